//! Images before they are rounded to bytes.

use crate::image::Image;
use crate::srgb::{Encoder, srgb_to_linear};

/// RGBA in linear light, premultiplied; `f32`, as a byte is all that will be kept of it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Plane {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) texels: Vec<[f32; 4]>,
}

impl Plane {
    pub(crate) fn new(width: usize, height: usize) -> Self {
        Self { width, height, texels: vec![[0.0; 4]; width * height] }
    }

    /// Half as wide and high, no side under one: each texel the mean of those it covers. Sides are powers of two.
    pub(crate) fn halved(&self) -> Self {
        let (step_x, step_y) = (if self.width > 1 { 2 } else { 1 }, if self.height > 1 { 2 } else { 1 });
        let mut half = Self::new(self.width / step_x, self.height / step_y);
        let share = 1.0 / (step_x * step_y) as f32;
        for (index, texel) in half.texels.iter_mut().enumerate() {
            let (x, y) = (index % (self.width / step_x), index / (self.width / step_x));
            for row in 0..step_y {
                let begin = (y * step_y + row) * self.width + x * step_x;
                for source in &self.texels[begin..begin + step_x] {
                    for channel in 0..4 {
                        texel[channel] += source[channel] * share;
                    }
                }
            }
        }
        half
    }

    /// One image of a level, read back. An image that is not there is empty.
    pub(crate) fn decoded(image: &Image, layer: u32) -> Self {
        let mut plane = Self::new(image.width as usize, image.height as usize);
        let size = plane.texels.len();
        let bytes = image.texels.chunks_exact(4).skip(layer as usize * size);
        for (texel, bytes) in plane.texels.iter_mut().zip(bytes) {
            *texel = [srgb_to_linear(bytes[0]), srgb_to_linear(bytes[1]), srgb_to_linear(bytes[2]), f32::from(bytes[3]) / 255.0];
        }
        plane
    }

    /// Lays another over it: premultiplied, so that every channel is what is above and what of the one below shows through.
    pub(crate) fn cover(&mut self, above: &Self) {
        for (below, above) in self.texels.iter_mut().zip(&above.texels) {
            let open = 1.0 - above[3];
            for channel in 0..4 {
                below[channel] = above[channel] + below[channel] * open;
            }
        }
    }

    pub(crate) fn is_one_texel(&self) -> bool {
        self.width <= 1 && self.height <= 1
    }
}

/// Layers of one level, encoded one after the other.
///
/// Coverage is rounded so that a layer's mean is kept: what one texel's byte lacks or has too much goes to the next that holds hair, row by row. Rounded each for
/// itself, hair that covers under half a step would vanish. Colour follows its texel's rounded coverage.
pub(crate) fn encode(layers: &[Plane]) -> Image {
    let encoder = Encoder::new();
    let (width, height) = layers.first().map_or((0, 0), |plane| (plane.width, plane.height));
    let mut texels = Vec::with_capacity(4 * width * height * layers.len());
    for plane in layers {
        let mut owed = 0.0f32;
        for texel in &plane.texels {
            // Without hair or wholly covered there is nothing to round.
            let wanted = texel[3].clamp(0.0, 1.0) * 255.0;
            let byte = if wanted > 0.0 && wanted < 255.0 { (wanted + owed + 0.5).clamp(0.0, 255.0) as u8 } else { wanted as u8 };
            owed += wanted - f32::from(byte);
            let share = if wanted > 0.0 { f32::from(byte) / wanted } else { 0.0 };
            // Premultiplied colour cannot exceed what covers.
            texels.extend(texel[..3].iter().map(|&c| encoder.byte((c * share).min(f32::from(byte) / 255.0))));
            texels.push(byte);
        }
    }
    Image { width: width as u32, height: height as u32, layers: layers.len() as u32, texels }
}
