//! The one primitive: a ball that rolls along a line and changes its radius on the way, flattened if wanted.

use glam::DVec3;

/// The union of balls along a segment whose radius changes linearly: a capsule where it does not, a ball where the segment has no length.
///
/// Its field is the exact signed distance outside, so its gradient is 1 long: for a point at height *t* along the axis and distance *y* from it
/// the nearest ball is the one at *u* = *t* − *y s* / √(1 − *s*²), *s* being the taper, brought to the ends of the segment (the minimum over *u* of a
/// convex function; Quilez, "Distance functions", gives the same solid as `sdRoundCone`).
///
/// A flattened cone is squeezed along an axis across its own. Distances taken in the unsqueezed space and multiplied by the squeeze never exceed
/// the true distance: the gradient stays between the squeeze and 1, so that a step of Newton's method or a Lipschitz bound can lean on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cone {
    from: DVec3,
    /// Unit; also for a ball, where it is only the way the fur lies.
    axis: DVec3,
    length: f64,
    radius: f64,
    /// Radius lost per length, between −1 and 1.
    taper: f64,
    /// *s* / √(1 − *s*²).
    lean: f64,
    /// Unit, across `axis`.
    flat: DVec3,
    /// 1 is round.
    squeeze: f64,
}

impl Cone {
    /// From ball to ball; where one holds the other it alone is left. `axis` is the way the fur lies on a ball.
    pub(crate) fn new(from: (DVec3, f64), to: (DVec3, f64), axis: DVec3) -> Self {
        let run = to.0 - from.0;
        let length = run.length();
        let shrink = from.1 - to.1;
        if length <= shrink.abs() * 1.000_001 + 1e-12 {
            let (centre, radius) = if shrink >= 0.0 { from } else { to };
            return Self {
                from: centre,
                axis: run.normalize_or(axis),
                length: 0.0,
                radius,
                taper: 0.0,
                lean: 0.0,
                flat: DVec3::ZERO,
                squeeze: 1.0,
            };
        }
        let taper = shrink / length;
        let lean = taper / (1.0 - taper * taper).sqrt();
        Self { from: from.0, axis: run / length, length, radius: from.1, taper, lean, flat: DVec3::ZERO, squeeze: 1.0 }
    }

    /// Squeezed along a direction, of which the part across the axis counts.
    pub(crate) fn flattened(self, along: DVec3, squeeze: f64) -> Self {
        let flat = (along - self.axis * along.dot(self.axis)).normalize_or_zero();
        Self { flat, squeeze: if flat == DVec3::ZERO { 1.0 } else { squeeze }, ..self }
    }

    /// The signed distance, or less where flattened.
    #[inline]
    pub(crate) fn value(&self, p: DVec3) -> f64 {
        let (v, u) = self.nearest_ball(p);
        self.squeeze * ((v - u * self.axis).length() - self.radius_at(u))
    }

    /// That, and its gradient; zero on the axis itself, where there is none.
    #[inline]
    pub(crate) fn value_and_gradient(&self, p: DVec3) -> (f64, DVec3) {
        let (v, u) = self.nearest_ball(p);
        let away = v - u * self.axis;
        let distance = away.length();
        let outward = if distance > 0.0 { away / distance } else { DVec3::ZERO };
        (self.squeeze * (distance - self.radius_at(u)), self.squeeze * self.unsqueezed(outward))
    }

    /// How thin the solid is where it is nearest to a point: half its least width there.
    pub(crate) fn thickness(&self, p: DVec3) -> f64 {
        self.squeeze * self.radius_at(self.nearest_ball(p).1)
    }

    /// Half the width at its thicker end.
    pub(crate) fn greatest_thickness(&self) -> f64 {
        self.squeeze * self.radius.max(self.radius_at(self.length))
    }

    /// Where the axis runs to: the way the fur lies.
    pub(crate) fn axis(&self) -> DVec3 {
        self.axis
    }

    /// A box around it.
    pub(crate) fn bounds(&self) -> (DVec3, DVec3) {
        let ends = [(self.from, self.radius), (self.from + self.length * self.axis, self.radius_at(self.length))];
        let low = ends.map(|(centre, radius)| centre - radius);
        let high = ends.map(|(centre, radius)| centre + radius);
        (low[0].min(low[1]), high[0].max(high[1]))
    }

    fn radius_at(&self, u: f64) -> f64 {
        self.radius - self.taper * u
    }

    /// The point in the unsqueezed space from the first end, and the place along the axis of the ball it is nearest to.
    #[inline]
    fn nearest_ball(&self, p: DVec3) -> (DVec3, f64) {
        let v = self.unsqueezed(p - self.from);
        let t = v.dot(self.axis);
        let y = (v.length_squared() - t * t).max(0.0).sqrt();
        (v, (t - self.lean * y).clamp(0.0, self.length))
    }

    #[inline]
    fn unsqueezed(&self, v: DVec3) -> DVec3 {
        v + self.flat * (self.flat.dot(v) * (1.0 / self.squeeze - 1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = DVec3> {
        [-2.0..2.0, -2.0..2.0, -2.0..2.0].prop_map(|[x, y, z]: [f64; 3]| DVec3::new(x, y, z))
    }

    proptest! {
        #[test]
        fn the_distance_is_that_to_the_nearest_of_many_balls(p in point(), a in point(), b in point(), ra in 0.01..0.5, rb in 0.01..0.5) {
            let cone = Cone::new((a, ra), (b, rb), DVec3::Z);
            let sampled = (0..=2000).map(|k| f64::from(k) / 2000.0).map(|u| p.distance(a.lerp(b, u)) - (ra + u * (rb - ra)));
            let least = sampled.fold(f64::INFINITY, f64::min);
            prop_assert!(cone.value(p) <= least + 1e-12 && cone.value(p) >= least - 3e-3, "{} {least}", cone.value(p));
        }

        #[test]
        fn the_gradient_is_that_of_differences_and_between_the_squeeze_and_one(p in point(), a in point(), b in point(), ra in 0.01..0.5,
                rb in 0.01..0.5, flat in point(), squeeze in 0.2..1.0) {
            let cone = Cone::new((a, ra), (b, rb), DVec3::Z).flattened(flat, squeeze);
            let (value, gradient) = cone.value_and_gradient(p);
            prop_assert_eq!(value, cone.value(p));
            prop_assume!(value > 1e-3);
            let h = 1e-5;
            let difference = |axis: DVec3| (cone.value(p + h * axis) - cone.value(p - h * axis)) / (2.0 * h);
            let by_differences = DVec3::new(difference(DVec3::X), difference(DVec3::Y), difference(DVec3::Z));
            prop_assert!(gradient.distance(by_differences) < 1e-2, "{gradient} {by_differences}");
            prop_assert!(gradient.length() < 1.0 + 1e-9 && gradient.length() > squeeze - 1e-9, "{}", gradient.length());
        }
    }

    #[test]
    fn a_flattened_ball_is_an_ellipsoid() {
        let disc = Cone::new((DVec3::ZERO, 1.0), (DVec3::ZERO, 1.0), DVec3::Z).flattened(DVec3::X, 0.25);
        for on in [DVec3::new(0.25, 0.0, 0.0), DVec3::Y, DVec3::NEG_Y] {
            assert!(disc.value(on).abs() < 1e-15, "{on}");
        }
        assert_eq!(disc.greatest_thickness(), 0.25);
    }
}
