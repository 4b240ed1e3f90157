//! The row "Scale" of the numbers at their extremes from file to coat, and what a coat's `f32` costs.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it measured")]

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{DVec3, Vec3};
use pelage_coat::Coat;
use pelage_graph::{Evaluator, Graph, Request};
use pelage_mesh::{Mesh, read_obj};
use pelage_patch::PatchTiling;

fn graphs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs")
}

fn bunny() -> Mesh {
    read_obj(&graphs().join("models/bunny.obj")).unwrap().mesh
}

/// The saved bunny's tiling and coat, of another file and less hair.
fn furred(model: &Path) -> (Arc<PatchTiling>, Arc<Coat>) {
    let registry = pelage_nodes::registry();
    let mut graph = Graph::read(&graphs().join("bunny.ron")).unwrap();
    let model = model.display().to_string();
    let set = [
        ("bunny.path", model.as_str()),
        ("hair.count", "80"),
        ("hair.undercoat.count", "0"),
        ("shells.layers", "4"),
        ("shells.resolution", "32"),
    ];
    for (input, value) in set.into_iter().chain([("fin.size", "(64, 16)")]) {
        graph.set(&registry, input, value, Path::new(".")).unwrap();
    }
    let request = Request::output("patches.patches").and_output("coat.fur");
    let evaluation = Evaluator::new(0).run(&graph.check(&registry).unwrap(), &request).unwrap();
    (evaluation.get::<PatchTiling>("patches.patches").unwrap(), evaluation.get::<Coat>("coat.fur").unwrap())
}

/// The greatest distance between two lists of vectors.
fn apart(a: &[Vec3], b: &[Vec3]) -> f32 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
}

/// The file's numbers times anything and moved ten million times the model's size give the same coat, which does not know of either.
#[test]
fn a_coat_of_any_scale_and_place_is_the_same() {
    let (bunny, folder) = (bunny(), tempfile::tempdir().unwrap());
    let (_, here) = furred(&graphs().join("models/bunny.obj"));
    let far = 1e7 * bunny.diameter() * DVec3::new(0.8, -0.4, -1.0);
    let (mut places, mut tiles, mut hair) = (0.0_f32, 0.0_f32, 0.0_f32);
    for scale in [1e-30, 1e-15, 1.0, 1e15, 1e30] {
        for offset in [DVec3::ZERO, far] {
            let vertices = bunny.positions().iter().map(|&p| scale * (p + offset)).map(|p| format!("v {:e} {:e} {:e}\n", p.x, p.y, p.z));
            let faces = bunny.topology().triangles().map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1));
            let file = folder.path().join("bunny.obj");
            std::fs::write(&file, vertices.chain(faces).collect::<String>()).unwrap();
            let (_, there) = furred(&file);
            let what = format!("× {scale} at {offset}");
            assert!(there.patches.faces == here.patches.faces && there.patches.patch_ends == here.patches.patch_ends, "{what}");
            places = places.max(apart(&here.surface.positions, &there.surface.positions));
            let coordinates = here.patches.coordinates.iter().zip(&there.patches.coordinates);
            tiles = coordinates.map(|(a, b)| a.distance(*b)).fold(tiles, f32::max);
            let (a, b) = (&here.surface, &there.surface);
            for (a, b) in [(&a.normals, &b.normals), (&a.offsets, &b.offsets), (&a.directions, &b.directions), (&a.colours, &b.colours)] {
                hair = hair.max(apart(a, b));
            }
            assert!(places < 1e-4 && tiles < 1e-4 && hair < 1e-4, "{what}: places {places}, tiles {tiles}, hair {hair}");
        }
    }
    println!(
        "reached: {} patches each time, places within {places:.0e}, tile coordinates within {tiles:.0e}, hair within {hair:.0e}",
        here.patches.patch_ends.len()
    );
}

/// A coat rounds to `f32` what was worked out in `f64`: places after they are normalised, and tile coordinates. What is lost is far under a pixel and a texel.
#[test]
fn what_a_coat_rounds_is_far_under_a_pixel_and_a_texel() {
    let (tiling, coat) = furred(&graphs().join("models/bunny.obj"));
    let bunny = bunny();
    let exact = bunny.positions().iter().map(|&p| (p - coat.frame.centre) / coat.frame.diameter);
    let place = exact.zip(&coat.surface.positions).map(|(exact, kept)| exact.distance(kept.as_dvec3())).fold(0.0, f64::max);
    let coordinates = tiling.coordinates().iter().zip(&coat.patches.coordinates);
    let tile = coordinates.map(|(exact, kept)| exact.distance(kept.as_dvec2())).fold(0.0, f64::max);
    // Of a model that fills 4,096 pixels, and of the finest tile.
    println!("reached: {place:.0e} diameters, {:.0e} pixels", 4096.0 * place);
    println!("reached: {tile:.0e} tiles, {:.0e} texels", 2048.0 * tile);
    assert!(4096.0 * place < 1e-3 && 2048.0 * tile < 1e-2, "{place} {tile}");
}
