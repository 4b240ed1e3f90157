//! Which pixels count.

use crate::{AccuracyError, Image};

/// 255 where a pixel of `image` differs from `background` (sRGB bytes) by more than `tolerance` in any channel, else 0.
///
/// The subject of a picture drawn over one flat colour. A tolerance of 0 also counts the faintest edge pixel.
#[must_use]
pub fn unlike_background(image: Image, background: [u8; 3], tolerance: u8) -> Vec<u8> {
    let differs = |pixel: &[u8]| pixel.iter().zip(background).any(|(&channel, ground)| channel.abs_diff(ground) > tolerance);
    image.rgb().chunks_exact(3).map(|pixel| if differs(pixel) { 255 } else { 0 }).collect()
}

/// 255 where either mask is above zero, else 0.
///
/// # Errors
///
/// [`MaskLength`](AccuracyError::MaskLength) if the masks are of different lengths.
pub fn union(first: &[u8], second: &[u8]) -> Result<Vec<u8>, AccuracyError> {
    if first.len() != second.len() {
        return Err(AccuracyError::MaskLength { expected: first.len(), found: second.len() });
    }
    Ok(first.iter().zip(second).map(|(&a, &b)| if a > 0 || b > 0 { 255 } else { 0 }).collect())
}

/// 255 where a pixel above zero lies within `radius` pixels along both axes (a square of side `2 · radius + 1`), else 0.
///
/// Linear in the number of pixels, whatever the radius. `mask` is row-major with `width` columns.
///
/// # Errors
///
/// [`MaskLength`](AccuracyError::MaskLength) if `mask` does not hold `width · height` bytes.
pub fn dilate(mask: &[u8], width: u32, height: u32, radius: u32) -> Result<Vec<u8>, AccuracyError> {
    let expected = usize::try_from(u64::from(width) * u64::from(height)).unwrap_or(usize::MAX);
    if mask.len() != expected {
        return Err(AccuracyError::MaskLength { expected, found: mask.len() });
    }
    let (columns, rows) = (width as usize, height as usize);
    let mut along_rows = vec![0; mask.len()];
    for row in 0..rows {
        dilate_line(mask, &mut along_rows, row * columns, 1, columns, radius);
    }
    let mut dilated = vec![0; mask.len()];
    for column in 0..columns {
        dilate_line(&along_rows, &mut dilated, column, columns, rows, radius);
    }
    Ok(dilated)
}

/// Sets each of `count` places of a line (from `start`, `stride` apart) that has a place above zero within `radius`.
fn dilate_line(source: &[u8], target: &mut [u8], start: usize, stride: usize, count: usize, radius: u32) {
    let radius = radius as usize;
    let place = |index: usize| start + index * stride;
    // `reach` is the end of what the places above zero seen so far cover: forwards, then backwards.
    let mut reach = 0;
    for index in 0..count {
        if source[place(index)] > 0 {
            reach = index.saturating_add(radius).saturating_add(1);
        }
        if index < reach {
            target[place(index)] = 255;
        }
    }
    let mut reach = count;
    for index in (0..count).rev() {
        if source[place(index)] > 0 {
            reach = index.saturating_sub(radius);
        }
        if index >= reach {
            target[place(index)] = 255;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The definition, pixel by pixel.
    fn dilate_slowly(mask: &[u8], width: i64, height: i64, radius: i64) -> Vec<u8> {
        let set = |x: i64, y: i64| (0..width).contains(&x) && (0..height).contains(&y) && mask[(y * width + x) as usize] > 0;
        let near = |x: i64, y: i64| (y - radius..=y + radius).any(|v| (x - radius..=x + radius).any(|u| set(u, v)));
        (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| if near(x, y) { 255 } else { 0 }).collect()
    }

    #[test]
    fn dilation_is_a_square_about_each_pixel() {
        let mut mask = vec![0; 9 * 7];
        mask[2 * 9 + 3] = 1;
        mask[6 * 9 + 8] = 200;
        for radius in [0, 1, 2, 5, 100] {
            assert_eq!(dilate(&mask, 9, 7, radius).unwrap(), dilate_slowly(&mask, 9, 7, i64::from(radius)), "radius {radius}");
        }
        assert_eq!(dilate(&mask, 9, 7, u32::MAX).unwrap(), vec![255; 63]);
        assert_eq!(dilate(&[0; 63], 9, 7, 3).unwrap(), vec![0; 63], "nothing spreads from nothing");
    }

    #[test]
    fn dilation_refuses_another_size() {
        assert_eq!(dilate(&[0; 5], 2, 3, 1), Err(AccuracyError::MaskLength { expected: 6, found: 5 }));
        assert!(dilate(&[], u32::MAX, u32::MAX, 1).is_err());
        assert_eq!(dilate(&[], 0, 3, 1), Ok(vec![]));
    }

    #[test]
    fn union_counts_what_either_counts() {
        assert_eq!(union(&[0, 1, 0, 9], &[0, 0, 2, 9]).unwrap(), [0, 255, 255, 255]);
        assert_eq!(union(&[0], &[0, 0]), Err(AccuracyError::MaskLength { expected: 1, found: 2 }));
    }

    #[test]
    fn the_background_does_not_count() {
        let bytes = [10, 20, 30, 10, 22, 30, 13, 20, 30];
        let image = Image::new(3, 1, &bytes).unwrap();
        assert_eq!(unlike_background(image, [10, 20, 30], 0), [0, 255, 255]);
        assert_eq!(unlike_background(image, [10, 20, 30], 2), [0, 0, 255]);
    }
}
