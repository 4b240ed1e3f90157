//! Strands grown in a second, by their number; then what a point of a strand costs beside a floor measured in the same run.
#![allow(clippy::print_stdout, reason = "a benchmark prints")]

use divan::{Bencher, black_box, counter::ItemsCount};
use pelage_strand::{Amounts, ByNoise, Gather, GrowSettings, Guide, Offset, StrandTile, Style, TileNoise, Undercoat, grow, guided};
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

/// Each type, guard hairs alone.
#[divan::bench(args = ["straight", "woolly", "spiky", "varied"], sample_count = 5, sample_size = 1)]
fn types(bencher: Bencher<'_, '_>, kind: &str) {
    let plain = GrowSettings {
        count: 4000,
        style: Style::Straight,
        undercoat: Undercoat { count: 0, ..Undercoat::default() },
        ..GrowSettings::default()
    };
    let amounts = Amounts { length: 0.5, thickness: 0.5, colour: 0.5, tip: 0.5, bend: 0.5 };
    let settings = match kind {
        "woolly" => GrowSettings { style: Style::Woolly { radius: 0.1, turns: 3.0, irregularity: 0.7 }, ..plain },
        "spiky" => GrowSettings { gather: Gather::Spiky { strength: 0.9, offset: Offset::Sine }, ..plain },
        "varied" => GrowSettings { by_noise: ByNoise { cells: 4, amounts }, ..plain },
        _ => plain,
    };
    bencher.counter(ItemsCount::new(settings.count)).bench(|| grow(black_box(&settings)));
}

/// The default coat bent along guides; the counter is strands.
#[divan::bench(args = [4, 64, 1024], sample_count = 5, sample_size = 1)]
fn guides(bencher: Bencher<'_, '_>, count: u32) {
    let tile = grow(&GrowSettings::default()).unwrap_or_else(|_| StrandTile::empty(0.35));
    let place = |k: u32| [0.618_034 * f64::from(k), 0.754_878 * f64::from(k)];
    let guides: Vec<Guide> = (0..count).map(|k| Guide { root: place(k), points: vec![[0.2, 0.1, 0.5], [0.5, 0.0, 0.8]] }).collect();
    bencher.counter(ItemsCount::new(tile.strand_count())).bench(|| guided(black_box(&tile), &guides));
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
