//! What keeps a list of triangles from being a surface.

/// Why an index list is no oriented manifold.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TopologyError {
    /// A corner names a vertex that does not exist.
    #[error("face {face} names vertex {vertex}, but there are {vertex_count}; remove the face or add the vertex")]
    VertexOutOfRange {
        /// The face.
        face: u32,
        /// The vertex it names.
        vertex: u32,
        /// How many there are.
        vertex_count: usize,
    },
    /// A face uses a vertex twice.
    #[error("face {face} uses vertex {vertex} twice; remove the face")]
    DegenerateFace {
        /// The face.
        face: u32,
        /// The repeated vertex.
        vertex: u32,
    },
    /// Two faces run along an edge in the same direction: three faces share it, a face is doubled, or windings disagree.
    #[error(
        "faces {first} and {second} both run along the edge from vertex {from} to {to}; \
         turn one of them if their windings disagree, remove one if they are the same, \
         or give the third face at an edge vertices of its own"
    )]
    EdgeUsedTwice {
        /// The face met first.
        first: u32,
        /// The face met second.
        second: u32,
        /// Where the edge starts.
        from: u32,
        /// Where the edge ends.
        to: u32,
    },
    /// No choice of windings makes the faces agree, as on a Möbius strip or a Klein bottle.
    #[error(
        "the surface has one side only (it is not orientable, like a Möbius strip): no way of turning its faces lets \
         all of them agree, and going around it faces {first} and {second} clash at the edge between vertices {from} and {to}; \
         cut it open along a line of edges, giving one side of the cut vertices of its own"
    )]
    NotOrientable {
        /// One of two neighbours whose windings cannot agree.
        first: u32,
        /// The other.
        second: u32,
        /// One end of the edge between them.
        from: u32,
        /// Its other end.
        to: u32,
    },
    /// Several fans of faces touch at one vertex only.
    #[error("the faces around vertex {vertex} form more than one fan; give each fan a vertex of its own")]
    NonManifoldVertex {
        /// The vertex.
        vertex: u32,
    },
    /// More vertices than there are handles for.
    #[error("{vertices} vertices are too many; at most {} fit", u32::MAX >> 1)]
    TooManyVertices {
        /// How many were given.
        vertices: usize,
    },
    /// More half-edges than a `u32` counts.
    #[error("{faces} faces are too many; at most {} fit", (u32::MAX - 1) / 3)]
    TooManyFaces {
        /// How many were given.
        faces: usize,
    },
}
