//! `pelage check`.

use std::path::PathBuf;

use clap::Args;

use crate::failure::Failure;
use crate::graph::{Overrides, with_files};
use crate::output::print;

#[derive(Args)]
pub(crate) struct Check {
    /// The graphs.
    #[arg(required = true, value_name = "GRAPH.ron")]
    graphs: Vec<PathBuf>,
    #[command(flatten)]
    overrides: Overrides,
}

impl Check {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let registry = pelage_nodes::registry();
        let mut faults = Vec::new();
        for path in &self.graphs {
            let checked = self.overrides.read(path, &registry).and_then(|graph| {
                graph.check(&registry).map_err(|faults| with_files(faults, &graph, &registry, path))?;
                Ok(graph.check_files(&registry).map_err(|faults| faults.with_path(path))?)
            });
            match checked {
                Ok(()) => {}
                Err(Failure::Input(message)) => faults.push(message),
                Err(other) => return Err(other),
            }
        }
        if !faults.is_empty() {
            return Err(Failure::Input(faults.join("\n")));
        }
        let count = self.graphs.len();
        print(&format!("{count} graph{}, no faults\n", if count == 1 { "" } else { "s" }))
    }
}
