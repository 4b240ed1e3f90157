//! Light from all around: what is projected from a picture, against integrals known in closed form and by quadrature.
#![allow(clippy::expect_used, clippy::unwrap_used, reason = "a test may panic")]

use std::f64::consts::PI;

use glam::DVec3;
use pelage_lighting::{Environment, EnvironmentError, Irradiance};
use proptest::prelude::*;

/// The unit direction of an azimuth and an elevation in degrees, as the lights of a graph have it.
fn toward(azimuth: f64, elevation: f64) -> DVec3 {
    let (a, e) = (azimuth.to_radians(), elevation.to_radians());
    DVec3::new(e.cos() * a.sin(), e.sin(), e.cos() * a.cos())
}

/// Directions all around.
fn normals() -> impl Iterator<Item = DVec3> {
    (-9..=9).flat_map(|e| (0..24).map(move |a| toward(f64::from(a) * 15.0, f64::from(e) * 10.0)))
}

fn environment(width: usize, height: usize, radiance: impl Fn(usize, usize) -> [f32; 3]) -> Environment {
    let texels = (0..width * height).map(|at| radiance(at % width, at / width)).collect();
    Environment::new(width, height, texels).expect("a legal picture")
}

fn apart(a: DVec3, b: DVec3) -> f64 {
    (a - b).abs().max_element()
}

#[test]
fn uniform_light_is_one_for_every_normal_whatever_the_picture_size() {
    for (width, height) in [(1, 1), (1, 2), (2, 1), (3, 5), (64, 32), (257, 100)] {
        let light = environment(width, height, |_, _| [1.0; 3]).irradiance();
        for normal in normals() {
            assert!(apart(light.at(normal), DVec3::ONE) < 1e-12, "{width} × {height}: {}", light.at(normal));
        }
    }
}

#[test]
fn a_sky_and_a_ground_are_the_hemisphere_which_is_the_exact_cosine_integral() {
    let (sky, ground) = ([0.5, 0.75, 1.0], [0.25, 0.125, 0.0]);
    let around = environment(6, 4, |_, row| if row < 2 { sky } else { ground });
    let hemisphere = Irradiance::hemisphere(DVec3::from(sky.map(f64::from)), DVec3::from(ground.map(f64::from)));
    let light = around.irradiance();
    for normal in normals() {
        assert!(apart(light.at(normal), hemisphere.at(normal)) < 1e-14);
        // Of a half-space above it, a plane that leans sees (1 + cos) / 2.
        assert!(apart(around.irradiance_in_full(normal), hemisphere.at(normal)) < 1e-4, "{normal}");
    }
}

#[test]
fn one_bright_texel_lights_what_faces_it_by_the_cosine_to_order_two() {
    let (width, height) = (360, 180);
    for (azimuth, elevation) in [(0.5, 0.5), (90.5, 20.5), (-60.5, -45.5), (179.5, 60.5), (-179.5, 10.5)] {
        let (column, row) = ((180.0 - azimuth) as usize, (90.0 - elevation) as usize);
        let texel = |c, r| if (c, r) == (column, row) { [1e4; 3] } else { [0.0; 3] };
        let around = environment(width, height, texel);
        let (light, sun) = (around.irradiance(), toward(azimuth, elevation));
        // One square degree, as seen from within.
        let whole = 1e4 / PI * (1_f64.to_radians() * ((elevation + 0.5).to_radians().sin() - (elevation - 0.5).to_radians().sin()));
        for normal in normals().chain([sun]) {
            let cosine = sun.dot(normal);
            let order_two = (3.0 / 32.0 + cosine / 2.0 + 15.0 / 32.0 * cosine * cosine).max(0.0);
            assert!((light.at(normal).x / whole - order_two).abs() < 1e-4, "{azimuth} {elevation}: {normal}");
            assert!((around.irradiance_in_full(normal).x / whole - cosine.max(0.0)).abs() < 5e-3);
            assert!(light.at(normal).x <= light.at(sun).x);
            // What the orders left out make, as the documentation says it.
            assert!((order_two - cosine.max(0.0)).abs() <= 3.0 / 32.0 + 1e-12);
        }
    }
}

#[test]
fn turning_is_moving_the_columns() {
    let picture = |shift: usize| {
        environment(24, 12, move |column, row| {
            let (c, r) = (((column + shift) % 24) as f32, row as f32);
            [(c * 0.7 + r).sin().abs(), (c * c * 0.1).cos().abs() * r, f32::from((c as u8).is_multiple_of(5))]
        })
    };
    let still = picture(0).irradiance();
    for shift in 0..24 {
        // Columns run clockwise: what moves to the left moves anticlockwise.
        let (moved, turned) = (picture(shift).irradiance(), still.turned((15.0 * shift as f64).to_radians()));
        for normal in normals() {
            assert!(apart(moved.at(normal), turned.at(normal)) < 1e-12, "{shift}: {normal}");
        }
    }
}

#[test]
fn what_is_no_picture_is_refused_and_said() {
    assert_eq!(Environment::new(0, 0, Vec::new()), Err(EnvironmentError::Empty { width: 0, height: 0 }));
    assert_eq!(Environment::new(3, 0, Vec::new()), Err(EnvironmentError::Empty { width: 3, height: 0 }));
    assert_eq!(Environment::new(2, 2, vec![[1.0; 3]]), Err(EnvironmentError::Length { width: 2, height: 2, found: 1 }));
    let most = usize::MAX;
    assert_eq!(Environment::new(most, most, vec![[1.0; 3]]), Err(EnvironmentError::Length { width: most, height: most, found: 1 }));
    for bad in [f32::NAN, f32::INFINITY, -1e-3] {
        let mut texels = vec![[1.0; 3]; 6];
        texels[5][1] = bad;
        let error = Environment::new(3, 2, texels).unwrap_err();
        assert!(matches!(error, EnvironmentError::Radiance { column: 2, row: 1, .. }), "{error}");
        assert!(error.to_string().contains("(2, 1)"), "{error}");
    }
}

#[test]
fn the_brightest_picture_gives_finite_light() {
    let light = environment(8, 2, |column, _| if column == 0 { [f32::MAX; 3] } else { [0.0; 3] }).irradiance();
    for normal in normals().chain([DVec3::splat(f64::NAN), DVec3::splat(1e300), DVec3::ZERO, DVec3::splat(f64::INFINITY)]) {
        let at = light.at(normal);
        assert!(at.is_finite() && at.cmpge(DVec3::ZERO).all(), "{normal}: {at}");
    }
    assert_eq!(light.at(DVec3::NAN), light.0[0]);
}

proptest! {
    #[test]
    fn irradiance_of_any_picture_is_near_the_full_integral(texels in prop::collection::vec(0.0..1.0_f32, 32), a in -180.0..180.0_f64, e in -90.0..90.0_f64) {
        let around = environment(8, 4, |column, row| [texels[row * 8 + column]; 3]);
        let (to_order_two, full) = (around.irradiance().at(toward(a, e)).x, around.irradiance_in_full(toward(a, e)).x);
        // Order 4 is the next that the cosine has, and a twenty-fourth of the mean.
        prop_assert!((to_order_two - full).abs() < 0.05, "{to_order_two} {full}");
    }

    #[test]
    fn lights_add_and_scale_as_their_pictures_do(s in 0.0..5.0_f32, a in -180.0..180.0_f64, e in -90.0..90.0_f64) {
        let (one, other) = (|c: usize, r: usize| (c * r) as f32, |c: usize, r: usize| (c + 3 * r) as f32);
        let of = |radiance: &dyn Fn(usize, usize) -> f32| environment(5, 3, |c, r| [radiance(c, r); 3]).irradiance();
        let expected = of(&|c, r| s * one(c, r) + other(c, r));
        prop_assert!(apart((of(&one) * f64::from(s) + of(&other)).at(toward(a, e)), expected.at(toward(a, e))) < 1e-5);
    }
}
