//! What the hair shall be like.

use crate::colour::{Bands, Opacity};
use crate::curve::Taper;
use crate::error::{StrandError, within};
use crate::gather::Gather;
use crate::style::Style;
use crate::vary::{self, ByNoise, ByPattern};

/// Most strands in a tile, guard hairs and undercoat together.
pub const MAX_STRANDS: u64 = 1 << 20;
/// Most points in a tile (16 bytes each: 512 MiB).
pub const MAX_POINTS: u64 = 1 << 25;

/// The second, shorter population: down between the guard hairs. Deep layers become dense by it, upper ones stay open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Undercoat {
    /// Strands in a tile; 0 leaves the undercoat out. Cost is linear in it.
    pub count: u32,
    /// Height of the longest, as a fraction of the guard hairs' height: 0.05 to 1.
    pub length: f64,
    /// Radius at the root, as a fraction of the guard hairs': 0.05 to 4.
    pub thickness: f64,
    /// Linear RGB, each 0 to 1; the root is darker by the same ratio as the guard hairs' root.
    pub colour: [f32; 3],
}

/// Everything [`crate::grow`] needs. Lengths are in tile sides, angles in degrees, colours linear RGB.
///
/// The default is a soft, dense rabbit's coat for a tile of about a tenth of the model's diameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrowSettings {
    /// Guard hairs in a tile: some 100 is sparse, 1000 dense at the default thickness; up to [`MAX_STRANDS`]. Cost is linear in it.
    pub count: u32,
    /// Height that the longest hair reaches, in tile sides: 0.001 to 8.
    pub height: f64,
    /// How much shorter hairs may be: the shortest is 1 − this of the longest, most are near the longest (K3). 0 to 0.95.
    pub length_variation: f64,
    /// Radius at the root, in tile sides: 1e-6 to 0.25.
    pub thickness: f64,
    /// How much thicker or thinner hairs may be, constant along a hair: 0 to 0.95.
    pub thickness_variation: f64,
    /// Radius at the tip as a fraction of that at the root: 0 to 1.
    pub tip_thickness: f64,
    /// How much thicker or thinner tips may be: 0 to 1.
    pub tip_variation: f64,
    /// How the radius goes from root to tip (K6).
    pub taper: Taper,
    /// Shape around the way of growth.
    pub style: Style,
    /// Angle from upright towards +t that the hair grows at, in degrees: 0 to 75.
    pub lean: f64,
    /// How much more or less than others a hair may bend, lean and gravity: 0 to 1.
    pub bend_variation: f64,
    /// How much each hair's own heading differs from the lean, in degrees: 0 to 60.
    pub splay: f64,
    /// Pull back to the heading, per length grown: 0 (free) to 100 (stiff).
    pub stiffness: f64,
    /// Pull towards the skin, per length grown: 0 to 20. Tips lie lower than roots by it.
    pub gravity: f64,
    /// Smooth random sideways push, half of it shared by neighbours: 0 to 20.
    pub wander: f64,
    /// How strongly hairs keep clear of each other: 0 to 20.
    pub separation: f64,
    /// How far tips gather to the lock's middle: 0 (none) to 1 (points).
    pub clump: f64,
    /// Width of a lock, of `clump` as of `gather`, in tile sides: 0.01 to 1.
    pub clump_size: f64,
    /// How hairs lie in locks: not, in tufts or in spikes (K7).
    pub gather: Gather,
    /// Linear RGB at the root, each 0 to 1.
    pub root_colour: [f32; 3],
    /// Linear RGB at the tip, each 0 to 1.
    pub tip_colour: [f32; 3],
    /// Brightness differs by up to this fraction from hair to hair, constant along a hair (K9): 0 to 1.
    pub colour_variation: f64,
    /// Colours along the guard hairs in the place of those of root and tip, shared by all of them; none by default (K9).
    pub bands: Bands,
    /// What part of all hairs is white: 0 to 1 (K9).
    pub white: f64,
    /// How opaque hairs are, by hair and from root to tip (K9).
    pub opacity: Opacity,
    /// What smooth noise takes away from place to place (K6); nothing by default.
    pub by_noise: ByNoise,
    /// What a pattern takes away from place to place (K6); nothing by default.
    pub by_pattern: ByPattern,
    /// The down between the guard hairs.
    pub undercoat: Undercoat,
    /// Time steps of the simulation and segments of a strand: 1 to 512. Cost is linear in it; below about 8 for each turn curls show corners.
    pub steps: u32,
    /// Of everything random.
    pub seed: u64,
}

impl Default for Undercoat {
    fn default() -> Self {
        Self { count: 3200, length: 0.55, thickness: 0.7, colour: [0.30, 0.245, 0.19] }
    }
}

impl Default for GrowSettings {
    fn default() -> Self {
        Self {
            count: 1400,
            height: 0.35,
            length_variation: 0.5,
            thickness: 0.0095,
            thickness_variation: 0.15,
            tip_thickness: 0.15,
            tip_variation: 0.0,
            taper: Taper::Power { exponent: 2.0 },
            style: Style::Wavy { amplitude: 0.008 / 0.35, waves: 1.2 },
            lean: 22.0,
            bend_variation: 0.0,
            splay: 10.0,
            stiffness: 3.0,
            gravity: 0.5,
            wander: 0.4,
            separation: 0.6,
            clump: 0.15,
            clump_size: 0.1,
            gather: Gather::Free,
            root_colour: [0.16, 0.115, 0.08],
            tip_colour: [0.50, 0.41, 0.32],
            colour_variation: 0.3,
            bands: Bands::default(),
            white: 0.0,
            opacity: Opacity::default(),
            by_noise: ByNoise::default(),
            by_pattern: ByPattern::default(),
            undercoat: Undercoat::default(),
            steps: 24,
            seed: 25,
        }
    }
}

impl GrowSettings {
    /// Guard hairs and undercoat together.
    pub fn strand_count(&self) -> u64 {
        u64::from(self.count) + u64::from(self.undercoat.count)
    }

    /// Says what is wrong first, if anything is.
    ///
    /// # Errors
    /// A value outside the range that its field states, or more strands or points than a tile holds.
    pub fn validate(&self) -> Result<(), StrandError> {
        let sides = "tile sides";
        let of_one = "of 1";
        within("height", self.height, 1e-3, 8.0, sides)?;
        within("length_variation", self.length_variation, 0.0, 0.95, of_one)?;
        within("thickness", self.thickness, 1e-6, 0.25, sides)?;
        within("tip_thickness", self.tip_thickness, 0.0, 1.0, of_one)?;
        within("thickness_variation", self.thickness_variation, 0.0, 0.95, of_one)?;
        within("tip_variation", self.tip_variation, 0.0, 1.0, of_one)?;
        within("bend_variation", self.bend_variation, 0.0, 1.0, of_one)?;
        within("lean", self.lean, 0.0, 75.0, "degrees")?;
        within("splay", self.splay, 0.0, 60.0, "degrees")?;
        within("stiffness", self.stiffness, 0.0, 100.0, "per length")?;
        within("gravity", self.gravity, 0.0, 20.0, "per length")?;
        within("wander", self.wander, 0.0, 20.0, "per length")?;
        within("separation", self.separation, 0.0, 20.0, "per length")?;
        within("clump", self.clump, 0.0, 1.0, of_one)?;
        within("clump_size", self.clump_size, 0.01, 1.0, sides)?;
        within("colour_variation", self.colour_variation, 0.0, 1.0, of_one)?;
        within("white", self.white, 0.0, 1.0, of_one)?;
        within("undercoat.length", self.undercoat.length, 0.05, 1.0, "of the guard hairs'")?;
        within("undercoat.thickness", self.undercoat.thickness, 0.05, 4.0, "of the guard hairs'")?;
        for (name, colour) in
            [("root_colour", self.root_colour), ("tip_colour", self.tip_colour), ("undercoat.colour", self.undercoat.colour)]
        {
            colour.iter().try_for_each(|&c| within(name, f64::from(c), 0.0, 1.0, "(linear light)"))?;
        }
        within("steps", f64::from(self.steps), 1.0, 512.0, "steps")?;
        self.style.validate()?;
        self.taper.validate()?;
        self.gather.validate()?;
        self.opacity.validate()?;
        vary::validate(&self.by_noise, &self.by_pattern)?;
        self.validate_size()
    }

    fn validate_size(&self) -> Result<(), StrandError> {
        check_size(self.strand_count(), self.strand_count() * (u64::from(self.steps) + 1))
    }
}

/// Whether a tile holds as many strands and points.
pub(crate) fn check_size(strands: u64, points: u64) -> Result<(), StrandError> {
    if strands > MAX_STRANDS {
        return Err(StrandError::TooManyStrands { asked: strands, limit: MAX_STRANDS });
    }
    if points > MAX_POINTS { Err(StrandError::TooManyPoints { asked: points, limit: MAX_POINTS }) } else { Ok(()) }
}
