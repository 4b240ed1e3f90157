//! Numbers brought to other ranges, masks, and mixing.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use glam::{Vec3, Vec4};
use pelage_field::{ColourField, Course, FieldError, Image, ScalarField};
use pelage_mesh::{plane, sphere};
use proptest::prelude::*;

fn field(values: &[f32]) -> ScalarField {
    ScalarField::new(values.to_vec()).unwrap()
}

fn remapped(values: &[f32], from: (f64, f64), to: (f64, f64), course: &Course) -> Vec<f32> {
    field(values).remapped(from, to, course).unwrap().values().to_vec()
}

#[test]
fn a_range_goes_to_a_range_and_stays_in_it() {
    assert_eq!(remapped(&[-1.0, 0.0, 1.0, 2.0, 9.0], (0.0, 2.0), (10.0, 20.0), &Course::Straight), [10.0, 10.0, 15.0, 20.0, 20.0]);
    assert_eq!(remapped(&[0.0, 0.5, 2.0], (2.0, 0.0), (0.0, 1.0), &Course::Straight), [1.0, 0.75, 0.0]);
    assert_eq!(remapped(&[0.0, 0.25, 0.5, 1.0], (0.0, 1.0), (0.0, 1.0), &Course::Smooth), [0.0, 0.15625, 0.5, 1.0]);
    let waves = remapped(&[0.0, 0.125, 0.25, 0.5, 0.75, 1.0], (0.0, 1.0), (0.0, 2.0), &Course::Waves(2.0));
    for (value, expected) in waves.iter().zip([0.0, 1.0, 2.0, 0.0, 2.0, 0.0]) {
        assert!((value - expected).abs() < 1e-6, "{waves:?}");
    }
}

#[test]
fn a_curve_goes_through_its_points_and_has_no_hills_between() {
    let curve = Course::Curve(vec![(0.1, 0.0), (0.3, 1.0), (0.6, 1.0), (0.9, 0.2)]);
    let at_points = remapped(&[0.0, 0.1, 0.3, 0.6, 0.9], (0.0, 1.0), (0.0, 1.0), &curve);
    assert!(at_points.iter().zip([0.0, 0.0, 1.0, 1.0, 0.2]).all(|(v, y)| (v - y).abs() < 1e-6), "{at_points:?}");
    let values = remapped(&(0..=100).map(|k| k as f32 / 100.0).collect::<Vec<_>>(), (0.0, 1.0), (0.0, 1.0), &curve);
    assert!(values[10..=30].is_sorted() && values[30..=60].iter().all(|&v| v == 1.0) && values[60..].iter().rev().is_sorted());
    assert!((values[90] - 0.2).abs() < 1e-6 && (values[100] - 0.2).abs() < 1e-6);
    // A peak is no higher than its point.
    let peak = Course::Curve(vec![(0.0, 0.0), (0.3, 1.0), (1.0, 0.2)]);
    let values = remapped(&(0..=100).map(|k| k as f32 / 100.0).collect::<Vec<_>>(), (0.0, 1.0), (0.0, 1.0), &peak);
    assert!(
        values[..=30].is_sorted()
            && values[30..].iter().rev().is_sorted()
            && (values[30] - 1.0).abs() < 1e-6
            && values.iter().all(|v| *v <= 1.0)
    );
    // Points on a line are a line.
    let line = Course::Curve(vec![(0.0, 0.0), (0.2, 0.2), (0.7, 0.7), (1.0, 1.0)]);
    let values = remapped(&[0.05, 0.5, 0.93], (0.0, 1.0), (0.0, 1.0), &line);
    assert!(values.iter().zip([0.05, 0.5, 0.93]).all(|(v, x)| (v - x).abs() < 1e-6), "{values:?}");
}

#[test]
fn a_mask_is_half_at_its_threshold() {
    let mask = |softness| field(&[0.0, 0.4, 0.45, 0.5, 0.55, 0.6, 1.0]).mask(0.5, softness).unwrap().values().to_vec();
    assert_eq!(mask(0.0), [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]);
    let soft = mask(0.2);
    for (value, expected) in soft.iter().zip([0.0, 0.0, 0.15625, 0.5, 0.84375, 1.0, 1.0]) {
        assert!((value - expected).abs() < 1e-5, "{soft:?}");
    }
}

#[test]
fn colours_are_mixed_in_linear_light_and_measured() {
    let (black, white) = (ColourField::new(vec![Vec3::ZERO; 4]).unwrap(), ColourField::new(vec![Vec3::new(1.0, 0.8, 0.6); 4]).unwrap());
    let mixed = black.mixed(&white, &field(&[-1.0, 0.0, 0.25, 7.0])).unwrap();
    assert_eq!(mixed.values(), [Vec3::ZERO, Vec3::ZERO, 0.25 * Vec3::new(1.0, 0.8, 0.6), Vec3::new(1.0, 0.8, 0.6)]);
    assert_eq!(mixed.measured(|c| c.y).unwrap().values(), [0.0, 0.0, 0.2, 0.8]);
    assert!(matches!(black.mixed(&white, &field(&[1.0])), Err(FieldError::Length { values: 1, expected: 4 })));
    let three = field(&[1.0, 2.0]).zip_with(&field(&[10.0, 20.0]), &field(&[100.0, 200.0]), |a, b, c| a + b + c).unwrap();
    assert_eq!(three.values(), [111.0, 222.0]);
    assert!(field(&[1.0, 2.0]).zip_with(&field(&[1.0, 2.0]), &field(&[1.0]), |a, _, _| a).is_err());
}

#[test]
fn a_meshs_own_colours_are_a_field() {
    let ball = sphere(1.0, 2).unwrap();
    assert_eq!(ColourField::of_vertices(&ball), Err(FieldError::NoColours));
    let own: Vec<Vec4> = (0..ball.positions().len()).map(|k| Vec4::new(0.1, 0.01 * k as f32, 0.3, 0.5)).collect();
    let (colours, alpha) = ColourField::of_vertices(&ball.with_colours(own).unwrap()).unwrap();
    assert!(colours.values()[7] == Vec3::new(0.1, 0.07, 0.3) && alpha.values()[7] == 0.5);
}

/// What 16 bits tell apart and 8 do not.
#[test]
fn images_of_16_bits_keep_them() {
    let sheet = plane(1.0, 1.0, 1, 1).unwrap();
    let pixels: Vec<u16> = [0, 0, 0, 32768, 0, 0, 0, 32769].repeat(2);
    let (_, alpha) = ColourField::from_image(&sheet, &Image::rgba16(&pixels, 2, 2).unwrap()).unwrap();
    assert!(alpha.values().iter().all(|&a| (a - 32768.5 / 65535.0).abs() < 1e-7), "{:?}", alpha.values());
    // Numbers that 8 bits have are the same at 16.
    let bytes: Vec<u8> = (0..=255).collect();
    let wide: Vec<u16> = bytes.iter().map(|&b| 257 * u16::from(b)).collect();
    let at = glam::DVec2::new(0.3, 0.7);
    let (eight, sixteen) = (Image::rgba8(&bytes, 8, 8).unwrap().at(at), Image::rgba16(&wide, 8, 8).unwrap().at(at));
    assert!(eight.distance(sixteen) < 1e-7);
}

#[test]
fn what_is_no_range_is_refused() {
    let some = field(&[0.0, 1.0]);
    assert_eq!(some.remapped((1.0, 1.0), (0.0, 1.0), &Course::Straight), Err(FieldError::EmptyRange(1.0)));
    for (from, to) in
        [((f64::NAN, 1.0), (0.0, 1.0)), ((0.0, f64::INFINITY), (0.0, 1.0)), ((0.0, 1.0), (f64::NAN, 1.0)), ((0.0, 1.0), (0.0, 1e300))]
    {
        assert!(matches!(some.remapped(from, to, &Course::Straight), Err(FieldError::Setting { .. })), "{from:?} {to:?}");
    }
    for points in [
        vec![],
        vec![(0.0, 0.0)],
        vec![(0.0, 0.0), (0.0, 1.0)],
        vec![(1.0, 0.0), (0.0, 1.0)],
        vec![(0.0, f64::NAN), (1.0, 1.0)],
        vec![(0.0, 0.0), (f64::NAN, 1.0)],
    ] {
        assert!(
            matches!(some.remapped((0.0, 1.0), (0.0, 1.0), &Course::Curve(points.clone())), Err(FieldError::CurvePoint { .. })),
            "{points:?}"
        );
    }
    for count in [-1.0, f64::NAN, 1001.0] {
        assert!(some.remapped((0.0, 1.0), (0.0, 1.0), &Course::Waves(count)).is_err());
    }
    assert!(some.mask(f64::NAN, 0.1).is_err() && some.mask(0.5, -0.1).is_err() && some.mask(0.5, f64::NAN).is_err());
}

proptest! {
    #[test]
    fn what_comes_out_lies_in_the_range_that_was_asked_for(values in prop::collection::vec(-1e30..1e30_f32, 1..20), from in (-10.0..10.0_f64, -10.0..10.0_f64), to in (-5.0..5.0_f64, -5.0..5.0_f64), waves in 0.0..1000.0_f64) {
        prop_assume!(from.0 != from.1);
        for course in [Course::Straight, Course::Smooth, Course::Waves(waves), Course::Curve(vec![(0.0, 0.0), (0.3, 0.9), (1.0, 1.0)])] {
            let out = field(&values).remapped(from, to, &course).unwrap();
            let (least, most) = (to.0.min(to.1) as f32 - 1e-5, to.0.max(to.1) as f32 + 1e-5);
            prop_assert!(out.values().iter().all(|v| (least..=most).contains(v)), "{:?}", course);
        }
    }
}
