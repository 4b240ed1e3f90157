//! Every saved graph makes the picture that is kept of it.
#![allow(clippy::print_stdout, reason = "the distance of each picture, to choose bounds by")]

use pelage_graph::Evaluator;
use pelage_tests::{Bounds, Error, Golden, Scene, VARIANTS, gpu, graph_names};

#[test]
fn every_graph_makes_its_picture() -> Result<(), Error> {
    let names = graph_names()?;
    compare(names.iter().map(|name| (name.as_str(), name.as_str(), &[][..])))
}

#[test]
fn every_variant_makes_its_picture() -> Result<(), Error> {
    compare(VARIANTS.iter().map(|variant| (variant.name, variant.graph, variant.overrides)))
}

/// Also where the driver is not the one that drew the kept pictures.
#[test]
fn any_driver_draws_the_kept_pictures_within_wider_bounds() -> Result<(), Error> {
    let mut evaluator = pelage_nodes::evaluator(1 << 30);
    let (mut mean, mut p99) = (0.0_f64, 0.0_f64);
    let graphs = ["ball", "die", "nvidia", "straight", "truth"];
    for name in graphs {
        let comparison = Golden::read(name)?.compare(&*Scene::evaluate_with(&mut evaluator, name, &[])?.picture()?)?;
        assert!(comparison.within(Bounds::ACROSS_DRIVERS), "{name}: {comparison:?}");
        (mean, p99) = (mean.max(comparison.mean), p99.max(comparison.p99));
    }
    println!("reached: mean {mean:.4}, 99th percentile {p99:.4} on {}", gpu()?.headless().summary().name);
    Ok(())
}

/// Compares goldens with what graphs make: the golden's name, the graph's, and what is set in it.
fn compare<'a>(pictures: impl Iterator<Item = (&'a str, &'a str, &'a [(&'a str, &'a str)])>) -> Result<(), Error> {
    let mut evaluator = pelage_nodes::evaluator(1 << 30);
    let mut failures = Vec::new();
    for (name, graph, overrides) in pictures {
        match compared(&mut evaluator, name, graph, overrides) {
            Ok(said) => println!("{said}"),
            Err(error) => failures.push(error.to_string()),
        }
    }
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n").into()) }
}

fn compared(evaluator: &mut Evaluator, name: &str, graph: &str, overrides: &[(&str, &str)]) -> Result<String, Error> {
    let golden = Golden::read(name)?;
    let picture = Scene::evaluate_with(evaluator, graph, overrides)?.picture()?;
    let comparison = golden.expect(&picture, Bounds::KEPT)?;
    Ok(format!("{name}: FLIP mean {:.5}, 99th percentile {:.5}", comparison.mean, comparison.p99))
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
