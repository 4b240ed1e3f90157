//! Why polygons give no surface.

use crate::MeshError;

/// Why [`repair`](crate::repair) gives no mesh. All else it mends.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RepairError {
    /// There is no polygon.
    #[error("there is no face, so there is no surface")]
    NoFaces,
    /// No polygon has an area.
    #[error(
        "none of the {faces} faces has an area, so there is no usable surface; are all vertices at one place or on one line, or so far from the origin that rounding puts them there?"
    )]
    NoSurface {
        /// How many polygons there are.
        faces: usize,
    },
    /// A position is NaN or infinite.
    #[error("vertex {vertex} has a coordinate that is NaN or infinite; mend the number")]
    NotFinite {
        /// The vertex.
        vertex: u32,
    },
    /// A colour is NaN or infinite.
    #[error("vertex {vertex} has a colour that is NaN or infinite; mend it or leave all of them out")]
    ColourNotFinite {
        /// The vertex.
        vertex: u32,
    },
    /// There is not one colour a vertex.
    #[error("{colours} colours for {vertices} vertices; give one for each, or none")]
    ColourCount {
        /// Colours given.
        colours: usize,
        /// Vertices given.
        vertices: usize,
    },
    /// A used texture coordinate is NaN or infinite.
    #[error("polygon {polygon} uses texture coordinates that are NaN or infinite; mend them or leave all of them out")]
    CoordinateNotFinite {
        /// The polygon.
        polygon: usize,
    },
    /// A corner names a vertex that does not exist.
    #[error("polygon {polygon} names vertex {vertex}, but there are {count}; remove the polygon or add the vertex")]
    VertexOutOfRange {
        /// The polygon.
        polygon: usize,
        /// The vertex it names.
        vertex: u32,
        /// How many there are.
        count: usize,
    },
    /// A corner names texture coordinates that do not exist.
    #[error("polygon {polygon} names texture coordinates {index}, but there are {count}; add them, or leave all of them out")]
    CoordinateOutOfRange {
        /// The polygon.
        polygon: usize,
        /// What it names.
        index: u32,
        /// How many there are.
        count: usize,
    },
    /// The arrays of the soup do not fit together.
    #[error(
        "the soup has {corners} corners, {coordinates} texture coordinates for them, and polygons that end at {end}; \
             give one for each corner or none, and ends that rise up to the number of corners"
    )]
    Arrays {
        /// Corners given.
        corners: usize,
        /// Texture coordinates of corners given.
        coordinates: usize,
        /// Where the last polygon ends.
        end: usize,
    },
    /// More of something than there are handles for.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}
