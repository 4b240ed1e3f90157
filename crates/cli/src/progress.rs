//! How a run gets on: a bar on a terminal, nothing on a pipe.

use std::io::{IsTerminal, Write};
use std::sync::{Mutex, MutexGuard, PoisonError};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use pelage_graph::{Evaluation, NodeId, Observer, PortParts, State, TraceEntry};

/// Shows which nodes run.
pub(crate) struct Progress {
    bar: ProgressBar,
    running: Mutex<Vec<NodeId>>,
    verbose: bool,
}

impl Progress {
    pub(crate) fn new(quiet: bool, verbose: bool) -> Self {
        let hidden = quiet || verbose || !std::io::stderr().is_terminal();
        let target = if hidden { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let bar = ProgressBar::with_draw_target(Some(0), target);
        if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len} {prefix} {msg}") {
            bar.set_style(style);
        }
        Self { bar, running: Mutex::default(), verbose }
    }

    /// Says what the run is, of several.
    pub(crate) fn title(&self, title: &str) {
        self.bar.set_prefix(title.to_owned());
        if self.verbose {
            // Nothing is left to do if standard error is gone.
            let _ = writeln!(std::io::stderr(), "{title}");
        }
    }

    /// Takes the bar away.
    pub(crate) fn clear(&self) {
        self.bar.finish_and_clear();
    }

    /// Takes the bar away; says what each node did if asked to.
    pub(crate) fn finish(&self, evaluation: &Evaluation) {
        self.clear();
        if self.verbose {
            for entry in evaluation.trace() {
                say(entry);
            }
            for warning in pelage_nodes::warnings(evaluation) {
                // Nothing is left to do if standard error is gone.
                let _ = writeln!(std::io::stderr(), "warning: {warning}");
            }
        }
    }
}

impl Progress {
    fn running(&self) -> MutexGuard<'_, Vec<NodeId>> {
        self.running.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The names of the nodes that run.
    fn show(&self, running: &[NodeId]) {
        self.bar.set_message(running.iter().map(NodeId::as_str).collect::<Vec<_>>().join(", "));
    }
}

impl Observer for Progress {
    fn started(&self, node: &NodeId, done: usize, total: usize) {
        self.bar.set_length(total as u64);
        self.bar.set_position(done as u64);
        let mut running = self.running();
        running.push(node.clone());
        self.show(&running);
    }

    fn finished(&self, entry: &TraceEntry) {
        self.bar.inc(1);
        let mut running = self.running();
        running.retain(|node| *node != entry.node);
        self.show(&running);
    }
}

fn say(entry: &TraceEntry) {
    let state = match entry.state {
        State::Computed => "computed",
        State::Hit => "cached",
        State::NotNeeded => "not needed",
    };
    let parts: String = entry.parts.iter().map(left_out).collect();
    // Nothing is left to do if standard error is gone.
    let _ = writeln!(std::io::stderr(), "{:<16} {:<14} {state:<10} {:>8.1} ms{parts}", entry.node.to_string(), entry.kind, entry.ms);
}

/// `  fur without fins, levels`; nothing of an output that is whole.
fn left_out(output: &PortParts) -> String {
    let names: Vec<&str> = output.left_out.iter().map(|part| part.name).collect();
    if names.is_empty() { String::new() } else { format!("  {} without {}", output.port, names.join(", ")) }
}
