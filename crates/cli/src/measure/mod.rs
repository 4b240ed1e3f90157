//! `pelage measure`: what settings of a graph cost, and how far their pictures are from the truth.

pub(crate) mod description;
pub(crate) mod errors;
pub(crate) mod plan;
pub(crate) mod results;
pub(crate) mod run;
mod sheet;

use std::path::{Path, PathBuf};

use clap::Args;

use crate::failure::Failure;
use crate::graph::Overrides;
use crate::render::size;
use crate::running::Running;
use description::{Description, assigned, varied};
use plan::Plan;
use results::Results;
use run::Engine;

/// Times that each frame is timed, where nothing is said.
pub(crate) const ROUNDS: u32 = 9;

/// The most settings in one sweep.
const MOST_SETTINGS: usize = 1000;

#[derive(Args)]
pub(crate) struct Measure {
    /// The graph.
    #[arg(value_name = "GRAPH.ron", required_unless_present = "sweep", conflicts_with = "sweep")]
    graph: Option<PathBuf>,
    /// A saved sweep, which names its graph; what is given here as well goes before it.
    #[arg(long, value_name = "SWEEP.ron")]
    sweep: Option<PathBuf>,
    /// The values of an input, in RON, with commas between: NODE.INPUT=a,b,c. Repeatable: every combination is measured.
    #[arg(long, value_name = "NODE.INPUT=a,b,c", required_unless_present = "sweep")]
    vary: Vec<String>,
    /// The output to measure against, as NODE.image of a ReferenceImage; the measured output at the finest setting without.
    #[arg(long, value_name = "NODE.PORT")]
    against: Option<String>,
    /// An input of what is measured against; without, each input that varies has the last of its values there. Repeatable.
    #[arg(long, value_name = "NODE.INPUT=VALUE")]
    finest: Vec<String>,
    /// Make what is measured against anew for each setting, with only --finest changed: for inputs that change the true picture, as a camera's.
    #[arg(long)]
    each: bool,
    /// An input that varies by which settings are told apart, as a camera's: only those alike in it compete and are timed in turn. Repeatable.
    #[arg(long, value_name = "NODE.INPUT")]
    group: Vec<String>,
    /// Which output to measure, when there are several: one of a RenderImage node.
    #[arg(long, value_name = "NODE.PORT")]
    output: Option<String>,
    /// Pixels of the pictures, instead of the graph's; of what is measured against, too.
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<(u32, u32)>,
    /// Times that each frame is timed, in turn with the others; what the sweep says, or 9, without.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    rounds: Option<u32>,
    /// The folder to write sweep.csv, sweep.json, sweep.svg and sheet.png to.
    #[arg(short, long = "out", value_name = "DIR", required_unless_present = "fingerprint")]
    out: Option<PathBuf>,
    /// Measure nothing: print one word that stands for all that would be measured, as sweep.json has it. Another word: the figures are out of date.
    #[arg(long, conflicts_with = "out")]
    fingerprint: bool,
    #[command(flatten)]
    running: Running,
    #[command(flatten)]
    overrides: Overrides,
}

impl Measure {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        self.out.as_deref().map_or(Ok(()), crate::output::check_folder)?;
        let description = self.description()?;
        let rounds = self.rounds.or(description.rounds).unwrap_or(ROUNDS).max(1);
        let plan = Plan::new(&description, &self.overrides, self.size, MOST_SETTINGS)?;
        let Some(out) = &self.out else { return crate::output::print(&format!("{}\n", plan.fingerprint()?)) };
        let mut engine = Engine::new(&self.running);
        let measured = run::measure(&plan, &mut engine, rounds)?;
        let results = Results::new(&description, &plan, &measured, rounds);
        if !self.running.quiet {
            crate::output::print(&results.to_table())?;
        }
        results.write(out, sheet::draw(&measured)?)
    }

    /// The saved sweep, or none, with what the command line says.
    fn description(&self) -> Result<Description, Failure> {
        let mut description = match (&self.sweep, &self.graph) {
            (Some(path), _) => Description::read(path)?,
            (None, Some(graph)) => Description::of_graph(graph),
            (None, None) => return Err(Failure::Usage("give GRAPH.ron or --sweep SWEEP.ron".into())),
        };
        description.vary.extend(varied(&self.vary)?);
        description.finest.extend(assigned("--finest", &self.finest)?);
        if let Some(against) = &self.against {
            description.against = Some(against.clone());
        }
        if let Some(output) = &self.output {
            description.output = Some(output.clone());
        }
        description.each |= self.each;
        description.groups.extend(self.group.iter().filter(|group| !description.groups.contains(group)).cloned().collect::<Vec<_>>());
        Ok(description)
    }
}

/// Where paths on the command line begin.
fn here() -> PathBuf {
    std::env::current_dir().unwrap_or_else(|_| Path::new(".").to_owned())
}
