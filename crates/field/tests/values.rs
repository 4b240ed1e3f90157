//! Numbers and colours on a surface.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it measured")]

use glam::{DVec2, DVec3, Vec3};
use pelage_field::{ColourField, FieldError, Image, ScalarField};
use pelage_mesh::{Mesh, plane, sphere, torus};
use proptest::prelude::*;

#[test]
fn a_ramp_follows_the_direction_at_any_scale() {
    let mut most = 0.0_f64;
    for scale in [1e-30, 1.0, 1e30] {
        let ball = sphere(scale, 8).unwrap();
        let ramp = ScalarField::ramp(&ball, DVec3::new(0.0, 5.0, 0.0), 2.0, -1.0).unwrap();
        for (p, &value) in ball.positions().iter().zip(ramp.values()) {
            let expected = 2.0 - 3.0 * (0.5 + 0.5 * p.y / scale);
            assert!((f64::from(value) - expected).abs() < 1e-6);
            most = most.max((f64::from(value) - expected).abs());
        }
    }
    println!("reached: within {most:.0e} of a ramp from 2 to -1");
    let flat = ScalarField::ramp(&plane(1.0, 1.0, 2, 2).unwrap(), DVec3::Y, 3.0, 4.0).unwrap();
    assert!(flat.values().iter().all(|&value| value == 3.0));
}

#[test]
fn arithmetic_is_that_of_the_values() {
    let mesh = sphere(1.0, 3).unwrap();
    let (x, y) = (ScalarField::ramp(&mesh, DVec3::X, 0.0, 1.0).unwrap(), ScalarField::ramp(&mesh, DVec3::Y, 1.0, 3.0).unwrap());
    let at = |field: &ScalarField, k: usize| field.values()[k];
    for k in 0..mesh.positions().len() {
        let (a, b) = (at(&x, k), at(&y, k));
        assert_eq!(at(&x.plus(&y).unwrap(), k), a + b);
        assert_eq!(at(&x.minus(&y).unwrap(), k), a - b);
        assert_eq!(at(&x.times(&y).unwrap(), k), a * b);
        assert_eq!(at(&x.scaled(0.25).unwrap(), k), 0.25 * a);
        assert_eq!(at(&y.clamped(1.5, 2.0), k), b.clamp(1.5, 2.0));
        assert_eq!(at(&x.map(|a| a * a).unwrap(), k), a * a);
    }
    let other = ScalarField::constant(&sphere(1.0, 2).unwrap(), 1.0).unwrap();
    assert!(matches!(x.plus(&other), Err(FieldError::Length { .. })));
    let mut vertex = 0..;
    assert_eq!(x.map(|a| if vertex.next() == Some(5) { 1.0 / 0.0 } else { a }), Err(FieldError::NotFinite { vertex: 5 }));
    assert!(ScalarField::constant(&mesh, f32::NAN).is_err() && y.scaled(f32::MAX).is_err());
    assert!(ScalarField::ramp(&mesh, DVec3::ZERO, 0.0, 1.0).is_err());
}

/// A plane of one cell, whose corner k looks the image up at `places[k]`.
fn looking_at(places: [DVec2; 4]) -> Mesh {
    let mesh = plane(1.0, 1.0, 1, 1).unwrap();
    let coordinates = mesh.half_edges().map(|h| places[h.origin().index()]).collect();
    mesh.with_texture_coordinates(coordinates).unwrap()
}

/// Two pixels by two: black with alpha 0, white, sRGB red 188 (0.5029 in linear light), blue with alpha 51.
const IMAGE: [u8; 16] = [0, 0, 0, 0, 255, 255, 255, 255, 188, 0, 0, 255, 0, 0, 255, 51];

fn image() -> Image<'static> {
    Image::rgba8(&IMAGE, 2, 2).unwrap()
}

#[test]
fn pixels_are_found_at_their_centres_upright_and_wrapped() {
    let centres = [(0.25, 0.75), (0.75, 0.75), (0.25, 0.25), (0.75, 0.25)].map(DVec2::from);
    for shift in [DVec2::ZERO, DVec2::new(-3.0, 5.0), DVec2::splat(1024.0)] {
        let mesh = looking_at(centres.map(|place| place + shift));
        let (colours, alpha) = ColourField::from_image(&mesh, &image()).unwrap();
        let expected = [Vec3::ZERO, Vec3::ONE, Vec3::new(0.502_886, 0.0, 0.0), Vec3::Z];
        for (a, b) in colours.values().iter().zip(expected) {
            assert!(a.distance(b) < 1e-5, "{a} for {b}");
        }
        assert_eq!(alpha.values(), [0.0, 1.0, 1.0, 0.2]);
    }
}

#[test]
fn between_pixels_light_is_mixed_in_linear_space() {
    let places = [(0.5, 0.75), (0.0, 0.75), (0.25, 0.0), (0.5, 0.5)].map(DVec2::from);
    let (colours, alpha) = ColourField::from_image(&looking_at(places), &image()).unwrap();
    let red = 0.502_886;
    let expected = [Vec3::splat(0.5), Vec3::splat(0.5), Vec3::new(0.5 * red, 0.0, 0.0), Vec3::new(1.0 + red, 1.0, 2.0) / 4.0];
    for (a, b) in colours.values().iter().zip(expected) {
        assert!(a.distance(b) < 1e-5, "{a} for {b}");
    }
    assert!((alpha.values()[3] - 0.55).abs() < 1e-6);
}

#[test]
fn corners_at_a_seam_are_averaged() {
    let mesh = plane(1.0, 1.0, 1, 1).unwrap();
    // The first face sees white, the second blue; the two vertices of the diagonal see both.
    let coordinates = (0..6).map(|corner| if corner < 3 { DVec2::new(0.75, 0.75) } else { DVec2::new(0.75, 0.25) }).collect();
    let mesh = mesh.with_texture_coordinates(coordinates).unwrap();
    let (colours, alpha) = ColourField::from_image(&mesh, &image()).unwrap();
    for vertex in mesh.vertices() {
        let faces: Vec<_> = vertex.faces().map(|face| face.id().0).collect();
        let (red, amount) = match faces.as_slice() {
            [0] => (1.0, 1.0),
            [1] => (0.0, 0.2),
            _ => (0.5, 0.6),
        };
        assert!((colours.values()[vertex.index()].x - red).abs() < 1e-6 && (alpha.values()[vertex.index()] - amount).abs() < 1e-6);
    }
}

#[test]
fn images_that_do_not_fit_are_refused() {
    for (bytes, width, height) in [(0, 0, 0), (16, 2, 1), (15, 2, 2), (17, 2, 2), (16, u32::MAX, u32::MAX)] {
        assert!(matches!(Image::rgba8(&vec![0; bytes], width, height), Err(FieldError::ImageSize { .. })));
        assert!(matches!(Image::rgba16(&vec![0; bytes], width, height), Err(FieldError::ImageSize { .. })));
    }
    assert_eq!(ColourField::from_image(&sphere(1.0, 1).unwrap(), &image()), Err(FieldError::NoTextureCoordinates));
    assert!(ColourField::from_image(&torus(1.0, 0.5, 3, 3).unwrap(), &image()).is_ok());
}

#[test]
fn colours_are_made_and_mixed() {
    let ball = sphere(2.0, 4).unwrap();
    let (dark, light) = (Vec3::new(0.1, 0.2, 0.3), Vec3::new(0.9, 0.8, 0.7));
    let ramp = ColourField::ramp(&ball, DVec3::Y, dark, light).unwrap();
    assert!(ramp.values()[0].distance(light) < 1e-6 && ramp.values()[11].distance(dark) < 1e-6);
    let half = ColourField::constant(&ball, light).unwrap().times(&ScalarField::constant(&ball, 0.5).unwrap()).unwrap();
    assert!(half.values().iter().all(|c| c.distance(0.5 * light) < 1e-7));
    assert!(ramp.map(|c| c / 0.0).is_err());
    assert!(ColourField::constant(&ball, Vec3::NAN).is_err());
}

proptest! {
    #[test]
    fn samples_stay_within_the_pixels(bytes in prop::collection::vec(any::<u8>(), 60), u in -1e6..1e6_f64, v in -1e300..1e300_f64) {
        let (colours, alpha) = ColourField::from_image(&looking_at([DVec2::new(u, v); 4]), &Image::rgba8(&bytes, 5, 3).unwrap()).unwrap();
        prop_assert!(colours.values().iter().all(|c| c.min_element() >= 0.0 && c.max_element() <= 1.000_001));
        prop_assert!(alpha.values().iter().all(|a| (0.0..=1.000_001).contains(a)));
    }
}
