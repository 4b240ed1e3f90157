//! The Gaussian and its integral, tabled.

use libm::{erf, exp};
use std::f64::consts::SQRT_2;
use std::sync::LazyLock;

/// Beyond this many σ the integral is taken for 0 or 1; what is left out is under 2e-6.
const REACH: f32 = 4.75;
/// Table steps in one σ.
const STEPS: usize = 256;
const ENTRIES: usize = 2 * 5 * STEPS + 2;

/// The integral of the unit Gaussian up to `x`: (1 + erf(x/√2))/2, exact to f64.
pub(crate) fn integral(x: f64) -> f64 {
    0.5 * (1.0 + erf(x / SQRT_2))
}

/// exp(−x²/2), the Gaussian of peak 1.
pub(crate) fn bell(x: f64) -> f64 {
    exp(-0.5 * x * x)
}

/// [`integral`] and [`bell`] by linear interpolation, within 2e-6 and 2e-6: fast enough for the inner loop.
#[derive(Clone, Copy)]
pub(crate) struct Tables {
    integral: &'static [f32; ENTRIES],
    bell: &'static [f32; ENTRIES],
}

impl Tables {
    pub(crate) fn new() -> Self {
        static INTEGRAL: LazyLock<[f32; ENTRIES]> = LazyLock::new(|| std::array::from_fn(|i| integral(node(i)) as f32));
        static BELL: LazyLock<[f32; ENTRIES]> = LazyLock::new(|| std::array::from_fn(|i| bell(node(i)) as f32));
        Self { integral: &INTEGRAL, bell: &BELL }
    }

    #[inline]
    pub(crate) fn integral(self, x: f32) -> f32 {
        interpolate(self.integral, x)
    }

    #[inline]
    pub(crate) fn bell(self, x: f32) -> f32 {
        interpolate(self.bell, x)
    }
}

/// Where entry `i` stands.
fn node(i: usize) -> f64 {
    i as f64 / STEPS as f64 - 5.0
}

#[inline]
fn interpolate(table: &[f32; ENTRIES], x: f32) -> f32 {
    // NaN goes to the first entry.
    let place = (x.clamp(-REACH, REACH) + 5.0) * STEPS as f32;
    let index = (place as usize).min(ENTRIES - 2);
    let part = place - index as f32;
    let (low, high) = (table[index], table[index + 1]);
    low + (high - low) * part
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tables_err_under_a_few_millionths() {
        let tables = Tables::new();
        for x in (-47_000..=47_000).map(|i| f64::from(i) * 1e-4) {
            assert!((f64::from(tables.integral(x as f32)) - integral(x)).abs() < 3e-6, "{x}");
            assert!((f64::from(tables.bell(x as f32)) - bell(x)).abs() < 3e-6, "{x}");
        }
        assert!(tables.bell(50.0) < 2e-5 && tables.integral(-50.0) < 2e-6 && tables.integral(50.0) > 1.0 - 2e-6);
    }
}
