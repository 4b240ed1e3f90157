//! What a camera sees lies where it should.
#![allow(clippy::print_stdout, reason = "a test says what it measured")]

use glam::{Vec3, Vec4, Vec4Swizzles};
use pelage_coat::Camera;
use proptest::prelude::*;

fn project(camera: &Camera, aspect: f32, point: Vec3) -> Vec3 {
    let clip: Vec4 = camera.view_projection(aspect) * point.extend(1.0);
    clip.xyz() / clip.w
}

#[test]
fn depth_runs_from_one_at_the_near_plane_to_zero_far_away() {
    let camera = Camera { eye: Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, field_of_view: 1.0, near: 0.25 };
    assert!((project(&camera, 1.5, 0.75 * Vec3::Z).z - 1.0).abs() < 1e-6);
    assert!(project(&camera, 1.5, -1e6 * Vec3::Z).z.abs() < 1e-6);
}

/// From how far behind a place another is told apart by its depth in `f32`, as a part of the distance from the eye.
fn least_gap(near: f32, distance: f32, depth: impl Fn(f32, f32) -> f32) -> f32 {
    let apart = |gap: &f32| depth(near, distance * (1.0 + gap)) != depth(near, distance);
    (0..26).map(|k| 2.0_f32.powi(k - 24)).find(apart).unwrap_or(f32::INFINITY)
}

/// With the nearest of near planes, at any distance: a step of `f32` behind, where depth from 0 at the near plane to 1 far away tells nothing apart.
#[test]
fn reversed_depth_tells_apart_at_any_distance() {
    // As the projection has it, w being the distance.
    let camera = |near: f32| Camera { eye: Vec3::ZERO, target: -Vec3::Z, up: Vec3::Y, field_of_view: 1.0, near };
    let reversed = |near: f32, distance: f32| project(&camera(near), 1.0, -distance * Vec3::Z).z;
    let forward = |near: f32, distance: f32| 1.0 - near / distance;
    let mut most = 0.0_f32;
    for near in [1e-4, 1e-2, 10.0] {
        for distance in [1.01, 1.7, 10.0, 1e3, 1e6].map(|times| near * times) {
            most = most.max(least_gap(near, distance, reversed));
        }
    }
    let forward_at_one = least_gap(1e-4, 1.0, forward);
    println!("reached: told apart {most:.0e} of the distance behind each other; {forward_at_one:.0e} with depth from 0 to 1");
    assert!(most < 5e-7 && forward_at_one > 1e-4, "{most} {forward_at_one}");
}

#[test]
fn up_is_up_and_right_is_right() {
    let camera = Camera::framing(Vec3::ZERO, 0.5, 0.0, 0.0, 0.6, 1.0, 1.0);
    assert!(project(&camera, 1.0, 0.1 * Vec3::Y).y > 0.0);
    assert!(project(&camera, 1.0, 0.1 * Vec3::X).x > 0.0);
    assert!((camera.toward_eye() - Vec3::Z).length() < 1e-6);
}

#[test]
fn azimuth_grows_anticlockwise_seen_from_above() {
    let camera = Camera::framing(Vec3::ZERO, 0.5, std::f32::consts::FRAC_PI_2, 0.0, 0.6, 1.0, 1.0);
    assert!((camera.toward_eye() - Vec3::X).length() < 1e-6);
}

proptest! {
    #[test]
    fn framing_shows_the_whole_ball(
        azimuth in -7.0..7.0_f32, elevation in -1.57..1.57_f32, field_of_view in 0.1..2.0_f32, aspect in 0.3..3.0_f32,
        a in 0.0..6.3_f32, b in -1.5..1.5_f32,
    ) {
        let (centre, radius) = (Vec3::new(0.3, -0.2, 0.1), 0.4);
        let camera = Camera::framing(centre, radius, azimuth, elevation, field_of_view, aspect, 1.0);
        let on_ball = centre + radius * Vec3::new(a.cos() * b.cos(), b.sin(), a.sin() * b.cos());
        let seen = project(&camera, aspect, on_ball);
        prop_assert!(seen.is_finite());
        prop_assert!(seen.x.abs() <= 1.001 && seen.y.abs() <= 1.001 && (0.0..=1.0).contains(&seen.z), "{}", seen);
    }

    #[test]
    fn straight_up_and_down_are_no_special_case(azimuth in -7.0..7.0_f32, down in any::<bool>()) {
        let elevation = if down { -1.0 } else { 1.0 } * std::f32::consts::FRAC_PI_2;
        let camera = Camera::framing(Vec3::ZERO, 0.5, azimuth, elevation, 0.6, 1.3, 1.1);
        prop_assert!(camera.view_projection(1.3).is_finite());
        let before = Camera::framing(Vec3::ZERO, 0.5, azimuth, elevation * 0.99, 0.6, 1.3, 1.1);
        let (top, top_before) = (project(&camera, 1.3, Vec3::new(0.2, 0.0, 0.1)), project(&before, 1.3, Vec3::new(0.2, 0.0, 0.1)));
        prop_assert!((top - top_before).length() < 0.1, "{} {}", top, top_before);
    }
}
