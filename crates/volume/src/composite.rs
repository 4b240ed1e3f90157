//! Looking at a stack without a renderer.

use crate::image::{Image, ShellStack};
use crate::srgb::srgb_to_linear;

impl ShellStack {
    /// The picture of one level seen along the normal, outermost layer in front: linear RGBA, premultiplied; alpha is what hair covers, the skin not counted.
    ///
    /// With `skin`, the innermost layer is behind and every texel is opaque. `None` for a level that does not exist.
    pub fn seen_from_above(&self, level: usize, skin: bool) -> Option<Vec<[f32; 4]>> {
        let mip = self.mips.get(level)?;
        let size = (mip.width * mip.height) as usize;
        let mut picture = vec![[0.0f32; 4]; size];
        let first = usize::from(!skin);
        for layer in mip.texels.chunks_exact(4 * size).skip(first) {
            for (below, texel) in picture.iter_mut().zip(layer.chunks_exact(4)) {
                let over = decode(texel);
                for channel in 0..4 {
                    below[channel] = over[channel] + below[channel] * (1.0 - over[3]);
                }
            }
        }
        Some(picture)
    }

    /// What part of the light passes all layers above the skin along a slanted line, averaged over the tile.
    ///
    /// `slope` is how far the line runs along x and y for each tile side that it rises: (0, 0) along the normal, (1, 0) at 45°. Layers are read between texels
    /// as a graphics card does. `None` for a level that does not exist or a slope that is not finite.
    pub fn transmittance(&self, level: usize, slope: [f64; 2]) -> Option<f64> {
        let mip = self.mips.get(level)?;
        if !slope.iter().all(|s| s.is_finite()) {
            return None;
        }
        let steps = f64::from((self.layers - 1).max(1));
        let mut open = vec![1.0f64; (mip.width * mip.height) as usize];
        for layer in 1..self.layers {
            let rise = self.height * f64::from(layer) / steps;
            dim(&mut open, mip, layer, slope.map(|s| s * rise * f64::from(mip.width)));
        }
        Some(open.iter().sum::<f64>() / open.len().max(1) as f64)
    }
}

/// Linear, premultiplied.
fn decode(texel: &[u8]) -> [f32; 4] {
    [srgb_to_linear(texel[0]), srgb_to_linear(texel[1]), srgb_to_linear(texel[2]), f32::from(texel[3]) / 255.0]
}

/// Takes from each texel what a layer, moved by `shift` texels over the torus, covers; read between texel centres.
fn dim(open: &mut [f64], mip: &Image, layer: u32, shift: [f64; 2]) {
    let size = (mip.width * mip.height) as usize;
    let (width, height) = (mip.width as usize, mip.height as usize);
    let layer: Vec<f64> =
        mip.texels.chunks_exact(4).skip(layer as usize * size).take(size).map(|texel| f64::from(texel[3]) / 255.0).collect();
    let [fx, fy] = shift.map(|s| s - s.floor());
    // A shift may be many tiles.
    let wrapped = |shift: f64, side: usize| (shift.floor().rem_euclid(side as f64) as usize).min(side - 1);
    let (right, down) = (wrapped(shift[0], width), wrapped(shift[1], height));
    for (y, line) in open.chunks_exact_mut(width.max(1)).enumerate() {
        let row = |y: usize| &layer[(y + down) % height * width..][..width];
        let (top, bottom) = (row(y), row(y + 1));
        for (x, open) in line.iter_mut().enumerate() {
            let (left, right) = ((x + right) % width, (x + right + 1) % width);
            let above = top[left] * (1.0 - fx) + top[right] * fx;
            let below = bottom[left] * (1.0 - fx) + bottom[right] * fx;
            *open *= 1.0 - (above * (1.0 - fy) + below * fy);
        }
    }
}
