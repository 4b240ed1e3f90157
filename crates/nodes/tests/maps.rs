//! Hair without strands, and patches that overlap, as nodes: a coat comes of them, and what is wrong is said.
#![allow(clippy::unwrap_used, reason = "clippy excuses test functions only, not what they call")]

use std::path::Path;

use image::{GrayAlphaImage, LumaA, Rgb, RgbImage, Rgba, RgbaImage};
use pelage_coat::{Coat, FinTexture, ShellTexture};
use pelage_graph::{Evaluation, Graph, Request};

/// Runs nodes beside a ball with patches, and asks for an output.
fn run(folder: &Path, nodes: &str, output: &str) -> Result<Evaluation, String> {
    let text = format!(
        r#"Graph(version: 1, nodes: {{ "ball": Sphere(subdivisions: 5), "patches": GrowPatches(mesh: "ball.mesh", tile_size: 0.3), {nodes} }})"#
    );
    let graph = Graph::parse(&text).unwrap().with_directory(folder);
    let graph = graph.check(&pelage_nodes::registry()).map_err(|faults| faults.to_string())?;
    pelage_nodes::evaluator(0).run(&graph, &Request::output(output)).map_err(|error| error.to_string())
}

fn shells(folder: &Path, nodes: &str) -> Result<std::sync::Arc<ShellTexture>, String> {
    Ok(run(folder, nodes, "shells.shells")?.get::<ShellTexture>("shells.shells").unwrap())
}

#[test]
fn a_coat_wants_no_strands() {
    let folder = tempfile::tempdir().unwrap();
    let nodes = r#""grains": PatternShells(layers: 5, resolution: 32, cells: 32), "shells": LevelsOfDetail(shells: "grains.shells"), "fin": FinOfShells(shells: "grains.shells"),
        "coat": LayFur(mesh: "ball.mesh", patches: "patches.patches", shells: "shells.shells", fin: "fin.fin", length: 0.05)"#;
    let evaluation = run(folder.path(), nodes, "coat.fur").unwrap();
    let coat = evaluation.get::<Coat>("coat.fur").unwrap();
    assert_eq!((coat.shells.layers(), coat.shells.levels.len(), coat.shells.directions.is_some()), (5, 4, false));
    // Hair that is a pattern stands as the fur does.
    assert!(coat.surface.directions.iter().zip(&coat.surface.normals).all(|(direction, normal)| direction.distance(*normal) < 1e-5));
    assert!(!coat.edges.vertices.is_empty() && coat.fin.as_ref().unwrap().byte_size() > 0);
}

#[test]
fn images_of_any_kind_are_shells() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    RgbaImage::from_pixel(6, 5, Rgba([200, 100, 50, 255])).save(at("odd.png")).unwrap();
    RgbaImage::from_pixel(1, 1, Rgba([200, 100, 50, 128])).save(at("one.png")).unwrap();
    RgbImage::from_pixel(8, 8, Rgb([10, 200, 30])).save(at("photo.jpg")).unwrap();
    GrayAlphaImage::from_pixel(8, 8, LumaA([120, 255])).save(at("grey.png")).unwrap();
    image::ImageBuffer::<Rgba<u16>, _>::from_pixel(4, 4, Rgba([51_400, 25_700, 12_850, 65_535])).save(at("deep.png")).unwrap();
    for (name, tallest) in [("odd.png", 1.0), ("one.png", 0.0), ("photo.jpg", 1.0), ("grey.png", 1.0), ("deep.png", 1.0)] {
        let made = shells(folder.path(), &format!(r#""shells": ImageShells(paths: ["{name}"], layers: 5, resolution: 16)"#)).unwrap();
        let alpha = |layer: usize| f64::from(made.mips[0].texels[4 * 16 * 16 * layer + 3]) / 255.0;
        assert_eq!((made.layers(), alpha(2), alpha(4)), (5, 1.0, tallest), "{name}");
    }
    // Eight bits and sixteen say the same.
    let of = |name: &str| shells(folder.path(), &format!(r#""shells": ImageShells(paths: ["{name}"], layers: 3, resolution: 8)"#)).unwrap();
    assert_eq!(of("odd.png"), of("deep.png"));
    let stack =
        shells(folder.path(), r#""shells": ImageShells(paths: ["odd.png", "one.png", "photo.jpg"], layers: 99, resolution: 8)"#).unwrap();
    assert_eq!(stack.layers(), 3);
}

#[test]
fn what_is_no_image_is_said() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("broken.png"), b"\x89PNG\r\n\x1a\nno more").unwrap();
    RgbaImage::new(4, 4).save(folder.path().join("fine.png")).unwrap();
    for (nodes, expected) in [
        (r#""shells": ImageShells(paths: ["none.png"])"#, "none.png"),
        (r#""shells": ImageShells(paths: ["fine.png", "broken.png"])"#, "broken.png"),
        (r#""shells": ImageShells(paths: [])"#, "layers"),
        (r#""shells": ImageShells(paths: ["fine.png"], resolution: 100)"#, "power of two"),
        (r#""grains": PatternShells(), "shells": TintShells(shells: "grains.shells", path: "broken.png")"#, "broken.png"),
        (r#""shells": PatternShells(density: 1.5)"#, "density"),
        (r#""shells": PatternShells(density: nan)"#, "density"),
        (r#""shells": PatternShells(cells: 300, look: Noise(kind: Dots))"#, "cells"),
        (r#""shells": PatternShells(layers: 256, resolution: 2048)"#, "texels"),
    ] {
        let error = shells(folder.path(), nodes).unwrap_err();
        assert!(error.contains(expected), "{nodes}: no {expected:?} in {error}");
    }
}

/// Z3: a colour texture of its own; what covers stays.
#[test]
fn a_picture_dyes_shells() {
    let folder = tempfile::tempdir().unwrap();
    let picture = RgbaImage::from_fn(16, 16, |x, _| if x < 8 { Rgba([0, 255, 0, 255]) } else { Rgba([0, 0, 0, 0]) });
    picture.save(folder.path().join("half.png")).unwrap();
    let grains = r#""grains": PatternShells(layers: 3, resolution: 16, cells: 16, density: 0.5, root_colour: (1.0, 1.0, 1.0), tip_colour: (1.0, 1.0, 1.0), brightness: 0.0)"#;
    let plain = shells(folder.path(), &grains.replace("\"grains\"", "\"shells\"")).unwrap();
    let dyed = shells(folder.path(), &format!(r#"{grains}, "shells": TintShells(shells: "grains.shells", path: "half.png")"#)).unwrap();
    for (index, (before, after)) in plain.mips[0].texels.chunks_exact(4).zip(dyed.mips[0].texels.chunks_exact(4)).enumerate() {
        assert_eq!(before[3], after[3]);
        let green = index % 16 < 8;
        assert_eq!([after[0], after[1], after[2]], if green { [0, before[1], 0] } else { [before[0], before[1], before[2]] }, "{index}");
    }
}

#[test]
fn a_fin_of_coats_in_a_row_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let nodes = r#""a": GrowStrands(count: 20, undercoat: (count: 0)), "b": GrowStrands(count: 10, undercoat: (count: 0), seed: 2), "row": CoatsInARow(first: "a.strands", second: "b.strands"),
        "shells": SampleShells(strands: "row.strands", layers: 4, resolution: 16), "fin": FinOfShells(shells: "shells.shells")"#;
    let error = run(folder.path(), nodes, "fin.fin").map(|evaluation| evaluation.get::<FinTexture>("fin.fin").is_ok()).unwrap_err();
    assert!(error.contains("take SampleFin"), "{error}");
}

/// L6: more triangles than the tiling has, and between vertices of the mesh what its corners are.
#[test]
fn overlapping_patches_make_a_coat() {
    let folder = tempfile::tempdir().unwrap();
    let nodes = r#""shells": PatternShells(layers: 3, resolution: 16, cells: 16), "lapped": LapPatches(mesh: "ball.mesh", tile_size: 0.3),
        "lengths": ScalarRamp(mesh: "ball.mesh", from: 1.0, to: 2.0), "fin": FinOfShells(shells: "shells.shells"),
        "tiled": LayFur(mesh: "ball.mesh", patches: "patches.patches", shells: "shells.shells", fin: "fin.fin", lengths: "lengths.values", length: 0.1),
        "coat": LayFur(mesh: "ball.mesh", patches: "patches.patches", lapped: "lapped.lapped", shells: "shells.shells", fin: "fin.fin", lengths: "lengths.values", length: 0.1)"#;
    let of = |output: &str| run(folder.path(), nodes, output).unwrap().get::<Coat>(output).unwrap();
    let (tiled, lapped) = (of("tiled.fur"), of("coat.fur"));
    assert!(tiled.patches.opacities.is_empty() && lapped.patches.opacities.len() == lapped.patches.vertices.len());
    assert!(lapped.patches.faces.len() > 2 * tiled.patches.faces.len());
    assert_eq!(tiled.edges, lapped.edges, "fins are as they were");
    let own = tiled.surface.positions.len();
    assert_eq!(tiled.surface.offsets, lapped.surface.offsets[..own]);
    for (offset, position) in lapped.surface.offsets.iter().zip(&lapped.surface.positions).skip(own) {
        // The length goes evenly from 0.1 at the bottom to 0.2 at the top of a ball whose diameter in its box is 1 / √3 of it.
        let wanted = 0.15 + 0.1 * position.y * 3f32.sqrt();
        assert!((offset.length() - wanted).abs() < 0.01, "{} for {wanted}", offset.length());
    }
    let other =
        nodes.replace("LapPatches(mesh: \"ball.mesh\"", "LapPatches(mesh: \"other.mesh\"") + r#", "other": Sphere(subdivisions: 9)"#;
    let error = run(folder.path(), &other, "coat.fur").unwrap_err();
    assert!(error.contains("the overlapping patches") && error.contains("link both to the same mesh"), "{error}");
}
