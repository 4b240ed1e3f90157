//! What differs from place to place of the tile: by smooth noise and by a pattern (K6).

use libm::cos;
use std::f64::consts::TAU;

use crate::error::{StrandError, within};
use crate::noise::TileNoise;
use crate::seed::{Purpose, mix};

/// How much less of each there is where the noise or the pattern is at its most: 0 is none of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Amounts {
    /// Of the hair's length: 0 to 0.95.
    pub length: f64,
    /// Of its radius: 0 to 0.95.
    pub thickness: f64,
    /// Of its brightness: 0 to 1.
    pub colour: f64,
    /// Of its radius at the tip: 0 to 1.
    pub tip: f64,
    /// Of how far it bends, lean and gravity: 0 to 1.
    pub bend: f64,
}

/// Smooth noise over the tile, another for each quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ByNoise {
    /// Cells of noise along a tile side: 1 to 64.
    pub cells: u32,
    /// How much it takes away.
    pub amounts: Amounts,
}

/// A pattern over the tile, the same for each quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ByPattern {
    /// Its shape.
    pub pattern: Pattern,
    /// How wide its edges are: 0 (sharp) to 1 (a sine).
    pub softness: f64,
    /// How much it takes away.
    pub amounts: Amounts,
}

/// A pattern that repeats with the tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// Straight stripes, as wide as the gaps between them.
    Stripes {
        /// How many are met along s: 0 to 64.
        along_s: u32,
        /// How many are met along t: 0 to 64; with both, they run aslant.
        along_t: u32,
    },
    /// A chessboard.
    Checks {
        /// Pairs of squares along a tile side: 1 to 64.
        count: u32,
    },
    /// Round spots, every row half a step beside the one before, half of the tile in all.
    Dots {
        /// Spots along a row: 1 to 64.
        count: u32,
    },
}

impl Default for ByNoise {
    fn default() -> Self {
        Self { cells: 3, amounts: Amounts::default() }
    }
}

impl Default for ByPattern {
    fn default() -> Self {
        Self { pattern: Pattern::Stripes { along_s: 0, along_t: 3 }, softness: 0.3, amounts: Amounts::default() }
    }
}

impl Pattern {
    /// How much of the pattern there is at a place in tile sides, 0 to 1: 1 in the middle of a stripe, a square or a spot, also at the origin.
    ///
    /// ```
    /// let stripes = pelage_strand::Pattern::Stripes { along_s: 2, along_t: 0 };
    /// assert_eq!((stripes.value(0.0, 0.3, 0.0), stripes.value(0.25, 0.3, 0.0)), (1.0, 0.0));
    /// ```
    pub fn value(&self, x: f64, y: f64, softness: f64) -> f64 {
        let wave = |periods: f64| cos(TAU * (periods - periods.floor()));
        let level = match *self {
            Self::Stripes { along_s, along_t } => wave(x * f64::from(along_s) + y * f64::from(along_t)),
            Self::Checks { count } => wave(x * f64::from(count)) * wave(y * f64::from(count)),
            Self::Dots { count } => 1.0 - nearest_spot(x * f64::from(count), y * f64::from(count)) / SPOT,
        };
        eased(level, softness)
    }

    fn validate(&self) -> Result<(), StrandError> {
        let most = 64.0;
        match *self {
            Self::Stripes { along_s, along_t } => {
                within("pattern.along_s", f64::from(along_s), 0.0, most, "stripes")?;
                within("pattern.along_t", f64::from(along_t), 0.0, most, "stripes")
            }
            Self::Checks { count } => within("pattern.count", f64::from(count), 1.0, most, "pairs of squares"),
            Self::Dots { count } => within("pattern.count", f64::from(count), 1.0, most, "spots"),
        }
    }
}

/// Radius of a spot, in steps along its row: two in a square step cover half of it.
const SPOT: f64 = 0.282_094_791_773_878_14;

/// How far the nearest spot's middle is, in steps.
fn nearest_spot(x: f64, y: f64) -> f64 {
    let off = |c: f64| c - (c + 0.5).floor();
    let (whole, half) = ([off(x), off(y)], [off(x + 0.5), off(y + 0.5)]);
    let squared = |[x, y]: [f64; 2]| x * x + y * y;
    squared(whole).min(squared(half)).sqrt()
}

/// From 0 to 1 as a level goes through 0, over a width of twice the softness.
fn eased(level: f64, softness: f64) -> f64 {
    if level.abs() >= softness {
        return if level >= 0.0 { 1.0 } else { 0.0 };
    }
    let part = 0.5 + 0.5 * level / softness;
    part * part * (3.0 - 2.0 * part)
}

impl Amounts {
    fn validate(&self, names: [&'static str; 5]) -> Result<(), StrandError> {
        let values = [self.length, self.thickness, self.colour, self.tip, self.bend];
        let most = [0.95, 0.95, 1.0, 1.0, 1.0];
        (0..5).try_for_each(|k| within(names[k], values[k], 0.0, most[k], "of 1"))
    }

    /// What is left where there is so much of each quantity's noise or pattern.
    fn left(&self, there: [f64; 5]) -> Factors {
        Factors {
            length: 1.0 - self.length * there[0],
            thickness: 1.0 - self.thickness * there[1],
            colour: 1.0 - self.colour * there[2],
            tip: 1.0 - self.tip * there[3],
            bend: 1.0 - self.bend * there[4],
        }
    }
}

/// What a place makes of each quantity of a hair that stands there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Factors {
    pub(crate) length: f64,
    pub(crate) thickness: f64,
    pub(crate) colour: f64,
    pub(crate) tip: f64,
    pub(crate) bend: f64,
}

/// Noise and pattern of one tile.
#[derive(Clone, Copy)]
pub(crate) struct Places {
    noises: [TileNoise; 5],
    by_noise: ByNoise,
    by_pattern: ByPattern,
}

impl Places {
    pub(crate) fn new(seed: u64, by_noise: ByNoise, by_pattern: ByPattern) -> Self {
        let noise = |quantity: u64| TileNoise::new(mix(mix(seed ^ Purpose::Places as u64) ^ quantity), by_noise.cells);
        Self { noises: [0, 1, 2, 3, 4].map(noise), by_noise, by_pattern }
    }

    pub(crate) fn at(&self, x: f64, y: f64) -> Factors {
        let noisy = self.by_noise.amounts.left(self.noises.map(|noise| (0.5 + noise.value(x, y, 0.5)).clamp(0.0, 1.0)));
        let pattern = self.by_pattern.pattern.value(x, y, self.by_pattern.softness);
        let patterned = self.by_pattern.amounts.left([pattern; 5]);
        Factors {
            length: noisy.length * patterned.length,
            thickness: noisy.thickness * patterned.thickness,
            colour: noisy.colour * patterned.colour,
            tip: noisy.tip * patterned.tip,
            bend: noisy.bend * patterned.bend,
        }
    }
}

pub(crate) fn validate(by_noise: &ByNoise, by_pattern: &ByPattern) -> Result<(), StrandError> {
    within("by_noise.cells", f64::from(by_noise.cells), 1.0, 64.0, "cells a tile side")?;
    by_noise.amounts.validate(["by_noise.length", "by_noise.thickness", "by_noise.colour", "by_noise.tip", "by_noise.bend"])?;
    by_pattern.pattern.validate()?;
    within("by_pattern.softness", by_pattern.softness, 0.0, 1.0, "of 1")?;
    by_pattern.amounts.validate(["by_pattern.length", "by_pattern.thickness", "by_pattern.colour", "by_pattern.tip", "by_pattern.bend"])
}
