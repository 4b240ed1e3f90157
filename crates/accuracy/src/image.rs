//! A picture as it is handed in: borrowed sRGB bytes whose size is known to fit.

use crate::AccuracyError;

/// The most pixels a picture may have: 2²⁶, an 8192×8192 picture.
///
/// FLIP holds about 80 bytes a pixel while it works, 5 GiB at this limit; its library cannot report a failed allocation.
pub const MAX_PIXELS: u32 = 1 << 26;

/// A picture of sRGB bytes, row-major from the top left, three a pixel, no padding. At least one pixel, at most [`MAX_PIXELS`].
#[derive(Debug, Clone, Copy)]
pub struct Image<'a> {
    width: u32,
    height: u32,
    rgb: &'a [u8],
}

impl<'a> Image<'a> {
    /// A picture of `width`×`height` pixels over `rgb`, which holds `width · height · 3` bytes.
    ///
    /// # Errors
    ///
    /// [`NoPixels`](AccuracyError::NoPixels), [`TooManyPixels`](AccuracyError::TooManyPixels) or
    /// [`WrongLength`](AccuracyError::WrongLength).
    pub fn new(width: u32, height: u32, rgb: &'a [u8]) -> Result<Self, AccuracyError> {
        if width == 0 || height == 0 {
            return Err(AccuracyError::NoPixels { width, height });
        }
        // In u64: the product of two u32 always fits.
        let pixels = u64::from(width) * u64::from(height);
        if pixels > u64::from(MAX_PIXELS) {
            return Err(AccuracyError::TooManyPixels { width, height, limit: MAX_PIXELS });
        }
        let expected = pixels as usize * 3;
        if rgb.len() != expected {
            return Err(AccuracyError::WrongLength { width, height, expected, found: rgb.len() });
        }
        Ok(Self { width, height, rgb })
    }

    /// Columns, in pixels.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows, in pixels.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The bytes: red, green, blue of the top left pixel first.
    #[must_use]
    pub fn rgb(&self) -> &'a [u8] {
        self.rgb
    }

    /// How many pixels.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.rgb.len() / 3
    }
}

/// That the two pictures have one size and the mask, if any, one byte for each of their pixels.
pub(crate) fn check_pair(reference: Image, test: Image, mask: Option<&[u8]>) -> Result<(), AccuracyError> {
    let sizes = ((reference.width, reference.height), (test.width, test.height));
    if sizes.0 != sizes.1 {
        return Err(AccuracyError::SizeMismatch { reference: sizes.0, test: sizes.1 });
    }
    let Some(mask) = mask else { return Ok(()) };
    if mask.len() != reference.pixels() {
        return Err(AccuracyError::MaskLength { expected: reference.pixels(), found: mask.len() });
    }
    if mask.iter().all(|&byte| byte == 0) {
        return Err(AccuracyError::EmptyMask { pixels: mask.len() });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_fits_its_size() {
        assert_eq!(Image::new(2, 3, &[0; 18]).unwrap().pixels(), 6);
        let with_alpha = Image::new(2, 3, &[0; 24]).unwrap_err();
        assert_eq!(with_alpha, AccuracyError::WrongLength { width: 2, height: 3, expected: 18, found: 24 });
        assert!(matches!(Image::new(0, 3, &[]), Err(AccuracyError::NoPixels { .. })));
        assert!(matches!(Image::new(u32::MAX, u32::MAX, &[]), Err(AccuracyError::TooManyPixels { .. })));
        assert!(matches!(Image::new(8192, 8193, &[]), Err(AccuracyError::TooManyPixels { .. })));
        assert!(matches!(Image::new(8192, 8192, &[]), Err(AccuracyError::WrongLength { .. })));
    }

    #[test]
    fn a_pair_has_one_size_and_a_mask_that_counts_something() {
        let (wide, tall) = (Image::new(2, 1, &[0; 6]).unwrap(), Image::new(1, 2, &[0; 6]).unwrap());
        assert_eq!(check_pair(wide, tall, None), Err(AccuracyError::SizeMismatch { reference: (2, 1), test: (1, 2) }));
        assert_eq!(check_pair(wide, wide, Some(&[1])), Err(AccuracyError::MaskLength { expected: 2, found: 1 }));
        assert_eq!(check_pair(wide, wide, Some(&[0, 0])), Err(AccuracyError::EmptyMask { pixels: 2 }));
        assert_eq!(check_pair(wide, wide, Some(&[0, 1])), Ok(()));
    }
}
