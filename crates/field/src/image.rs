//! Looking up an image.

use glam::DVec2;

use crate::FieldError;

/// RGBA8 pixels in sRGB, rows from the top, repeated without end.
pub(crate) struct Image<'a> {
    pixels: &'a [[u8; 4]],
    width: usize,
    height: usize,
    /// What each byte of a colour channel is in linear light.
    linear: [f64; 256],
}

impl<'a> Image<'a> {
    pub(crate) fn new(bytes: &'a [u8], width: u32, height: u32) -> Result<Self, FieldError> {
        let (pixels, rest) = bytes.as_chunks::<4>();
        let count = u64::from(width) * u64::from(height);
        if count == 0 || pixels.len() as u64 != count || !rest.is_empty() {
            return Err(FieldError::ImageSize { width, height, bytes: bytes.len(), expected: count.saturating_mul(4) });
        }
        Ok(Self {
            pixels,
            width: width as usize,
            height: height as usize,
            linear: std::array::from_fn(|byte| to_linear(byte as f64 / 255.0)),
        })
    }

    /// Linear red, green, blue and alpha, 0 to 1, between the four pixels around a place; pixel centres lie at halves.
    pub(crate) fn sample(&self, place: DVec2) -> [f64; 4] {
        let (left, right, across) = neighbours(place.x, self.width);
        let (top, bottom, down) = neighbours(1.0 - place.y.rem_euclid(1.0), self.height);
        let corners = [
            (left, top, (1.0 - across) * (1.0 - down)),
            (right, top, across * (1.0 - down)),
            (left, bottom, (1.0 - across) * down),
            (right, bottom, across * down),
        ];
        corners.into_iter().fold([0.0; 4], |sum, (x, y, weight)| {
            let pixel = self.linear_pixel(x, y);
            std::array::from_fn(|k| sum[k] + weight * pixel[k])
        })
    }

    fn linear_pixel(&self, x: usize, y: usize) -> [f64; 4] {
        let [red, green, blue, alpha] = self.pixels[y * self.width + x];
        let colour = |byte: u8| self.linear[byte as usize];
        [colour(red), colour(green), colour(blue), f64::from(alpha) / 255.0]
    }
}

/// The two pixels around a place along one side of `count` pixels, and how far it is from the first to the second.
fn neighbours(place: f64, count: usize) -> (usize, usize, f64) {
    let position = place.rem_euclid(1.0) * count as f64 - 0.5;
    let floor = position.floor();
    let first = (floor as i64).rem_euclid(count as i64) as usize;
    (first, (first + 1) % count, position - floor)
}

/// The decoding function of sRGB (IEC 61966-2-1).
fn to_linear(encoded: f64) -> f64 {
    if encoded <= 0.04045 { encoded / 12.92 } else { libm::pow((encoded + 0.055) / 1.055, 2.4) }
}
