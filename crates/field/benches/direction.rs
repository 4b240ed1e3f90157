//! Direction fields and their singularities on tori of 5,000, 100,000 and 1,000,000 faces.
#![allow(clippy::unwrap_used, reason = "a benchmark's input is its own")]

use divan::Bencher;
use divan::counter::ItemsCount;
use glam::DVec3;
use pelage_field::{Constraint, DirectionField, Flow, PointConstraint, singularities};
use pelage_mesh::{Mesh, torus};

const SIZES: [(u32, u32); 3] = [(50, 50), (250, 200), (1000, 500)];

fn main() {
    divan::main();
}

fn model((major, minor): (u32, u32)) -> (Mesh, ItemsCount) {
    let mesh = torus(1.0, 0.4, major, minor).unwrap();
    let faces = mesh.topology().face_count();
    (mesh, ItemsCount::new(faces))
}

/// Across the axis: four small caps to complete.
#[divan::bench(args = SIZES, sample_count = 10)]
fn toward(bencher: Bencher<'_, '_>, size: (u32, u32)) {
    let (mesh, faces) = model(size);
    bencher.counter(faces).bench(|| DirectionField::toward(&mesh, DVec3::X).unwrap());
}

/// Along the axis: the whole top and bottom circles to complete.
#[divan::bench(args = SIZES, sample_count = 10)]
fn toward_across_circles(bencher: Bencher<'_, '_>, size: (u32, u32)) {
    let (mesh, faces) = model(size);
    bencher.counter(faces).bench(|| DirectionField::toward(&mesh, DVec3::Y).unwrap());
}

#[divan::bench(args = SIZES, sample_count = 10)]
fn four_constraints(bencher: Bencher<'_, '_>, size: (u32, u32)) {
    let (mesh, faces) = model(size);
    let constraints = [DVec3::X, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Z].map(|at| Constraint { at, along: at.cross(DVec3::Y) });
    bencher.counter(faces).bench(|| DirectionField::from_constraints(&mesh, &constraints, &[], 0.2).unwrap());
}

/// A whirl, a source and a saddle.
#[divan::bench(args = SIZES, sample_count = 5)]
fn three_points(bencher: Bencher<'_, '_>, size: (u32, u32)) {
    let (mesh, faces) = model(size);
    let points = [(DVec3::X, Flow::Turned(1.6)), (DVec3::NEG_X, Flow::Turned(0.0)), (DVec3::Z, Flow::Saddle(DVec3::Y))];
    let points = points.map(|(at, flow)| PointConstraint { at: 1.4 * at, flow });
    bencher.counter(faces).bench(|| DirectionField::from_constraints(&mesh, &[], &points, 0.2).unwrap());
}

#[divan::bench(args = SIZES, sample_count = 10)]
fn indices(bencher: Bencher<'_, '_>, size: (u32, u32)) {
    let (mesh, faces) = model(size);
    let field = DirectionField::toward(&mesh, DVec3::X).unwrap();
    bencher.counter(faces).bench(|| singularities(&mesh, &field).unwrap());
}
