//! A number that is not known for sure.

/// A normal distribution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Estimate {
    pub(super) mean: f64,
    pub(super) deviation: f64,
}

impl Estimate {
    /// With some more uncertainty.
    pub(super) fn blurred(self, by: f64) -> Self {
        Self { deviation: self.deviation.hypot(by), ..self }
    }

    /// How likely it is to be at most so much.
    pub(super) fn chance_below(self, limit: f64) -> f64 {
        if self.deviation > 0.0 { normal_below((limit - self.mean) / self.deviation) } else { f64::from(self.mean <= limit) }
    }

    /// How much less than `best` is to be expected, more counting as nothing.
    pub(super) fn expected_gain(self, best: f64) -> f64 {
        let less = best - self.mean;
        if self.deviation <= 0.0 {
            return less.max(0.0);
        }
        let z = less / self.deviation;
        let density = libm::exp(-0.5 * z * z) / (2.0 * std::f64::consts::PI).sqrt();
        less * normal_below(z) + self.deviation * density
    }
}

/// How likely a normal number is to be below `z` deviations.
fn normal_below(z: f64) -> f64 {
    0.5 * libm::erfc(-z / std::f64::consts::SQRT_2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chances_and_gains_are_those_of_the_normal_distribution() {
        let estimate = Estimate { mean: 2.0, deviation: 0.5 };
        assert!((estimate.chance_below(2.0) - 0.5).abs() < 1e-12 && (estimate.chance_below(2.5) - 0.841_344_746).abs() < 1e-9);
        // At the mean the gain is a deviation over the root of two pi; far below the best it is the difference.
        assert!((estimate.expected_gain(2.0) - 0.5 * 0.398_942_280).abs() < 1e-9 && (estimate.expected_gain(12.0) - 10.0).abs() < 1e-9);
        let sure = Estimate { mean: 2.0, deviation: 0.0 };
        assert_eq!(
            (sure.chance_below(2.0), sure.chance_below(1.9), sure.expected_gain(3.0), sure.expected_gain(1.0)),
            (1.0, 0.0, 1.0, 0.0)
        );
        assert_eq!(sure.blurred(0.5), estimate);
    }
}
