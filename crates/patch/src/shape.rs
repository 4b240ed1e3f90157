//! The intrinsic shape of each face: laid out flat, in tiles, with the weights of its sides.

use glam::{DVec2, DVec3};
use pelage_mesh::{Face, FaceId, Mesh};

/// Least slack of the triangle inequality in the weights, as a fraction of the face's mean side: intrinsic mollification (Sharp and Crane
/// 2020, section 4.5), which bounds the cotangents of slivers.
const MOLLIFICATION: f64 = 1e-6;
/// A face is *degenerate* where twice its area is at most this fraction of its longest side squared: its normal is then rounding noise.
const DEGENERATE: f64 = 1e-10;

/// A face in its own plane, in tile units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FaceShape {
    /// Corners: the first at the origin, the second on the positive x axis, the third above it, so that the face winds anticlockwise.
    pub(crate) corners: [DVec2; 3],
    /// Half the cotangent of the angle at each corner, of the mollified face: the weight of the side opposite.
    pub(crate) weights: [f64; 3],
    /// Without area, so that orientation, stretch and turning mean nothing.
    pub(crate) degenerate: bool,
}

/// Every face's shape.
pub(crate) fn face_shapes(mesh: &Mesh, tile_side: f64) -> Vec<FaceShape> {
    let sides: Vec<[DVec3; 2]> = mesh.faces().map(|face| sides_in_tiles(face, tile_side)).collect();
    let total: f64 = sides.iter().map(|[u, v]| u.length() + v.length() + u.distance(*v)).sum();
    // Keeps faces that are a single point from dividing by zero.
    let floor = if total > 0.0 { 1e-12 * total / (3 * sides.len()) as f64 } else { 1.0 };
    sides.iter().map(|&[u, v]| FaceShape::new(u, v, floor)).collect()
}

/// The area of each face in tiles, and the flat frame (x, y) of the same layout in space.
pub(crate) fn face_axes(mesh: &Mesh, face: FaceId, tile_side: f64) -> [DVec3; 2] {
    let [u, v] = sides_in_tiles(mesh.face(face), tile_side);
    let x = u.normalize_or_zero();
    // Gram and Schmidt, twice over, as once loses the small angle of a needle.
    let y = (v - x * v.dot(x)).normalize_or_zero();
    [x, (y - x * y.dot(x)).normalize_or_zero()]
}

fn sides_in_tiles(face: Face<'_, Mesh>, tile_side: f64) -> [DVec3; 2] {
    let [a, b, c] = face.positions();
    [(b - a) / tile_side, (c - a) / tile_side]
}

impl FaceShape {
    fn new(u: DVec3, v: DVec3, floor: f64) -> Self {
        let doubled_area = u.cross(v).length();
        let lengths = [u.distance(v), v.length(), u.length()];
        let longest = lengths.into_iter().fold(0.0, f64::max);
        let base = lengths[2];
        let third = if base > 0.0 { DVec2::new(u.dot(v) / base, doubled_area / base) } else { DVec2::new(0.0, lengths[1]) };
        Self {
            corners: [DVec2::ZERO, DVec2::new(base, 0.0), third],
            weights: half_cotangents(mollified(lengths, floor)),
            degenerate: doubled_area <= DEGENERATE * longest * longest,
        }
    }

    /// The middle of the face.
    pub(crate) fn centre(&self) -> DVec2 {
        (self.corners[0] + self.corners[1] + self.corners[2]) / 3.0
    }

    /// In square tiles.
    pub(crate) fn area(&self) -> f64 {
        0.5 * self.corners[1].x * self.corners[2].y
    }

    /// The unit direction from corner `k` to the next; x where they coincide.
    pub(crate) fn side_direction(&self, k: usize) -> DVec2 {
        (self.corners[(k + 1) % 3] - self.corners[k]).try_normalize().unwrap_or(DVec2::X)
    }
}

/// Lengthens all sides by the least amount that gives every triangle inequality its slack.
fn mollified(lengths: [f64; 3], floor: f64) -> [f64; 3] {
    let total: f64 = lengths.iter().sum();
    let slack = (MOLLIFICATION * total / 3.0).max(floor);
    let longest = lengths.into_iter().fold(0.0, f64::max);
    let missing = (slack - (total - 2.0 * longest)).max(0.0);
    lengths.map(|l| l + missing)
}

/// From side lengths alone, the side opposite corner *k* being *k*; the area by Kahan's form of Heron's formula, which does not cancel.
fn half_cotangents(lengths: [f64; 3]) -> [f64; 3] {
    let mut sorted = lengths;
    sorted.sort_by(f64::total_cmp);
    let [c, b, a] = sorted;
    let four_areas = ((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c))).max(0.0).sqrt();
    let squares = lengths.map(|l| l * l);
    let sum: f64 = squares.iter().sum();
    squares.map(|opposite| 0.5 * (sum - 2.0 * opposite) / four_areas)
}
