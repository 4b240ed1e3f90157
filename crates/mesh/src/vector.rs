//! Lengths, directions and angles that neither overflow nor vanish on the way.

use glam::DVec3;

/// The unit vector along `v`, whatever its magnitude; zero for the zero vector and where `v` is not finite or shorter than 1e-300.
///
/// `normalize_or_zero` squares first, which loses vectors shorter than about 1e-154 and longer than 1e154.
#[inline]
pub fn unit(v: DVec3) -> DVec3 {
    let largest = v.abs().max_element();
    // Dividing by the least subnormals would overflow; there is nothing to be known about their direction anyway.
    if largest > 1e-300 && largest.is_finite() { (v / largest).normalize_or_zero() } else { DVec3::ZERO }
}

/// The angle between two vectors, 0 to π; 0 if one has no direction. Exact near 0 and π, where the arc cosine is not (Kahan 2006).
#[inline]
pub fn angle_between(a: DVec3, b: DVec3) -> f64 {
    let (a, b) = (unit(a), unit(b));
    libm::atan2(a.cross(b).length(), a.dot(b))
}
