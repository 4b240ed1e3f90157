//! What can be wrong with settings or with hand-made strands.

use thiserror::Error;

/// Why no tile was made; every variant names what to change.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StrandError {
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
    /// More hairs were asked for than one tile may hold.
    #[error("{asked} strands were asked for, but a tile holds at most {limit}: lower `count` or `undercoat.count`")]
    TooManyStrands {
        /// Guard hairs and undercoat together.
        asked: u64,
        /// The bound, [`crate::MAX_STRANDS`].
        limit: u64,
    },
    /// Strands times points on each passes the bound on memory.
    #[error("{asked} points were asked for, but a tile holds at most {limit}: lower `steps` or the number of strands")]
    TooManyPoints {
        /// Strands times points on each.
        asked: u64,
        /// The bound, [`crate::MAX_POINTS`].
        limit: u64,
    },
    /// A row of coats without a coat.
    #[error("a row of coats needs at least one tile of hair: give one")]
    NoTiles,
    /// A hand-made strand has too few points to be a curve.
    #[error("strand {strand} has {points} point(s), but a strand needs at least 2: add its tip or leave the strand out")]
    TooShort {
        /// Index of the strand in the order given.
        strand: usize,
        /// How many points it has.
        points: usize,
    },
    /// A hand-made strand has another number of radii than of points.
    #[error("strand {strand} has {points} points but {radii} radii: give one radius for each point")]
    RadiiMismatch {
        /// Index of the strand in the order given.
        strand: usize,
        /// How many points it has.
        points: usize,
        /// How many radii it has.
        radii: usize,
    },
    /// A hand-made strand holds NaN, an infinity, a negative radius or a place too far away to keep.
    #[error(
        "strand {strand} is not usable at point {point}: coordinates, radii and colours must be finite, radii not negative, and no place further than {limit} tiles away"
    )]
    BadPoint {
        /// Index of the strand in the order given.
        strand: usize,
        /// Index of the point along it.
        point: usize,
        /// How far away a root may lie, in tile sides.
        limit: f64,
    },
}
