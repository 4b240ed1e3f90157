//! How a command that evaluates runs: on how many threads, and what it says while it does.

use std::sync::Arc;

use clap::Args;
use pelage_graph::Evaluator;

use crate::progress::Progress;

/// What a run may keep in memory for nodes that share results.
pub(crate) const CACHE_BYTES: usize = 1 << 30;

#[derive(Args)]
pub(crate) struct Running {
    /// How many nodes run at a time, and on how many threads each; as many as there are cores without.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Nothing on the terminal: no progress, no table.
    #[arg(short, long)]
    pub(crate) quiet: bool,
    /// Say what each node did.
    #[arg(short, long, conflicts_with = "quiet")]
    pub(crate) verbose: bool,
}

impl Running {
    /// An engine on as many threads, and the pool that its nodes share their own work out to.
    pub(crate) fn evaluator(&self) -> Evaluator {
        let evaluator = pelage_nodes::evaluator(CACHE_BYTES);
        let Some(threads) = self.threads else { return evaluator };
        // Fails only where a pool exists already, which then was sized alike: one command runs.
        let _ = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
        evaluator.threads(threads.into())
    }

    /// What shows how an evaluation gets on.
    pub(crate) fn progress(&self) -> Arc<Progress> {
        Arc::new(Progress::new(self.quiet, self.verbose))
    }
}
