//! In what light.

use glam::Vec3;

/// A light at infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// The unit direction towards it.
    pub direction: Vec3,
    /// Its colour times its strength.
    pub colour: Vec3,
}

/// The lights of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lights {
    /// Lights at infinity; the first is the one that casts shadows and is evaluated as finely as asked for.
    pub directional: Vec<Light>,
    /// The light from all around.
    pub ambient: Irradiance,
}

/// The light from all around that falls on a surface, as a polynomial of its unit normal (Ramamoorthi and Hanrahan 2001): the coefficients of
/// 1, *y*, *z*, *x*, *xy*, *yz*, 3*z*² − 1, *xz*, *x*² − *y*².
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Irradiance(pub [Vec3; 9]);

impl Lights {
    /// Most directional lights: whoever draws may refuse more.
    pub const MOST: usize = 4;
}

impl Irradiance {
    /// From straight above (y up) and from straight below, in proportion to the height that the normal looks at in between.
    pub fn hemisphere(sky: Vec3, ground: Vec3) -> Self {
        let mut terms = [Vec3::ZERO; 9];
        terms[0] = 0.5 * (sky + ground);
        terms[1] = 0.5 * (sky - ground);
        Self(terms)
    }

    /// What falls on a surface with this unit normal, nothing negative.
    pub fn at(&self, n: Vec3) -> Vec3 {
        let basis = [1.0, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3.0 * n.z * n.z - 1.0, n.x * n.z, n.x * n.x - n.y * n.y];
        self.0.iter().zip(basis).map(|(&term, b)| term * b).sum::<Vec3>().max(Vec3::ZERO)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hemisphere_runs_from_ground_to_sky() {
        let (sky, ground) = (Vec3::new(0.5, 0.6, 0.9), Vec3::new(0.3, 0.2, 0.1));
        let light = Irradiance::hemisphere(sky, ground);
        assert!(light.at(Vec3::Y).abs_diff_eq(sky, 1e-6));
        assert!(light.at(Vec3::NEG_Y).abs_diff_eq(ground, 1e-6));
        assert!(light.at(Vec3::X).abs_diff_eq(0.5 * (sky + ground), 1e-6));
    }
}
