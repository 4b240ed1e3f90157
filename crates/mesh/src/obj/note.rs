//! What a reader of a file should know, though nothing had to be mended.

use std::fmt;

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
    /// Statements that this reader does not know, such as free-form curves.
    UnknownStatements {
        /// How many.
        count: usize,
        /// The line of the first.
        line: usize,
        /// Its first word, as far as it can be shown.
        first: String,
    },
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoTextureCoordinates => f.write_str("faces name texture coordinates, but the file has none (`vt`): left out"),
            Self::CornersWithoutTextureCoordinates { corners } => {
                write!(f, "corners of faces without texture coordinates: {corners}; those of the others are left out")
            }
            Self::UnknownStatements { count, line, first } => {
                write!(f, "statements of unknown kinds passed over: {count}, the first in line {line}: `{first}`")
            }
        }
    }
}
