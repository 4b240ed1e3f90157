//! What a shell shows of a stack.

use libm::{expm1f, log1p, log1pf};

/// A shell: where it stands and what it shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shell {
    /// Where it stands: 0 at the skin, 1 at the tips.
    pub height: f32,
    /// The mean height of what is seen of it from outside, weighted by opacity: its own, unless it shows several shells at once.
    pub light_height: f32,
    /// Which image of the stack it shows.
    pub image: u32,
    /// Multiplies the image's alpha, 0 to 1 (L22).
    pub opacity: f32,
    /// How many layers of that alpha it stands for (K5): a texel's alpha is 1 − (1 − opacity × α)^layers. Positive or 0.
    pub layers: f32,
}

impl Shell {
    /// A shell that shows an image as it is.
    pub fn plain(height: f32, image: u32) -> Self {
        Self { height, light_height: height, image, opacity: 1.0, layers: 1.0 }
    }

    /// What it covers where its image covers `alpha`: 1 − (1 − opacity × α)^layers.
    pub fn covers(&self, alpha: f32) -> f32 {
        let once = (self.opacity * alpha).clamp(0.0, 1.0);
        if self.layers == 1.0 { once } else { -expm1f(self.layers * log1pf(-once)) }
    }

    /// The one shell that shows an image as two do that both show it: `self` stays below.
    ///
    /// Of thin texels the two together cover S = Σ nₖoₖ times alpha; of those that cover m they leave open exp(−L), L = −Σ nₖ ln(1 − m oₖ). Both are kept: the opacity o solves
    /// −ln(1 − m o)/(m o) = L/(m S), and n = S/o. So equal opacities are merged exactly for every alpha; others within 0.002 of a texel's alpha if they are 0.1 apart,
    /// and within 0.02 whatever they are. Both sums add up, so pairs of pairs keep them too.
    pub(crate) fn merged(&self, upper: &Self) -> Self {
        let pairs = [self, upper].map(|shell| (f64::from(shell.opacity.clamp(0.0, 1.0)), f64::from(shell.layers)));
        let thin: f64 = pairs.iter().map(|(o, n)| o * n).sum();
        if pairs[0].0 == pairs[1].0 || thin <= 0.0 {
            return Self { layers: self.layers + upper.layers, ..*self };
        }
        let full: f64 = pairs.iter().map(|(o, n)| -n * log1p(-KEPT_ALPHA * o)).sum();
        let opacity = (opacity_of(full / (KEPT_ALPHA * thin)) / KEPT_ALPHA).min(1.0);
        Self { opacity: opacity as f32, layers: (thin / opacity) as f32, ..*self }
    }
}

/// The alpha besides 0 at which merged shells are exact: of 0.6 to 0.95 the one that errs least over all pairs of opacities.
const KEPT_ALPHA: f64 = 0.9;

/// Solves −ln(1 − x)/x = `ratio`: it rises from 1 at 0 to infinity at 1.
fn opacity_of(ratio: f64) -> f64 {
    // At a ratio of 1 any small opacity will do: the layers make up for it.
    let (mut low, mut high) = (1e-6, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if -log1p(-middle) < ratio * middle { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn shell(opacity: f32, layers: f32) -> Shell {
        Shell { opacity, layers, ..Shell::plain(0.5, 1) }
    }

    fn apart(one: &Shell, two: [&Shell; 2]) -> f32 {
        (0..=255u8)
            .map(f32::from)
            .map(|byte| {
                let alpha = byte / 255.0;
                let open: f32 = two.iter().map(|shell| 1.0 - shell.covers(alpha)).product();
                (1.0 - one.covers(alpha) - open).abs()
            })
            .fold(0.0, f32::max)
    }

    #[test]
    fn equal_opacities_are_merged_exactly() {
        for (opacity, layers) in
            [(1.0, [1.0, 1.0]), (1.0, [0.25, 0.5]), (0.3, [1.0, 1.0]), (0.3, [4.0, 2.0]), (0.0, [1.0, 1.0]), (0.999, [1.0, 3.0])]
        {
            let pair = layers.map(|n| shell(opacity, n));
            let one = pair[0].merged(&pair[1]);
            assert!(apart(&one, [&pair[0], &pair[1]]) < 2e-6, "{opacity} {layers:?}: {one:?}");
        }
    }

    proptest! {
        /// As the method says; half a byte's step is 0.002.
        #[test]
        fn unequal_opacities_are_merged_within_bounds(o in 0.0f32..=1.0, step in 0.0f32..=0.1, any in 0.0f32..=1.0) {
            let (below, above, far) = (shell(o, 1.0), shell((o - step).max(0.0), 1.0), shell(any, 1.0));
            prop_assert!(apart(&below.merged(&above), [&below, &above]) < 0.002);
            prop_assert!(apart(&below.merged(&far), [&below, &far]) < 0.02);
        }
    }

    #[test]
    fn a_ramp_merged_again_and_again_stays_within_half_a_step() {
        let mut shells: Vec<Shell> = (0..15u8).map(|k| shell(1.0 - f32::from(k) / 15.0, 1.0)).collect();
        let ramp = shells.clone();
        for folded in [2usize, 4, 8] {
            shells = shells.chunks(2).map(|pair| pair.get(1).map_or(pair[0], |upper| pair[0].merged(upper))).collect();
            for (one, all) in shells.iter().zip(ramp.chunks(folded)) {
                for alpha in (0..=255u8).map(|byte| f32::from(byte) / 255.0) {
                    let open: f32 = all.iter().map(|shell| 1.0 - shell.covers(alpha)).product();
                    assert!((1.0 - one.covers(alpha) - open).abs() < 0.0025, "{folded} at {alpha}: {one:?}");
                }
            }
        }
    }

    #[test]
    fn a_column_of_parts_of_a_layer_is_the_layer() {
        for parts in [1, 3, 7] {
            let one = shell(1.0, 1.0 / parts as f32);
            for alpha in [0.0f32, 0.003, 0.3, 0.9, 1.0] {
                let open = (0..parts).map(|_| 1.0 - one.covers(alpha)).product::<f32>();
                assert!((1.0 - open - alpha).abs() < 1e-6);
            }
        }
    }
}
