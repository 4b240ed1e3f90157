//! Painted strokes.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it measured")]

use glam::DVec3;
use pelage_field::{FieldError, ScalarField, Stroke};
use pelage_mesh::{Mesh, join, plane, sphere};
use proptest::prelude::*;

fn stroke(points: &[DVec3], radius: f64) -> Stroke {
    Stroke { points: points.to_vec(), radius, softness: 0.5, value: 1.0 }
}

/// How far a place is from a line, in space.
fn to_line(p: DVec3, from: DVec3, to: DVec3) -> f64 {
    let along = to - from;
    (from + along * ((p - from).dot(along) / along.length_squared()).clamp(0.0, 1.0)).distance(p)
}

#[test]
fn on_a_plane_the_profile_is_that_of_the_distance_to_the_line() {
    let sheet = plane(1.0, 1.0, 80, 80).unwrap();
    let diameter = sheet.diameter();
    let (from, to) = (DVec3::new(-0.3, 0.0, -0.2), DVec3::new(0.25, 0.0, 0.3));
    let painted = Stroke { value: 3.0, ..stroke(&[from, to], 0.1) };
    let field = ScalarField::strokes(&sheet, std::slice::from_ref(&painted), -1.0).unwrap();
    let mut most = 0.0_f64;
    for (p, &value) in sheet.positions().iter().zip(field.values()) {
        let distance = to_line(*p, from, to) / diameter;
        let t = ((0.1 - distance) / 0.05).clamp(0.0, 1.0);
        let expected = -1.0 + 4.0 * t * t * (3.0 - 2.0 * t);
        most = most.max((f64::from(value) - expected).abs());
    }
    println!("reached: within {most:.3} of 4 on a plane");
    assert!(most < 0.05, "{most}");
    let distances = ScalarField::distance_to_strokes(&sheet, &[painted]).unwrap();
    let apart = |(p, &d): (&DVec3, &f32)| (f64::from(d) - to_line(*p, from, to) / diameter).abs();
    let most = sheet.positions().iter().zip(distances.values()).map(apart).fold(0.0, f64::max);
    // Half the way between two beads.
    assert!(most <= 0.1 / 16.0 + 1e-9, "{most}");
}

#[test]
fn on_a_ball_distance_is_that_of_great_circles() {
    let ball = sphere(1.0, 40).unwrap();
    let diameter = ball.diameter();
    let field = ScalarField::distance_to_strokes(&ball, &[stroke(&[DVec3::Y], 0.05)]).unwrap();
    for (p, &d) in ball.positions().iter().zip(field.values()) {
        let expected = p.normalize().dot(DVec3::Y).clamp(-1.0, 1.0).acos() / diameter;
        assert!((f64::from(d) - expected).abs() < 0.006, "{d} for {expected}");
    }
}

/// Two sheets closer together than the brush is wide: paint on one is not on the other, and the other piece is far.
#[test]
fn paint_does_not_pass_through_the_air() {
    let sheet = plane(1.0, 1.0, 20, 20).unwrap();
    let above = sheet.with_positions(sheet.positions().iter().map(|&p| p + 0.02 * DVec3::Y).collect()).unwrap();
    let both = join(&sheet, &above).unwrap();
    let painted = [stroke(&[DVec3::ZERO], 0.2)];
    let (values, distances) =
        (ScalarField::strokes(&both, &painted, 0.0).unwrap(), ScalarField::distance_to_strokes(&both, &painted).unwrap());
    let count = sheet.positions().len();
    assert!(values.values()[..count].contains(&1.0) && values.values()[count..].iter().all(|&v| v == 0.0));
    assert!(distances.values()[count..].iter().all(|&d| d == 10.0));
}

#[test]
fn later_strokes_are_painted_over_earlier_ones() {
    let sheet = plane(1.0, 1.0, 40, 40).unwrap();
    let line = [DVec3::new(-0.4, 0.0, 0.0), DVec3::new(0.4, 0.0, 0.0)];
    let across = [DVec3::new(0.0, 0.0, -0.4), DVec3::new(0.0, 0.0, 0.4)];
    let strokes =
        [Stroke { value: 2.0, softness: 0.0, ..stroke(&line, 0.05) }, Stroke { value: 5.0, softness: 0.0, ..stroke(&across, 0.05) }];
    let at = |field: &ScalarField, place: DVec3| field.values()[sheet.positions().iter().position(|p| p.distance(place) < 1e-9).unwrap()];
    let field = ScalarField::strokes(&sheet, &strokes, 0.0).unwrap();
    assert_eq!([DVec3::ZERO, 0.3 * DVec3::X, 0.3 * DVec3::Z, DVec3::new(0.3, 0.0, 0.3)].map(|p| at(&field, p)), [5.0, 2.0, 5.0, 0.0]);
    let turned = ScalarField::strokes(&sheet, &[strokes[1].clone(), strokes[0].clone()], 0.0).unwrap();
    assert_eq!(at(&turned, DVec3::ZERO), 2.0);
    assert_eq!(ScalarField::strokes(&sheet, &[], 7.0).unwrap(), ScalarField::constant(&sheet, 7.0).unwrap());
}

/// A coarse and a dense ball have the same paint where they have a vertex.
#[test]
fn paint_is_the_same_whatever_the_triangles() {
    let (coarse, dense) = (sphere(1.0, 12).unwrap(), sphere(1.0, 48).unwrap());
    let painted = [stroke(&[DVec3::X, DVec3::new(0.8, 0.6, 0.0), DVec3::Y], 0.15)];
    let [few, many] = [&coarse, &dense].map(|mesh| ScalarField::strokes(mesh, &painted, 0.0).unwrap());
    let mut most = 0.0_f32;
    for (vertex, p) in coarse.positions().iter().enumerate() {
        let twin = dense.positions().iter().position(|q| q.distance(*p) < 1e-9).unwrap();
        most = most.max((few.values()[vertex] - many.values()[twin]).abs());
    }
    println!("reached: within {most:.3} of each other");
    assert!(most < 0.08, "{most}");
}

#[test]
fn a_stroke_that_cannot_be_painted_is_named() {
    let ball = sphere(1.0, 20).unwrap();
    let good = stroke(&[DVec3::X], 0.1);
    let fail = |bad: Stroke| {
        let strokes = [good.clone(), bad];
        let (one, other) = (ScalarField::strokes(&ball, &strokes, 0.0).unwrap_err(), ScalarField::distance_to_strokes(&ball, &strokes));
        assert!(one.to_string().starts_with("stroke 1"), "{one}");
        assert!(other.is_err() || matches!(one, FieldError::StrokeBetweenVertices { .. }), "{one}");
        one
    };
    assert!(matches!(fail(stroke(&[], 0.1)), FieldError::EmptyStroke { .. }));
    assert!(matches!(fail(stroke(&[DVec3::X, DVec3::splat(f64::NAN)], 0.1)), FieldError::StrokePlace { point: 1, .. }));
    assert!(matches!(fail(stroke(&[2.0 * DVec3::X], 0.1)), FieldError::StrokeOffSurface { point: 0, .. }));
    assert!(matches!(fail(stroke(&[DVec3::ZERO], 0.1)), FieldError::StrokeOffSurface { point: 0, .. }));
    // From one side to the other it would go through the inside.
    assert!(matches!(fail(stroke(&[DVec3::X, DVec3::Y, DVec3::NEG_Y], 0.1)), FieldError::StrokeLeavesSurface { point: 0 | 1, .. }));
    for radius in [0.0, -1.0, f64::NAN, 11.0, f64::INFINITY] {
        assert!(matches!(fail(stroke(&[DVec3::X], radius)), FieldError::StrokeSetting { parameter: "radius", .. }));
    }
    for softness in [-0.1, 1.1, f64::NAN] {
        assert!(matches!(fail(Stroke { softness, ..good.clone() }), FieldError::StrokeSetting { parameter: "softness", .. }));
    }
    assert!(matches!(fail(Stroke { value: f32::NAN, ..good.clone() }), FieldError::StrokeSetting { parameter: "value", .. }));
    let centre = ball.faces().next().unwrap().centre();
    assert!(matches!(fail(stroke(&[centre], 0.001)), FieldError::StrokeBetweenVertices { .. }));
    let endless = stroke(&[DVec3::X, DVec3::new(0.999, 0.0, 0.01)].repeat(100_000), 0.001);
    assert!(matches!(fail(endless), FieldError::StrokeTooLong { .. }));
    let nothing = Mesh::from_triangles(vec![DVec3::X], &[]).unwrap();
    assert_eq!(ScalarField::strokes(&nothing, &[good], 0.0), Err(FieldError::NoSurface));
}

/// A little off the surface is on it.
#[test]
fn a_place_off_the_surface_by_less_than_the_radius_is_brought_to_it() {
    let ball = sphere(1.0, 20).unwrap();
    let [on, off] = [1.0, 1.2].map(|far| ScalarField::strokes(&ball, &[stroke(&[far * DVec3::Y], 0.1)], 0.0).unwrap());
    assert!(on == off);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn values_lie_between_background_and_stroke(turn in prop::collection::vec(-3.0..3.0_f64, 4), radius in 0.05..0.4_f64, softness in 0.0..=1.0_f64, value in -5.0..5.0_f32) {
        let ball = sphere(1.0, 10).unwrap();
        let points: Vec<DVec3> = turn.iter().map(|t| DVec3::new(t.cos(), 0.3 * (2.0 * t).sin(), t.sin()).normalize()).collect();
        // Far apart, a stroke may be refused; else it paints.
        if let Ok(field) = ScalarField::strokes(&ball, &[Stroke { points, radius, softness, value }], 1.0) {
            let (least, most) = (value.min(1.0), value.max(1.0));
            prop_assert!(field.values().iter().all(|v| (least..=most).contains(v)));
            prop_assert!(field.values().iter().any(|&v| (v - value).abs() < 1.0 || softness > 0.5));
        }
    }
}
