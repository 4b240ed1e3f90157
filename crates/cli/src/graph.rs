//! Reading a graph with the overrides of the command line.

use std::path::{Path, PathBuf};

use clap::Args;
use pelage_graph::{Faults, Graph, ReadError, Registry};

use crate::failure::Failure;

/// What every command that reads a graph takes.
#[derive(Args, Default)]
pub(crate) struct Overrides {
    /// Override an input: NODE.INPUT=VALUE, VALUE in RON; a bare word is a string, a path is relative to the working directory. Repeatable.
    #[arg(long = "set", value_name = "NODE.INPUT=VALUE")]
    set: Vec<String>,
}

impl Overrides {
    /// Reads a graph and applies the overrides.
    pub(crate) fn read(&self, path: &Path, registry: &Registry) -> Result<Graph, Failure> {
        let graph = Graph::read(path).map_err(|error| match error {
            ReadError::Faults(faults) => Failure::from(faults),
            other => Failure::Input(other.to_string()),
        })?;
        self.apply(graph, path, registry)
    }

    /// The graph with the overrides; `path` is what messages call it.
    pub(crate) fn apply(&self, mut graph: Graph, path: &Path, registry: &Registry) -> Result<Graph, Failure> {
        let here = std::env::current_dir().unwrap_or_else(|_| PathBuf::from("."));
        let mut faults = Vec::new();
        for assignment in &self.set {
            let Some((target, value)) = assignment.split_once('=') else {
                return Err(Failure::Usage(format!("--set {assignment}: expected NODE.INPUT=VALUE")));
            };
            if let Err(error) = graph.set(registry, target, value, &here) {
                faults.push(format!("--set {error}"));
            }
        }
        if faults.is_empty() {
            return Ok(graph);
        }
        // Those of the file are said along with them, so that one run answers with all there is.
        faults.extend(graph.check(registry).err().map(|of_file| with_files(of_file, &graph, registry, path).to_string()));
        Err(Failure::Input(faults.join("\n")))
    }
}

/// The faults of a graph and those of the files that it names, so that one run answers with all there is.
pub(crate) fn with_files(faults: Faults, graph: &Graph, registry: &Registry, path: &Path) -> Faults {
    let all = match graph.check_files(registry) {
        Ok(()) => faults,
        Err(files) => faults.and(files),
    };
    all.with_path(path)
}
