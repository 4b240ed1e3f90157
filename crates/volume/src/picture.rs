//! An artist's picture as a fin (L9).

use crate::error::{VolumeError, within};
use crate::image::{FinTexture, Work};
use crate::mips::image_mips;
use crate::plane::Plane;
use crate::srgb::srgb_to_linear;

/// Most texels along and up a fin.
const MOST: [u32; 2] = [8192, 2048];

/// A fin from RGBA8 pixels, sRGB-encoded, alpha straight, as image files hold them: the skin at the bottom row, the tips at the top, repeating across.
///
/// Sides that are no powers of two become the next larger (8192 and 2048 at most): each texel is the mean, premultiplied and in linear light, of the part of the picture that it covers, so
/// that the picture's coverage is kept exactly and its left and right edges meet as they did. Its `height` is 1, as a picture does not know how high it is beside a tile.
///
/// # Errors
/// Bytes that do not fit the size, no pixels, tiles outside 1 to 64.
pub fn fin_from_pixels(pixels: &[u8], width: u32, height: u32, tiles_across: u32) -> Result<FinTexture, VolumeError> {
    within("tiles_across", f64::from(tiles_across), 1.0, 64.0, "tiles")?;
    let expected = u64::from(width).saturating_mul(u64::from(height)).saturating_mul(4);
    let length = pixels.len() as u64;
    if expected == 0 || expected != length {
        return Err(VolumeError::Pixels { width, height, expected, length });
    }
    let mut plane = Plane::new(width as usize, height as usize);
    for (texel, pixel) in plane.texels.iter_mut().zip(pixels.as_chunks::<4>().0) {
        let alpha = f32::from(pixel[3]) / 255.0;
        *texel = [srgb_to_linear(pixel[0]) * alpha, srgb_to_linear(pixel[1]) * alpha, srgb_to_linear(pixel[2]) * alpha, alpha];
    }
    let sides = [width, height].map(|side| side.checked_next_power_of_two().unwrap_or(u32::MAX));
    let plane = across(&plane, sides[0].min(MOST[0]) as usize);
    let plane = turned(&across(&turned(&plane), sides[1].min(MOST[1]) as usize));
    Ok(FinTexture { tiles_across, height: 1.0, mips: image_mips(plane), work: Work::default() })
}

/// The picture `width` texels wide, each the mean of what it covers.
fn across(plane: &Plane, width: usize) -> Plane {
    if width == plane.width {
        return plane.clone();
    }
    let mut out = Plane::new(width, plane.height);
    let step = plane.width as f64 / width as f64;
    for (to, from) in out.texels.chunks_exact_mut(width).zip(plane.texels.chunks_exact(plane.width)) {
        for (x, texel) in to.iter_mut().enumerate() {
            let (begin, end) = (x as f64 * step, (x + 1) as f64 * step);
            let last = (end.ceil() as usize).min(from.len());
            for (index, source) in from.iter().enumerate().take(last).skip(begin as usize) {
                let part = (end.min(index as f64 + 1.0) - begin.max(index as f64)).max(0.0) / step;
                *texel = [0, 1, 2, 3].map(|channel| texel[channel] + part as f32 * source[channel]);
            }
        }
    }
    out
}

/// Rows for columns.
fn turned(plane: &Plane) -> Plane {
    let mut out = Plane::new(plane.height, plane.width);
    for (index, texel) in plane.texels.iter().enumerate() {
        out.texels[index % plane.width * plane.height + index / plane.width] = *texel;
    }
    out
}
