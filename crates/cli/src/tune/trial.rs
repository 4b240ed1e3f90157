//! Trying one setting after the other.

use std::sync::Arc;

use pelage_nodes::{Contender, Gpu, Picture, time_in_turn};

use super::Cost;
use super::sought::Measures;
use crate::failure::Failure;
use crate::measure::errors::Errors;
use crate::measure::plan::{Plan, prefixed};
use crate::measure::run::{Engine, times_of};

/// Cost and errors of a picture.
#[derive(Clone, Copy)]
pub(super) struct Worth {
    pub(super) fragments: Option<u64>,
    pub(super) bytes: usize,
    /// None where time is no matter.
    pub(super) ms: Option<f64>,
    pub(super) flip_mean: f64,
    pub(super) flip_p99: f64,
}

impl Worth {
    /// What was asked to be counted as cost; none where the adapter does not count.
    pub(super) fn cost(&self, cost: Cost) -> Option<f64> {
        match cost {
            Cost::Ms => self.ms,
            Cost::Fragments => self.fragments.map(|fragments| fragments as f64),
            Cost::Bytes => Some(self.bytes as f64),
        }
    }
}

/// A setting that was tried.
pub(super) struct Tried {
    /// Which of the plan's.
    pub(super) number: usize,
    pub(super) worth: Worth,
}

/// What it takes to try them.
pub(super) struct Bench<'a> {
    plan: &'a Plan,
    cost: Cost,
    rounds: u32,
    engine: Engine<'a>,
    truth: Arc<Picture>,
    clock: Option<Clock>,
    start: Worth,
    tried: Vec<Tried>,
    /// How many settings there may be in all.
    most: usize,
}

impl<'a> Bench<'a> {
    /// Makes the picture to measure against, and that of the graph as it is. At `most` so many settings are going to be tried.
    pub(super) fn new(plan: &'a Plan, cost: Cost, mut engine: Engine<'a>, rounds: u32, most: usize) -> Result<Self, Failure> {
        // There is one, as no cases are and no setting has its own.
        let truth = engine.reference(plan, 0)?;
        let (picture, contender) = engine.draw(plan, &plan.start, "the graph as it is")?;
        let mut clock = if cost == Cost::Ms { Some(Clock::new(contender.clone())?) } else { None };
        let start =
            worth(&truth, &picture, contender, clock.as_mut(), rounds).map_err(|failure| prefixed("the graph as it is: ", failure))?;
        Ok(Self { plan, cost, rounds, engine, truth, clock, start, tried: Vec::new(), most })
    }

    /// Cost and error of a setting. One that was tried before is not tried again.
    pub(super) fn evaluate(&mut self, number: usize) -> Result<(f64, f64), Failure> {
        if let Some(before) = self.tried.iter().find(|one| one.number == number) {
            return self.of(&before.worth);
        }
        let setting = &self.plan.settings[number];
        let values = setting.values.join(", ");
        let title = format!("{} of at most {}: {values}", self.tried.len() + 1, self.most);
        let (picture, contender) = self.engine.draw(self.plan, setting, &title)?;
        let worth = worth(&self.truth, &picture, contender, self.clock.as_mut(), self.rounds)
            .map_err(|failure| prefixed(&format!("{values}: "), failure))?;
        self.tried.push(Tried { number, worth });
        self.of(&worth)
    }

    /// What the graph as it is is worth.
    pub(super) fn as_it_is(&self) -> &Worth {
        &self.start
    }

    /// Cost and error.
    pub(super) fn of(&self, worth: &Worth) -> Result<(f64, f64), Failure> {
        let uncounted = || Failure::Input("this graphics adapter does not count fragments; tune for ms or bytes".into());
        Ok((worth.cost(self.cost).ok_or_else(uncounted)?, worth.flip_mean))
    }

    /// Milliseconds of settings that were tried, all timed anew in the same rounds, which is what is known of them from now on. That a frame seemed quickest of
    /// many may be luck, and luck does not last.
    pub(super) fn time_again(&mut self, numbers: &[usize]) -> Result<Vec<f64>, Failure> {
        let Some(clock) = &mut self.clock else { return Ok(Vec::new()) };
        let (engine, plan) = (&mut self.engine, self.plan);
        let draw = |number: &usize| Ok::<_, Failure>(engine.draw(plan, &plan.settings[*number], "timed again")?.1);
        let all = clock.time(numbers.iter().map(draw).collect::<Result<_, _>>()?, self.rounds)?;
        for (number, ms) in numbers.iter().zip(&all) {
            self.tried.iter_mut().filter(|one| one.number == *number).for_each(|one| one.worth.ms = Some(*ms));
        }
        Ok(all)
    }

    /// What was tried, in order.
    pub(super) fn tried(&self) -> &[Tried] {
        &self.tried
    }
}

impl Measures for Bench<'_> {
    fn start(&self) -> Result<(f64, f64), Failure> {
        self.of(&self.start)
    }

    fn measure(&mut self, number: usize) -> Result<(f64, f64), Failure> {
        self.evaluate(number)
    }
}

/// What a picture costs, and how far it is from the truth.
fn worth(truth: &Picture, picture: &Picture, contender: Contender, clock: Option<&mut Clock>, rounds: u32) -> Result<Worth, Failure> {
    let errors = Errors::of(truth, picture).map_err(|error| Failure::Input(error.to_string()))?;
    let fragments = contender.report().stats.fragments.map(|fragments| fragments.total());
    let bytes = contender.texture_bytes();
    let ms = clock.map(|clock| clock.time(vec![contender], rounds)).transpose()?;
    let ms = ms.and_then(|ms| ms.first().copied());
    Ok(Worth { fragments, bytes, ms, flip_mean: errors.flip_mean, flip_p99: errors.flip_p99 })
}

/// Times frames in turn with that of the graph as it is: whatever else the machine does slows both alike.
struct Clock {
    gpu: Gpu,
    start: Contender,
    /// Milliseconds of its frame, once they are known.
    start_ms: Option<f64>,
}

impl Clock {
    fn new(start: Contender) -> Result<Self, Failure> {
        Ok(Self { gpu: Gpu::new().map_err(|error| Failure::Input(error.to_string()))?, start, start_ms: None })
    }

    /// Milliseconds of each: of the start's frame at its quickest in the first rounds, times the median ratio within a round.
    fn time(&mut self, mut contenders: Vec<Contender>, rounds: u32) -> Result<Vec<f64>, Failure> {
        contenders.push(self.start.clone());
        let rounds = time_in_turn(&self.gpu, &contenders, rounds).map_err(|error| Failure::input("timing", &error))?;
        let last = contenders.len() - 1;
        let [least, ..] = times_of(&rounds, last);
        let start = *self.start_ms.get_or_insert(least);
        Ok((0..last).map(|index| times_of(&rounds, index)[2] * start).collect())
    }
}
