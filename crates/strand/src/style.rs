//! The shape of a hair around the way it grows (K7).

use glam::DVec3;
use libm::{asin, cos, sin};
use std::f64::consts::{FRAC_2_PI, TAU};

use crate::error::{StrandError, within};
use crate::noise::TileNoise;
use crate::seed::{Purpose, mix};
use crate::traits::Traits;

/// The shape that every hair follows around the way it grows (K7). How far aside is a fraction of the box's height, so that a style looks the same at every
/// height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Style {
    /// No shape of its own.
    Straight,
    /// A sine to one side and back.
    Wavy {
        /// How far to either side, in heights: 0 to 1.
        amplitude: f64,
        /// Periods from root to tip: 0 to 64.
        waves: f64,
    },
    /// A helix, half of the hairs each way round, neighbours nearly in step.
    Curly {
        /// Of the helix, in heights: 0 to 1.
        radius: f64,
        /// From root to tip: 0 to 64.
        turns: f64,
    },
    /// A triangle wave: straight runs and sharp bends.
    Zigzag {
        /// How far to either side, in heights: 0 to 1.
        amplitude: f64,
        /// Periods from root to tip: 0 to 64.
        waves: f64,
    },
    /// A helix that changes its sense once on the way, as crimped wool does, each hair out of step with its neighbours.
    Woolly {
        /// Of the helix, in heights: 0 to 1.
        radius: f64,
        /// From root to tip, both ways together: 0 to 64.
        turns: f64,
        /// How much radius and pace differ along a hair: 0 (a regular helix) to 1.
        irregularity: f64,
    },
}

impl Style {
    pub(crate) fn validate(&self) -> Result<(), StrandError> {
        let (names, reach, periods) = match *self {
            Self::Straight => return Ok(()),
            Self::Wavy { amplitude, waves } => (["style.amplitude", "style.waves"], amplitude, waves),
            Self::Curly { radius, turns } => (["style.radius", "style.turns"], radius, turns),
            Self::Zigzag { amplitude, waves } => (["style.amplitude", "style.waves"], amplitude, waves),
            Self::Woolly { radius, turns, irregularity } => {
                within("style.irregularity", irregularity, 0.0, 1.0, "of 1")?;
                (["style.radius", "style.turns"], radius, turns)
            }
        };
        within(names[0], reach, 0.0, 1.0, "heights")?;
        within(names[1], periods, 0.0, 64.0, "periods")
    }
}

/// A style in one tile: what is worked out once for all hairs.
#[derive(Clone, Copy)]
pub(crate) struct Shape {
    style: Style,
    /// How high the box is, in tile sides: what the style's fractions are of.
    height: f64,
    /// What makes wool irregular.
    wool: TileNoise,
}

impl Shape {
    pub(crate) fn new(style: Style, height: f64, seed: u64) -> Self {
        Self { style, height, wool: TileNoise::new(mix(seed ^ Purpose::Wool as u64), 1) }
    }

    /// Where the hair is beside its guide at a time in [0, 1], in tile sides; zero at the root.
    pub(crate) fn at(&self, traits: &Traits, heading: DVec3, side: DVec3, time: f64) -> DVec3 {
        let turned = |periods: f64| traits.phase + TAU * periods * time;
        match self.style {
            Style::Straight => DVec3::ZERO,
            Style::Wavy { amplitude, waves } => side * (amplitude * self.height * (sin(turned(waves)) - sin(traits.phase))),
            Style::Zigzag { amplitude, waves } => side * (amplitude * self.height * (triangle(turned(waves)) - triangle(traits.phase))),
            Style::Curly { radius, turns } => {
                let other = heading.cross(side) * traits.hand;
                let angle = turned(turns);
                (side * (cos(angle) - cos(traits.phase)) + other * (sin(angle) - sin(traits.phase))) * (radius * self.height)
            }
            Style::Woolly { radius, turns, irregularity } => {
                let other = heading.cross(side) * traits.hand;
                let [root, here] = [0.0, time].map(|time| self.wound(traits, turns, irregularity, time));
                (side * (here[0] - root[0]) + other * (here[1] - root[1])) * (radius * self.height)
            }
        }
    }

    /// Where wool is on its helix, whose mean radius is 1.
    fn wound(&self, traits: &Traits, turns: f64, irregularity: f64, time: f64) -> [f64; 2] {
        // Forth, and from the reversal on back.
        let way = if time < traits.reversal { time } else { 2.0 * traits.reversal - time };
        let [wider, faster] = self.wool.sideways(0.37, 0.71, traits.own_noise + WOOL_PACE * time);
        let angle = traits.phase + TAU * (turns * way + 0.5 * irregularity * faster);
        let radius = 1.0 + irregularity * wider;
        [radius * cos(angle), radius * sin(angle)]
    }
}

/// Cells of noise from a woolly hair's root to its tip.
const WOOL_PACE: f64 = 4.0;

/// The triangle wave that meets the sine at its zeros and peaks.
fn triangle(angle: f64) -> f64 {
    FRAC_2_PI * asin(sin(angle).clamp(-1.0, 1.0))
}
