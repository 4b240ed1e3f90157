//! The contact sheet: every picture with where it errs below.

use image::{ExtendedColorType, RgbImage, imageops};

use super::errors::rgb;
use super::run::Measured;
use crate::failure::Failure;
use crate::render::encode_png;

/// The widest a picture is on the sheet, in pixels.
const WIDEST: u32 = 320;

/// Pixels between pictures.
const GAP: u32 = 4;

/// The sheet as PNG, in reading order: first what all are measured against, alone; then each setting's picture, above its FLIP error. Where each has a picture of its own to be
/// measured against, that is above it instead.
pub(crate) fn draw(measured: &Measured) -> Result<Vec<u8>, Failure> {
    let mut stacks: Vec<Vec<RgbImage>> = Vec::new();
    for one in &measured.settings {
        let size = (one.picture.width, one.picture.height);
        let heat = small(size, one.errors.heat.clone())?;
        let reference = || small((one.reference.width, one.reference.height), rgb(&one.reference));
        if measured.one_reference && stacks.is_empty() {
            stacks.push(vec![reference()?]);
        }
        let own = if measured.one_reference { None } else { Some(reference()?) };
        stacks.push(own.into_iter().chain([small(size, rgb(&one.picture))?, heat]).collect());
    }
    let sheet = placed(&stacks);
    encode_png(sheet.as_raw(), sheet.dimensions(), ExtendedColorType::Rgb8)
}

/// The stacks in rows, about twice as many pictures across as down.
fn placed(stacks: &[Vec<RgbImage>]) -> RgbImage {
    let most = |of: fn(&RgbImage) -> u32| stacks.iter().flatten().map(of).max().unwrap_or(1);
    let (width, height) = (most(RgbImage::width) + GAP, most(RgbImage::height) + GAP);
    let deep = stacks.iter().map(Vec::len).max().unwrap_or(1) as u32;
    let across = ((2 * deep as usize * stacks.len()) as f64).sqrt().ceil().clamp(1.0, stacks.len().max(1) as f64) as u32;
    let down = (stacks.len() as u32).div_ceil(across);
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

/// A picture, no wider than it may be.
fn small((width, height): (u32, u32), rgb: Vec<u8>) -> Result<RgbImage, Failure> {
    let picture = RgbImage::from_raw(width, height, rgb).ok_or_else(|| Failure::Input("a picture has not the bytes of its size".into()))?;
    if width <= WIDEST {
        return Ok(picture);
    }
    let height = (u64::from(height) * u64::from(WIDEST) / u64::from(width)).max(1) as u32;
    Ok(imageops::thumbnail(&picture, WIDEST, height))
}
