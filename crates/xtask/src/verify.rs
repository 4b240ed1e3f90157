//! `cargo verify`: every check and test, with the reason each exists.

use std::env;
use std::time::Instant;

use clap::ValueEnum;

use crate::book;
use crate::failure::{Failure, Result};
use crate::figures;
use crate::layering;
use crate::licences;
use crate::place::Place;
use crate::process::CommandLine;
use crate::totals::{self, Totals};
use crate::vulkan;

/// The steps, in the order they run: what is quick to fail first, the tests last, so that their totals end the log.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum StepName {
    /// A loader and a driver, as half of the tests draw.
    Vulkan,
    /// The lock files, that of the rivals too.
    Locks,
    /// cargo fmt.
    Format,
    /// Who may know whom.
    Layering,
    /// Of every dependency.
    Licences,
    /// clippy with warnings denied.
    Clippy,
    /// rustdoc with warnings denied.
    Docs,
    /// Pages, links, pictures, node reference.
    Book,
    /// Speeds beside their floors, errors beside what they are of.
    Figures,
    /// Unit, property, integration and documentation tests.
    Tests,
}

impl StepName {
    /// Why the step exists.
    fn why(self) -> &'static str {
        match self {
            Self::Vulkan => "something to draw with, as the tests of pictures draw",
            Self::Locks => "the same versions everywhere: what a crate asks for is in every lock file, the benchmarks' own too",
            Self::Format => "one layout of the code, so that a diff shows what changed and nothing else",
            Self::Layering => "data goes one way: no crate knows what is on its right",
            Self::Licences => "whoever takes a crate may combine it with what they have",
            Self::Clippy => "no panic, no printing in libraries, no needless clone; with and without drawing, with and without checks",
            Self::Docs => "every public item is documented and every link in it leads somewhere",
            Self::Book => "every page is in the contents, every link and picture exists, the node reference is of today",
            Self::Figures => "what is claimed of speed and error is printed beside its floor, measured in the same run",
            Self::Tests => "it does what it says: units, properties, examples of the documentation, saved graphs and their pictures",
        }
    }

    /// What to type to run it alone.
    fn alone(self) -> String {
        let name = self.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned());
        format!("cargo verify {name}")
    }

    fn run(self, place: &Place) -> Result<Option<Totals>> {
        let cargo = |arguments: &str| CommandLine::cargo().with(arguments.split_whitespace()).within(place.root());
        match self {
            Self::Vulkan => vulkan::make_sure()?,
            Self::Locks => {
                cargo("fetch --quiet --locked").run()?;
                cargo("fetch --quiet --locked --manifest-path tests/rivals/Cargo.toml").run()?;
            }
            Self::Format => cargo("fmt --all --check").run()?,
            Self::Layering => layering::check(place)?,
            Self::Licences => licences::check(place)?,
            Self::Clippy => {
                cargo("clippy --workspace --all-targets --features pelage-xtask/checks --locked -- -D warnings").run()?;
                cargo("clippy --package pelage-nodes --no-default-features --all-targets --locked -- -D warnings").run()?;
                cargo("clippy --package pelage-xtask --all-targets --locked -- -D warnings").run()?;
                cargo("clippy --package pelage-fuzz --all-targets --features libfuzzer --locked -- -D warnings").run()?;
            }
            Self::Docs => cargo("doc --workspace --no-deps --locked").with_variable("RUSTDOCFLAGS", "-D warnings").run()?,
            Self::Book => book::verify(place)?,
            Self::Figures => figures::print(place)?,
            // Without a choice of targets cargo also builds every example, which a broken one fails.
            Self::Tests => {
                let tests = cargo("test --workspace --features pelage-xtask/checks --locked");
                return totals::run(&tests, std::io::stdout()).map(Some);
            }
        }
        Ok(None)
    }
}

/// Runs the `wanted` steps, all of them if none is named, and stops at the first that fails.
pub(crate) fn run(place: &Place, wanted: &[StepName]) -> Result<()> {
    let steps = chosen(wanted);
    if steps.contains(&StepName::Tests) {
        say_where_models_are();
    }
    let begun = Instant::now();
    let mut times = Vec::new();
    let mut totals = None;
    for step in steps {
        println!("\n── {step:?}: {}", step.why());
        let start = Instant::now();
        totals = step.run(place).map_err(|failure| explain(step, &failure))?.or(totals);
        println!("── {step:?}: done in {:.1} s", start.elapsed().as_secs_f64());
        times.push(format!("{step:?} {:.0} s", start.elapsed().as_secs_f64()));
    }
    println!("\nverified in {:.0} s: {}", begun.elapsed().as_secs_f64(), times.join(", "));
    if let Some(totals) = totals {
        println!("{totals}");
    }
    Ok(())
}

/// Every step that is wanted, in the fixed order.
fn chosen(wanted: &[StepName]) -> Vec<StepName> {
    StepName::value_variants().iter().copied().filter(|step| wanted.is_empty() || wanted.contains(step)).collect()
}

/// A log that says why a test of real models did nothing.
fn say_where_models_are() {
    match env::var_os("PELAGE_MODELS") {
        Some(folder) => println!("models to test with: {}", folder.display()),
        None => println!("PELAGE_MODELS is not set: the tests that want a folder of models say so and return"),
    }
}

fn explain(step: StepName, failure: &Failure) -> Failure {
    Failure::new(format!("{step:?} {failure}")).remedy(format!("the step alone: {}", step.alone()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_steps_run_by_default_and_the_tests_last() {
        let all = chosen(&[]);
        assert_eq!(all.len(), 10);
        assert_eq!(all.first(), Some(&StepName::Vulkan));
        assert_eq!(all.last(), Some(&StepName::Tests));
    }

    #[test]
    fn named_steps_keep_their_order_and_run_once() {
        let chosen = chosen(&[StepName::Tests, StepName::Format, StepName::Tests]);
        assert_eq!(chosen, [StepName::Format, StepName::Tests]);
    }

    #[test]
    fn a_failure_says_how_to_repeat_it() {
        let failure = CommandLine::new("false").run().unwrap_err();
        let text = explain(StepName::Clippy, &failure).to_string();
        assert!(text.contains("to repeat: false") && text.contains("cargo verify clippy"), "{text}");
    }
}
