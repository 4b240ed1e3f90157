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
            let shift = slope.map(|s| s * rise * f64::from(mip.width));
            for (index, open) in open.iter_mut().enumerate() {
                let (x, y) = (index % mip.width as usize, index / mip.width as usize);
                *open *= 1.0 - alpha_between(mip, layer, x as f64 + shift[0], y as f64 + shift[1]);
            }
        }
        Some(open.iter().sum::<f64>() / open.len().max(1) as f64)
    }
}

/// Linear, premultiplied.
fn decode(texel: &[u8]) -> [f32; 4] {
    [srgb_to_linear(texel[0]), srgb_to_linear(texel[1]), srgb_to_linear(texel[2]), f32::from(texel[3]) / 255.0]
}

/// Alpha between texel centres, wrapped; (x, y) counts from the centre of the first texel.
fn alpha_between(mip: &Image, layer: u32, x: f64, y: f64) -> f64 {
    let (fx, fy) = (x - x.floor(), y - y.floor());
    let at = |dx: f64, dy: f64| {
        let wrap = |c: f64, side: u32| (c as i64).rem_euclid(i64::from(side)) as u32;
        let texel = mip.texel(layer, wrap(x.floor() + dx, mip.width), wrap(y.floor() + dy, mip.height));
        texel.map_or(0.0, |t| f64::from(t[3]) / 255.0)
    };
    let top = at(0.0, 0.0) * (1.0 - fx) + at(1.0, 0.0) * fx;
    let bottom = at(0.0, 1.0) * (1.0 - fx) + at(1.0, 1.0) * fx;
    top * (1.0 - fy) + bottom * fy
}
