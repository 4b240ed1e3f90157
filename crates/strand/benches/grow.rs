//! Strands grown in a second, by their number; then what a point of a strand costs beside a floor measured in the same run.
#![allow(clippy::print_stdout, reason = "a benchmark prints")]

use divan::{Bencher, black_box, counter::ItemsCount};
use pelage_strand::{GrowSettings, TileNoise, Undercoat, grow};
use std::time::Instant;

fn main() {
    divan::main();
    ratios();
}

#[divan::bench(args = [1_000, 4_000, 16_000], sample_count = 5, sample_size = 1)]
fn strands(bencher: Bencher<'_, '_>, count: u32) {
    let settings = GrowSettings { count, undercoat: Undercoat { count: 0, ..Undercoat::default() }, ..GrowSettings::default() };
    bencher.counter(ItemsCount::new(count)).bench(|| grow(black_box(&settings)));
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn default_coat(bencher: Bencher<'_, '_>) {
    let settings = GrowSettings::default();
    bencher.counter(ItemsCount::new(settings.strand_count())).bench(|| grow(black_box(&settings)));
}

/// The best of five, in nanoseconds.
fn best(mut work: impl FnMut()) -> f64 {
    (0..5).fold(f64::INFINITY, |best, _| {
        let start = Instant::now();
        work();
        best.min(start.elapsed().as_nanos() as f64)
    })
}

/// The floor is the least that any growth with wander asks of a point: two values of noise, once.
fn ratios() {
    let settings = GrowSettings::default();
    let points = grow(&settings).map_or(0, |tile| tile.point_count());
    let noise = TileNoise::new(7, 5);
    let growth = best(|| {
        black_box(grow(black_box(&settings)).is_ok());
    });
    let floor = best(|| {
        let sum: f64 = (0..points).map(|i| i as f64).flat_map(|i| noise.sideways(i * 0.618, i * 0.755, i * 0.3)).sum();
        black_box(sum);
    });
    println!(
        "\ndefault coat: {:.0} strands a second, {:.0} ns a point",
        settings.strand_count() as f64 / growth * 1e9,
        growth / points as f64
    );
    println!(
        "floor, two values of noise a point once, on one thread: {:.0} ns a point; growth, up to six times over, takes {:.1} times that",
        floor / points as f64,
        growth / floor
    );
}
