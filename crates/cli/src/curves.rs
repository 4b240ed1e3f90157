//! `pelage curves`.

use std::path::PathBuf;

use clap::Args;
use pelage_graph::{CheckedGraph, Request};
use pelage_nodes::Curves;

use crate::failure::Failure;
use crate::graph::{Overrides, with_files};
use crate::output::write_file;
use crate::running::Running;

/// The hair of a graph as curves: `x y z radius` a line, a blank line between strands; in diameters of the model about the centre of its bounding box.
#[derive(Args)]
pub(crate) struct Export {
    /// The graph.
    #[arg(value_name = "GRAPH.ron")]
    graph: PathBuf,
    /// Where to write the curves.
    #[arg(short, long = "out", value_name = "OUT.txt")]
    out: PathBuf,
    /// Which output to write, when there are several: one of a StrandCurves node.
    #[arg(long, value_name = "NODE.PORT")]
    output: Option<String>,
    #[command(flatten)]
    running: Running,
    #[command(flatten)]
    overrides: Overrides,
}

impl Export {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let registry = pelage_nodes::registry();
        let graph = self.overrides.read(&self.graph, &registry)?;
        let checked = graph.check(&registry).map_err(|faults| with_files(faults, &graph, &registry, &self.graph))?;
        let output = self.output_of(&checked)?;
        let progress = self.running.progress();
        let evaluation = self.running.evaluator().run(&checked, &Request::output(&output).with_observer(progress.clone()))?;
        progress.finish(&evaluation);
        let mut text = Vec::new();
        let curves = evaluation.get::<Curves>(&output)?;
        curves.write(&mut text).map_err(|error| Failure::input(self.out.display(), &error))?;
        write_file(&self.out, &text)
    }

    /// The output asked for, or the only one of curves.
    fn output_of(&self, graph: &CheckedGraph) -> Result<String, Failure> {
        if let Some(output) = &self.output {
            return Ok(output.clone());
        }
        let found: Vec<String> = graph.outputs().filter(|(_, kind)| *kind == "Curves").map(|(port, _)| port).collect();
        let about = self.graph.display();
        match &found[..] {
            [one] => Ok(one.clone()),
            [] => Err(Failure::Input(format!("{about}: the graph has no hair as curves; add a StrandCurves node to it"))),
            several => Err(Failure::Input(format!(
                "{about}: the graph has several hairs as curves, {}; pick one with --output",
                several.join(", ")
            ))),
        }
    }
}
