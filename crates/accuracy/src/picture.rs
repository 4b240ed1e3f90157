//! Errors as a picture for a person.

use crate::image::check_pair;
use crate::{AccuracyError, ErrorMap, Image, linear_light};

/// How much of its brightness a pixel keeps that did not count.
const OUTSIDE: u8 = 3;

/// An error map as sRGB bytes, three a pixel, of the map's own size: black for 0 by purple and orange to pale yellow for 1 (the
/// *magma* colours of FLIP's authors). Pixels that `mask` does not count are a third as bright, so that one sees what was measured.
///
/// For the picture written beside a failed comparison.
///
/// # Errors
///
/// [`MaskLength`](AccuracyError::MaskLength) if the map's values or the mask are not one a pixel.
pub fn heat_picture(map: &ErrorMap, mask: Option<&[u8]>) -> Result<Vec<u8>, AccuracyError> {
    let pixels = usize::try_from(u64::from(map.width) * u64::from(map.height)).unwrap_or(usize::MAX);
    for found in [map.values.len(), mask.map_or(pixels, <[u8]>::len)] {
        if found != pixels {
            return Err(AccuracyError::MaskLength { expected: pixels, found });
        }
    }
    let colours = nv_flip::magma_lut().to_vec();
    let mut rgb = Vec::with_capacity(pixels * 3);
    for (index, value) in map.values.iter().enumerate() {
        // A float cast saturates, and turns NaN to 0: a NaN must be seen, so it is drawn as the largest error.
        let entry = if value.is_nan() { 255 } else { usize::from((value * 255.0).round() as u8) };
        let dim = if mask.is_some_and(|mask| mask[index] == 0) { OUTSIDE } else { 1 };
        rgb.extend(colours[3 * entry..3 * entry + 3].iter().map(|channel| channel / dim));
    }
    Ok(rgb)
}

/// The signed difference of linear light, `test` less `reference`, as sRGB bytes, three a pixel: middle grey (half of the byte's range) where they are alike, brighter in each channel in
/// which the test is brighter. `gain` (1 unless a faint difference is to be seen) multiplies the difference, of which black to white, 1, goes from grey to the end of the range.
///
/// # Errors
///
/// [`SizeMismatch`](AccuracyError::SizeMismatch).
pub fn difference_picture(reference: Image, test: Image, gain: f32) -> Result<Vec<u8>, AccuracyError> {
    check_pair(reference, test, None)?;
    let light: Vec<f64> = (0..=255).map(linear_light).collect();
    // A float cast saturates.
    let byte = |(&a, &b): (&u8, &u8)| (127.5 + 127.5 * f64::from(gain) * (light[usize::from(b)] - light[usize::from(a)])).round() as u8;
    Ok(reference.rgb().iter().zip(test.rgb()).map(byte).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_difference_has_a_sign() {
        let (a, b) = ([0, 255, 188], [255, 0, 188]);
        let image = |rgb| Image::new(1, 1, rgb).unwrap();
        assert_eq!(difference_picture(image(&a), image(&b), 1.0), Ok(vec![255, 0, 128]));
        let dark = difference_picture(image(&[0; 3]), image(&[0, 10, 188]), 1.0).unwrap();
        // Half of the light, and 10 / 255 / 12.92 of it.
        assert_eq!(dark, [128, 128, 192]);
        assert_eq!(difference_picture(image(&[0; 3]), image(&[0, 10, 188]), 40.0), Ok(vec![128, 143, 255]));
    }

    fn map(values: Vec<f32>) -> ErrorMap {
        ErrorMap { width: values.len() as u32, height: 1, values }
    }

    #[test]
    fn brighter_is_worse() {
        let rgb = heat_picture(&map((0..=20).map(|step| step as f32 / 20.0).collect()), None).unwrap();
        let brightness: Vec<u32> = rgb.chunks_exact(3).map(|pixel| pixel.iter().map(|&channel| u32::from(channel)).sum()).collect();
        assert!(brightness.is_sorted_by(|a, b| a < b), "{brightness:?}");
        assert!(brightness[0] < 10);
    }

    #[test]
    fn what_did_not_count_is_dim() {
        let rgb = heat_picture(&map(vec![1.0, 1.0]), Some(&[0, 1])).unwrap();
        assert!((0..3).all(|channel| rgb[channel] == rgb[3 + channel] / 3), "{rgb:?}");
    }

    #[test]
    fn any_value_has_a_colour() {
        let rgb = heat_picture(&map(vec![f32::NAN, 1.0, 7.0, f32::INFINITY, -1.0, 0.0]), None).unwrap();
        let pixel = |index: usize| &rgb[3 * index..3 * index + 3];
        assert!(pixel(0) == pixel(1) && pixel(2) == pixel(1) && pixel(3) == pixel(1) && pixel(4) == pixel(5));
    }

    #[test]
    fn sizes_are_checked() {
        assert_eq!(heat_picture(&map(vec![0.0; 3]), Some(&[1])), Err(AccuracyError::MaskLength { expected: 3, found: 1 }));
        let torn = ErrorMap { width: 2, height: 2, values: vec![0.0; 3] };
        assert_eq!(heat_picture(&torn, None), Err(AccuracyError::MaskLength { expected: 4, found: 3 }));
    }
}
