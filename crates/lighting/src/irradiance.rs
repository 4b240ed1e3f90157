//! The light from all around, as a polynomial of the surface's normal.

use std::ops::{Add, Mul};

use glam::DVec3;

use crate::hair::within;

/// What light from all around falls on a surface, by its unit normal: the coefficients of
/// 1, *y*, *z*, *x*, *xy*, *yz*, 3*z*² − 1, *xz*, *x*² − *y*², one colour each.
///
/// The nine real spherical harmonics up to order 2 without their constants (Ramamoorthi and Hanrahan 2001). In units in which light of radiance 1
/// from everywhere gives 1: irradiance over π.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Irradiance(pub [DVec3; 9]);

impl Irradiance {
    /// From straight above (y up) and from straight below, in proportion to the height that the normal looks at in between.
    ///
    /// That is exactly what a sky and a ground of one colour each give.
    pub fn hemisphere(sky: DVec3, ground: DVec3) -> Self {
        let mut terms = [DVec3::ZERO; 9];
        terms[0] = 0.5 * (sky + ground);
        terms[1] = 0.5 * (sky - ground);
        Self(terms)
    }

    /// What falls on a surface with this unit normal, nothing negative; of a normal that is no number, the mean over all.
    pub fn at(&self, normal: DVec3) -> DVec3 {
        if normal.is_nan() {
            return not_negative(self.0[0]);
        }
        let (x, y, z) = (clamped(normal.x), clamped(normal.y), clamped(normal.z));
        let basis = [1.0, y, z, x, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y];
        not_negative(self.0.iter().zip(basis).map(|(&term, b)| term * b).sum())
    }

    /// The same light turned about the vertical, anticlockwise seen from above, by an angle in radians: what came from azimuth *a* comes from *a* + `angle`.
    ///
    /// Exact: harmonics of one order turn among themselves.
    #[must_use]
    pub fn turned(&self, angle: f64) -> Self {
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        let [mean, y, z, x, xy, yz, zz, xz, xx_yy] = self.0;
        // Those of x and z, alone and times y, turn as a vector does.
        let turn = |x: DVec3, z: DVec3| (x * cos + z * sin, z * cos - x * sin);
        let ((x, z), (xy, yz)) = (turn(x, z), turn(xy, yz));
        // Those of x², z² and xz: their mean stays, and the rest, half cos 2a and half sin 2a of the azimuth a, turns twice as fast.
        let (of_xx, of_zz) = (xx_yy - zz, 2.0 * zz);
        let (sin_2, cos_2) = (2.0 * sin * cos, (cos - sin) * (cos + sin));
        let (middle, even, odd) = (0.5 * (of_zz + of_xx), 0.5 * (of_zz - of_xx), 0.5 * xz);
        let (even, odd) = (even * cos_2 - odd * sin_2, even * sin_2 + odd * cos_2);
        let zz = 0.5 * (middle + even);
        Self([mean, y, z, x, xy, yz, zz, 2.0 * odd, middle - even + zz])
    }
}

impl Add for Irradiance {
    type Output = Self;

    /// Both lights at once.
    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl Mul<f64> for Irradiance {
    type Output = Self;

    /// The light so many times as strong.
    fn mul(self, strength: f64) -> Self {
        Self(self.0.map(|term| term * strength))
    }
}

/// A rounded unit vector's coordinate within its range.
fn clamped(coordinate: f64) -> f64 {
    within(coordinate, -1.0, 1.0, 0.0)
}

fn not_negative(light: DVec3) -> DVec3 {
    light.max(DVec3::ZERO)
}
