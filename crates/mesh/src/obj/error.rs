//! What is wrong with an OBJ file, where, and how to mend it.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::RepairError;

/// An OBJ file that gives no mesh, even mended. It displays as `file, line: what is wrong; how to mend it`.
#[derive(Debug)]
pub struct ObjError {
    /// The file, if it came from one.
    pub path: Option<PathBuf>,
    /// The line, from 1, if the fault has a place.
    pub line: Option<usize>,
    /// What is wrong.
    pub fault: ObjFault,
}

/// What is wrong with an OBJ file. Vertices are numbered from 1, as in the file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ObjFault {
    /// The file cannot be opened or read.
    #[error("the file cannot be read: {0}")]
    Unreadable(std::io::Error),
    /// There is no face.
    #[error("no face (a line like `f 1 2 3`) was found, so there is no surface; is it an OBJ file?")]
    NoFaces,
    /// It is text of two bytes a character.
    #[error("the text is UTF-16, and an OBJ file has one byte a letter; save it as UTF-8 or plain text")]
    Utf16,
    /// There is no face, and there are bytes that no text has.
    #[error("the file is binary, and no face (a line like `f 1 2 3`) was found; export the model as Wavefront OBJ")]
    Binary,
    /// A `v` line is not three numbers.
    #[error("a vertex needs three numbers, like `v 0.5 1 -2`")]
    BadVertex,
    /// A vertex has a colour that is no finite number.
    #[error("vertex {vertex} has a colour that is NaN, infinite or too large; mend the number")]
    ColourNotFinite {
        /// The vertex.
        vertex: u32,
    },
    /// A `vt` line is not two numbers.
    #[error("texture coordinates need two numbers, like `vt 0.5 1`")]
    BadTextureCoordinates,
    /// An `f` line is not indices.
    #[error("a face needs corners like `1`, `1/2`, `1//3` or `1/2/3`, each number whole and not 0")]
    BadFace,
    /// An index has more digits than any file has vertices.
    #[error("an index of {digits} digits is larger than any file has vertices; mend the number")]
    IndexTooLarge {
        /// How many digits it has.
        digits: usize,
    },
    /// A face names a vertex that is not there.
    #[error("the face names vertex {index}, but the file has {count}; indices start at 1, or at -1 from the last line back")]
    VertexOutOfRange {
        /// What the face says.
        index: i64,
        /// How many vertices there are.
        count: usize,
    },
    /// A face names texture coordinates that are not there.
    #[error("the face names texture coordinates {index}, but the file has {count}; add them or remove the index")]
    CoordinatesOutOfRange {
        /// What the face says.
        index: i64,
        /// How many pairs of texture coordinates there are.
        count: usize,
    },
    /// A coordinate that is no finite number.
    #[error("vertex {vertex} has a coordinate that is NaN, infinite or too large; mend the number")]
    NotFinite {
        /// The vertex.
        vertex: u32,
    },
    /// A texture coordinate that is no finite number.
    #[error("the face uses texture coordinates that are NaN, infinite or too large; mend the number")]
    CoordinateNotFinite,
    /// The faces give no surface.
    #[error(transparent)]
    Repair(RepairError),
}

impl ObjError {
    /// A fault of the file as a whole.
    pub(super) fn whole(fault: ObjFault) -> Self {
        Self { path: None, line: None, fault }
    }

    /// A fault with a place.
    pub(super) fn at(line: usize, fault: ObjFault) -> Self {
        Self { path: None, line: Some(line), fault }
    }

    pub(super) fn in_file(self, path: &Path) -> Self {
        Self { path: Some(path.to_owned()), ..self }
    }
}

impl fmt::Display for ObjError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.path, self.line) {
            (Some(path), Some(line)) => write!(f, "{}, line {line}: ", path.display())?,
            (Some(path), None) => write!(f, "{}: ", path.display())?,
            (None, Some(line)) => write!(f, "line {line}: ")?,
            (None, None) => {}
        }
        self.fault.fmt(f)
    }
}

impl std::error::Error for ObjError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.fault {
            ObjFault::Unreadable(error) => Some(error),
            ObjFault::Repair(error) => Some(error),
            _ => None,
        }
    }
}
