//! Coarser and coarser shells of the same hair (L16).

use rayon::prelude::*;

use crate::composite::shown;
use crate::directions::{direction_mips, weighted};
use crate::error::VolumeError;
use crate::image::{Image, ShellStack};
use crate::plane::{Plane, encode};
use crate::shell::Shell;
use crate::shells::MAX_TEXELS;

impl ShellStack {
    /// The stack with all its levels of detail: of each level, the shells 2*j* and 2*j* + 1 of the finer one composited into one that stands where shell 2*j* does
    /// (Lengyel et al. 2001, section 2.4), down to the skin with all hair on it.
    ///
    /// Composited in premultiplied linear light from the finest level's images, mip by mip, and rounded to bytes once, so that along the normal each level covers in every
    /// texel of every mip what the finest does: a coat keeps its opacity and its colour as it recedes, whatever its mips are made by. (Mips made of the composite would
    /// be another coat: hair that stands in the same texels in two layers covers less, composited first, than two layers that were averaged first.) The new images follow
    /// those there are: 2N − 1 in all for N shells with an image each. Two shells that show one image go on showing it, as one shell of more layers, and need no new one.
    /// Coarser levels that the stack had are made anew.
    ///
    /// # Errors
    /// More texels than are worked on at once.
    pub fn with_levels(&self) -> Result<Self, VolumeError> {
        let mut stack = self.finest();
        let side = u64::from(stack.resolution());
        let asked = 2 * u64::from(stack.layers()) * side * side;
        if asked > 2 * MAX_TEXELS {
            return Err(VolumeError::TooManyTexels { asked: asked / 2, limit: MAX_TEXELS });
        }
        let mut mips: Vec<Vec<Layer>> = (0..stack.mips.len()).into_par_iter().map(|mip| layers(&stack, mip)).collect();
        while mips.first().is_some_and(|layers| layers.len() > 1) {
            mips = mips.into_par_iter().map(|layers| layers.chunks(2).map(Layer::of_pair).collect()).collect();
            settle_shells(&mut mips, stack.images());
            stack.append(&mips);
            stack.levels.extend(mips.first().map(|layers| layers.iter().map(|layer| layer.shell).collect()));
            mips.iter_mut().flatten().for_each(|layer| layer.is_new = false);
        }
        Ok(stack)
    }

    /// The finest level of detail alone, with the images that it shows, in the order in which it shows them first.
    pub(crate) fn finest(&self) -> Self {
        let mut shells = self.levels.first().cloned().unwrap_or_default();
        let mut kept: Vec<u32> = Vec::new();
        for shell in &mut shells {
            let place = kept.iter().position(|&image| image == shell.image).unwrap_or_else(|| {
                kept.push(shell.image);
                kept.len() - 1
            });
            shell.image = place as u32;
        }
        let pick = |mips: &[Image]| mips.iter().map(|mip| picked(mip, &kept)).collect();
        Self {
            mips: pick(&self.mips),
            directions: self.directions.as_deref().map(pick),
            levels: vec![shells],
            ..self.clone_without_images()
        }
    }

    /// What is not images.
    fn clone_without_images(&self) -> Self {
        Self { height: self.height, mips: Vec::new(), levels: self.levels.clone(), directions: None, work: self.work }
    }

    /// Adds the images of a level's layers that are new, for each mip.
    fn append(&mut self, mips: &[Vec<Layer>]) {
        for (images, layers) in self.mips.iter_mut().zip(mips) {
            let new: Vec<Plane> = layers.iter().filter(|layer| layer.is_new).map(|layer| layer.colour.clone()).collect();
            images.texels.extend(encode(&new).texels);
            images.layers += new.len() as u32;
        }
        if let (Some(directions), Some(finest)) = (&mut self.directions, mips.first()) {
            let planes = finest.iter().filter(|layer| layer.is_new).filter_map(|layer| layer.directions.clone()).collect();
            for (images, new) in directions.iter_mut().zip(direction_mips(planes)) {
                images.texels.extend(new.texels);
                images.layers += new.layers;
            }
        }
    }
}

/// Says of a new level's shells, the same for all mips, where their images will be and at what height they are lit: where the coarsest mip, which knows the
/// coverage of whole layers, shows their hair aslant: along the normal one sees deeper into the shade than from aside. What fine mips hide in the same texel is seen from aside, as one layer moves against the next.
fn settle_shells(mips: &mut [Vec<Layer>], images: u32) {
    let heights: Vec<f32> = mips.last().map_or(Vec::new(), |layers| layers.iter().map(Layer::light_height).collect());
    for layers in mips {
        let mut next = images;
        for (layer, &height) in layers.iter_mut().zip(&heights) {
            layer.shell.light_height = height;
            if layer.is_new {
                layer.shell.image = next;
                next += 1;
            }
        }
    }
}

/// Some images of a mip level.
fn picked(mip: &Image, images: &[u32]) -> Image {
    let size = 4 * mip.width as usize * mip.height as usize;
    let bytes = images.iter().filter_map(|&image| mip.texels.get(image as usize * size..(image as usize + 1) * size));
    Image { layers: images.len() as u32, texels: bytes.flatten().copied().collect(), ..*mip }
}

/// A shell while levels are made of it, unrounded.
#[derive(Clone)]
struct Layer {
    shell: Shell,
    colour: Plane,
    directions: Option<Plane>,
    /// What is seen of it from outside, aslant, texel by texel, and that times the height.
    seen: Vec<f32>,
    lit: Vec<f32>,
    /// No image of the stack shows it yet.
    is_new: bool,
}

/// A mip of the finest level, as it is drawn; the finest mip with its directions.
fn layers(stack: &ShellStack, mip: usize) -> Vec<Layer> {
    let shells = stack.levels.first().map_or(&[][..], Vec::as_slice);
    let map = stack.directions.as_ref().filter(|_| mip == 0).and_then(|mips| mips.first());
    let Some(mip) = stack.mips.get(mip) else { return Vec::new() };
    let layer = |&shell: &Shell| {
        let colour = shown(mip, &shell);
        let directions = map.map(|map| weighted(map, shell.image, &colour));
        let seen: Vec<f32> = colour.texels.iter().map(|texel| aslant(texel[3])).collect();
        let lit = seen.iter().map(|seen| seen * shell.light_height).collect();
        Layer { shell, colour, directions, seen, lit, is_new: false }
    };
    shells.par_iter().map(layer).collect()
}

impl Layer {
    /// The composite of a pair; of an odd one left over at the tips, itself.
    fn of_pair(pair: &[Self]) -> Self {
        let mut layer = pair[0].clone();
        let Some(upper) = pair.get(1) else { return layer };
        for (lit, (above, seen)) in layer.lit.iter_mut().zip(upper.lit.iter().zip(&upper.seen)) {
            *lit = above + *lit * (1.0 - seen);
        }
        for (seen, above) in layer.seen.iter_mut().zip(&upper.seen) {
            *seen = above + *seen * (1.0 - above);
        }
        layer.colour.cover(&upper.colour);
        if let (Some(below), Some(above)) = (&mut layer.directions, &upper.directions) {
            below.cover(above);
        }
        if layer.shell.image == upper.shell.image {
            layer.shell = layer.shell.merged(&upper.shell);
        } else {
            layer.shell = Shell { opacity: 1.0, layers: 1.0, ..layer.shell };
            layer.is_new = true;
        }
        layer
    }

    /// The mean height of what is seen aslant from outside, as most of a coat is; its own where nothing is.
    fn light_height(&self) -> f32 {
        let seen: f64 = self.seen.iter().map(|&seen| f64::from(seen)).sum();
        let lit: f64 = self.lit.iter().map(|&lit| f64::from(lit)).sum();
        if seen > 0.0 { ((lit / seen) as f32).clamp(0.0, 1.0) } else { self.shell.height }
    }
}

/// What of an opacity is met by a ray that crosses layers as slantedly as rays of sight do on the mean, at N·V = 2/3.
fn aslant(alpha: f32) -> f32 {
    1.0 - (1.0 - alpha).max(0.0).powf(1.5)
}
