//! The search against evaluating everything, over trade-offs made up at random.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test may panic; what the book says of the search is printed"
)]

use std::collections::BTreeSet;
use std::convert::Infallible;

use pelage_accuracy::{Found, Goal, SearchError, search};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

/// How what several knobs do comes together.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Together {
    /// Costs multiply, errors add up.
    Plainly,
    /// Costs multiply beside a fixed cost, squares of errors add up.
    AsSquares,
    /// Costs add up; each error is of what the others have left.
    OfTheRest,
    /// Costs multiply beside a fixed cost; only the largest error shows.
    AsLargest,
    /// As squares; each setting's cost is off by up to 1.5 % and its error by up to 5 %, at random.
    Noisily,
    /// As squares; the first two values of each knob are the wrong way round.
    OutOfOrder,
}

const ALL: [Together; 6] =
    [Together::Plainly, Together::AsSquares, Together::OfTheRest, Together::AsLargest, Together::Noisily, Together::OutOfOrder];

/// What one knob does: the logarithm of its cost, rising, and its error, falling, each by value.
#[derive(Clone, Debug)]
struct Knob {
    log_cost: Vec<f64>,
    error: Vec<f64>,
}

/// Rises from 0 to `to` in steps that are uneven.
fn rising(count: usize, to: f64, power: f64, unevenness: &[f64]) -> Vec<f64> {
    let mut values: Vec<f64> =
        (0..count).map(|index| to * (index as f64 / (count - 1) as f64).powf(power) * (1.0 + unevenness[index])).collect();
    values.sort_by(f64::total_cmp);
    values
}

fn knob(most: usize) -> impl Strategy<Value = Knob> {
    let uneven = || proptest::collection::vec(-0.3..0.3, most);
    // One knob in four costs next to nothing, as fins do.
    let cost = prop_oneof![3 => 0.1..2.5, 1 => Just(0.02)];
    (2..=most, cost, 0.4..3.0, uneven(), 0.0..1.0f64, 0.4..3.0, uneven()).prop_map(
        |(count, cost, cost_power, cost_uneven, error, power, error_uneven)| {
            let mut error = rising(count, 0.4 * error * error, power, &error_uneven);
            error.reverse();
            let finest = error[count - 1];
            error.iter_mut().for_each(|error| *error -= finest);
            Knob { log_cost: rising(count, cost, cost_power, &cost_uneven), error }
        },
    )
}

/// Every setting of a grid, evaluated.
#[derive(Clone, Debug)]
struct TradeOff {
    counts: Vec<usize>,
    rows: Vec<(f64, f64)>,
}

impl TradeOff {
    fn new(knobs: &[Knob], together: Together, fixed: f64, base: f64, noise: &[(f64, f64)]) -> Self {
        let counts: Vec<usize> = knobs.iter().map(|knob| knob.error.len()).collect();
        let row = |number: usize| {
            let (mut rest, mut at) = (number, Vec::new());
            for knob in knobs.iter().rev() {
                let value = rest % knob.error.len();
                at.push((knob, if together == Together::OutOfOrder && value < 2 { 1 - value } else { value }));
                rest /= knob.error.len();
            }
            let product = at.iter().map(|(knob, value)| knob.log_cost[*value]).sum::<f64>().exp();
            let sum: f64 = at.iter().map(|(knob, value)| knob.log_cost[*value].exp()).sum();
            let errors: Vec<f64> = at.iter().map(|(knob, value)| knob.error[*value]).collect();
            let squares = (base * base + errors.iter().map(|error| error * error).sum::<f64>()).sqrt();
            let (cost, error) = match together {
                Together::Plainly => (product, base + errors.iter().sum::<f64>()),
                Together::AsSquares | Together::OutOfOrder => (fixed + product, squares),
                Together::OfTheRest => (sum, 1.0 - (1.0 - base) * errors.iter().map(|error| 1.0 - error).product::<f64>()),
                Together::AsLargest => (fixed + product, errors.iter().copied().fold(base, f64::max)),
                Together::Noisily => {
                    let (cost, error) = noise[number % noise.len()];
                    (product * (1.0 + 0.015 * cost), squares * (1.0 + 0.05 * error))
                }
            };
            (1e5 * cost, error)
        };
        let len = counts.iter().product();
        Self { rows: (0..len).map(row).collect(), counts }
    }

    fn at(&self, setting: &[usize]) -> (f64, f64) {
        self.rows[setting.iter().zip(&self.counts).fold(0, |number, (position, count)| number * count + position)]
    }

    fn search(&self, goal: Goal, most: usize) -> Result<Found, SearchError<Infallible>> {
        search(&self.counts, goal, most, |setting| Ok(self.at(setting)))
    }

    /// A limit that `share` of all settings keep.
    fn goal(&self, within_error: bool, share: f64) -> Goal {
        let mut values: Vec<f64> = self.rows.iter().map(|row| if within_error { row.1 } else { row.0 }).collect();
        values.sort_by(f64::total_cmp);
        let limit = values[((values.len() - 1) as f64 * share) as usize];
        if within_error { Goal::WithinError(limit) } else { Goal::WithinCost(limit) }
    }

    /// The best of all, by looking at all.
    fn best(&self, goal: Goal) -> Option<f64> {
        let met = self.rows.iter().filter_map(|&(cost, error)| match goal {
            Goal::WithinError(limit) => (error <= limit).then_some(cost),
            Goal::WithinCost(limit) => (cost <= limit).then_some(error),
        });
        met.min_by(f64::total_cmp)
    }
}

fn sought(goal: Goal, trial: &pelage_accuracy::Trial) -> f64 {
    if matches!(goal, Goal::WithinError(_)) { trial.cost } else { trial.error }
}

fn trade_off(
    knobs: std::ops::RangeInclusive<usize>,
    values: usize,
    together: impl Strategy<Value = Together>,
) -> impl Strategy<Value = TradeOff> {
    let noise = proptest::collection::vec((-1.0..1.0, -1.0..1.0), 997);
    let base = prop_oneof![Just(0.0), 0.02..0.2];
    (proptest::collection::vec(knob(values), knobs), together, 0.1..2.0, base, noise)
        .prop_map(|(knobs, together, fixed, base, noise)| TradeOff::new(&knobs, together, fixed, base, &noise))
}

/// How a search fares over many trade-offs of a kind.
#[derive(Default)]
struct Tally {
    cases: usize,
    within: usize,
    evaluations: usize,
    settings: usize,
}

impl Tally {
    fn add(&mut self, trade_off: &TradeOff, goal: Goal) {
        let best = trade_off.best(goal).unwrap();
        self.cases += 1;
        self.settings += trade_off.rows.len();
        match trade_off.search(goal, 100) {
            Ok(found) => {
                self.evaluations += found.trials.len();
                self.within += usize::from(sought(goal, &found.trials[found.best]) <= 1.1 * best);
            }
            Err(SearchError::OutOfReach { trials, .. }) => self.evaluations += trials.len(),
            Err(error) => panic!("{error}"),
        }
    }
}

/// So many trade-offs of each kind, the same in every run, with a limit of either sort that 2 to 70 % of their settings keep.
fn tallied(title: &str, knobs: std::ops::RangeInclusive<usize>, values: usize, cases: usize) -> Tally {
    let mut all = Tally::default();
    for together in ALL {
        let mut runner = TestRunner::deterministic();
        let mut tally = Tally::default();
        for _ in 0..cases {
            let strategy = (trade_off(knobs.clone(), values, Just(together)), 0.02..0.7);
            let (trade_off, share) = strategy.new_tree(&mut runner).unwrap().current();
            for within_error in [true, false] {
                tally.add(&trade_off, trade_off.goal(within_error, share));
            }
        }
        let mean = |sum: usize| sum as f64 / tally.cases as f64;
        let (within, evaluations, settings) = (100.0 * mean(tally.within), mean(tally.evaluations), mean(tally.settings));
        println!("| {title} | {together:?} | {settings:.0} | {evaluations:.1} | {within:.1} % |");
        all.cases += tally.cases;
        all.within += tally.within;
        all.evaluations += tally.evaluations;
        all.settings += tally.settings;
    }
    all
}

#[test]
fn it_is_within_a_tenth_of_the_best_by_few_evaluations() {
    for (title, knobs, values, cases, share) in
        [("2 or 3 knobs", 2..=3, 4, 60, 0.6), ("3 or 4 knobs", 3..=4, 6, 25, 0.15), ("5 knobs", 5..=5, 6, 2, 0.05)]
    {
        let tally = tallied(title, knobs, values, cases);
        assert!(tally.within as f64 >= 0.98 * tally.cases as f64, "{title}: {} of {}", tally.within, tally.cases);
        assert!((tally.evaluations as f64) < share * tally.settings as f64, "{title}: {} of {}", tally.evaluations, tally.settings);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn whatever_is_sought_what_is_found_keeps_the_limit(
        trade_off in trade_off(1..=3, 5, proptest::sample::select(&ALL)), within_error: bool, share in 0.0..1.0, beyond in 0.5..1.5, most in 1usize..40,
    ) {
        let goal = match trade_off.goal(within_error, share) {
            Goal::WithinError(limit) => Goal::WithinError(limit * beyond),
            Goal::WithinCost(limit) => Goal::WithinCost(limit * beyond),
        };
        let result = trade_off.search(goal, most);
        prop_assert_eq!(&result, &trade_off.search(goal, most), "twice the same");
        let (trials, settled) = match &result {
            Ok(found) => {
                let best = &found.trials[found.best];
                prop_assert!(goal.is_met_by(best));
                prop_assert!(found.trials.iter().filter(|trial| goal.is_met_by(trial)).all(|trial| sought(goal, best) <= sought(goal, trial)));
                (&found.trials, found.settled)
            }
            Err(SearchError::OutOfReach { nearest, trials, settled, .. }) => {
                prop_assert!(trials.iter().all(|trial| !goal.is_met_by(trial)));
                let excess = |trial: &pelage_accuracy::Trial| if within_error { trial.error } else { trial.cost };
                prop_assert!(trials.iter().all(|trial| excess(nearest) <= excess(trial)));
                (trials, *settled)
            }
            Err(error) => return Err(TestCaseError::fail(error.to_string())),
        };
        prop_assert!(trials.len() <= most && (settled || trials.len() == most));
        let distinct: BTreeSet<&[usize]> = trials.iter().map(|trial| &*trial.setting).collect();
        prop_assert_eq!(distinct.len(), trials.len(), "a setting is evaluated once");
        prop_assert!(trials.iter().all(|trial| trade_off.at(&trial.setting) == (trial.cost, trial.error)));
    }
}

#[test]
fn one_setting_and_settings_all_alike_are_searched_too() {
    let search = |knobs: &[usize], goal| search(knobs, goal, 100, |_| Ok::<_, Infallible>((3.0, 0.25)));
    for knobs in [&[][..], &[1, 1], &[3, 2]] {
        let found = search(knobs, Goal::WithinError(0.25)).unwrap();
        assert!(found.settled && found.trials[found.best].cost == 3.0, "{found:?}");
        let error = search(knobs, Goal::WithinCost(2.5)).unwrap_err();
        assert_eq!(error.to_string(), "no setting costs 2.5 or less, the least is 3: allow more");
    }
}

#[test]
fn what_hides_between_ends_that_are_alike_is_found_before_giving_up() {
    let errors = [0.5, 0.5, 0.5, 0.05, 0.5, 0.5];
    let evaluate = |setting: &[usize]| Ok::<_, Infallible>((1.0 + setting[0] as f64, errors[setting[0]]));
    let found = search(&[6], Goal::WithinError(0.1), 100, evaluate).unwrap();
    assert_eq!(found.trials[found.best].setting, [3]);
    let Err(SearchError::OutOfReach { nearest, trials, .. }) = search(&[6], Goal::WithinError(0.01), 100, evaluate) else {
        panic!("nothing errs so little")
    };
    assert_eq!((nearest.setting, trials.len()), (vec![3], 6));
}

#[test]
fn what_cannot_be_searched_is_said() {
    let fine = |_: &[usize]| Ok::<_, String>((1.0, 0.0));
    assert_eq!(search(&[2, 0], Goal::WithinError(0.1), 9, fine), Err(SearchError::NoValues { knob: 1 }));
    assert_eq!(search(&[1000, 1000], Goal::WithinError(0.1), 9, fine), Err(SearchError::TooManySettings));
    assert_eq!(search(&[usize::MAX, 3], Goal::WithinError(0.1), 9, fine), Err(SearchError::TooManySettings));
    for goal in [Goal::WithinError(-0.1), Goal::WithinError(f64::INFINITY), Goal::WithinCost(0.0)] {
        assert!(matches!(search(&[2], goal, 9, fine), Err(SearchError::Limit { .. })), "{goal:?}");
    }
    for (cost, error) in [(0.0, 0.1), (f64::NAN, 0.1), (1.0, f64::INFINITY), (1.0, -0.1)] {
        let result = search(&[2], Goal::WithinError(0.1), 9, |_| Ok::<_, String>((cost, error)));
        assert!(matches!(&result, Err(SearchError::Measurement { setting, .. }) if setting == &[1]), "{result:?}");
    }
    let broken = search(&[2], Goal::WithinError(0.1), 9, |setting| if setting == [0] { Err("no device") } else { Ok((1.0, 0.5)) });
    assert_eq!(broken, Err(SearchError::Evaluate("no device")));
    let error = search(&[9], Goal::WithinError(0.1), 1, |_| Ok::<_, String>((1.0, 0.5))).unwrap_err();
    assert!(error.to_string().ends_with("the least is 0.5: allow more, or more evaluations"), "{error}");
}
