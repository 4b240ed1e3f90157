//! Where a ray crosses a face, without gaps between faces.
//!
//! S. Woop, C. Benthin, I. Wald: Watertight Ray/Triangle Intersection, Journal of Computer Graphics Techniques 2(1), 2013: space is sheared so that the ray runs along
//! an axis, and the two faces at an edge ask the same question of it. Where the ray passes through an edge exactly, the answer is that of a ray moved aside by an
//! infinitesimal (H. Edelsbrunner, E. Mücke: Simulation of Simplicity, ACM Transactions on Graphics 9(1), 1990), so that exactly one of them is hit.

use std::cmp::Ordering;

use glam::{DVec2, DVec3};

use crate::FaceId;

/// A ray in the frame of the boxes, sheared.
pub(super) struct Shear {
    origin: DVec3,
    inverse: DVec3,
    /// The axis along which the ray is longest, last; the others so that windings are kept.
    axes: [usize; 3],
    slope: DVec2,
    stretch: f64,
}

/// Where a ray crosses a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    pub(super) face: FaceId,
    /// Along the ray, in units of the frame; negative behind its start.
    pub(super) distance: f64,
    pub(super) barycentrics: DVec3,
    /// Whether the face winds anticlockwise as the ray sees it.
    pub(super) faces_ray: bool,
}

impl Shear {
    /// `direction` is a unit vector.
    pub(super) fn new(origin: DVec3, direction: DVec3) -> Self {
        let size = direction.abs();
        let z = if size.x >= size.y && size.x >= size.z {
            0
        } else if size.y >= size.z {
            1
        } else {
            2
        };
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        let (x, y) = if direction[z] < 0.0 { (y, x) } else { (x, y) };
        let slope = DVec2::new(direction[x], direction[y]) / direction[z];
        Self { origin, inverse: direction.recip(), axes: [x, y, z], slope, stretch: 1.0 / direction[z] }
    }

    pub(super) fn origin(&self) -> DVec3 {
        self.origin
    }

    /// How far along the ray it enters a box; infinite if it does not, 0 if it starts inside.
    #[inline]
    pub(super) fn entry(&self, low: DVec3, high: DVec3) -> f64 {
        let (a, b) = ((low - self.origin) * self.inverse, (high - self.origin) * self.inverse);
        // `min` and `max` pass NaN over, which is a ray along a side of the padded box: it meets nothing of what is inside.
        let (enter, leave) = (a.min(b).max_element().max(0.0), a.max(b).min_element());
        if enter <= leave * (1.0 + 8.0 * f64::EPSILON) { enter * (1.0 - 8.0 * f64::EPSILON) } else { f64::INFINITY }
    }

    /// Where a point lies when the ray starts at the origin and runs along z; the same for every face that has it as a corner.
    #[inline]
    fn project(&self, point: DVec3) -> (DVec2, f64) {
        let arm = point - self.origin;
        let [x, y, z] = self.axes.map(|axis| arm[axis]);
        (DVec2::new(x, y) - self.slope * z, self.stretch * z)
    }

    #[inline]
    pub(super) fn crossing(&self, face: FaceId, corners: [DVec3; 3]) -> Option<Crossing> {
        let [(a, za), (b, zb), (c, zc)] = corners.map(|corner| self.project(corner));
        let sides = [passes_left(b, c), passes_left(c, a), passes_left(a, b)];
        let side = sides[0];
        if side == Ordering::Equal || sides[1] != side || sides[2] != side {
            return None;
        }
        let weights = DVec3::new(b.perp_dot(c), c.perp_dot(a), a.perp_dot(b)).abs();
        let sum = weights.element_sum();
        if !(sum > 0.0 && sum < f64::INFINITY) {
            return None;
        }
        let barycentrics = weights / sum;
        // Rounding in a face seen on edge must not bring the hit off the face.
        let along = barycentrics.dot(DVec3::new(za, zb, zc)).clamp(za.min(zb).min(zc), za.max(zb).max(zc));
        Some(Crossing { face, distance: along, barycentrics, faces_ray: side == Ordering::Less })
    }
}

/// On which side of the line from `a` to `b` the origin lies: greater on the left. Never equal but where the two are one; opposite for the line back.
#[inline]
fn passes_left(a: DVec2, b: DVec2) -> Ordering {
    let area = a.perp_dot(b);
    // Moved by (ε, ε²), ε infinitesimal.
    let moved = DVec2::new(a.y - b.y, b.x - a.x);
    let sign = [area, moved.x, moved.y].into_iter().find(|&sign| sign != 0.0).unwrap_or(0.0);
    sign.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
}
