//! Coarser and coarser shells of the same hair (L16).

use rayon::prelude::*;

use crate::composite::shown;
use crate::directions::{direction_mips, weighted};
use crate::error::VolumeError;
use crate::image::{Image, ShellStack};
use crate::mips::{MipRule, shell_mips};
use crate::plane::Plane;
use crate::shell::Shell;
use crate::shells::MAX_TEXELS;

impl ShellStack {
    /// The stack with all its levels of detail: of each level, the shells 2*j* and 2*j* + 1 of the finer one composited into one that stands where shell 2*j* does
    /// (Lengyel et al. 2001, section 2.4), down to the skin with all hair on it.
    ///
    /// Composited at full resolution, in premultiplied linear light, from the finest level's images, and rounded to bytes once, so that along the normal each level covers in
    /// every texel what the finest does. Mips are then made by `rule`: of the composite, not the composite of mips. The new images follow those there are:
    /// 2N − 1 in all for N shells with an image each. Two shells that show one image go on showing it, as one shell of more layers, and need no new one.
    /// Coarser levels that the stack had are made anew.
    ///
    /// # Errors
    /// More texels than are worked on at once.
    pub fn with_levels(&self, rule: MipRule) -> Result<Self, VolumeError> {
        let mut stack = self.finest();
        let side = u64::from(stack.resolution());
        let asked = 2 * u64::from(stack.layers()) * side * side;
        if asked > 2 * MAX_TEXELS {
            return Err(VolumeError::TooManyTexels { asked: asked / 2, limit: MAX_TEXELS });
        }
        let mut layers = layers(&stack);
        while layers.len() > 1 {
            layers = layers.par_chunks(2).map(Layer::of_pair).collect();
            for (image, layer) in (stack.images()..).zip(layers.iter_mut().filter(|layer| layer.is_new)) {
                layer.shell.image = image;
            }
            stack.append(&layers, rule);
            stack.levels.push(layers.iter().map(|layer| layer.shell).collect());
            layers.iter_mut().for_each(|layer| layer.is_new = false);
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

    /// Adds the images of a level's layers that are new.
    fn append(&mut self, layers: &[Layer], rule: MipRule) {
        let new: Vec<u32> = (0u32..).zip(layers).filter(|(_, layer)| layer.is_new).map(|(index, _)| index).collect();
        // The whole level, as a rule may look at columns.
        let mips = shell_mips(layers.iter().map(|layer| layer.colour.clone()).collect(), rule);
        join(&mut self.mips, &mips, &new);
        if let Some(directions) = &mut self.directions {
            let planes: Option<Vec<Plane>> = layers.iter().map(|layer| layer.directions.clone()).collect();
            join(directions, &direction_mips(planes.unwrap_or_default()), &new);
        }
    }
}

/// Some images of a mip level.
fn picked(mip: &Image, images: &[u32]) -> Image {
    let size = 4 * mip.width as usize * mip.height as usize;
    let bytes = images.iter().filter_map(|&image| mip.texels.get(image as usize * size..(image as usize + 1) * size));
    Image { layers: images.len() as u32, texels: bytes.flatten().copied().collect(), ..*mip }
}

/// Adds some of the images of other mips to those there are.
fn join(mips: &mut [Image], others: &[Image], images: &[u32]) {
    for (mip, other) in mips.iter_mut().zip(others) {
        mip.texels.extend(picked(other, images).texels);
        mip.layers += images.len() as u32;
    }
}

/// A shell while levels are made of it, unrounded.
#[derive(Clone)]
struct Layer {
    shell: Shell,
    colour: Plane,
    directions: Option<Plane>,
    /// Height times what is seen of it from outside, texel by texel.
    lit: Vec<f32>,
    /// No image of the stack shows it yet.
    is_new: bool,
}

/// The finest level, as it is drawn.
fn layers(stack: &ShellStack) -> Vec<Layer> {
    let shells = stack.levels.first().map_or(&[][..], Vec::as_slice);
    let Some(mip) = stack.mips.first() else { return Vec::new() };
    let map = stack.directions.as_ref().and_then(|mips| mips.first());
    let layer = |&shell: &Shell| {
        let colour = shown(mip, &shell);
        let directions = map.map(|map| weighted(map, shell.image, &colour));
        let lit = colour.texels.iter().map(|texel| texel[3] * shell.light_height).collect();
        Layer { shell, colour, directions, lit, is_new: false }
    };
    shells.par_iter().map(layer).collect()
}

impl Layer {
    /// The composite of a pair; of an odd one left over at the tips, itself.
    fn of_pair(pair: &[Self]) -> Self {
        let mut layer = pair[0].clone();
        let Some(upper) = pair.get(1) else { return layer };
        for (lit, (above, texel)) in layer.lit.iter_mut().zip(upper.lit.iter().zip(&upper.colour.texels)) {
            *lit = above + *lit * (1.0 - texel[3]);
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
        layer.shell.light_height = layer.light_height();
        layer
    }

    /// The mean height of what is seen from outside; its own where nothing is.
    fn light_height(&self) -> f32 {
        let seen: f64 = self.colour.texels.iter().map(|texel| f64::from(texel[3])).sum();
        let lit: f64 = self.lit.iter().map(|&lit| f64::from(lit)).sum();
        if seen > 0.0 { ((lit / seen) as f32).clamp(0.0, 1.0) } else { self.shell.height }
    }
}
