//! Looking at a stack without a renderer.

use crate::image::{Image, ShellStack};
use crate::plane::Plane;
use crate::shell::Shell;

impl ShellStack {
    /// The picture of one mip level seen along the normal, outermost shell in front: linear RGBA, premultiplied; alpha is what hair covers, the skin not counted.
    ///
    /// With `skin`, the innermost layer is behind and every texel is opaque. `None` for a level that does not exist.
    pub fn seen_from_above(&self, mip: usize, skin: bool) -> Option<Vec<[f32; 4]>> {
        self.seen_at(0, mip, skin)
    }

    /// The same at a level of detail. Of a coarser one the innermost shell holds hair besides the skin.
    pub fn seen_at(&self, level: usize, mip: usize, skin: bool) -> Option<Vec<[f32; 4]>> {
        let (shells, mip) = (self.levels.get(level)?, self.mips.get(mip)?);
        let mut picture = Plane::new(mip.width as usize, mip.height as usize);
        for shell in shells.iter().skip(usize::from(!skin)) {
            picture.cover(&shown(mip, shell));
        }
        Some(picture.texels)
    }

    /// What part of the light passes all shells above the skin along a slanted line, averaged over the tile.
    ///
    /// `slope` is how far the line runs along x and y for each tile side that it rises: (0, 0) along the normal, (1, 0) at 45°. Layers are read between texels
    /// as a graphics card does. `None` for a level that does not exist or a slope that is not finite.
    pub fn transmittance(&self, mip: usize, slope: [f64; 2]) -> Option<f64> {
        let (shells, mip) = (self.levels.first()?, self.mips.get(mip)?);
        if !slope.iter().all(|s| s.is_finite()) {
            return None;
        }
        let mut open = vec![1.0f64; (mip.width * mip.height) as usize];
        for shell in shells.iter().skip(1) {
            let rise = self.height * f64::from(shell.height);
            dim(&mut open, mip, shell, slope.map(|s| s * rise * f64::from(mip.width)));
        }
        Some(open.iter().sum::<f64>() / open.len().max(1) as f64)
    }
}

/// What a shell shows of a mip level: colour follows alpha, as it is premultiplied.
pub(crate) fn shown(mip: &Image, shell: &Shell) -> Plane {
    let mut plane = Plane::decoded(mip, shell.image);
    if shell.opacity == 1.0 && shell.layers == 1.0 {
        return plane;
    }
    for texel in &mut plane.texels {
        let covers = shell.covers(texel[3]);
        let share = if texel[3] > 0.0 { covers / texel[3] } else { 0.0 };
        *texel = [texel[0] * share, texel[1] * share, texel[2] * share, covers];
    }
    plane
}

/// Takes from each texel what a shell's image, moved by `shift` texels over the torus, covers; read between texel centres.
fn dim(open: &mut [f64], mip: &Image, shell: &Shell, shift: [f64; 2]) {
    let size = (mip.width * mip.height) as usize;
    let (width, height) = (mip.width as usize, mip.height as usize);
    let bytes = mip.texels.chunks_exact(4).skip(shell.image as usize * size).take(size);
    // Read between texels first, and then shown, as a graphics card does.
    let layer: Vec<f64> = bytes.map(|texel| f64::from(texel[3]) / 255.0).collect();
    let plain = shell.opacity == 1.0 && shell.layers == 1.0;
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
            let read = above * (1.0 - fy) + below * fy;
            *open *= 1.0 - if plain { read } else { f64::from(shell.covers(read as f32)) };
        }
    }
}
