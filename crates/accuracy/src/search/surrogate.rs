//! What is expected of settings that were not measured, and how surely: a Gaussian process over the grid.
//!
//! C. E. Rasmussen, C. K. I. Williams: *Gaussian Processes for Machine Learning*, 2006, sections 2.2 and 5.4. What is told apart is how far a setting is from the finest, so that the
//! finest itself is known. Along each knob the difference wanders from value to value (Brownian motion, by its number of steps), as far as was measured from one end to the other;
//! any two knobs together may differ from their sum, by how much the measurements say; and a little is left to each setting for itself.

use super::estimate::Estimate;
use super::factor::Factor;

/// How far two knobs together may be from the sum of both, as a share of the two: what is tried.
const INTERACTIONS: [f64; 5] = [0.01, 0.04, 0.15, 0.5, 1.5];

/// The share of all effects that is each setting's own, noise included: what is tried.
const OWN: [f64; 5] = [1e-6, 1e-4, 1e-3, 4e-3, 1e-2];

/// The least that a knob is believed to do where it seemed to do less, as a share of the one that does most.
const LEAST_EFFECT: f64 = 0.03;

/// A quantity as it was measured at some settings of a grid.
pub(super) struct Surrogate<'a> {
    finest: f64,
    effects: Vec<f64>,
    /// For each measured setting, how far each knob is from its finest value, 0 to 1.
    places: &'a [Vec<f64>],
    kernel: Kernel,
    factor: Factor,
    /// The inverse of the covariance, times the differences.
    weights: Vec<f64>,
    /// How likely the measurements are, as a logarithm.
    likelihood: f64,
}

/// How alike two settings are.
#[derive(Clone, Copy)]
struct Kernel {
    interaction: f64,
    own: f64,
}

impl Kernel {
    /// Of two different settings, or a setting and itself without what is its own.
    fn covariance(self, effects: &[f64], a: &[f64], b: &[f64]) -> f64 {
        let (mut sum, mut squares, mut alone) = (0.0, 0.0, 0.0);
        for ((&effect, a), b) in effects.iter().zip(a).zip(b) {
            let shared = a.min(*b);
            let both = effect * shared;
            (sum, squares, alone) = (sum + both, squares + both * both, alone + effect * both);
        }
        // All pairs: the square of the sum without the squares, each pair once.
        alone + self.interaction * 0.5 * (sum * sum - squares)
    }

    fn variance(self, effects: &[f64], at: &[f64]) -> f64 {
        self.covariance(effects, at, at) + self.own * effects.iter().map(|effect| effect * effect).sum::<f64>()
    }
}

impl<'a> Surrogate<'a> {
    /// From what was measured at some places, the finest first: by the kernel under which it is likeliest.
    pub(super) fn fit(places: &'a [Vec<f64>], measured: &[f64]) -> Self {
        let finest = measured.first().copied().unwrap_or(0.0);
        let differences: Vec<f64> = measured.iter().map(|value| value - finest).collect();
        let effects = effects(places, &differences);
        let with = |interaction, own| Self::with(Kernel { interaction, own }, finest, effects.clone(), places, &differences);
        let mut best = with(INTERACTIONS[0], OWN[0]);
        for (interaction, own) in INTERACTIONS.into_iter().flat_map(|interaction| OWN.map(|own| (interaction, own))).skip(1) {
            let next = with(interaction, own);
            if next.likelihood > best.likelihood {
                best = next;
            }
        }
        best
    }

    fn with(kernel: Kernel, finest: f64, effects: Vec<f64>, places: &'a [Vec<f64>], differences: &[f64]) -> Self {
        let factor = Factor::of(places.len(), |row, column| match row == column {
            true => kernel.variance(&effects, &places[row]),
            false => kernel.covariance(&effects, &places[row], &places[column]),
        });
        let half = factor.forward(differences);
        let likelihood = -0.5 * half.iter().map(|value| value * value).sum::<f64>() - factor.log_root_determinant();
        let weights = factor.backward(half);
        Self { finest, effects, places, kernel, factor, weights, likelihood }
    }

    /// What is expected at a place that was not measured.
    pub(super) fn estimate(&self, at: &[f64]) -> Estimate {
        let likeness: Vec<f64> = self.places.iter().map(|place| self.kernel.covariance(&self.effects, place, at)).collect();
        let mean = self.finest + likeness.iter().zip(&self.weights).map(|(a, b)| a * b).sum::<f64>();
        let known: f64 = self.factor.forward(&likeness).iter().map(|value| value * value).sum();
        let variance = self.kernel.variance(&self.effects, at) - known;
        Estimate { mean, deviation: variance.max(0.0).sqrt() }
    }
}

/// How far each knob was seen to move the quantity, the others left alone: at the least as far as from one of its ends to the other, the others at their finest.
fn effects(places: &[Vec<f64>], differences: &[f64]) -> Vec<f64> {
    let mut effects = vec![0.0_f64; places.first().map_or(0, Vec::len)];
    for (index, (place, value)) in places.iter().zip(differences).enumerate() {
        for (other, before) in places[..index].iter().zip(differences) {
            let mut apart = (0..place.len()).filter(|&knob| place[knob] != other[knob]);
            if let (Some(knob), None) = (apart.next(), apart.next()) {
                effects[knob] = effects[knob].max((value - before).abs());
            }
        }
    }
    let most = effects.iter().copied().fold(f64::MIN_POSITIVE.sqrt(), f64::max);
    effects.into_iter().map(|effect| effect.max(LEAST_EFFECT * most)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places() -> Vec<Vec<f64>> {
        vec![vec![0.0, 0.0], vec![1.0, 0.0], vec![0.0, 1.0], vec![1.0, 1.0]]
    }

    #[test]
    fn what_was_measured_is_expected_and_what_lies_between_is_in_between() {
        let places = places();
        let surrogate = Surrogate::fit(&places, &[5.0, 3.0, 4.5, 2.5]);
        for (place, measured) in places.iter().zip([5.0, 3.0, 4.5, 2.5]) {
            let estimate = surrogate.estimate(place);
            assert!((estimate.mean - measured).abs() < 0.02, "{place:?}: {estimate:?}");
        }
        let between = surrogate.estimate(&[0.5, 0.0]);
        assert!((between.mean - 4.0).abs() < 0.05, "{between:?}");
        // Anywhere between 3 and 5 is as likely.
        assert!(between.deviation > 0.5 && between.deviation < 1.5, "{between:?}");
        assert!(surrogate.estimate(&[1.0, 0.0]).deviation < 0.1);
    }

    #[test]
    fn what_knobs_do_together_is_uncertain_until_it_is_seen() {
        let places = places();
        let unseen = Surrogate::fit(&places[..3], &[0.0, 1.0, 1.0]).estimate(&[1.0, 1.0]);
        assert!((unseen.mean - 2.0).abs() < 0.1 && unseen.deviation > 0.05, "{unseen:?}");
        // Of two that do nothing more together, three do nothing more either; of two that do, they may.
        let seen = |both: f64| Surrogate::fit(&places, &[0.0, 1.0, 1.0, both]).estimate(&[0.5, 1.0]).mean;
        assert!((seen(2.0) - 1.5).abs() < 0.02 && seen(1.0) < 1.3, "{} {}", seen(2.0), seen(1.0));
    }

    #[test]
    fn a_knob_that_does_nothing_alone_is_still_uncertain_and_one_quantity_everywhere_is_finite() {
        let places = places();
        assert!(Surrogate::fit(&places[..3], &[0.0, 1.0, 0.0]).estimate(&[0.0, 0.5]).deviation > 0.001);
        let flat = Surrogate::fit(&places, &[1.0; 4]).estimate(&[0.5, 0.5]);
        assert!(flat.mean == 1.0 && flat.deviation.is_finite(), "{flat:?}");
    }
}
