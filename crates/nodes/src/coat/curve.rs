//! How a hair stands: straight, or bent on its way from skin to tip.

use glam::DVec3;

/// A hair of length 1 in the plane of the normal and the way the fur lies: it leaves the skin at one angle and ends at another.
///
/// place(h) = *c* h + *b* (h² − h), as `Surface::bends` has it: a parabola whose derivative runs evenly from *c* − *b* at the skin to *c* + *b* at the
/// tip, here of equal size, so that it is symmetric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Curve {
    /// From the normal towards the way the fur lies, in radians: at the skin, and at the tip.
    angles: [f64; 2],
    /// The cosine and the sine of half the angle between the two.
    half: (f64, f64),
    /// How long it would be with derivatives of size 1 at its ends.
    arc: f64,
}

impl Curve {
    /// A hair whose tip leans by `slant`, in radians under a right angle, of which the part `bend`, 0 to 1, comes from bending: with 0 it is straight, with 1 it
    /// leaves the skin along the normal.
    pub(crate) fn new(slant: f64, bend: f64) -> Self {
        let half = 0.5 * slant * bend;
        Self { angles: [slant * (1.0 - bend), slant], half: (half.cos(), half.sin()), arc: arc_length(half) }
    }

    /// *c* and *b* of a hair of length 1 for a normal and a unit tangent; without a tangent it stands straight up.
    pub(crate) fn lay(&self, normal: DVec3, along: DVec3) -> (DVec3, DVec3) {
        if along == DVec3::ZERO {
            return (normal, DVec3::ZERO);
        }
        let (root, tip) = self.ends(normal, along);
        (0.5 * (root + tip) / self.arc, 0.5 * (tip - root) / self.arc)
    }

    /// The unit directions at the skin and at the tip.
    fn ends(&self, normal: DVec3, along: DVec3) -> (DVec3, DVec3) {
        let [root, tip] = self.angles.map(|angle| normal * angle.cos() + along * angle.sin());
        (root, tip)
    }

    /// How fast it runs at height h: the size of the derivative, of which the mean is 1.
    pub(crate) fn speed(&self, height: f64) -> f64 {
        let (cos, sin) = self.half;
        let off_middle = (2.0 * height - 1.0) * sin;
        (cos * cos + off_middle * off_middle).sqrt() / self.arc
    }
}

/// The length of a parabola whose derivatives at its ends have size 1 and twice the angle `half` between them.
///
/// ∫₀¹ √(C² + (2h − 1)² S²) dh = ½ (1 + C² / S · asinh(S / C)), with C and S the cosine and the sine of `half`.
fn arc_length(half: f64) -> f64 {
    let tan = half.tan().abs();
    if tan == 0.0 { 1.0 } else { 0.5 * (1.0 + half.cos() * (tan.asinh() / tan)) }
}
