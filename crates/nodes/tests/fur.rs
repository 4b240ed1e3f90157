//! How hair stands that is combed, bent and cut.
#![allow(clippy::unwrap_used, reason = "clippy excuses test functions only, not what they call")]

use std::sync::Arc;

use glam::{DVec3, Vec3};
use pelage_coat::{Coat, Surface};
use pelage_graph::{Evaluator, Graph, Request};

const LENGTH: f64 = 0.05;

/// A plane in straight upright hair combed along x, laid with these parameters; some of its fields vary from 0 to 2 along x.
fn coat(parameters: &str) -> Arc<Coat> {
    let nodes = format!(
        r#""plane": Plane(cells: (8, 1)), "combed": DirectionField(mesh: "plane.mesh", toward: (1.0, 0.0, 0.0)),
        "ramp": ScalarRamp(mesh: "plane.mesh", along: (1.0, 0.0, 0.0), from: 0.0, to: 2.0), "patches": GrowPatches(mesh: "plane.mesh"),
        "hair": GrowStrands(style: Straight, count: 20, length_variation: 0.0, lean: 0.0, splay: 0.0, gravity: 0.0, wander: 0.0, separation: 0.0,
            clump: 0.0, undercoat: (count: 0), steps: 256),
        "shells": SampleShells(strands: "hair.strands", layers: 2, resolution: 8), "fin": SampleFin(strands: "hair.strands", size: (8, 8)),
        "coat": LayFur(mesh: "plane.mesh", patches: "patches.patches", strands: "hair.strands", shells: "shells.shells", fin: "fin.fin",
            length: {LENGTH:?}, {parameters})"#
    );
    let checked = Graph::parse(&format!("Graph(version: 1, nodes: {{{nodes}}})")).unwrap().check(&pelage_nodes::registry()).unwrap();
    Evaluator::new(0).run(&checked, &Request::output("coat.fur")).unwrap().get::<Coat>("coat.fur").unwrap()
}

fn combed(slant: f64, bend: f64, more: &str) -> Arc<Coat> {
    coat(&format!("directions: \"combed.directions\", slant: {slant:?}, bend: {bend:?}, {more}"))
}

/// The angles and the shares of the slant that are tried.
fn poses() -> impl Iterator<Item = (f64, f64)> {
    [-80.0, -33.0, 0.0, 1e-6, 25.0, 60.0, 80.0].into_iter().flat_map(|slant| [0.0, 1e-9, 0.3, 0.75, 1.0].map(|bend| (slant, bend)))
}

/// *c* and *b* of a vertex.
fn curve(surface: &Surface, vertex: usize) -> (DVec3, DVec3) {
    (surface.offsets[vertex].as_dvec3(), surface.bends[vertex].as_dvec3())
}

/// The direction that leans by an angle in degrees.
fn leaning(degrees: f64) -> DVec3 {
    DVec3::new(degrees.to_radians().sin(), degrees.to_radians().cos(), 0.0)
}

#[test]
fn a_bent_hair_is_as_long_as_a_straight_one() {
    for (slant, bend) in poses() {
        let coat = combed(slant, bend, "");
        let (c, b) = curve(&coat.surface, 4);
        let place = |h: f64| c * h + b * (h * h - h);
        // Chords are short of the arc by the square of their number.
        let arc: f64 = (0..4000).map(|k| place(f64::from(k) / 4000.0).distance(place(f64::from(k + 1) / 4000.0))).sum();
        assert!((arc / LENGTH - 1.0).abs() < 1e-6, "slant {slant}, bend {bend}: {}", arc / LENGTH);
    }
}

#[test]
fn a_bent_hair_ends_at_the_slant_and_leaves_the_skin_at_what_is_left_of_it() {
    for (slant, bend) in poses() {
        let coat = combed(slant, bend, "");
        let (c, b) = curve(&coat.surface, 4);
        assert!((c + b).normalize().distance(leaning(slant)) < 1e-6, "tip of slant {slant}, bend {bend}");
        assert!((c - b).normalize().distance(leaning(slant * (1.0 - bend))) < 1e-6, "root of slant {slant}, bend {bend}");
    }
}

#[test]
fn without_bend_it_is_the_straight_hair_to_the_last_bit() {
    for slant in [-80.0_f64, 0.0, 25.0, 80.0] {
        let coat = combed(slant, 0.0, "");
        let (sin, cos) = slant.to_radians().sin_cos();
        let expected = (LENGTH * (DVec3::Y * cos + DVec3::X * sin)).as_vec3();
        assert_eq!(coat.surface.offsets[4], expected);
        assert!(coat.surface.bends.iter().all(|&bend| bend == Vec3::ZERO) && coat.surface.ends.iter().all(|&end| end == 1.0));
    }
}

#[test]
fn sheared_hair_is_as_high_as_it_was_and_longer_by_one_over_the_cosine() {
    // The paper's shear (L20) moves shells along the surface and leaves their heights: hair grows longer as it is combed down, where bent hair, above, keeps its length.
    for slant in [-80.0_f64, -33.0, 0.0, 25.0, 60.0, 80.0] {
        let coat = combed(slant, 0.7, "slant_as: Sheared");
        let (c, b) = curve(&coat.surface, 4);
        let radians = slant.to_radians();
        assert!(b == DVec3::ZERO && (c - LENGTH * DVec3::new(radians.tan(), 1.0, 0.0)).length() < 1e-6, "slant {slant}: {c}, {b}");
        assert!((c.length() * radians.cos() / LENGTH - 1.0).abs() < 1e-6, "slant {slant}: {}", c.length() / LENGTH);
    }
}

#[test]
fn without_directions_nothing_bends() {
    let coat = coat("slant: 60.0, bend: 1.0");
    assert!(coat.surface.bends.iter().all(|&bend| bend == Vec3::ZERO));
    assert_eq!(coat.surface.offsets[4], (LENGTH * DVec3::Y).as_vec3());
    assert!(coat.surface.directions[4].distance(Vec3::Y) < 1e-6);
}

/// The mean unit direction of a vertex's curve from the skin to a height, by the midpoint rule.
fn mean_direction(surface: &Surface, vertex: usize, end: f64) -> DVec3 {
    let (c, b) = curve(surface, vertex);
    let n = 2000;
    let at = |k: i32| (c + b * (2.0 * end * (f64::from(k) + 0.5) / f64::from(n) - 1.0)).normalize();
    (0..n).map(at).sum::<DVec3>() / f64::from(n)
}

#[test]
fn the_lit_direction_is_the_mean_over_the_bent_hair() {
    for (slant, bend) in poses() {
        let coat = combed(slant, bend, "");
        let (mean, lit) = (mean_direction(&coat.surface, 4, 1.0), coat.surface.directions[4].as_dvec3());
        assert!(lit.distance(mean) < 2e-5, "slant {slant}, bend {bend}: {lit}, not {mean}");
    }
}

#[test]
fn cut_hair_keeps_its_length_and_ends_where_the_field_says() {
    let (whole, cut) = (combed(60.0, 1.0, ""), combed(60.0, 1.0, "lengths: \"ramp.values\", lengths_as: Cut"));
    let scaled = combed(60.0, 1.0, "lengths: \"ramp.values\"");
    let (mut bare, mut shorter, mut full) = (0, 0, 0);
    for vertex in 0..cut.surface.positions.len() {
        let x = cut.surface.positions[vertex].x - cut.surface.positions.iter().map(|p| p.x).fold(f32::INFINITY, f32::min);
        let across = cut.surface.positions.iter().map(|p| p.x).fold(f32::NEG_INFINITY, f32::max);
        let factor = f64::from(x / across);
        let end = cut.surface.ends[vertex];
        assert!((f64::from(end) - factor.min(1.0)).abs() < 1e-5, "factor {factor}: cut at {end}");
        assert!((scaled.surface.offsets[vertex].as_dvec3() - factor * whole.surface.offsets[vertex].as_dvec3()).length() < 1e-6);
        assert_eq!(scaled.surface.ends[vertex], 1.0);
        if factor == 0.0 {
            assert_eq!((cut.surface.offsets[vertex], scaled.surface.offsets[vertex]), (Vec3::ZERO, Vec3::ZERO));
            bare += 1;
            continue;
        }
        assert_eq!((cut.surface.offsets[vertex], cut.surface.bends[vertex]), (whole.surface.offsets[vertex], whole.surface.bends[vertex]));
        // What is left is lit as it stands: more upright than the whole.
        let (mean, lit) = (mean_direction(&cut.surface, vertex, f64::from(end)), cut.surface.directions[vertex].as_dvec3());
        assert!(lit.distance(mean) < 2e-3, "cut at {end}: {lit}, not {mean}");
        (shorter, full) = if end < 1.0 { (shorter + 1, full) } else { (shorter, full + 1) };
    }
    assert!(bare == 2 && shorter >= 6 && full >= 8, "{bare} bare, {shorter} cut, {full} whole");
}

#[test]
fn bare_skin_has_no_fins_however_it_came_about() {
    let fins = |more: &str| combed(0.0, 0.0, more).edges.vertices.len();
    let [scaled, cut] = ["Scale", "Cut"].map(|lengths_as| fins(&format!("lengths: \"ramp.values\", lengths_as: {lengths_as}")));
    assert_eq!((scaled, cut), (fins("") - 1, fins("") - 1), "one edge has both its ends in the bare");
}
