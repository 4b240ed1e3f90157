//! Pictures as image files hold them, made into planes.

use crate::error::VolumeError;
use crate::plane::Plane;
use crate::srgb::srgb_to_linear;

/// A picture as RGBA8: sRGB-encoded, alpha straight, row by row from the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pixels<'a> {
    /// `4 * width * height` bytes.
    pub rgba: &'a [u8],
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
}

impl Pixels<'_> {
    /// Linear and premultiplied.
    pub(crate) fn plane(&self) -> Result<Plane, VolumeError> {
        let (width, height, length) = (self.width, self.height, self.rgba.len() as u64);
        let expected = u64::from(width).saturating_mul(u64::from(height)).saturating_mul(4);
        if expected == 0 || expected != length {
            return Err(VolumeError::Pixels { width, height, expected, length });
        }
        let mut plane = Plane::new(width as usize, height as usize);
        for (texel, pixel) in plane.texels.iter_mut().zip(self.rgba.as_chunks::<4>().0) {
            let alpha = f32::from(pixel[3]) / 255.0;
            *texel = [srgb_to_linear(pixel[0]) * alpha, srgb_to_linear(pixel[1]) * alpha, srgb_to_linear(pixel[2]) * alpha, alpha];
        }
        Ok(plane)
    }
}

/// The plane in another size: each texel is the mean of the part that it covers, so that coverage is kept and opposite edges meet as they did.
pub(crate) fn resized(plane: &Plane, width: u32, height: u32) -> Plane {
    turned(&across(&turned(&across(plane, width as usize)), height as usize))
}

/// `width` texels wide.
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
