//! `u32` handles: four bytes each, and not to be mistaken for one another. They say what is arithmetic; the rest is said by views.

macro_rules! handle {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(transparent)]
        pub struct $name(pub u32);

        impl $name {
            /// The handle as a place in an array.
            #[inline]
            pub fn index(self) -> usize {
                self.0 as usize
            }

            /// The handle of a place in an array; places past `u32::MAX` do not exist in a [`Topology`](crate::Topology).
            #[inline]
            pub fn from_index(index: usize) -> Self {
                debug_assert!(u32::try_from(index).is_ok());
                Self(index as u32)
            }
        }
    };
}

handle! {
    /// A vertex.
    VertexId
}
handle! {
    /// One side of an edge, running along the border of one face with that face on its left.
    HalfEdgeId
}
handle! {
    /// A triangle.
    FaceId
}

impl HalfEdgeId {
    /// The face on its left.
    #[inline]
    pub fn face(self) -> FaceId {
        FaceId(self.0 / 3)
    }

    /// The half-edge after it around its face.
    #[inline]
    pub fn next(self) -> Self {
        Self(if self.0 % 3 == 2 { self.0 - 2 } else { self.0 + 1 })
    }

    /// The half-edge before it around its face.
    #[inline]
    pub fn previous(self) -> Self {
        Self(if self.0.is_multiple_of(3) { self.0 + 2 } else { self.0 - 1 })
    }
}

impl FaceId {
    /// Its three half-edges, in winding order.
    #[inline]
    pub fn half_edges(self) -> [HalfEdgeId; 3] {
        [HalfEdgeId(3 * self.0), HalfEdgeId(3 * self.0 + 1), HalfEdgeId(3 * self.0 + 2)]
    }
}
