//! Lapped patches: a surface tiled by local parameterisations, so that one small square of hair covers it.
//!
//! [`grow`] cuts a [`Mesh`](pelage_mesh::Mesh) into patches, each a topological disc of whole faces, and lays each out in the plane of the
//! hair tile, which repeats. Every face lies in exactly one patch, none is flipped, and each keeps the bounds on stretch and turning that
//! [`Settings`] name; [`Quality`] measures all of that on the finished [`PatchTiling`].
//!
//! Coordinates are (s, t) in tiles: 1 is one repeat. Hair lies along +t, which follows the direction field; s × t points out of the
//! surface, so that faces wind anticlockwise in the (s, t) plane as they do seen from outside. Lengths given by callers are in model units,
//! angles in radians unless a name says degrees.
//!
//! ```
//! use pelage_field::DirectionField;
//! use pelage_patch::{Settings, grow};
//!
//! let ball = pelage_mesh::sphere(1.0, 12)?;
//! let combed = DirectionField::toward(&ball, glam::DVec3::NEG_Y)?;
//! let tiling = grow(&ball, Some(&combed), &Settings::for_mesh(&ball))?;
//!
//! let quality = tiling.quality(&ball, Some(&combed));
//! assert!(quality.all_discs && quality.faces_flipped == 0);
//! assert!(quality.stretch_p50 < 1.15 && quality.misalignment_deg_mean.is_some_and(|degrees| degrees < 12.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! From Praun, Finkelstein and Hoppe, *Lapped textures*, SIGGRAPH 2000, as Lengyel, Praun, Finkelstein and Hoppe adapt it in *Real-time fur
//! over arbitrary surfaces*, I3D 2001, section 2.1: patches end on mesh edges and do not overlap. Where and why this departs from them is
//! said in the book's page on lapped patches.

mod connectivity;
mod cover;
mod disc;
mod distortion;
mod frame;
mod growth;
mod lapped;
mod quality;
mod settings;
mod shape;
mod solve;
mod splotch;
mod tiling;

pub use cover::grow;
pub use lapped::{LappedPatches, lap};
pub use quality::Quality;
pub use settings::{
    DEFAULT_ALIGNMENT, DEFAULT_MAX_STRETCH, DEFAULT_MAX_TURNING, DEFAULT_PATCH_EXTENT, DEFAULT_TILE_FRACTION, PatchError, Settings,
};
pub use tiling::{Patch, PatchTiling};
