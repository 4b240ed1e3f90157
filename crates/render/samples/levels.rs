//! Coarser levels of detail of a stack made by hand: pairs of shells composited, again and again, down to one (Lengyel et al. 2001, section 3).

use std::sync::Arc;

use pelage_coat::{ShellLayer, ShellTexture};

use super::hair::{Hair, decode, mips};

/// The hair with all its coarser levels.
pub fn with_levels(hair: &Hair) -> Hair {
    let finest = &hair.shells.mips[0];
    let side = finest.width as usize;
    let texels = finest.texels.chunks_exact(4).map(|t| decode([t[0], t[1], t[2], t[3]]));
    let all: Vec<[f32; 4]> = texels.collect();
    let mut images: Vec<Vec<[f32; 4]>> = all.chunks_exact(side * side).map(<[_]>::to_vec).collect();
    let mut levels = vec![hair.shells.levels[0].clone()];
    while let Some(fine) = levels.last().filter(|level| level.len() > 1).cloned() {
        let coarse = fine.chunks(2).map(|pair| composite(pair, &mut images)).collect();
        levels.push(coarse);
    }
    let shells = ShellTexture { images: images.len() as u32, mips: mips(images, side, side), levels, ..ShellTexture::clone(&hair.shells) };
    Hair { shells: Arc::new(shells), fin: Arc::clone(&hair.fin) }
}

/// One shell that stands for two, and its image; an odd one out is itself.
fn composite(pair: &[ShellLayer], images: &mut Vec<Vec<[f32; 4]>>) -> ShellLayer {
    let [below, above] = pair else { return pair[0] };
    let (lower, upper) = (&images[below.image as usize], &images[above.image as usize]);
    let over = lower.iter().zip(upper).map(|(b, a)| std::array::from_fn(|c| a[c] + b[c] * (1.0 - a[3])));
    let image: Vec<[f32; 4]> = over.collect();
    // What each adds to the coverage says at which height the light is taken.
    let (seen_above, all) = (upper.iter().map(|a| a[3]).sum::<f32>(), image.iter().map(|c| c[3]).sum::<f32>());
    let share = if all > 0.0 { seen_above / all } else { 0.5 };
    let light_height = below.light_height + share * (above.light_height - below.light_height);
    images.push(image);
    ShellLayer { image: images.len() as u32 - 1, light_height, ..*below }
}
