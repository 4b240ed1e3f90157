//! Blurring along the surface.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it measured")]

mod common;

use glam::{DVec3, Vec3};
use pelage_field::{ColourField, FieldError, Noise, NoiseKind, ScalarField};
use pelage_mesh::{Mesh, join, plane, sphere};
use proptest::prelude::*;

/// The sum over the area, in square diameters.
fn integral(mesh: &Mesh, field: &ScalarField) -> f64 {
    mesh.vertices().zip(field.values()).map(|(vertex, &value)| vertex.area() * f64::from(value)).sum::<f64>() / mesh.diameter().powi(2)
}

fn spots(mesh: &Mesh) -> ScalarField {
    ScalarField::noise(mesh, &Noise { kind: NoiseKind::Dots, size: 0.1, ..Noise::default() }).unwrap().mask(0.5, 0.0).unwrap()
}

#[test]
fn the_integral_stays_and_no_value_leaves_the_range() {
    let mut worst = 0.0_f64;
    for (name, mesh) in common::models() {
        let field = spots(&mesh).map(|v| 0.25 + 0.5 * v).unwrap();
        let (least, most) = field.values().iter().fold((1.0_f32, 0.0_f32), |(a, b), &v| (a.min(v), b.max(v)));
        for radius in [1e-4, 0.01, 0.3, 10.0] {
            let blurred = field.blurred(&mesh, radius).unwrap();
            let (before, after) = (integral(&mesh, &field), integral(&mesh, &blurred));
            worst = worst.max((after / before - 1.0).abs());
            assert!((after / before - 1.0).abs() < 1e-5, "{name} by {radius}: {before} became {after}");
            assert!(blurred.values().iter().all(|v| (least..=most).contains(v)), "{name} by {radius}");
        }
    }
    println!("reached: integrals kept to {worst:.0e}");
}

/// A step on a plane becomes the Gaussian's integral; a wide sheet, so that the rim is far.
#[test]
fn a_step_becomes_the_integral_of_a_gaussian() {
    let sheet = plane(4.0, 0.2, 400, 20).unwrap();
    let step = ScalarField::ramp(&sheet, DVec3::X, -2.0, 2.0)
        .unwrap()
        .map(|x| {
            if x > 0.0 {
                1.0
            } else if x == 0.0 {
                0.5
            } else {
                0.0
            }
        })
        .unwrap();
    let deviation = 0.05;
    let blurred = step.blurred(&sheet, deviation).unwrap();
    let (mut most, diameter) = (0.0_f64, sheet.diameter());
    for (p, &value) in sheet.positions().iter().zip(blurred.values()) {
        let x = p.x / diameter / deviation;
        let expected = 0.5 + 0.5 * libm::erf(x / 2_f64.sqrt());
        most = most.max((f64::from(value) - expected).abs());
    }
    println!("reached: within {most:.3} of the Gaussian's integral");
    assert!(most < 0.03, "{most}");
}

/// A wave that fits a strip of zero flux is damped by exp(−k² t), which four implicit steps meet by a known factor.
#[test]
fn a_wave_is_damped_as_the_steps_say() {
    let sheet = plane(1.0, 0.1, 200, 20).unwrap();
    let wave = |p: &DVec3| libm::cos(2.0 * std::f64::consts::PI * (p.x + 0.5)) as f32;
    let field = ScalarField::new(sheet.positions().iter().map(wave).collect()).unwrap();
    let radius = 0.1;
    let blurred = field.blurred(&sheet, radius).unwrap();
    let number = 2.0 * std::f64::consts::PI * sheet.diameter();
    let expected = (1.0 + 0.5 * radius * radius * number * number / 4.0).powi(-4);
    for (a, b) in field.values().iter().zip(blurred.values()).filter(|(a, _)| a.abs() > 0.5) {
        assert!((f64::from(b / a) - expected).abs() < 2e-3, "{} for {expected}", b / a);
    }
}

/// The blur of coarse and of dense triangles is the same.
#[test]
fn the_triangles_make_little_difference() {
    let (coarse, dense) = (sphere(1.0, 24).unwrap(), sphere(1.0, 72).unwrap());
    let [few, many] = [&coarse, &dense]
        .map(|mesh| ScalarField::ramp(mesh, DVec3::Y, 0.0, 1.0).unwrap().mask(0.6, 0.05).unwrap().blurred(mesh, 0.08).unwrap());
    let mut most = 0.0_f32;
    for (vertex, p) in coarse.positions().iter().enumerate() {
        let twin = dense.positions().iter().position(|q| q.distance(*p) < 1e-9).unwrap();
        most = most.max((few.values()[vertex] - many.values()[twin]).abs());
    }
    println!("reached: within {most:.4} of each other");
    assert!(most < 0.01, "{most}");
}

#[test]
fn pieces_do_not_mix_and_colours_are_blurred_like_numbers() {
    let sheet = plane(1.0, 1.0, 10, 10).unwrap();
    let above = sheet.with_positions(sheet.positions().iter().map(|&p| p + 0.01 * DVec3::Y).collect()).unwrap();
    let both = join(&sheet, &above).unwrap();
    let count = sheet.positions().len();
    let halves = ScalarField::new((0..2 * count).map(|v| if v < count { 0.0 } else { 1.0 }).collect()).unwrap();
    assert_eq!(halves.blurred(&both, 1.0).unwrap(), halves);
    let spots = spots(&sheet);
    let colours = ColourField::new(spots.values().iter().map(|&v| Vec3::new(v, 1.0 - v, 0.5)).collect()).unwrap();
    let (numbers, colours) = (spots.blurred(&sheet, 0.03).unwrap(), colours.blurred(&sheet, 0.03).unwrap());
    for (v, colour) in numbers.values().iter().zip(colours.values()) {
        assert!(colour.distance(Vec3::new(*v, 1.0 - v, 0.5)) < 1e-5);
    }
}

#[test]
fn nothing_to_blur_changes_nothing_and_the_rest_is_refused() {
    let ball = sphere(1.0, 6).unwrap();
    let spots = spots(&ball);
    assert_eq!(spots.blurred(&ball, 0.0).unwrap(), spots);
    for radius in [-0.1, f64::NAN, 10.1] {
        assert!(matches!(spots.blurred(&ball, radius), Err(FieldError::Setting { .. })));
    }
    assert!(matches!(spots.blurred(&sphere(1.0, 5).unwrap(), 0.1), Err(FieldError::Length { .. })));
    let nothing = Mesh::from_triangles(vec![DVec3::X], &[]).unwrap();
    let one = ScalarField::constant(&nothing, 3.0).unwrap();
    assert_eq!(one.blurred(&nothing, 0.1).unwrap(), one);
    // A face without area, and a vertex without a face.
    let flat = Mesh::from_triangles(vec![DVec3::ZERO, DVec3::X, 2.0 * DVec3::X, DVec3::Y], &[[0, 1, 2]]).unwrap();
    let field = ScalarField::new(vec![1.0, 2.0, 3.0, 9.0]).unwrap();
    let blurred = field.blurred(&flat, 0.1).unwrap();
    assert!(blurred.values()[3] == 9.0 && blurred.values().iter().all(|v| v.is_finite()));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    /// Slivers of any height: what a value is stays within what there was, and the sum stays.
    #[test]
    fn any_triangles_keep_sum_and_range(squeeze in -9.0..0.0_f64, radius in 0.001..10.0_f64, values in prop::collection::vec(-1.0..1.0_f32, 81)) {
        let sheet = plane(1.0, 1.0, 8, 8).unwrap();
        let narrow = |p: &DVec3| DVec3::new(if (8.0 * p.x).round() as i64 % 2 == 0 { p.x } else { (p.x * 4.0).floor() / 4.0 + 10_f64.powf(squeeze) }, p.y, p.z);
        let sheet = sheet.with_positions(sheet.positions().iter().map(narrow).collect()).unwrap();
        let field = ScalarField::new(values).unwrap();
        let blurred = field.blurred(&sheet, radius).unwrap();
        let (least, most) = field.values().iter().fold((1.0_f32, -1.0_f32), |(a, b), &v| (a.min(v), b.max(v)));
        prop_assert!(blurred.values().iter().all(|v| (least..=most).contains(v)));
        prop_assert!((integral(&sheet, &field) - integral(&sheet, &blurred)).abs() < 1e-5);
    }
}
