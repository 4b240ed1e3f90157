//! Fur combed by hand: which way and how far it leans at each vertex, and how long it is, changed stroke by stroke (L21).

mod brush;
mod stroke;
mod tools;

use glam::DVec3;
use pelage_mesh::{Mesh, unit};

use crate::transport::tangent_part;
use crate::{DirectionField, FieldError, ScalarField};

pub use brush::Brush;
pub use stroke::{BrushStroke, Tool};

/// The furthest that fur is combed down, in radians: 80°. Beyond it, shells lie on each other.
pub const MOST_SLANT: f64 = 80.0 * std::f64::consts::PI / 180.0;

/// How fur is combed, vertex by vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct Comb {
    /// Tangent vectors, in model coordinates: the way that the fur leans, as long as the angle from the normal in radians.
    leans: Vec<DVec3>,
    /// Factors of the fur's length.
    lengths: Vec<f64>,
}

impl Comb {
    /// Fur that leans along a field by one angle in radians, up to [`MOST_SLANT`], or that stands straight up without; of its full length.
    ///
    /// # Errors
    /// Where the field is of another mesh, or the angle is not finite.
    pub fn new(mesh: &Mesh, directions: Option<&DirectionField>, slant: f64) -> Result<Self, FieldError> {
        let vertices = mesh.positions().len();
        if !slant.is_finite() {
            return Err(FieldError::NotFinite { vertex: 0 });
        }
        let slant = slant.clamp(-MOST_SLANT, MOST_SLANT);
        let leans = match directions {
            Some(field) if field.vectors().len() != vertices => {
                return Err(FieldError::Length { values: field.vectors().len(), expected: vertices });
            }
            Some(field) => field.vectors().iter().map(|&direction| direction * slant).collect(),
            None => vec![DVec3::ZERO; vertices],
        };
        Ok(Self { leans, lengths: vec![1.0; vertices] })
    }

    /// Adds a lean everywhere, as the wind does: its part along the surface, as many radians long (N4).
    ///
    /// # Errors
    /// Where it is not finite, or the mesh is another.
    pub fn add(&mut self, mesh: &Mesh, lean: DVec3) -> Result<(), FieldError> {
        if mesh.positions().len() != self.leans.len() {
            return Err(FieldError::Length { values: self.leans.len(), expected: mesh.positions().len() });
        }
        if !lean.is_finite() {
            return Err(FieldError::NoDirection(lean));
        }
        for (own, normal) in self.leans.iter_mut().zip(mesh.vertex_normals()) {
            *own = bounded(*own + tangent_part(lean, normal));
        }
        Ok(())
    }

    /// Tangent vectors, as long as the angle from the normal in radians.
    pub fn leans(&self) -> &[DVec3] {
        &self.leans
    }

    /// Which way the fur lies; where it stands up, completed from its surroundings ([`DirectionField::from_vectors`]).
    ///
    /// # Errors
    /// Where the mesh is another or has no faces.
    pub fn directions(&self, mesh: &Mesh) -> Result<DirectionField, FieldError> {
        DirectionField::from_vectors(mesh, &self.leans)
    }

    /// The angle from the normal, in radians, along [`Comb::directions`].
    ///
    /// # Errors
    /// None that can be reached: all angles are finite.
    pub fn slants(&self) -> Result<ScalarField, FieldError> {
        ScalarField::new(self.leans.iter().map(|lean| lean.length() as f32).collect())
    }

    /// Factors of the fur's length.
    ///
    /// # Errors
    /// Where so much was puffed up that a length is not finite.
    pub fn lengths(&self) -> Result<ScalarField, FieldError> {
        ScalarField::new(self.lengths.iter().map(|&length| length as f32).collect())
    }
}

/// A lean that is no further down than may be.
fn bounded(lean: DVec3) -> DVec3 {
    if lean.length() > MOST_SLANT { unit(lean) * MOST_SLANT } else { lean }
}
