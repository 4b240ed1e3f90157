//! Linear light: the root mean square error of it, and how much of it there is.

use crate::AccuracyError;
use crate::image::{Image, check_pair};

/// The linear light, 0 to 1, of an sRGB byte: IEC 61966-2-1, the decoding curve.
#[must_use]
pub fn linear_light(byte: u8) -> f64 {
    let encoded = f64::from(byte) / 255.0;
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// The root of the mean squared difference of linear light, 0 (alike) to 1 (black against white), over the three channels of the
/// pixels that `mask` counts (all of them without a mask).
///
/// Linear light adds as energy does, so this is what noise and coverage errors average to; it says nothing of what is seen:
/// [`flip`](crate::flip) does.
///
/// # Errors
///
/// [`SizeMismatch`](AccuracyError::SizeMismatch), [`MaskLength`](AccuracyError::MaskLength) or
/// [`EmptyMask`](AccuracyError::EmptyMask).
pub fn rmse_linear(reference: Image, test: Image, mask: Option<&[u8]>) -> Result<f64, AccuracyError> {
    check_pair(reference, test, mask)?;
    let light: Vec<f64> = (0..=255).map(linear_light).collect();
    let squared = |(a, b): (&u8, &u8)| {
        let difference = light[usize::from(*a)] - light[usize::from(*b)];
        difference * difference
    };
    let mut sum = 0.0;
    let mut counted = 0usize;
    for (index, (a, b)) in reference.rgb().chunks_exact(3).zip(test.rgb().chunks_exact(3)).enumerate() {
        if mask.is_none_or(|mask| mask[index] > 0) {
            sum += a.iter().zip(b).map(squared).sum::<f64>();
            counted += 3;
        }
    }
    Ok((sum / counted as f64).sqrt())
}

/// The light of the test over that of the reference: both the mean of linear light over the three channels of the pixels that `mask` counts (all of them without a mask). 1 where a picture is
/// as bright as it should be; NaN where the reference is black.
///
/// It says what a mean of [`flip`](crate::flip) cannot: whether a picture errs by being too dark or too bright as a whole, which an exposure would mend, or by showing something else.
///
/// # Errors
///
/// [`SizeMismatch`](AccuracyError::SizeMismatch), [`MaskLength`](AccuracyError::MaskLength) or
/// [`EmptyMask`](AccuracyError::EmptyMask).
pub fn light_ratio(reference: Image, test: Image, mask: Option<&[u8]>) -> Result<f64, AccuracyError> {
    check_pair(reference, test, mask)?;
    let light: Vec<f64> = (0..=255).map(linear_light).collect();
    let sum = |image: Image| -> f64 {
        let counted = image.rgb().chunks_exact(3).enumerate().filter(|(index, _)| mask.is_none_or(|mask| mask[*index] > 0));
        counted.flat_map(|(_, pixel)| pixel).map(|&byte| light[usize::from(byte)]).sum()
    };
    let (should, is) = (sum(reference), sum(test));
    Ok(if should > 0.0 { is / should } else { f64::NAN })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_is_srgb() {
        assert_eq!(linear_light(0), 0.0);
        assert_eq!(linear_light(255), 1.0);
        // Half of the light is byte 188 (187.5 exactly); byte 10 lies on the straight part.
        assert!((linear_light(188) - 0.5029).abs() < 1e-4);
        assert!((linear_light(10) - 10.0 / 255.0 / 12.92).abs() < 1e-15);
        assert!((1..=255u8).all(|byte| linear_light(byte) > linear_light(byte - 1)));
    }

    #[test]
    fn known_differences() {
        let black = [0; 12];
        let mut one_white_channel = black;
        one_white_channel[4] = 255;
        let reference = Image::new(2, 2, &black).unwrap();
        let white = Image::new(2, 2, &[255; 12]).unwrap();
        let test = Image::new(2, 2, &one_white_channel).unwrap();
        assert_eq!(rmse_linear(reference, white, None), Ok(1.0));
        assert_eq!(rmse_linear(reference, reference, None), Ok(0.0));
        assert!((rmse_linear(reference, test, None).unwrap() - (1.0f64 / 12.0).sqrt()).abs() < 1e-15);
        assert!((rmse_linear(reference, test, Some(&[0, 9, 0, 0])).unwrap() - (1.0f64 / 3.0).sqrt()).abs() < 1e-15);
        assert_eq!(rmse_linear(reference, test, Some(&[1, 0, 1, 1])), Ok(0.0));
        assert_eq!(rmse_linear(reference, test, None), rmse_linear(test, reference, None));
    }

    #[test]
    fn light_adds_over_what_the_mask_counts() {
        // Byte 188 is half of the light of 255.
        let (white, half) = ([255; 12], [188, 188, 188, 255, 255, 255, 188, 188, 188, 255, 255, 255]);
        let (white, half) = (Image::new(2, 2, &white).unwrap(), Image::new(2, 2, &half).unwrap());
        assert!((light_ratio(white, half, None).unwrap() - 0.75).abs() < 2e-3);
        assert!((light_ratio(half, white, Some(&[1, 0, 1, 0])).unwrap() - 2.0).abs() < 2e-2);
        assert_eq!(light_ratio(half, half, None), Ok(1.0));
        assert!(light_ratio(Image::new(2, 2, &[0; 12]).unwrap(), white, None).unwrap().is_nan());
        assert!(matches!(light_ratio(white, half, Some(&[0; 4])), Err(AccuracyError::EmptyMask { .. })));
    }
}
