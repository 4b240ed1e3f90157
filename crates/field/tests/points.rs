//! Points that the fur lies about: found where they were put, with their index.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it leaves out")]

mod common;

use std::f64::consts::{FRAC_PI_2, PI};

use common::{assert_unit_and_tangent, models};
use glam::DVec3;
use pelage_field::{Constraint, DirectionField, FieldError, Flow, PointConstraint, boundary_turning, singularities};
use pelage_mesh::{FaceId, Mesh, plane, sphere};

/// A source, a sink, a whirl of either sense, a spiral and a saddle.
fn flows(axis: DVec3) -> [(Flow, i32); 6] {
    let turned = [0.0, PI, FRAC_PI_2, -FRAC_PI_2, 0.8].map(|angle| (Flow::Turned(angle), 1));
    let [a, b, c, d, e] = turned;
    [a, b, c, d, e, (Flow::Saddle(axis), -1)]
}

fn about(at: DVec3, flow: Flow) -> PointConstraint {
    PointConstraint { at, flow }
}

fn index_in(mesh: &Mesh, field: &DirectionField, face: FaceId) -> i32 {
    singularities(mesh, field).unwrap().iter().find(|s| s.face == face).map_or(0, |s| s.index)
}

#[test]
fn each_point_holds_its_index_wherever_it_is() {
    for (name, mesh) in models() {
        let (faces, reach) = (mesh.topology().face_count(), 0.1 * mesh.diameter());
        for k in 0..6 {
            let face = FaceId::from_index((k * 7919 + 13) % faces);
            let at = mesh.face(face).centre();
            let (flow, index) = flows(mesh.face(face).half_edges()[0].vector())[k];
            // Each of a tetrahedron's faces has half the curvature that a saddle needs to be the other way, and three sides turn no further.
            if faces == 4 && index < 0 {
                continue;
            }
            let beside = [(DVec3::ONE, DVec3::NEG_Y), (DVec3::NEG_X, DVec3::X)];
            let vectors = beside.map(|(side, along)| Constraint { at: at + reach * side, along });
            let vectors = if k % 2 == 0 { &vectors[..] } else { &[] };
            let field = DirectionField::from_constraints(&mesh, vectors, &[about(at, flow)], 0.2).unwrap();
            assert_unit_and_tangent(&name, &mesh, &field);
            assert_eq!(index_in(&mesh, &field, face), index, "{name}: {flow:?} in {face:?}");
            let sum: i64 = singularities(&mesh, &field).unwrap().iter().map(|s| i64::from(s.index)).sum();
            let turning: i64 = boundary_turning(&mesh, &field).unwrap().iter().map(|&turns| i64::from(turns)).sum();
            assert_eq!(sum, mesh.topology().euler_characteristic() + turning, "{name}");
        }
    }
}

/// Nothing else is needed on a ball: what leaves one place arrives at the opposite one.
#[test]
fn one_point_on_a_ball_has_its_counterpart_opposite() {
    let ball = sphere(2.0, 20).unwrap();
    for at in [DVec3::Y, DVec3::new(0.48, -0.6, 0.64)] {
        for (flow, index) in flows(DVec3::X) {
            let field = DirectionField::from_constraints(&ball, &[], &[about(2.0 * at, flow)], 0.2).unwrap();
            let found = singularities(&ball, &field).unwrap();
            let near = |s: &&pelage_field::Singularity| ball.face(s.face).centre().distance(2.0 * at) < 2.0 * ball.mean_edge_length();
            assert_eq!(found.iter().filter(near).map(|s| s.index).collect::<Vec<_>>(), [index], "{flow:?}");
            let rest: Vec<_> = found.iter().filter(|s| !near(s)).map(|s| (s.index, ball.face(s.face).centre())).collect();
            if index == 1 {
                assert!(rest.len() == 1 && rest[0].0 == 1 && rest[0].1.distance(-2.0 * at) < 0.3, "{flow:?} leaves {rest:?}");
            } else {
                // Against a saddle there is a pole of index 3, which shows as three faces side by side.
                assert!(rest.iter().map(|r| r.0).sum::<i32>() == 3 && rest.iter().all(|r| r.1.dot(at) < 0.0), "{rest:?}");
            }
        }
    }
}

/// Directions against those along great circles, from two edges off the point to 150° from it.
#[test]
fn directions_are_geodesic() {
    let ball = sphere(1.0, 20).unwrap();
    let at = ball.face(FaceId(1234)).centre().normalize();
    for angle in [0.0, 0.8, FRAC_PI_2, -FRAC_PI_2, PI] {
        let field = DirectionField::from_constraints(&ball, &[], &[about(at, Flow::Turned(angle))], 0.2).unwrap();
        for vertex in ball.vertices() {
            let place = vertex.position();
            let away = (place * place.dot(at) - at).normalize();
            // Anticlockwise seen from outside.
            let wanted = angle.cos() * away + angle.sin() * place.cross(away);
            let from = at.angle_between(place);
            if from > 2.0 * ball.mean_edge_length() && from < 2.6 {
                let off = field.at_vertex(vertex.id()).angle_between(wanted).to_degrees();
                assert!(off < if from < 1.7 { 1.0 } else { 6.0 }, "{off}° off at {from} from a point turned by {angle}");
            }
        }
    }
}

/// On a plane the directions are exact: x + iy away from a source, its conjugate about a saddle.
#[test]
fn on_a_plane_they_are_the_formula() {
    let mesh = plane(2.0, 2.0, 9, 9).unwrap();
    let axis = DVec3::new(0.6, 0.0, 0.8);
    for (flow, _) in flows(3.0 * axis) {
        let field = DirectionField::from_constraints(&mesh, &[], &[about(DVec3::new(0.03, 0.5, -0.02), flow)], 0.3).unwrap();
        let held = singularities(&mesh, &field).unwrap()[0].face;
        // The middle of a right triangle's inscribed circle: the cathetus less the radius from either leg.
        let corners = mesh.face(held).positions();
        let sides = [corners[1].distance(corners[2]), corners[2].distance(corners[0]), corners[0].distance(corners[1])];
        let middle = (0..3).map(|k| sides[k] * corners[k]).sum::<DVec3>() / sides.iter().sum::<f64>();
        for vertex in mesh.vertices() {
            let away = (vertex.position() - middle).normalize();
            let side = DVec3::Y.cross(away);
            let wanted = match flow {
                Flow::Turned(angle) => angle.cos() * away + angle.sin() * side,
                Flow::Saddle(_) => 2.0 * axis * axis.dot(away) - away,
            };
            // A conjugate about the axis is a reflection in it.
            assert!(field.at_vertex(vertex.id()).distance(wanted) < 1e-9, "{flow:?} at {}", vertex.position());
        }
    }
}

#[test]
fn a_point_rules_its_place_and_vectors_theirs() {
    let ball = sphere(1.0, 20).unwrap();
    let vectors = [Constraint { at: DVec3::X, along: DVec3::Y }, Constraint { at: DVec3::NEG_Z, along: DVec3::X }];
    let points =
        [about(DVec3::Y, Flow::Turned(FRAC_PI_2)), about(DVec3::NEG_Y, Flow::Turned(0.0)), about(DVec3::Z, Flow::Saddle(DVec3::X))];
    for radius in [0.05, 0.2, 100.0] {
        let field = DirectionField::from_constraints(&ball, &vectors, &points, radius).unwrap();
        let found = singularities(&ball, &field).unwrap();
        for point in points {
            let index = if matches!(point.flow, Flow::Saddle(_)) { -1 } else { 1 };
            let held = found.iter().filter(|s| ball.face(s.face).centre().distance(point.at) < ball.mean_edge_length());
            assert_eq!(held.map(|s| s.index).collect::<Vec<_>>(), [index], "{point:?} at a radius of {radius}");
        }
        for Constraint { at, along } in vectors.into_iter().filter(|_| radius < 1.0) {
            let vertex = ball.vertices().min_by(|a, b| a.position().distance(at).total_cmp(&b.position().distance(at)));
            let off = field.at_vertex(vertex.unwrap().id()).angle_between(along).to_degrees();
            assert!(off < 15.0, "{off}° off {at} at a radius of {radius}");
        }
    }
}

/// Two points in one face cannot both be had; no fault comes of it.
#[test]
fn coincident_points_are_finite() {
    let ball = sphere(1.0, 8).unwrap();
    let mut worst = 0.0_f64;
    for (one, _) in flows(DVec3::Z) {
        for (other, _) in flows(DVec3::Y) {
            for (vectors, apart) in [(&[][..], 0.0), (&[Constraint { at: DVec3::X, along: DVec3::Y }][..], 0.05)] {
                let points = [about(DVec3::X, one), about(DVec3::X + apart * DVec3::Y, other)];
                let field = DirectionField::from_constraints(&ball, vectors, &points, 0.2).unwrap();
                worst = worst.max(assert_unit_and_tangent("ball", &ball, &field));
            }
        }
    }
    println!("reached: unit and tangent within {worst:.0e}");
}

#[test]
fn the_same_at_any_scale() {
    for (name, mesh) in models() {
        let point = |scale: f64| about(scale * mesh.face(FaceId(3)).centre(), Flow::Turned(1.0));
        let field = DirectionField::from_constraints(&mesh, &[], &[point(1.0)], 0.2).unwrap();
        for scale in [1e-30, 1e30] {
            let other = mesh.with_positions(mesh.positions().iter().map(|&p| scale * p).collect()).unwrap();
            let again = DirectionField::from_constraints(&other, &[], &[point(scale)], 0.2).unwrap();
            assert_eq!(index_in(&other, &again, FaceId(3)), 1, "{name} × {scale}");
            let off = field.vectors().iter().zip(again.vectors()).filter(|(a, b)| a.distance(**b) > 1e-5).count();
            assert_eq!(off, 0, "{name} × {scale}");
        }
    }
}

#[test]
fn what_is_no_point_is_refused() {
    let ball = sphere(1.0, 2).unwrap();
    let refused = |point| DirectionField::from_constraints(&ball, &[], &[about(DVec3::X, Flow::Turned(0.0)), point], 0.2).unwrap_err();
    assert!(matches!(refused(about(DVec3::NAN, Flow::Turned(0.0))), FieldError::PointPlace { constraint: 1, .. }));
    assert!(matches!(refused(about(DVec3::X, Flow::Turned(f64::INFINITY))), FieldError::PointTurn { constraint: 1, .. }));
    assert!(matches!(refused(about(DVec3::X, Flow::Saddle(DVec3::ZERO))), FieldError::PointDirection { constraint: 1, .. }));
    // A saddle straight out of the surface is one along some axis; a mesh without area has no place for one.
    let upright = DirectionField::from_constraints(&ball, &[], &[about(DVec3::X, Flow::Saddle(DVec3::X))], 0.2).unwrap();
    assert_unit_and_tangent("ball", &ball, &upright);
    let flat = Mesh::from_triangles(vec![DVec3::ZERO; 3], &[[0, 1, 2]]).unwrap();
    let field = DirectionField::from_constraints(&flat, &[], &[about(DVec3::X, Flow::Turned(0.0))], 0.2).unwrap();
    assert!(field.vectors().iter().all(|&v| v == DVec3::ZERO));
}
