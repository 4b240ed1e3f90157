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
    /// A list has too few or too many entries.
    #[error("{name} has {length} entries, but must have {least} to {most}: {}", if length < least { "add some" } else { "leave some out" })]
    ListLength {
        /// The list's field name.
        name: &'static str,
        /// How many entries it has.
        length: usize,
        /// Fewest allowed.
        least: usize,
        /// Most allowed.
        most: usize,
    },
    /// Two guide hairs stand in one place of the tile, so that hair there could not follow both.
    #[error("guides {first} and {second} have the same root, give or take whole tiles: move one or leave it out")]
    GuidesMeet {
        /// Index of one in the order given.
        first: usize,
        /// Index of the other.
        second: usize,
    },
    /// A guide hair holds NaN, an infinity, or a point under the skin or too far away.
    #[error(
        "guide {guide} is not usable at point {point}: coordinates must be finite, at most {limit} heights from the root, and not under the skin"
    )]
    BadGuide {
        /// Index of the guide in the order given.
        guide: usize,
        /// Index of the point along it, 0 for the root.
        point: usize,
        /// How far a point may be, in heights.
        limit: f64,
    },
    /// More hairs were asked for than one tile may hold.
    #[error("{asked} strands were asked for, but a tile holds at most {limit}: lower `count`, `undercoat.count` or what is mixed in")]
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

/// Refuses NaN too, as no comparison with it holds.
pub(crate) fn within(name: &'static str, value: f64, low: f64, high: f64, unit: &'static str) -> Result<(), StrandError> {
    if value >= low && value <= high { Ok(()) } else { Err(StrandError::OutOfRange { name, value, low, high, unit }) }
}
