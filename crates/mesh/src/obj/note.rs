//! What a reader of a file should know, though nothing had to be mended.

use std::fmt;

use glam::DVec3;

use crate::WELD_TOLERANCE;

/// Something about an OBJ file that was left out.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Note {
    /// Faces name texture coordinates and the file has none.
    NoTextureCoordinates,
    /// The file has texture coordinates, but not for every corner: the mesh has none.
    CornersWithoutTextureCoordinates {
        /// Corners without.
        corners: usize,
    },
    /// The file has colours, but not for every vertex: the mesh has none.
    VerticesWithoutColour {
        /// Vertices without.
        vertices: usize,
    },
    /// Colours outside 0 to 1, brought to the nearer end.
    ColoursOutOfRange {
        /// Vertices with such a colour.
        vertices: usize,
    },
    /// Statements that this reader does not know, such as free-form curves.
    UnknownStatements {
        /// How many.
        count: usize,
        /// The line of the first.
        line: usize,
        /// Its first word, as far as it can be shown.
        first: String,
    },
    /// The model lies so far from the origin, or is so small, that a step of its coordinates is more than [`WELD_TOLERANCE`] of its longest side: what was finer
    /// is lost.
    CoarseCoordinates {
        /// How many decimal digits of that side they hold, rounded down.
        digits: u32,
    },
}

impl Note {
    /// [`Note::CoarseCoordinates`], if those of the vertices of a surface are.
    pub(super) fn coarse(positions: &[DVec3]) -> Option<Self> {
        let (low, high) = positions.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
        let farthest = low.abs().max(high.abs()).max_element();
        // Halved first, as the whole may be too large for f64; below its normal range f64 has steps of one size.
        let step = 0.5 * f64::EPSILON * farthest.max(f64::MIN_POSITIVE) / (0.5 * high - 0.5 * low).max_element();
        (step > WELD_TOLERANCE).then(|| Self::CoarseCoordinates { digits: (-step.log10()).floor().max(0.0) as u32 })
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoTextureCoordinates => f.write_str("faces name texture coordinates, but the file has none (`vt`): left out"),
            Self::CornersWithoutTextureCoordinates { corners } => {
                write!(f, "corners of faces without texture coordinates: {corners}; those of the others are left out")
            }
            Self::VerticesWithoutColour { vertices } => {
                write!(f, "vertices without a colour: {vertices}; the colours of the others are left out")
            }
            Self::ColoursOutOfRange { vertices } => {
                write!(f, "vertices with a colour outside 0 to 1: {vertices}; brought to the nearer end")
            }
            Self::UnknownStatements { count, line, first } => {
                write!(f, "statements of unknown kinds passed over: {count}, the first in line {line}: `{first}`")
            }
            Self::CoarseCoordinates { digits } => {
                write!(
                    f,
                    "coordinates hold {digits} digits of the model's longest side, and finer shapes are lost: move it to the origin, or scale it up, \
                     in the program that made it"
                )
            }
        }
    }
}
