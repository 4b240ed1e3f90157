//! Half-edge topology and triangle geometry.
//!
//! [`Topology`] says which faces, edges and vertices touch; it knows no positions. [`Mesh`] adds them.
//! The structure is the directed-edge one of Campagna, Kobbelt and Seidel 1998: the three half-edges of face *f* are
//! 3*f*, 3*f* + 1 and 3*f* + 2, so that a half-edge's face, next and previous are arithmetic and only its mate is stored.
//!
//! Faces wind anticlockwise seen from outside, the frame is right-handed, and a model's own units are kept in `f64`.

mod geometry;
mod handles;
mod obj;
mod primitives;
mod summary;
mod topology;
mod vector;

pub use geometry::{Mesh, MeshError};
pub use handles::{FaceId, HalfEdgeId, VertexId};
pub use obj::{ObjError, ObjFault, parse_obj, read_obj};
pub use primitives::{MOST_PRIMITIVE_FACES, PrimitiveError, plane, rounded_die, sphere, torus};
pub use summary::Summary;
pub use topology::{BrokenInvariant, Components, Topology, TopologyError};
pub use vector::{angle_between, unit};
