//! A fin of shells that no strands are known of.

use crate::error::VolumeError;
use crate::fin::FinSettings;
use crate::image::{FinTexture, ShellStack, Work};
use crate::mips::image_mips;
use crate::pixels::resized;
use crate::plane::Plane;
use crate::shell::Shell;

impl ShellStack {
    /// A fin of the shells themselves: a slab of their texels, each row of the fin what of the nearest shell is seen through the slab. For hair whose strands nobody has, as a noise's; where there are
    /// strands [`sample_fin`](crate::sample_fin) is finer. Of several tiles side by side each is cut at another place.
    ///
    /// # Errors
    /// Settings out of range, as of [`sample_fin`](crate::sample_fin); a stack without shells above its skin.
    pub fn fin(&self, settings: &FinSettings) -> Result<FinTexture, VolumeError> {
        settings.validate()?;
        let shells = self.levels.first().map_or(&[][..], Vec::as_slice);
        let (Some(hair), Some(finest)) = (shells.get(1..).filter(|hair| !hair.is_empty()), self.mips.first()) else {
            return Err(VolumeError::NoHairShells);
        };
        let images: Vec<Plane> = (0..finest.layers).map(|layer| Plane::decoded(finest, layer)).collect();
        let (rows, tiles) = (settings.height, settings.tiles_across);
        let side = finest.width as usize;
        let depth = ((settings.slab_width * side as f64).round() as usize).clamp(1, side);
        let mut fin = Plane::new(side * tiles as usize, rows as usize);
        for row in 0..rows as usize {
            let shell = nearest(hair, 1.0 - (row as f32 + 0.5) / rows as f32);
            let Some(image) = images.get(shell.image as usize) else { continue };
            for column in 0..fin.width {
                let (tile, s) = (column / side, column % side);
                // A tile's cut begins a part of the side further than the one before, which no number of tiles repeats.
                let start = (tile as f64 * 0.618_033_988_749_895).fract() * side as f64;
                fin.texels[row * side * tiles as usize + column] = through(image, shell, s, start as usize, depth);
            }
        }
        let mips = image_mips(resized(&fin, settings.width, settings.height));
        Ok(FinTexture { tiles_across: tiles, height: self.height, mips, work: Work::default() })
    }
}

/// The shell that stands nearest to a height.
fn nearest(shells: &[Shell], height: f32) -> &Shell {
    let far = |shell: &&Shell| (shell.height - height).abs();
    shells.iter().min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(&shells[0])
}

/// What is seen of `depth` texels in a row, the nearest first.
fn through(image: &Plane, shell: &Shell, s: usize, start: usize, depth: usize) -> [f32; 4] {
    let mut seen = [0.0f32; 4];
    for step in 0..depth {
        let texel = image.texels[(start + step) % image.height * image.width + s];
        let alpha = shell.covers(texel[3]);
        let share = if texel[3] > 0.0 { alpha / texel[3] } else { 0.0 };
        let open = 1.0 - seen[3];
        for channel in 0..3 {
            seen[channel] += open * share * texel[channel];
        }
        seen[3] += open * alpha;
    }
    seen
}
