//! What is expected of settings that were not measured, and how surely: Gaussian processes over the grid.
//!
//! C. E. Rasmussen, C. K. I. Williams: *Gaussian Processes for Machine Learning*, 2006, sections 2.2 and 5.2. What is told apart is how far a setting is from the finest, so that the
//! finest itself is known. Along each knob the difference wanders from value to value (Brownian motion, by its number of steps), as far as measurements went that differ in this knob alone;
//! any two knobs together may differ from their sum; and a little is left to each setting for itself. By how much the last two is a matter of hypotheses, each weighed by how likely it makes
//! what was measured.

use super::estimate::Estimate;
use super::factor::Factor;

/// How far two knobs together may be from the sum of both, as a share of the two: the hypotheses.
const INTERACTIONS: [f64; 5] = [0.01, 0.04, 0.15, 0.5, 1.5];

/// The share of all effects that is each setting's own, noise included: the hypotheses.
const OWN: [f64; 5] = [1e-6, 1e-4, 1e-3, 4e-3, 1e-2];

/// A hypothesis of less weight is left out.
const LEAST_WEIGHT: f64 = 1e-3;

/// The least that a knob is believed to do where it seemed to do less, as a share of the one that does most.
const LEAST_EFFECT: f64 = 0.1;

/// A quantity as it was measured at some settings of a grid.
pub(super) struct Surrogate<'a> {
    finest: f64,
    effects: Vec<f64>,
    /// For each measured setting, how far each knob is from its finest value, 0 to 1.
    places: &'a [Vec<f64>],
    /// Each with its weight; the weights are 1 in all.
    hypotheses: Vec<(f64, Hypothesis)>,
}

/// One way in which settings may be alike, with what was measured.
struct Hypothesis {
    kernel: Kernel,
    factor: Factor,
    /// The inverse of the covariance, times the differences.
    solved: Vec<f64>,
    /// The logarithm of how likely it makes what was measured.
    likelihood: f64,
}

/// How alike settings are.
#[derive(Clone, Copy)]
struct Kernel {
    interaction: f64,
    own: f64,
}

/// What two settings have in common.
#[derive(Clone, Copy)]
struct Common {
    /// By each knob alone.
    alone: f64,
    /// By each two of them.
    pairs: f64,
}

impl Common {
    fn of(effects: &[f64], a: &[f64], b: &[f64]) -> Self {
        let (mut sum, mut squares, mut alone) = (0.0, 0.0, 0.0);
        for ((&effect, a), b) in effects.iter().zip(a).zip(b) {
            let both = effect * a.min(*b);
            (sum, squares, alone) = (sum + both, squares + both * both, alone + effect * both);
        }
        // The square of the sum without the squares has each pair twice.
        Self { alone, pairs: 0.5 * (sum * sum - squares) }
    }
}

impl Kernel {
    /// Of two different settings.
    fn covariance(self, common: Common) -> f64 {
        common.alone + self.interaction * common.pairs
    }

    /// Of a setting and itself.
    fn variance(self, common: Common, effects: &[f64]) -> f64 {
        self.covariance(common) + self.own * effects.iter().map(|effect| effect * effect).sum::<f64>()
    }
}

impl<'a> Surrogate<'a> {
    /// From what was measured at some places, the finest first.
    pub(super) fn fit(places: &'a [Vec<f64>], measured: &[f64]) -> Self {
        let finest = measured.first().copied().unwrap_or(0.0);
        let differences: Vec<f64> = measured.iter().map(|value| value - finest).collect();
        let effects = effects(places, &differences);
        let kernels = INTERACTIONS.into_iter().flat_map(|interaction| OWN.map(|own| Kernel { interaction, own }));
        let all: Vec<Hypothesis> = kernels.map(|kernel| Hypothesis::new(kernel, &effects, places, &differences)).collect();
        Self { finest, effects, places, hypotheses: weighed(all) }
    }

    /// What is expected at a place that was not measured.
    pub(super) fn estimate(&self, at: &[f64]) -> Estimate {
        let common: Vec<Common> = self.places.iter().map(|place| Common::of(&self.effects, place, at)).collect();
        let itself = Common::of(&self.effects, at, at);
        let estimate = |one: &Hypothesis| one.estimate(&common, one.kernel.variance(itself, &self.effects));
        let estimates: Vec<(f64, Estimate)> = self.hypotheses.iter().map(|(weight, one)| (*weight, estimate(one))).collect();
        let mean = estimates.iter().map(|(weight, one)| weight * one.mean).sum::<f64>();
        // What each is unsure of, and where they disagree.
        let variance = |one: &Estimate| one.deviation * one.deviation + (one.mean - mean) * (one.mean - mean);
        let deviation = estimates.iter().map(|(weight, one)| weight * variance(one)).sum::<f64>().sqrt();
        Estimate { mean: self.finest + mean, deviation }
    }
}

impl Hypothesis {
    fn new(kernel: Kernel, effects: &[f64], places: &[Vec<f64>], differences: &[f64]) -> Self {
        let factor = Factor::of(places.len(), |row, column| {
            let common = Common::of(effects, &places[row], &places[column]);
            if row == column { kernel.variance(common, effects) } else { kernel.covariance(common) }
        });
        let half = factor.forward(differences);
        let likelihood = -0.5 * half.iter().map(|value| value * value).sum::<f64>() - factor.log_root_determinant();
        Self { kernel, solved: factor.backward(half), factor, likelihood }
    }

    /// By how much a place differs from the finest, from what it has in common with the measured ones and how far it may go.
    fn estimate(&self, common: &[Common], variance: f64) -> Estimate {
        let likeness: Vec<f64> = common.iter().map(|&common| self.kernel.covariance(common)).collect();
        let known: f64 = self.factor.forward(&likeness).iter().map(|value| value * value).sum();
        let mean = likeness.iter().zip(&self.solved).map(|(a, b)| a * b).sum();
        Estimate { mean, deviation: (variance - known).max(0.0).sqrt() }
    }
}

/// Each with its weight, as likely as it makes what was measured, without those of next to none.
fn weighed(all: Vec<Hypothesis>) -> Vec<(f64, Hypothesis)> {
    let most = all.iter().map(|one| one.likelihood).fold(f64::NEG_INFINITY, f64::max);
    let weight = |one: &Hypothesis| libm::exp(one.likelihood - most);
    let sum: f64 = all.iter().map(weight).sum();
    let mut kept: Vec<(f64, Hypothesis)> =
        all.into_iter().map(|one| (weight(&one) / sum, one)).filter(|(weight, _)| *weight > LEAST_WEIGHT).collect();
    let sum: f64 = kept.iter().map(|(weight, _)| weight).sum();
    kept.iter_mut().for_each(|(weight, _)| *weight /= sum);
    kept
}

/// How far each knob moves the quantity over all its values: the most that is needed to explain measurements that differ in it alone, where a walk goes as far as the root of its steps.
fn effects(places: &[Vec<f64>], differences: &[f64]) -> Vec<f64> {
    let mut effects = vec![0.0_f64; places.first().map_or(0, Vec::len)];
    for (index, (place, value)) in places.iter().zip(differences).enumerate() {
        for (other, before) in places[..index].iter().zip(differences) {
            let mut apart = (0..place.len()).filter(|&knob| place[knob] != other[knob]);
            if let (Some(knob), None) = (apart.next(), apart.next()) {
                let way = (place[knob] - other[knob]).abs();
                effects[knob] = effects[knob].max((value - before).abs() / way.sqrt());
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
