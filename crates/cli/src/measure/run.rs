//! Evaluating every setting with one engine, so that only what a setting changes is made again; then timing all in turn.

use std::sync::Arc;

use pelage_graph::{CheckedGraph, Evaluation, Evaluator, Request};
use pelage_nodes::{Contender, Gpu, Picture, time_in_turn};
use rayon::prelude::*;

use super::errors::Errors;
use super::plan::{Plan, Setting};
use crate::failure::Failure;
use crate::running::Running;

/// All there is to know.
pub(crate) struct Measured {
    pub(crate) settings: Vec<MeasuredSetting>,
    /// The least and the median of each setting's times in milliseconds, and the median of its ratios to the last of its group.
    pub(crate) times: Vec<[f64; 3]>,
    /// Whether all were measured against one picture.
    pub(crate) one_reference: bool,
    /// Of all that was measured.
    pub(crate) fingerprint: String,
}

/// One setting's picture, what it was measured against, and the errors.
pub(crate) struct MeasuredSetting {
    pub(crate) picture: Arc<Picture>,
    pub(crate) reference: Arc<Picture>,
    pub(crate) contender: Contender,
    pub(crate) errors: Errors,
}

/// Draws every setting, then times each frame so many times.
pub(crate) fn measure(plan: &Plan, engine: &mut Engine<'_>, rounds: u32) -> Result<Measured, Failure> {
    let mut references: Vec<Option<Arc<Picture>>> = vec![None; plan.references.len()];
    let mut drawn = Vec::new();
    for (index, setting) in plan.settings.iter().enumerate() {
        let reference = match &references[setting.reference] {
            Some(made) => made.clone(),
            None => engine.reference(plan, setting.reference)?,
        };
        references[setting.reference] = Some(reference.clone());
        let title = format!("{} of {}: {}", index + 1, plan.settings.len(), setting.values.join(", "));
        let (picture, contender) = engine.draw(plan, setting, &title)?;
        drawn.push((picture, reference, contender));
    }
    let contenders: Vec<Contender> = drawn.iter().map(|(_, _, contender)| contender.clone()).collect();
    let times = times(plan, &contenders, rounds)?;
    let measured = |(index, (picture, reference, contender)): (usize, (Arc<Picture>, Arc<Picture>, Contender))| {
        let about = || plan.settings[index].values.join(", ");
        let errors = Errors::of(&reference, &picture).map_err(|error| Failure::input(about(), &error))?;
        Ok(MeasuredSetting { picture, reference, contender, errors })
    };
    let settings = drawn.into_par_iter().enumerate().map(measured).collect::<Result<Vec<_>, Failure>>()?;
    Ok(Measured { settings, times, one_reference: plan.references.len() == 1, fingerprint: plan.fingerprint()? })
}

/// Times of all settings, those of a group in turn; only a group's coats are on the device at once.
fn times(plan: &Plan, contenders: &[Contender], rounds: u32) -> Result<Vec<[f64; 3]>, Failure> {
    let gpu = Gpu::new().map_err(|error| Failure::Input(error.to_string()))?;
    let mut times = vec![[f64::NAN; 3]; contenders.len()];
    for group in plan.groups() {
        let own: Vec<Contender> = group.rows.iter().map(|&index| contenders[index].clone()).collect();
        let rounds = time_in_turn(&gpu, &own, rounds).map_err(|error| Failure::input("timing", &error))?;
        for (place, &index) in group.rows.iter().enumerate() {
            times[index] = times_of(&rounds, place);
        }
    }
    Ok(times)
}

/// The least and the median of a setting's times, and the median of their ratios to the last setting's.
pub(crate) fn times_of(rounds: &[Vec<f64>], index: usize) -> [f64; 3] {
    let mut times: Vec<f64> = rounds.iter().map(|round| round[index]).collect();
    let mut ratios: Vec<f64> = rounds.iter().map(|round| round[index] / round[round.len() - 1]).collect();
    let median = |numbers: &mut [f64]| {
        numbers.sort_by(f64::total_cmp);
        numbers.get(numbers.len() / 2).copied().unwrap_or(f64::NAN)
    };
    let (middle, ratio) = (median(&mut times), median(&mut ratios));
    [times.first().copied().unwrap_or(f64::NAN), middle, ratio]
}

/// What evaluates: one cache for all, so that only what a setting changes is made again.
pub(crate) struct Engine<'a> {
    evaluator: Evaluator,
    running: &'a Running,
}

impl<'a> Engine<'a> {
    pub(crate) fn new(running: &'a Running) -> Self {
        Self { evaluator: running.evaluator(), running }
    }

    /// What settings are measured against. An equal one that was made before is in the cache.
    pub(crate) fn reference(&mut self, plan: &Plan, index: usize) -> Result<Arc<Picture>, Failure> {
        let title = match plan.references.len() {
            1 => "what is measured against".to_owned(),
            count => format!("what is measured against, {} of {count}", index + 1),
        };
        Ok(self.run(&plan.references[index], Request::output(&plan.against), &title)?.get::<Picture>(&plan.against)?)
    }

    /// The picture of a setting, ready to be timed.
    pub(crate) fn draw(&mut self, plan: &Plan, setting: &Setting, title: &str) -> Result<(Arc<Picture>, Contender), Failure> {
        let frame = format!("{}.frame", plan.picture);
        let request = Request::output(&plan.output).and_output(&frame).and_on_the_way(&setting.fur);
        let evaluation = self.run(&setting.graph, request, title)?;
        Ok((evaluation.get(&plan.output)?, Contender::of(&evaluation, &setting.fur, &frame)?))
    }

    fn run(&mut self, graph: &CheckedGraph, request: Request, title: &str) -> Result<Evaluation, Failure> {
        let progress = self.running.progress();
        progress.title(title);
        let evaluation = self.evaluator.run(graph, &request.with_observer(progress.clone()));
        progress.clear();
        let evaluation = evaluation?;
        progress.finish(&evaluation);
        Ok(evaluation)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ratio_is_taken_within_a_round() {
        // The machine was ten times as slow in the second round.
        let rounds = [vec![2.0, 4.0], vec![20.0, 40.0], vec![3.0, 4.0]];
        assert_eq!(times_of(&rounds, 0), [2.0, 3.0, 0.5]);
        assert_eq!(times_of(&rounds, 1), [4.0, 4.0, 1.0]);
    }
}
