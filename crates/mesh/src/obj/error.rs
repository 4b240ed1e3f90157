//! What is wrong with an OBJ file, where, and how to mend it.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::MeshError;

/// An OBJ file that gives no mesh. It displays as `file, line: what is wrong; how to mend it`.
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
    /// A statement holds bytes that are no UTF-8.
    #[error("the line is not text; save the file as text in UTF-8")]
    NotText,
    /// A `v` line is not three numbers.
    #[error("a vertex needs three numbers, like `v 0.5 1 -2`")]
    BadVertex,
    /// A `vt` line is not two numbers.
    #[error("texture coordinates need two numbers, like `vt 0.5 1`")]
    BadTextureCoordinates,
    /// An `f` line is not indices.
    #[error("a face needs corners like `1`, `1/2`, `1//3` or `1/2/3`, each number whole and not 0")]
    BadFace,
    /// A face names a vertex that is not there.
    #[error("the face names vertex {index}, but the file has {count}; indices start at 1, or at -1 from the last line back")]
    VertexOutOfRange {
        /// What the face says.
        index: String,
        /// How many vertices there are.
        count: usize,
    },
    /// A face names texture coordinates that are not there.
    #[error("the face names texture coordinates {index}, but the file has {count}; add them or remove the index")]
    CoordinatesOutOfRange {
        /// What the face says.
        index: String,
        /// How many pairs of texture coordinates there are.
        count: usize,
    },
    /// A face with fewer than three corners.
    #[error("the face has {corners} corners; give it three or more, or remove it")]
    TooFewCorners {
        /// How many it has.
        corners: usize,
    },
    /// A face that touches a vertex twice.
    #[error("the face uses vertex {vertex} twice; remove it")]
    RepeatedVertex {
        /// The vertex.
        vertex: u32,
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
    /// Two faces run along an edge the same way.
    #[error(
        "this face and that of line {other_line} run along the edge from vertex {from} to {to} the same way; turn one of them if they \
         face opposite ways, remove one if they are the same, or give a third face at an edge vertices of its own"
    )]
    EdgeUsedTwice {
        /// Where the other face is.
        other_line: usize,
        /// Where the edge starts.
        from: u32,
        /// Where it ends.
        to: u32,
    },
    /// The surface has one side.
    #[error(
        "the surface has one side only, like a Möbius strip: however its faces are turned, some neighbours clash, such as this face and that \
         of line {other_line} at the edge between vertices {from} and {to}; cut it open along a line of edges, giving one side of the cut vertices of its own"
    )]
    NotOrientable {
        /// Where the other face is.
        other_line: usize,
        /// One end of the edge.
        from: u32,
        /// The other.
        to: u32,
    },
    /// Pieces of surface that touch at a vertex only.
    #[error("several pieces of surface touch at vertex {vertex} only; give each a vertex of its own")]
    NonManifoldVertex {
        /// The vertex.
        vertex: u32,
    },
    /// Any other reason why the numbers are no mesh.
    #[error(transparent)]
    Mesh(MeshError),
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
            ObjFault::Mesh(error) => Some(error),
            _ => None,
        }
    }
}
