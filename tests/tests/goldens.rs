//! Every saved graph makes the picture that is kept of it.
#![allow(clippy::print_stdout, reason = "the distance of each picture, to choose bounds by")]

use pelage_graph::Evaluator;
use pelage_tests::{Bounds, Comparison, Error, Golden, Scene, VARIANTS, gpu, graph_names};

#[test]
fn every_graph_makes_its_picture() -> Result<(), Error> {
    let names = graph_names()?;
    let (mean, p99) = compare(names.iter().map(|name| (name.as_str(), name.as_str(), &[][..])))?;
    println!("reached: mean {mean:.4}, 99th percentile {p99:.4} on {}", gpu()?.headless().summary().name);
    Ok(())
}

#[test]
fn every_variant_makes_its_picture() -> Result<(), Error> {
    compare(VARIANTS.iter().map(|variant| (variant.name, variant.graph, variant.overrides))).map(drop)
}

/// Compares goldens with what graphs make: the golden's name, the graph's, and what is set in it. Says the worst mean and the worst 99th percentile.
fn compare<'a>(pictures: impl Iterator<Item = (&'a str, &'a str, &'a [(&'a str, &'a str)])>) -> Result<(f64, f64), Error> {
    let mut evaluator = pelage_nodes::evaluator(1 << 30);
    let (mut worst, mut failures) = ((0.0_f64, 0.0_f64), Vec::new());
    for (name, graph, overrides) in pictures {
        match compared(&mut evaluator, name, graph, overrides) {
            Ok(Comparison { mean, p99 }) => {
                println!("{name}: FLIP mean {mean:.5}, 99th percentile {p99:.5}");
                worst = (worst.0.max(mean), worst.1.max(p99));
            }
            Err(error) => failures.push(error.to_string()),
        }
    }
    if failures.is_empty() { Ok(worst) } else { Err(failures.join("\n").into()) }
}

fn compared(evaluator: &mut Evaluator, name: &str, graph: &str, overrides: &[(&str, &str)]) -> Result<Comparison, Error> {
    let golden = Golden::read(name)?;
    let picture = Scene::evaluate_with(evaluator, graph, overrides)?.picture()?;
    golden.expect(&picture, Bounds::KEPT)
}

#[test]
fn a_missing_golden_fails_and_is_not_written() {
    assert!(Golden::read("no such graph").is_err());
    assert!(!Golden::path("no such graph").exists());
}

#[test]
fn the_same_graph_makes_the_same_bytes() -> Result<(), Error> {
    let (first, second) = (Scene::evaluate("die", &[])?.picture()?, Scene::evaluate("die", &[])?.picture()?);
    assert!(first.rgba == second.rgba, "two runs differ");
    Ok(())
}
