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

#[cfg(test)]
mod tests {
    #![allow(clippy::print_stdout, reason = "a test says what it measured")]

    use super::*;

    /// The face over a base of 1 whose apex stands above its middle.
    fn cap(height: f64) -> FaceShape {
        FaceShape::new(DVec3::X, DVec3::new(0.5, height, 0.0), 0.0)
    }

    /// Of caps down to no height at all: weights no larger than a slack of 1e-6 of the mean side leaves, of which only those are changed that have less slack.
    #[test]
    fn caps_are_mollified_at_a_millionth_of_their_mean_side() {
        let mut most = 0.0_f64;
        for height in [1e-2, 1e-4, 1e-6, 1e-8, 0.0_f64] {
            let lengths = [height.hypot(0.5), height.hypot(0.5), 1.0];
            let mean = lengths.iter().sum::<f64>() / 3.0;
            let slack = |[a, b, c]: [f64; 3]| a + b - c;
            let made = mollified(lengths, 0.0);
            let (before, after) = (slack(lengths), slack(made));
            // To rounding, and no more than the least that does it: all sides by the same.
            assert!(after >= 1e-6 * mean * (1.0 - 1e-9), "{height}: {after}");
            let added = [0, 1, 2].map(|k| made[k] - lengths[k]);
            assert!(added.iter().all(|a| (a - (1e-6 * mean - before).max(0.0)).abs() < 1e-15), "{height}: {added:?}");
            assert_eq!(before >= 1e-6 * mean, made == lengths, "what has slack enough keeps every bit");
            // An isosceles triangle with legs l and base b: half the cotangent at the base is b / 4h, and at the apex (h² − b²/4) / 2bh.
            let [leg, _, base] = made;
            let high = ((leg - 0.5 * base) * (leg + 0.5 * base)).sqrt();
            let wanted = [0.25 * base / high, 0.25 * base / high, (high * high - 0.25 * base * base) / (2.0 * base * high)];
            let weights = cap(height).weights;
            // Corners 0 and 1 are at the base, which is the side from the one to the other.
            assert!((0..3).all(|k| (weights[k] - wanted[k]).abs() < 1e-6 * wanted[k].abs()), "{height}: {weights:?} for {wanted:?}");
            most = weights.iter().fold(most, |most, weight| most.max(weight.abs()));
        }
        println!("reached: weights {most:.0} at most");
        // Of a cap without height, base 1, legs ½ (1 + 1e-6 · 4/3): a height of √(⅓ 1e-6).
        assert!(most < 500.0, "{most}");
        // Slivers of the other kind, needles, have slack on their short side alone, and are mollified alike.
        let needle = FaceShape::new(DVec3::X, DVec3::new(1.0, 1e-9, 0.0), 0.0);
        assert!(needle.weights.iter().all(|weight| weight.is_finite() && weight.abs() < 2e6), "{:?}", needle.weights);
        // A face that is one point has the floor's sides.
        let point = FaceShape::new(DVec3::ZERO, DVec3::ZERO, 1e-12);
        assert!(point.weights.iter().all(|weight| weight.is_finite()) && point.degenerate);
    }
}
