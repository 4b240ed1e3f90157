//! Evaluating every setting with one engine, so that only what a setting changes is made again; then timing all in turn.

use std::sync::Arc;

use pelage_graph::{CheckedGraph, Evaluation, Evaluator, Request};
use pelage_nodes::{Contender, Gpu, Picture, time_in_turn};
use rayon::prelude::*;

use super::errors::Errors;
use super::plan::{Plan, Setting};
use crate::failure::Failure;
use crate::progress::Progress;
use crate::render::CACHE_BYTES;

/// How to go about it.
pub(crate) struct How {
    pub(crate) rounds: u32,
    pub(crate) threads: Option<u16>,
    pub(crate) quiet: bool,
    pub(crate) verbose: bool,
}

/// All there is to know.
pub(crate) struct Measured {
    pub(crate) settings: Vec<MeasuredSetting>,
    /// Milliseconds: rounds of all settings.
    pub(crate) rounds: Vec<Vec<f64>>,
    /// Whether all were measured against one picture.
    pub(crate) one_reference: bool,
}

/// One setting's picture, what it was measured against, and the errors.
pub(crate) struct MeasuredSetting {
    pub(crate) picture: Arc<Picture>,
    pub(crate) reference: Arc<Picture>,
    pub(crate) contender: Contender,
    pub(crate) errors: Errors,
}

pub(crate) fn measure(plan: &Plan, how: &How) -> Result<Measured, Failure> {
    let mut engine = Engine::new(how);
    let shared = plan.finest.as_ref().map(|graph| engine.truth(plan, graph)).transpose()?;
    let mut drawn = Vec::new();
    for (index, setting) in plan.settings.iter().enumerate() {
        let own = setting.finest.as_ref().map(|graph| engine.truth(plan, graph)).transpose()?;
        let reference = own.or_else(|| shared.clone());
        let reference = reference.ok_or_else(|| Failure::Input(format!("{}: nothing to measure against", plan.output)))?;
        let title = format!("{} of {}: {}", index + 1, plan.settings.len(), setting.values.join(", "));
        let (picture, contender) = engine.draw(plan, setting, &title)?;
        drawn.push((picture, reference, contender));
    }
    let contenders: Vec<Contender> = drawn.iter().map(|(_, _, contender)| contender.clone()).collect();
    let gpu = Gpu::new().map_err(|error| Failure::Input(error.to_string()))?;
    let rounds = time_in_turn(&gpu, &contenders, how.rounds).map_err(|error| Failure::input("timing", &error))?;
    let measured = |(index, (picture, reference, contender)): (usize, (Arc<Picture>, Arc<Picture>, Contender))| {
        let about = || plan.settings[index].values.join(", ");
        let errors = Errors::of(&reference, &picture).map_err(|error| Failure::input(about(), &error))?;
        Ok(MeasuredSetting { picture, reference, contender, errors })
    };
    let settings = drawn.into_par_iter().enumerate().map(measured).collect::<Result<Vec<_>, Failure>>()?;
    Ok(Measured { settings, rounds, one_reference: shared.is_some() })
}

/// What evaluates: one cache for all, so that only what a setting changes is made again.
pub(crate) struct Engine<'a> {
    evaluator: Evaluator,
    how: &'a How,
}

impl<'a> Engine<'a> {
    pub(crate) fn new(how: &'a How) -> Self {
        let mut evaluator = pelage_nodes::evaluator(CACHE_BYTES);
        if let Some(threads) = how.threads {
            evaluator = evaluator.threads(threads.into());
        }
        Self { evaluator, how }
    }

    /// The picture to measure against.
    pub(crate) fn truth(&mut self, plan: &Plan, graph: &CheckedGraph) -> Result<Arc<Picture>, Failure> {
        Ok(self.run(graph, Request::output(&plan.against), "what is measured against")?.get::<Picture>(&plan.against)?)
    }

    /// The picture of a setting, ready to be timed.
    pub(crate) fn draw(&mut self, plan: &Plan, setting: &Setting, title: &str) -> Result<(Arc<Picture>, Contender), Failure> {
        let frame = format!("{}.frame", plan.picture);
        let request = Request::output(&plan.output).and_output(&frame).and_output(&setting.fur);
        let evaluation = self.run(&setting.graph, request, title)?;
        Ok((evaluation.get(&plan.output)?, Contender::of(&evaluation, &setting.fur, &frame)?))
    }

    fn run(&mut self, graph: &CheckedGraph, request: Request, title: &str) -> Result<Evaluation, Failure> {
        let progress = Arc::new(Progress::new(self.how.quiet, self.how.verbose));
        progress.title(title);
        let evaluation = self.evaluator.run(graph, &request.with_observer(progress.clone()));
        progress.clear();
        let evaluation = evaluation?;
        progress.finish(&evaluation);
        Ok(evaluation)
    }
}
