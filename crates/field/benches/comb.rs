//! A stroke of a comb on meshes of 10,000, 100,000 and 1,000,000 vertices that touches as many of them each time: with the brush at hand it takes as long on all, as a stroke looks at nothing
//! that it does not touch. Beside it what is done once for a mesh.
#![allow(clippy::unwrap_used, reason = "a benchmark's input is its own")]

use divan::Bencher;
use divan::counter::ItemsCount;
use glam::DVec3;
use pelage_field::{Brush, BrushStroke, Comb, Tool};
use pelage_mesh::{Mesh, torus};

const SIZES: [(u32, u32); 3] = [(125, 80), (400, 250), (1250, 800)];

/// Vertices that a stroke touches, about.
const TOUCHED: f64 = 2000.0;

fn main() {
    divan::main();
}

fn model((major, minor): (u32, u32)) -> Mesh {
    torus(1.0, 0.4, major, minor).unwrap()
}

/// A short drag at the outside of the ring, as wide as it takes to touch so many vertices.
fn stroke(mesh: &Mesh) -> BrushStroke {
    let vertices = mesh.positions().len() as f64;
    // Area of the torus over its vertices, times those touched, is the area of the stroke: a rectangle of 2 r by 4 r with two half discs.
    let area = 4.0 * std::f64::consts::PI * std::f64::consts::PI * 0.4 * TOUCHED / vertices;
    let radius = (area / (8.0 + std::f64::consts::PI)).sqrt();
    let path = (-2..=2).map(|k| f64::from(k) * radius / 1.4).map(|angle| 1.4 * DVec3::new(angle.cos(), 0.0, angle.sin())).collect();
    BrushStroke { tool: Tool::Comb { toward: DVec3::new(0.0, -0.5, 0.3) }, path, radius: radius / mesh.diameter(), strength: 0.7 }
}

#[divan::bench(args = SIZES, sample_count = 20)]
fn stroke_of_2000_vertices(bencher: Bencher<'_, '_>, size: (u32, u32)) {
    let mesh = model(size);
    let (mut brush, stroke) = (Brush::on(&mesh), stroke(&mesh));
    let mut comb = Comb::new(&mesh, None, 0.0).unwrap();
    let touched = brush.apply(&stroke, &mut comb).unwrap().len();
    bencher.counter(ItemsCount::new(touched)).bench_local(|| brush.apply(&stroke, &mut comb).unwrap());
}

#[divan::bench(args = SIZES, sample_count = 3)]
fn brush_made(bencher: Bencher<'_, '_>, size: (u32, u32)) {
    let mesh = model(size);
    bencher.counter(ItemsCount::new(mesh.positions().len())).bench(|| Brush::on(&mesh));
}
