//! Which faces, edges and vertices touch.

mod build;
mod check;
mod diagnosis;
mod error;

pub use check::BrokenInvariant;
pub use error::TopologyError;

use crate::{FaceId, HalfEdgeId, VertexId};

/// No half-edge: the far side of a boundary edge, or the fan of an unreferenced vertex.
const NONE: u32 = u32::MAX;

/// An oriented manifold triangle topology, with or without boundary, in flat arrays.
///
/// Twenty-four bytes a face and four a vertex. It is read through views, such as `topology.vertex(v).neighbours()` ([`Vertex`](crate::Vertex),
/// [`HalfEdge`](crate::HalfEdge), [`Edge`](crate::Edge), [`Face`](crate::Face)): what concerns one is O(1), walks take a step for each item.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Topology {
    /// Where half-edge *h* starts. `origins[3f..3f+3]` are the corners of face *f*.
    origins: Vec<VertexId>,
    /// The half-edge on the other side, or `NONE` at a boundary.
    twins: Vec<u32>,
    /// A half-edge that leaves the vertex; the one from which the whole fan can be walked anticlockwise if the vertex is on a boundary.
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

    /// The corners of every face, as [`Topology::from_triangles`] takes them.
    pub fn triangles(&self) -> impl ExactSizeIterator<Item = [u32; 3]> + '_ {
        self.origins.chunks_exact(3).map(|corners| [corners[0].0, corners[1].0, corners[2].0])
    }

    /// How many vertices have a face.
    pub fn referenced_vertex_count(&self) -> usize {
        self.leaving.iter().filter(|&&first| first != NONE).count()
    }

    /// χ = V − E + F, unreferenced vertices not counted.
    pub fn euler_characteristic(&self) -> i64 {
        self.referenced_vertex_count() as i64 - self.edge_count() as i64 + self.face_count() as i64
    }

    /// How many handles all pieces have together: 2C − 2g − B = χ with C pieces and B boundary loops. Linear time.
    pub fn genus(&self) -> usize {
        let (components, loops) = (self.components().count(), self.boundary_loops().len());
        // An oriented surface: always even, never negative.
        ((2 * components as i64 - loops as i64 - self.euler_characteristic()) / 2) as usize
    }

    /// Whether there is a surface and it has no boundary.
    pub fn is_closed(&self) -> bool {
        self.face_count() > 0 && self.boundary_edges == 0
    }
}

/// What views are made of.
impl Topology {
    #[inline]
    pub(crate) fn corners(&self, face: FaceId) -> [VertexId; 3] {
        let first = 3 * face.index();
        [self.origins[first], self.origins[first + 1], self.origins[first + 2]]
    }

    #[inline]
    pub(crate) fn origin(&self, half_edge: HalfEdgeId) -> VertexId {
        self.origins[half_edge.index()]
    }

    #[inline]
    pub(crate) fn tip(&self, half_edge: HalfEdgeId) -> VertexId {
        self.origins[half_edge.next().index()]
    }

    #[inline]
    pub(crate) fn twin(&self, half_edge: HalfEdgeId) -> Option<HalfEdgeId> {
        let twin = self.twins[half_edge.index()];
        (twin != NONE).then_some(HalfEdgeId(twin))
    }

    #[inline]
    pub(crate) fn first_leaving(&self, vertex: VertexId) -> Option<HalfEdgeId> {
        let first = self.leaving[vertex.index()];
        (first != NONE).then_some(HalfEdgeId(first))
    }

    #[inline]
    pub(crate) fn leaving(&self, vertex: VertexId) -> impl Iterator<Item = HalfEdgeId> + '_ {
        let first = self.first_leaving(vertex);
        std::iter::successors(first, move |&h| self.twin(h.previous()).filter(|&next| Some(next) != first))
    }
}
