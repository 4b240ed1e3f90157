//! The best of many settings by few evaluations.
//!
//! Each evaluation makes what is measured more surely known, and the next is of the setting that promises most: the expected gain over the best so far, times the
//! chance that the goal is met (J. R. Gardner and others: *Bayesian Optimization with Inequality Constraints*, ICML 2014). The search ends where no setting is left that has a chance
//! worth the look. What is expected of a setting is in `surrogate`.

mod estimate;
mod factor;
mod goal;
mod grid;
mod surrogate;

use thiserror::Error;

pub use goal::Goal;
use grid::Grid;
use surrogate::Surrogate;

/// The most settings of a grid that is searched.
pub const MAX_SETTINGS: usize = 100_000;

/// The chance of a better setting below which it is not looked for.
const CHANCE: f64 = 0.005;

/// A setting that was evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// For each knob the position of its value, from 0.
    pub setting: Vec<usize>,
    /// What it costs.
    pub cost: f64,
    /// How far it errs.
    pub error: f64,
}

/// What a search came to.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// Where the best is in `trials`.
    pub best: usize,
    /// What was evaluated, in order.
    pub trials: Vec<Trial>,
    /// Whether nothing better is expected; false if the search was cut short.
    pub settled: bool,
}

/// Why nothing was found.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SearchError<E> {
    /// A knob without values.
    #[error("knob {knob} has no values: give it one or more")]
    NoValues {
        /// Which, from 0.
        knob: usize,
    },
    /// A grid beyond [`MAX_SETTINGS`].
    #[error("the knobs have more than {MAX_SETTINGS} settings: give them fewer values")]
    TooManySettings,
    /// A limit that nothing could be under.
    #[error("a limit of {limit} cannot be kept: give a number from 0 up for an error, above 0 for a cost")]
    Limit {
        /// The limit.
        limit: f64,
    },
    /// A measurement that cannot be compared.
    #[error("setting {setting:?} costs {cost} and errs by {error}: a cost has to be above 0, an error not below, both finite")]
    Measurement {
        /// The setting.
        setting: Vec<usize>,
        /// Its cost.
        cost: f64,
        /// Its error.
        error: f64,
    },
    /// A setting could not be evaluated.
    #[error("a setting could not be evaluated")]
    Evaluate(E),
    /// No setting was found that meets the goal.
    #[error("{}", out_of_reach(.goal, .nearest, *.settled))]
    OutOfReach {
        /// What was sought.
        goal: Goal,
        /// What comes nearest: errs least, or costs least.
        nearest: Trial,
        /// What was evaluated, in order.
        trials: Vec<Trial>,
        /// Whether nothing nearer is expected; false if the search was cut short.
        settled: bool,
    },
}

fn out_of_reach(goal: &Goal, nearest: &Trial, settled: bool) -> String {
    let remedy = if settled { "" } else { ", or more evaluations" };
    match goal {
        Goal::WithinError(limit) => format!("no setting errs by {limit} or less, the least is {}: allow more{remedy}", nearest.error),
        Goal::WithinCost(limit) => format!("no setting costs {limit} or less, the least is {}: allow more{remedy}", nearest.cost),
    }
}

/// Finds the setting of a grid that a goal asks for, without evaluating most of them.
///
/// `knobs` says how many values each knob has, in an order in which the last is the finest: neighbours should be alike, but neither cost nor error has to rise or fall from one to the
/// next. `evaluate` gives cost and error of a setting and is asked for each at most once, the finest first, and for no more than `most` in all. What it does not depend on is chance:
/// same measurements, same search.
///
/// Against evaluating everything, over trade-offs made up at random: within a tenth of the best in more than 99 of 100, by 8 evaluations of 15 settings, 18 of 193 and 28 of 1128 (means, which `tests/search.rs` prints).
/// Before it says that nothing is in reach, it has seen all that differ by one knob from what comes nearest.
/// There is no guarantee: a single setting much better than all its neighbours is not seen.
///
/// # Errors
///
/// [`SearchError`]: the first error of `evaluate`, and [`OutOfReach`](SearchError::OutOfReach) if nothing was found that meets the goal.
///
/// # Example
///
/// ```
/// use pelage_accuracy::{Goal, search};
///
/// // Shells, and samples a pixel: costs multiply, errors add up.
/// let (shells, samples) = ([4.0, 8.0, 16.0, 32.0, 64.0], [1.0, 4.0]);
/// let evaluate = |setting: &[usize]| -> Result<(f64, f64), std::convert::Infallible> {
///     let (shells, samples) = (shells[setting[0]], samples[setting[1]]);
///     Ok(((5.0 + shells) * samples, 0.4 / shells + 0.02 / samples))
/// };
/// let found = search(&[5, 2], Goal::WithinError(0.05), 100, evaluate)?;
/// assert_eq!(found.trials[found.best].setting, [2, 0]);
/// assert!(found.settled && found.trials.len() < 10);
/// # Ok::<(), pelage_accuracy::SearchError<std::convert::Infallible>>(())
/// ```
pub fn search<E>(
    knobs: &[usize],
    goal: Goal,
    most: usize,
    evaluate: impl FnMut(&[usize]) -> Result<(f64, f64), E>,
) -> Result<Found, SearchError<E>> {
    check(knobs, goal)?;
    let mut search = Search::new(Grid::new(knobs), goal, evaluate);
    let settled = search.run(most.max(1))?;
    let trials = search.trials;
    let met = (0..trials.len()).filter(|&index| goal.is_met_by(&trials[index]));
    if let Some(best) = met.min_by(|&a, &b| goal.better(&trials[a], &trials[b])) {
        return Ok(Found { best, trials, settled });
    }
    match trials.iter().min_by(|a, b| goal.nearer(a, b)).cloned() {
        Some(nearest) => Err(SearchError::OutOfReach { goal, nearest, trials, settled }),
        None => Err(SearchError::NoValues { knob: 0 }),
    }
}

fn check<E>(knobs: &[usize], goal: Goal) -> Result<(), SearchError<E>> {
    if let Some(knob) = knobs.iter().position(|&count| count == 0) {
        return Err(SearchError::NoValues { knob });
    }
    if Grid::new(knobs).len().is_none_or(|len| len > MAX_SETTINGS) {
        return Err(SearchError::TooManySettings);
    }
    match goal {
        Goal::WithinError(limit) if limit.is_finite() && limit >= 0.0 => Ok(()),
        Goal::WithinCost(limit) if limit.is_finite() && limit > 0.0 => Ok(()),
        Goal::WithinError(limit) | Goal::WithinCost(limit) => Err(SearchError::Limit { limit }),
    }
}

/// What has been measured so far.
struct Search<'a, F> {
    grid: Grid<'a>,
    goal: Goal,
    evaluate: F,
    trials: Vec<Trial>,
    /// Where each trial is in the grid.
    places: Vec<Vec<f64>>,
    /// By number, whether a setting was evaluated.
    seen: Vec<bool>,
}

impl<'a, E, F: FnMut(&[usize]) -> Result<(f64, f64), E>> Search<'a, F> {
    fn new(grid: Grid<'a>, goal: Goal, evaluate: F) -> Self {
        let seen = vec![false; grid.len().unwrap_or(0)];
        Self { grid, goal, evaluate, trials: Vec::new(), places: Vec::new(), seen }
    }

    /// Evaluates until nothing better is expected, or so many are evaluated; whether it was the former.
    fn run(&mut self, most: usize) -> Result<bool, SearchError<E>> {
        let ends = self.grid.ends();
        for &number in ends.iter().take(most) {
            self.evaluate(number)?;
        }
        if ends.len() > most {
            return Ok(false);
        }
        while let Some(number) = self.most_promising().or_else(|| self.beside_the_nearest()) {
            if self.trials.len() >= most {
                return Ok(false);
            }
            self.evaluate(number)?;
        }
        Ok(true)
    }

    fn evaluate(&mut self, number: usize) -> Result<(), SearchError<E>> {
        let setting = self.grid.setting(number);
        let (cost, error) = (self.evaluate)(&setting).map_err(SearchError::Evaluate)?;
        if !(cost.is_finite() && cost > 0.0 && error.is_finite() && error >= 0.0) {
            return Err(SearchError::Measurement { setting, cost, error });
        }
        self.places.push(self.grid.place(&setting));
        self.trials.push(Trial { setting, cost, error });
        self.seen[number] = true;
        Ok(())
    }

    /// The setting to evaluate next, if any is worth it; of equals the first.
    fn most_promising(&self) -> Option<usize> {
        let log_cost = Surrogate::fit(&self.places, &self.trials.iter().map(|trial| libm::log(trial.cost)).collect::<Vec<_>>());
        let error = Surrogate::fit(&self.places, &self.trials.iter().map(|trial| trial.error).collect::<Vec<_>>());
        let met = self.trials.iter().filter(|trial| self.goal.is_met_by(trial));
        let best = met.min_by(|a, b| self.goal.better(a, b));
        let mut pick: Option<(f64, usize)> = None;
        for number in (0..self.seen.len()).filter(|&number| !self.seen[number]) {
            let place = self.grid.place(&self.grid.setting(number));
            let prospect = self.goal.prospect(log_cost.estimate(&place), error.estimate(&place), best);
            if prospect.chance >= CHANCE && pick.is_none_or(|(most, _)| prospect.promise > most) {
                pick = Some((prospect.promise, number));
            }
        }
        pick.map(|(_, number)| number)
    }

    /// Before nothing is said to be in reach: a setting that differs by one knob from what comes nearest, if there is one that was not evaluated.
    fn beside_the_nearest(&self) -> Option<usize> {
        if self.trials.iter().any(|trial| self.goal.is_met_by(trial)) {
            return None;
        }
        let nearest = self.trials.iter().min_by(|a, b| self.goal.nearer(a, b))?;
        let differing = |number: &usize| self.grid.setting(*number).iter().zip(&nearest.setting).filter(|(a, b)| a != b).count() == 1;
        (0..self.seen.len()).filter(|&number| !self.seen[number]).find(differing)
    }
}
