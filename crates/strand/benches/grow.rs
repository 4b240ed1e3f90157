//! Strands grown in a second, by their number.

use divan::{Bencher, counter::ItemsCount};
use pelage_strand::{GrowSettings, Undercoat, grow};

fn main() {
    divan::main();
}

#[divan::bench(args = [1_000, 4_000, 16_000], sample_count = 5, sample_size = 1)]
fn strands(bencher: Bencher<'_, '_>, count: u32) {
    let settings = GrowSettings { count, undercoat: Undercoat { count: 0, ..Undercoat::default() }, ..GrowSettings::default() };
    bencher.counter(ItemsCount::new(count)).bench(|| grow(divan::black_box(&settings)));
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn default_coat(bencher: Bencher<'_, '_>) {
    let settings = GrowSettings::default();
    bencher.counter(ItemsCount::new(settings.strand_count())).bench(|| grow(divan::black_box(&settings)));
}
