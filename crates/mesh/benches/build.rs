//! Index list → half-edges, beside a sort of the same edge keys: the floor that any such structure stands on.
//!
//! Besides the table of `divan`, each size prints the ratio of the least times, measured turn and turn about, since machines drift.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a benchmark prints, and its input is its own")]

mod common;

use pelage_mesh::{Mesh, Topology, torus};
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64Mcg;

/// Segments of tori with 5,000, 100,000 and 1,000,000 faces.
const SIZES: [(u32, u32); 3] = [(50, 50), (250, 200), (1000, 500)];

struct Input {
    vertex_count: usize,
    triangles: Vec<[u32; 3]>,
}

impl Input {
    fn torus((major, minor): (u32, u32)) -> Self {
        let mesh = torus(1.0, 0.4, major, minor).unwrap();
        Self { vertex_count: mesh.topology().vertex_count(), triangles: mesh.topology().triangles().collect() }
    }

    /// Faces in random order: the worst a file can do to the caches.
    fn shuffled(size: (u32, u32)) -> Self {
        let mut input = Self::torus(size);
        input.triangles.shuffle(&mut Pcg64Mcg::seed_from_u64(1));
        input
    }

    fn keys(&self) -> Vec<u64> {
        let edges = self.triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
        edges.map(|(a, b)| u64::from(a.min(b)) << 32 | u64::from(a.max(b))).collect()
    }

    fn build(&self) -> Topology {
        Topology::from_triangles(self.vertex_count, &self.triangles).unwrap()
    }
}

fn main() {
    println!("half-edges from an index list, against one sort of the same keys (the least of several times on a core, ns a face)");
    for (name, make) in [("in order", Input::torus as fn(_) -> _), ("shuffled", Input::shuffled)] {
        let times = SIZES.map(|size| print_ratio(name, &make(size)));
        println!("            {name}: a face of the largest takes {:.2} times as long as one of the least", times[2] / times[0]);
    }
    println!();
    divan::main();
}

/// Prints the figures of one input; gives the time of a face.
fn print_ratio(name: &str, input: &Input) -> f64 {
    let keys = input.keys();
    let faces = input.triangles.len();
    let rounds = (3_000_000 / faces).clamp(7, 301);
    let mut sorted = keys.clone();
    let sort = || {
        sorted.copy_from_slice(&keys);
        sorted.sort_unstable();
    };
    let [build, sort] = common::least(rounds, faces, || input.build(), sort);
    println!("  {faces:>9} faces {name}: {build:6.1}, sort {sort:6.1}, ratio {:.2}", build / sort);
    build
}

#[divan::bench(args = SIZES)]
fn half_edges(bencher: divan::Bencher<'_, '_>, size: (u32, u32)) {
    let input = Input::torus(size);
    bencher.counter(divan::counter::ItemsCount::new(input.triangles.len())).bench(|| input.build());
}

#[divan::bench(args = SIZES)]
fn sorted_keys(bencher: divan::Bencher<'_, '_>, size: (u32, u32)) {
    let input = Input::torus(size);
    let keys = input.keys();
    bencher.counter(divan::counter::ItemsCount::new(input.triangles.len())).with_inputs(|| keys.clone()).bench_values(|mut keys| {
        keys.sort_unstable();
        keys
    });
}

#[divan::bench(args = SIZES)]
fn vertex_normals(bencher: divan::Bencher<'_, '_>, (major, minor): (u32, u32)) {
    let mesh: Mesh = torus(1.0, 0.4, major, minor).unwrap();
    bencher.counter(divan::counter::ItemsCount::new(mesh.topology().face_count())).bench(|| mesh.vertex_normals());
}
