//! How large the model is: what every tolerance is relative to.

use glam::DVec3;

use super::soup::Soup;

/// A few times the rounding of one coordinate.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The box around the vertices in use.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    centre: DVec3,
    /// The diagonal of the box.
    diameter: f64,
    /// By how much rounding may have moved a vertex, in diameters.
    pub(super) noise: f64,
}

impl Scale {
    /// Nothing if there is no vertex, or all are at one place.
    pub(super) fn of(points: impl Iterator<Item = DVec3>) -> Option<Self> {
        let (low, high) = points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        // Halved first, as the whole may be too large for `f64`.
        let half = 0.5 * high - 0.5 * low;
        let largest = half.max_element();
        if !largest.is_finite() || largest <= 0.0 {
            return None;
        }
        // Scaled by the largest, as squares would leave the range.
        let diameter = (2.0 * largest * (half / largest).length()).min(f64::MAX);
        let noise = ROUNDING * low.abs().max(high.abs()).max_element() / diameter;
        Some(Self { centre: 0.5 * low + 0.5 * high, diameter, noise })
    }

    /// A place, seen from the middle of the box, in diameters.
    #[inline]
    pub(super) fn place(&self, p: DVec3) -> DVec3 {
        (p - self.centre) / self.diameter
    }

    /// The median length of the polygons' sides that have one, in diameters; 0 if none has.
    pub(super) fn median_side(&self, soup: &Soup) -> f64 {
        let mut lengths = Vec::with_capacity(soup.corners.len());
        for range in soup.ranges() {
            let corners = &soup.corners[range];
            let sides = corners.iter().zip(corners.iter().cycle().skip(1));
            lengths.extend(sides.map(|(&a, &b)| self.between(soup.positions[a as usize], soup.positions[b as usize]).length_squared()));
        }
        lengths.retain(|&length| length > 0.0);
        let middle = lengths.len() / 2;
        // Of the squares, as roots change no order.
        if lengths.is_empty() { 0.0 } else { lengths.select_nth_unstable_by(middle, f64::total_cmp).1.sqrt() }
    }

    /// From one place to another, in diameters.
    #[inline]
    pub(super) fn between(&self, from: DVec3, to: DVec3) -> DVec3 {
        (to - from) / self.diameter
    }
}
