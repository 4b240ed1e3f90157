//! The project's own chores: `cargo demo`, `cargo verify` and `cargo book` (aliases in `.cargo/config.toml`).
//!
//! - `demo` renders the furry bunny and says where the picture is.
//! - `verify` runs every check and test, each with the reason it exists, and stops at the first failure.
//! - `book` builds the book; `book all` makes anew all that it shows: `book pictures`, `book sweeps`, `book said`, `book extremes`.
//! - `vulkan` only makes sure that there is something to draw with, as `demo` and `verify` do first.
//!
//! `verify` and `book` are behind the feature `checks`, so that a newcomer's `cargo demo` compiles an argument parser and nothing
//! else.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program for a person at a terminal")]

#[cfg(feature = "checks")]
mod book;
mod demo;
mod failure;
#[cfg(feature = "checks")]
mod figures;
#[cfg(feature = "checks")]
mod layering;
#[cfg(feature = "checks")]
mod licences;
mod place;
mod process;
#[cfg(feature = "checks")]
mod totals;
#[cfg(feature = "checks")]
mod verify;
mod vulkan;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use failure::Result;
use place::Place;

#[derive(Parser)]
#[command(name = "cargo", about = "Chores of the Pelage workspace", disable_help_subcommand = true)]
struct Arguments {
    #[command(subcommand)]
    chore: Chore,
}

#[derive(Subcommand)]
enum Chore {
    /// Render graphs/bunny.ron to target/demo/bunny.png.
    Demo {
        /// Passed on to `pelage render`, such as `--set bunny.path=cat.obj` or `-o elsewhere.png`.
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<String>,
    },
    /// Make sure of a Vulkan loader and driver.
    Vulkan,
    /// Run every check and test, or only the steps named.
    #[cfg(feature = "checks")]
    Verify {
        /// Steps to run, all of them by default; always in the fixed order.
        #[arg(value_enum)]
        steps: Vec<verify::StepName>,
    },
    /// Build the book into book/book, with the node reference made anew.
    #[cfg(feature = "checks")]
    Book {
        /// What else to make.
        #[arg(value_enum)]
        what: Option<book::What>,
        /// Which sweeps to measure, by their names in graphs/sweeps; all without.
        #[arg(value_name = "SWEEP")]
        sweeps: Vec<String>,
    },
}

fn main() -> ExitCode {
    match run(Arguments::parse().chore) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("\nerror: {failure}");
            ExitCode::from(failure.code())
        }
    }
}

fn run(chore: Chore) -> Result<()> {
    let place = Place::find()?;
    match chore {
        Chore::Demo { arguments } => demo::run(&place, &arguments),
        Chore::Vulkan => vulkan::make_sure(),
        #[cfg(feature = "checks")]
        Chore::Verify { steps } => verify::run(&place, &steps),
        #[cfg(feature = "checks")]
        Chore::Book { what, sweeps } => book::run(&place, what, &sweeps),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_arguments_are_well_formed() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn what_follows_demo_is_passed_on() {
        let parsed = Arguments::parse_from(["cargo", "demo", "--set", "bunny.path=a.obj", "-o", "x.png", "-q"]);
        let Chore::Demo { arguments } = parsed.chore else { panic!("not the demo") };
        assert_eq!(arguments, ["--set", "bunny.path=a.obj", "-o", "x.png", "-q"]);
    }
}
