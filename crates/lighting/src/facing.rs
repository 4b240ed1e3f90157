//! The side away from the light is darker.

use crate::hair::within;

/// How far round the skin the light reaches, softened so that it wraps about the terminator.
///
/// Hair lighting alone lights both sides of a ball alike. Goldman 1997 scales it by where the light stands to the skin:
/// 1 + ρ (smoothstep(ω_min, ω_max, N·L) − 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facing {
    /// ρ: 0 (no facing term, the paper's bare formula) to 1 (the far side gets no direct light).
    pub strength: f64,
    /// ω_min: no direct light where N·L is below; −1 to 1.
    pub dark_below: f64,
    /// ω_max: all of it where N·L is above; above `dark_below`, to 1.
    pub full_above: f64,
}

impl Default for Facing {
    fn default() -> Self {
        Self { strength: 1.0, dark_below: -0.4, full_above: 0.9 }
    }
}

impl Facing {
    /// The factor on the direct light for a skin whose normal makes N·L with it: from 1 − `strength` to 1, never falling as N·L grows.
    /// What is no number lies in the dark.
    pub fn factor(&self, n_dot_l: f64) -> f64 {
        // A range without width is a step, not a division by zero.
        let t = within((n_dot_l - self.dark_below) / (self.full_above - self.dark_below).max(1e-9), 0.0, 1.0, 0.0);
        1.0 + within(self.strength, 0.0, 1.0, 0.0) * (t * t * (3.0 - 2.0 * t) - 1.0)
    }
}
