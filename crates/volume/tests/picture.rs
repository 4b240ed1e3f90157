//! What a picture made a fin promises.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use pelage_volume::{Pixels, VolumeError, fin_from_pixels, srgb_to_linear};
use proptest::prelude::*;

fn picture(rgba: &[u8], width: u32, height: u32) -> Pixels<'_> {
    Pixels { rgba, width, height }
}

#[test]
fn straight_alpha_becomes_premultiplied_linear_light() {
    // Two of each, so that nothing is resampled.
    let pixels = [[255u8, 128, 0, 128], [10, 20, 30, 0], [255, 128, 0, 255], [255, 128, 0, 51]].concat();
    let fin = fin_from_pixels(&picture(&pixels, 2, 2), 3).unwrap();
    assert_eq!((fin.tiles_across, fin.mips.iter().map(|mip| (mip.width, mip.height)).collect::<Vec<_>>()), (3, vec![(2, 2), (1, 1)]));
    let texel = |x, y| fin.mips[0].texel(0, x, y).unwrap();
    // Opaque stays as it is; without cover there is no colour, whatever the file says.
    assert_eq!((texel(0, 1), texel(1, 0)), ([255, 128, 0, 255], [0; 4]));
    for (x, y, alpha) in [(0, 0, 128.0), (1, 1, 51.0)] {
        let [red, green, blue, covered] = texel(x, y);
        assert!((f32::from(covered) - alpha).abs() <= 1.0 && blue == 0);
        let covered = f32::from(covered) / 255.0;
        assert!((srgb_to_linear(red) - covered).abs() < 0.005, "{red}");
        assert!((srgb_to_linear(green) - covered * srgb_to_linear(128)).abs() < 0.003, "{green}");
    }
    assert!((fin.mips[1].mean_coverage(0) - fin.mips[0].mean_coverage(0)).abs() < 1.0 / 255.0);
}

#[test]
fn sides_become_powers_of_two_and_the_picture_stays_where_it_was() {
    // Six columns of three rows: left third opaque white, the rest clear.
    let pixels: Vec<u8> = (0..18).flat_map(|i| if i % 6 < 2 { [255; 4] } else { [0; 4] }).collect();
    let fin = fin_from_pixels(&picture(&pixels, 6, 3), 1).unwrap();
    assert_eq!((fin.mips[0].width, fin.mips[0].height), (8, 4));
    // A third of eight texels is two and two thirds, in every row.
    for y in 0..4 {
        let alphas: Vec<u8> = (0..8).map(|x| fin.mips[0].texel(0, x, y).unwrap()[3]).collect();
        assert!(alphas[..2] == [255, 255] && alphas[2].abs_diff(170) <= 1 && alphas[3..] == [0; 5], "{alphas:?}");
    }
    // Up is up: bottom row covered only.
    let pixels: Vec<u8> = (0..9).flat_map(|i| if i >= 6 { [255; 4] } else { [0; 4] }).collect();
    let fin = fin_from_pixels(&picture(&pixels, 3, 3), 1).unwrap();
    assert!(fin.mips[0].texel(0, 1, 3).unwrap()[3] == 255 && fin.mips[0].texel(0, 1, 0).unwrap()[3] == 0);
}

#[test]
fn what_is_no_picture_is_refused() {
    for (pixels, width, height) in [(vec![], 0, 0), (vec![0; 12], 2, 2), (vec![0; 20], 2, 2), (vec![], u32::MAX, u32::MAX)] {
        assert!(matches!(fin_from_pixels(&picture(&pixels, width, height), 1), Err(VolumeError::Pixels { .. })), "{width} × {height}");
    }
    for tiles in [0, 65] {
        assert!(matches!(fin_from_pixels(&picture(&[0; 4], 1, 1), tiles), Err(VolumeError::OutOfRange { name: "tiles_across", .. })));
    }
}

proptest! {
    #[test]
    fn any_size_keeps_its_coverage(width in 1u32..40, height in 1u32..40, seed in prop::collection::vec(any::<u8>(), 60)) {
        let pixels: Vec<u8> = seed.iter().copied().cycle().take((4 * width * height) as usize).collect();
        let fin = fin_from_pixels(&picture(&pixels, width, height), 1).unwrap();
        let wanted = pixels.iter().skip(3).step_by(4).map(|&alpha| f64::from(alpha)).sum::<f64>() / (255.0 * f64::from(width * height));
        prop_assert!(fin.mips[0].width.is_power_of_two() && fin.mips[0].width >= width && fin.mips[0].width < 2 * width);
        for mip in &fin.mips {
            let texels = f64::from(mip.width * mip.height);
            prop_assert!((mip.mean_coverage(0) - wanted).abs() < 1.5 / (255.0 * texels) + 1e-6, "{}: {} of {wanted}", mip.width, mip.mean_coverage(0));
        }
    }
}
