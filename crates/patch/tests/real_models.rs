//! The limits on real models, at the default setting.
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "a test stops where it fails and says what it did not try")]

mod common;

use pelage_patch::{Settings, grow};

/// The stand-ins for the paper's Table 1 have 1,452 to 5,000 faces, and 150 to 400 patches where the paper has 192 to 338.
#[test]
fn default_setting_keeps_the_limits() {
    for (name, mesh) in common::real_models() {
        let field = common::combed(&mesh);
        for directions in [Some(&field), None] {
            let table_1 = name.starts_with("t1_");
            for seed in 0..if table_1 { 3 } else { 1 } {
                let settings = Settings { seed, ..Settings::for_mesh(&mesh) };
                let tiling = grow(&mesh, directions, &settings).unwrap();
                let quality = common::check(&mesh, directions, &settings, &tiling);
                assert!(quality.stretch_p50 <= 1.15 && quality.stretch_p99 <= 2.0, "{name}: {quality:?}");
                assert!(quality.misalignment_deg_mean.is_none_or(|d| d < 12.0), "{name}: {quality:?}");
                assert!(quality.tiny_patch_area < 0.05, "{name}: {quality:?}");
                assert!(!table_1 || (150..=400).contains(&quality.patch_count), "{name}: {quality:?}");
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
