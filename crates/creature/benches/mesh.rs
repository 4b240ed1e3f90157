//! Faces of a creature in a second, beside a floor: as many evaluations of the same field as the mesh has vertices.
//!
//! Besides the table of `divan`, each size prints the ratio of the least times, measured turn and turn about, since machines drift; and how clean the mesh is.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a benchmark prints, and its input is its own")]

use std::hint::black_box;
use std::time::{Duration, Instant};

use pelage_creature::{Creature, Species};

const SIZES: [u32; 4] = [5_000, 60_000, 250_000, 1_000_000];

fn main() {
    println!("a cat of so many faces, against an evaluation of its field at each vertex (least times)");
    for faces in SIZES {
        print_ratio(faces);
    }
    println!();
    divan::main();
}

fn print_ratio(faces: u32) {
    let (mut make, mut floor) = (Duration::MAX, Duration::MAX);
    let creature = Creature::new(&Species::Cat.plan(), faces).unwrap();
    for _ in 0..(300_000 / faces).clamp(1, 7) {
        make = make.min(time(|| Creature::new(&Species::Cat.plan(), faces).unwrap()));
        floor = floor.min(time(|| creature.mesh().positions().iter().map(|&p| creature.field(p)).sum::<f64>()));
    }
    let angles = creature.mesh().faces().map(|face| face.angles().into_iter().fold(f64::INFINITY, f64::min));
    let least = angles.fold(f64::INFINITY, f64::min).to_degrees();
    let (seconds, ratio) = (make.as_secs_f64(), make.as_secs_f64() / floor.as_secs_f64());
    let per_face = seconds * 1e6 / f64::from(faces);
    println!("  {faces:>9} faces: {seconds:7.3} s, {per_face:6.2} µs a face, {ratio:5.0} times the floor; least angle {least:.1}°");
}

fn time<T>(work: impl FnOnce() -> T) -> Duration {
    let start = Instant::now();
    black_box(work());
    start.elapsed()
}

#[divan::bench(args = [5_000, 60_000, 250_000], sample_count = 5)]
fn cat(bencher: divan::Bencher<'_, '_>, faces: u32) {
    bencher.counter(divan::counter::ItemsCount::new(faces)).bench(|| Creature::new(&Species::Cat.plan(), faces).unwrap());
}
