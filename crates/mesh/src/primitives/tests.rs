use std::f64::consts::{PI, TAU};

use super::*;
use crate::Summary;

fn close(a: f64, b: f64, relative: f64) {
    assert!((a - b).abs() <= relative * b.abs(), "{a} is not within {relative} of {b}");
}

fn all_outwards(mesh: &Mesh, outward: impl Fn(DVec3) -> DVec3) {
    for face in mesh.faces() {
        let cosine = face.normal().dot(outward(face.centre()).normalize());
        assert!(cosine > 0.5, "face {face:?} looks inwards: {cosine}");
    }
}

#[test]
fn plane_is_flat_and_faces_up() {
    let mesh = plane(3.0, 2.0, 6, 5).unwrap();
    let summary = Summary::of(&mesh);
    assert_eq!((summary.vertices, summary.faces, summary.boundary_loops, summary.euler_characteristic), (42, 60, 1, 1));
    close(summary.area, 6.0, 1e-12);
    close(summary.diameter, 13_f64.sqrt(), 1e-12);
    assert!(mesh.faces().all(|face| face.normal().distance(DVec3::Y) < 1e-12));
    for (h, uv) in mesh.half_edges().zip(mesh.texture_coordinates().unwrap()) {
        let p = h.origin().position();
        assert!(DVec2::new(p.x / 3.0 + 0.5, 0.5 - p.z / 2.0).distance(*uv) < 1e-12);
    }
}

#[test]
fn sphere_is_closed_and_even() {
    for subdivisions in [1, 2, 3, 4, 5, 8, 17, 40] {
        let mesh = sphere(2.0, subdivisions).unwrap();
        let (summary, n) = (Summary::of(&mesh), subdivisions as usize);
        assert_eq!((summary.vertices, summary.faces, summary.unreferenced_vertices), (10 * n * n + 2, 20 * n * n, 0));
        assert_eq!((summary.euler_characteristic, summary.genus, summary.boundary_loops, summary.components), (2, 0, 0, 1));
        assert!(mesh.positions().iter().all(|p| (p.length() - 2.0).abs() < 1e-12));
        all_outwards(&mesh, |p| p);
        let areas = mesh.faces().map(crate::Face::area);
        let (least, most) = areas.fold((f64::INFINITY, 0.0_f64), |(least, most), area| (least.min(area), most.max(area)));
        assert!(most / least < 1.35, "areas differ by {}", most / least);
        if subdivisions == 40 {
            close(summary.area, 4.0 * PI * 4.0, 1e-3);
            close(summary.signed_volume, 4.0 / 3.0 * PI * 8.0, 2e-3);
        }
    }
}

#[test]
fn torus_is_closed_and_has_the_right_area() {
    let mesh = torus(2.0, 0.5, 240, 120).unwrap();
    let summary = Summary::of(&mesh);
    assert_eq!((summary.euler_characteristic, summary.genus, summary.boundary_loops), (0, 1, 0));
    close(summary.area, TAU * 2.0 * TAU * 0.5, 1e-3);
    close(summary.signed_volume, TAU * 2.0 * PI * 0.25, 1e-3);
    all_outwards(&mesh, |p| p - DVec3::new(p.x, 0.0, p.z).normalize() * 2.0);
    assert_eq!(Summary::of(&torus(2.0, 0.5, 3, 3).unwrap()).genus, 1);
    // The seam: a corner at u = 1 sits on the vertex of u = 0.
    let most = mesh.texture_coordinates().unwrap().iter().fold(0.0_f64, |most, uv| most.max(uv.x));
    close(most, 1.0, 0.0);
}

#[test]
fn die_goes_from_cube_to_sphere() {
    for segments in [3, 4, 5, 11, 24] {
        for rounding in [0.0, 1e-6, 0.1, 0.3, 0.75, 0.999, 1.0] {
            let mesh = rounded_die(2.0, rounding, segments).unwrap();
            let (summary, n) = (Summary::of(&mesh), segments as usize);
            assert_eq!((summary.vertices, summary.faces, summary.unreferenced_vertices), (6 * n * n + 2, 12 * n * n, 0));
            assert_eq!((summary.euler_characteristic, summary.components, summary.faces_without_area), (2, 1, 0));
            all_outwards(&mesh, |p| p);
            for p in mesh.positions() {
                let core = p.clamp(DVec3::splat(rounding - 1.0), DVec3::splat(1.0 - rounding));
                let distance = if rounding == 0.0 { p.abs().max_element() - 1.0 } else { p.distance(core) - rounding };
                assert!(distance.abs() < 1e-12, "{p} is {distance} off the die with rounding {rounding}");
            }
        }
    }
    close(rounded_die(2.0, 0.0, 7).unwrap().area(), 24.0, 1e-12);
    let (r, core) = (0.25, 1.5);
    let area = 6.0 * core * core + 12.0 * core * r * 0.5 * PI + 4.0 * PI * r * r;
    close(rounded_die(2.0, 0.25, 80).unwrap().area(), area, 1e-3);
}

#[test]
fn impossible_parameters_are_refused() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e300] {
        assert!(matches!(sphere(bad, 4), Err(PrimitiveError::Length { parameter: "radius", .. })));
        assert!(matches!(plane(1.0, bad, 4, 4), Err(PrimitiveError::Length { parameter: "depth", .. })));
        assert!(matches!(torus(bad, 1.0, 4, 4), Err(PrimitiveError::Length { parameter: "major", .. })));
    }
    assert!(matches!(torus(1.0, 1.0, 4, 4), Err(PrimitiveError::TorusCutsItself { .. })));
    assert!(matches!(rounded_die(1.0, 1.1, 4), Err(PrimitiveError::Fraction { .. })));
    assert!(matches!(rounded_die(1.0, f64::NAN, 4), Err(PrimitiveError::Fraction { .. })));
    assert!(matches!(rounded_die(1.0, 0.5, 2), Err(PrimitiveError::TooFewSegments { least: 3, .. })));
    assert!(matches!(sphere(1.0, 0), Err(PrimitiveError::TooFewSegments { least: 1, .. })));
    for most in [u32::MAX, 100_000] {
        assert!(matches!(sphere(1.0, most), Err(PrimitiveError::TooManyFaces { .. })));
        assert!(matches!(rounded_die(1.0, 0.5, most), Err(PrimitiveError::TooManyFaces { .. })));
        assert!(matches!(plane(1.0, 1.0, most, most), Err(PrimitiveError::TooManyFaces { .. })));
    }
}

#[test]
fn figures_hold_at_any_scale() {
    for scale in [1e-30, 1e-15, 1.0, 1e15, 1e30] {
        for mesh in [sphere(scale, 6).unwrap(), torus(2.0 * scale, scale, 12, 9).unwrap(), rounded_die(scale, 0.3, 6).unwrap()] {
            let summary = Summary::of(&mesh);
            assert_eq!(summary.faces_without_area, 0);
            assert!(summary.area > 0.1 * scale * scale && summary.area < 1e3 * scale * scale);
            assert!(summary.signed_volume > 0.1 * scale.powi(3));
            assert!(mesh.vertex_normals().iter().all(|n| (n.length() - 1.0).abs() < 1e-12));
        }
    }
    let (unit, ours) = (sphere(1.0, 6).unwrap(), sphere(1e-30, 6).unwrap());
    for (a, b) in unit.vertex_normals().iter().zip(ours.vertex_normals()) {
        assert!(a.distance(b) < 1e-12);
    }
}
