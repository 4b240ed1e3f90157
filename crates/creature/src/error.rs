//! What can be wrong with what is asked for.

use std::ops::RangeInclusive;

use pelage_mesh::MeshError;

/// Why there is no such creature.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CreatureError {
    /// A number of the plan, or of the settings, is outside its range or not finite.
    #[error("{name} is {value}; give a number from {} to {}", .range.start(), .range.end())]
    OutOfRange {
        /// Which: `ears.length`.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it may be.
        range: RangeInclusive<f64>,
    },
    /// Parts of the plan touch and enclose a hole, as a tail does that curls back to the rump: fur could not be laid as on a ball.
    #[error(
        "parts of the creature touch: its skin has {handles} handles and {pieces} pieces; \
         give a straighter or thinner tail, thinner legs or ears, or a wider gap between the feet"
    )]
    Fused {
        /// Handles of the surface: 0 for a creature whose parts only touch where they grow.
        handles: usize,
        /// Separate pieces of surface: 1 for a whole creature.
        pieces: usize,
    },
    /// So few faces that the thinnest parts would lose their shape.
    #[error("{asked} faces are too few: no fewer than {reached} keep every part of this creature; ask for more, or leave out thin parts")]
    TooCoarse {
        /// What was asked for.
        asked: u32,
        /// How far it went.
        reached: u32,
    },
    /// The faces do not make a mesh: a fault of this crate.
    #[error("the creature is no mesh: {0}; please report this")]
    Mesh(#[from] MeshError),
}

/// Refuses what is outside a range, NaN included.
pub(crate) fn check(name: &'static str, value: f64, range: RangeInclusive<f64>) -> Result<(), CreatureError> {
    if range.contains(&value) { Ok(()) } else { Err(CreatureError::OutOfRange { name, value, range }) }
}
