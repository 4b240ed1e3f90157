//! `pelage tune`: the cheapest settings of a graph within an error, or those that err least within a cost.

mod knobs;
mod report;
mod sought;
mod trial;

use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args, ValueEnum};
use pelage_accuracy::{Goal, SearchError, search};

use crate::failure::Failure;
use crate::graph::{Overrides, with_files};
use crate::measure::description::{Description, assigned, varied};
use crate::measure::plan::{Plan, output_of};
use crate::measure::{ROUNDS, run::Engine};
use crate::output::{print, write_file};
use crate::render::size;
use crate::running::Running;
use report::Report;
use sought::{CONFIRMATIONS, Sought, confirmed, number, timed_again};
use trial::Bench;

/// The most settings that are checked and searched.
const MOST_SETTINGS: usize = 5000;

/// How many settings are evaluated at the most, where nothing is said.
const EVALUATIONS: u32 = 100;

#[derive(Args)]
#[command(group(ArgGroup::new("goal").required(true).args(["max_error", "max_ms", "max_fragments", "max_bytes"])))]
pub(crate) struct Tune {
    /// The graph.
    #[arg(value_name = "GRAPH.ron")]
    graph: PathBuf,
    /// The largest mean FLIP error, 0 to 1: the cheapest setting within it is sought.
    #[arg(long, value_name = "E", value_parser = error)]
    max_error: Option<f64>,
    /// The longest time of a frame, in milliseconds: the setting within it that errs least is sought.
    #[arg(long, value_name = "T", value_parser = cost)]
    max_ms: Option<f64>,
    /// The most fragments: the setting within them that errs least is sought.
    #[arg(long, value_name = "N", value_parser = cost)]
    max_fragments: Option<f64>,
    /// The most bytes of textures: the setting within them that errs least is sought.
    #[arg(long, value_name = "N", value_parser = cost)]
    max_bytes: Option<f64>,
    /// What is to be little within the largest error.
    #[arg(long, value_name = "COST", conflicts_with_all = ["max_ms", "max_fragments", "max_bytes"], default_value = "ms")]
    cost: Cost,
    /// Values of an input, in RON, with commas between, the finest last: NODE.INPUT=a,b,c. In place of those that would be tried, or an input more. Repeatable.
    #[arg(long, value_name = "NODE.INPUT=a,b,c")]
    vary: Vec<String>,
    /// The output to measure against, as NODE.image of a ReferenceImage; the tuned output at its finest setting without.
    #[arg(long, value_name = "NODE.PORT")]
    against: Option<String>,
    /// An input of what is measured against; without, each input that varies has the last of its values there. Repeatable.
    #[arg(long, value_name = "NODE.INPUT=VALUE")]
    finest: Vec<String>,
    /// Which output to tune, when there are several: one of a RenderImage node.
    #[arg(long, value_name = "NODE.PORT")]
    output: Option<String>,
    /// Pixels of the pictures while settings are searched, instead of the graph's. The limit stays that of the graph's own size, at which the chosen is measured before it is written.
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<(u32, u32)>,
    /// How many settings are evaluated at the most.
    #[arg(long, value_name = "N", default_value_t = EVALUATIONS, value_parser = clap::value_parser!(u32).range(1..=5000))]
    evaluations: u32,
    /// Times that each frame is timed, in turn with that of the graph as it is.
    #[arg(long, value_name = "N", default_value_t = ROUNDS, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    rounds: u32,
    /// The graph to write, with what was chosen.
    #[arg(short, long = "out", value_name = "OUT.ron")]
    out: PathBuf,
    #[command(flatten)]
    running: Running,
    #[command(flatten)]
    overrides: Overrides,
}

/// What a setting costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Cost {
    /// Milliseconds of a frame, timed in turn with the graph as it is.
    Ms,
    /// Samples that pass the tests: counted, the same in every run on an adapter.
    Fragments,
    /// Bytes of textures, all mips: exact.
    Bytes,
}

impl Tune {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        self.check_out()?;
        let (goal, cost) = self.goal()?;
        let description = self.description()?;
        let plan = Plan::new(&description, &self.overrides, self.size, MOST_SETTINGS)?;
        let own_plan = self.size.map(|_| Plan::new(&description, &self.overrides, None, MOST_SETTINGS)).transpose()?;
        let counts: Vec<usize> = description.vary.values().map(Vec::len).collect();
        let most = plan.settings.len().min(self.evaluations as usize);
        let mut bench = Bench::new(&plan, cost, Engine::new(&self.running), self.rounds, most)?;
        let at_own_size = |plan| Bench::new(plan, cost, Engine::new(&self.running), self.rounds, CONFIRMATIONS);
        let mut own = own_plan.as_ref().map(at_own_size).transpose()?;
        let sought = match &mut own {
            None => self.settle(goal, cost, &counts, &mut bench)?,
            Some(own) => {
                let sought = |goal, bench: &mut Bench<'_>| self.settle(goal, cost, &counts, bench);
                confirmed(goal, &counts, &mut bench, own, sought)?
            }
        };
        let number = number(&counts, &sought.trial.setting);
        let report = Report::new(&plan, cost, &bench);
        if !sought.met {
            return Err(self.out_of_reach(&report, goal, &sought, &plan.settings[number].values));
        }
        let text = self.tuned(&description, &plan, number)?;
        if !self.running.quiet {
            let own = own.as_ref().and_then(|own| Some((&own.tried().iter().find(|one| one.number == number)?.worth, own.as_it_is())));
            print(&report.to_text(number, sought.settled, own))?;
        }
        write_file(&self.out, text.as_bytes())
    }

    /// That what is written can be, and is not what is read.
    fn check_out(&self) -> Result<(), Failure> {
        let out = self.out.display();
        if self.out.is_dir() {
            return Err(Failure::Usage(format!("-o {out}: that is a folder; name a file")));
        }
        if self.out.extension().is_none_or(|extension| extension != "ron") {
            return Err(Failure::Usage(format!("-o {out}: what is written is a graph; name a file that ends in .ron")));
        }
        match (self.out.canonicalize(), self.graph.canonicalize()) {
            (Ok(out), Ok(graph)) if out == graph => {
                Err(Failure::Usage(format!("-o {}: that is the graph itself; name another file", self.out.display())))
            }
            _ => Ok(()),
        }
    }

    /// What a search comes to, by times taken anew if time is what costs.
    fn settle(&self, goal: Goal, cost: Cost, counts: &[usize], bench: &mut Bench<'_>) -> Result<Sought, Failure> {
        let sought = self.seek(goal, counts, bench)?;
        if cost == Cost::Ms { timed_again(goal, sought, counts, |numbers| bench.time_again(numbers)) } else { Ok(sought) }
    }

    /// Searches, evaluating what the search asks for.
    fn seek(&self, goal: Goal, counts: &[usize], bench: &mut Bench<'_>) -> Result<Sought, Failure> {
        match search(counts, goal, self.evaluations as usize, |setting| bench.evaluate(number(counts, setting))) {
            Ok(found) => Ok(Sought { trial: found.trials[found.best].clone(), met: true, settled: found.settled, trials: found.trials }),
            Err(SearchError::OutOfReach { nearest, trials, settled, .. }) => Ok(Sought { trial: nearest, met: false, settled, trials }),
            Err(SearchError::Evaluate(failure)) => Err(failure),
            Err(error) => Err(Failure::Input(format!("{}: {error}", self.graph.display()))),
        }
    }

    /// What is sought, and by which cost.
    fn goal(&self) -> Result<(Goal, Cost), Failure> {
        let within = |limit: Option<f64>, cost| limit.map(|limit| (Goal::WithinCost(limit), cost));
        self.max_error
            .map(|limit| (Goal::WithinError(limit), self.cost))
            .or_else(|| within(self.max_ms, Cost::Ms))
            .or_else(|| within(self.max_fragments, Cost::Fragments))
            .or_else(|| within(self.max_bytes, Cost::Bytes))
            .ok_or_else(|| Failure::Usage("give --max-error, --max-ms, --max-fragments or --max-bytes".into()))
    }

    /// The graph, and what in it varies: what it has to turn, with what the command line says.
    fn description(&self) -> Result<Description, Failure> {
        let mut description = Description::of_graph(&self.graph);
        description.output.clone_from(&self.output);
        description.against.clone_from(&self.against);
        description.finest = assigned("--finest", &self.finest)?;
        let registry = pelage_nodes::registry();
        let graph = self.overrides.read(&self.graph, &registry)?;
        let checked = graph.check(&registry).map_err(|faults| with_files(faults, &graph, &registry, &self.graph))?;
        let output = output_of(&description, &graph, &registry)?;
        description.vary = knobs::of(&graph, &checked, &registry, &output);
        description.vary.extend(varied(&self.vary)?);
        if description.vary.is_empty() {
            return Err(Failure::Input(format!(
                "{}: {output} has nothing to tune; say what, with --vary NODE.INPUT=a,b,c",
                self.graph.display()
            )));
        }
        Ok(description)
    }

    /// The graph with what was chosen, as it is written to where it goes.
    fn tuned(&self, description: &Description, plan: &Plan, chosen: usize) -> Result<String, Failure> {
        let registry = pelage_nodes::registry();
        let mut graph = self.overrides.read(&self.graph, &registry)?;
        for (target, value) in plan.varied.iter().zip(&plan.settings[chosen].values) {
            graph.set(&registry, target, value, &description.directory).map_err(|error| Failure::Input(error.to_string()))?;
        }
        let folder = self.out.parent().unwrap_or(Path::new(""));
        graph.relocate(&registry, folder).map_err(|error| Failure::input(self.out.display(), &error))?;
        Ok(graph.to_ron())
    }

    fn out_of_reach(&self, report: &Report<'_>, goal: Goal, nearest: &Sought, values: &[String]) -> Failure {
        let (limit, least) = match goal {
            Goal::WithinError(limit) => (format!("errs by {limit} or less"), format!("{:.5}", nearest.trial.error)),
            Goal::WithinCost(limit) => (format!("costs {limit} {} or less", report.unit()), report.cost_text(nearest.trial.cost)),
        };
        let at = if self.size.is_some() { " at its own size" } else { "" };
        let remedy = if nearest.settled { "allow more, or give other values with --vary" } else { "allow more, or more --evaluations" };
        let (graph, values, evaluated) = (self.graph.display(), report.named(values), report.evaluated());
        Failure::Input(format!("{graph}: no setting {limit}{at}; the least found is {least}, with {values} ({evaluated}): {remedy}"))
    }
}

/// An error that can be kept.
fn error(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| (0.0..=1.0).contains(number));
    number.ok_or_else(|| "expected a number from 0 to 1, as in 0.05".into())
}

/// A cost that can be kept.
fn cost(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite() && *number > 0.0);
    number.ok_or_else(|| "expected a number above 0".into())
}
