//! Contact sheets: pictures side by side, small.

use image::{ExtendedColorType, RgbImage, imageops};

use crate::failure::Failure;
use crate::render::encode_png;

/// Pixels between pictures.
const GAP: u32 = 4;

/// Stacks of pictures in rows, about twice as many pictures across as down, on white.
pub(crate) fn placed(stacks: &[Vec<RgbImage>]) -> RgbImage {
    let deep = stacks.iter().map(Vec::len).max().unwrap_or(1) as u32;
    let across = ((2 * deep as usize * stacks.len()) as f64).sqrt().ceil() as u32;
    in_rows_of(across, stacks)
}

/// Stacks of pictures, so many in a row.
pub(crate) fn in_rows_of(across: u32, stacks: &[Vec<RgbImage>]) -> RgbImage {
    let most = |of: fn(&RgbImage) -> u32| stacks.iter().flatten().map(of).max().unwrap_or(1);
    let (width, height) = (most(RgbImage::width) + GAP, most(RgbImage::height) + GAP);
    let deep = stacks.iter().map(Vec::len).max().unwrap_or(1) as u32;
    let across = across.clamp(1, stacks.len().max(1) as u32);
    let down = (stacks.len().max(1) as u32).div_ceil(across);
    let mut sheet = RgbImage::from_pixel(across * width - GAP, down * deep * height - GAP, image::Rgb([255; 3]));
    for (index, stack) in stacks.iter().enumerate() {
        let (column, row) = (index as u32 % across, index as u32 / across);
        for (level, picture) in stack.iter().enumerate() {
            let (x, y) = (column * width, (row * deep + level as u32) * height);
            imageops::replace(&mut sheet, picture, x.into(), y.into());
        }
    }
    sheet
}

/// A picture of three bytes a pixel, made smaller until it is no wider and no higher than it may be.
pub(crate) fn within((widest, highest): (u32, u32), (width, height): (u32, u32), rgb: Vec<u8>) -> Result<RgbImage, Failure> {
    let picture = RgbImage::from_raw(width, height, rgb).ok_or_else(|| Failure::Input("a picture has not the bytes of its size".into()))?;
    if width <= widest && height <= highest {
        return Ok(picture);
    }
    let (wide, high) = (u64::from(width), u64::from(height));
    let by_width = wide * u64::from(highest) >= high * u64::from(widest);
    let (width, height) = if by_width {
        (widest, (high * u64::from(widest) / wide.max(1)).max(1) as u32)
    } else {
        ((wide * u64::from(highest) / high.max(1)).max(1) as u32, highest)
    };
    Ok(imageops::thumbnail(&picture, width, height))
}

/// The sheet as PNG.
pub(crate) fn png(sheet: &RgbImage) -> Result<Vec<u8>, Failure> {
    encode_png(sheet.as_raw(), sheet.dimensions(), ExtendedColorType::Rgb8)
}
