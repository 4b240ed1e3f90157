//! What kinds of hair there are, as a file says it.

use pelage_graph::{Colour, NodeError, Param};
use pelage_strand::{Amounts, Bands, ByNoise, ByPattern, Curve, Gather, Offset, Opacity, Pattern, Stop, Style, Taper};

use crate::shading::linear;

/// The shape that every hair follows around the way it grows. How far aside is a fraction of the box's height.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum HairStyle {
    /// No shape of its own.
    Straight,
    /// A sine to one side and back.
    Wavy {
        /// How far to either side.
        #[param(default = 0.008 / 0.35, range = 0.0..=1.0, unit = "heights", effect = "wider waves")]
        amplitude: f64,
        /// Periods from root to tip.
        #[param(default = 1.2, range = 0.0..=64.0, unit = "periods", effect = "finer waves; give at least 8 steps to each")]
        waves: f64,
    },
    /// A helix, neighbours nearly in step.
    Curly {
        /// Its radius.
        #[param(default = 0.06, range = 0.0..=1.0, unit = "heights", effect = "wider curls")]
        radius: f64,
        /// From root to tip.
        #[param(default = 2.0, range = 0.0..=64.0, unit = "turns", effect = "finer curls; give at least 8 steps to each")]
        turns: f64,
    },
    /// A triangle wave.
    Zigzag {
        /// How far to either side.
        #[param(default = 0.04, range = 0.0..=1.0, unit = "heights", effect = "wider bends")]
        amplitude: f64,
        /// Periods from root to tip.
        #[param(default = 3.0, range = 0.0..=64.0, unit = "periods", effect = "finer bends; give at least 8 steps to each")]
        waves: f64,
    },
    /// A helix that changes its sense on the way, each hair out of step with its neighbours.
    Woolly {
        /// Its mean radius.
        #[param(default = 0.1, range = 0.0..=1.0, unit = "heights", effect = "thicker wool")]
        radius: f64,
        /// From root to tip, both ways together.
        #[param(default = 3.0, range = 0.0..=64.0, unit = "turns", effect = "finer wool; give at least 8 steps to each")]
        turns: f64,
        /// How much radius and pace differ along a hair.
        #[param(default = 0.7, range = 0.0..=1.0, unit = "fraction", effect = "0 is a regular helix, larger more tangled")]
        irregularity: f64,
    },
}

impl From<&HairStyle> for Style {
    fn from(style: &HairStyle) -> Self {
        match *style {
            HairStyle::Straight => Self::Straight,
            HairStyle::Wavy { amplitude, waves } => Self::Wavy { amplitude, waves },
            HairStyle::Curly { radius, turns } => Self::Curly { radius, turns },
            HairStyle::Zigzag { amplitude, waves } => Self::Zigzag { amplitude, waves },
            HairStyle::Woolly { radius, turns, irregularity } => Self::Woolly { radius, turns, irregularity },
        }
    }
}

/// How hairs lie in locks, beside their style: any style may be clumpy or spiky.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum HairGather {
    /// Not gathered.
    Free,
    /// Tufts: each hair goes its own part of the way to the middle of its lock, and each lock its own way aside.
    Clumpy {
        /// How far tips go at most, of the way to the middle.
        #[param(default = 0.8, range = 0.0..=1.0, unit = "fraction", effect = "denser tufts, wider gaps")]
        strength: f64,
        /// How far tufts go aside.
        #[param(default = 0.1, range = 0.0..=1.0, unit = "heights", effect = "messier")]
        mess: f64,
        /// How both grow along the hair.
        #[param(default = HairOffset::Power { exponent: 1.5 })]
        offset: HairOffset,
    },
    /// Spikes: every tip goes the same part of the way, and hairs are the shorter the nearer to the rim, so that a lock is a cone.
    Spiky {
        /// How far tips go, of the way to the middle.
        #[param(default = 0.95, range = 0.0..=1.0, unit = "fraction", effect = "sharper spikes; at 1 all tips of a lock meet")]
        strength: f64,
        /// How it grows along the hair.
        #[param(default = HairOffset::Power { exponent: 1.0 })]
        offset: HairOffset,
    },
}

impl From<&HairGather> for Gather {
    fn from(gather: &HairGather) -> Self {
        match gather {
            HairGather::Free => Self::Free,
            HairGather::Clumpy { strength, mess, offset } => Self::Clumpy { strength: *strength, mess: *mess, offset: offset.into() },
            HairGather::Spiky { strength, offset } => Self::Spiky { strength: *strength, offset: offset.into() },
        }
    }
}

/// How an offset grows from nothing at the root to all of it at the tip (K8).
#[derive(Clone, Debug, PartialEq, Param)]
pub enum HairOffset {
    /// (1 - cos pi x)/2: neither root nor tip is bent.
    Sine,
    /// (e^(r x) - 1)/(e^r - 1).
    Exponential {
        /// The rate.
        #[param(default = 2.0, range = -8.0..=8.0, unit = "rate", effect = "above 0 hair bends at its tip, below 0 at its root")]
        rate: f64,
    },
    /// x^p.
    Power {
        /// The exponent.
        #[param(default = 1.5, range = 0.1..=10.0, unit = "exponent", effect = "above 1 hair bends at its tip, below 1 at its root")]
        exponent: f64,
    },
}

impl From<&HairOffset> for Offset {
    fn from(offset: &HairOffset) -> Self {
        match *offset {
            HairOffset::Sine => Self::Sine,
            HairOffset::Exponential { rate } => Self::Exponential { rate },
            HairOffset::Power { exponent } => Self::Power { exponent },
        }
    }
}

/// How a hair's radius goes from its root to its tip (K6).
#[derive(Clone, Debug, PartialEq, Param)]
pub enum HairTaper {
    /// As thick at the tip as at the root.
    Fixed,
    /// A cone.
    Linear,
    /// By a power of the way.
    Power {
        /// The exponent.
        #[param(default = 2.0, range = 0.1..=10.0, unit = "exponent", effect = "1 is a cone, larger keeps its thickness longer")]
        exponent: f64,
    },
    /// Exponentially.
    Exponential {
        /// The rate.
        #[param(default = 2.0, range = -8.0..=8.0, unit = "rate", effect = "above 0 it thins at first, below 0 at last")]
        rate: f64,
    },
    /// By values of its own at even steps from root to tip, at most 16; the tip's thickness is the last of them.
    Curve {
        /// The radii.
        #[param(default = vec![0.6, 1.0, 0.9, 0.0], range = 0.0..=4.0, unit = "radii at the root", effect = "any profile: a spindle, beads")]
        values: Vec<f64>,
    },
}

impl TryFrom<&HairTaper> for Taper {
    type Error = NodeError;

    fn try_from(taper: &HairTaper) -> Result<Self, NodeError> {
        Ok(match taper {
            HairTaper::Fixed => Self::Fixed,
            HairTaper::Linear => Self::Linear,
            HairTaper::Power { exponent } => Self::Power { exponent: *exponent },
            HairTaper::Exponential { rate } => Self::Exponential { rate: *rate },
            HairTaper::Curve { values } => Self::Curve(Curve::new(values)?),
        })
    }
}

/// A colour at a place along the hair.
#[derive(Clone, Debug, PartialEq, Param)]
pub struct HairBand {
    /// The place, 0 at the root, 1 at the tip.
    #[param(default = 0.0, range = 0.0..=1.0, unit = "fraction of the hair", effect = "moves the band")]
    pub along: f64,
    /// The colour there.
    #[param(default = Colour([0.5, 0.5, 0.5]))]
    pub colour: Colour,
}

/// The bands of a list of colours.
pub(super) fn bands(list: &[HairBand]) -> Result<Bands, NodeError> {
    let stop = |band: &HairBand| Stop { along: band.along as f32, colour: linear(band.colour).to_array() };
    Ok(Bands::new(&list.iter().map(stop).collect::<Vec<_>>())?)
}

/// How opaque hairs are, by hair and from root to tip (K9).
#[derive(Clone, Debug, PartialEq, Param)]
pub struct HairOpacity {
    /// At the root.
    #[param(default = 1.0, range = 0.0..=1.0, unit = "fraction", effect = "lower: skin and undercoat show through")]
    pub root: f64,
    /// At the tip.
    #[param(default = 1.0, range = 0.0..=1.0, unit = "fraction", effect = "lower: a softer silhouette")]
    pub tip: f64,
    /// How much less opaque hairs may be, constant along each.
    #[param(default = 0.0, range = 0.0..=1.0, unit = "fraction", effect = "larger: uneven density")]
    pub variation: f64,
}

impl HairOpacity {
    pub(super) const WHOLE: Self = Self { root: 1.0, tip: 1.0, variation: 0.0 };
}

impl From<&HairOpacity> for Opacity {
    fn from(&HairOpacity { root, tip, variation }: &HairOpacity) -> Self {
        Self { root, tip, variation }
    }
}

/// What smooth noise over the tile takes away, where it is at its most; another noise for each quantity (K6).
#[derive(Clone, Debug, PartialEq, Param)]
pub struct HairNoise {
    /// Cells of noise along a tile side.
    #[param(default = 3, range = 1..=64, unit = "cells a tile side", effect = "finer patches")]
    pub cells: u32,
    /// Of the length.
    #[param(default = 0.0, range = 0.0..=0.95, unit = "fraction", effect = "uneven height")]
    pub length: f64,
    /// Of the thickness.
    #[param(default = 0.0, range = 0.0..=0.95, unit = "fraction", effect = "thinner in places")]
    pub thickness: f64,
    /// Of the brightness.
    #[param(default = 0.0, range = 0.0..=1.0, unit = "fraction", effect = "darker in places")]
    pub colour: f64,
    /// Of the tip's thickness.
    #[param(default = 0.0, range = 0.0..=1.0, unit = "fraction", effect = "finer tips in places")]
    pub tip: f64,
    /// Of lean and gravity.
    #[param(default = 0.0, range = 0.0..=1.0, unit = "fraction", effect = "more upright in places")]
    pub bend: f64,
}

impl HairNoise {
    pub(super) const NONE: Self = Self { cells: 3, length: 0.0, thickness: 0.0, colour: 0.0, tip: 0.0, bend: 0.0 };
}

impl From<&HairNoise> for ByNoise {
    fn from(&HairNoise { cells, length, thickness, colour, tip, bend }: &HairNoise) -> Self {
        Self { cells, amounts: Amounts { length, thickness, colour, tip, bend } }
    }
}

/// A pattern that repeats with the tile.
#[derive(Clone, Debug, PartialEq, Param)]
pub enum TilePattern {
    /// Straight stripes, as wide as the gaps between them.
    Stripes {
        /// How many are met across the way the fur lies.
        #[param(default = 0, range = 0..=64, unit = "stripes", effect = "finer; with both they run aslant")]
        along_s: u32,
        /// How many are met along the way the fur lies.
        #[param(default = 3, range = 0..=64, unit = "stripes", effect = "finer; with both they run aslant")]
        along_t: u32,
    },
    /// A chessboard.
    Checks {
        /// Pairs of squares along a tile side.
        #[param(default = 2, range = 1..=64, unit = "pairs of squares", effect = "finer")]
        count: u32,
    },
    /// Round spots, every row half a step beside the one before, half of the tile in all.
    Dots {
        /// Spots along a row.
        #[param(default = 2, range = 1..=64, unit = "spots", effect = "finer")]
        count: u32,
    },
}

/// What a pattern over the tile takes away, where it is at its most; the same for each quantity (K6).
#[derive(Clone, Debug, PartialEq, Param)]
pub struct HairPattern {
    /// Its shape.
    #[param(default = TilePattern::Stripes { along_s: 0, along_t: 3 })]
    pub pattern: TilePattern,
    /// How wide its edges are.
    #[param(default = 0.3, range = 0.0..=1.0, unit = "fraction", effect = "0 is sharp, 1 a sine")]
    pub softness: f64,
    /// Of the length.
    #[param(default = 0.0, range = 0.0..=0.95, unit = "fraction", effect = "shorter inside the pattern")]
    pub length: f64,
    /// Of the thickness.
    #[param(default = 0.0, range = 0.0..=0.95, unit = "fraction", effect = "thinner inside the pattern")]
    pub thickness: f64,
    /// Of the brightness.
    #[param(default = 0.0, range = 0.0..=1.0, unit = "fraction", effect = "darker inside the pattern")]
    pub colour: f64,
    /// Of the tip's thickness.
    #[param(default = 0.0, range = 0.0..=1.0, unit = "fraction", effect = "finer tips inside the pattern")]
    pub tip: f64,
    /// Of lean and gravity.
    #[param(default = 0.0, range = 0.0..=1.0, unit = "fraction", effect = "more upright inside the pattern")]
    pub bend: f64,
}

impl HairPattern {
    pub(super) const NONE: Self = Self {
        pattern: TilePattern::Stripes { along_s: 0, along_t: 3 },
        softness: 0.3,
        length: 0.0,
        thickness: 0.0,
        colour: 0.0,
        tip: 0.0,
        bend: 0.0,
    };
}

impl From<&HairPattern> for ByPattern {
    fn from(HairPattern { pattern, softness, length, thickness, colour, tip, bend }: &HairPattern) -> Self {
        let pattern = match *pattern {
            TilePattern::Stripes { along_s, along_t } => Pattern::Stripes { along_s, along_t },
            TilePattern::Checks { count } => Pattern::Checks { count },
            TilePattern::Dots { count } => Pattern::Dots { count },
        };
        let amounts = Amounts { length: *length, thickness: *thickness, colour: *colour, tip: *tip, bend: *bend };
        Self { pattern, softness: *softness, amounts }
    }
}
