//! Noise, strokes and blur on tori of 5,000, 100,000 and 1,000,000 faces.
#![allow(clippy::unwrap_used, reason = "a benchmark's input is its own")]

use divan::Bencher;
use divan::counter::ItemsCount;
use glam::DVec3;
use pelage_field::{Noise, NoiseKind, ScalarField, Stroke};
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

#[divan::bench(args = SIZES, sample_count = 5)]
fn perlin_three_octaves(bencher: Bencher<'_, '_>, size: (u32, u32)) {
    let (mesh, faces) = model(size);
    bencher.counter(faces).bench(|| ScalarField::noise(&mesh, &Noise::default()).unwrap());
}

#[divan::bench(args = SIZES, sample_count = 5)]
fn dots_one_octave(bencher: Bencher<'_, '_>, size: (u32, u32)) {
    let (mesh, faces) = model(size);
    let noise = Noise { kind: NoiseKind::Dots, octaves: 1, ..Noise::default() };
    bencher.counter(faces).bench(|| ScalarField::noise(&mesh, &noise).unwrap());
}

/// A quarter of the way around the ring, at its outside.
#[divan::bench(args = SIZES, sample_count = 3)]
fn a_stroke(bencher: Bencher<'_, '_>, size: (u32, u32)) {
    let (mesh, faces) = model(size);
    let points =
        (0..=16).map(|k| f64::from(k) * std::f64::consts::FRAC_PI_2 / 16.0).map(|t| 1.4 * DVec3::new(t.cos(), 0.0, t.sin())).collect();
    let stroke = [Stroke { points, radius: 0.05, softness: 0.5, value: 1.0 }];
    bencher.counter(faces).bench(|| ScalarField::strokes(&mesh, &stroke, 0.0).unwrap());
}

#[divan::bench(args = SIZES, sample_count = 3)]
fn blur(bencher: Bencher<'_, '_>, size: (u32, u32)) {
    let (mesh, faces) = model(size);
    let field = ScalarField::noise(&mesh, &Noise::default()).unwrap();
    bencher.counter(faces).bench(|| field.blurred(&mesh, 0.02).unwrap());
}
