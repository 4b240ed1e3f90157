//! A face and what it touches.

use super::{Edge, HalfEdge, Surface, Vertex, view};
use crate::FaceId;

view! {
    /// A triangle of a surface.
    Face, FaceId
}

impl<'a, S: Surface> Face<'a, S> {
    /// Its handle.
    #[inline]
    pub fn id(self) -> FaceId {
        self.id
    }

    /// Its place in an array of one value a face.
    #[inline]
    pub fn index(self) -> usize {
        self.id.index()
    }

    /// Its half-edges, in winding order; the *k*th starts at corner *k*.
    #[inline]
    pub fn half_edges(self) -> [HalfEdge<'a, S>; 3] {
        self.id.half_edges().map(|h| HalfEdge::new(self.surface, h))
    }

    /// Its edges, in winding order; the *k*th runs from corner *k* to the next.
    #[inline]
    pub fn edges(self) -> [Edge<'a, S>; 3] {
        self.half_edges().map(HalfEdge::edge)
    }

    /// Its corners, in winding order.
    #[inline]
    pub fn vertices(self) -> [Vertex<'a, S>; 3] {
        self.surface.as_topology().corners(self.id).map(|v| Vertex::new(self.surface, v))
    }

    /// What lies across each of its edges: the *k*th is the face across [`Face::half_edges`]`[k]`.
    #[inline]
    pub fn across(self) -> [Option<Self>; 3] {
        self.half_edges().map(|half_edge| half_edge.twin().map(HalfEdge::face))
    }

    /// The faces that share an edge with it, in winding order.
    #[inline]
    pub fn neighbours(self) -> impl Iterator<Item = Self> + use<'a, S> {
        self.across().into_iter().flatten()
    }

    /// Whether one of its edges is on the boundary.
    #[inline]
    pub fn is_boundary(self) -> bool {
        self.half_edges().into_iter().any(HalfEdge::is_boundary)
    }
}
