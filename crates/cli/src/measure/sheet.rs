//! The contact sheet: every picture with where it errs below.

use image::RgbImage;

use super::errors::rgb;
use super::run::Measured;
use crate::contact::{placed, png, within};
use crate::failure::Failure;

/// The widest a picture is on the sheet, in pixels.
const WIDEST: u32 = 320;

/// The sheet as PNG, in reading order: first what all are measured against, alone; then each setting's picture, above its FLIP error. Where each has a picture of its own to be
/// measured against, that is above it instead.
pub(crate) fn draw(measured: &Measured) -> Result<Vec<u8>, Failure> {
    let small = |size, rgb| within((WIDEST, u32::MAX), size, rgb);
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
    png(&placed(&stacks))
}
