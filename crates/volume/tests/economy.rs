//! What sharing images and keeping only one of them promise.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test that cannot go on fails, and says what it measured")]

use pelage_strand::{GrowSettings, StrandTile, Style, Undercoat, grow};
use pelage_volume::{Image, OneLayerFit, Shell, ShellSettings, ShellStack, Spacing, VolumeError, Work, sample_shells};

const SIDE: u32 = 16;

fn bare() -> Undercoat {
    Undercoat { count: 0, ..Undercoat::default() }
}

/// Straight, upright, all as long and as thick.
fn straight() -> GrowSettings {
    let upright = GrowSettings {
        style: Style::Straight,
        lean: 0.0,
        splay: 0.0,
        gravity: 0.0,
        wander: 0.0,
        separation: 0.0,
        ..GrowSettings::default()
    };
    GrowSettings {
        clump: 0.0,
        count: 300,
        length_variation: 0.0,
        tip_thickness: 1.0,
        colour_variation: 0.0,
        tip_colour: GrowSettings::default().root_colour,
        undercoat: bare(),
        ..upright
    }
}

fn sampled(settings: &GrowSettings, layers: u32) -> ShellStack {
    sample_shells(&grow(settings).unwrap(), &ShellSettings { layers, resolution: 64, ..ShellSettings::default() }).unwrap()
}

/// A stack by hand: alpha of a texel of an image by a rule, grey.
fn stack(layers: u32, alpha: impl Fn(u32, u32) -> u8) -> ShellStack {
    let texels = (0..layers).flat_map(|k| (0..SIDE * SIDE).map(move |i| (k, i)));
    let bytes = texels.flat_map(|(k, i)| if k == 0 { [90, 90, 90, 255] } else { [0, 0, 0, alpha(k, i)] }).collect();
    let heights = Spacing::Even.heights(layers);
    ShellStack {
        height: 1.0,
        mips: vec![Image { width: SIDE, height: SIDE, layers, texels: bytes }],
        levels: vec![(0..layers).map(|k| Shell::plain(heights[k as usize] as f32, k)).collect()],
        directions: None,
        work: Work::default(),
    }
}

fn alpha(stack: &ShellStack, image: u32, texel: u32) -> f64 {
    f64::from(stack.mips[0].texel(image, texel % SIDE, texel / SIDE).unwrap()[3]) / 255.0
}

fn noise(k: u32, i: u32) -> u8 {
    // Weyl's sequence: no two layers alike.
    ((k * 97 + i * 151 + k * i * 13) % 251) as u8
}

#[test]
fn shells_that_share_an_image_together_cover_what_it_does() {
    let source = stack(20, noise);
    for spacing in [Spacing::Even, Spacing::Power(1.3), Spacing::Exponential(0.7)] {
        let shared = source.shared(60, spacing).unwrap();
        assert_eq!((shared.layers(), shared.images()), (60, 20));
        assert_eq!(
            shared.levels[0].iter().map(|shell| shell.height).collect::<Vec<_>>(),
            spacing.heights(60).iter().map(|&h| h as f32).collect::<Vec<_>>()
        );
        for image in 1..20 {
            let column: Vec<&Shell> = shared.levels[0].iter().filter(|shell| shell.image == image).collect();
            assert!(!column.is_empty());
            for texel in 0..SIDE * SIDE {
                let own = alpha(&shared, image, texel);
                let open: f64 = column.iter().map(|shell| 1.0 - f64::from(shell.covers(own as f32))).product();
                assert!((1.0 - open - own).abs() < 2e-6, "{spacing:?}, image {image}, texel {texel}: {} of {own}", 1.0 - open);
            }
        }
        // So the whole passes what it did.
        let [before, after] = [&source, &shared].map(|stack| stack.transmittance(0, [0.0, 0.0]).unwrap());
        assert!((before - after).abs() < 1e-6, "{before} {after}");
    }
}

/// The row "Shells" of the numbers at their extremes: α = 0.3 in any number of layers keeps 0.9967.
#[test]
fn any_number_of_shells_passes_the_same_light() {
    // 77/255: sixteen layers above the skin.
    let source = stack(17, |_, _| 77);
    let wanted = (1.0f64 - 77.0 / 255.0).powi(16);
    assert!((1.0 - wanted - 0.9967).abs() < 3e-4);
    let mut most = 0.0_f64;
    for spacing in [Spacing::Even, Spacing::Power(3.0), Spacing::Exponential(4.0), Spacing::Exponential(-3.0)] {
        for shells in [2, 3, 5, 16, 17, 18, 60, 256] {
            let shared = source.shared(shells, spacing).unwrap();
            let layers: f32 = shared.levels[0][1..].iter().map(|shell| shell.layers).sum();
            assert!((layers - 16.0).abs() < 1e-3, "{spacing:?}, {shells}: {layers}");
            let passes = shared.transmittance(0, [0.0, 0.0]).unwrap();
            assert!((passes - wanted).abs() < 1e-5, "{spacing:?}, {shells}: {passes} of {wanted}");
            most = most.max((passes - wanted).abs());
            assert!(shared.images() <= shells.min(17) && shared.byte_size() == (4 * SIDE * SIDE * shared.images()) as usize);
        }
    }
    println!("reached: {:.4} kept within {most:.0e} by 1 to 255 shells over the skin", 1.0 - wanted);
}

/// Sampled anew, no shell is corrected; and shared twice, hair is as dense as shared once.
#[test]
fn nothing_is_corrected_twice() {
    let hair = grow(&GrowSettings { count: 400, undercoat: bare(), ..GrowSettings::default() }).unwrap();
    let anew = |layers: u32| sample_shells(&hair, &ShellSettings { layers, resolution: 64, ..ShellSettings::default() }).unwrap();
    for layers in [10, 30] {
        assert!(anew(layers).levels[0].iter().all(|shell| shell.layers == 1.0));
    }
    let (ten, thirty) = (anew(10), anew(30));
    let shared = ten.shared(30, Spacing::Even).unwrap();
    let passes = |stack: &ShellStack| stack.transmittance(0, [0.0, 0.0]).unwrap();
    assert!((passes(&shared) - passes(&ten)).abs() < 1e-6);
    // Each image shown whole three times passes the third power.
    let (repeated, one) = (passes(&shared.clone().repeated()), passes(&ten));
    assert!(repeated < 0.5 * one && repeated >= one.powi(3), "{repeated} {one}");
    // The strands' own answer for 30 layers is near, without a correction; a third of a layer each would pass 0.64.
    assert!((passes(&thirty) - passes(&ten)).abs() < 0.12, "{} {}", passes(&thirty), passes(&ten));
    let twice = stack(9, |_, _| 60).shared(33, Spacing::Even).unwrap().shared(12, Spacing::Even).unwrap();
    let sum: f32 = twice.levels[0][1..].iter().map(|shell| shell.layers).sum();
    assert!((sum - 8.0).abs() < 1e-4, "{sum}");
}

#[test]
fn shared_stacks_have_levels_of_detail_with_few_images() {
    let shared = stack(5, noise).shared(33, Spacing::Even).unwrap().with_levels().unwrap();
    assert_eq!(shared.levels.iter().map(Vec::len).collect::<Vec<_>>(), [33, 17, 9, 5, 3, 2, 1]);
    assert!(shared.images() < 5 + 2 * 7 + 4, "{}", shared.images());
    let passes = |level: usize| -> f64 {
        let seen = shared.seen_at(level, 0, true).unwrap();
        seen.iter().map(|texel| f64::from(texel[0])).sum::<f64>() / seen.len() as f64
    };
    for level in 1..7 {
        assert!((passes(level) - passes(0)).abs() < 0.004, "{level}: {} of {}", passes(level), passes(0));
    }
}

#[test]
fn upright_hair_without_taper_is_one_image() {
    let stack = sampled(&straight(), 16);
    let fit = OneLayerFit::of(&stack).unwrap();
    // The tips' own layer stands at their very end and holds all of it, so the ramp is flat.
    assert!(fit.ramp.iter().all(|&o| o > 0.99), "{:?}", fit.ramp);
    assert!(fit.unlikeness < 0.01 && fit.alpha_largest < 1.5 / 255.0, "{fit:?}", fit = (fit.unlikeness, fit.alpha_largest));
    let one = fit.stack(&stack);
    assert_eq!((one.images(), one.layers(), one.byte_size()), (2, 16, 2 * 4 * 5461));
    assert!(one.levels[0][1..].iter().all(|shell| shell.image == 1 && shell.layers == 1.0));
    let (before, after) = (stack.seen_from_above(0, true).unwrap(), one.seen_from_above(0, true).unwrap());
    let worst = before.iter().flatten().zip(after.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(worst < 0.05, "{worst}");
}

/// Layers that are an image times a ramp by construction: the ramp comes back, and nothing is left over.
#[test]
fn a_ramp_is_found_again() {
    let ramp = |k: u32| f64::from(16 - k) / 15.0;
    let source = stack(16, |k, i| (f64::from(noise(1, i)) * ramp(k)).round() as u8);
    let fit = OneLayerFit::of(&source).unwrap();
    assert!((1..16).all(|k| (fit.ramp[k as usize - 1] - ramp(k)).abs() < 0.003), "{:?}", fit.ramp);
    assert!(fit.alpha_largest < 1.01 / 255.0 && fit.alpha_rms < 0.4 / 255.0, "{} {}", fit.alpha_largest, fit.alpha_rms);
    // Each shell, as it is drawn, is the layer it stands for.
    let one = fit.stack(&source);
    for (k, shell) in (1u32..).zip(&one.levels[0][1..]) {
        for texel in 0..SIDE * SIDE {
            let (drawn, own) = (f64::from(shell.covers(alpha(&one, 1, texel) as f32)), alpha(&source, k, texel));
            assert!((drawn - own).abs() < 2.0 / 255.0, "shell {k}, texel {texel}: {drawn} of {own}");
        }
    }
}

/// Shells of it that are made one show the same image, within what a ramp's shells merged err by; only skins are new.
#[test]
fn one_layer_has_levels_of_detail() {
    let source = stack(16, |k, i| (f64::from(noise(1, i)) * f64::from(16 - k) / 15.0).round() as u8);
    let one = OneLayerFit::of(&source).unwrap().stack(&source).with_levels().unwrap();
    assert_eq!(one.levels.iter().map(Vec::len).collect::<Vec<_>>(), [16, 8, 4, 2, 1]);
    assert_eq!(one.images(), 2 + 4);
    for level in 1..4usize {
        assert!(one.levels[level][1..].iter().all(|shell| shell.image == 1));
        for texel in 0..SIDE * SIDE {
            let open = |level: usize, from: usize| -> f64 {
                one.levels[level][from..].iter().map(|shell| 1.0 - f64::from(shell.covers(alpha(&one, 1, texel) as f32))).product()
            };
            let (coarse, fine) = (open(level, 1), open(0, 1 << level));
            assert!((coarse - fine).abs() < 0.003, "level {level}, texel {texel}: {coarse} of {fine}");
        }
    }
}

#[test]
fn curly_hair_is_not_one_image() {
    let unlike = |settings: &GrowSettings| OneLayerFit::of(&sampled(settings, 16)).unwrap().unlikeness;
    let curly = unlike(&GrowSettings { style: Style::Curly { radius: 0.14286, turns: 2.0 }, ..straight() });
    let leaning = unlike(&GrowSettings { lean: 40.0, ..straight() });
    assert!(curly > 0.5 && leaning > 0.5, "{curly} {leaning}");
}

#[test]
fn a_direction_map_goes_along() {
    let hair: StrandTile = grow(&straight()).unwrap();
    let settings = ShellSettings { layers: 8, resolution: 32, directions: Some(1.0), ..ShellSettings::default() };
    let stack = sample_shells(&hair, &settings).unwrap();
    let one = OneLayerFit::of(&stack).unwrap().stack(&stack);
    let map = one.directions.as_ref().unwrap();
    assert!(map.iter().all(|mip| mip.layers == 2 && mip.texels.chunks_exact(4).all(|texel| texel == [128, 128, 255, 255])));
    let shared = stack.shared(4, Spacing::Even).unwrap();
    assert_eq!(shared.directions.unwrap()[0].layers, shared.mips[0].layers);
}

#[test]
fn what_cannot_be_shared_or_fitted_is_refused() {
    let skin = stack(1, noise);
    assert_eq!(OneLayerFit::of(&skin), Err(VolumeError::NoHairShells));
    assert_eq!(skin.shared(4, Spacing::Even), Err(VolumeError::NoHairShells));
    assert_eq!(skin.shared(1, Spacing::Even).unwrap().layers(), 1);
    for shells in [0, 257] {
        assert!(matches!(stack(3, noise).shared(shells, Spacing::Even), Err(VolumeError::OutOfRange { name: "shells", .. })));
    }
    assert!(stack(3, noise).shared(4, Spacing::Power(-1.0)).is_err());
    // No hair at all is like any image.
    let bald = OneLayerFit::of(&stack(4, |_, _| 0)).unwrap();
    assert_eq!((bald.unlikeness, bald.alpha_rms), (0.0, 0.0));
}
