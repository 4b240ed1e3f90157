//! Fields on a surface: one value for each vertex.
//!
//! [`ScalarField`] holds numbers such as lengths, [`ColourField`] colours in linear light: constants, ramps, noise in space ([`Noise`]), painted strokes ([`Stroke`]), images
//! ([`Image`]) and the mesh's own colours; calculated with, remapped ([`Course`]), masked, mixed and blurred. [`DirectionField`] unit tangents: which way fur lies.
//! A direction field comes from one direction for the whole model, or from a few at chosen places and whirls, sources, sinks and saddles about
//! others. It is unit and tangent everywhere, also where what is given says nothing, and tells where it cannot be continuous ([`singularities`]).
//!
//! # Convention
//! Everything is in the model's coordinates, and nothing depends on its scale: distances are measured in diameters
//! ([`Mesh::diameter`](pelage_mesh::Mesh::diameter)). Results are the same bits on every run.
//!
//! ```
//! use glam::DVec3;
//! use pelage_field::{Constraint, DirectionField, ScalarField, singularities};
//!
//! let ball = pelage_mesh::sphere(1.0, 10)?;
//! // Combed down on the right, up on the left.
//! let constraints = [
//!     Constraint { at: DVec3::X, along: DVec3::NEG_Y },
//!     Constraint { at: DVec3::NEG_X, along: DVec3::Y },
//! ];
//! let field = DirectionField::from_constraints(&ball, &constraints, &[], 0.25)?;
//! // No field on a sphere is continuous: indices add up to 2.
//! let indices = singularities(&ball, &field)?.iter().map(|s| s.index).sum::<i32>();
//! assert_eq!(indices, 2);
//! // Longer towards the top.
//! let lengths = ScalarField::ramp(&ball, DVec3::Y, 0.01, 0.03)?;
//! assert_eq!(lengths.values().len(), field.vectors().len());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Sources
//! E. Praun, A. Finkelstein, H. Hoppe: Lapped Textures, SIGGRAPH 2000 (spreading a few vectors). F. Knöppel, K. Crane, U. Pinkall, P. Schröder:
//! Globally Optimal Direction Fields, SIGGRAPH 2013 (transport, indices, smoothness). E. L. Melvær, M. Reimers: Geodesic
//! Polar Coordinates on Polygonal Meshes, Computer Graphics Forum 31(8), 2012 (directions about a place).

mod blur;
mod colour;
mod comb;
mod completion;
mod constraints;
mod direction;
mod error;
mod fan;
mod image;
mod noise;
mod point;
mod polar;
mod remap;
mod scalar;
mod singularity;
mod strokes;
mod transport;

pub use self::noise::{Noise, NoiseKind};
pub use colour::ColourField;
pub use comb::{Brush, BrushStroke, Comb, MOST_SLANT, Tool};
pub use completion::LEAST_PROJECTION;
pub use constraints::Constraint;
pub use direction::DirectionField;
pub use error::FieldError;
pub use image::Image;
pub use point::{Flow, PointConstraint};
pub use remap::Course;
pub use scalar::ScalarField;
pub use singularity::{Singularity, boundary_turning, singularities};
pub use strokes::Stroke;
