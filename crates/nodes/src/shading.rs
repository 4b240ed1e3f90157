//! What hair makes of light.

use glam::{DVec3, Vec3};
use pelage_graph::{Colour, Context, Evaluate, Node, NodeError};
use pelage_lighting::{Facing, HairLighting, SelfShadow, Shading};

/// A picked colour in linear light.
pub(crate) fn linear(colour: Colour) -> Vec3 {
    DVec3::from(colour.to_linear()).as_vec3()
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
