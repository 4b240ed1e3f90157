//! The limits on real models, at the default setting.
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "a test stops where it fails and says what it did not try")]

mod common;

use common::Model;
use pelage_mesh::Mesh;
use pelage_patch::{PatchTiling, Settings, grow};

/// The faces with area whose image does not wind as they do, counted without the library's help.
fn flips(mesh: &Mesh, tiling: &PatchTiling) -> usize {
    let flipped = |row: &usize| {
        let [a, b, c] = tiling.faces()[*row].map(|v| tiling.coordinates()[v as usize]);
        let [p, q, r] = mesh.face(tiling.surface_faces()[*row]).positions();
        let longest = p.distance(q).max(q.distance(r)).max(r.distance(p));
        let has_area = (q - p).cross(r - p).length() / longest / longest > 1e-10;
        has_area && (b - a).perp_dot(c - a) <= 0.0
    };
    (0..tiling.faces().len()).filter(flipped).count()
}

/// What the issue asks of every model at the default setting, with the default field and without. What is stricter here than there: p50 and p99 of the stretch
/// are met by 1.1 and 1.6, mean misalignment by 8° instead of 12°.
#[test]
fn default_setting_keeps_the_limits() {
    let (mut tilings, mut flipped) = (0, 0);
    for Model { name, mesh, clean } in common::all_models() {
        let field = common::combed(&mesh);
        let faces = mesh.topology().face_count();
        for directions in [Some(&field), None] {
            for seed in 0..if faces < 7000 { 3 } else { 1 } {
                let settings = Settings { seed, ..Settings::for_mesh(&mesh) };
                let tiling = grow(&mesh, directions, &settings).unwrap();
                let quality = common::check(&mesh, directions, &settings, &tiling);
                assert_eq!(
                    quality.faces_flipped,
                    flips(&mesh, &tiling),
                    "{name}: the count of flips, 0 on every model as `check` has seen, is that of a search of its own"
                );
                tilings += 1;
                flipped += quality.faces_flipped;
                // A percentile of two faces, of a quadrangle bent by 50°, is one face: that keeps the bounds on each.
                if faces < 100 {
                    continue;
                }
                assert!(quality.stretch_p50 <= 1.1 && quality.stretch_p99 <= 1.6, "{name}: {quality:?}");
                assert!(quality.misalignment_deg_mean_far.is_none_or(|degrees| degrees < 8.0), "{name}: {quality:?}");
                assert!(!clean || quality.tiny_patch_area < 0.04, "{name}: {quality:?}");
                // Of a cone's 5,000 needles, each a sliver of many directions, a quarter; of a model one in twenty-five.
                let part = if clean { 25 } else { 4 };
                assert!(tiling.let_off().len() * part <= faces, "{name}: {} of {faces} faces are let off", tiling.let_off().len());
            }
        }
    }
    println!("reached: {flipped} flips in {tilings} tilings of all models, counted twice");
}

/// The stand-ins for the paper's Table 1 have 1,452 to 5,000 faces, and 150 to 400 patches where the paper has 192 to 338, at one setting.
#[test]
fn table_1_has_as_many_patches_as_the_paper() {
    for (name, mesh) in common::real_models().into_iter().filter(|(name, _)| name.starts_with("t1_")) {
        let field = common::combed(&mesh);
        for directions in [Some(&field), None] {
            for seed in 0..5 {
                let tiling = grow(&mesh, directions, &Settings { seed, ..Settings::for_mesh(&mesh) }).unwrap();
                assert!((150..=400).contains(&tiling.patches().len()), "{name}: {} patches", tiling.patches().len());
                if directions.is_some() && name != "t1_die_1452" {
                    let tiny = tiling.quality(&mesh, directions).tiny_patch_count;
                    assert!(20 * tiny <= tiling.patches().len() + 40, "{name}: {tiny} tiny patches");
                }
            }
        }
    }
}

/// Other seeds and tile sizes keep what holds by construction.
#[test]
fn any_setting_keeps_the_bounds() {
    for (name, mesh) in common::real_models() {
        if mesh.topology().face_count() > 5000 {
            continue;
        }
        let field = common::combed(&mesh);
        for (seed, tile, extent) in [(1, 0.01, 1.0), (2, 0.05, 8.0), (3, 0.5, 0.1), (4, 1.0, 4.0)] {
            let settings = Settings { seed, patch_extent: extent, ..Settings::with_tile_side(tile * mesh.diameter()) };
            let tiling = common::tile(&mesh, Some(&field), &settings);
            assert!(!tiling.patches().is_empty(), "{name}");
        }
    }
}
