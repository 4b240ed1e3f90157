//! The sRGB transfer function (IEC 61966-2-1).

use libm::pow;
use std::sync::LazyLock;

/// Linear light of an sRGB byte, 0 to 1.
pub fn srgb_to_linear(byte: u8) -> f32 {
    static TABLE: LazyLock<[f32; 256]> = LazyLock::new(|| std::array::from_fn(|i| decode(i as f64 / 255.0) as f32));
    TABLE[byte as usize]
}

/// The nearest sRGB byte to linear light; what lies outside [0, 1] is cut off.
pub fn linear_to_srgb(linear: f32) -> u8 {
    Encoder::new().byte(linear)
}

fn decode(encoded: f64) -> f64 {
    if encoded <= 0.040_45 { encoded / 12.92 } else { pow((encoded + 0.055) / 1.055, 2.4) }
}

/// How finely linear light is tabled before the exact comparison.
const BINS: usize = 4096;

/// Encodes to the nearest byte without a power for each texel: a table gives the byte to begin from, comparisons with the exact limits the rest.
#[derive(Clone, Copy)]
pub(crate) struct Encoder {
    tables: &'static (Vec<u8>, [f32; 256]),
}

impl Encoder {
    pub(crate) fn new() -> Self {
        static TABLES: LazyLock<(Vec<u8>, [f32; 256])> = LazyLock::new(|| {
            // limit[b] is the linear light from which byte b is nearest.
            let limits: [f32; 256] = std::array::from_fn(|b| if b == 0 { 0.0 } else { decode((b as f64 - 0.5) / 255.0) as f32 });
            let first = |bin: usize| limits.partition_point(|&limit| limit <= bin as f32 / BINS as f32).saturating_sub(1) as u8;
            ((0..=BINS).map(first).collect(), limits)
        });
        Self { tables: &TABLES }
    }

    pub(crate) fn byte(self, linear: f32) -> u8 {
        // NaN becomes 0 in the cast.
        let value = linear.clamp(0.0, 1.0);
        let (bins, limits) = self.tables;
        let mut byte = bins[((value * BINS as f32) as usize).min(BINS)];
        while byte < 255 && value >= limits[byte as usize + 1] {
            byte += 1;
        }
        byte
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_comes_back() {
        assert!((0..=255u8).all(|byte| linear_to_srgb(srgb_to_linear(byte)) == byte));
    }

    #[test]
    fn encoding_is_to_the_nearest_byte() {
        for i in 0..=100_000 {
            let linear = i as f32 / 100_000.0;
            let l = f64::from(linear);
            let encoded = if l <= 0.003_130_8 { 12.92 * l } else { 1.055 * pow(l, 1.0 / 2.4) - 0.055 };
            assert!((f64::from(linear_to_srgb(linear)) - 255.0 * encoded).abs() < 0.5 + 1e-3, "{linear}");
        }
        assert_eq!([linear_to_srgb(f32::NAN), linear_to_srgb(-1.0), linear_to_srgb(9.0)], [0, 0, 255]);
    }
}
