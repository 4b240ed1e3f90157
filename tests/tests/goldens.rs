//! Every saved graph makes the picture that is kept of it.
#![allow(clippy::print_stdout, reason = "the distance of each picture, to choose bounds by")]

use pelage_tests::{Bounds, Error, Golden, Scene, graph_names};

#[test]
fn every_graph_makes_its_picture() -> Result<(), Error> {
    let mut failures = Vec::new();
    for name in graph_names()? {
        let checked = Golden::read(&name).and_then(|golden| golden.expect(&*Scene::evaluate(&name, &[])?.picture()?, Bounds::KEPT));
        match checked {
            Ok(comparison) => println!("{name}: FLIP mean {:.5}, 99th percentile {:.5}", comparison.mean, comparison.p99),
            Err(error) => failures.push(error.to_string()),
        }
    }
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n").into()) }
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
