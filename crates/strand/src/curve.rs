//! Values along a hair: how thick it is, and lists of a few numbers.

use libm::{exp, pow};

use crate::error::{StrandError, within};

/// Most values of a [`Curve`].
pub const MAX_CURVE: usize = 16;

/// Values at even steps from root to tip, joined by straight lines.
///
/// ```
/// let spindle = pelage_strand::Curve::new(&[0.5, 1.0, 0.0])?;
/// assert_eq!((spindle.at(0.0), spindle.at(0.25), spindle.at(1.0)), (0.5, 0.75, 0.0));
/// # Ok::<(), pelage_strand::StrandError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve {
    values: [f64; MAX_CURVE],
    count: usize,
}

impl Curve {
    /// A curve through 1 to [`MAX_CURVE`] values, each 0 to 4.
    ///
    /// # Errors
    /// None or too many values, or one out of range.
    pub fn new(values: &[f64]) -> Result<Self, StrandError> {
        let count = values.len();
        if count == 0 || count > MAX_CURVE {
            return Err(StrandError::ListLength { name: "taper.values", length: count, least: 1, most: MAX_CURVE });
        }
        values.iter().try_for_each(|&value| within("taper.values", value, 0.0, 4.0, "radii at the root"))?;
        Ok(Self { values: std::array::from_fn(|index| values.get(index).copied().unwrap_or(0.0)), count })
    }

    /// The value a part of the way from root to tip, 0 to 1; the nearest end's beyond.
    pub fn at(&self, along: f64) -> f64 {
        let last = self.count - 1;
        let place = along.clamp(0.0, 1.0) * last as f64;
        let index = (place as usize).min(last);
        let [low, high] = [index, (index + 1).min(last)].map(|index| self.values[index]);
        low + (high - low) * (place - index as f64)
    }
}

/// How a hair's radius goes from its root to its tip (K6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Taper {
    /// As thick at the tip as at the root, whatever `tip_thickness` says.
    Fixed,
    /// A cone.
    Linear,
    /// By a power of the way.
    Power {
        /// 1 is a cone, larger keeps its thickness longer: 0.1 to 10.
        exponent: f64,
    },
    /// Exponentially.
    Exponential {
        /// Above 0 it thins at first, below 0 at last, 0 is a cone: −8 to 8.
        rate: f64,
    },
    /// By values of its own, in radii at the root; `tip_thickness` has no say.
    Curve(Curve),
}

impl Taper {
    pub(crate) fn validate(&self) -> Result<(), StrandError> {
        match *self {
            Self::Fixed | Self::Linear | Self::Curve(_) => Ok(()),
            Self::Power { exponent } => within("taper.exponent", exponent, 0.1, 10.0, "(exponent)"),
            Self::Exponential { rate } => within("taper.rate", rate, -8.0, 8.0, "(rate)"),
        }
    }

    /// Radius over that at the root a part of the way along; `tip` is that at the tip.
    pub(crate) fn at(&self, along: f64, tip: f64) -> f64 {
        // Of what the tip has less than the root, how much is left.
        let left = match *self {
            Self::Fixed => return 1.0,
            Self::Curve(curve) => return curve.at(along),
            Self::Linear => 1.0 - along,
            Self::Power { exponent } => 1.0 - pow(along, exponent),
            Self::Exponential { rate } => 1.0 - exponential(along, rate),
        };
        tip + (1.0 - tip) * left
    }
}

/// From 0 to 1, by e^(−rate x): fast at first above 0, at last below.
pub(crate) fn exponential(x: f64, rate: f64) -> f64 {
    if rate.abs() < 1e-6 { x } else { (1.0 - exp(-rate * x)) / (1.0 - exp(-rate)) }
}
