//! How far a picture is from the one it should be.

use pelage_accuracy::{
    AccuracyError, DEFAULT_PIXELS_PER_DEGREE, Image, ProfileBin, dilate, flip, heat_picture, light_ratio, rmse_linear, silhouette, union,
};
use pelage_nodes::Picture;

/// Pixels on both sides of the outline over which alpha is compared.
const REACH: u32 = 8;

/// The errors of one setting.
pub(crate) struct Errors {
    pub(crate) flip_mean: f64,
    pub(crate) flip_p99: f64,
    pub(crate) rmse_linear: f64,
    pub(crate) light: f64,
    /// NaN, as the two that follow, where the reference has no outline in the picture.
    pub(crate) outline_shift: f64,
    pub(crate) outline_rms: f64,
    pub(crate) alpha_bias: f64,
    pub(crate) profile: Vec<ProfileBin>,
    /// FLIP as a picture, three bytes a pixel.
    pub(crate) heat: Vec<u8>,
}

impl Errors {
    /// Over what either picture covers and two pixels around.
    pub(crate) fn of(reference: &Picture, test: &Picture) -> Result<Self, AccuracyError> {
        let (reference_rgb, test_rgb) = (rgb(reference), rgb(test));
        let (width, height) = (reference.width, reference.height);
        let (a, b) = (Image::new(width, height, &reference_rgb)?, Image::new(test.width, test.height, &test_rgb)?);
        if (width, height) != (test.width, test.height) {
            return Err(AccuracyError::SizeMismatch { reference: (width, height), test: (test.width, test.height) });
        }
        let mask = dilate(&union(&reference.coverage, &test.coverage)?, width, height, 2)?;
        let seen = flip(a, b, Some(&mask), DEFAULT_PIXELS_PER_DEGREE)?;
        let outline = match silhouette(width, height, &reference.coverage, &test.coverage, REACH) {
            Err(AccuracyError::NoOutline { .. }) => None,
            other => Some(other?),
        };
        let of_outline = |pick: fn(&pelage_accuracy::Silhouette) -> f64| outline.as_ref().map_or(f64::NAN, pick);
        Ok(Self {
            flip_mean: seen.mean,
            flip_p99: seen.p99,
            rmse_linear: rmse_linear(a, b, Some(&mask))?,
            light: light_ratio(a, b, Some(&mask))?,
            outline_shift: of_outline(|outline| outline.shift),
            outline_rms: of_outline(|outline| outline.rms),
            alpha_bias: of_outline(|outline| outline.bias),
            heat: heat_picture(&seen.map, Some(&mask))?,
            profile: outline.map(|outline| outline.profile).unwrap_or_default(),
        })
    }
}

/// Without the alpha, which is 255.
pub(crate) fn rgb(picture: &Picture) -> Vec<u8> {
    picture.rgba.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect()
}
