//! Fur maps: hair that is a pattern in the tile and not strands (K2, Z1, Z2).
//!
//! A map ranks the places of the tile: the first in rank is covered wherever anything is. At height *h*, 0 at the skin and 1 at the tips, the part `density` × (1 − *h*)^`thinning` is covered, so that
//! the density is the part that is covered at the skin, and hair thins to the tips as `thinning` says (K3); at 0 all hair is as long as the fur. With every place of the same rank on all layers
//! hair stands straight (Kenwright 2014, 2.5.1: the same seed for all layers).
//!
//! Zima's article picks texels with replacement, so that a density of 0.2 covers 0.18, and numbers layers so that the tip is never drawn. Here the density is what is covered, and layers reach
//! the tips.

mod ranks;

use rayon::prelude::*;

use crate::error::{VolumeError, within};
use crate::image::ShellStack;
use crate::pixels::resized;
use crate::plane::Plane;
use crate::stack::StackSettings;
use ranks::{Grain, Noise};

/// What the pattern is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MapLook {
    /// Cells of a square grid at random, each a hair or nothing (Zima's fur map).
    #[default]
    Grains,
    /// Clouds: gradient noise (Perlin 2002).
    Perlin,
    /// Clouds without the grid's axes to be seen: gradient noise on a simplicial grid (OpenSimplex).
    Simplex,
    /// Round tufts at random places, one to a cell (Worley 1996).
    Dots,
}

/// A pattern of hair in the tile. It does not depend on how finely it is sampled: another resolution shows the same hair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FurMap {
    /// What the pattern is.
    pub look: MapLook,
    /// Cells along the tile's side, 1 to 1024 of grains and to 256 of noise.
    pub cells: u32,
    /// The part of the skin that hair covers, 0 to 1.
    pub density: f64,
    /// How it falls towards the tips, as an exponent: 0 to 16.
    pub thinning: f64,
    /// Of noise how many layers are added, each with cells half as large: 1 to 8.
    pub octaves: u32,
    /// Of noise by how many cells it changes from the skin to the tips: 0 to 16. 0: hair stands straight.
    pub drift: f64,
    /// Of animated layers (K19) where in the loop they are; its whole part does not count.
    pub phase: f64,
    /// How much they move, 0 to 1: grains grow shorter by so much and longer again, each at its own time; noise moves by so many cells.
    pub swing: f64,
    /// Linear RGB at the skin, each 0 to 1.
    pub root_colour: [f32; 3],
    /// The same at the tips.
    pub tip_colour: [f32; 3],
    /// By how much hairs differ in brightness, 0 to 1; each is the same from root to tip (K9).
    pub brightness: f64,
    /// Which of the patterns of a kind.
    pub seed: u64,
}

impl Default for FurMap {
    fn default() -> Self {
        Self {
            look: MapLook::Grains,
            cells: 128,
            density: 0.2,
            thinning: 0.0,
            octaves: 1,
            drift: 0.0,
            phase: 0.0,
            swing: 0.0,
            root_colour: [0.15, 0.1, 0.07],
            tip_colour: [0.6, 0.45, 0.3],
            brightness: 0.1,
            seed: 1,
        }
    }
}

impl FurMap {
    /// Says what is wrong first, if anything is.
    ///
    /// # Errors
    /// A value outside the range that its field states.
    pub fn validate(&self) -> Result<(), VolumeError> {
        let most = if self.look == MapLook::Grains { 1024.0 } else { 256.0 };
        within("cells", f64::from(self.cells), 1.0, most, "cells")?;
        within("density", self.density, 0.0, 1.0, "(fraction covered)")?;
        within("thinning", self.thinning, 0.0, 16.0, "(exponent)")?;
        within("octaves", f64::from(self.octaves), 1.0, 8.0, "octaves")?;
        within("drift", self.drift, 0.0, 16.0, "cells")?;
        within("phase", self.phase, -1e6, 1e6, "loops")?;
        within("swing", self.swing, 0.0, 1.0, "(fraction)")?;
        within("brightness", self.brightness, 0.0, 1.0, "(fraction)")?;
        let colours = self.root_colour.iter().chain(&self.tip_colour);
        colours.into_iter().try_for_each(|&c| within("colour", f64::from(c), 0.0, 1.0, "(linear light)"))
    }

    /// The part that is covered at a height.
    fn covered(&self, height: f64) -> f64 {
        self.density * libm::pow((1.0 - height).max(0.0), self.thinning)
    }

    /// What a hair looks like at a height, premultiplied: `shade` from −1 to 1 is how much brighter or darker it is than the mean.
    fn texel(&self, height: f64, shade: f64, alpha: f32) -> [f32; 4] {
        let (t, bright) = (height as f32, (1.0 + self.brightness * shade) as f32);
        let colour = |k: usize| ((self.root_colour[k] + (self.tip_colour[k] - self.root_colour[k]) * t) * bright).clamp(0.0, 1.0) * alpha;
        [colour(0), colour(1), colour(2), alpha]
    }
}

/// Makes shells of a map. The same bytes come out whatever the number of threads.
///
/// # Errors
/// Settings out of range.
///
/// # Example
///
/// ```
/// use pelage_volume::{FurMap, StackSettings, map_shells};
///
/// let shells = map_shells(&FurMap { density: 0.2, ..FurMap::default() }, &StackSettings { layers: 40, ..StackSettings::default() })?;
/// assert!((shells.mips[0].mean_coverage(39) - 0.2).abs() < 1e-3);
/// # Ok::<(), pelage_volume::VolumeError>(())
/// ```
pub fn map_shells(map: &FurMap, settings: &StackSettings) -> Result<ShellStack, VolumeError> {
    map.validate()?;
    settings.validate()?;
    let heights = settings.spacing.heights(settings.layers);
    let side = settings.resolution;
    let planes: Vec<Plane> = match map.look {
        MapLook::Grains => {
            let grains = ranks::grains(map);
            heights.par_iter().map(|&height| resized(&grains_at(map, &grains, height), side, side)).collect()
        }
        MapLook::Perlin | MapLook::Simplex | MapLook::Dots => {
            let noise = Noise::new(map);
            heights.par_iter().map(|&height| noise_at(map, &noise, height, side as usize)).collect()
        }
    };
    Ok(settings.stack(planes))
}

/// The cells at a height, a texel each.
fn grains_at(map: &FurMap, grains: &[Grain], height: f64) -> Plane {
    let mut plane = Plane::new(map.cells as usize, map.cells as usize);
    for (texel, grain) in plane.texels.iter_mut().zip(grains) {
        // Its own height when it is as short as now; past its tip there is nothing.
        let own = height / grain.length(map);
        if own <= 1.0 && grain.rank < map.covered(own) {
            *texel = map.texel(height, grain.shade, 1.0);
        }
    }
    plane
}

/// Noise at a height. Edges are as wide as a texel.
fn noise_at(map: &FurMap, noise: &Noise, height: f64, side: usize) -> Plane {
    let mut plane = Plane::new(side, side);
    let threshold = map.covered(height);
    if threshold <= 0.0 {
        return plane;
    }
    let ranks = noise.ranks(height, side);
    let at = |x: usize, y: usize| ranks[y % side * side + x % side];
    for (index, texel) in plane.texels.iter_mut().enumerate() {
        let (x, y) = (index % side, index / side);
        let across = (at(x + 1, y) - at(x + side - 1, y)).abs().max((at(x, y + 1) - at(x, y + side - 1)).abs());
        let width = (0.5 * across).max(1e-9);
        let alpha = if threshold >= 1.0 { 1.0 } else { (0.5 + (threshold - ranks[index]) / width).clamp(0.0, 1.0) };
        if alpha > 0.0 {
            *texel = map.texel(height, noise.shade(x, y, side), alpha as f32);
        }
    }
    plane
}
