//! How far apart shells stand (K4).

use libm::{expm1, pow};

use crate::error::{VolumeError, within};

/// How the heights of shells follow from their numbers; the skin is always at 0 and the outermost at 1.
///
/// After Kenwright, "A practical guide to generating real-time dynamic fur and hair using shells" (2014): outer shells closer together, as the silhouette is seen
/// through few of them. Both curves have outer shells closer for parameters above their neutral value, and inner ones below it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Spacing {
    /// Shell k of n at k/(n − 1).
    #[default]
    Even,
    /// 1 − (1 − x)^p, x = k/(n − 1), p from 0.1 to 4; 1 is even.
    Power(f64),
    /// (1 − e^(−rx))/(1 − e^(−r)), r from −8 to 8; 0 is even. The outermost spacing is e^(−r(n − 2)/(n − 1)) of the innermost.
    Exponential(f64),
}

impl Spacing {
    /// Refuses parameters out of range.
    ///
    /// # Errors
    /// Which parameter, and its range.
    pub fn validate(self) -> Result<(), VolumeError> {
        match self {
            Self::Even => Ok(()),
            Self::Power(power) => within("spacing power", power, 0.1, 4.0, "exponent"),
            Self::Exponential(rate) => within("spacing rate", rate, -8.0, 8.0, "rate"),
        }
    }

    /// The height, 0 to 1, of the shell at a part, 0 to 1, of the way through their number. Rises with it.
    pub fn height(self, part: f64) -> f64 {
        let part = part.clamp(0.0, 1.0);
        match self {
            Self::Power(power) => 1.0 - pow(1.0 - part, power),
            Self::Exponential(rate) if rate != 0.0 => expm1(-rate * part) / expm1(-rate),
            Self::Even | Self::Exponential(_) => part,
        }
    }

    /// The heights of so many shells, innermost first; a single one is the skin.
    pub fn heights(self, shells: u32) -> Vec<f64> {
        let steps = f64::from(shells.saturating_sub(1).max(1));
        (0..shells).map(|k| self.height(f64::from(k) / steps)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_spacing_goes_from_skin_to_tips_and_rises() {
        for spacing in
            [0.1, 0.5, 1.0, 2.0, 4.0].map(Spacing::Power).into_iter().chain([-8.0, -1e-9, 0.0, 1e-9, 8.0].map(Spacing::Exponential))
        {
            let heights = spacing.heights(256);
            assert!(heights[0] == 0.0 && (heights[255] - 1.0).abs() < 1e-12, "{spacing:?}");
            assert!(heights.windows(2).all(|pair| pair[1] > pair[0]), "{spacing:?}");
        }
        assert_eq!(Spacing::Even.heights(3), [0.0, 0.5, 1.0]);
        assert!((Spacing::Power(2.0).height(0.5) - 0.75).abs() < 1e-12);
        // The nearest power to none is even.
        assert!((Spacing::Exponential(1e-6).height(0.3) - 0.3).abs() < 1e-6);
        assert!(Spacing::Exponential(2.0).height(0.5) > 0.7 && Spacing::Exponential(-2.0).height(0.5) < 0.3);
    }

    #[test]
    fn outer_shells_of_an_exponential_spacing_are_closer_by_its_rate() {
        let heights = Spacing::Exponential(3.0).heights(11);
        let shares: Vec<f64> = heights.windows(3).map(|h| (h[2] - h[1]) / (h[1] - h[0])).collect();
        assert!(shares.iter().all(|share| (share - libm::exp(-0.3)).abs() < 1e-9), "{shares:?}");
    }

    #[test]
    fn parameters_out_of_range_are_refused() {
        for wrong in [Spacing::Power(0.0), Spacing::Power(f64::NAN), Spacing::Exponential(9.0)] {
            assert!(matches!(wrong.validate(), Err(VolumeError::OutOfRange { .. })), "{wrong:?}");
        }
    }
}
