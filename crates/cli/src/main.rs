//! `pelage`: saved fur graphs, rendered and inspected headlessly.
//!
//! Exit codes: 0 done, 1 the input or the graph is wrong or evaluation failed, 2 wrong usage, 3 no graphics adapter.

mod check;
mod contact;
mod curves;
mod failure;
mod gallery;
mod graph;
mod inspect;
mod measure;
mod nodes;
mod output;
mod progress;
mod render;
mod running;
mod survey;
mod tune;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Fur from saved node graphs.
#[derive(Parser)]
#[command(name = "pelage", version, about)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Evaluate a graph's picture and write it.
    Render(render::Render),
    /// Validate graphs without evaluating them; every fault with line, column and node.
    Check(check::Check),
    /// The node reference.
    Nodes(nodes::Nodes),
    /// The pictures of many graphs, and a contact sheet of them.
    Gallery(gallery::Gallery),
    /// What is in a model: counts, genus, quality.
    Inspect(inspect::Inspect),
    /// What settings of a graph cost and how far their pictures err: CSV, JSON, SVG and a contact sheet.
    Measure(measure::Measure),
    /// The cheapest settings of a graph within an error, or those that err least within a cost, as a graph.
    Tune(tune::Tune),
    /// The hair on the surface as curves, for other ray tracers.
    Curves(curves::Export),
    /// Table 1 of the paper: how fast each model of a folder is drawn, with half and with all layers.
    Survey(survey::Survey),
}

fn main() -> ExitCode {
    // clap itself answers wrong usage with exit code 2.
    let done = match Arguments::parse().command {
        Command::Render(command) => command.run(),
        Command::Check(command) => command.run(),
        Command::Nodes(command) => command.run(),
        Command::Gallery(command) => command.run(),
        Command::Inspect(command) => command.run(),
        Command::Measure(command) => command.run(),
        Command::Tune(command) => command.run(),
        Command::Curves(command) => command.run(),
        Command::Survey(command) => command.run(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
