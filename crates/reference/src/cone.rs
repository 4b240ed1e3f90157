//! Where a ray enters and leaves a piece of hair: the hull of two spheres, a *round cone*.

use glam::DVec3;

use crate::ray::Ray;

/// The part of a ray inside a round cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Span {
    pub(crate) enter: f64,
    pub(crate) leave: f64,
}

/// Where the line of a ray passes through the hull of two spheres.
///
/// The hull is convex and its rim is made of parts of both spheres and of the cone that touches them, all of which lie inside it: so it is entered at the first of
/// what the line meets of them, and left at the last. A point of the line is on the part of the cone that belongs to the hull where the sphere that touches it there
/// is one between the two. All is worked out from the place nearest to the first sphere, so that a far origin costs no digits.
pub(crate) fn span(ray: &Ray, ends: [DVec3; 2], radii: [f64; 2]) -> Option<Span> {
    let shift = (ends[0] - ray.origin).dot(ray.direction);
    let start = ray.at(shift);
    let mut span = Span { enter: f64::INFINITY, leave: f64::NEG_INFINITY };
    for (end, radius) in ends.into_iter().zip(radii) {
        span.take_sphere(start - end, ray.direction, radius);
    }
    span.take_cone(start - ends[0], ray.direction, ends[1] - ends[0], radii);
    (span.enter <= span.leave).then_some(Span { enter: span.enter + shift, leave: span.leave + shift })
}

/// How far along the axis, 0 to 1, the sphere is that touches the hull's rim at a place of it.
pub(crate) fn part_at(place: DVec3, ends: [DVec3; 2], radii: [f64; 2]) -> f64 {
    let (axis, narrowing) = (ends[1] - ends[0], radii[0] - radii[1]);
    let squared = axis.length_squared() - narrowing * narrowing;
    if squared > 0.0 {
        ((place - ends[0]).dot(axis) - narrowing * radii[0]).clamp(0.0, squared) / squared
    } else if radii[0] >= radii[1] {
        // One sphere holds the other.
        0.0
    } else {
        1.0
    }
}

impl Span {
    fn take(&mut self, distance: f64) {
        self.enter = self.enter.min(distance);
        self.leave = self.leave.max(distance);
    }

    fn take_sphere(&mut self, from_centre: DVec3, direction: DVec3, radius: f64) {
        let middle = -from_centre.dot(direction);
        let squared = radius * radius - (from_centre + direction * middle).length_squared();
        if squared >= 0.0 {
            let half = squared.sqrt();
            self.take(middle - half);
            self.take(middle + half);
        }
    }

    /// The cone on which (p·axis)(…) has the touching sphere between the ends: k₂ t² + 2 k₁ t + k₀ = 0 (I. Quilez, *Intersectors*, rounded cone).
    fn take_cone(&mut self, from_first: DVec3, direction: DVec3, axis: DVec3, radii: [f64; 2]) {
        let narrowing = radii[0] - radii[1];
        let squared = axis.length_squared() - narrowing * narrowing;
        if squared <= 0.0 {
            return;
        }
        let (along, slope) = (axis.dot(from_first) - narrowing * radii[0], axis.dot(direction));
        // The distance to the touching sphere's rim, as a quadratic form of the place: |p|² − r₀² − (p·axis − Δr r₀)² / (|axis|² − Δr²).
        let k2 = squared - slope * slope;
        let k1 = squared * direction.dot(from_first) - slope * along;
        let k0 = squared * (from_first.length_squared() - radii[0] * radii[0]) - along * along;
        let discriminant = k1 * k1 - k2 * k0;
        if discriminant < 0.0 {
            return;
        }
        // Both roots without cancellation.
        let sum = -(k1 + discriminant.sqrt().copysign(k1));
        for root in [sum / k2, k0 / sum] {
            let touched = along + slope * root;
            if root.is_finite() && touched > 0.0 && touched < squared {
                self.take(root);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector(range: f64) -> impl Strategy<Value = DVec3> {
        [-range..range, -range..range, -range..range].prop_map(DVec3::from)
    }

    /// How far a place is outside of the hull: the least over the spheres between the two, by trying many and then narrowing down.
    fn outside(place: DVec3, ends: [DVec3; 2], radii: [f64; 2]) -> f64 {
        let at = |t: f64| (place - ends[0].lerp(ends[1], t)).length() - (radii[0] + (radii[1] - radii[0]) * t);
        // The distance is convex in t and the radius linear, so that thirds close in on the least.
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..200 {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if at(a) < at(b) { high = b } else { low = a }
        }
        at(0.0).min(at(1.0)).min(at(0.5 * (low + high)))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn the_rim_is_where_the_hull_begins(
            a in vector(1.0), b in vector(1.0), ra in 0.0..0.5f64, rb in 0.0..0.5f64, from in vector(3.0), toward in vector(1.0),
        ) {
            let direction = (toward - from).normalize();
            let ray = Ray { origin: from, direction, from: 0.0, to: f64::INFINITY };
            match span(&ray, [a, b], [ra, rb]) {
                Some(span) => {
                    for distance in [span.enter, span.leave] {
                        prop_assert!(outside(ray.at(distance), [a, b], [ra, rb]).abs() < 1e-6, "{}", outside(ray.at(distance), [a, b], [ra, rb]));
                    }
                    // Inside between, outside beyond.
                    let inside = ray.at(0.5 * (span.enter + span.leave));
                    prop_assert!(outside(inside, [a, b], [ra, rb]) < 1e-9);
                    prop_assert!(outside(ray.at(span.enter - 0.01), [a, b], [ra, rb]) > -1e-9);
                    prop_assert!(outside(ray.at(span.leave + 0.01), [a, b], [ra, rb]) > -1e-9);
                    let part = part_at(ray.at(span.enter), [a, b], [ra, rb]);
                    let touching = (ray.at(span.enter) - a.lerp(b, part)).length() - (ra + (rb - ra) * part);
                    prop_assert!(touching.abs() < 1e-6, "{touching}");
                }
                None => {
                    for step in 0..400 {
                        prop_assert!(outside(ray.at(f64::from(step) * 0.02), [a, b], [ra, rb]) > -1e-9);
                    }
                }
            }
        }
    }

    #[test]
    fn a_thin_hair_far_away_is_met_at_its_width() {
        let (ends, radii) = ([DVec3::new(0.0, -1.0, 0.0), DVec3::new(0.0, 1.0, 0.0)], [1e-6; 2]);
        for eye in [1.0, 1e3] {
            let ray = |x: f64| Ray { origin: DVec3::new(x, 0.1, eye), direction: DVec3::NEG_Z, from: 0.0, to: f64::INFINITY };
            assert!(span(&ray(0.999_9e-6), ends, radii).is_some() && span(&ray(1.000_1e-6), ends, radii).is_none(), "from {eye}");
        }
    }

    #[test]
    fn along_the_axis_and_without_length() {
        let ray = Ray { origin: DVec3::new(0.0, 0.0, 5.0), direction: DVec3::NEG_Z, from: 0.0, to: f64::INFINITY };
        let met = |ends: [DVec3; 2], radii| span(&ray, ends, radii).map(|span| [span.enter, span.leave]);
        assert_eq!(met([DVec3::Z, DVec3::NEG_Z], [0.5, 0.25]), Some([3.5, 6.25]));
        assert_eq!(met([DVec3::ZERO; 2], [0.5, 0.25]), Some([4.5, 5.5]));
        assert_eq!(met([DVec3::X, DVec3::X], [0.5, 0.25]), None);
        assert_eq!(met([DVec3::ZERO, 0.1 * DVec3::Z], [0.5, 0.1]), Some([4.5, 5.5]), "one holds the other");
    }
}
