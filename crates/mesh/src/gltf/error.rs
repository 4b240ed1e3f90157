//! What is wrong with a glTF file, and how to mend it.

use std::fmt;
use std::path::{Path, PathBuf};

use super::MOST_GLTF_FACES;
use crate::RepairError;

/// A glTF file that gives no mesh, even mended. It displays as `file: what is wrong; how to mend it`.
#[derive(Debug)]
pub struct GltfError {
    /// The file, if it came from one.
    pub path: Option<PathBuf>,
    /// What is wrong.
    pub fault: GltfFault,
}

/// What is wrong with a glTF file. Everything is numbered from 0, as in the file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GltfFault {
    /// The file cannot be opened or read.
    #[error("the file cannot be read: {0}")]
    Unreadable(std::io::Error),
    /// A binary file is shorter than its header says.
    #[error("the file is cut short: its header speaks of {said} bytes, and {there} are there; copy or export it again")]
    CutShort {
        /// Bytes by the header.
        said: u32,
        /// Bytes there are.
        there: usize,
    },
    /// It is no glTF 2.0, or contradicts itself.
    #[error("this is no sound glTF 2.0: {0}; export it again")]
    Broken(String),
    /// It needs an extension that is not read, such as compressed meshes.
    #[error("the file needs the extension {0}, which is not read; export it without, such as uncompressed")]
    Extension(String),
    /// A buffer is in another file that cannot be read.
    #[error("buffer {buffer} is in `{file}`, which cannot be read: {cause}")]
    Buffer {
        /// The buffer.
        buffer: usize,
        /// The file, as the model names it.
        file: String,
        /// Why not.
        cause: std::io::Error,
    },
    /// A buffer names what is neither data nor a file beside the model.
    #[error("{what} is at `{uri}`; only data and files in the model's own folder or below are read")]
    Elsewhere {
        /// What is there.
        what: String,
        /// Where it is said to be.
        uri: String,
    },
    /// Data in the text that cannot be decoded.
    #[error("{what} holds data that is no base64; export it again")]
    Data {
        /// What holds them.
        what: String,
    },
    /// The buffer of a binary file that has none.
    #[error("buffer {buffer} is to be in the file itself, which holds no binary part; give the buffer a file")]
    NoBinary {
        /// The buffer.
        buffer: usize,
    },
    /// Bytes are named that are not there.
    #[error("{what} needs the bytes up to {end} of buffer {buffer}, which has {length}; the file is cut short or was put together wrongly")]
    OutOfBuffer {
        /// What needs them.
        what: String,
        /// The buffer.
        buffer: usize,
        /// Where they end.
        end: u64,
        /// Bytes the buffer has.
        length: usize,
    },
    /// Numbers stored as changes to others.
    #[error("accessor {accessor} is sparse, which is not read; export the model without")]
    Sparse {
        /// The accessor.
        accessor: usize,
    },
    /// Numbers of a kind that does not go where they are used.
    #[error("accessor {accessor} is used for {used_for}, which are {wanted}, and it has {found}")]
    Kind {
        /// The accessor.
        accessor: usize,
        /// What for.
        used_for: &'static str,
        /// What these may be.
        wanted: &'static str,
        /// What it has.
        found: String,
    },
    /// The numbers of a vertex do not go with its place.
    #[error("mesh {mesh}, primitive {primitive}: {found} {what} for {positions} positions; give one for each")]
    Count {
        /// The mesh.
        mesh: usize,
        /// The primitive.
        primitive: usize,
        /// Of what.
        what: &'static str,
        /// How many.
        found: usize,
        /// Positions there are.
        positions: usize,
    },
    /// A primitive has no positions.
    #[error("mesh {mesh}, primitive {primitive} has no positions; remove it or give it some")]
    NoPositions {
        /// The mesh.
        mesh: usize,
        /// The primitive.
        primitive: usize,
    },
    /// An index leads to no vertex.
    #[error("mesh {mesh}, primitive {primitive} names vertex {index}, but has {count}; mend the index")]
    VertexOutOfRange {
        /// The mesh.
        mesh: usize,
        /// The primitive.
        primitive: usize,
        /// What it names.
        index: u32,
        /// How many there are.
        count: usize,
    },
    /// A number of a vertex is NaN or infinite.
    #[error("mesh {mesh}, primitive {primitive}: vertex {vertex} has {what} that are NaN or infinite; mend the numbers")]
    NotFinite {
        /// The mesh.
        mesh: usize,
        /// The primitive.
        primitive: usize,
        /// The vertex.
        vertex: usize,
        /// Which numbers.
        what: &'static str,
    },
    /// A node's place is no place.
    #[error("node {node} is moved by numbers that are NaN, infinite or too large; mend its matrix, translation, rotation or scale")]
    Transform {
        /// The node.
        node: usize,
    },
    /// A node that is reached twice: the nodes are no tree.
    #[error("node {node} is shown twice or is its own parent; give each node one parent")]
    NodeTwice {
        /// The node.
        node: usize,
    },
    /// More faces than are read.
    #[error("the scene shows more than {MOST_GLTF_FACES} faces; show fewer copies, or simplify it")]
    TooManyFaces,
    /// There is no triangle.
    #[error("the scene shows no triangle, so there is no surface")]
    NoFaces,
    /// An image is in another file that cannot be read.
    #[error("image {image} is in `{file}`, which cannot be read: {cause}")]
    Image {
        /// The image.
        image: usize,
        /// The file, as the model names it.
        file: String,
        /// Why not.
        cause: std::io::Error,
    },
    /// An image is nowhere.
    #[error("image {image} has neither bytes nor a file; embed it or name its file")]
    NoImage {
        /// The image.
        image: usize,
    },
    /// The faces give no surface.
    #[error(transparent)]
    Repair(RepairError),
}

impl GltfError {
    pub(super) fn in_file(self, path: &Path) -> Self {
        Self { path: Some(path.to_owned()), ..self }
    }
}

impl From<GltfFault> for GltfError {
    fn from(fault: GltfFault) -> Self {
        Self { path: None, fault }
    }
}

/// What the library complains of.
pub(super) fn of_library(error: gltf::Error) -> GltfError {
    let said = match error {
        gltf::Error::Validation(faults) => match faults.into_iter().next() {
            Some((path, fault)) => format!("{path}: {fault}"),
            None => "it is not valid".to_owned(),
        },
        other => other.to_string(),
    };
    // What is said may hold names out of the file.
    GltfFault::Broken(said.chars().filter(|c| !c.is_control()).take(200).collect()).into()
}

impl fmt::Display for GltfError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(path) = &self.path {
            write!(f, "{}: ", path.display())?;
        }
        self.fault.fmt(f)
    }
}

impl std::error::Error for GltfError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.fault {
            GltfFault::Unreadable(error) | GltfFault::Buffer { cause: error, .. } | GltfFault::Image { cause: error, .. } => Some(error),
            GltfFault::Repair(error) => Some(error),
            _ => None,
        }
    }
}
