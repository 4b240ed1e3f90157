//! The Gaussian and its integral, tabled.

use libm::{erf, exp};
use std::f64::consts::SQRT_2;
use std::sync::LazyLock;

/// Beyond this many σ the integral is taken for 0 or 1; what is left out is under 2e-6.
pub(crate) const REACH: f32 = 4.75;
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

/// [`integral`] by linear interpolation, within 1e-6: fast enough for the inner loop.
#[derive(Clone, Copy)]
pub(crate) struct IntegralTable(&'static [f32; ENTRIES]);

impl IntegralTable {
    pub(crate) fn new() -> Self {
        static TABLE: LazyLock<[f32; ENTRIES]> = LazyLock::new(|| std::array::from_fn(|i| integral(i as f64 / STEPS as f64 - 5.0) as f32));
        Self(&TABLE)
    }

    #[inline]
    pub(crate) fn at(self, x: f32) -> f32 {
        // NaN goes to the first entry.
        let place = (x.clamp(-REACH, REACH) + 5.0) * STEPS as f32;
        let index = (place as usize).min(ENTRIES - 2);
        let part = place - index as f32;
        let (low, high) = (self.0[index], self.0[index + 1]);
        low + (high - low) * part
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_errs_under_a_millionth() {
        let table = IntegralTable::new();
        let worst = (-60_000..=60_000)
            .map(|i| f64::from(i) * 1e-4)
            .map(|x| (f64::from(table.at(x as f32)) - integral(x)).abs())
            .fold(0.0, f64::max);
        assert!(worst < 2e-6, "{worst}");
    }
}
