//! Which faces, edges and vertices touch.

mod build;
mod check;
mod diagnosis;
mod error;
mod loops;

pub use check::BrokenInvariant;
pub use error::TopologyError;
pub use loops::Components;

use crate::{FaceId, HalfEdgeId, VertexId};

/// No half-edge: the far side of a boundary edge, or the fan of an unreferenced vertex.
const NONE: u32 = u32::MAX;

/// An oriented manifold triangle topology, with or without boundary, in flat arrays.
///
/// Twenty-four bytes a face and four a vertex. Accessors of one handle are O(1), walks take a step for each item.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Topology {
    /// Where half-edge *h* starts. `origins[3f..3f+3]` are the corners of face *f*.
    origins: Vec<VertexId>,
    /// The half-edge on the other side, or `NONE` at a boundary.
    twins: Vec<u32>,
    /// A half-edge that leaves the vertex; the one from which the whole fan can be walked by `rotate_left` if the vertex is on a boundary.
    leaving: Vec<u32>,
    /// How many half-edges have no twin.
    boundary_edges: u32,
}

impl Topology {
    /// How many vertices, referenced or not.
    pub fn vertex_count(&self) -> usize {
        self.leaving.len()
    }

    /// How many faces.
    pub fn face_count(&self) -> usize {
        self.origins.len() / 3
    }

    /// How many half-edges: three a face.
    pub fn half_edge_count(&self) -> usize {
        self.origins.len()
    }

    /// How many edges, boundary edges among them.
    pub fn edge_count(&self) -> usize {
        (self.origins.len() + self.boundary_edges as usize) / 2
    }

    /// How many edges have a face on one side only.
    pub fn boundary_edge_count(&self) -> usize {
        self.boundary_edges as usize
    }

    /// Every vertex.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = VertexId> + use<> {
        (0..self.vertex_count() as u32).map(VertexId)
    }

    /// Every face.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = FaceId> + use<> {
        (0..self.face_count() as u32).map(FaceId)
    }

    /// One half-edge for each edge: the one with the lower number, or the only one at a boundary.
    pub fn edges(&self) -> impl Iterator<Item = HalfEdgeId> + '_ {
        (0..self.origins.len() as u32).filter(|&h| self.twins[h as usize] == NONE || h < self.twins[h as usize]).map(HalfEdgeId)
    }

    /// The corners of a face, in winding order.
    #[inline]
    pub fn face_vertices(&self, face: FaceId) -> [VertexId; 3] {
        let first = 3 * face.index();
        [self.origins[first], self.origins[first + 1], self.origins[first + 2]]
    }

    /// The faces across the three edges of a face; the *k*th lies across half-edge 3*f* + *k*.
    #[inline]
    pub fn face_neighbours(&self, face: FaceId) -> [Option<FaceId>; 3] {
        face.half_edges().map(|h| self.twin(h).map(HalfEdgeId::face))
    }

    /// Every half-edge.
    pub fn half_edges(&self) -> impl ExactSizeIterator<Item = HalfEdgeId> + use<> {
        (0..self.half_edge_count() as u32).map(HalfEdgeId)
    }

    /// The corners of every face, as [`Topology::from_triangles`] takes them.
    pub fn triangles(&self) -> impl ExactSizeIterator<Item = [u32; 3]> + '_ {
        self.origins.chunks_exact(3).map(|corners| [corners[0].0, corners[1].0, corners[2].0])
    }

    /// Where the half-edge starts.
    #[inline]
    pub fn origin(&self, half_edge: HalfEdgeId) -> VertexId {
        self.origins[half_edge.index()]
    }

    /// Where the half-edge ends.
    #[inline]
    pub fn tip(&self, half_edge: HalfEdgeId) -> VertexId {
        self.origins[half_edge.next().index()]
    }

    /// The half-edge on the other side of the edge, if there is a face.
    #[inline]
    pub fn twin(&self, half_edge: HalfEdgeId) -> Option<HalfEdgeId> {
        let twin = self.twins[half_edge.index()];
        (twin != NONE).then_some(HalfEdgeId(twin))
    }

    /// The next half-edge, anticlockwise, that leaves the same vertex; none past a boundary.
    #[inline]
    pub fn rotate_left(&self, half_edge: HalfEdgeId) -> Option<HalfEdgeId> {
        self.twin(half_edge.previous())
    }

    /// The half-edges that leave a vertex, anticlockwise; at a boundary vertex from one end of the fan to the other.
    pub fn leaving(&self, vertex: VertexId) -> impl Iterator<Item = HalfEdgeId> + '_ {
        let first = self.leaving[vertex.index()];
        let first = (first != NONE).then_some(HalfEdgeId(first));
        std::iter::successors(first, move |&h| self.rotate_left(h).filter(|&next| Some(next) != first))
    }

    /// The faces around a vertex, anticlockwise.
    pub fn vertex_faces(&self, vertex: VertexId) -> impl Iterator<Item = FaceId> + '_ {
        self.leaving(vertex).map(HalfEdgeId::face)
    }

    /// The vertices joined to a vertex by an edge, anticlockwise.
    pub fn vertex_neighbours(&self, vertex: VertexId) -> impl Iterator<Item = VertexId> + '_ {
        // The fan of a boundary vertex has one neighbour more than half-edges that leave: the start of the last face's last side.
        let last = self.leaving(vertex).map(HalfEdgeId::previous).find(|&h| self.twin(h).is_none()).map(|h| self.origin(h));
        self.leaving(vertex).map(|h| self.tip(h)).chain(last)
    }

    /// Whether a face uses the vertex.
    #[inline]
    pub fn is_referenced(&self, vertex: VertexId) -> bool {
        self.leaving[vertex.index()] != NONE
    }

    /// Whether the vertex lies on a boundary; an unreferenced vertex does not.
    pub fn is_boundary_vertex(&self, vertex: VertexId) -> bool {
        let first = self.leaving[vertex.index()];
        first != NONE && self.twins[first as usize] == NONE
    }
}
