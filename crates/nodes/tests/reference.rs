//! The node of the true picture: every input has its effect, and it is the library's picture.
#![cfg(feature = "gpu")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::sync::Arc;

use pelage_graph::{CancelToken, EvaluateError, Evaluator, Graph, Request};
use pelage_nodes::{Picture, RayReport};

/// A ball with hair that leans out of its patches; not one graphics device is made.
const BALL: &str = r#"Graph(version: 1, nodes: {
    "ball": Sphere(subdivisions: 4),
    "patches": GrowPatches(mesh: "ball.mesh", tile_size: 0.3),
    "hair": GrowStrands(count: 60, undercoat: (count: 60), steps: 8, lean: 40.0),
    "shells": SampleShells(strands: "hair.strands", layers: 2, resolution: 16),
    "coat": LayFur(mesh: "ball.mesh", patches: "patches.patches", strands: "hair.strands", shells: "shells.shells", length: 0.08),
    "camera": Camera(), "light": Light(), "shading": HairLighting(),
    "truth": ReferenceImage(fur: "coat.fur", strands: "hair.strands", camera: "camera.camera", light: "light.light", shading: "shading.shading", size: (40, 30), samples: 4),
})"#;

fn drawn(set: &[(&str, &str)]) -> (Arc<Picture>, Arc<RayReport>) {
    let registry = pelage_nodes::registry();
    let mut graph = Graph::parse(BALL).unwrap();
    for (input, value) in set {
        graph.set(&registry, input, value, ".".as_ref()).unwrap();
    }
    let checked = graph.check(&registry).unwrap();
    let evaluation = Evaluator::new(1 << 28).run(&checked, &Request::output("truth.image").and_output("truth.rays")).unwrap();
    (evaluation.get::<Picture>("truth.image").unwrap(), evaluation.get::<RayReport>("truth.rays").unwrap())
}

#[test]
fn every_input_has_its_effect() {
    let (plain, rays) = drawn(&[]);
    assert_eq!((plain.width, plain.height, plain.rgba.len(), plain.coverage.len()), (40, 30, 4800, 1200));
    assert_eq!((rays.camera_rays, rays.shadow_rays, rays.counts.triangles), (4800, 0, 320));
    assert!(plain.coverage.contains(&255) && plain.coverage.contains(&0) && plain.coverage.iter().any(|c| (1..255).contains(c)));
    assert!(plain == drawn(&[]).0, "two runs differ");
    for (input, value) in [
        ("truth.seed", "2"),
        ("truth.samples", "5"),
        ("truth.placement", "Free"),
        ("truth.shadows", "Rays"),
        ("truth.length_scale", "0.5"),
        ("truth.skin_colour", "(1.0, 0.0, 0.0)"),
        ("truth.background_top", "(1.0, 0.0, 0.0)"),
        ("truth.background_bottom", "(1.0, 0.0, 0.0)"),
        ("light.azimuth", "170.0"),
        ("shading.shadow", "3.0"),
        ("camera.azimuth", "90.0"),
    ] {
        assert!(*drawn(&[(input, value)]).0 != *plain, "{input} = {value} changes nothing");
    }
    let (_, by_rays) = drawn(&[("truth.shadows", "Rays")]);
    assert!(by_rays.shadow_rays > 100 && by_rays.shadow_rays <= by_rays.camera_rays);
    let (fine, coarse) = (drawn(&[("truth.tolerance", "0.001")]).1, drawn(&[("truth.tolerance", "0.5")]).1);
    assert!(fine.counts.segments > rays.counts.segments && rays.counts.segments > coarse.counts.segments);
}

#[test]
fn without_length_it_is_bald() {
    let (bald, rays) = drawn(&[("truth.length_scale", "0.0")]);
    assert_eq!(rays.counts.segments, 0);
    // The camera frames the coat, bald or not.
    assert!(bald.coverage.iter().map(|&c| u32::from(c)).sum::<u32>() < drawn(&[]).0.coverage.iter().map(|&c| u32::from(c)).sum::<u32>());
}

#[test]
fn a_run_that_is_told_to_stop_stops() {
    let registry = pelage_nodes::registry();
    let checked = Graph::parse(BALL).unwrap().check(&registry).unwrap();
    let cancel = CancelToken::default();
    cancel.cancel();
    let run = Evaluator::new(1 << 28).run(&checked, &Request::output("truth.image").with_cancel(cancel));
    assert!(matches!(run, Err(EvaluateError::Cancelled)), "{:?}", run.err());
}
