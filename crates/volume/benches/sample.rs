//! Strands sampled in a second, and pairs of a hair's piece and a texel: the time of a pair is the time over their number.

use divan::{Bencher, counter::ItemsCount};
use pelage_strand::{GrowSettings, StrandTile, grow};
use pelage_volume::{FinSettings, ShellSettings, sample_fin, sample_shells};

fn main() {
    divan::main();
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
    bencher.counter(ItemsCount::new(tile.strand_count())).bench(|| sample_shells(&tile, divan::black_box(&settings)));
}

/// The counter is (piece, texel) pairs at 128² in 16 layers, mips and encoding included.
#[divan::bench(args = [8, 16, 32, 64], sample_count = 5, sample_size = 1)]
fn pairs_by_layers(bencher: Bencher<'_, '_>, layers: u32) {
    let tile = coat();
    let settings = settings(128, layers);
    let pairs = sample_shells(&tile, &settings).map_or(0, |stack| stack.work.pairs);
    bencher.counter(ItemsCount::new(pairs)).bench(|| sample_shells(&tile, divan::black_box(&settings)));
}

/// The same on one thread: what a pair costs.
#[divan::bench(sample_count = 5, sample_size = 1)]
fn pairs_on_one_thread(bencher: Bencher<'_, '_>) {
    let tile = coat();
    let settings = settings(128, 16);
    let pairs = sample_shells(&tile, &settings).map_or(0, |stack| stack.work.pairs);
    let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(1).build() else { return };
    bencher.counter(ItemsCount::new(pairs)).bench(|| pool.install(|| sample_shells(&tile, divan::black_box(&settings))));
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn fin(bencher: Bencher<'_, '_>) {
    let tile = coat();
    bencher.bench(|| sample_fin(&tile, divan::black_box(&FinSettings::default())));
}
