//! Tangent vectors from one tangent plane to another.

use glam::DVec3;

/// Turns a tangent vector at one unit normal into one at another by the least rotation between the normals: parallel transport along
/// the great circle between them. Nothing is known where the normals are opposite, or one is zero.
#[inline]
pub(crate) fn transport(vector: DVec3, from: DVec3, to: DVec3) -> DVec3 {
    let cosine = from.dot(to);
    if cosine < -0.999 || from == DVec3::ZERO || to == DVec3::ZERO {
        return DVec3::ZERO;
    }
    // Rodrigues' rotation about from × to, simplified with vector · from = 0.
    vector - (from + to) * (vector.dot(to) / (1.0 + cosine))
}

/// The part of a vector in the plane across a unit normal.
#[inline]
pub(crate) fn tangent_part(vector: DVec3, normal: DVec3) -> DVec3 {
    vector - normal * vector.dot(normal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn direction() -> impl Strategy<Value = DVec3> {
        (-1.0..1.0_f64, 0.0..std::f64::consts::TAU).prop_map(|(z, turn)| {
            let r = (1.0 - z * z).sqrt();
            DVec3::new(r * turn.cos(), r * turn.sin(), z)
        })
    }

    proptest! {
        #[test]
        fn keeps_lengths_and_angles_and_ends_tangent(from in direction(), to in direction(), a in direction(), b in direction()) {
            prop_assume!(from.dot(to) > -0.99);
            let (a, b) = (tangent_part(a, from), tangent_part(b, from));
            let (x, y) = (transport(a, from, to), transport(b, from, to));
            prop_assert!(x.dot(to).abs() < 1e-9);
            prop_assert!((x.length() - a.length()).abs() < 1e-9 && (x.dot(y) - a.dot(b)).abs() < 1e-9);
            // It turns no more than the normals do: the axis stays where it is.
            let axis = from.cross(to).normalize_or_zero();
            prop_assert!((x.dot(axis) - a.dot(axis)).abs() < 1e-9);
            prop_assert!(transport(x, to, from).distance(a) < 1e-9);
        }
    }
}
