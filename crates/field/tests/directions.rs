//! Direction fields: unit, tangent, where they are wanted, at any scale.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may fail, and says what it leaves out")]

mod common;

use common::{assert_unit_and_tangent, models};
use glam::DVec3;
use pelage_field::{Constraint, DirectionField, FieldError, LEAST_PROJECTION, Singularity, boundary_turning, singularities};
use pelage_mesh::{Edge, Mesh, Vertex, plane, rounded_die, sphere, torus};

/// Two opposite constraints on either side, as far apart as the model is wide.
fn opposite(mesh: &Mesh) -> [Constraint; 2] {
    let (low, high) = mesh.bounds().unwrap();
    let middle = 0.5 * (low + high);
    let [left, right] = [DVec3::new(low.x, middle.y, middle.z), DVec3::new(high.x, middle.y, middle.z)];
    [Constraint { at: left, along: DVec3::Y }, Constraint { at: right, along: -2.0 * DVec3::Y }]
}

fn scaled(mesh: &Mesh, scale: f64) -> Mesh {
    mesh.with_positions(mesh.positions().iter().map(|&p| scale * p).collect()).unwrap()
}

#[test]
fn unit_and_tangent_everywhere() {
    let mut worst = 0.0_f64;
    for (name, mesh) in models() {
        for direction in [DVec3::X, DVec3::NEG_Y, DVec3::new(0.0, -0.3, -1.0)] {
            let field = DirectionField::toward(&mesh, direction).unwrap();
            worst = worst.max(assert_unit_and_tangent(&name, &mesh, &field));
            worst = worst.max(assert_unit_and_tangent(&name, &mesh, &field.smoothed(&mesh, 5).unwrap()));
        }
        for radius in [0.001, 0.25, 100.0] {
            let field = DirectionField::from_constraints(&mesh, &opposite(&mesh), &[], radius).unwrap();
            worst = worst.max(assert_unit_and_tangent(&name, &mesh, &field));
        }
    }
    println!("reached: unit and tangent within {worst:.0e}");
}

#[test]
fn indices_add_up_to_the_euler_characteristic_and_the_turning_of_the_boundary() {
    for (name, mesh) in models() {
        let mut fields = vec![DirectionField::from_constraints(&mesh, &opposite(&mesh), &[], 0.2).unwrap()];
        for direction in [DVec3::X, DVec3::Y, DVec3::Z] {
            fields.push(DirectionField::toward(&mesh, direction).unwrap());
        }
        for field in fields {
            let found = singularities(&mesh, &field).unwrap();
            let sum: i64 = found.iter().map(|s| i64::from(s.index)).sum();
            let turning: i64 = boundary_turning(&mesh, &field).unwrap().iter().map(|&turns| i64::from(turns)).sum();
            assert_eq!(sum, mesh.topology().euler_characteristic() + turning, "{name}");
        }
    }
}

#[test]
fn the_projection_is_kept_where_it_is_well_conditioned() {
    for (name, mesh) in models() {
        let direction = DVec3::new(0.2, -1.0, 0.1).normalize();
        let field = DirectionField::toward(&mesh, 7.0 * direction).unwrap();
        let mut kept = 0;
        for (v, n) in field.vectors().iter().zip(mesh.vertex_normals()) {
            let tangent = direction - n * n.dot(direction);
            if tangent.length() > LEAST_PROJECTION + 1e-9 {
                assert!(v.distance(tangent.normalize()) < 1e-9, "{name}");
                kept += 1;
            }
        }
        assert!(kept > 0 || name == "plane", "{name}");
    }
}

#[test]
fn the_same_at_any_scale() {
    let mut worst = 0.0_f64;
    for (name, mesh) in models() {
        let direction = DVec3::new(0.3, -1.0, 0.2);
        let toward = DirectionField::toward(&mesh, direction).unwrap();
        let spread = DirectionField::from_constraints(&mesh, &opposite(&mesh), &[], 0.2).unwrap();
        for scale in [1e-30, 1e-15, 1e15, 1e30] {
            let other = scaled(&mesh, scale);
            let pairs = [
                (&toward, DirectionField::toward(&other, scale * direction).unwrap()),
                (&spread, DirectionField::from_constraints(&other, &opposite(&other), &[], 0.2).unwrap()),
            ];
            for (a, b) in pairs {
                for (a, b) in a.vectors().iter().zip(b.vectors()) {
                    assert!(a.distance(*b) < 1e-5, "{name} × {scale}: {a} became {b}");
                    worst = worst.max(a.distance(*b));
                }
                assert_eq!(singularities(&mesh, a).unwrap(), singularities(&other, &b).unwrap(), "{name} × {scale}");
            }
        }
    }
    println!("reached: vectors within {worst:.0e}, the same singularities");
}

#[test]
fn two_runs_agree_to_the_bit() {
    for (name, mesh) in models() {
        let constraints = opposite(&mesh);
        let make = || DirectionField::from_constraints(&mesh, &constraints, &[], 0.1).unwrap().smoothed(&mesh, 3).unwrap();
        assert!(make() == make(), "{name}");
    }
}

/// The field at a ball's poles, which one direction says nothing about, is the smooth one: it goes straight over.
#[test]
fn the_poles_of_a_ball_are_filled_smoothly() {
    let ball = sphere(1.0, 24).unwrap();
    let field = DirectionField::toward(&ball, DVec3::Y).unwrap();
    for edge in ball.edges() {
        let ends = edge.vertices();
        let [a, b] = ends.map(Vertex::position);
        // Around a pole the field turns by about edge over distance; at three edges it is well under a radian.
        let from_pole = DVec3::new(a.x, 0.0, a.z).length().min(DVec3::new(b.x, 0.0, b.z).length());
        if from_pole > 3.0 * ball.mean_edge_length() {
            let [v, w] = ends.map(|vertex| field.at_vertex(vertex.id()));
            assert!(v.angle_between(w) < 0.6, "at {a}: {v} beside {w}");
        }
    }
}

#[test]
fn singularities_lie_where_the_analytic_field_has_them() {
    let (mut off_pole, mut off_saddle) = (0.0_f64, 0.0_f64);
    // On a ball, height has its source at the bottom and its sink at the top.
    for direction in [DVec3::Y, DVec3::X, DVec3::new(1.0, 2.0, -0.5).normalize()] {
        let ball = sphere(3.0, 24).unwrap();
        let found = singularities(&ball, &DirectionField::toward(&ball, direction).unwrap()).unwrap();
        let heights: Vec<f64> = found.iter().map(|s| ball.face(s.face).centre().dot(direction) / 3.0).collect();
        assert_eq!(found.iter().map(|s| s.index).collect::<Vec<_>>(), [1, 1], "{heights:?}");
        // Within the completed cap, whose edge is where the sine is LEAST_PROJECTION.
        assert!(heights.iter().all(|h| h.abs() > 0.994) && heights[0] * heights[1] < 0.0, "{heights:?}");
        let degrees = |s: &Singularity| ball.face(s.face).centre().normalize().dot(direction).abs().min(1.0).acos().to_degrees();
        off_pole = found.iter().map(degrees).fold(off_pole, f64::max);
    }
    // Across a torus's axis, height has a minimum, a maximum and two saddles.
    let ring = torus(1.0, 0.4, 80, 48).unwrap();
    let found = singularities(&ring, &DirectionField::toward(&ring, DVec3::X).unwrap()).unwrap();
    let mut places: Vec<_> = found.iter().map(|s| (ring.face(s.face).centre(), s.index)).collect();
    places.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
    let expected = [(-1.4, 1), (-0.6, -1), (0.6, -1), (1.4, 1)];
    assert_eq!(places.len(), expected.len(), "{places:?}");
    for ((place, index), (x, expected)) in places.into_iter().zip(expected) {
        assert!(index == expected && place.distance(DVec3::new(x, 0.0, 0.0)) < 0.15, "{place} has {index}");
        off_saddle = off_saddle.max(place.distance(DVec3::new(x, 0.0, 0.0)) / ring.mean_edge_length());
    }
    // Around a torus's axis nothing is singular.
    let around: Vec<Constraint> = (0..8)
        .map(|k| {
            let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 8.0).sin_cos();
            Constraint { at: 1.4 * DVec3::new(cos, 0.0, -sin), along: DVec3::new(-sin, 0.0, -cos) }
        })
        .collect();
    let field = DirectionField::from_constraints(&ring, &around, &[], 0.1).unwrap();
    assert_eq!(singularities(&ring, &field).unwrap(), []);
    println!("reached: on the ball {off_pole:.1}° off, on the torus {off_saddle:.1} edges off, around its axis none");
}

#[test]
fn a_flat_patch_has_no_singularity_and_the_whole_boundary_turning() {
    let mesh = plane(2.0, 2.0, 10, 10).unwrap();
    let along = DirectionField::toward(&mesh, DVec3::new(1.0, 0.0, 0.4)).unwrap();
    assert_eq!((singularities(&mesh, &along).unwrap(), boundary_turning(&mesh, &along).unwrap()), (vec![], vec![-1]));
    // Out of the middle: four constraints outwards; the field keeps to the boundary's tangent.
    let outwards: Vec<Constraint> = [DVec3::X, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Z].map(|d| Constraint { at: 0.9 * d, along: d }).into();
    let field = DirectionField::from_constraints(&mesh, &outwards, &[], 0.2).unwrap();
    let found = singularities(&mesh, &field).unwrap();
    assert_eq!((found.len(), found[0].index), (1, 1));
    assert!(mesh.face(found[0].face).centre().length() < 0.3);
    assert_eq!(boundary_turning(&mesh, &field).unwrap(), [0]);
}

#[test]
fn what_lies_across_the_direction_follows_an_axis() {
    let mesh = plane(1.0, 1.0, 4, 4).unwrap();
    let field = DirectionField::toward(&mesh, DVec3::Y).unwrap();
    assert!(field.vectors().iter().all(|&v| v == DVec3::X));
}

#[test]
fn constraints_are_met_and_rule_their_surroundings() {
    let ball = sphere(1.0, 16).unwrap();
    let constraints = [
        Constraint { at: DVec3::Y, along: DVec3::X },
        Constraint { at: DVec3::NEG_Y, along: DVec3::new(-1.0, 0.0, 5.0) },
        Constraint { at: 4.0 * DVec3::Z, along: DVec3::Y },
    ];
    let field = DirectionField::from_constraints(&ball, &constraints, &[], 0.1).unwrap();
    for Constraint { at, along } in constraints {
        let near = ball.vertices().filter(|v| v.position().distance(at.normalize()) < 0.3);
        for vertex in near {
            assert!(field.at_vertex(vertex.id()).dot(along.normalize()) > 0.9);
        }
    }
}

#[test]
fn opposite_constraints_at_one_place_are_finite() {
    let ball = sphere(1.0, 8).unwrap();
    let here = |along| Constraint { at: DVec3::X, along };
    let mut worst = 0.0_f64;
    for constraints in [[here(DVec3::Y), here(-DVec3::Y)], [here(DVec3::X), here(DVec3::X)]] {
        let field = DirectionField::from_constraints(&ball, &constraints, &[], 0.2).unwrap();
        worst = worst.max(assert_unit_and_tangent("ball", &ball, &field));
    }
    println!("reached: unit and tangent within {worst:.0e}");
}

#[test]
fn a_piece_without_constraints_follows_their_mean() {
    let (one, far) = (sphere(1.0, 6).unwrap(), 10.0 * DVec3::X);
    let count = one.positions().len() as u32;
    let positions = one.positions().iter().copied().chain(one.positions().iter().map(|&p| p + far)).collect();
    let triangles: Vec<_> = one.topology().triangles().chain(one.topology().triangles().map(|t| t.map(|v| v + count))).collect();
    let pair = Mesh::from_triangles(positions, &triangles).unwrap();
    let constraints = [Constraint { at: DVec3::X, along: DVec3::Y }, Constraint { at: DVec3::NEG_X, along: DVec3::Z }];
    let field = DirectionField::from_constraints(&pair, &constraints, &[], 0.2).unwrap();
    let toward = DirectionField::toward(&pair, DVec3::new(0.0, 1.0, 1.0)).unwrap();
    for vertex in pair.vertices().map(Vertex::id).skip(count as usize) {
        assert!(field.at_vertex(vertex).distance(toward.at_vertex(vertex)) < 1e-9);
    }
}

#[test]
fn unreferenced_vertices_stay_zero() {
    let mesh = Mesh::from_triangles(vec![DVec3::ZERO, DVec3::X, DVec3::ONE * 9.0, DVec3::Y], &[[0, 1, 3]]).unwrap();
    let constraints = [Constraint { at: DVec3::ONE * 9.0, along: DVec3::X }];
    for field in
        [DirectionField::toward(&mesh, DVec3::X).unwrap(), DirectionField::from_constraints(&mesh, &constraints, &[], 1.0).unwrap()]
    {
        assert_eq!(field.vectors(), [DVec3::X, DVec3::X, DVec3::ZERO, DVec3::X]);
    }
}

#[test]
fn what_makes_no_field_is_refused() {
    let (ball, empty) = (sphere(1.0, 2).unwrap(), Mesh::from_triangles(vec![DVec3::ZERO], &[]).unwrap());
    for bad in [DVec3::ZERO, DVec3::NAN, DVec3::new(1.0, f64::INFINITY, 0.0)] {
        assert!(matches!(DirectionField::toward(&ball, bad), Err(FieldError::NoDirection(_))));
        let constraints = [Constraint { at: DVec3::X, along: DVec3::Y }, Constraint { at: DVec3::X, along: bad }];
        let error = DirectionField::from_constraints(&ball, &constraints, &[], 0.2).unwrap_err();
        assert!(matches!(error, FieldError::ConstraintDirection { constraint: 1, .. }));
    }
    let one = [Constraint { at: DVec3::NAN, along: DVec3::Y }];
    assert!(matches!(DirectionField::from_constraints(&ball, &one, &[], 0.2), Err(FieldError::ConstraintPlace { constraint: 0, .. })));
    assert_eq!(DirectionField::from_constraints(&ball, &[], &[], 0.2), Err(FieldError::NoConstraints));
    let one = [Constraint { at: DVec3::X, along: DVec3::Y }];
    for radius in [0.0, -1.0, f64::NAN, 1e3] {
        assert!(matches!(DirectionField::from_constraints(&ball, &one, &[], radius), Err(FieldError::Radius(_))));
    }
    assert_eq!(DirectionField::toward(&empty, DVec3::X), Err(FieldError::NoSurface));
    assert_eq!(DirectionField::from_constraints(&empty, &one, &[], 0.2), Err(FieldError::NoSurface));
    let field = DirectionField::toward(&ball, DVec3::X).unwrap();
    assert!(matches!(singularities(&empty, &field), Err(FieldError::Length { .. })));
    assert!(matches!(field.smoothed(&empty, 1), Err(FieldError::Length { .. })));
}

/// A die whose vertices are off by 1/1000 of its side, the same on each run.
fn rough_die() -> Mesh {
    let die = rounded_die(1.0, 0.3, 24).unwrap();
    let jolt = |k: usize| (k as f64 * 78.233).sin() * 1e-3;
    let rough = die.positions().iter().enumerate().map(|(k, &p)| p + DVec3::new(jolt(3 * k), jolt(3 * k + 1), jolt(3 * k + 2)));
    die.with_positions(rough.collect()).unwrap()
}

#[test]
fn roughness_of_what_lies_across_is_not_taken_for_a_direction() {
    let die = rough_die();
    let field = DirectionField::toward(&die, DVec3::Y).unwrap();
    let (top, bottom): (Vec<_>, Vec<_>) = singularities(&die, &field).unwrap().into_iter().partition(|s| die.face(s.face).centre().y > 0.0);
    for side in [top, bottom] {
        assert_eq!(side.iter().map(|s| s.index).collect::<Vec<_>>(), [1], "{side:?}");
        let place = die.face(side[0].face).centre();
        assert!(place.y.abs() > 0.49 && place.x.hypot(place.z) < 0.15, "{place}");
    }
}

#[test]
fn smoothing_brings_neighbours_together() {
    let die = rough_die();
    let difference = |field: &DirectionField| -> f64 {
        let across = |edge: Edge<'_, Mesh>| {
            let [a, b] = edge.vertices().map(|end| field.at_vertex(end.id()));
            a.distance_squared(b)
        };
        die.edges().map(across).sum()
    };
    let field = DirectionField::toward(&die, DVec3::new(1.0, 0.3, 0.2)).unwrap();
    let (five, twenty) = (field.smoothed(&die, 5).unwrap(), field.smoothed(&die, 20).unwrap());
    assert!(difference(&five) < 0.97 * difference(&field) && difference(&twenty) < difference(&five));
    assert_eq!(field.smoothed(&die, 0).unwrap(), field);
}
