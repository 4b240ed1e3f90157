//! Colours as files have them.

/// A channel in linear light, 0 to 1, of one in sRGB, 0 to 1: the decoding function of IEC 61966-2-1.
///
/// Beyond 1 it goes on as it comes, below 0 along the line it has there, and what is no number stays so.
#[inline]
pub fn srgb_to_linear(encoded: f64) -> f64 {
    if encoded <= 0.04045 { encoded / 12.92 } else { libm::pow((encoded + 0.055) / 1.055, 2.4) }
}
