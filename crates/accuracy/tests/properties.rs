//! Properties that hold for every picture.

use pelage_accuracy::{DEFAULT_PIXELS_PER_DEGREE, Image, dilate, flip, heat_picture, rmse_linear};
use proptest::collection::vec;
use proptest::prelude::*;

/// Two pictures of one size and a mask, all of random bytes.
fn pair() -> impl Strategy<Value = (u32, u32, Vec<u8>, Vec<u8>, Vec<u8>)> {
    (1u32..14, 1u32..14).prop_flat_map(|(width, height)| {
        let pixels = (width * height) as usize;
        (Just(width), Just(height), vec(any::<u8>(), pixels * 3), vec(any::<u8>(), pixels * 3), vec(0u8..3, pixels))
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn flip_is_symmetric_bounded_and_finite((width, height, a, b, mask) in pair(), pixels_per_degree in 8.0f32..=512.0) {
        let (first, second) = (Image::new(width, height, &a).unwrap(), Image::new(width, height, &b).unwrap());
        let mask = mask.iter().any(|&byte| byte > 0).then_some(mask.as_slice());
        let report = flip(first, second, mask, pixels_per_degree).unwrap();
        prop_assert_eq!(&report, &flip(second, first, mask, pixels_per_degree).unwrap());
        prop_assert!(report.map.values.iter().all(|value| (0.0..=1.0).contains(value)), "{:?}", report);
        prop_assert!(report.mean <= report.max && report.p99 <= report.max);
        prop_assert_eq!(report.pixels, mask.map_or(report.map.values.len(), |mask| mask.iter().filter(|&&byte| byte > 0).count()));
        prop_assert_eq!(heat_picture(&report.map, mask).unwrap().len(), a.len());
    }

    #[test]
    fn a_picture_is_itself((width, height, a, _, _) in pair()) {
        let image = Image::new(width, height, &a).unwrap();
        prop_assert_eq!(flip(image, image, None, DEFAULT_PIXELS_PER_DEGREE).unwrap().max, 0.0);
        prop_assert_eq!(rmse_linear(image, image, None).unwrap(), 0.0);
    }

    #[test]
    fn rmse_is_a_distance((width, height, a, b, _) in pair()) {
        let (first, second) = (Image::new(width, height, &a).unwrap(), Image::new(width, height, &b).unwrap());
        let error = rmse_linear(first, second, None).unwrap();
        prop_assert_eq!(error, rmse_linear(second, first, None).unwrap());
        prop_assert!((0.0..=1.0).contains(&error));
        prop_assert_eq!(error == 0.0, a == b);
    }

    #[test]
    fn dilations_add((width, height, _, _, mask) in pair(), first in 0u32..4, second in 0u32..4) {
        let twice = dilate(&dilate(&mask, width, height, first).unwrap(), width, height, second).unwrap();
        prop_assert_eq!(twice, dilate(&mask, width, height, first + second).unwrap());
    }

    #[test]
    fn no_input_panics(width in any::<u32>(), height in any::<u32>(), bytes in vec(any::<u8>(), 0..64), number in any::<f32>()) {
        if let Ok(image) = Image::new(width % 8, height % 8, &bytes) {
            let _ = flip(image, image, Some(&bytes), number);
            let _ = rmse_linear(image, image, Some(&bytes));
        }
        prop_assert!(Image::new(width.max(1 << 14), height.max(1 << 14), &bytes).is_err());
        let _ = dilate(&bytes, width, height, number as u32);
    }
}
