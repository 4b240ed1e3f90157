//! All terms together: the one place that says what colour lit fur has.

use glam::DVec3;

use crate::hair::within;
use crate::{Facing, HairLighting, Irradiance, SelfShadow, half_vector};

/// A light at infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionalLight {
    /// *L*, the unit direction towards the light.
    pub direction: DVec3,
    /// The light's colour times its strength.
    pub colour: DVec3,
}

/// All the light there is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Illumination {
    /// Lights at infinity, any number; their light adds up.
    pub lights: Vec<DirectionalLight>,
    /// The light from all around.
    pub ambient: Irradiance,
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
    /// Shadow and facing act on the lit part only; the ambient part has its own way down. The lit parts of all lights add up:
    /// Ka · irradiance(N) · sky(d) + Σ (Kd (1 − u²)^(Pd/2) + Ks (1 − v²)^(Ps/2) · w) · shadow(d, N·L) · facing(N·L) · light.
    pub fn shade(&self, illumination: &Illumination, view: DVec3, hair: &HairPoint) -> DVec3 {
        self.shade_with(illumination, hair, |light| {
            let half = half_vector(light.direction, view);
            let diffuse = self.hair.diffuse_factor(hair.direction.dot(light.direction));
            (diffuse, self.hair.specular_factor(hair.direction.dot(half.direction)) * half.weight)
        })
    }

    /// As [`Shading::shade`], with the diffuse and the specular factor of each light looked up elsewhere, in a [`crate::LightingTable`] say; the weight *w* is
    /// part of the specular one.
    pub fn shade_with(&self, illumination: &Illumination, hair: &HairPoint, factors: impl Fn(&DirectionalLight) -> (f64, f64)) -> DVec3 {
        let depth = 1.0 - hair.height;
        let ambient = self.hair.ambient * illumination.ambient.at(hair.normal) * self.self_shadow.sky_transmittance(depth);
        illumination.lights.iter().fold(ambient, |sum, light| {
            let (diffuse, specular) = factors(light);
            let n_dot_l = hair.normal.dot(light.direction);
            let reach = self.self_shadow.transmittance(depth, n_dot_l) * self.facing.factor(n_dot_l);
            sum + (self.hair.diffuse * diffuse + self.hair.specular * specular) * light.colour * reach
        })
    }

    /// The light that bare skin of albedo 1 sends out: Ka · irradiance(N) + Σ Kd · max(N·L, 0) · light.
    pub fn skin(&self, illumination: &Illumination, normal: DVec3) -> DVec3 {
        let ambient = self.hair.ambient * illumination.ambient.at(normal);
        illumination.lights.iter().fold(ambient, |sum, light| {
            let n_dot_l = within(normal.dot(light.direction), 0.0, 1.0, 0.0);
            sum + self.hair.diffuse * light.colour * n_dot_l
        })
    }
}
