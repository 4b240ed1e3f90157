//! A mesh at another place, turned, and of another size.

use glam::{DMat3, DVec3};

use crate::{Mesh, MeshError};

/// Scaled, then turned, then moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// How many times as large along x, y and z; a negative number mirrors.
    pub scale: DVec3,
    /// How far it is turned about x, then y, then z, in radians, anticlockwise seen from the axis's tip.
    pub turn: DVec3,
    /// How far it is moved, in model units.
    pub shift: DVec3,
}

impl Default for Transform {
    /// All stays as it is.
    fn default() -> Self {
        Self { scale: DVec3::ONE, turn: DVec3::ZERO, shift: DVec3::ZERO }
    }
}

impl Transform {
    /// Scale and turn together.
    pub fn matrix(&self) -> DMat3 {
        let [about_x, about_y, about_z] = self.turn.to_array().map(libm::sincos).map(|(sin, cos)| (cos, sin));
        let about_x = DMat3::from_cols(DVec3::X, DVec3::new(0.0, about_x.0, about_x.1), DVec3::new(0.0, -about_x.1, about_x.0));
        let about_y = DMat3::from_cols(DVec3::new(about_y.0, 0.0, -about_y.1), DVec3::Y, DVec3::new(about_y.1, 0.0, about_y.0));
        let about_z = DMat3::from_cols(DVec3::new(about_z.0, about_z.1, 0.0), DVec3::new(-about_z.1, about_z.0, 0.0), DVec3::Z);
        about_z * about_y * about_x * DMat3::from_diagonal(self.scale)
    }
}

/// Why a mesh cannot be transformed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TransformError {
    /// A scale of 0 makes the mesh flat, and faces without area of it.
    #[error("the scale is {0}, which makes the model flat; give numbers other than 0")]
    Flat(DVec3),
    /// A number is NaN or infinite, or positions leave the range of numbers.
    #[error("the transform gives no place: {0}; give finite numbers, and smaller ones")]
    Mesh(#[from] MeshError),
    /// A number is NaN or infinite.
    #[error("scale {scale}, turn {turn} and shift {shift} are not all finite; mend the numbers")]
    NotFinite {
        /// The scale.
        scale: DVec3,
        /// The turn.
        turn: DVec3,
        /// The shift.
        shift: DVec3,
    },
}

/// The mesh scaled, turned and moved. Where that mirrors it, faces are wound the other way, so that outside stays outside; their first corner stays the first.
///
/// # Errors
/// Where a scale is 0, or a number or a place is not finite.
///
/// ```
/// use glam::DVec3;
/// use pelage_mesh::{Transform, sphere, transform};
///
/// let ball = sphere(1.0, 4)?;
/// let mirrored = transform(&ball, &Transform { scale: DVec3::new(-2.0, 1.0, 1.0), ..Transform::default() })?;
/// assert!((mirrored.signed_volume() - 2.0 * ball.signed_volume()).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn transform(mesh: &Mesh, by: &Transform) -> Result<Mesh, TransformError> {
    let Transform { scale, turn, shift } = *by;
    if !(scale.is_finite() && turn.is_finite() && shift.is_finite()) {
        return Err(TransformError::NotFinite { scale, turn, shift });
    }
    if scale.to_array().contains(&0.0) {
        return Err(TransformError::Flat(scale));
    }
    let matrix = by.matrix();
    let positions = mesh.positions().iter().map(|&p| matrix * p + shift).collect();
    let moved = mesh.with_positions(positions)?;
    Ok(if scale.x.signum() * scale.y.signum() * scale.z.signum() < 0.0 { wound_back(&moved)? } else { moved })
}

/// All faces wound the other way.
fn wound_back(mesh: &Mesh) -> Result<Mesh, MeshError> {
    let triangles: Vec<[u32; 3]> = mesh.topology().triangles().map(|[a, b, c]| [a, c, b]).collect();
    let mut wound = Mesh::from_triangles(mesh.positions().to_vec(), &triangles)?;
    if let Some(coordinates) = mesh.texture_coordinates() {
        wound = wound.with_texture_coordinates(coordinates.as_chunks::<3>().0.iter().flat_map(|&[a, b, c]| [a, c, b]).collect())?;
    }
    match mesh.colours() {
        Some(colours) => wound.with_colours(colours.to_vec()),
        None => Ok(wound),
    }
}
