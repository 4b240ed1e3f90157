//! What a stack of shell layers promises.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use pelage_strand::{GrowSettings, StrandTile, Style, Undercoat, grow};
use pelage_volume::{Image, MipRule, ShellSettings, Spacing, VolumeError, sample_shells, sample_skin, srgb_to_linear};
use proptest::prelude::*;

fn bare() -> Undercoat {
    Undercoat { count: 0, ..Undercoat::default() }
}

fn coat() -> StrandTile {
    grow(&GrowSettings::default()).unwrap()
}

#[test]
fn levels_halve_down_to_one_texel_and_bytes_add_up() {
    let stack = sample_shells(&coat(), &ShellSettings::default()).unwrap();
    let sides: Vec<u32> = stack.mips.iter().map(|mip| mip.width).collect();
    assert_eq!(sides, [128, 64, 32, 16, 8, 4, 2, 1]);
    assert!(stack.mips.iter().all(|mip| mip.height == mip.width && mip.layers == 16));
    assert!(stack.mips.iter().all(|mip| mip.texels.len() == 4 * 16 * (mip.width * mip.height) as usize));
    // 16 × 4 bytes × (128² + 64² + … + 1).
    assert_eq!(stack.byte_size(), 16 * 4 * 21845);
    assert_eq!(stack.level_bytes().iter().sum::<usize>(), stack.byte_size());
}

#[test]
fn the_skin_alone_is_that_of_the_whole() {
    for layers in [1, 2, 9] {
        let settings =
            ShellSettings { layers, resolution: 32, directions: Some(0.7), spacing: Spacing::Power(2.0), ..ShellSettings::default() };
        let (whole, skin) = (sample_shells(&coat(), &settings).unwrap(), sample_skin(&coat(), &settings).unwrap());
        assert_eq!((skin.images(), &skin.levels[0][..]), (1, &whole.levels[0][..1]));
        let first =
            |mips: &[Image]| mips.iter().map(|mip| mip.texels[..4 * (mip.width * mip.height) as usize].to_vec()).collect::<Vec<_>>();
        assert!(first(&skin.mips) == first(&whole.mips), "{layers} layers");
        assert!(skin.directions.as_deref().map(first) == whole.directions.as_deref().map(first), "{layers} layers");
    }
}

#[test]
fn the_skin_is_opaque_at_every_level_and_the_tips_are_there() {
    for mip_rule in [MipRule::Coverage, MipRule::Transmittance] {
        let stack = sample_shells(&coat(), &ShellSettings { mip_rule, ..ShellSettings::default() }).unwrap();
        for mip in &stack.mips {
            assert!((0..mip.width * mip.width).all(|i| mip.texel(0, i % mip.width, i / mip.width).unwrap()[3] == 255));
        }
        assert!(stack.mips[0].mean_coverage(15) > 0.002);
        let cover: Vec<f64> = (1..16).map(|layer| stack.mips[0].mean_coverage(layer)).collect();
        assert!(cover.windows(2).all(|pair| pair[1] < pair[0]), "denser below: {cover:?}");
    }
}

#[test]
fn a_bald_box_is_skin_and_nothing_else() {
    let bald = StrandTile::empty(0.3);
    let stack = sample_shells(&bald, &ShellSettings { skin_colour: [1.0, 0.0, 0.0], ..ShellSettings::default() }).unwrap();
    for mip in &stack.mips {
        let (skin, rest) = mip.texels.split_at(4 * (mip.width * mip.height) as usize);
        assert!(skin.chunks_exact(4).all(|texel| texel == [255, 0, 0, 255]) && rest.iter().all(|&byte| byte == 0));
    }
}

#[test]
fn colour_is_premultiplied_and_is_the_hairs_own() {
    let grey =
        GrowSettings { root_colour: [0.5; 3], tip_colour: [0.5; 3], colour_variation: 0.0, undercoat: bare(), ..GrowSettings::default() };
    let stack = sample_shells(&grow(&grey).unwrap(), &ShellSettings::default()).unwrap();
    for texel in stack.mips[0].texels.chunks_exact(4).skip(128 * 128) {
        let covered = f32::from(texel[3]) / 255.0;
        // Rounding of alpha and of the encoded colour: dark bytes are 0.0003 of linear light apart, bright ones 0.009.
        assert!((srgb_to_linear(texel[0]) - 0.5 * covered).abs() < 0.006, "{texel:?}");
        assert!(texel[0] == texel[1] && texel[1] == texel[2]);
    }
}

#[test]
fn mips_keep_what_their_rule_says() {
    let tile = coat();
    let stack = sample_shells(&tile, &ShellSettings { mip_rule: MipRule::Coverage, ..ShellSettings::default() }).unwrap();
    for mip in &stack.mips {
        for layer in 0..16 {
            let lost = mip.mean_coverage(layer) - stack.mips[0].mean_coverage(layer);
            // The rounding of bytes keeps a level's sum to a step.
            assert!(lost.abs() < 1.01 / (255.0 * f64::from(mip.width * mip.width)), "layer {layer} at {}: {lost}", mip.width);
        }
    }
    let open = grow(&GrowSettings { count: 400, lean: 0.0, splay: 4.0, undercoat: bare(), ..GrowSettings::default() }).unwrap();
    let stack = sample_shells(&open, &ShellSettings { mip_rule: MipRule::Transmittance, ..ShellSettings::default() }).unwrap();
    let full = stack.transmittance(0, [0.0, 0.0]).unwrap();
    assert!(full > 0.2);
    for level in 0..stack.mips.len() {
        let kept = stack.transmittance(level, [0.0, 0.0]).unwrap();
        assert!((kept - full).abs() < 0.01, "level {level}: {kept} of {full}");
    }
}

#[test]
fn any_number_of_threads_makes_the_same_bytes() {
    let tile = coat();
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            sample_shells(&tile, &ShellSettings { resolution: 64, mip_rule: MipRule::Transmittance, ..ShellSettings::default() }).unwrap()
        })
    };
    let one = with(1);
    assert_eq!(one, with(2));
    assert_eq!(one, with(8));
}

#[test]
fn settings_out_of_range_are_named() {
    let good = ShellSettings::default();
    let tile = coat();
    let wrong = |settings: ShellSettings| sample_shells(&tile, &settings).unwrap_err();
    assert_eq!(
        wrong(ShellSettings { resolution: 100, ..good }),
        VolumeError::NotPowerOfTwo { name: "resolution", value: 100, nearest: 128 }
    );
    assert!(matches!(wrong(ShellSettings { layers: 0, ..good }), VolumeError::OutOfRange { name: "layers", .. }));
    assert!(matches!(wrong(ShellSettings { lateral_sigma: f64::NAN, ..good }), VolumeError::OutOfRange { name: "lateral_sigma", .. }));
    assert!(matches!(wrong(ShellSettings { layers: 256, resolution: 2048, ..good }), VolumeError::TooManyTexels { .. }));
    assert!(matches!(sample_shells(&StrandTile::empty(f64::NAN), &good), Err(VolumeError::NoHeight { .. })));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn whatever_is_in_range_is_sampled(
        layers in 1u32..20, level in 0u32..7, lateral in 0.0..100.0, vertical in 0.05..=8.0,
        thickness in 1e-6..=0.25, lean in 0.0..=75.0, radius in 0.0..=1.0, turns in 0.0..=64.0,
    ) {
        let style = Style::Curly { radius, turns };
        let undercoat = Undercoat { count: 3, ..Undercoat::default() };
        let tile = grow(&GrowSettings { count: 6, undercoat, thickness, lean, style, ..GrowSettings::default() }).unwrap();
        for mip_rule in [MipRule::Coverage, MipRule::Transmittance] {
            let settings = ShellSettings { layers, resolution: 1 << level, lateral_sigma: lateral, vertical_sigma: vertical, mip_rule, ..ShellSettings::default() };
            let stack = sample_shells(&tile, &settings).unwrap();
            prop_assert_eq!(stack.mips.len() as u32, level + 1);
            prop_assert!(stack.mips.iter().all(|mip| mip.texel(0, 0, 0).is_some_and(|texel| texel[3] == 255)));
            prop_assert!(stack.transmittance(0, [1.0, 0.0]).is_some_and(|t| (0.0..=1.0).contains(&t)));
        }
    }
}
