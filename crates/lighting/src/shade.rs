//! All terms together: the one place that says what colour lit fur has.

use glam::DVec3;

use crate::hair::within;
use crate::{Facing, HairLighting, SelfShadow, half_vector};

/// A light at infinity and a hemisphere of light from all around.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Illumination {
    /// *L*, the unit direction towards the light.
    pub direction: DVec3,
    /// The light's colour times its strength.
    pub colour: DVec3,
    /// The colour times strength of the light from straight above (y up).
    pub sky: DVec3,
    /// The same from straight below.
    pub ground: DVec3,
}

impl Illumination {
    /// The light from all around that falls on a skin with unit `normal`: from ground to sky in proportion to the height it looks at.
    pub fn hemisphere(&self, normal: DVec3) -> DVec3 {
        self.ground.lerp(self.sky, within(0.5 + 0.5 * normal.y, 0.0, 1.0, 0.0))
    }
}

/// A place on a hair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HairPoint {
    /// *T*, the unit direction of the hair, or the mean of several, at most 1 long; its sign is without effect.
    pub direction: DVec3,
    /// *N*, the unit normal of the skin beneath.
    pub normal: DVec3,
    /// 0 at the skin, 1 at the tips.
    pub height: f64,
}

/// Everything that says how a coat takes light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shading {
    /// The fibre's own lighting.
    pub hair: HairLighting,
    /// How deep light gets.
    pub self_shadow: SelfShadow,
    /// How far round it gets.
    pub facing: Facing,
}

impl Shading {
    /// The light that a hair of albedo 1 sends to the eye; multiply by the hair's colour. `view` is *V*, the unit direction to the eye.
    ///
    /// Shadow and facing act on the lit part only; the ambient part has the hemisphere and its own way down:
    /// Ka · hemisphere(N) · sky(d) + (Kd (1 − u²)^(Pd/2) + Ks (1 − v²)^(Ps/2) · w) · shadow(d, N·L) · facing(N·L) · light.
    pub fn shade(&self, illumination: &Illumination, view: DVec3, hair: &HairPoint) -> DVec3 {
        let half = half_vector(illumination.direction, view);
        let diffuse = self.hair.diffuse_factor(hair.direction.dot(illumination.direction));
        let specular = self.hair.specular_factor(hair.direction.dot(half.direction)) * half.weight;
        self.shade_with(illumination, hair, diffuse, specular)
    }

    /// As [`Shading::shade`], with the two factors looked up elsewhere, in a [`crate::LightingTable`] say.
    pub fn shade_with(&self, illumination: &Illumination, hair: &HairPoint, diffuse: f64, specular: f64) -> DVec3 {
        let (depth, n_dot_l) = (1.0 - hair.height, hair.normal.dot(illumination.direction));
        let ambient = self.hair.ambient * illumination.hemisphere(hair.normal) * self.self_shadow.sky_transmittance(depth);
        let reach = self.self_shadow.transmittance(depth, n_dot_l) * self.facing.factor(n_dot_l);
        ambient + (self.hair.diffuse * diffuse + self.hair.specular * specular) * illumination.colour * reach
    }

    /// The light that bare skin of albedo 1 sends out: Ka · hemisphere(N) + Kd · max(N·L, 0) · light.
    pub fn skin(&self, illumination: &Illumination, normal: DVec3) -> DVec3 {
        let n_dot_l = within(normal.dot(illumination.direction), 0.0, 1.0, 0.0);
        self.hair.ambient * illumination.hemisphere(normal) + self.hair.diffuse * illumination.colour * n_dot_l
    }
}
