//! Numbers on a surface.

use glam::DVec3;
use pelage_mesh::{Mesh, Vertex, unit};

use crate::FieldError;

/// A finite number at each vertex: length, density, any amount.
#[derive(Clone, Debug, PartialEq)]
pub struct ScalarField {
    values: Vec<f32>,
}

impl ScalarField {
    /// Takes values as they are, one for each vertex.
    ///
    /// # Errors
    /// Where one is not finite.
    pub fn new(values: Vec<f32>) -> Result<Self, FieldError> {
        values.iter().position(|value| !value.is_finite()).map_or(Ok(Self { values }), |vertex| Err(FieldError::NotFinite { vertex }))
    }

    /// The same value everywhere.
    ///
    /// # Errors
    /// Where it is not finite.
    pub fn constant(mesh: &Mesh, value: f32) -> Result<Self, FieldError> {
        Self::new(vec![value; mesh.positions().len()])
    }

    /// From `from` at the model's first extent along a direction to `to` at its last, linearly; a model flat across the direction has `from`.
    ///
    /// # Errors
    /// Where the direction is zero, a number is not finite, or the mesh has no faces.
    pub fn ramp(mesh: &Mesh, direction: DVec3, from: f32, to: f32) -> Result<Self, FieldError> {
        Self::new(places_along(mesh, direction)?.into_iter().map(|place| mix(from, to, place)).collect())
    }

    /// The values.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// Each value replaced by a function of it.
    ///
    /// # Errors
    /// Where the function gives a number that is not finite.
    pub fn map(&self, function: impl FnMut(f32) -> f32) -> Result<Self, FieldError> {
        Self::new(self.values.iter().copied().map(function).collect())
    }

    /// A function of this field's value and another's at each vertex.
    ///
    /// # Errors
    /// Where the fields are not of one mesh, or the function gives a number that is not finite.
    pub fn zip(&self, other: &Self, mut function: impl FnMut(f32, f32) -> f32) -> Result<Self, FieldError> {
        if self.values.len() != other.values.len() {
            return Err(FieldError::Length { values: other.values.len(), expected: self.values.len() });
        }
        Self::new(self.values.iter().zip(&other.values).map(|(&a, &b)| function(a, b)).collect())
    }

    /// A function of three fields' values at each vertex.
    ///
    /// # Errors
    /// As [`ScalarField::zip`].
    pub fn zip_with(&self, second: &Self, third: &Self, mut function: impl FnMut(f32, f32, f32) -> f32) -> Result<Self, FieldError> {
        let mut thirds = third.values.iter();
        if third.values.len() != self.values.len() {
            return Err(FieldError::Length { values: third.values.len(), expected: self.values.len() });
        }
        self.zip(second, |a, b| function(a, b, thirds.next().copied().unwrap_or_default()))
    }

    /// The sum of two fields.
    ///
    /// # Errors
    /// As [`ScalarField::zip`].
    pub fn plus(&self, other: &Self) -> Result<Self, FieldError> {
        self.zip(other, |a, b| a + b)
    }

    /// The difference of two fields.
    ///
    /// # Errors
    /// As [`ScalarField::zip`].
    pub fn minus(&self, other: &Self) -> Result<Self, FieldError> {
        self.zip(other, |a, b| a - b)
    }

    /// The product of two fields.
    ///
    /// # Errors
    /// As [`ScalarField::zip`].
    pub fn times(&self, other: &Self) -> Result<Self, FieldError> {
        self.zip(other, |a, b| a * b)
    }

    /// Every value times a factor.
    ///
    /// # Errors
    /// Where that is not finite.
    pub fn scaled(&self, factor: f32) -> Result<Self, FieldError> {
        self.map(|value| value * factor)
    }

    /// Whether the field has a value for each vertex of a mesh.
    pub(crate) fn check(&self, mesh: &Mesh) -> Result<(), FieldError> {
        let (values, expected) = (self.values.len(), mesh.positions().len());
        if values == expected { Ok(()) } else { Err(FieldError::Length { values, expected }) }
    }

    /// Every value brought between two bounds; `least` wins where they cross.
    #[must_use]
    pub fn clamped(&self, least: f32, most: f32) -> Self {
        Self { values: self.values.iter().map(|value| value.min(most).max(least)).collect() }
    }

    /// How many bytes it holds, for a cache to count.
    pub fn byte_size(&self) -> usize {
        size_of_val(self.values.as_slice())
    }
}

/// (1 − t) a + t b, exact at both ends.
pub(crate) fn mix(a: f32, b: f32, t: f64) -> f32 {
    ((1.0 - t) * f64::from(a) + t * f64::from(b)) as f32
}

/// Where each vertex lies between the model's first and last extent along a direction, 0 to 1; unreferenced vertices are brought to the nearer end.
pub(crate) fn places_along(mesh: &Mesh, direction: DVec3) -> Result<Vec<f64>, FieldError> {
    let axis = unit(direction);
    if axis == DVec3::ZERO {
        return Err(FieldError::NoDirection(direction));
    }
    let along = |vertex: Vertex<'_, Mesh>| vertex.position().dot(axis);
    let referenced = mesh.vertices().filter(|vertex| vertex.is_referenced()).map(along);
    let (least, most) = referenced.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), x| (least.min(x), most.max(x)));
    if least > most {
        return Err(FieldError::NoSurface);
    }
    let extent = most - least;
    Ok(mesh.vertices().map(|v| if extent > 0.0 { ((along(v) - least) / extent).clamp(0.0, 1.0) } else { 0.0 }).collect())
}
