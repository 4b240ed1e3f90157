//! What is sought.

use std::cmp::Ordering;

use super::Trial;
use super::estimate::Estimate;

/// What a search looks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Goal {
    /// The setting that costs least of those that err no more than this.
    WithinError(f64),
    /// The setting that errs least of those that cost no more than this.
    WithinCost(f64),
}

/// How much less than the best has to be expected of a setting to be worth a look.
const WORTHWHILE: f64 = 0.93;

/// The share by which a setting may cost more or less than its neighbours let expect, whatever they say.
const COST_JITTER: f64 = 0.01;

/// The same of errors, which are less even: where one hair more falls between two pixels the next falls into one.
const ERROR_JITTER: f64 = 0.03;

/// What is expected of a setting with regard to a goal.
pub(super) struct Prospect {
    /// How likely it is that the goal is met, and by clearly less than the best.
    pub(super) chance: f64,
    /// How much it promises; of two settings the one that promises more is measured first.
    pub(super) promise: f64,
}

impl Goal {
    /// Whether the goal is met.
    pub fn is_met_by(self, trial: &Trial) -> bool {
        match self {
            Self::WithinError(limit) => trial.error <= limit,
            Self::WithinCost(limit) => trial.cost <= limit,
        }
    }

    /// Of two that meet the goal the lesser is better; where they are even, the one that does better by what is limited.
    pub fn better(self, a: &Trial, b: &Trial) -> Ordering {
        match self {
            Self::WithinError(_) => by_cost(a, b).then(by_error(a, b)),
            Self::WithinCost(_) => by_error(a, b).then(by_cost(a, b)),
        }
    }

    /// Of two that do not meet it the lesser is nearer.
    pub fn nearer(self, a: &Trial, b: &Trial) -> Ordering {
        match self {
            Self::WithinError(_) => by_error(a, b).then(by_cost(a, b)),
            Self::WithinCost(_) => by_cost(a, b).then(by_error(a, b)),
        }
    }

    /// What a setting promises, given the logarithm of the cost and the error that are expected of it, and the best so far.
    pub(super) fn prospect(self, log_cost: Estimate, error: Estimate, best: Option<&Trial>) -> Prospect {
        let log_cost = log_cost.blurred(COST_JITTER);
        let error = error.blurred(ERROR_JITTER * error.mean.abs());
        let (meets, sought) = match self {
            Self::WithinError(limit) => (error.chance_below(limit), log_cost),
            Self::WithinCost(limit) => (log_cost.chance_below(libm::log(limit)), error),
        };
        let (best, worthwhile) = match (self, best) {
            (_, None) => return Prospect { chance: meets, promise: meets },
            // Nothing errs less than not at all.
            (Self::WithinCost(_), Some(best)) if best.error <= 0.0 => return Prospect { chance: 0.0, promise: 0.0 },
            (Self::WithinCost(_), Some(best)) => (best.error, WORTHWHILE * best.error),
            (Self::WithinError(_), Some(best)) => (libm::log(best.cost), libm::log(WORTHWHILE * best.cost)),
        };
        Prospect { chance: meets * sought.chance_below(worthwhile), promise: meets * sought.expected_gain(best) }
    }
}

fn by_cost(a: &Trial, b: &Trial) -> Ordering {
    a.cost.total_cmp(&b.cost)
}

fn by_error(a: &Trial, b: &Trial) -> Ordering {
    a.error.total_cmp(&b.error)
}
