//! A picture as the rays made it.

use glam::Vec3;
use pelage_coat::Background;

/// A picture in linear light.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Red, green, blue and coverage, row by row from the top; colour is premultiplied, not clamped, and what of a pixel skin or hair covers is 0 to 1.
    pub pixels: Vec<[f32; 4]>,
    /// Rays from the eye.
    pub camera_rays: u64,
    /// Rays towards lights.
    pub shadow_rays: u64,
}

impl Image {
    /// Before a background, sRGB-encoded: red, green, blue and an alpha of 255, row by row from the top.
    pub fn over(&self, background: &Background) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(4 * self.pixels.len());
        for (row, line) in self.pixels.chunks_exact((self.width as usize).max(1)).enumerate() {
            let height = 1.0 - (row as f32 + 0.5) / self.height as f32;
            let behind = background.bottom.lerp(background.top, height);
            for &[red, green, blue, coverage] in line {
                let colour = Vec3::new(red, green, blue) + behind * (1.0 - coverage);
                bytes.extend(colour.to_array().map(encoded));
                bytes.push(255);
            }
        }
        bytes
    }

    /// Coverage alone, a byte a pixel.
    pub fn coverage(&self) -> Vec<u8> {
        self.pixels.iter().map(|pixel| (pixel[3].clamp(0.0, 1.0) * 255.0).round() as u8).collect()
    }
}

/// Linear light as an sRGB byte.
fn encoded(linear: f32) -> u8 {
    let c = f64::from(linear).clamp(0.0, 1.0);
    let encoded = if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
    (encoded * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colour_goes_over_the_background() {
        let pixels = vec![[0.0; 4], [0.25, 0.5, 1.0, 1.0], [0.25, 0.25, 0.25, 0.5], [9.0, 9.0, 9.0, 1.0]];
        let image = Image { width: 2, height: 2, pixels, camera_rays: 0, shadow_rays: 0 };
        let background = Background { top: Vec3::ONE, bottom: Vec3::ZERO };
        let bytes = image.over(&background);
        // Three quarters of the way up is 0.75, encoded 225; over a quarter 0.25 / 2 is added to 0.25.
        assert_eq!(bytes[..8], [225, 225, 225, 255, 137, 188, 255, 255]);
        assert_eq!(bytes[8..], [165, 165, 165, 255, 255, 255, 255, 255]);
        assert_eq!(image.coverage(), [0, 255, 128, 255]);
    }
}
