//! What can be wrong with a scene or with how it is looked at.

use pelage_coat::CoatError;

/// Most segments of a scene: 10 GB of them.
pub const MOST_SEGMENTS: usize = 1 << 26;

/// Coordinates of skin and fur may be this large, in diameters; an ordinary coat stays within one.
pub const FARTHEST: f64 = 1e6;

/// A face may be this large, in tiles of hair.
pub const MOST_TILES: f64 = 1e6;

/// Why there is no scene, or no picture of it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReferenceError {
    /// The coat's arrays do not agree.
    #[error(transparent)]
    Coat(#[from] CoatError),
    /// The hair's box has no height to measure heights by.
    #[error("the hair's box is {height} tile sides high; give it a finite, positive height")]
    NoHeight {
        /// Its height.
        height: f64,
    },
    /// A strand with a straight piece too long for its tile.
    #[error("strand {strand} crosses {tiles:.0} tiles in one straight piece; at most {limit} can be laid: give it more points")]
    LongStrand {
        /// Of the tile.
        strand: usize,
        /// Tiles that the box around the piece covers.
        tiles: f64,
        /// As many as may be.
        limit: f64,
    },
    /// A number is not one, or out of its range.
    #[error("{name} is {value}, but must be {low} to {high} {unit}")]
    OutOfRange {
        /// The field.
        name: &'static str,
        /// What it is.
        value: f64,
        /// The least.
        low: f64,
        /// The most.
        high: f64,
        /// What it counts.
        unit: &'static str,
    },
    /// Skin or fur is further away than makes sense.
    #[error("vertex {vertex} or its fur is further than {FARTHEST} diameters from the origin; coat coordinates have a diameter of 1")]
    TooFar {
        /// Of the surface.
        vertex: usize,
    },
    /// A face holds more hair than can be laid.
    #[error("face {face} spans {tiles:.0} tiles of hair; at most {MOST_TILES} are laid: make the tile larger on the surface")]
    TooManyTiles {
        /// Of the patches.
        face: usize,
        /// How many.
        tiles: f64,
    },
    /// More hair than memory.
    #[error("the coat has more than {limit} segments of hair; use fewer strands, a larger tile, or a coarser tolerance")]
    TooManySegments {
        /// [`MOST_SEGMENTS`].
        limit: usize,
    },
    /// A camera that sees nothing.
    #[error("the camera is not one: {what}")]
    Camera {
        /// What is wrong, and what is needed.
        what: &'static str,
    },
    /// A light that is not one.
    #[error("light {light} is not one: its direction must be finite and have a length, its colour be finite")]
    Light {
        /// Which of the lights at infinity.
        light: usize,
    },
    /// The caller asked to stop.
    #[error("cancelled")]
    Cancelled,
}

/// Refuses NaN too, as no comparison with it holds.
pub(crate) fn within(name: &'static str, value: f64, low: f64, high: f64, unit: &'static str) -> Result<(), ReferenceError> {
    if value >= low && value <= high { Ok(()) } else { Err(ReferenceError::OutOfRange { name, value, low, high, unit }) }
}
