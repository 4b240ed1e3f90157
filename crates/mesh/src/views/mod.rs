//! Handles joined to their surface, so that what is asked reads as a sentence: `mesh.edge(e).twin_face().normal()`.
//!
//! A view is a reference and a `u32`, is `Copy`, and holds nothing else. What concerns neighbourhood is said of any [`Surface`], what concerns places of a
//! [`Mesh`] only, and what follows from a view of a mesh is again a view of that mesh.

mod boundary;
mod component;
mod edge;
mod face;
mod geometry;
mod rings;
mod vertex;

pub use boundary::BoundaryLoop;
pub use component::{Component, Components};
pub use edge::{Edge, HalfEdge};
pub use face::Face;
pub use rings::Rings;
pub use vertex::Vertex;

use crate::{FaceId, HalfEdgeId, Mesh, Topology, VertexId};

/// What vertices, edges and faces belong to: a [`Topology`], which knows who touches whom, or a [`Mesh`], which also knows where.
pub trait Surface: sealed::Sealed {
    /// Which faces, edges and vertices touch.
    fn as_topology(&self) -> &Topology;
}

impl Surface for Topology {
    #[inline]
    fn as_topology(&self) -> &Topology {
        self
    }
}

impl Surface for Mesh {
    #[inline]
    fn as_topology(&self) -> &Topology {
        self.topology()
    }
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for crate::Topology {}
    impl Sealed for crate::Mesh {}
}

/// Declares a view: a handle with the surface that it belongs to. Views compare as their handles do.
macro_rules! view {
    ($(#[$doc:meta])* $name:ident, $id:ident) => {
        $(#[$doc])*
        pub struct $name<'a, S: crate::Surface = crate::Topology> {
            surface: &'a S,
            id: crate::$id,
        }

        impl<S: crate::Surface> Clone for $name<'_, S> {
            #[inline]
            fn clone(&self) -> Self {
                *self
            }
        }

        impl<S: crate::Surface> Copy for $name<'_, S> {}

        impl<S: crate::Surface> PartialEq for $name<'_, S> {
            #[inline]
            fn eq(&self, other: &Self) -> bool {
                self.id == other.id
            }
        }

        impl<S: crate::Surface> Eq for $name<'_, S> {}

        impl<S: crate::Surface> std::fmt::Debug for $name<'_, S> {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.debug_tuple(stringify!($name)).field(&self.id.0).finish()
            }
        }

        impl<'a, S: crate::Surface> $name<'a, S> {
            #[inline]
            pub(crate) fn new(surface: &'a S, id: crate::$id) -> Self {
                Self { surface, id }
            }

            /// The surface that it belongs to.
            #[inline]
            pub fn surface(self) -> &'a S {
                self.surface
            }
        }
    };
}
pub(crate) use view;

/// The ways from a surface to its views; a handle that is not of the surface panics once it is asked for anything, as an array does.
macro_rules! elements {
    ($surface:ident) => {
        impl $surface {
            /// A vertex.
            #[inline]
            pub fn vertex(&self, vertex: VertexId) -> Vertex<'_, Self> {
                Vertex::new(self, vertex)
            }

            /// A half-edge.
            #[inline]
            pub fn half_edge(&self, half_edge: HalfEdgeId) -> HalfEdge<'_, Self> {
                HalfEdge::new(self, half_edge)
            }

            /// The edge of which a half-edge is one side.
            #[inline]
            pub fn edge(&self, side: HalfEdgeId) -> Edge<'_, Self> {
                self.half_edge(side).edge()
            }

            /// A face.
            #[inline]
            pub fn face(&self, face: FaceId) -> Face<'_, Self> {
                Face::new(self, face)
            }

            /// Every vertex, referenced or not.
            pub fn vertices(&self) -> impl ExactSizeIterator<Item = Vertex<'_, Self>> + DoubleEndedIterator {
                (0..self.as_topology().vertex_count() as u32).map(|v| self.vertex(VertexId(v)))
            }

            /// Every half-edge.
            pub fn half_edges(&self) -> impl ExactSizeIterator<Item = HalfEdge<'_, Self>> + DoubleEndedIterator {
                (0..self.as_topology().half_edge_count() as u32).map(|h| self.half_edge(HalfEdgeId(h)))
            }

            /// Every edge once, in order of its lower half-edge.
            pub fn edges(&self) -> impl Iterator<Item = Edge<'_, Self>> {
                self.half_edges().filter_map(Edge::of_lower_side)
            }

            /// Every face.
            pub fn faces(&self) -> impl ExactSizeIterator<Item = Face<'_, Self>> + DoubleEndedIterator {
                (0..self.as_topology().face_count() as u32).map(|f| self.face(FaceId(f)))
            }

            /// The loops of the boundary, in the order of their lowest half-edge, with which each starts. Linear time.
            pub fn boundary_loops(&self) -> Vec<BoundaryLoop<'_, Self>> {
                boundary::loops_among(self.half_edges())
            }

            /// The connected pieces: faces are connected where they share an edge (fans that share a vertex only are no manifold). Linear time.
            pub fn components(&self) -> Components<'_, Self> {
                Components::of(self)
            }
        }
    };
}

elements!(Topology);
elements!(Mesh);
