//! Why no texture was made.

use thiserror::Error;

/// Every variant names what to change.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum VolumeError {
    /// A setting is not a number or lies outside its range.
    #[error("{name} is {value} {unit}, but must lie between {low} and {high}: set it inside that range")]
    OutOfRange {
        /// The setting's field name.
        name: &'static str,
        /// What was asked for.
        value: f64,
        /// Smallest allowed value.
        low: f64,
        /// Largest allowed value.
        high: f64,
        /// What the value counts.
        unit: &'static str,
    },
    /// A side that mips halve evenly was wanted.
    #[error("{name} is {value} texels, but must be a power of two so that each mip is half the one before: try {nearest}")]
    NotPowerOfTwo {
        /// The setting's field name.
        name: &'static str,
        /// What was asked for.
        value: u32,
        /// The next power of two.
        nearest: u32,
    },
    /// The stack would not fit the bound on working memory.
    #[error("{asked} texels in all layers were asked for, but at most {limit} are sampled at once: lower `layers` or `resolution`")]
    TooManyTexels {
        /// Layers × resolution².
        asked: u64,
        /// The bound, [`crate::MAX_TEXELS`].
        limit: u64,
    },
    /// One hair runs on for so long that its window would not fit the bound on working memory.
    #[error(
        "strand {strand} spans a window of {asked:.3e} texels, but at most {limit} are sampled for one: shorten the strand or lower the resolution"
    )]
    StrandTooWide {
        /// Its number in the tile.
        strand: usize,
        /// Texels of its window.
        asked: f64,
        /// The bound, [`crate::MAX_TEXELS`].
        limit: u64,
    },
    /// A stack that is only a skin, or nothing, where hair above it is needed.
    #[error("the stack has no shell above its skin: give it at least two layers")]
    NoHairShells,
    /// Pixels that are not an image.
    #[error("{width} × {height} pixels need {expected} bytes of RGBA, and at least one pixel; {length} bytes were given")]
    Pixels {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Bytes needed.
        expected: u64,
        /// Bytes there.
        length: u64,
    },
    /// The box of hair has no height, so there is nowhere to put layers.
    #[error("the hair's box is {height} tile sides high: its height must be positive and finite")]
    NoHeight {
        /// The tile's height.
        height: f64,
    },
}

/// Refuses NaN too, as no comparison with it holds.
pub(crate) fn within(name: &'static str, value: f64, low: f64, high: f64, unit: &'static str) -> Result<(), VolumeError> {
    if value >= low && value <= high { Ok(()) } else { Err(VolumeError::OutOfRange { name, value, low, high, unit }) }
}

/// Refuses sides that do not halve down to one.
pub(crate) fn power_of_two(name: &'static str, value: u32, high: u32) -> Result<(), VolumeError> {
    within(name, f64::from(value), 1.0, f64::from(high), "texels")?;
    if value.is_power_of_two() { Ok(()) } else { Err(VolumeError::NotPowerOfTwo { name, value, nearest: value.next_power_of_two() }) }
}
