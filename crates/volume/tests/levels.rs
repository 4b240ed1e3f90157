//! What levels of detail promise.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use pelage_strand::{GrowSettings, StrandTile, Style, Undercoat, grow};
use pelage_volume::{MipRule, ShellSettings, ShellStack, sample_shells, srgb_to_linear};

fn coat() -> StrandTile {
    grow(&GrowSettings { count: 300, undercoat: Undercoat { count: 300, ..Undercoat::default() }, ..GrowSettings::default() }).unwrap()
}

fn chain(layers: u32, mip_rule: MipRule) -> ShellStack {
    sample_shells(&coat(), &ShellSettings { layers, resolution: 32, mip_rule, ..ShellSettings::default() }).unwrap().with_levels().unwrap()
}

/// Everything that is seen at a level of detail, along the normal, and what all but the skin of its finest shells covers.
fn seen(stack: &ShellStack, level: usize, mip: usize) -> Vec<[f32; 4]> {
    stack.seen_at(level, mip, true).unwrap()
}

#[test]
fn every_number_of_layers_halves_down_to_one() {
    for (layers, wanted) in [(1, vec![1]), (2, vec![2, 1]), (3, vec![3, 2, 1]), (7, vec![7, 4, 2, 1]), (16, vec![16, 8, 4, 2, 1])] {
        let stack = chain(layers, MipRule::Coverage);
        assert_eq!(stack.levels.iter().map(Vec::len).collect::<Vec<_>>(), wanted);
        // An odd one left over is its own composite.
        let left_over = stack.levels.windows(2).filter(|pair| pair[0].len() % 2 == 1 && pair[0].len() > 1).count();
        let images: usize = wanted.iter().sum::<usize>() - left_over;
        assert_eq!((stack.images(), stack.mips[0].texels.len()), (images as u32, images * 4 * 32 * 32));
        for (level, pair) in stack.levels.windows(2).enumerate() {
            for (j, shell) in pair[1].iter().enumerate() {
                assert_eq!(shell.height, pair[0][2 * j].height, "level {level}, shell {j}");
            }
        }
        if layers == 16 {
            assert_eq!(images, 2 * 16 - 1);
        }
    }
}

#[test]
fn every_level_covers_what_the_finest_does_texel_by_texel() {
    for layers in [2, 5, 16] {
        let stack = chain(layers, MipRule::Coverage);
        let open = |level: usize, texel: usize| -> f64 {
            // Below 1 by the hair alone: the finest level's without its skin, the coarser ones' shells above the innermost.
            let shells = stack.levels[level].iter().skip(1);
            shells.map(|shell| 1.0 - f64::from(stack.mips[0].texels[4 * (shell.image as usize * 1024 + texel) + 3]) / 255.0).product()
        };
        for level in 1..stack.levels.len() {
            let folded = 1 << level;
            for texel in 0..1024 {
                let kept: f64 = stack.levels[0][folded.min(layers as usize)..]
                    .iter()
                    .map(|shell| 1.0 - f64::from(stack.mips[0].texels[4 * (shell.image as usize * 1024 + texel) + 3]) / 255.0)
                    .product();
                // Each shell of the level is rounded once, by less than a byte's step.
                let bound = (stack.levels[level].len() - 1) as f64 * 1.01 / 255.0 + 1e-6;
                assert!((open(level, texel) - kept).abs() < bound, "level {level}, texel {texel}: {} of {kept}", open(level, texel));
            }
        }
    }
}

/// However far away, as the finest level does there: a coat keeps its colour as it recedes.
#[test]
fn every_level_shows_the_same_colours_on_an_opaque_skin_in_every_mip() {
    for rule in [MipRule::Coverage, MipRule::Transmittance] {
        let stack = chain(16, rule);
        for mip in 0..stack.mips.len() {
            let finest = seen(&stack, 0, mip);
            for level in 1..stack.levels.len() {
                let coarse = seen(&stack, level, mip);
                let mean = |picture: &[[f32; 4]], channel: usize| {
                    picture.iter().map(|texel| f64::from(texel[channel])).sum::<f64>() / picture.len() as f64
                };
                // Rounding to bytes, which many texels average.
                let bound = 5e-4 + 8e-3 / f64::from(stack.mips[mip].width);
                for channel in 0..3 {
                    let lost = mean(&coarse, channel) - mean(&finest, channel);
                    assert!(lost.abs() < bound, "level {level}, mip {mip}, channel {channel}: {lost}");
                }
                let worst = coarse.iter().flatten().zip(finest.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
                assert!(worst < 0.03, "level {level}, mip {mip}: {worst}");
                let skin = stack.levels[level][0].image;
                let side = stack.mips[mip].width;
                assert!((0..side * side).all(|i| stack.mips[mip].texel(skin, i % side, i / side).unwrap()[3] == 255));
            }
        }
        let last = stack.levels.last().unwrap();
        assert!(last.len() == 1 && seen(&stack, stack.levels.len() - 1, 0).iter().all(|texel| texel[3] == 1.0));
    }
}

#[test]
fn light_is_taken_where_the_visible_hair_is() {
    // Full shells hide all below them: the composite is lit where its upper shell is.
    let wall = GrowSettings {
        style: Style::Straight,
        count: 4000,
        thickness: 0.05,
        tip_thickness: 1.0,
        length_variation: 0.0,
        lean: 0.0,
        splay: 0.0,
        undercoat: Undercoat { count: 0, ..Undercoat::default() },
        ..GrowSettings::default()
    };
    let full = sample_shells(&grow(&wall).unwrap(), &ShellSettings { layers: 8, resolution: 16, ..ShellSettings::default() }).unwrap();
    assert!(full.mips[0].mean_coverage(6) > 0.9999);
    let full = full.with_levels().unwrap();
    assert!((full.levels[1][2].light_height - 5.0 / 7.0).abs() < 1e-3, "{:?}", full.levels[1]);
    // A bald box is lit at the skin, and its empty shells where they stand.
    let bald = sample_shells(&StrandTile::empty(0.3), &ShellSettings { layers: 4, resolution: 4, ..ShellSettings::default() }).unwrap();
    let bald = bald.with_levels().unwrap();
    assert_eq!(bald.levels[2][0].light_height, 0.0);
    assert!((bald.levels[1][1].light_height - 2.0 / 3.0).abs() < 1e-6);
    // Between: the mean over what is seen, by hand, of whole layers, crossed at N·V = 2/3.
    let stack = chain(4, MipRule::Coverage);
    let coarsest = stack.mips.last().unwrap();
    let alpha = |shell: u32| 1.0 - (1.0 - f64::from(coarsest.texel(shell, 0, 0).unwrap()[3]) / 255.0).powf(1.5);
    let (below, above) = (alpha(2) * (1.0 - alpha(3)), alpha(3));
    let wanted = (below * (2.0 / 3.0) + above) / (below + above);
    assert!((f64::from(stack.levels[1][1].light_height) - wanted).abs() < 1e-5);
}

#[test]
fn a_composite_is_premultiplied() {
    let stack = chain(8, MipRule::Coverage);
    for texel in stack.mips[0].texels.chunks_exact(4) {
        let covered = f32::from(texel[3]) / 255.0;
        assert!(texel[..3].iter().all(|&c| srgb_to_linear(c) <= covered + 0.005), "{texel:?}");
    }
}

#[test]
fn levels_are_made_of_the_finest_and_are_the_same_when_made_twice_and_by_any_number_of_threads() {
    let once = chain(11, MipRule::Transmittance);
    assert_eq!(once.with_levels().unwrap(), once);
    for threads in [1, 2, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| chain(11, MipRule::Transmittance)), once, "{threads} threads");
    }
}
