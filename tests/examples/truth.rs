//! How far what is drawn is from the hair itself: the renderer's pictures of two graphs, with few and many layers, beside the same strands ray cast,
//! and of a third with its shadows, beside rays to the light.
//!
//! `cargo run --release -p pelage-tests --example truth [-- SAMPLES]`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::sync::Arc;

use pelage_accuracy::{DEFAULT_PIXELS_PER_DEGREE, Image, flip, linear_light, rmse_linear};
use pelage_graph::{Evaluator, Graph, Request};
use pelage_nodes::Picture;
use pelage_tests::{Error, repository};

/// What is set, in the sampling of shells and in drawing.
const WAYS: &[(&str, &[(&str, &str)])] = &[
    ("8 layers", &[("shells.layers", "8")]),
    ("16 layers", &[("shells.layers", "16")]),
    ("32 layers", &[]),
    ("128 layers", &[("shells.layers", "128")]),
    ("32 layers, 512 texels", &[("shells.resolution", "512")]),
    ("128 layers, 512 texels", &[("shells.layers", "128"), ("shells.resolution", "512")]),
    ("the same, no step blur", &[("shells.layers", "128"), ("shells.resolution", "512"), ("picture.step_blur", "0.0")]),
    (
        "the same, lit at pixels by the map",
        &[
            ("shells.layers", "128"),
            ("shells.resolution", "512"),
            ("shells.directions", "true"),
            ("picture.step_blur", "0.0"),
            ("picture.lighting", "Pixels"),
        ],
    ),
    ("32 layers, no fins", &[("picture.fins", "false")]),
    ("32 layers, depth tested", &[("picture.depth", "Tested")]),
];

/// Shadows by the map and from hair to hair, each on and off, beside rays to the lights.
const SHADOWS: &[(&str, &[(&str, &str)])] = &[
    ("a map of 1024²", &[("picture.hair_shadow", "0.0")]),
    ("a map of 4096²", &[("picture.hair_shadow", "0.0"), ("picture.shadow_size", "4096")]),
    ("a map of 256²", &[("picture.hair_shadow", "0.0"), ("picture.shadow_size", "256")]),
    ("no shadows", &[("picture.hair_shadow", "0.0"), ("picture.shadows", "false")]),
    ("from hair to hair, 0.5", &[("picture.shadows", "false")]),
    ("from hair to hair, 1", &[("picture.hair_shadow", "1.0"), ("picture.shadows", "false")]),
    ("both, as saved", &[]),
];

const HEADING: &str =
    "light over what both cover wholly, red, green, blue; coverage of the picture; FLIP mean, 99th percentile; RMSE of linear light";

fn main() -> Result<(), Error> {
    let samples = std::env::args().nth(1).unwrap_or("64".into());
    shadows(&samples)?;
    for name in ["bunny", "truth"] {
        let mut evaluator = pelage_nodes::evaluator(1 << 30);
        let truth = picture(&mut evaluator, name, "truth.image", &[("truth.samples", &samples)])?;
        println!("{name}: {HEADING}");
        print_row("the truth", &truth, &truth)?;
        let other = picture(&mut evaluator, name, "truth.image", &[("truth.samples", &samples), ("truth.seed", "2")])?;
        print_row("the truth with another seed", &other, &truth)?;
        let free = picture(&mut evaluator, name, "truth.image", &[("truth.samples", &samples), ("truth.placement", "Free")])?;
        print_row("free strands", &free, &truth)?;
        for (what, set) in WAYS {
            print_row(what, &*picture(&mut evaluator, name, "picture.image", set)?, &truth)?;
        }
    }
    Ok(())
}

/// The bear in the key light alone, which is the one that the map is of.
fn shadows(samples: &str) -> Result<(), Error> {
    let mut evaluator = pelage_nodes::evaluator(1 << 30);
    let lights = [("rim.strength", "0.0"), ("truth.samples", samples)];
    let truth = |evaluator: &mut Evaluator, more: &[(&'static str, &'static str)]| {
        picture(evaluator, "shadows", "truth.image", &lights.iter().chain(more).copied().collect::<Vec<_>>())
    };
    let rays = truth(&mut evaluator, &[("truth.shadows", "Rays")])?;
    println!("shadows: {HEADING}");
    print_row("the truth, rays to the light", &rays, &rays)?;
    print_row("the truth, the self-shadow's formula", &*truth(&mut evaluator, &[])?, &rays)?;
    for (what, set) in SHADOWS {
        let set: Vec<(&str, &str)> = [("rim.strength", "0.0")].iter().chain(*set).copied().collect();
        print_row(what, &*picture(&mut evaluator, "shadows", "picture.image", &set)?, &rays)?;
    }
    Ok(())
}

/// A picture of a graph; where it has no truth, one is added.
fn picture(evaluator: &mut Evaluator, name: &str, output: &str, set: &[(&str, &str)]) -> Result<Arc<Picture>, Error> {
    const TRUTH: &str = r#""truth": ReferenceImage(fur: "coat.fur", strands: "hair.strands", camera: "camera.camera", light: "light.light", shading: "shading.shading"),"#;
    let registry = pelage_nodes::registry();
    let text = std::fs::read_to_string(repository().join(format!("graphs/{name}.ron")))?;
    // The last of a chain of lights.
    let truth = if text.contains("rim.light") { TRUTH.replace("light.light", "rim.light") } else { TRUTH.to_owned() };
    let text = if text.contains("ReferenceImage") { text } else { text.replacen("nodes: {", &format!("nodes: {{ {truth}"), 1) };
    let mut graph = Graph::parse(&text)?.with_directory(repository().join("graphs"));
    let size = [("truth.size", "(480, 360)"), ("picture.size", "(480, 360)")];
    for (input, value) in size.iter().chain(set) {
        graph.set(&registry, input, value, repository())?;
    }
    Ok(evaluator.run(&graph.check(&registry)?, &Request::output(output))?.get::<Picture>(output)?)
}

fn print_row(what: &str, picture: &Picture, truth: &Picture) -> Result<(), Error> {
    let rgb = |picture: &Picture| picture.rgba.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect::<Vec<u8>>();
    let (test, reference) = (rgb(picture), rgb(truth));
    let mask: Vec<u8> = picture.coverage.iter().zip(&truth.coverage).map(|(a, b)| if *a > 0 || *b > 0 { 255 } else { 0 }).collect();
    let images = (Image::new(truth.width, truth.height, &reference)?, Image::new(picture.width, picture.height, &test)?);
    let report = flip(images.0, images.1, Some(&mask), DEFAULT_PIXELS_PER_DEGREE)?;
    let whole = |k: usize| picture.coverage[k] == 255 && truth.coverage[k] == 255;
    let count = (0..mask.len()).filter(|&k| whole(k)).count() as f64;
    let light = [0, 1, 2].map(|c| (0..mask.len()).filter(|&k| whole(k)).map(|k| linear_light(test[3 * k + c])).sum::<f64>() / count);
    let covered = picture.coverage.iter().map(|&c| f64::from(c)).sum::<f64>() / 255.0 / mask.len() as f64;
    println!(
        "  {what:36} {:.4} {:.4} {:.4}  {covered:.4}  {:.4} {:.4}  {:.4}",
        light[0],
        light[1],
        light[2],
        report.mean,
        report.p99,
        rmse_linear(images.0, images.1, Some(&mask))?
    );
    Ok(())
}
