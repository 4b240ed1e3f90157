//! Half-edge topology and triangle geometry.
//!
//! [`Topology`] says which faces, edges and vertices touch; it knows no positions. [`Mesh`] adds them, and texture coordinates.
//! Meshes come from an OBJ file ([`read_obj`]), from a list of triangles, or from a formula ([`sphere`], [`torus`], [`plane`], [`rounded_die`]);
//! [`Summary`] puts one into figures.
//!
//! # Convention
//! Faces wind anticlockwise seen from outside, the frame is right-handed with y up, and a model's own units are kept in `f64`. A handle is a
//! `u32` ([`VertexId`], [`HalfEdgeId`], [`FaceId`]). Nothing here panics on the content of a model; a fault is a typed error that says where and how to mend it.
//! A handle that is not of the mesh it is used with is a fault of the program, and panics as an array does.
//!
//! ```
//! use glam::DVec3;
//! use pelage_mesh::{Mesh, Summary, VertexId};
//!
//! let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
//! let tetrahedron = Mesh::from_triangles(corners, &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])?;
//!
//! let topology = tetrahedron.topology();
//! let ring: Vec<VertexId> = topology.vertex_neighbours(VertexId(3)).collect();
//! assert_eq!(ring.len(), 3);
//! let across: Vec<f64> = topology.edges().map(|edge| tetrahedron.edge_length(edge)).collect();
//! assert_eq!(across.len(), 6);
//! assert!(Summary::of(&tetrahedron).is_closed());
//! # Ok::<(), pelage_mesh::MeshError>(())
//! ```
//!
//! # Sources
//! S. Campagna, L. Kobbelt, H.-P. Seidel: Directed Edges, a Scalable Representation for Triangle Meshes, Journal of Graphics Tools 3(4), 1998:
//! the three half-edges of face *f* are 3*f*, 3*f* + 1 and 3*f* + 2, so that a half-edge's face, next and previous are arithmetic and only its
//! mate is stored. G. Thürmer, C. A. Wüthrich: Computing Vertex Normals from Polygonal Facets, Journal of Graphics Tools 3(1), 1998.

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
