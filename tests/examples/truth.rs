//! How far pictures are from each other that are all true: the hair of two graphs ray cast, with other noise, and with strands that are not cut at patches. What is drawn is held against
//! them by `pelage measure`. A table in Markdown: light is the mean of red over what both cover wholly, coverage that of the picture.
//!
//! `cargo run --release -p pelage-tests --example truth [-- SAMPLES]`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::sync::Arc;

use pelage_accuracy::{DEFAULT_PIXELS_PER_DEGREE, Image, flip, linear_light, rmse_linear};
use pelage_graph::{Evaluator, Graph, Request};
use pelage_nodes::Picture;
use pelage_tests::{Error, repository};

fn main() -> Result<(), Error> {
    let samples = std::env::args().nth(1).unwrap_or("64".into());
    println!("| graph | picture | light | coverage | FLIP, mean | 99th percentile | RMSE |\n|---|---|---|---|---|---|---|");
    for name in ["bunny", "truth"] {
        let mut evaluator = pelage_nodes::evaluator(1 << 30);
        let truth = truth_of(&mut evaluator, name, &[("truth.samples", &samples)])?;
        print_row(name, "the truth", &truth, &truth)?;
        let other = truth_of(&mut evaluator, name, &[("truth.samples", &samples), ("truth.seed", "2")])?;
        print_row(name, "the truth with other noise", &other, &truth)?;
        let free = truth_of(&mut evaluator, name, &[("truth.samples", &samples), ("truth.placement", "Free")])?;
        print_row(name, "free strands", &free, &truth)?;
    }
    Ok(())
}

/// The true picture of a graph.
fn truth_of(evaluator: &mut Evaluator, name: &str, set: &[(&str, &str)]) -> Result<Arc<Picture>, Error> {
    let registry = pelage_nodes::registry();
    let text = std::fs::read_to_string(repository().join(format!("graphs/{name}.ron")))?;
    let mut graph = Graph::parse(&text)?.with_directory(repository().join("graphs"));
    for (input, value) in [("truth.size", "(480, 360)")].iter().chain(set) {
        graph.set(&registry, input, value, repository())?;
    }
    Ok(evaluator.run(&graph.check(&registry)?, &Request::output("truth.image"))?.get::<Picture>("truth.image")?)
}

fn print_row(name: &str, what: &str, picture: &Picture, truth: &Picture) -> Result<(), Error> {
    let rgb = |picture: &Picture| picture.rgba.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect::<Vec<u8>>();
    let (test, reference) = (rgb(picture), rgb(truth));
    let mask: Vec<u8> = picture.coverage.iter().zip(&truth.coverage).map(|(a, b)| if *a > 0 || *b > 0 { 255 } else { 0 }).collect();
    let images = (Image::new(truth.width, truth.height, &reference)?, Image::new(picture.width, picture.height, &test)?);
    let report = flip(images.0, images.1, Some(&mask), DEFAULT_PIXELS_PER_DEGREE)?;
    let whole = |k: usize| picture.coverage[k] == 255 && truth.coverage[k] == 255;
    let count = (0..mask.len()).filter(|&k| whole(k)).count() as f64;
    let light = (0..mask.len()).filter(|&k| whole(k)).map(|k| linear_light(test[3 * k])).sum::<f64>() / count;
    let covered = picture.coverage.iter().map(|&c| f64::from(c)).sum::<f64>() / 255.0 / mask.len() as f64;
    let rmse = rmse_linear(images.0, images.1, Some(&mask))?;
    println!("| {name} | {what} | {light:.3} | {covered:.3} | {:.3} | {:.3} | {rmse:.3} |", report.mean, report.p99);
    Ok(())
}
