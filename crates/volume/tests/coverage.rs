//! Sampled coverage against the definition, by many samples.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

#[path = "common/exact.rs"]
mod exact;

use exact::ExactLayer;
use pelage_strand::{GrowSettings, StrandSource, StrandTile, Style, Undercoat, grow};
use pelage_volume::{ShellSettings, sample_shells};

/// Root mean square, worst and mean difference over every texel of a layer that a few hairs touch.
fn error(settings: &GrowSettings, resolution: u32, layers: u32, layer: u32) -> (f64, f64, f64) {
    let hair = grow(settings).unwrap();
    let shells = ShellSettings { resolution, layers, ..ShellSettings::default() };
    let stack = sample_shells(&hair, &shells).unwrap();
    let spacing = hair.height() / f64::from(layers - 1);
    let exact = ExactLayer {
        height: spacing * f64::from(layer),
        core: spacing * shells.vertical_core,
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
                let (rms, worst, mean) = error(&settings, resolution, 16, layer);
                // The samples' own noise is about 0.01.
                assert!(
                    rms < 0.032 && worst < 0.12 && mean.abs() < 0.004,
                    "{name} at {resolution}, layer {layer}: rms {rms}, worst {worst}, mean {mean}"
                );
            }
        }
    }
}

/// The exact coverage of a texel of a tile that holds these hairs, from root to tip each, box 1 high, layer at 0.5 with spacing 0.1.
fn truth(hairs: &[([f64; 3], [f64; 3], f64)], resolution: u32, lateral: f64) -> impl Fn(u32, u32) -> f64 {
    let sources: Vec<StrandSource> = hairs
        .iter()
        .map(|&(root, tip, radius)| StrandSource {
            points: vec![root, tip],
            radii: vec![radius; 2],
            root_colour: [1.0; 3],
            tip_colour: [1.0; 3],
        })
        .collect();
    let tile = StrandTile::from_strands(1.0, &sources).unwrap();
    let layer = ExactLayer { height: 0.5, core: 0.05, vertical: 0.02, resolution, lateral };
    move |x, y| layer.coverage(&tile, x, y, 8192)
}

#[test]
fn the_truth_itself_is_what_geometry_says() {
    let whole = |at: &dyn Fn(u32, u32) -> f64| (0..32 * 32).map(|i| at(i % 32, i / 32)).sum::<f64>() / 1024.0;
    // Upright: the area of its disc. Leaning by 1: besides, the strip that its core and fading run sweep.
    let disc = std::f64::consts::PI * 0.05 * 0.05;
    let upright = whole(&truth(&[([0.4, 0.47, 0.0], [0.4, 0.47, 1.0], 0.05)], 32, 0.35));
    assert!((upright / disc - 1.0).abs() < 2e-3, "{upright} {disc}");
    let swept = disc + 2.0 * 0.05 * (2.0 * 0.05 + 0.02 * std::f64::consts::TAU.sqrt());
    let leaning = whole(&truth(&[([0.1, 0.47, 0.0], [1.1, 0.47, 1.0], 0.05)], 32, 0.35));
    assert!((leaning / swept - 1.0).abs() < 2e-3, "{leaning} {swept}");
    // At the rim of hair much wider than a texel: the mean over the box of Φ, by the midpoint rule. The rim stands at 460.8 texels of 512.
    let rim = truth(&[([0.5, 0.5 + 0.5 / 512.0, 0.0], [0.5, 0.5 + 0.5 / 512.0, 1.0], 0.4)], 512, 0.35);
    for x in 459..463 {
        let inside = |at: f64| 0.5 * (1.0 + libm::erf((460.8 - at) / (0.35 * std::f64::consts::SQRT_2)));
        let wanted = (0..1000).map(|i| inside(f64::from(x) + (f64::from(i) + 0.5) / 1000.0)).sum::<f64>() / 1000.0;
        assert!((rim(x, 256) - wanted).abs() < 5e-3, "{x}: {} {wanted}", rim(x, 256));
    }
    // Hair on hair is one hair, hair beside hair two.
    let one = ([0.3, 0.3, 0.0], [0.3, 0.3, 1.0], 0.05);
    let twice = whole(&truth(&[one, one], 32, 0.35));
    assert!((twice / disc - 1.0).abs() < 2e-3);
    let beside = whole(&truth(&[one, ([0.7, 0.7, 0.0], [0.7, 0.7, 1.0], 0.05)], 32, 0.35));
    assert!((beside / (2.0 * disc) - 1.0).abs() < 2e-3);
}
