//! The flat patch.

use glam::DVec3;

use super::grid::Grid;
use super::{PrimitiveError, build_textured, check_faces, check_length, check_segments};
use crate::Mesh;

/// A rectangle in the xz plane around the origin, facing up (+y): `width` along x and `depth` along z, in model units, cut into
/// `width_segments` × `depth_segments` cells of two triangles.
///
/// Texture coordinates are 0 to 1, u along +x and v along −z, so that a picture is upright seen from above with +z towards the viewer.
///
/// # Errors
/// Where a length is outside 1e-90 to 1e90, a count of segments is 0, or there would be more than [`MOST_PRIMITIVE_FACES`](crate::MOST_PRIMITIVE_FACES).
pub fn plane(width: f64, depth: f64, width_segments: u32, depth_segments: u32) -> Result<Mesh, PrimitiveError> {
    check_length("width", width)?;
    check_length("depth", depth)?;
    check_segments("width_segments", width_segments, 1)?;
    check_segments("depth_segments", depth_segments, 1)?;
    check_faces(1, width_segments, depth_segments)?;
    let along = |size: f64, k: u32, segments: u32| size * (f64::from(k) / f64::from(segments) - 0.5);
    let mut positions = Vec::with_capacity((width_segments as usize + 1) * (depth_segments as usize + 1));
    for j in 0..=depth_segments {
        for i in 0..=width_segments {
            positions.push(DVec3::new(along(width, i, width_segments), 0.0, -along(depth, j, depth_segments)));
        }
    }
    let mut grid = Grid::default();
    // Diagonals alternate, so that no direction is favoured.
    grid.add(width_segments, depth_segments, |i, j| j * (width_segments + 1) + i, |i, j| (i + j).is_multiple_of(2));
    build_textured(positions, &grid.triangles, grid.coordinates)
}
