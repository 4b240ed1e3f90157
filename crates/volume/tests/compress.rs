//! What compressed stacks promise.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use pelage_strand::{GrowSettings, Undercoat, grow};
use pelage_volume::{Image, Shell, ShellSettings, ShellStack, Work, sample_shells};
use proptest::prelude::*;

fn coat() -> ShellStack {
    let undercoat = Undercoat { count: 500, ..Undercoat::default() };
    let hair = grow(&GrowSettings { count: 400, undercoat, ..GrowSettings::default() }).unwrap();
    sample_shells(&hair, &ShellSettings { layers: 6, resolution: 64, ..ShellSettings::default() }).unwrap()
}

fn of_texels(side: u32, texels: Vec<u8>) -> ShellStack {
    ShellStack {
        height: 1.0,
        mips: vec![Image { width: side, height: side, layers: 1, texels }],
        levels: vec![vec![Shell::plain(0.0, 0)]],
        directions: None,
        work: Work::default(),
    }
}

#[test]
fn a_quarter_of_the_bytes_and_small_mips_in_a_block_each() {
    let stack = coat();
    let small = stack.compressed();
    assert_eq!(small.level_bytes(), [6 * 4096, 6 * 1024, 6 * 256, 6 * 64, 6 * 16, 6 * 16, 6 * 16]);
    assert_eq!(small.byte_size(), small.level_bytes().iter().sum::<usize>());
    let back = small.decoded();
    assert_eq!((back.levels, back.mips.len()), (stack.levels, stack.mips.len()));
    assert!(back.mips.iter().zip(&stack.mips).all(|(a, b)| (a.width, a.layers, a.texels.len()) == (b.width, b.layers, b.texels.len())));
}

#[test]
fn hair_is_as_thick_as_it_was_and_near_what_it_was() {
    let stack = coat().with_levels().unwrap();
    let back = stack.compressed().decoded();
    for (mip, own) in back.mips.iter().zip(&stack.mips) {
        let texels = f64::from(mip.width * mip.width);
        for image in 0..stack.images() {
            let (got, wanted) = (mip.mean_coverage(image), own.mean_coverage(image));
            // A thousandth, or half a step in each of the few texels that a block rounds once more.
            let bound = (0.001 * wanted).max(0.5 / (255.0 * texels)) + 0.5 / 255.0 * (16.0 / texels).min(1.0);
            assert!((got - wanted).abs() <= bound, "image {image} at {}: {got} of {wanted}", mip.width);
        }
    }
    let errors = stack.compressed().errors(&stack);
    assert!(errors.iter().all(|error| error.alpha_rms < 0.03 && error.colour_rms < 0.03), "{errors:?}");
    assert!(errors[0].alpha_rms > 1e-4 && errors[0].coverage <= 0.001, "{:?}", errors[0]);
    // The skin is opaque after all.
    assert!(back.mips.iter().all(|mip| (0..mip.width * mip.width).all(|i| mip.texel(0, i % mip.width, i / mip.width).unwrap()[3] == 255)));
}

#[test]
fn no_hair_stays_none_and_one_colour_itself() {
    let nothing = of_texels(8, vec![0; 256]);
    assert_eq!(nothing.compressed().decoded().mips, nothing.mips);
    let flat = of_texels(8, [255, 0, 255, 102].repeat(64));
    assert_eq!(flat.compressed().decoded().mips, flat.mips);
}

/// A mip of two texels is one block of them over and over: masked out instead, what is left of the block would be whatever a colour fit makes of it.
#[test]
fn blocks_past_the_edge_go_on_with_the_torus() {
    let two = of_texels(2, vec![255, 255, 255, 255, 0, 0, 0, 51, 0, 0, 0, 51, 255, 255, 255, 255]);
    let block = two.compressed().mips[0].clone();
    let wide = pelage_volume::BlockImage { width: 4, height: 4, layers: 1, ..block.clone() }.decoded();
    for i in 0..16 {
        assert_eq!(wide.texel(0, i % 4, i / 4), two.mips[0].texel(0, i % 2, i / 4 % 2), "texel {i}");
    }
    assert_eq!(block.decoded(), two.mips[0]);
}

#[test]
fn blocks_are_the_same_for_any_number_of_threads() {
    let stack = coat();
    let made = stack.compressed();
    for threads in [1, 2, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| stack.compressed()), made, "{threads} threads");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Any bytes are blocks, and blocks of any sizes are read without harm.
    #[test]
    fn any_texels_are_compressed_and_any_blocks_read(level in 0u32..5, seed in prop::collection::vec(any::<u8>(), 64), blocks in prop::collection::vec(any::<u8>(), 0..100)) {
        let side = 1u32 << level;
        let texels = seed.iter().copied().cycle().take(4 * (side * side) as usize).collect();
        let stack = of_texels(side, texels);
        let back = stack.compressed().decoded();
        prop_assert_eq!(back.mips[0].texels.len(), stack.mips[0].texels.len());
        let broken = pelage_volume::BlockImage { width: side, height: side, layers: 2, blocks };
        prop_assert_eq!(broken.decoded().texels.len(), 8 * (side * side) as usize);
    }
}
