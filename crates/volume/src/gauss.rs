//! The Gaussian and its integral, exact and as polynomials for the inner loop.

use libm::{erf, exp};
use std::f64::consts::SQRT_2;

/// The integral of the unit Gaussian up to `x`: (1 + erf(x/√2))/2, exact to f64.
pub(crate) fn integral(x: f64) -> f64 {
    0.5 * (1.0 + erf(x / SQRT_2))
}

/// exp(−x²/2), the Gaussian of peak 1.
pub(crate) fn bell(x: f64) -> f64 {
    exp(-0.5 * x * x)
}

/// Beyond this many σ the integral is taken for ±½ and the bell for 0.
const REACH: f32 = 4.0;

/// [`integral`] − ½, within 4e-5 for every f32: an odd polynomial, without branch or table, so that several are evaluated at once.
///
/// Chebyshev interpolation of (Φ(x) − ½)/x in x², scaled so that it ends at ±½.
#[inline(always)]
pub(crate) fn centred_integral(x: f32) -> f32 {
    const C: [f32; 9] = [
        0.175_960_93,
        -0.084_307_08,
        0.055_931_16,
        -0.037_132_382,
        0.022_606_827,
        -0.011_554_306,
        0.005_929_009,
        -0.003_987_566_6,
        0.001_555_051_8,
    ];
    let x = x.clamp(-REACH, REACH);
    x * polynomial(x, C)
}

/// [`bell`] within 4.5e-4, a ninth of a byte's step: an even polynomial.
#[inline(always)]
pub(crate) fn even_bell(x: f32) -> f32 {
    const C: [f32; 9] =
        [0.017_986_21, -0.072_643_7, 0.146_330_1, -0.203_926_43, 0.198_660_63, -0.126_588_3, 0.092_874_266, -0.096_759_33, 0.044_118_337];
    polynomial(x.clamp(-REACH, REACH), C)
}

/// In 2x²/REACH² − 1, by Horner.
#[inline(always)]
fn polynomial(x: f32, coefficients: [f32; 9]) -> f32 {
    let t = x * x * (2.0 / (REACH * REACH)) - 1.0;
    coefficients.iter().rev().fold(0.0, |sum, &c| sum * t + c)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::print_stdout, reason = "a test says what it measured")]

    use super::*;

    #[test]
    fn the_polynomials_err_as_stated() {
        let mut most = [0.0_f64; 2];
        for x in (-60_000..=60_000).map(|i| f64::from(i) * 1e-4) {
            let off = [f64::from(centred_integral(x as f32)) + 0.5 - integral(x), f64::from(even_bell(x as f32)) - bell(x)];
            assert!(off[0].abs() < 4e-5 && off[1].abs() < 4.5e-4, "{x}: {off:?}");
            most = [0, 1].map(|k| most[k].max(off[k].abs()));
        }
        println!("reached: {:.0e} of the integral, {:.0e} of the bell; a byte's step is 4e-3", most[0], most[1]);
        for x in [50.0, 1e30, f32::INFINITY] {
            assert!((centred_integral(x) - 0.5).abs() < 1e-5 && (centred_integral(-x) + 0.5).abs() < 1e-5 && even_bell(x).abs() < 1e-4);
        }
        assert_eq!(centred_integral(0.0), 0.0);
    }
}
