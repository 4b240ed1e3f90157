//! A vertex and what surrounds it.

use super::{Edge, Face, HalfEdge, Rings, Surface, view};
use crate::VertexId;

view! {
    /// A vertex of a surface.
    Vertex, VertexId
}

impl<'a, S: Surface> Vertex<'a, S> {
    /// Its handle.
    #[inline]
    pub fn id(self) -> VertexId {
        self.id
    }

    /// Its place in an array of one value a vertex.
    #[inline]
    pub fn index(self) -> usize {
        self.id.index()
    }

    /// The first half-edge of [`Vertex::leaving`]; none if no face uses the vertex.
    #[inline]
    pub fn first_leaving(self) -> Option<HalfEdge<'a, S>> {
        self.surface.as_topology().first_leaving(self.id).map(|h| HalfEdge::new(self.surface, h))
    }

    /// The half-edges that leave it, anticlockwise; at a boundary from one end of the fan to the other.
    #[inline]
    pub fn leaving(self) -> impl Iterator<Item = HalfEdge<'a, S>> + use<'a, S> {
        let surface = self.surface;
        surface.as_topology().leaving(self.id).map(move |h| HalfEdge::new(surface, h))
    }

    /// The half-edges that end at it, anticlockwise: each the one before its counterpart of [`Vertex::leaving`] around their face.
    #[inline]
    pub fn arriving(self) -> impl Iterator<Item = HalfEdge<'a, S>> + use<'a, S> {
        self.leaving().map(HalfEdge::previous)
    }

    /// The edges at it, anticlockwise: one more than faces at a boundary.
    #[inline]
    pub fn edges(self) -> impl Iterator<Item = Edge<'a, S>> + use<'a, S> {
        self.leaving().map(HalfEdge::edge).chain(self.last_arriving().map(HalfEdge::edge))
    }

    /// The faces around it, anticlockwise.
    #[inline]
    pub fn faces(self) -> impl Iterator<Item = Face<'a, S>> + use<'a, S> {
        self.leaving().map(HalfEdge::face)
    }

    /// The vertices joined to it by an edge, anticlockwise: its one-ring.
    #[inline]
    pub fn neighbours(self) -> impl Iterator<Item = Self> + use<'a, S> {
        self.leaving().map(HalfEdge::tip).chain(self.last_arriving().map(HalfEdge::origin))
    }

    /// The half-edges across its faces from it, anticlockwise: the rim of its one-ring, a closed loop but at a boundary.
    #[inline]
    pub fn link(self) -> impl Iterator<Item = HalfEdge<'a, S>> + use<'a, S> {
        self.leaving().map(HalfEdge::next)
    }

    /// The vertices one edge away, those two edges away, and so on until there are no more.
    pub fn rings(self) -> Rings<'a, S> {
        Rings::around(self)
    }

    /// How many edges meet at it.
    pub fn valence(self) -> usize {
        self.leaving().count() + usize::from(self.is_boundary())
    }

    /// How many faces meet at it.
    pub fn face_count(self) -> usize {
        self.leaving().count()
    }

    /// The half-edge from here to another vertex, if one runs so; at a boundary there may be only the one that runs back.
    pub fn half_edge_to(self, other: VertexId) -> Option<HalfEdge<'a, S>> {
        self.leaving().find(|half_edge| half_edge.tip().id == other)
    }

    /// The edge between it and another vertex.
    pub fn edge_to(self, other: VertexId) -> Option<Edge<'a, S>> {
        self.neighbours().zip(self.edges()).find(|(neighbour, _)| neighbour.id == other).map(|(_, edge)| edge)
    }

    /// Whether a face uses it.
    #[inline]
    pub fn is_referenced(self) -> bool {
        self.first_leaving().is_some()
    }

    /// Whether it lies on the boundary; an unreferenced vertex does not.
    #[inline]
    pub fn is_boundary(self) -> bool {
        self.first_leaving().is_some_and(HalfEdge::is_boundary)
    }

    /// The boundary half-edge that ends at a boundary vertex: the fan of which has one edge more than half-edges that leave.
    #[inline]
    fn last_arriving(self) -> Option<HalfEdge<'a, S>> {
        if self.is_boundary() { self.arriving().find(|half_edge| half_edge.is_boundary()) } else { None }
    }
}
