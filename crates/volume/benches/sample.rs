//! Strands sampled in a second, and pairs of a hair's piece and a texel: the time of a pair is the time over their number; then pairs beside floors measured
//! in the same run.
#![allow(clippy::print_stdout, reason = "a benchmark prints")]

use divan::{Bencher, black_box, counter::ItemsCount};
use pelage_strand::{GrowSettings, StrandTile, Undercoat, grow};
use pelage_volume::{FinSettings, ShellSettings, sample_fin, sample_shells};
use std::time::Instant;

fn main() {
    divan::main();
    ratios();
}

/// The default coat, bare of panics: an empty box if it would not grow.
fn coat() -> StrandTile {
    grow(&GrowSettings::default()).unwrap_or_else(|_| StrandTile::empty(0.35))
}

fn settings(resolution: u32, layers: u32) -> ShellSettings {
    ShellSettings { resolution, layers, ..ShellSettings::default() }
}

/// The counter is strands: 16 layers of all of them.
#[divan::bench(args = [32, 64, 128, 256, 512], sample_count = 5, sample_size = 1)]
fn strands_by_resolution(bencher: Bencher<'_, '_>, resolution: u32) {
    let tile = coat();
    let settings = settings(resolution, 16);
    bencher.counter(ItemsCount::new(tile.strand_count())).bench(|| sample_shells(&tile, black_box(&settings)));
}

/// The counter is (piece, texel) pairs at 128², mips and encoding included.
#[divan::bench(args = [8, 16, 32, 64], sample_count = 5, sample_size = 1)]
fn pairs_by_layers(bencher: Bencher<'_, '_>, layers: u32) {
    let tile = coat();
    let settings = settings(128, layers);
    let pairs = sample_shells(&tile, &settings).map_or(0, |stack| stack.work.pairs);
    bencher.counter(ItemsCount::new(pairs)).bench(|| sample_shells(&tile, black_box(&settings)));
}

/// A hundred thousand strands, grown and sampled into 16 layers of 256²; the counter is strands.
#[divan::bench(sample_count = 1, sample_size = 1)]
fn a_hundred_thousand_grown_and_sampled(bencher: Bencher<'_, '_>) {
    let count = 100_000;
    let settings =
        GrowSettings { count, thickness: 0.0015, undercoat: Undercoat { count: 0, ..Undercoat::default() }, ..GrowSettings::default() };
    bencher.counter(ItemsCount::new(count)).bench(|| {
        grow(black_box(&settings))
            .ok()
            .and_then(|tile| sample_shells(&tile, &ShellSettings { resolution: 256, ..ShellSettings::default() }).ok())
    });
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn fin(bencher: Bencher<'_, '_>) {
    let tile = coat();
    bencher.bench(|| sample_fin(&tile, black_box(&FinSettings::default())));
}

/// The best of five on one thread, in nanoseconds an item.
fn best(items: u64, mut work: impl FnMut() + Send) -> f64 {
    let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(1).build() else { return f64::NAN };
    let time = (0..5).fold(f64::INFINITY, |best, _| {
        let start = Instant::now();
        pool.install(&mut work);
        best.min(start.elapsed().as_nanos() as f64)
    });
    time / items.max(1) as f64
}

/// All of a stack's time by the pair, on one thread, beside adding a number to a texel and beside one erf for each pair.
fn ratios() {
    let tile = coat();
    println!(
        "\non one thread, ns a (piece, texel) pair, everything included; a pair holds four erf across and along, and a bell where hair fades"
    );
    for (resolution, layers) in [(128, 16), (128, 64), (256, 16)] {
        let settings = settings(resolution, layers);
        let pairs = sample_shells(&tile, &settings).map_or(0, |stack| stack.work.pairs);
        let ours = best(pairs, || {
            black_box(sample_shells(&tile, black_box(&settings)).is_ok());
        });
        let mut texels = vec![0.0f32; (resolution * resolution) as usize];
        let add = best(pairs, || {
            let mut left = pairs as usize;
            while left > 0 {
                let some = left.min(texels.len());
                texels[..some].iter_mut().zip(1u32..).for_each(|(texel, i)| *texel += i as f32);
                black_box(&mut texels);
                left -= some;
            }
        });
        let erf = best(pairs, || {
            black_box((0..pairs).map(|i| libm::erff((i % 1024) as f32 * (1.0 / 256.0) - 2.0)).sum::<f32>());
        });
        println!(
            "{layers} × {resolution}²: {pairs} pairs, {ours:.1} ns; adding to a texel {add:.2} ns, {:.0} times less; one erf {erf:.1} ns, ours {:.1} times that",
            ours / add,
            ours / erf
        );
    }
}
