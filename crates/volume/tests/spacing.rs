//! What uneven heights promise.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use pelage_strand::{GrowSettings, StrandSource, StrandTile, Undercoat, grow};
use pelage_volume::{ShellSettings, ShellStack, Spacing, sample_shells};

const SPACINGS: [Spacing; 4] = [Spacing::Power(2.0), Spacing::Power(0.5), Spacing::Exponential(2.0), Spacing::Exponential(-2.0)];

fn leaning() -> StrandTile {
    let hair = StrandSource {
        points: vec![[0.1, 0.5, 0.0], [0.85, 0.5, 1.0]],
        radii: vec![0.03; 2],
        root_colour: [0.2, 0.4, 0.6],
        tip_colour: [0.8, 0.4, 0.1],
    };
    StrandTile::from_strands(1.0, &[hair]).unwrap()
}

/// Each core begins where the one before ends, so no gap and no shell twice: along the hair the layers together cover it once, wherever they stand.
#[test]
fn slanted_hair_is_whole_at_uneven_heights() {
    for spacing in SPACINGS.into_iter().chain([Spacing::Even]) {
        let stack = sample_shells(&leaning(), &ShellSettings { layers: 9, resolution: 64, spacing, ..ShellSettings::default() }).unwrap();
        let seen = stack.seen_from_above(0, false).unwrap();
        // The hair's axis, but for the part that the skin's own layer shows and the last half of the outermost.
        let first = 0.1 + 0.75 * 0.5 * spacing.height(1.0 / 8.0);
        let axis = (0..64).map(|x| (f64::from(x) + 0.5) / 64.0).filter(|x| (first + 0.04..0.83).contains(x));
        for x in axis {
            let alpha = seen[32 * 64 + (x * 64.0) as usize][3];
            assert!(alpha > 0.95, "{spacing:?} at {x}: {alpha}");
        }
    }
}

/// A layer holds the run of hair from half way to the layer below to half way to that above, and its filter's tails: mass by hand.
#[test]
fn each_layer_holds_what_lies_around_it() {
    let settings = ShellSettings { layers: 9, resolution: 64, ..ShellSettings::default() };
    for spacing in SPACINGS {
        let stack = sample_shells(&leaning(), &ShellSettings { spacing, ..settings }).unwrap();
        let heights = spacing.heights(9);
        for layer in 2..7 {
            let reach = 0.5 * (heights[layer + 1] - heights[layer - 1]);
            let weight = 2.0 * settings.vertical_core + settings.vertical_sigma * std::f64::consts::TAU.sqrt();
            let wanted = 2.0 * 0.03 * 0.75 * reach * weight + std::f64::consts::PI * 0.03 * 0.03;
            let covered = stack.mips[0].mean_coverage(layer as u32);
            assert!((covered / wanted - 1.0).abs() < 0.015, "{spacing:?}, layer {layer}: {covered} of {wanted}");
        }
        assert!(stack.levels[0].iter().all(|shell| shell.layers == 1.0 && shell.opacity == 1.0));
        let stand: Vec<f32> = stack.levels[0].iter().map(|shell| shell.height).collect();
        assert_eq!(stand, heights.iter().map(|&h| h as f32).collect::<Vec<_>>());
    }
}

/// Sampled anew, light passes as it does with even layers, and nothing is corrected afterwards.
#[test]
fn light_passes_uneven_layers_as_it_does_even_ones() {
    let hair =
        grow(&GrowSettings { count: 700, undercoat: Undercoat { count: 0, ..Undercoat::default() }, ..GrowSettings::default() }).unwrap();
    let through = |spacing: Spacing, slope: f64| {
        let stack = sample_shells(&hair, &ShellSettings { spacing, layers: 24, ..ShellSettings::default() }).unwrap();
        stack.transmittance(0, [slope, 0.0]).unwrap()
    };
    for slope in [0.0, 1.0] {
        let even = through(Spacing::Even, slope);
        for spacing in [Spacing::Power(1.5), Spacing::Exponential(1.0)] {
            let uneven = through(spacing, slope);
            assert!((uneven - even).abs() < 0.03, "{spacing:?} at {slope}: {uneven} of {even}");
        }
    }
}

#[test]
fn the_colour_of_a_layer_is_the_hairs_at_its_height() {
    for spacing in SPACINGS {
        let settings = ShellSettings { layers: 9, resolution: 64, spacing, ..ShellSettings::default() };
        let stack = sample_shells(&leaning(), &settings).unwrap();
        for layer in [2usize, 5, 7] {
            let height = spacing.heights(9)[layer];
            let (x, wanted) = (0.1 + 0.75 * height, 0.2 + 0.6 * height);
            let texel = stack.mips[0].texel(layer as u32, (x * 64.0) as u32, 32).unwrap();
            let red = f64::from(pelage_volume::srgb_to_linear(texel[0])) * 255.0 / f64::from(texel[3]);
            assert!((red - wanted).abs() < 0.01, "{spacing:?}, layer {layer}: {red} of {wanted}");
        }
    }
}

#[test]
fn one_even_spacing_is_another() {
    let hair = leaning();
    let stack = |spacing: Spacing| sample_shells(&hair, &ShellSettings { spacing, resolution: 64, ..ShellSettings::default() }).unwrap();
    let even = stack(Spacing::Even);
    for other in [Spacing::Power(1.0), Spacing::Exponential(1e-6)] {
        let alphas = |stack: &ShellStack| stack.mips[0].texels.iter().skip(3).step_by(4).copied().collect::<Vec<u8>>();
        let far = alphas(&stack(other)).iter().zip(&alphas(&even)).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(far <= Some(1), "{other:?}: {far:?}");
    }
}
