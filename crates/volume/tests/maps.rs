//! Hair that is a pattern: as much of it as is asked for, the same at any resolution, without a seam, and straight where it is to be.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use pelage_volume::{
    FinSettings, FurMap, MapLook, Pixels, ShellStack, Spacing, StackSettings, VolumeError, map_shells, shells_from_pixels,
};
use proptest::prelude::*;

const NOISES: [MapLook; 3] = [MapLook::Perlin, MapLook::Simplex, MapLook::Dots];

fn made(map: &FurMap, layers: u32, resolution: u32) -> ShellStack {
    map_shells(map, &StackSettings { layers, resolution, ..StackSettings::default() }).unwrap()
}

/// Alpha of a layer, row by row.
fn alpha(stack: &ShellStack, layer: u32) -> Vec<u8> {
    let side = stack.resolution();
    (0..side * side).map(|index| stack.mips[0].texel(layer, index % side, index / side).unwrap()[3]).collect()
}

fn noise(look: MapLook) -> FurMap {
    FurMap { look, cells: 12, density: 0.4, ..FurMap::default() }
}

/// Zima's: 40 layers, 0.2 of the texels, the same on all of them, the tips included.
#[test]
fn of_grains_exactly_the_density_is_covered_on_every_layer() {
    let stack = made(&FurMap { density: 0.2, ..FurMap::default() }, 40, 128);
    let first = alpha(&stack, 1);
    let count = first.iter().filter(|&&alpha| alpha == 255).count();
    assert_eq!((count, first.iter().filter(|&&alpha| alpha == 0).count()), (3277, 128 * 128 - 3277), "0.2 of 16,384, none in part");
    assert!((2..40).all(|layer| alpha(&stack, layer) == first));
    assert!(alpha(&stack, 0).iter().all(|&alpha| alpha == 255), "the skin is opaque");
}

#[test]
fn hair_thins_towards_the_tips_by_the_exponent_and_stays_where_it_is() {
    for look in [MapLook::Grains, MapLook::Perlin, MapLook::Dots] {
        let stack = made(
            &FurMap { density: 0.5, thinning: 1.5, cells: if look == MapLook::Grains { 128 } else { 12 }, look, ..FurMap::default() },
            9,
            128,
        );
        for layer in 1..9 {
            let height = f64::from(layer) / 8.0;
            let (covered, wanted) = (stack.mips[0].mean_coverage(layer), 0.5 * (1.0 - height).powf(1.5));
            assert!((covered - wanted).abs() < 0.012, "{look:?}: {covered} of {wanted} at {height}");
            let (below, above) = (alpha(&stack, layer - 1), alpha(&stack, layer));
            assert!(below.iter().zip(&above).all(|(below, above)| *above <= below.saturating_add(1)), "{look:?}: hair hangs in the air");
        }
    }
}

#[test]
fn more_density_adds_hair_and_moves_none() {
    let at = |density| alpha(&made(&FurMap { density, ..FurMap::default() }, 2, 128), 1);
    let rows: Vec<Vec<u8>> = [0.05, 0.2, 0.21, 0.9].map(at).into();
    assert!(rows.windows(2).all(|pair| pair[0].iter().zip(&pair[1]).all(|(few, many)| few <= many) && pair[0] != pair[1]));
}

#[test]
fn a_seed_is_the_same_hair_at_any_resolution() {
    for map in [FurMap { cells: 64, ..FurMap::default() }, noise(MapLook::Perlin), noise(MapLook::Simplex), noise(MapLook::Dots)] {
        let fine = made(&map, 3, 256);
        let coarse = made(&map, 3, 128);
        // The second level of the fine is as large as the first of the coarse.
        let (half, whole) = (&fine.mips[1], &coarse.mips[0]);
        let off: f64 =
            half.texels.iter().zip(&whole.texels).map(|(a, b)| f64::from(a.abs_diff(*b))).sum::<f64>() / half.texels.len() as f64;
        assert!(off < 4.0, "{:?}: {off} of 255", map.look);
        let other = made(&FurMap { seed: 2, ..map }, 3, 128);
        let far: f64 =
            other.mips[0].texels.iter().zip(&whole.texels).map(|(a, b)| f64::from(a.abs_diff(*b))).sum::<f64>() / whole.texels.len() as f64;
        assert!(far > 8.0 * off.max(1.0), "{:?}: {far}", map.look);
    }
}

#[test]
fn noise_covers_its_density_and_has_no_seam() {
    for look in NOISES {
        let stack = made(&noise(look), 2, 128);
        assert!((stack.mips[0].mean_coverage(1) - 0.4).abs() < 0.01, "{look:?}: {}", stack.mips[0].mean_coverage(1));
        let texels = alpha(&stack, 1);
        let at = |x: usize, y: usize| f64::from(texels[y % 128 * 128 + x % 128]);
        // How much neighbours differ across each line of the tile; the border is as any other.
        let steps = |along: fn(usize, usize) -> [usize; 2], next: fn(usize, usize) -> [usize; 2]| -> Vec<f64> {
            let line = |k: usize| {
                (0..128).map(|n| (at(along(k, n)[0], along(k, n)[1]) - at(next(k, n)[0], next(k, n)[1])).abs()).sum::<f64>() / 128.0
            };
            (0..128).map(line).collect()
        };
        for lines in [steps(|k, n| [k, n], |k, n| [k + 1, n]), steps(|k, n| [n, k], |k, n| [n, k + 1])] {
            let mean = lines.iter().sum::<f64>() / 128.0;
            let deviation = (lines.iter().map(|line| (line - mean) * (line - mean)).sum::<f64>() / 128.0).sqrt();
            assert!((lines[127] - mean).abs() < 3.5 * deviation, "{look:?}: {} at the border, {mean} ± {deviation}", lines[127]);
        }
    }
}

#[test]
fn drift_lets_hair_wander_and_keeps_its_density() {
    for look in NOISES {
        let straight = made(&noise(look), 5, 64);
        let wandering = made(&FurMap { drift: 2.0, ..noise(look) }, 5, 64);
        assert_eq!(alpha(&straight, 1), alpha(&straight, 4), "{look:?}");
        assert_ne!(alpha(&wandering, 1), alpha(&wandering, 4), "{look:?}");
        for layer in 1..5 {
            assert!((wandering.mips[0].mean_coverage(layer) - 0.4).abs() < 0.12, "{look:?}: {}", wandering.mips[0].mean_coverage(layer));
        }
    }
}

/// K19: layers that are animated come back to where they began.
#[test]
fn a_loop_closes_and_moves_on_the_way() {
    for map in [FurMap::default(), noise(MapLook::Perlin), noise(MapLook::Dots)] {
        let at = |phase, swing| made(&FurMap { phase, swing, ..map }, 6, 64).mips[0].texels.clone();
        assert!(at(0.25, 0.5) == at(1.25, 0.5) && at(0.25, 0.5) == at(-0.75, 0.5), "{:?}", map.look);
        assert_ne!(at(0.0, 0.5), at(0.5, 0.5), "{:?}", map.look);
        // A hundredth of the loop moves little, over its end as within it.
        let moved = |from, to| at(from, 0.5).iter().zip(at(to, 0.5)).filter(|&(&a, b)| a.abs_diff(b) > 8).count();
        assert!(
            2 * moved(0.995, 0.005) < 3 * moved(0.495, 0.505) + 300,
            "{:?}: {} and {}",
            map.look,
            moved(0.995, 0.005),
            moved(0.495, 0.505)
        );
        assert_eq!(at(0.0, 0.0), at(0.3, 0.0), "{:?} moves at rest", map.look);
    }
}

/// K9: brighter or darker by hair, and the same from root to tip.
#[test]
fn a_hair_has_one_brightness() {
    let grey = FurMap { root_colour: [0.3; 3], tip_colour: [0.3; 3], brightness: 0.5, ..FurMap::default() };
    let stack = made(&grey, 4, 128);
    let colours = |layer| -> Vec<[u8; 4]> { (0..128 * 128).map(|k| stack.mips[0].texel(layer, k % 128, k / 128).unwrap()).collect() };
    let (low, high) = (colours(1), colours(3));
    assert_eq!(low, high);
    let mut shades: Vec<u8> = low.iter().filter(|texel| texel[3] == 255).map(|texel| texel[0]).collect();
    shades.sort_unstable();
    shades.dedup();
    assert!(shades.len() > 20, "{shades:?}");
}

#[test]
fn the_same_bytes_come_of_any_number_of_threads() {
    let map = FurMap { octaves: 3, drift: 1.0, ..noise(MapLook::Simplex) };
    let by = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| made(&map, 6, 64));
    assert_eq!(by(1), by(3));
}

#[test]
fn settings_out_of_range_are_refused_by_name() {
    let refused = |map: FurMap, stack: StackSettings, field: &str| {
        let error = map_shells(&map, &stack).unwrap_err();
        assert!(matches!(&error, VolumeError::OutOfRange { name, .. } if *name == field) || error.to_string().contains(field), "{error}");
    };
    let (map, stack) = (FurMap::default(), StackSettings::default());
    for density in [-0.1, 1.1, f64::NAN, f64::INFINITY] {
        refused(FurMap { density, ..map }, stack, "density");
    }
    refused(FurMap { cells: 0, ..map }, stack, "cells");
    refused(FurMap { cells: 1025, ..map }, stack, "cells");
    refused(FurMap { cells: 257, look: MapLook::Dots, ..map }, stack, "cells");
    refused(FurMap { octaves: 0, ..map }, stack, "octaves");
    refused(FurMap { thinning: f64::NAN, ..map }, stack, "thinning");
    refused(FurMap { drift: 17.0, ..map }, stack, "drift");
    refused(FurMap { phase: f64::INFINITY, ..map }, stack, "phase");
    refused(FurMap { swing: 1.5, ..map }, stack, "swing");
    refused(FurMap { brightness: -1.0, ..map }, stack, "brightness");
    refused(FurMap { root_colour: [2.0; 3], ..map }, stack, "colour");
    refused(map, StackSettings { layers: 0, ..stack }, "layers");
    refused(map, StackSettings { resolution: 100, ..stack }, "resolution");
    refused(map, StackSettings { spacing: Spacing::Power(9.0), ..stack }, "spacing power");
    refused(map, StackSettings { layers: 256, resolution: 2048, ..stack }, "texels");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// Whatever is in range makes a stack, and its mips keep what covers.
    #[test]
    fn every_setting_in_range_makes_a_stack(
        look in prop_oneof![Just(MapLook::Grains), Just(MapLook::Perlin), Just(MapLook::Simplex), Just(MapLook::Dots)],
        cells in 1u32..=256, density in 0.0f64..=1.0, thinning in 0.0f64..=16.0, drift in 0.0f64..=16.0,
        swing in 0.0f64..=1.0, phase in -1e6f64..=1e6, layers in 1u32..=8, power in 0u32..=6, seed in any::<u64>(),
    ) {
        let stack = made(&FurMap { look, cells, density, thinning, drift, swing, phase, seed, ..FurMap::default() }, layers, 1 << power);
        prop_assert_eq!((stack.layers(), stack.mips.len()), (layers, power as usize + 1));
        for layer in 0..layers {
            let (fine, coarse) = (stack.mips[0].mean_coverage(layer), stack.mips[power as usize].mean_coverage(layer));
            prop_assert!((fine - coarse).abs() <= 1.0 / 255.0, "{} {}", fine, coarse);
        }
    }
}

#[test]
fn of_one_picture_alpha_is_how_high_hair_stands() {
    // None, a third, two thirds, all the way up.
    let rgba: Vec<u8> = [0u8, 85, 170, 255].iter().flat_map(|&alpha| [200, 100, 50, alpha]).collect();
    let settings = StackSettings { layers: 4, resolution: 2, ..StackSettings::default() };
    let stack = shells_from_pixels(&[Pixels { rgba: &rgba, width: 2, height: 2 }], &settings).unwrap();
    let covered = |layer| alpha(&stack, layer);
    assert_eq!([covered(1), covered(2), covered(3)], [[0, 255, 255, 255], [0, 0, 255, 255], [0, 0, 0, 255]]);
    assert_eq!(stack.mips[0].texel(3, 1, 1), Some([200, 100, 50, 255]), "in its own colour, not premultiplied by its height");
}

#[test]
fn several_pictures_are_a_layer_each() {
    let picture = |colour: [u8; 4]| colour.repeat(9);
    let (skin, middle, tips) = (picture([10, 20, 30, 255]), picture([200, 0, 0, 128]), picture([0, 200, 0, 0]));
    let pixels = [&skin, &middle, &tips].map(|rgba| Pixels { rgba, width: 3, height: 3 });
    let stack = shells_from_pixels(&pixels, &StackSettings { layers: 99, resolution: 4, ..StackSettings::default() }).unwrap();
    assert_eq!(stack.layers(), 3);
    assert_eq!(stack.levels[0].iter().map(|shell| shell.height).collect::<Vec<_>>(), [0.0, 0.5, 1.0]);
    assert_eq!(stack.mips[0].texel(0, 2, 1), Some([10, 20, 30, 255]));
    assert!((stack.mips[0].mean_coverage(1) - 128.0 / 255.0).abs() < 1.0 / 255.0 && stack.mips[0].mean_coverage(2) == 0.0);
    // What is wrong with one of them is said, and none make none.
    let torn = Pixels { rgba: &skin[1..], width: 3, height: 3 };
    assert!(matches!(shells_from_pixels(&[pixels[0], torn], &StackSettings::default()), Err(VolumeError::Pixels { .. })));
    assert!(matches!(shells_from_pixels(&[], &StackSettings::default()), Err(VolumeError::OutOfRange { name: "layers", .. })));
    assert!(shells_from_pixels(&vec![pixels[0]; 257], &StackSettings::default()).is_err());
}

/// Of a slab D texels deep of which each covers d, 1 − (1 − d)^D is covered.
#[test]
fn a_fin_of_shells_shows_what_a_slab_of_them_covers() {
    let stack = made(&FurMap { cells: 64, density: 0.1, ..FurMap::default() }, 12, 64);
    for depth in [1, 4, 16] {
        let settings =
            FinSettings { width: 256, height: 32, slab_width: f64::from(depth) / 64.0, tiles_across: 4, ..FinSettings::default() };
        let fin = stack.fin(&settings).unwrap();
        let (covered, wanted) = (fin.mips[0].mean_coverage(0), 1.0 - 0.9f64.powi(depth));
        assert!((covered - wanted).abs() < 0.04, "{covered} of {wanted}");
    }
    // And of what lets through, each texel behind the other.
    let veil = [77u8; 4 * 64];
    let pixels = Pixels { rgba: &veil, width: 8, height: 8 };
    let stack_of_veils = shells_from_pixels(&[pixels; 3], &StackSettings { resolution: 32, ..StackSettings::default() }).unwrap();
    let fin = stack_of_veils.fin(&FinSettings { slab_width: 4.0 / 32.0, ..FinSettings::default() }).unwrap();
    let (covered, wanted) = (fin.mips[0].mean_coverage(0), 1.0 - (1.0 - 77.0 / 255.0f64).powi(4));
    assert!((covered - wanted).abs() < 0.01, "{covered} of {wanted}");
    // Where hair thins, the fin does: its top row is that of the tips.
    let thin = made(&FurMap { thinning: 2.0, density: 0.4, ..FurMap::default() }, 12, 128).fin(&FinSettings::default()).unwrap();
    let row = |y: u32| (0..512).map(|x| f64::from(thin.mips[0].texel(0, x, y).unwrap()[3])).sum::<f64>();
    assert!(row(0) < 0.05 * row(63) && row(20) < row(40), "{} {} {} {}", row(0), row(20), row(40), row(63));
    let bald = made(&FurMap::default(), 1, 16);
    assert_eq!(bald.fin(&FinSettings::default()).unwrap_err(), VolumeError::NoHairShells);
    assert!(matches!(stack.fin(&FinSettings { width: 100, ..FinSettings::default() }), Err(VolumeError::NotPowerOfTwo { .. })));
}
