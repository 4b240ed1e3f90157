//! Looking up an image.

use glam::{DVec2, Vec4};
use pelage_mesh::srgb_to_linear;

use crate::FieldError;

/// Pixels in sRGB with alpha, rows from the top, repeated without end in both directions.
///
/// (0, 0) of the texture coordinates is the lower left corner, (1, 1) the upper right.
#[derive(Clone, Debug)]
pub struct Image<'a> {
    pixels: Pixels<'a>,
    width: usize,
    height: usize,
    /// What each number of a colour channel is in linear light.
    linear: Vec<f64>,
}

/// Red, green, blue and alpha.
#[derive(Clone, Copy, Debug)]
enum Pixels<'a> {
    Eight(&'a [[u8; 4]]),
    Sixteen(&'a [[u16; 4]]),
}

impl<'a> Image<'a> {
    /// Of `width` × `height` pixels of four bytes.
    ///
    /// # Errors
    /// Where the bytes do not fit the size, or there is no pixel.
    pub fn rgba8(bytes: &'a [u8], width: u32, height: u32) -> Result<Self, FieldError> {
        let (pixels, rest) = bytes.as_chunks::<4>();
        Self::new(Pixels::Eight(pixels), pixels.len(), rest.len(), (width, height), 255)
    }

    /// Of `width` × `height` pixels of four 16-bit numbers.
    ///
    /// # Errors
    /// Where the numbers do not fit the size, or there is no pixel.
    pub fn rgba16(numbers: &'a [u16], width: u32, height: u32) -> Result<Self, FieldError> {
        let (pixels, rest) = numbers.as_chunks::<4>();
        Self::new(Pixels::Sixteen(pixels), pixels.len(), rest.len(), (width, height), 65535)
    }

    fn new(pixels: Pixels<'a>, found: usize, rest: usize, (width, height): (u32, u32), most: u16) -> Result<Self, FieldError> {
        let count = u64::from(width) * u64::from(height);
        if count == 0 || found as u64 != count || rest != 0 {
            return Err(FieldError::ImageSize { width, height, numbers: 4 * found + rest, expected: count.saturating_mul(4) });
        }
        let linear = (0..=most).map(|number| srgb_to_linear(f64::from(number) / f64::from(most))).collect();
        Ok(Self { pixels, width: width as usize, height: height as usize, linear })
    }

    /// The colour at a place, in linear light, and alpha: between the four pixels around it, whose centres lie at halves.
    pub fn at(&self, place: DVec2) -> Vec4 {
        Vec4::from(self.sample(place).map(|channel| channel as f32))
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
        let place = y * self.width + x;
        let [red, green, blue, alpha] = match self.pixels {
            Pixels::Eight(pixels) => pixels[place].map(u16::from),
            Pixels::Sixteen(pixels) => pixels[place],
        };
        let colour = |number: u16| self.linear[number as usize];
        [colour(red), colour(green), colour(blue), f64::from(alpha) / (self.linear.len() - 1) as f64]
    }
}

/// The two pixels around a place along one side of `count` pixels, and how far it is from the first to the second.
fn neighbours(place: f64, count: usize) -> (usize, usize, f64) {
    let position = place.rem_euclid(1.0) * count as f64 - 0.5;
    let floor = position.floor();
    let first = (floor as i64).rem_euclid(count as i64) as usize;
    (first, (first + 1) % count, position - floor)
}
