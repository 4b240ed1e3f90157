//! Half-edge topology and triangle geometry.
//!
//! [`Topology`] says which faces, edges and vertices touch; it knows no positions. [`Mesh`] adds them, texture coordinates and colours.
//! Meshes come from an OBJ or a glTF file ([`read_obj`], [`read_gltf`]), from any polygons whatever ([`repair`]), from a list of triangles, or from a formula ([`sphere`], [`torus`], [`plane`], [`rounded_die`]);
//! They are cut finer ([`subdivide`]), thinned out ([`simplify`]), moved ([`transform`]) and put together ([`join`]).
//! [`Summary`] puts one into figures, [`Geodesics`] measures along it, [`SpatialIndex`] finds where rays hit it and which of its points are near.
//!
//! # Convention
//! Faces wind anticlockwise seen from outside, the frame is right-handed with y up, and a model's own units are kept in `f64`. A handle is a
//! `u32` ([`VertexId`], [`HalfEdgeId`], [`FaceId`]) to be kept in arrays; joined to its surface it is a view ([`Vertex`], [`HalfEdge`], [`Edge`], [`Face`]),
//! from which the rest is asked as a sentence. Nothing here panics on the content of a model; a fault is a typed error that says where and how to mend it.
//! A handle that is not of the mesh it is used with is a fault of the program, and panics as an array does.
//!
//! ```
//! use glam::DVec3;
//! use pelage_mesh::{Edge, Mesh, Summary, VertexId};
//!
//! let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
//! let tetrahedron = Mesh::from_triangles(corners, &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])?;
//!
//! let top = tetrahedron.vertex(VertexId(3));
//! assert_eq!((top.valence(), top.neighbours().count()), (3, 3));
//! assert!(top.normal().dot(DVec3::Z) > 0.9 && top.faces().all(|face| face.area() >= 0.5));
//! let longest = tetrahedron.edges().map(Edge::length).fold(0.0, f64::max);
//! assert_eq!(longest, 2_f64.sqrt());
//! assert_eq!(tetrahedron.topology().genus(), 0);
//! assert!(Summary::of(&tetrahedron).is_closed());
//! # Ok::<(), pelage_mesh::MeshError>(())
//! ```
//!
//! # Features
//! `gltf` (default): glTF import, by the crate of that name. `simplify` (default): [`simplify`], by meshoptimizer, which a C++ compiler builds.
//!
//! # Sources
//! S. Campagna, L. Kobbelt, H.-P. Seidel: Directed Edges, a Scalable Representation for Triangle Meshes, Journal of Graphics Tools 3(4), 1998:
//! the three half-edges of face *f* are 3*f*, 3*f* + 1 and 3*f* + 2, so that a half-edge's face, next and previous are arithmetic and only its
//! mate is stored. G. Thürmer, C. A. Wüthrich: Computing Vertex Normals from Polygonal Facets, Journal of Graphics Tools 3(1), 1998.
//! A. Guéziec, G. Taubin, F. Lazarus, B. Horn: Cutting and Stitching: Converting Sets of Polygons to Manifold Surfaces, IEEE Transactions on
//! Visualization and Computer Graphics 7(2), 2001: vertices copied for each fan.

mod edit;
mod geodesic;
mod geometry;
#[cfg(feature = "gltf")]
mod gltf;
mod handles;
mod index;
mod obj;
mod point;
mod primitives;
mod quality;
mod repair;
mod srgb;
mod summary;
mod topology;
mod vector;
mod views;

#[cfg(feature = "gltf")]
pub use self::gltf::{Beside, GltfError, GltfFault, GltfImage, GltfImport, GltfMaterial, GltfNote, MOST_GLTF_FACES, parse_gltf, read_gltf};
pub use edit::{JoinError, MOST_SUBDIVIDED_FACES, SubdivideError, Transform, TransformError, join, subdivide, transform};
#[cfg(feature = "simplify")]
pub use edit::{Simplified, SimplifyError, SimplifySettings, simplify};
pub use geodesic::{Distances, GeodesicError, Geodesics, Source};
pub use geometry::{Mesh, MeshError};
pub use handles::{FaceId, HalfEdgeId, VertexId};
pub use index::{Hit, IndexError, Nearest, Ray, RayError, Side, SpatialIndex};
pub use obj::{Import, Note, ObjError, ObjFault, parse_obj, read_obj};
pub use point::SurfacePoint;
pub use primitives::{MOST_PRIMITIVE_FACES, PrimitiveError, plane, rounded_die, sphere, torus};
pub use quality::Quality;
pub use repair::{RepairError, RepairReport, RepairSettings, Repaired, Soup, WELD_TOLERANCE, repair};
pub use srgb::srgb_to_linear;
pub use summary::Summary;
pub use topology::{BrokenInvariant, Topology, TopologyError};
pub use vector::{angle_between, unit};
pub use views::{BoundaryLoop, Component, Components, Edge, Face, HalfEdge, Rings, Surface, Vertex};

/// The example of the read-me, kept working.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
