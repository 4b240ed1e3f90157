//! An artist's pictures as a fin (L9) and as shells (K2).

use rayon::prelude::*;

use crate::error::{VolumeError, within};
use crate::image::{FinTexture, ShellStack, Work};
use crate::mips::image_mips;
use crate::pixels::{Pixels, resized};
use crate::plane::Plane;
use crate::stack::StackSettings;

/// Most texels along and up a fin.
const MOST: [u32; 2] = [8192, 2048];

/// A fin from a picture: the skin at the bottom row, the tips at the top, repeating across.
///
/// Sides that are no powers of two become the next larger (8192 and 2048 at most): each texel is the mean, premultiplied and in linear light, of the part of the picture that it covers, so
/// that the picture's coverage is kept exactly and its left and right edges meet as they did. Its `height` is 1, as a picture does not know how high it is beside a tile.
///
/// # Errors
/// Bytes that do not fit the size, no pixels, tiles outside 1 to 64.
pub fn fin_from_pixels(picture: &Pixels<'_>, tiles_across: u32) -> Result<FinTexture, VolumeError> {
    within("tiles_across", f64::from(tiles_across), 1.0, 64.0, "tiles")?;
    let plane = picture.plane()?;
    let sides = [picture.width, picture.height].map(|side| side.checked_next_power_of_two().unwrap_or(u32::MAX));
    let plane = resized(&plane, sides[0].min(MOST[0]), sides[1].min(MOST[1]));
    Ok(FinTexture { tiles_across, height: 1.0, mips: image_mips(plane), work: Work::default() })
}

/// Shells from an artist's pictures of the tile, which repeats both ways.
///
/// Of one picture alpha says how high the hair stands, 0 none and 255 to the tips; its colour is that of the hair from root to tip. Several are a stack, the skin first and the tips last, each
/// a layer as it is: `layers` does not count. Pictures of any size become as fine as the resolution, each texel the mean of what it covers.
///
/// # Errors
/// No pictures, more than 256, bytes that do not fit their size, settings out of range.
pub fn shells_from_pixels(pictures: &[Pixels<'_>], settings: &StackSettings) -> Result<ShellStack, VolumeError> {
    let side = settings.resolution;
    let planes = match pictures {
        [heights] => {
            settings.validate()?;
            let (plane, heights) = (heights.plane()?, settings.spacing.heights(settings.layers));
            heights.par_iter().map(|&height| resized(&standing(&plane, height as f32), side, side)).collect()
        }
        stack => {
            StackSettings { layers: stack.len() as u32, ..*settings }.validate()?;
            stack.par_iter().map(|picture| Ok(resized(&picture.plane()?, side, side))).collect::<Result<Vec<_>, VolumeError>>()?
        }
    };
    Ok(settings.stack(planes))
}

/// What of a picture stands as high, all of it opaque.
fn standing(plane: &Plane, height: f32) -> Plane {
    let mut out = Plane::new(plane.width, plane.height);
    for (to, from) in out.texels.iter_mut().zip(&plane.texels) {
        if from[3] > 0.0 && from[3] >= height {
            *to = [from[0] / from[3], from[1] / from[3], from[2] / from[3], 1.0];
        }
    }
    out
}
