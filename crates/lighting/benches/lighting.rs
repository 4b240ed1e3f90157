//! The formula beside the table, the whole formula for one and for four lights, and the projection of an environment.
#![allow(clippy::print_stdout, reason = "a benchmark prints")]

use glam::DVec3;
use pelage_lighting::{
    DirectionalLight, Environment, HairLighting, HairPoint, Illumination, Irradiance, LightingTable, Shading, TableLayout,
};

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

#[divan::bench(args = [1, 4])]
fn lights(bencher: divan::Bencher<'_, '_>, count: usize) {
    let light = |k: usize| DirectionalLight { direction: DVec3::new(0.6, 0.8, k as f64 * 0.1).normalize_or_zero(), colour: DVec3::ONE };
    let ambient = Irradiance::hemisphere(DVec3::ONE, DVec3::splat(0.2));
    let illumination = Illumination { lights: (0..count).map(light).collect(), ambient };
    let shading = Shading::default();
    bencher.bench(|| {
        let shade = |(x, y): (f64, f64)| {
            let direction = DVec3::new(x, y, 0.5).normalize_or_zero();
            shading.shade(&illumination, DVec3::Z, &HairPoint { direction, normal: DVec3::Y, height: 0.5 })
        };
        cosines().map(shade).sum::<DVec3>()
    });
}

#[divan::bench]
fn environment_of_1024_by_512(bencher: divan::Bencher<'_, '_>) {
    let Ok(environment) = Environment::new(1024, 512, vec![[0.5; 3]; 1024 * 512]) else { return };
    bencher.bench(|| environment.irradiance());
}
