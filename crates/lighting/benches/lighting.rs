//! The formula beside the table, a million samples' worth a line.
#![allow(clippy::print_stdout, reason = "a benchmark prints")]

use pelage_lighting::{HairLighting, LightingTable, TableLayout};

const SAMPLES: usize = 10_000;

fn main() {
    divan::main();
}

fn cosines() -> impl Iterator<Item = (f64, f64)> {
    (0..SAMPLES).map(|i| (i as f64 / SAMPLES as f64 * 2.0 - 1.0, (i as f64 * 0.618_034).fract() * 2.0 - 1.0))
}

#[divan::bench]
fn exact() -> f64 {
    let lighting = HairLighting::default();
    cosines().map(|(u, v)| lighting.diffuse_factor(u) + lighting.specular_factor(v)).sum()
}

#[divan::bench]
fn table(bencher: divan::Bencher<'_, '_>) {
    let Ok(table) = LightingTable::new(&HairLighting::default(), TableLayout::default()) else { return };
    bencher.bench(|| {
        cosines()
            .map(|(u, v)| {
                let (diffuse, specular) = table.look_up(u, v);
                diffuse + specular
            })
            .sum::<f64>()
    });
}
