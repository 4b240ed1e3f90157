//! Surfaces made by formula, wound anticlockwise seen from outside.

mod die;
mod grid;
mod plane;
mod sphere;
mod torus;

pub use die::rounded_die;
pub use plane::plane;
pub use sphere::sphere;
pub use torus::torus;

use glam::{DVec2, DVec3};

use crate::{Mesh, MeshError};

/// A primitive has at most this many faces: about half a gigabyte.
pub const MOST_PRIMITIVE_FACES: u64 = 8_000_000;

/// Why there is no such primitive.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PrimitiveError {
    /// A length that must be positive is not, or is too extreme for areas and volumes to stay in the range of `f64`.
    #[error("{parameter} is {value}; give a length from 1e-90 to 1e90")]
    Length {
        /// The parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
    },
    /// A fraction outside its range.
    #[error("{parameter} is {value}; give a number from 0 to 1")]
    Fraction {
        /// The parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
    },
    /// The tube of a torus reaches its axis.
    #[error(
        "the tube's radius {minor} is not less than the ring's radius {major}, so that the torus would cut itself; make the tube thinner"
    )]
    TorusCutsItself {
        /// The ring's radius.
        major: f64,
        /// The tube's radius.
        minor: f64,
    },
    /// Too few segments for the surface to be one.
    #[error("{parameter} is {value}; give at least {least}")]
    TooFewSegments {
        /// The parameter.
        parameter: &'static str,
        /// Its value.
        value: u32,
        /// The least that works.
        least: u32,
    },
    /// More faces than [`MOST_PRIMITIVE_FACES`].
    #[error("{faces} faces would be made; use fewer segments, so that there are at most {MOST_PRIMITIVE_FACES}")]
    TooManyFaces {
        /// How many it would be.
        faces: u64,
    },
    /// The parts do not make a mesh: a fault of this crate.
    #[error("the primitive is no mesh: {0}; please report this")]
    Mesh(#[from] MeshError),
}

fn check_length(parameter: &'static str, value: f64) -> Result<(), PrimitiveError> {
    if (1e-90..=1e90).contains(&value) { Ok(()) } else { Err(PrimitiveError::Length { parameter, value }) }
}

fn check_fraction(parameter: &'static str, value: f64) -> Result<(), PrimitiveError> {
    if (0.0..=1.0).contains(&value) { Ok(()) } else { Err(PrimitiveError::Fraction { parameter, value }) }
}

fn check_segments(parameter: &'static str, value: u32, least: u32) -> Result<(), PrimitiveError> {
    if value >= least { Ok(()) } else { Err(PrimitiveError::TooFewSegments { parameter, value, least }) }
}

/// `patches` grids of `across` × `down` cells of two triangles.
fn check_faces(patches: u64, across: u32, down: u32) -> Result<(), PrimitiveError> {
    // Two 32-bit numbers and a small factor stay within 67 bits; saturation is as good as any number beyond the bound.
    let faces = (2 * patches).saturating_mul(u64::from(across) * u64::from(down));
    if faces <= MOST_PRIMITIVE_FACES { Ok(()) } else { Err(PrimitiveError::TooManyFaces { faces }) }
}

fn build(positions: Vec<DVec3>, triangles: &[[u32; 3]]) -> Result<Mesh, PrimitiveError> {
    Ok(Mesh::from_triangles(positions, triangles)?)
}

fn build_textured(positions: Vec<DVec3>, triangles: &[[u32; 3]], coordinates: Vec<DVec2>) -> Result<Mesh, PrimitiveError> {
    Ok(Mesh::from_triangles(positions, triangles)?.with_texture_coordinates(coordinates)?)
}

#[cfg(test)]
mod tests;
