//! Sampled coverage against the definition, by many samples.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

#[path = "common/exact.rs"]
mod exact;

use exact::ExactLayer;
use pelage_strand::{GrowSettings, Style, Undercoat, grow};
use pelage_volume::{ShellSettings, sample_shells};

/// Root mean square, worst and mean difference over every texel of a layer that a few hairs touch.
fn error(settings: &GrowSettings, resolution: u32, layers: u32, layer: u32) -> (f64, f64, f64) {
    let hair = grow(settings).unwrap();
    let shells = ShellSettings { resolution, layers, ..ShellSettings::default() };
    let stack = sample_shells(&hair, &shells).unwrap();
    let spacing = hair.height() / f64::from(layers - 1);
    let exact = ExactLayer {
        height: spacing * f64::from(layer),
        vertical: spacing * shells.vertical_sigma,
        resolution,
        lateral: shells.lateral_sigma,
    };
    let mut errors = Vec::new();
    for i in 0..resolution * resolution {
        let (x, y) = (i % resolution, i / resolution);
        let sampled = f64::from(stack.mips[0].texel(layer, x, y).unwrap()[3]) / 255.0;
        let truth = exact.coverage(&hair, x, y, 256);
        if sampled > 0.0 || truth > 1.0 / 255.0 {
            errors.push(sampled - truth);
        }
    }
    assert!(errors.len() > 10);
    let count = errors.len() as f64;
    let rms = (errors.iter().map(|e| e * e).sum::<f64>() / count).sqrt();
    (rms, errors.iter().fold(0.0, |worst: f64, e| worst.max(e.abs())), errors.iter().sum::<f64>() / count)
}

#[test]
fn sampled_coverage_is_the_expected_one() {
    let bare = Undercoat { count: 0, ..Undercoat::default() };
    let few = GrowSettings { count: 4, undercoat: bare, ..GrowSettings::default() };
    let kinds = [
        ("upright", GrowSettings { lean: 0.0, style: Style::Straight, wander: 0.0, splay: 0.0, gravity: 0.0, ..few }),
        ("leaning", GrowSettings { lean: 40.0, style: Style::Straight, ..few }),
        ("wavy", few),
        ("thin", GrowSettings { thickness: 0.003, ..few }),
    ];
    for (name, settings) in kinds {
        for resolution in [32, 64, 128] {
            for layer in [4, 9] {
                // Upright hair that tapers within the slab is taken by its section at the layer: too thin by up to 2 %.
                let (rms, worst, mean) = error(&settings, resolution, 16, layer);
                assert!(
                    rms < 0.04 && worst < 0.15 && mean.abs() < 0.02,
                    "{name} at {resolution}, layer {layer}: rms {rms}, worst {worst}, mean {mean}"
                );
            }
        }
    }
}
