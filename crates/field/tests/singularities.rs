//! Fields whose singularities are known, sampled from their formulas; and sums over surfaces of every genus.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it leaves out")]

mod common;

use common::surfaces::{copies, perforated};
use common::{assert_unit_and_tangent, models};
use glam::{DVec2, DVec3};
use pelage_field::{Constraint, DirectionField, Flow, PointConstraint, Singularity, boundary_turning, singularities};
use pelage_mesh::{Component, FaceId, Mesh, plane, sphere, torus};

/// The power of a complex number, negative ones being powers of the conjugate.
fn power(z: DVec2, exponent: i32) -> DVec2 {
    let base = if exponent < 0 { DVec2::new(z.x, -z.y) } else { z };
    (0..exponent.abs()).fold(DVec2::X, |product, _| product.rotate(base))
}

/// The whole index within `reach` of a place, and how many singularities lie farther.
fn around(mesh: &Mesh, found: &[Singularity], place: DVec3, reach: f64) -> (i32, usize) {
    let (near, far): (Vec<Singularity>, Vec<Singularity>) =
        found.iter().copied().partition(|s| mesh.face(s.face).centre().distance(place) < reach);
    (near.iter().map(|s| s.index).sum(), far.len())
}

/// z, z², z³, their conjugates, about a place inside a face: indices 1 to 3 and −1 to −3. One of 1 lies in that very face; three sides turn at most
/// one and a half times, so that one of 2 or 3 is found as so many faces side by side.
#[test]
fn powers_about_a_place_of_the_plane() {
    let mesh = plane(2.0, 2.0, 21, 21).unwrap();
    for face in [FaceId(200), FaceId(441), FaceId(643)] {
        let place = mesh.face(face).centre();
        for exponent in [-3, -2, -1, 1, 2, 3] {
            for turn in [0.0, 1.0, 2.5] {
                // Seen from above, x and −z are the real and the imaginary axis.
                let at = |p: &DVec3| DVec2::new(p.x - place.x, place.z - p.z);
                let value = |p: &DVec3| DVec2::from_angle(turn).rotate(power(at(p), exponent));
                let vectors: Vec<DVec3> = mesh.positions().iter().map(value).map(|w| DVec3::new(w.x, 0.0, -w.y)).collect();
                let field = DirectionField::from_vectors(&mesh, &vectors).unwrap();
                let found = singularities(&mesh, &field).unwrap();
                let edges = if exponent.abs() == 1 { 0.3 } else { 1.5 };
                let reach = edges * mesh.mean_edge_length();
                assert_eq!(around(&mesh, &found, place, reach), (exponent, 0), "z^{exponent} in {face:?}: {found:?}");
                assert_eq!(boundary_turning(&mesh, &field).unwrap(), [exponent - 1]);
                if exponent.abs() == 1 {
                    assert_eq!(found, [Singularity { face, index: exponent }]);
                }
            }
        }
    }
}

/// The field zᵏ of the plane on the ball by stereographic projection from the top: index k at the bottom and 2 − k at the top.
#[test]
fn powers_on_the_ball() {
    let ball = sphere(1.0, 24).unwrap();
    for exponent in -2..=4 {
        let value = |p: &DVec3| {
            let z = DVec2::new(p.x, -p.z) / (1.0 - p.y);
            // Of the direction's image only the direction counts: that of the projection's derivative, which keeps angles. Seen from
            // outside, from below, it is mirrored.
            let w = power(DVec2::new(z.x, -z.y), exponent);
            let flat = DVec3::new(w.x, 0.0, w.y);
            // The inverse projection's derivative: a reflection in the plane across the line from the top.
            let line = (*p - DVec3::Y).normalize_or_zero();
            flat - 2.0 * line * line.dot(flat)
        };
        let vectors: Vec<DVec3> = ball.positions().iter().map(value).map(|v| if v.is_finite() { v } else { DVec3::ZERO }).collect();
        let field = DirectionField::from_vectors(&ball, &vectors).unwrap();
        let found = singularities(&ball, &field).unwrap();
        let reach = 3.0 * ball.mean_edge_length();
        let (bottom, others) = around(&ball, &found, DVec3::NEG_Y, reach);
        let (top, rest) = around(&ball, &found, DVec3::Y, reach);
        assert_eq!((bottom, top), (exponent, 2 - exponent), "z^{exponent}: {found:?}");
        assert_eq!(others + rest, found.len(), "none lies elsewhere: {found:?}");
    }
}

/// Of each component by itself: its indices add up to χ, which is 2 − 2g where it is closed, and with boundary to χ and its boundary's turning.
fn assert_sums(name: &str, mesh: &Mesh, field: &DirectionField) {
    let components = mesh.components();
    let mut sums = vec![0_i64; components.count()];
    for singularity in singularities(mesh, field).unwrap() {
        sums[components.index_of(singularity.face)] += i64::from(singularity.index);
    }
    for (walk, turns) in mesh.boundary_loops().iter().zip(boundary_turning(mesh, field).unwrap()) {
        sums[components.index_of(walk.first().face().id())] -= i64::from(turns);
    }
    let characteristics: Vec<i64> = components.iter().map(Component::euler_characteristic).collect();
    assert_eq!(sums, characteristics, "{name}");
}

#[test]
fn each_component_has_its_own_sum() {
    let mut surfaces = models();
    let handles = perforated(19, 7, 1);
    assert_eq!(handles.topology().euler_characteristic(), 2 - 2 * 133);
    let three = perforated(3, 1, 3);
    assert_eq!(three.topology().euler_characteristic(), 2 - 2 * 3);
    let open = Mesh::from_triangles(three.positions().to_vec(), &three.topology().triangles().skip(40).collect::<Vec<_>>()).unwrap();
    surfaces.push(("genus 3, torn".into(), open));
    let four = perforated(2, 2, 3);
    assert_eq!(four.topology().euler_characteristic(), 2 - 2 * 4);
    surfaces.push(("genus 3".into(), three));
    surfaces.push(("genus 4".into(), four));
    surfaces.push(("genus 133".into(), handles));
    surfaces.push(("three tori".into(), copies(&torus(1.0, 0.3, 20, 12).unwrap(), 3, 3.0 * DVec3::X)));
    surfaces.push(("5,000 balls".into(), copies(&sphere(1.0, 1).unwrap(), 5000, 3.0 * DVec3::X)));
    let (mut pieces, mut singular) = (0, 0);
    for (name, mesh) in surfaces {
        let combed = DirectionField::toward(&mesh, DVec3::new(0.3, -1.0, 0.2)).unwrap();
        assert_unit_and_tangent(&name, &mesh, &combed);
        assert_sums(&name, &mesh, &combed);
        pieces += mesh.components().count();
        singular += singularities(&mesh, &combed).unwrap().len();
        let middle = mesh.face(FaceId::from_index(mesh.topology().face_count() / 2)).centre();
        let vectors = [Constraint { at: mesh.positions()[0], along: DVec3::X }, Constraint { at: middle, along: DVec3::NEG_X }];
        let points = [PointConstraint { at: mesh.face(FaceId(0)).centre(), flow: Flow::Turned(1.0) }];
        let spread = DirectionField::from_constraints(&mesh, &vectors, &points, 0.1).unwrap();
        assert_unit_and_tangent(&name, &mesh, &spread);
        assert_sums(&name, &mesh, &spread);
    }
    println!("reached: exact on {pieces} components, {singular} singularities of one direction among them");
}

#[test]
fn vectors_from_elsewhere_are_checked() {
    let ball = sphere(1.0, 3).unwrap();
    let count = ball.positions().len();
    use pelage_field::FieldError::{Length, NoSurface, NotFinite};
    assert_eq!(DirectionField::from_vectors(&ball, &[DVec3::X]), Err(Length { values: 1, expected: count }));
    let mut vectors = vec![DVec3::X; count];
    vectors[7] = DVec3::NAN;
    assert_eq!(DirectionField::from_vectors(&ball, &vectors), Err(NotFinite { vertex: 7 }));
    assert_eq!(DirectionField::from_vectors(&Mesh::from_triangles(vec![], &[]).unwrap(), &[]), Err(NoSurface));
    // One direction everywhere, whatever the lengths, is the field of that direction.
    let longer: Vec<DVec3> = (0..count).map(|k| DVec3::new(0.0, 1e-200 * (k + 1) as f64, 0.0)).collect();
    let (from, toward) = (DirectionField::from_vectors(&ball, &longer).unwrap(), DirectionField::toward(&ball, DVec3::Y).unwrap());
    assert!(from.vectors().iter().zip(toward.vectors()).all(|(a, b)| a.distance(*b) < 1e-9));
    // Nothing said anywhere is finished all the same.
    assert_unit_and_tangent("ball", &ball, &DirectionField::from_vectors(&ball, &vec![DVec3::ZERO; count]).unwrap());
}
