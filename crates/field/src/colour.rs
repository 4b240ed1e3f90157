//! Colours on a surface.

use glam::{DVec3, Vec3, Vec4};
use pelage_mesh::{HalfEdge, Mesh};

use crate::scalar::{mix, places_along};
use crate::{FieldError, Image, ScalarField};

/// A colour at each vertex, in linear light with the primaries of Rec. 709 (those of sRGB); 0 to 1 for what a surface reflects.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourField {
    values: Vec<Vec3>,
}

impl ColourField {
    /// Takes linear colours as they are, one for each vertex.
    ///
    /// # Errors
    /// Where one is not finite.
    pub fn new(values: Vec<Vec3>) -> Result<Self, FieldError> {
        values.iter().position(|value| !value.is_finite()).map_or(Ok(Self { values }), |vertex| Err(FieldError::NotFinite { vertex }))
    }

    /// The same linear colour everywhere.
    ///
    /// # Errors
    /// Where it is not finite.
    pub fn constant(mesh: &Mesh, colour: Vec3) -> Result<Self, FieldError> {
        Self::new(vec![colour; mesh.positions().len()])
    }

    /// From `from` at the model's first extent along a direction to `to` at its last, mixed in linear light; a model flat across the direction has `from`.
    ///
    /// # Errors
    /// Where the direction is zero, a number is not finite, or the mesh has no faces.
    pub fn ramp(mesh: &Mesh, direction: DVec3, from: Vec3, to: Vec3) -> Result<Self, FieldError> {
        let colour = |t| Vec3::new(mix(from.x, to.x, t), mix(from.y, to.y, t), mix(from.z, to.z, t));
        Self::new(places_along(mesh, direction)?.into_iter().map(colour).collect())
    }

    /// The colour of an image at each vertex, and its alpha as an amount from 0 to 1, which fur lengths may be scaled by (N5).
    ///
    /// It is looked up at each corner's coordinates, in linear light, and averaged over the corners at a vertex, so that at a texture seam both sides count. Colour is
    /// not weighted by alpha, which says nothing of how opaque a pixel is. Unreferenced vertices are black with alpha 0.
    ///
    /// # Errors
    /// Where the mesh has no texture coordinates.
    pub fn from_image(mesh: &Mesh, image: &Image<'_>) -> Result<(Self, ScalarField), FieldError> {
        let coordinates = mesh.texture_coordinates().ok_or(FieldError::NoTextureCoordinates)?;
        Self::from_samples(mesh, |corner| image.sample(coordinates[corner.index()]))
    }

    /// A colour and an amount for each face corner, the half-edge that starts there, averaged over the corners at a vertex. Unreferenced vertices are black with amount 0.
    ///
    /// # Errors
    /// Where one is not finite.
    pub fn from_corners(mesh: &Mesh, mut colour: impl FnMut(HalfEdge<'_, Mesh>) -> Vec4) -> Result<(Self, ScalarField), FieldError> {
        Self::from_samples(mesh, |corner| colour(corner).to_array().map(f64::from))
    }

    fn from_samples(mesh: &Mesh, mut sample: impl FnMut(HalfEdge<'_, Mesh>) -> [f64; 4]) -> Result<(Self, ScalarField), FieldError> {
        let count = mesh.positions().len();
        let (mut colours, mut amounts) = (vec![Vec3::ZERO; count], vec![0.0; count]);
        for vertex in mesh.vertices() {
            let (mut sum, mut count) = ([0.0; 4], 0.0);
            for corner in vertex.leaving() {
                let sample = sample(corner);
                (0..4).for_each(|k| sum[k] += sample[k]);
                count += 1.0;
            }
            if count > 0.0 {
                let [red, green, blue, amount] = sum.map(|channel| (channel / count) as f32);
                (colours[vertex.index()], amounts[vertex.index()]) = (Vec3::new(red, green, blue), amount);
            }
        }
        Ok((Self::new(colours)?, ScalarField::new(amounts)?))
    }

    /// The mesh's own colours, and their alpha as an amount.
    ///
    /// # Errors
    /// Where it has none.
    pub fn of_vertices(mesh: &Mesh) -> Result<(Self, ScalarField), FieldError> {
        let colours = mesh.colours().ok_or(FieldError::NoColours)?;
        Ok((Self::new(colours.iter().map(|c| c.truncate()).collect())?, ScalarField::new(colours.iter().map(|c| c.w).collect())?))
    }

    /// The colours.
    pub fn values(&self) -> &[Vec3] {
        &self.values
    }

    /// Each colour replaced by a function of it.
    ///
    /// # Errors
    /// Where the function gives a number that is not finite.
    pub fn map(&self, function: impl FnMut(Vec3) -> Vec3) -> Result<Self, FieldError> {
        Self::new(self.values.iter().copied().map(function).collect())
    }

    /// Each colour times a number.
    ///
    /// # Errors
    /// Where the fields are not of one mesh, or a product is not finite.
    pub fn times(&self, amounts: &ScalarField) -> Result<Self, FieldError> {
        if self.values.len() != amounts.values().len() {
            return Err(FieldError::Length { values: amounts.values().len(), expected: self.values.len() });
        }
        Self::new(self.values.iter().zip(amounts.values()).map(|(&colour, &amount)| colour * amount).collect())
    }

    /// From this field's colours to another's as `amounts` go from 0 to 1, in linear light; amounts beyond are brought to the nearer end.
    ///
    /// # Errors
    /// Where the fields are not of one mesh.
    pub fn mixed(&self, other: &Self, amounts: &ScalarField) -> Result<Self, FieldError> {
        let expected = self.values.len();
        for values in [other.values.len(), amounts.values().len()] {
            if values != expected {
                return Err(FieldError::Length { values, expected });
            }
        }
        let pairs = self.values.iter().zip(&other.values).zip(amounts.values());
        // Exact at both ends.
        Self::new(pairs.map(|((&a, &b), &t)| a * (1.0 - t.clamp(0.0, 1.0)) + b * t.clamp(0.0, 1.0)).collect())
    }

    /// A number of each colour.
    ///
    /// # Errors
    /// Where the function gives a number that is not finite.
    pub fn measured(&self, function: impl FnMut(Vec3) -> f32) -> Result<ScalarField, FieldError> {
        ScalarField::new(self.values.iter().copied().map(function).collect())
    }

    /// How many bytes it holds, for a cache to count.
    pub fn byte_size(&self) -> usize {
        size_of_val(self.values.as_slice())
    }
}
