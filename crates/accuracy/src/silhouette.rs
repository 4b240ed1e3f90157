//! How opaque pictures are across the outline of one of them.

use crate::AccuracyError;
use crate::distance::signed_distance;

/// Opacity at one distance from the outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfileBin {
    /// Pixels from the reference's outline, outside positive: 0.5 is the bin of all distances up to 1.
    pub distance: f64,
    /// How many pixels lie there, at least 1.
    pub pixels: usize,
    /// The reference's mean alpha, 0 to 1.
    pub reference: f64,
    /// The test's mean alpha, 0 to 1.
    pub test: f64,
}

/// The mean alpha of two pictures as a function of the signed distance from the reference's outline.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Silhouette {
    /// One for each pixel of distance at which there are any, from within to without.
    pub profile: Vec<ProfileBin>,
    /// Pixels by which the test reaches further out than the reference (negative: less far): the area that it covers more, by the length of the outline, which is
    /// the area within reach by twice the reach. An opaque outline that is moved by a pixel all along has 1. Too small where the subject is thinner than the reach.
    pub shift: f64,
    /// Root mean square over the bins of the difference of alpha, 0 to 1: that the test is softer or harder, too.
    pub rms: f64,
    /// Mean difference of alpha over all pixels within reach, −1 to 1: positive where the test covers more.
    pub bias: f64,
}

/// The least alpha that is inside: half.
const INSIDE: u8 = 128;

/// The alpha profile across the outline of `reference`, the contour at which its alpha is one half, out to `reach` pixels on both sides.
///
/// Both are `width · height` bytes of alpha, row-major. A pixel's distance is that from its centre to the nearest pixel on the other side of the contour, less half a
/// pixel; it is exact ([Felzenszwalb and Huttenlocher 2012](https://doi.org/10.4086/toc.2012.v008a019)) for the contour between pixels. What lies beyond the picture's edge is on no side.
///
/// Cost: linear in the pixels.
///
/// # Errors
///
/// [`MaskLength`](AccuracyError::MaskLength) where the alphas do not fit the size; [`NoOutline`](AccuracyError::NoOutline) where the reference is opaque
/// all over, or nowhere.
pub fn silhouette(width: u32, height: u32, reference: &[u8], test: &[u8], reach: u32) -> Result<Silhouette, AccuracyError> {
    let pixels = usize::try_from(u64::from(width) * u64::from(height)).unwrap_or(usize::MAX);
    for found in [reference.len(), test.len()] {
        if found != pixels {
            return Err(AccuracyError::MaskLength { expected: pixels, found });
        }
    }
    let inside: Vec<bool> = reference.iter().map(|&alpha| alpha >= INSIDE).collect();
    let opaque = inside.iter().filter(|&&inside| inside).count();
    if opaque == 0 || opaque == pixels {
        return Err(AccuracyError::NoOutline { opaque, pixels });
    }
    // No distance is greater than the diagonal.
    let reach = reach.min(width.saturating_add(height)) as usize;
    let mut sums = vec![(0usize, 0u64, 0u64); 2 * reach];
    for (index, distance) in signed_distance(width as usize, &inside).into_iter().enumerate() {
        // Never 0: the centre of a pixel is half a pixel from its edge or more.
        let bin = if distance > 0.0 { distance.ceil() - 1.0 } else { distance.floor() } + reach as f64;
        if bin >= 0.0 && (bin as usize) < sums.len() {
            let sum = &mut sums[bin as usize];
            *sum = (sum.0 + 1, sum.1 + u64::from(reference[index]), sum.2 + u64::from(test[index]));
        }
    }
    Ok(Silhouette::of(&sums, reach))
}

impl Silhouette {
    /// From the number of pixels in each bin and the sums of their alphas.
    fn of(sums: &[(usize, u64, u64)], reach: usize) -> Self {
        let mean = |sum: u64, pixels: usize| sum as f64 / (255.0 * pixels as f64);
        let bins = sums.iter().enumerate().filter(|(_, sum)| sum.0 > 0);
        let profile: Vec<ProfileBin> = bins
            .map(|(bin, &(pixels, reference, test))| ProfileBin {
                distance: bin as f64 - reach as f64 + 0.5,
                pixels,
                reference: mean(reference, pixels),
                test: mean(test, pixels),
            })
            .collect();
        let differences = || profile.iter().map(|bin| bin.test - bin.reference);
        let pixels: usize = profile.iter().map(|bin| bin.pixels).sum();
        let rms = (differences().map(|difference| difference * difference).sum::<f64>() / profile.len() as f64).sqrt();
        let bias = profile.iter().map(|bin| (bin.test - bin.reference) * bin.pixels as f64).sum::<f64>() / pixels as f64;
        Self { shift: bias * 2.0 * reach as f64, rms, bias, profile }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDE: u32 = 64;

    /// The left `columns` columns opaque.
    fn half_plane(columns: u32, alpha: u8) -> Vec<u8> {
        (0..SIDE * SIDE).map(|index| if index % SIDE < columns { alpha } else { 0 }).collect()
    }

    fn disc(radius: f64) -> Vec<u8> {
        let at = |index: u32| (f64::from(index % SIDE) - 31.5).hypot(f64::from(index / SIDE) - 31.5);
        (0..SIDE * SIDE).map(|index| if at(index) < radius { 255 } else { 0 }).collect()
    }

    #[test]
    fn alike_has_no_error_and_a_step_for_a_profile() {
        let plane = half_plane(32, 255);
        let found = silhouette(SIDE, SIDE, &plane, &plane, 5).unwrap();
        assert_eq!((found.shift, found.rms, found.bias), (0.0, 0.0, 0.0));
        let profile: Vec<(f64, f64)> = found.profile.iter().map(|bin| (bin.distance, bin.test)).collect();
        let step =
            [-4.5, -3.5, -2.5, -1.5, -0.5, 0.5, 1.5, 2.5, 3.5, 4.5].map(|distance| (distance, if distance < 0.0 { 1.0 } else { 0.0 }));
        assert_eq!(profile, step);
        assert!(found.profile.iter().all(|bin| bin.pixels == SIDE as usize));
    }

    #[test]
    fn an_outline_moved_by_pixels_is_told_by_how_many() {
        for (columns, shift) in [(32, 0.0), (33, 1.0), (36, 4.0), (31, -1.0), (29, -3.0)] {
            let found = silhouette(SIDE, SIDE, &half_plane(32, 255), &half_plane(columns, 255), 8).unwrap();
            assert!((found.shift - shift).abs() < 1e-12, "{columns}: {}", found.shift);
            assert!((found.bias - shift / 16.0).abs() < 1e-12);
        }
        let found = silhouette(SIDE, SIDE, &disc(20.0), &disc(22.0), 8).unwrap();
        // The area of the ring by the length of the outline it lies on.
        let expected = (22.0f64.powi(2) - 20.0f64.powi(2)) / 40.0;
        assert!((found.shift - expected).abs() < 0.1, "{} is not {expected}", found.shift);
    }

    #[test]
    fn a_softer_edge_has_no_shift_but_an_error() {
        let soft: Vec<u8> = (0..SIDE * SIDE).map(|index| [255, 204, 51, 0][(index % SIDE).clamp(30, 33) as usize - 30]).collect();
        let found = silhouette(SIDE, SIDE, &half_plane(32, 255), &soft, 4).unwrap();
        assert!(found.shift.abs() < 1e-12 && found.bias.abs() < 1e-12, "{found:?}");
        // A fifth wrong in two of eight bins.
        assert!((found.rms - 0.1).abs() < 1e-12, "{}", found.rms);
    }

    #[test]
    fn without_an_outline_there_is_no_profile() {
        for opaque in [0, 64] {
            let plane = half_plane(opaque, 255);
            let error = silhouette(SIDE, SIDE, &plane, &plane, 4).unwrap_err();
            assert_eq!(error, AccuracyError::NoOutline { opaque: (opaque * SIDE) as usize, pixels: (SIDE * SIDE) as usize });
        }
        assert!(silhouette(SIDE, SIDE, &half_plane(32, 127), &half_plane(32, 127), 4).is_err(), "less than half is outside");
        assert_eq!(silhouette(2, 2, &[255; 4], &[0; 3], 4), Err(AccuracyError::MaskLength { expected: 4, found: 3 }));
        assert!(silhouette(SIDE, SIDE, &half_plane(32, 255), &half_plane(9, 255), u32::MAX).is_ok());
    }
}
