//! Light, and what hair makes of it.

use glam::{DVec3, Vec3};
use pelage_coat::{Irradiance, Light, Lights};
use pelage_graph::{Colour, Context, Evaluate, Node, NodeError};
use pelage_lighting::{Facing, HairLighting, SelfShadow, Shading};

/// A picked colour in linear light.
pub(crate) fn linear(colour: Colour) -> Vec3 {
    DVec3::from(colour.to_linear()).as_vec3()
}

/// A light at infinity and the light from all around.
#[derive(Node)]
#[node(category = "Picture", version = 1, name = "Light")]
#[output(light: Lights, "The light.")]
pub struct LightNode {
    /// Where it comes from, around the vertical axis, anticlockwise seen from above; 0 is the side a camera of azimuth 0 stands on.
    #[param(default = 40.0, range = -360.0..=360.0, unit = "degrees", effect = "none on cost")]
    pub azimuth: f64,
    /// Above the horizon.
    #[param(default = 45.0, range = -90.0..=90.0, unit = "degrees", effect = "none on cost")]
    pub elevation: f64,
    /// Its colour.
    #[param(default = Colour([1.0, 0.96, 0.9]))]
    pub colour: Colour,
    /// How bright it is.
    #[param(default = 2.2, range = 0.0..=100.0, unit = "times white", effect = "brighter; past white it clips")]
    pub strength: f64,
    /// The light from above.
    #[param(default = Colour([0.62, 0.68, 0.78]))]
    pub sky: Colour,
    /// The light from below.
    #[param(default = Colour([0.45, 0.4, 0.36]))]
    pub ground: Colour,
}

impl Evaluate for LightNode {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let (azimuth, elevation) = (self.azimuth.to_radians(), self.elevation.to_radians());
        let direction = DVec3::new(elevation.cos() * azimuth.sin(), elevation.sin(), elevation.cos() * azimuth.cos());
        let sun = Light { direction: direction.as_vec3().normalize_or(Vec3::Y), colour: linear(self.colour) * self.strength as f32 };
        Ok(Lights { directional: vec![sun], ambient: Irradiance::hemisphere(linear(self.sky), linear(self.ground)) }.into())
    }
}

/// Hair lighting after Kajiya and Kay, Banks, and Lengyel et al.: Ka + Kd (1 − u²)^(Pd/2) + Ks (1 − v²)^(Ps/2) (L13).
#[derive(Node)]
#[node(category = "Picture", version = 1, name = "HairLighting")]
#[output(shading: Shading, "How hair answers light.")]
pub struct HairLightingNode {
    /// Ka: what the light from all around gives.
    #[param(default = Colour([0.75, 0.75, 0.75]))]
    pub ambient: Colour,
    /// Kd: what the light gives a hair it falls on from the side.
    #[param(default = Colour([0.9, 0.9, 0.9]))]
    pub diffuse: Colour,
    /// Ks: the highlight.
    #[param(default = Colour([0.3, 0.29, 0.27]))]
    pub specular: Colour,
    /// Pd: how fast the diffuse part falls as the hair turns to the light.
    #[param(default = 0.6, range = 0.0..=1000.0, unit = "exponent", effect = "larger: darker where hair points at the light")]
    pub diffuse_power: f64,
    /// Ps: how sharp the highlight is.
    #[param(default = 24.0, range = 0.0..=10000.0, unit = "exponent", effect = "larger: a narrower highlight")]
    pub specular_power: f64,
    /// How dense the fur is to light on its way down to the skin.
    #[param(default = 0.75, range = 0.0..=50.0, unit = "optical depth of the whole fur", effect = "larger: darker near the skin, more depth")]
    pub shadow: f64,
    /// How much darker the side away from the light is.
    #[param(default = 0.65, range = 0.0..=1.0, unit = "fraction", effect = "0: the paper's bare formula, which lights both sides alike")]
    pub facing: f64,
}

impl Evaluate for HairLightingNode {
    fn evaluate(&self, _: &mut Context<'_>) -> Result<Self::Outputs, NodeError> {
        let colour = |c: Colour| DVec3::from(c.to_linear());
        Ok(Shading {
            hair: HairLighting {
                ambient: colour(self.ambient),
                diffuse: colour(self.diffuse),
                specular: colour(self.specular),
                diffuse_power: self.diffuse_power,
                specular_power: self.specular_power,
            },
            self_shadow: SelfShadow { density: self.shadow, ..SelfShadow::default() },
            facing: Facing { strength: self.facing, ..Facing::default() },
        }
        .into())
    }
}
