//! Colours on a surface.

use glam::{DVec3, Vec3};
use pelage_mesh::Mesh;

use crate::image::Image;
use crate::scalar::{mix, places_along};
use crate::{FieldError, ScalarField};

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
    /// `pixels` are rows from the top of `width` × `height` pixels, four bytes each: sRGB red, green, blue, and alpha. The image repeats in both
    /// directions; (0, 0) of the texture coordinates is its lower left corner, (1, 1) its upper right. It is looked up between the four pixels around each corner's
    /// coordinates, in linear light, and averaged over the corners at a vertex, so that at a texture seam both sides count. Colour is
    /// not weighted by alpha, which says nothing of how opaque a pixel is. Unreferenced vertices are black with alpha 0.
    ///
    /// # Errors
    /// Where the mesh has no texture coordinates, or the bytes do not fit the size.
    pub fn from_image(mesh: &Mesh, pixels: &[u8], width: u32, height: u32) -> Result<(Self, ScalarField), FieldError> {
        let image = Image::new(pixels, width, height)?;
        let coordinates = mesh.texture_coordinates().ok_or(FieldError::NoTextureCoordinates)?;
        let topology = mesh.topology();
        let (mut colours, mut alphas) = (vec![Vec3::ZERO; topology.vertex_count()], vec![0.0; topology.vertex_count()]);
        for vertex in topology.vertices() {
            let (mut sum, mut count) = ([0.0; 4], 0.0);
            for corner in vertex.leaving() {
                let sample = image.sample(coordinates[corner.index()]);
                (0..4).for_each(|k| sum[k] += sample[k]);
                count += 1.0;
            }
            if count > 0.0 {
                let [red, green, blue, alpha] = sum.map(|channel| (channel / count) as f32);
                (colours[vertex.index()], alphas[vertex.index()]) = (Vec3::new(red, green, blue), alpha);
            }
        }
        Ok((Self::new(colours)?, ScalarField::new(alphas)?))
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

    /// How many bytes it holds, for a cache to count.
    pub fn byte_size(&self) -> usize {
        size_of_val(self.values.as_slice())
    }
}
