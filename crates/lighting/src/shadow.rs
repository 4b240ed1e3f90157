//! Fur that stands in its own shadow.

use crate::hair::within;

/// The mean path of light from a whole hemisphere through a layer, over the layer's thickness, as the exponent 5/3 of two-stream theory.
///
/// Diffuse light crosses a layer of optical depth τ with transmittance 2 E₃(τ), which exp(−5τ/3) follows within 0.033 (the *diffusivity
/// factor* of Elsasser 1942).
pub const DIFFUSIVITY: f64 = 5.0 / 3.0;

/// How light dies away on its way down through the fur.
///
/// Banks 1994 attenuates by the amount of fur crossed: through depth *d* under the tips along *L* it is d / (N·L), hence
/// exp(−σ d / max(N·L, ε)). Lengyel et al. 2001 darken the shells near the skin by it and give no curve; this is ours, with a floor:
/// minimum + (1 − minimum) · exp(−σ d / max(N·L, ε)), since light also comes down between hairs and through them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SelfShadow {
    /// σ: optical depth of the fur from tips to skin, straight down; 0 (no shadow) to about 10. Under 0 counts as 0.
    pub density: f64,
    /// The light that reaches the skin however dense the fur; 0 to 1.
    pub minimum: f64,
    /// ε: the least N·L that counts, above 0 to 1, so that low light still touches the tips.
    pub grazing: f64,
}

impl Default for SelfShadow {
    fn default() -> Self {
        Self { density: 0.9, minimum: 0.12, grazing: 0.35 }
    }
}

impl SelfShadow {
    /// The part of the direct light that arrives at `depth` (0 at the tips, 1 at the skin) where the skin's normal makes N·L with the light.
    ///
    /// From `minimum` to 1; 1 at the tips; falls with depth and rises with N·L. A depth that is no number counts as the skin's.
    pub fn transmittance(&self, depth: f64, n_dot_l: f64) -> f64 {
        let slant = n_dot_l.max(within(self.grazing, 1e-6, 1.0, 1.0));
        self.floored(self.density.max(0.0) * within(depth, 0.0, 1.0, 1.0) / slant)
    }

    /// The part of the light from all around that arrives at `depth`: the same law with the path of a whole hemisphere, [`DIFFUSIVITY`].
    pub fn sky_transmittance(&self, depth: f64) -> f64 {
        self.floored(self.density.max(0.0) * within(depth, 0.0, 1.0, 1.0) * DIFFUSIVITY)
    }

    fn floored(&self, optical_depth: f64) -> f64 {
        let minimum = within(self.minimum, 0.0, 1.0, 0.0);
        minimum + (1.0 - minimum) * libm::exp(-optical_depth)
    }
}
