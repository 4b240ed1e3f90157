//! The torus.

use std::f64::consts::TAU;

use glam::DVec3;

use super::grid::Grid;
use super::{PrimitiveError, build_textured, check_faces, check_length, check_segments};
use crate::Mesh;

/// A torus around the y axis: the middle of its tube runs at `major` from the axis, and the tube's radius is `minor`, in model units;
/// `major_segments` around the axis and `minor_segments` around the tube.
///
/// Texture coordinates: u once around the axis, anticlockwise seen from above; v once around the tube, from its inmost line over the bottom and the outside to the top.
///
/// # Errors
/// Where a length is outside 1e-90 to 1e90, `minor` is not less than `major`, there are fewer than 3 segments, or there would be more faces than
/// [`MOST_PRIMITIVE_FACES`](crate::MOST_PRIMITIVE_FACES).
pub fn torus(major: f64, minor: f64, major_segments: u32, minor_segments: u32) -> Result<Mesh, PrimitiveError> {
    check_length("major", major)?;
    check_length("minor", minor)?;
    if minor >= major {
        return Err(PrimitiveError::TorusCutsItself { major, minor });
    }
    check_segments("major_segments", major_segments, 3)?;
    check_segments("minor_segments", minor_segments, 3)?;
    check_faces(1, major_segments, minor_segments)?;
    let turn = |k: u32, segments: u32| libm::sincos(TAU * f64::from(k) / f64::from(segments));
    let mut positions = Vec::with_capacity(major_segments as usize * minor_segments as usize);
    for j in 0..minor_segments {
        let (sin_tube, cos_tube) = turn(j, minor_segments);
        let (from_axis, height) = (major - minor * cos_tube, -minor * sin_tube);
        for i in 0..major_segments {
            let (sin_ring, cos_ring) = turn(i, major_segments);
            positions.push(DVec3::new(from_axis * cos_ring, height, -from_axis * sin_ring));
        }
    }
    let vertex = |i: u32, j: u32| (j % minor_segments) * major_segments + i % major_segments;
    let mut grid = Grid::default();
    grid.add(major_segments, minor_segments, vertex, |i, j| (i + j).is_multiple_of(2));
    build_textured(positions, &grid.triangles, grid.coordinates)
}
