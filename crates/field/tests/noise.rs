//! Noise in space.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it measured")]

use glam::DVec3;
use pelage_field::{FieldError, Noise, NoiseKind, ScalarField};
use pelage_mesh::{Mesh, plane, sphere};
use proptest::prelude::*;

const KINDS: [NoiseKind; 4] = [NoiseKind::Perlin, NoiseKind::Simplex, NoiseKind::Dots, NoiseKind::Patches];

/// The dense plane has every vertex of the coarse one, and many between.
#[test]
fn the_same_place_has_the_same_noise_whatever_the_triangles() {
    let (coarse, dense) = (plane(1.0, 1.0, 8, 8).unwrap(), plane(1.0, 1.0, 64, 64).unwrap());
    for kind in KINDS {
        let noise = Noise { kind, size: 0.07, ..Noise::default() };
        let [few, many] = [&coarse, &dense].map(|mesh| ScalarField::noise(mesh, &noise).unwrap());
        for (vertex, p) in coarse.positions().iter().enumerate() {
            let twin = dense.positions().iter().position(|q| q == p).unwrap();
            assert_eq!(few.values()[vertex], many.values()[twin], "{kind:?} at {p}");
        }
    }
}

#[test]
fn values_fill_zero_to_one_about_a_half() {
    let ball = sphere(1.0, 60).unwrap();
    for kind in KINDS {
        for octaves in [1, 4] {
            let field = ScalarField::noise(&ball, &Noise { kind, size: 0.05, octaves, ..Noise::default() }).unwrap();
            let values = field.values();
            let mean = values.iter().sum::<f32>() / values.len() as f32;
            let (least, most) = values.iter().fold((1.0_f32, 0.0_f32), |(least, most), &v| (least.min(v), most.max(v)));
            println!("reached: {kind:?} of {octaves}: {least:.2} to {most:.2}, mean {mean:.3}");
            assert!((0.0..=1.0).contains(&least) && most <= 1.0 && most - least > 0.45 && (0.35..0.65).contains(&mean), "{kind:?}");
        }
    }
}

/// Continuous noise changes by less than its slope allows from vertex to vertex; a finer size changes faster; more octaves are rougher.
#[test]
fn size_and_octaves_say_how_fast_it_changes() {
    let sheet = plane(1.0, 1.0, 100, 100).unwrap();
    let diameter = sheet.diameter();
    let steepest = |noise: &Noise| {
        let field = ScalarField::noise(&sheet, noise).unwrap();
        let change = |edge: pelage_mesh::Edge<'_, Mesh>| {
            let [a, b] = edge.vertices().map(|v| field.values()[v.index()]);
            f64::from((a - b).abs()) / (edge.length() / diameter)
        };
        sheet.edges().map(change).sum::<f64>() / sheet.topology().edge_count() as f64
    };
    for kind in [NoiseKind::Perlin, NoiseKind::Simplex, NoiseKind::Dots] {
        let of = |size, octaves| steepest(&Noise { kind, size, octaves, roughness: 0.9, ..Noise::default() });
        let (wide, fine, rough) = (of(0.4, 1), of(0.1, 1), of(0.4, 3));
        println!("reached: {kind:?}: mean slope {wide:.2} at size 0.4, {fine:.2} at 0.1, {rough:.2} with three octaves");
        assert!((2.5..6.0).contains(&(fine / wide)), "{kind:?}: {wide} {fine}");
        assert!(rough > 1.2 * wide, "{kind:?}: {wide} {rough}");
    }
    let smooth = |roughness| steepest(&Noise { size: 0.4, octaves: 6, roughness, ..Noise::default() });
    assert_eq!(smooth(0.0), steepest(&Noise { size: 0.4, octaves: 1, ..Noise::default() }));
    assert!(smooth(0.9) > 2.0 * smooth(0.3));
}

#[test]
fn patches_are_flat_and_a_seed_gives_others() {
    let ball = sphere(1.0, 30).unwrap();
    let noise = Noise { kind: NoiseKind::Patches, octaves: 1, size: 0.2, ..Noise::default() };
    let field = ScalarField::noise(&ball, &noise).unwrap();
    let same = ball.edges().filter(|edge| edge.vertices().map(|v| field.values()[v.index()]).windows(2).all(|v| v[0] == v[1])).count();
    assert!(same as f64 > 0.8 * ball.topology().edge_count() as f64, "{same}");
    for kind in KINDS {
        let of = |seed| ScalarField::noise(&ball, &Noise { kind, seed, ..Noise::default() }).unwrap();
        assert!(of(1) == of(1) && of(1) != of(2));
    }
}

#[test]
fn scale_and_place_of_the_model_change_nothing() {
    let ball = sphere(1.0, 12).unwrap();
    let here = ScalarField::noise(&ball, &Noise::default()).unwrap();
    for (scale, shift) in [(1e-30, DVec3::ZERO), (1e30, DVec3::ZERO), (1.0, DVec3::new(100.0, -5.0, 3.0))] {
        let moved = ball.with_positions(ball.positions().iter().map(|&p| scale * p + shift).collect()).unwrap();
        let there = ScalarField::noise(&moved, &Noise::default()).unwrap();
        let apart = here.values().iter().zip(there.values()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(apart < 1e-5, "{scale} {shift}: {apart}");
    }
}

#[test]
fn settings_out_of_range_are_refused() {
    let ball = sphere(1.0, 2).unwrap();
    let still = Noise::default();
    let wrong = [
        Noise { size: 0.0, ..still },
        Noise { size: f64::NAN, ..still },
        Noise { size: 1e3, ..still },
        Noise { octaves: 0, ..still },
        Noise { octaves: 13, ..still },
        Noise { roughness: -0.1, ..still },
        Noise { roughness: 1.1, ..still },
    ];
    for noise in wrong {
        assert!(matches!(ScalarField::noise(&ball, &noise), Err(FieldError::Setting { .. })), "{noise:?}");
    }
    assert_eq!(ScalarField::noise(&Mesh::from_triangles(vec![DVec3::X], &[]).unwrap(), &still), Err(FieldError::NoSurface));
}

proptest! {
    #[test]
    fn any_noise_is_within_its_range(size in 0.005..100.0_f64, octaves in 1..=12_u32, roughness in 0.0..=1.0_f64, seed in any::<u32>(), kind in 0..4_usize) {
        let noise = Noise { kind: KINDS[kind], size, octaves, roughness, seed };
        let field = ScalarField::noise(&sphere(1.0, 3).unwrap(), &noise).unwrap();
        prop_assert!(field.values().iter().all(|v| (0.0..=1.0).contains(v)));
    }
}
