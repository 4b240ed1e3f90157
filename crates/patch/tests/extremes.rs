//! The row "Scale" of the numbers at their extremes, on real models: however large and wherever they are, they are tiled as at home.
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "a test stops where it fails and says what it did not try")]

mod common;

use std::path::Path;

use glam::DVec3;
use pelage_field::DirectionField;
use pelage_mesh::{Mesh, read_obj};
use pelage_patch::{PatchTiling, Settings};

/// The bunny that is shipped, and of the real models those that take little time.
fn models() -> Vec<(String, Mesh)> {
    let bunny = read_obj(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs/models/bunny.obj")).unwrap().mesh;
    let small = common::real_models().into_iter().filter(|(_, mesh)| mesh.topology().face_count() < 4000);
    std::iter::once(("the shipped bunny".to_owned(), bunny)).chain(small).collect()
}

/// Along a field and without, with tiles of a part of the diameter.
fn tilings(mesh: &Mesh) -> [PatchTiling; 2] {
    let settings = Settings::with_tile_side(0.08 * mesh.diameter());
    let field: DirectionField = common::combed(mesh);
    [Some(&field), None].map(|directions| common::tile(mesh, directions, &settings))
}

#[test]
fn a_model_of_any_scale_and_place_is_tiled_alike() {
    let (mut most, mut tried) = (0.0_f64, 0);
    for (name, mesh) in models() {
        let here = tilings(&mesh);
        let far = 1e7 * mesh.diameter() * DVec3::new(-0.4, 1.0, 0.8);
        for scale in [1e-30, 1e-15, 1.0, 1e15, 1e30] {
            for offset in [DVec3::ZERO, far].into_iter().filter(|&offset| scale != 1.0 || offset != DVec3::ZERO) {
                let there = tilings(&common::moved(&mesh, |p| scale * (p + offset)));
                for (here, there) in here.iter().zip(&there) {
                    assert_eq!(here.patches().len(), there.patches().len(), "{name} × {scale} at {offset}");
                    let worst = here.coordinates().iter().zip(there.coordinates()).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
                    assert!(here.faces() == there.faces() && worst < 1e-4, "{name} × {scale} at {offset}: {worst}");
                    (most, tried) = (most.max(worst), tried + 1);
                }
            }
        }
    }
    println!("reached: the same patches in {tried} tilings, coordinates within {most:.0e} tiles");
}
