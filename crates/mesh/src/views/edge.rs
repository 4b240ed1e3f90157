//! Edges and their sides.

use super::{Face, Surface, Vertex, view};
use crate::HalfEdgeId;

view! {
    /// One side of an edge: it runs along the border of one face, with that face on its left.
    HalfEdge, HalfEdgeId
}

impl<'a, S: Surface> HalfEdge<'a, S> {
    /// Its handle.
    #[inline]
    pub fn id(self) -> HalfEdgeId {
        self.id
    }

    /// Its place in an array of one value a half-edge (a corner of a face).
    #[inline]
    pub fn index(self) -> usize {
        self.id.index()
    }

    /// The vertex where it starts.
    #[inline]
    pub fn origin(self) -> Vertex<'a, S> {
        Vertex::new(self.surface, self.surface.as_topology().origin(self.id))
    }

    /// The vertex where it ends.
    #[inline]
    pub fn tip(self) -> Vertex<'a, S> {
        self.next().origin()
    }

    /// The corner of its face that is not on it.
    #[inline]
    pub fn apex(self) -> Vertex<'a, S> {
        self.previous().origin()
    }

    /// The face on its left.
    #[inline]
    pub fn face(self) -> Face<'a, S> {
        Face::new(self.surface, self.id.face())
    }

    /// The half-edge after it around its face.
    #[inline]
    pub fn next(self) -> Self {
        Self { id: self.id.next(), ..self }
    }

    /// The half-edge before it around its face.
    #[inline]
    pub fn previous(self) -> Self {
        Self { id: self.id.previous(), ..self }
    }

    /// The half-edge on the other side of the edge, if there is a face.
    #[inline]
    pub fn twin(self) -> Option<Self> {
        self.surface.as_topology().twin(self.id).map(|id| Self { id, ..self })
    }

    /// The next half-edge, anticlockwise, that leaves the same vertex; none past a boundary.
    #[inline]
    pub fn rotate_left(self) -> Option<Self> {
        self.previous().twin()
    }

    /// The next half-edge, clockwise, that leaves the same vertex; none past a boundary.
    #[inline]
    pub fn rotate_right(self) -> Option<Self> {
        self.twin().map(Self::next)
    }

    /// Whether there is no face on the other side.
    #[inline]
    pub fn is_boundary(self) -> bool {
        self.twin().is_none()
    }

    /// The edge of which it is a side.
    #[inline]
    pub fn edge(self) -> Edge<'a, S> {
        Edge::new(self.surface, self.twin().map_or(self.id, |twin| twin.id.min(self.id)))
    }
}

view! {
    /// An edge of a surface, whichever of its sides it was asked for by. Its identity is its lower half-edge.
    Edge, HalfEdgeId
}

impl<'a, S: Surface> Edge<'a, S> {
    /// The edge, if the half-edge is its lower side.
    #[inline]
    pub(super) fn of_lower_side(half_edge: HalfEdge<'a, S>) -> Option<Self> {
        let lower = half_edge.twin().is_none_or(|twin| half_edge.id < twin.id);
        lower.then_some(Self { surface: half_edge.surface, id: half_edge.id })
    }

    /// The lower of its half-edges, or the only one at a boundary.
    #[inline]
    pub fn half_edge(self) -> HalfEdge<'a, S> {
        HalfEdge::new(self.surface, self.id)
    }

    /// Its half-edges, the lower first: one at a boundary, else two.
    #[inline]
    pub fn half_edges(self) -> impl Iterator<Item = HalfEdge<'a, S>> + use<'a, S> {
        std::iter::once(self.half_edge()).chain(self.half_edge().twin())
    }

    /// Its ends, in the order in which its lower half-edge runs.
    #[inline]
    pub fn vertices(self) -> [Vertex<'a, S>; 2] {
        [self.half_edge().origin(), self.half_edge().tip()]
    }

    /// The faces on its sides: one at a boundary, else two.
    #[inline]
    pub fn faces(self) -> impl Iterator<Item = Face<'a, S>> + use<'a, S> {
        self.half_edges().map(HalfEdge::face)
    }

    /// Whether there is a face on one side only.
    #[inline]
    pub fn is_boundary(self) -> bool {
        self.half_edge().is_boundary()
    }
}
