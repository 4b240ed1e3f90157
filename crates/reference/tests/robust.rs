//! What is wrong is said, what is degenerate is bald, and who asks to stop is heard.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{Vec2, Vec3};
use pelage_coat::{Camera, Coat, Light, Lights, PatchMesh};
use pelage_reference::{Image, Laying, Placement, ReferenceError, Scene, Settings, View, quiet};
use pelage_strand::{StrandSource, StrandTile};
use proptest::prelude::*;
use support::{above, glow, hair, square, tile};

fn some_hair() -> StrandTile {
    tile(&[hair(&[[0.3, 0.3, 0.0], [0.5, 0.4, 0.5], [0.4, 0.7, 1.0]], &[0.05, 0.04, 0.01])])
}

fn view() -> View {
    let (lights, shading) = glow();
    View { camera: above(Vec3::ZERO, 1.5), lights, shading }
}

fn settings() -> Settings {
    Settings { size: (32, 24), samples: 4, ..Settings::default() }
}

fn picture(coat: &Coat, tile: &StrandTile, laying: &Laying) -> Result<Image, ReferenceError> {
    Scene::new(coat, tile, laying)?.render(&view(), &settings(), &quiet)
}

#[test]
fn fur_without_length_is_the_bald_picture() {
    let (mut coat, tile) = (square(3, 1.0), some_hair());
    let bald = picture(&coat, &StrandTile::empty(1.0), &Laying { length_scale: 0.0, ..Laying::default() }).unwrap();
    assert!(bald.pixels.iter().any(|pixel| pixel[3] == 1.0));
    for placement in [Placement::Shell, Placement::Free] {
        let laying = Laying { placement, ..Laying::default() };
        let shorn = Scene::new(&coat, &tile, &Laying { length_scale: 0.0, ..laying }).unwrap();
        assert_eq!(shorn.counts().segments, 0);
        assert!(shorn.render(&view(), &settings(), &quiet).unwrap() == bald);
    }
    assert!(picture(&coat, &tile, &Laying::default()).unwrap() != bald);
    coat.surface.offsets.fill(Vec3::ZERO);
    assert!(picture(&coat, &tile, &Laying::default()).unwrap() == bald);
}

#[test]
fn nothing_at_all_is_a_clear_picture() {
    let mut coat = square(1, 1.0);
    coat.patches = PatchMesh::default();
    let image = picture(&coat, &some_hair(), &Laying::default()).unwrap();
    assert!(image.pixels.len() == 32 * 24 && image.pixels.iter().all(|pixel| *pixel == [0.0; 4]));
    let scene = Scene::new(&coat, &some_hair(), &Laying::default()).unwrap().counts();
    assert_eq!((scene.segments, scene.triangles), (0, 0));
    let coat = square(1, 1.0);
    let empty = StrandTile::empty(1.0);
    let scene = Scene::new(&coat, &empty, &Laying::default()).unwrap();
    for size in [(0, 0), (0, 5), (7, 0)] {
        assert!(scene.render(&view(), &Settings { size, ..settings() }, &quiet).unwrap().pixels.is_empty());
    }
}

#[test]
fn what_is_wrong_is_said() {
    let (coat, tile) = (square(2, 1.0), some_hair());
    let laid = |coat: &Coat, tile: &StrandTile, laying: Laying| Scene::new(coat, tile, &laying).map(|_| ()).unwrap_err();
    for tolerance in [0.0, f64::NAN, 2.0] {
        assert!(matches!(
            laid(&coat, &tile, Laying { tolerance, ..Laying::default() }),
            ReferenceError::OutOfRange { name: "tolerance", .. }
        ));
    }
    assert!(matches!(laid(&coat, &tile, Laying { length_scale: -1.0, ..Laying::default() }), ReferenceError::OutOfRange { .. }));
    assert!(matches!(laid(&coat, &StrandTile::empty(f64::NAN), Laying::default()), ReferenceError::NoHeight { .. }));
    let mut broken = coat.clone();
    broken.surface.offsets[3].x = f32::NAN;
    assert!(matches!(laid(&broken, &tile, Laying::default()), ReferenceError::Coat(_)));
    let mut far = coat.clone();
    far.surface.positions[5].y = 1e30;
    assert_eq!(laid(&far, &tile, Laying::default()), ReferenceError::TooFar { vertex: 5 });
    let mut huge = coat.clone();
    huge.patches.coordinates[0] = Vec2::new(-1e5, -1e5);
    assert!(matches!(laid(&huge, &tile, Laying::default()), ReferenceError::TooManyTiles { .. }));
    let long = support::tile(&[hair(&[[0.0, 0.0, 0.0], [900.0, 900.0, 1.0]], &[0.1; 2])]);
    assert!(matches!(laid(&coat, &long, Laying::default()), ReferenceError::LongStrand { strand: 0, .. }));

    let scene = Scene::new(&coat, &tile, &Laying::default()).unwrap();
    let drawn = |view: &View, settings: Settings| scene.render(view, &settings, &quiet).unwrap_err();
    assert!(matches!(drawn(&view(), Settings { samples: 0, ..settings() }), ReferenceError::OutOfRange { name: "samples", .. }));
    assert!(matches!(drawn(&view(), Settings { size: (20_000, 1), ..settings() }), ReferenceError::OutOfRange { .. }));
    let good = view().camera;
    for camera in [
        Camera { eye: Vec3::NAN, ..good },
        Camera { target: good.eye, ..good },
        Camera { up: Vec3::Z, ..good },
        Camera { field_of_view: f32::NAN, ..good },
        Camera { field_of_view: 4.0, ..good },
        Camera { near: f32::NAN, ..good },
    ] {
        assert!(matches!(drawn(&View { camera, ..view() }, settings()), ReferenceError::Camera { .. }), "{camera:?}");
    }
    let dark = Lights { directional: vec![Light { direction: Vec3::ZERO, colour: Vec3::ONE }], ..Lights::default() };
    assert_eq!(drawn(&View { lights: dark, ..view() }, settings()), ReferenceError::Light { light: 0 });
}

#[test]
fn progress_is_told_and_cancelling_is_heard() {
    let (coat, tile) = (square(2, 1.0), some_hair());
    let scene = Scene::new(&coat, &tile, &Laying::default()).unwrap();
    let settings = Settings { size: (160, 160), ..settings() };
    let told = Mutex::new(Vec::new());
    let tell = |fraction: f64| {
        told.lock().unwrap().push(fraction);
        ControlFlow::Continue(())
    };
    scene.render(&view(), &settings, &tell).unwrap();
    let mut told = told.into_inner().unwrap();
    told.sort_by(f64::total_cmp);
    // Once for each of 10 × 10 blocks, and at the start.
    let wanted: Vec<f64> = (0..=100).map(|k| f64::from(k) / 100.0).collect();
    assert_eq!(told, wanted);
    for after in [0, 1, 30, 100] {
        let calls = AtomicUsize::new(0);
        let stop = |_: f64| if calls.fetch_add(1, Ordering::Relaxed) >= after { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        assert_eq!(scene.render(&view(), &settings, &stop), Err(ReferenceError::Cancelled), "after {after}");
        // Blocks that had begun are finished, and no more.
        assert!(calls.into_inner() <= after + 1 + rayon::current_num_threads(), "after {after}");
    }
}

#[test]
fn free_hair_is_one_for_each_root() {
    // 2.5 × 2.5 tiles from (0, 0): roots at (0.2, 0.3) stand 3 × 3 times, at (0.7, 0.6) 2 × 2 times; one on the corner of faces is not there twice.
    let upright = |x: f64, y: f64| hair(&[[x, y, 0.0], [x, y, 1.0]], &[0.01; 2]);
    let tile = tile(&[upright(0.2, 0.3), upright(0.7, 0.6), upright(0.5, 0.5)]);
    let coat = square(5, 2.5);
    let laying = Laying { placement: Placement::Free, ..Laying::default() };
    let scene = Scene::new(&coat, &tile, &laying).unwrap();
    let curves = scene.curves().unwrap().0;
    // Of (0.5, 0.5), three stand on the rim and a rim is on its face or not.
    let on_rim = |curve: &[[f32; 4]]| curve[0][0].abs().max(curve[0][1].abs()) > 0.499;
    let inside = curves.iter().filter(|curve| !on_rim(curve)).count();
    assert_eq!(inside, 9 + 4 + 4, "of {}", curves.len());
    assert!(curves.iter().all(|curve| curve.len() == 2 && curve[0][2] == 0.0 && (curve[1][2] - 0.1).abs() < 1e-6));
    assert!(curves.iter().all(|curve| (curve[0][3] - 0.004).abs() < 1e-6), "a hundredth of a tile side of 0.4");
}

#[test]
fn curves_are_text_that_reads_back() {
    let (coat, tile) = (square(4, 2.0), some_hair());
    for placement in [Placement::Shell, Placement::Free] {
        let scene = Scene::new(&coat, &tile, &Laying { placement, tolerance: 0.01, ..Laying::default() }).unwrap();
        let curves = scene.curves().unwrap();
        let mut text = Vec::new();
        curves.write(&mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        let read: Vec<Vec<[f32; 4]>> = text
            .split("\n\n")
            .map(|curve| {
                curve
                    .lines()
                    .map(|line| <[f32; 4]>::try_from(line.split(' ').map(|w| w.parse().unwrap()).collect::<Vec<f32>>()).unwrap())
                    .collect()
            })
            .collect();
        assert_eq!(read, curves.0);
        // All of one patch, so that no hair is in two pieces but at the rim, and each segment is in one curve.
        assert_eq!(read.len(), 4, "{placement:?}");
        let segments = read.iter().map(|curve| curve.len() - 1).sum::<usize>();
        // In shell space a face also has what reaches in from beside it.
        assert!(segments == scene.counts().segments || (placement == Placement::Shell && segments < scene.counts().segments));
        for curve in &read {
            assert!(curve.windows(2).all(|pair| pair[0][2] < pair[1][2]), "from root to tip");
            assert!(curve[0][2].abs() < 1e-6 && (curve[curve.len() - 1][2] - 0.1).abs() < 1e-6, "whole");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn no_coat_panics_or_makes_a_pixel_that_is_no_number(
        values in proptest::collection::vec(-2.0..2.0f32, 9 * 14), tilted in 0usize..4, placement in 0usize..2, scale in 0.0..3.0f64,
    ) {
        let mut coat = square(2, 1.0);
        for (v, own) in values.chunks_exact(14).enumerate() {
            let at = |k: usize| Vec3::new(own[k], own[k + 1], own[k + 2]);
            coat.surface.positions[v] = at(0);
            coat.surface.offsets[v] = at(3);
            coat.surface.bends[v] = at(6);
            coat.surface.ends[v] = own[9];
            coat.patches.coordinates[v] = Vec2::new(own[10], own[11]);
            coat.surface.directions[v] = Vec3::new(own[12], own[13], 0.0);
        }
        // Faces of no area, in the tile, on the surface, or both.
        if tilted & 1 == 1 { coat.surface.positions[1] = coat.surface.positions[0]; }
        if tilted & 2 == 2 { coat.patches.coordinates[4] = coat.patches.coordinates[0]; }
        let placement = [Placement::Shell, Placement::Free][placement];
        let strand = StrandSource { radii: vec![0.2, 0.0, 0.4], ..hair(&[[0.1, 0.1, 0.0], [0.1, 0.1, 0.0], [0.9, 0.2, 1.3]], &[0.0; 3]) };
        let image = picture(&coat, &tile(&[strand]), &Laying { placement, length_scale: scale, ..Laying::default() }).unwrap();
        prop_assert!(image.pixels.iter().flatten().all(|c| c.is_finite()));
        prop_assert!(image.pixels.iter().all(|p| (0.0..=1.0).contains(&p[3])));
    }
}
