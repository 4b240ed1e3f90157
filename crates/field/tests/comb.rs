//! Fur combed stroke by stroke: what each tool does under its middle, that nothing else is touched, and what is refused.
#![allow(clippy::unwrap_used, reason = "clippy excuses test functions only, not what they call")]

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;
use pelage_field::{Brush, BrushStroke, Comb, DirectionField, FieldError, MOST_SLANT, Tool, singularities};
use pelage_mesh::{Mesh, Vertex, plane, sphere, torus};
use proptest::prelude::*;

/// 2 × 2 across y, its diagonal 2√2.
fn sheet() -> Mesh {
    plane(2.0, 2.0, 40, 40).unwrap()
}

fn dab(tool: Tool) -> BrushStroke {
    BrushStroke { tool, path: vec![DVec3::ZERO], radius: 0.15, strength: 1.0 }
}

fn along_x(tool: Tool) -> BrushStroke {
    BrushStroke { path: vec![DVec3::new(-0.6, 0.0, 0.0), DVec3::new(0.6, 0.0, 0.0)], ..dab(tool) }
}

/// Fur that leans along x by 0.5, after a stroke.
fn after(mesh: &Mesh, stroke: &BrushStroke) -> Comb {
    let field = DirectionField::toward(mesh, DVec3::X).unwrap();
    let mut comb = Comb::new(mesh, Some(&field), 0.5).unwrap();
    Brush::on(mesh).apply(stroke, &mut comb).unwrap();
    comb
}

/// The lean and the length at the vertex nearest to a place.
fn at(mesh: &Mesh, comb: &Comb, place: DVec3) -> (DVec3, f32) {
    let nearest = mesh.vertices().min_by(|a, b| a.position().distance(place).total_cmp(&b.position().distance(place))).unwrap().index();
    (comb.leans()[nearest], comb.lengths().unwrap().values()[nearest])
}

fn near(found: DVec3, wanted: DVec3) -> bool {
    found.distance(wanted) < 0.02
}

#[test]
fn under_its_middle_each_tool_does_what_it_is_told() {
    let sheet = sheet();
    let middle = |tool| at(&sheet, &after(&sheet, &dab(tool)), DVec3::ZERO);
    assert!(
        near(middle(Tool::Comb { toward: DVec3::new(0.1, 5.0, 0.3) }).0, DVec3::new(0.6, 0.0, 0.3)),
        "the part along the normal is left out"
    );
    assert_eq!(middle(Tool::Lift).0, DVec3::ZERO);
    assert!(near(middle(Tool::Flatten { slant: 1.2 }).0, 1.2 * DVec3::X));
    assert!((middle(Tool::Cut { to: 0.3 }).1 - 0.3).abs() < 1e-6);
    let (lean, length) = middle(Tool::Puff { by: 0.5 });
    assert!((length - 1.5).abs() < 1e-6 && near(lean, 0.25 * DVec3::X));
    let along = after(
        &sheet,
        &BrushStroke { path: vec![DVec3::new(0.0, 0.0, -0.5), DVec3::new(0.0, 0.0, 0.5)], ..dab(Tool::Along { slant: 0.8 }) },
    );
    assert!(near(at(&sheet, &along, DVec3::ZERO).0, 0.8 * DVec3::Z));
}

#[test]
fn a_part_lays_fur_aside_and_a_whorl_around() {
    let sheet = sheet();
    let parted = after(&sheet, &along_x(Tool::Part { slant: 1.0 }));
    for side in [-1.0, 1.0] {
        let (lean, _) = at(&sheet, &parted, DVec3::new(0.1, 0.0, side * 0.05));
        assert!(lean.z * side > 0.7 && lean.x.abs() < 0.2, "{side}: {lean}");
    }
    let whirled = after(&sheet, &BrushStroke { radius: 0.3, ..dab(Tool::Whorl { turn: FRAC_PI_2, slant: 1.0 }) });
    for angle in [0.3, 1.7, 3.9, 5.5_f64] {
        let away = DVec3::new(angle.cos(), 0.0, angle.sin());
        let (lean, _) = at(&sheet, &whirled, 0.1 * away);
        // Anticlockwise seen from above, where x is to the right and z towards the eye.
        assert!(lean.dot(DVec3::Y.cross(away)) > 0.7, "{angle}: {lean}");
    }
    let sunk = after(&sheet, &dab(Tool::Whorl { turn: PI, slant: 1.0 }));
    assert!(at(&sheet, &sunk, DVec3::new(0.1, 0.0, 0.0)).0.x < -0.3);
}

#[test]
fn smoothing_brings_neighbours_together() {
    let sheet = sheet();
    let mut comb = after(&sheet, &along_x(Tool::Part { slant: 1.0 }));
    // How unlike neighbours are, by the squares of their differences.
    let roughness = |comb: &Comb| -> f64 {
        sheet.edges().map(|edge| edge.vertices().map(|v| comb.leans()[v.index()])).map(|[a, b]| a.distance_squared(b)).sum()
    };
    let before = roughness(&comb);
    let mut brush = Brush::on(&sheet);
    for _ in 0..10 {
        brush.apply(&along_x(Tool::Smooth), &mut comb).unwrap();
    }
    assert!(roughness(&comb) < 0.5 * before, "{} of {before}", roughness(&comb));
}

#[test]
fn swirls_set_by_hand_are_singularities_that_add_up() {
    for (mesh, euler) in [(sphere(1.0, 16).unwrap(), 2), (torus(1.0, 0.4, 48, 24).unwrap(), 0)] {
        let top = mesh.vertices().map(Vertex::position).max_by(|a, b| a.y.total_cmp(&b.y)).unwrap();
        // A little beside, as a singularity lies within a face.
        let place = top + DVec3::new(0.01, 0.0, 0.013);
        let field = DirectionField::toward(&mesh, DVec3::new(0.3, -0.2, -1.0)).unwrap();
        let mut comb = Comb::new(&mesh, Some(&field), 0.6).unwrap();
        let mut brush = Brush::on(&mesh);
        for turn in [0.0, 2.0] {
            let stroke = BrushStroke { tool: Tool::Whorl { turn, slant: 1.0 }, path: vec![place], radius: 0.15, strength: 1.0 };
            brush.apply(&stroke, &mut comb).unwrap();
            let found = singularities(&mesh, &comb.directions(&mesh).unwrap()).unwrap();
            assert_eq!(found.iter().map(|s| s.index).sum::<i32>(), euler);
            assert!(found.iter().any(|s| s.index == 1 && mesh.face(s.face).centre().distance(place) < 0.12), "turned by {turn}: {found:?}");
        }
    }
}

#[test]
fn a_stroke_follows_the_surface_and_not_the_space_between() {
    // Two sheets close together: the fur of the other one is not touched.
    let (low, high) = (sheet(), sheet());
    let count = low.positions().len() as u32;
    let positions = low.positions().iter().copied().chain(high.positions().iter().map(|&p| p + 0.05 * DVec3::Y)).collect();
    let triangles: Vec<[u32; 3]> =
        low.topology().triangles().chain(high.topology().triangles().map(|face| face.map(|v| v + count))).collect();
    let both = Mesh::from_triangles(positions, &triangles).unwrap();
    let mut comb = Comb::new(&both, None, 0.0).unwrap();
    let touched = Brush::on(&both).apply(&dab(Tool::Comb { toward: DVec3::X }), &mut comb).unwrap();
    assert!(!touched.is_empty() && touched.iter().all(|vertex| vertex.0 < count));
}

#[test]
fn a_lean_everywhere_is_bounded_and_tangent() {
    let ball = sphere(1.0, 8).unwrap();
    let mut comb = Comb::new(&ball, None, 0.0).unwrap();
    comb.add(&ball, 9.0 * DVec3::X).unwrap();
    for (lean, normal) in comb.leans().iter().zip(ball.vertex_normals()) {
        assert!(lean.length() <= MOST_SLANT + 1e-12 && lean.dot(normal).abs() < 1e-9);
    }
    assert!(comb.leans().iter().any(|lean| lean.length() > MOST_SLANT - 1e-9));
    assert!(matches!(comb.add(&ball, DVec3::NAN), Err(FieldError::NoDirection(_))));
}

#[test]
fn what_cannot_be_stroked_is_refused_and_nothing_changed() {
    let sheet = sheet();
    let start = Comb::new(&sheet, None, 0.0).unwrap();
    let refused = |stroke: BrushStroke| {
        let mut comb = start.clone();
        let error = Brush::on(&sheet).apply(&stroke, &mut comb).unwrap_err();
        assert_eq!(comb, start);
        error.to_string()
    };
    let lift = || dab(Tool::Lift);
    for (stroke, expected) in [
        (BrushStroke { path: vec![], ..lift() }, "one finite place"),
        (BrushStroke { path: vec![DVec3::NAN], ..lift() }, "one finite place"),
        (BrushStroke { radius: 0.0, ..lift() }, "radius must be"),
        (BrushStroke { radius: f64::NAN, ..lift() }, "radius must be"),
        (BrushStroke { strength: 1.5, ..lift() }, "strength must be"),
        (dab(Tool::Along { slant: 0.3 }), "two places"),
        (dab(Tool::Cut { to: -0.1 }), "what is cut"),
        (dab(Tool::Comb { toward: DVec3::INFINITY }), "angles must be finite"),
        (BrushStroke { path: vec![DVec3::ZERO, DVec3::new(0.0, 0.0, 3.0)], ..lift() }, "place 1"),
        (BrushStroke { radius: 1e-6, path: vec![DVec3::ZERO, DVec3::X], ..lift() }, "longer than 1000"),
    ] {
        let error = refused(stroke);
        assert!(error.contains(expected), "{expected}: {error}");
    }
    let mut other = Comb::new(&sphere(1.0, 4).unwrap(), None, 0.0).unwrap();
    assert!(matches!(Brush::on(&sheet).apply(&lift(), &mut other), Err(FieldError::Length { .. })));
}

fn tool() -> impl Strategy<Value = Tool> {
    let slant = || -3.0..3.0_f64;
    prop_oneof![
        prop::array::uniform3(-3.0..3.0_f64).prop_map(|toward| Tool::Comb { toward: toward.into() }),
        slant().prop_map(|slant| Tool::Along { slant }),
        Just(Tool::Smooth),
        slant().prop_map(|slant| Tool::Part { slant }),
        (slant(), slant()).prop_map(|(turn, slant)| Tool::Whorl { turn, slant }),
        Just(Tool::Lift),
        slant().prop_map(|slant| Tool::Flatten { slant }),
        (0.0..1.0_f64).prop_map(|to| Tool::Cut { to }),
        (0.0..3.0_f64).prop_map(|by| Tool::Puff { by }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    /// Whatever the tool, fur stays on the surface and within bounds, and what is further off than the radius keeps every bit.
    #[test]
    fn leans_stay_tangent_and_bounded_and_the_rest_is_untouched(
        tools in prop::collection::vec(tool(), 1..4), from in prop::array::uniform3(-1.0..1.0_f64), to in prop::array::uniform3(-1.0..1.0_f64),
        radius in 0.02..0.4_f64, strength in 0.0..=1.0_f64,
    ) {
        let ball = sphere(1.0, 10).unwrap();
        let on = |place: [f64; 3]| DVec3::from(place).try_normalize().unwrap_or(DVec3::X);
        let from = on(from);
        let to = on((from + 0.15 * DVec3::from(to)).to_array());
        let field = DirectionField::toward(&ball, DVec3::X).unwrap();
        let mut comb = Comb::new(&ball, Some(&field), 0.4).unwrap();
        let before = comb.clone();
        let mut brush = Brush::on(&ball);
        let reach = radius * ball.diameter();
        for tool in tools {
            let touched = brush.apply(&BrushStroke { tool, path: vec![from, to], radius, strength }, &mut comb).unwrap();
            // What a stroke looks at lies within its radius of the way between its ends, and a tenth further at most, as fast distances are not exact.
            let line = to - from;
            let along = |place: DVec3| ((place - from).dot(line) / line.length_squared().max(1e-12)).clamp(0.0, 1.0);
            let off = |place: DVec3| place.distance(from + line * along(place));
            prop_assert!(touched.iter().all(|vertex| off(ball.vertex(*vertex).position()) <= 1.1 * reach + 0.02));
        }
        for (vertex, normal) in ball.vertices().zip(ball.vertex_normals()) {
            let lean = comb.leans()[vertex.index()];
            prop_assert!(lean.is_finite() && lean.length() <= MOST_SLANT + 1e-12 && lean.dot(normal).abs() < 1e-9);
            prop_assert!(comb.lengths().unwrap().values()[vertex.index()] >= 0.0);
            if vertex.position().distance(from) > reach + 0.31 {
                prop_assert_eq!(lean, before.leans()[vertex.index()]);
            }
        }
    }
}
