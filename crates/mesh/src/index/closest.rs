//! The closest point of a face.

use glam::DVec3;

use crate::{FaceId, Mesh, SurfacePoint};

/// The point of a surface that is closest to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Where on the surface.
    pub point: SurfacePoint,
    /// Where in space, in model units.
    pub position: DVec3,
    /// How far from what was asked, in model units.
    pub distance: f64,
}

impl Nearest {
    pub(super) fn new(mesh: &Mesh, face: FaceId, barycentrics: DVec3, asked: DVec3) -> Self {
        let point = SurfacePoint { face, barycentrics };
        let position = point.position(mesh);
        let apart = asked - position;
        let largest = apart.abs().max_element();
        // The square may be out of range where the length is not.
        let distance = if largest > 0.0 { largest * (apart / largest).length() } else { 0.0 };
        Self { point, position, distance }
    }

    /// Nearer, or as near on a lower face.
    pub(super) fn is_before(&self, other: &Self) -> bool {
        (self.distance, self.point.face) < (other.distance, other.point.face)
    }
}

/// The barycentric coordinates of the point of a triangle that is closest to `point`: the best of the foot of the perpendicular, if it is inside, and of the three
/// sides. Each is a point of the triangle, so that rounding in a needle can make the answer a little too far but never wrong.
pub(super) fn on_triangle(point: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let (ab, bc, ca) = (side(point, a, b), side(point, b, c), side(point, c, a));
    let on_sides = [DVec3::new(1.0 - ab, ab, 0.0), DVec3::new(0.0, 1.0 - bc, bc), DVec3::new(ca, 0.0, 1.0 - ca)];
    let distance = |weights: &DVec3| (a * weights.x + b * weights.y + c * weights.z).distance_squared(point);
    let mut best = (distance(&on_sides[0]), on_sides[0]);
    for weights in on_sides.into_iter().skip(1).chain(foot(point, [a, b, c])) {
        let apart = distance(&weights);
        if apart < best.0 {
            best = (apart, weights);
        }
    }
    best.1
}

/// How far along the way from `a` to `b` the closest point lies, 0 to 1.
fn side(point: DVec3, a: DVec3, b: DVec3) -> f64 {
    let along = b - a;
    let squared = along.length_squared();
    if squared > 0.0 { ((point - a).dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 }
}

/// The foot of the perpendicular on the plane, if it lies in the triangle.
fn foot(point: DVec3, [a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let normal = (b - a).cross(c - a);
    let (from_a, from_b, from_c) = (a - point, b - point, c - point);
    let weights = DVec3::new(from_b.cross(from_c).dot(normal), from_c.cross(from_a).dot(normal), from_a.cross(from_b).dot(normal));
    let sum = weights.element_sum();
    (weights.min_element() >= 0.0 && sum > 0.0 && sum < f64::INFINITY).then(|| weights / sum)
}
