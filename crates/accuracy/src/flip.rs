//! FLIP over the pixels that count.

use std::ops::RangeInclusive;

use nv_flip::FlipImageRgb8;

use crate::image::{Image, check_pair};
use crate::{AccuracyError, percentile};

/// The viewing condition FLIP's authors propose: 67 pixels to a degree of the visual field, about what a 0.7 m wide screen of 3840
/// pixels shows at 0.7 m (Andersson et al. 2020, section 4).
///
/// Fewer pixels per degree is a viewer further away or a coarser screen, which blurs small differences and large ones alike: at 67
/// a difference is averaged over about ±10 pixels.
pub const DEFAULT_PIXELS_PER_DEGREE: f32 = 67.0;

/// The viewing conditions accepted. Below, FLIP's feature filters are narrower than a pixel and their weights underflow to 0/0;
/// above, each pixel would look at more than 69 neighbours on each side.
pub const PIXELS_PER_DEGREE_RANGE: RangeInclusive<f32> = 8.0..=512.0;

/// The error of every pixel, 0 (none seen) to 1, row-major from the top left.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorMap {
    /// Columns, in pixels.
    pub width: u32,
    /// Rows, in pixels.
    pub height: u32,
    /// `width · height` errors, of the pixels outside the mask too.
    pub values: Vec<f32>,
}

/// FLIP's errors over the pixels that counted.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FlipReport {
    /// Mean error, 0 to 1: the one number FLIP's authors recommend.
    pub mean: f64,
    /// 99th percentile (nearest rank), 0 to 1: what a small defect moves while the mean sleeps.
    pub p99: f64,
    /// Largest error, 0 to 1.
    pub max: f64,
    /// How many pixels counted, at least 1.
    pub pixels: usize,
    /// The error of every pixel.
    pub map: ErrorMap,
}

/// FLIP between two sRGB pictures (LDR-FLIP, Andersson et al. 2020): the error seen when they alternate in one place.
///
/// `mask` has one byte a pixel and counts those above zero towards mean, percentile and maximum; without it all count. The errors
/// themselves are always worked out over the whole pictures, as the filters look beyond the mask's edge.
///
/// The recommended mask is the [`union`](crate::union) of the subject in both pictures,
/// [`dilate`](crate::dilate)d by 2 pixels: with the reference's alone, fur that is too long would fall outside and count for
/// nothing, and an edge that moved by a pixel leaves errors on its outer side. A wider mask dilutes the mean.
///
/// `pixels_per_degree` is the viewing condition, [`DEFAULT_PIXELS_PER_DEGREE`] unless there is a reason.
///
/// The two pictures may be exchanged without a change. The same input gives the same bits on one machine; the library uses the
/// platform's `powf`, so expect other last places on another machine.
///
/// Cost: about 0.4 µs a pixel at 67 pixels per degree on one core (124 ms at 640×480), linear in the pixels and in
/// `pixels_per_degree`.
///
/// # Errors
///
/// [`SizeMismatch`](AccuracyError::SizeMismatch), [`MaskLength`](AccuracyError::MaskLength),
/// [`EmptyMask`](AccuracyError::EmptyMask) or [`PixelsPerDegree`](AccuracyError::PixelsPerDegree).
pub fn flip(reference: Image, test: Image, mask: Option<&[u8]>, pixels_per_degree: f32) -> Result<FlipReport, AccuracyError> {
    check_pair(reference, test, mask)?;
    if !PIXELS_PER_DEGREE_RANGE.contains(&pixels_per_degree) {
        let (low, high) = (*PIXELS_PER_DEGREE_RANGE.start(), *PIXELS_PER_DEGREE_RANGE.end());
        return Err(AccuracyError::PixelsPerDegree { found: pixels_per_degree, low, high });
    }
    let map = nv_flip::flip(to_flip(reference), to_flip(test), pixels_per_degree);
    let values = map.to_vec();
    let counted: Vec<f32> = match mask {
        None => values.clone(),
        Some(mask) => values.iter().zip(mask).filter(|&(_, &counts)| counts > 0).map(|(&value, _)| value).collect(),
    };
    let sum: f64 = counted.iter().copied().map(f64::from).sum();
    Ok(FlipReport {
        mean: sum / counted.len() as f64,
        p99: f64::from(percentile(&counted, 0.99)?),
        max: f64::from(percentile(&counted, 1.0)?),
        pixels: counted.len(),
        map: ErrorMap { width: reference.width(), height: reference.height(), values },
    })
}

fn to_flip(image: Image) -> FlipImageRgb8 {
    FlipImageRgb8::with_data(image.width(), image.height(), image.rgb())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::print_stdout, reason = "a test says what it measured")]

    use super::*;
    use crate::linear_light;

    const SIZE: u32 = 48;

    fn uniform(level: u8) -> Vec<u8> {
        vec![level; (SIZE * SIZE * 3) as usize]
    }

    fn with_square(mut rgb: Vec<u8>, corner: (u32, u32), side: u32, level: u8) -> Vec<u8> {
        for y in corner.1..corner.1 + side {
            for x in corner.0..corner.0 + side {
                let start = (3 * (y * SIZE + x)) as usize;
                rgb[start..start + 3].fill(level);
            }
        }
        rgb
    }

    fn compare(reference: &[u8], test: &[u8], mask: Option<&[u8]>) -> FlipReport {
        let image = |rgb| Image::new(SIZE, SIZE, rgb).unwrap();
        flip(image(reference), image(test), mask, DEFAULT_PIXELS_PER_DEGREE).unwrap()
    }

    /// CIE L*, 0 to 100, of a linear light 0 to 1.
    fn lightness(light: f64) -> f64 {
        let cube = (6.0f64 / 29.0).powi(3);
        if light > cube { 116.0 * light.cbrt() - 16.0 } else { light * (29.0f64 / 3.0).powi(3) }
    }

    /// FLIP of two uniform greys, in f64 from the paper (section 4.1.3): no features, no chroma, so that the colour difference is
    /// |L₁ − L₂|^0.7 mapped to [0, 1]; the greatest distance is that of the Hunt-adjusted green and blue (0.4 and 0.95 are
    /// the paper's p_c and p_t).
    fn flip_of_greys(first: u8, second: u8) -> f64 {
        let greatest = hyab_green_blue().powf(0.7);
        let difference = (lightness(linear_light(first)) - lightness(linear_light(second))).abs().powf(0.7);
        let knee = 0.4 * greatest;
        if difference < knee { difference * 0.95 / knee } else { 0.95 + (difference - knee) / (greatest - knee) * 0.05 }
    }

    /// HyAB distance of green and blue after the Hunt adjustment, from the sRGB primaries under D65.
    fn hyab_green_blue() -> f64 {
        let white = [0.950_47, 1.0, 1.088_83];
        let hunt = |xyz: [f64; 3]| {
            let f = |t: f64| (lightness(t) + 16.0) / 116.0;
            let [x, y, z] = [f(xyz[0] / white[0]), f(xyz[1] / white[1]), f(xyz[2] / white[2])];
            let l = 116.0 * y - 16.0;
            [l, 0.01 * l * 500.0 * (x - y), 0.01 * l * 200.0 * (y - z)]
        };
        let green = hunt([0.357_58, 0.715_17, 0.119_19]);
        let blue = hunt([0.180_48, 0.072_19, 0.950_53]);
        (green[0] - blue[0]).abs() + (green[1] - blue[1]).hypot(green[2] - blue[2])
    }

    #[test]
    fn alike_is_zero() {
        let spotted = with_square(uniform(90), (10, 10), 7, 200);
        let report = compare(&spotted, &spotted, None);
        assert_eq!((report.mean, report.p99, report.max), (0.0, 0.0, 0.0));
        assert_eq!(report.pixels, (SIZE * SIZE) as usize);
    }

    #[test]
    fn uniform_greys_differ_by_formula() {
        let mut most = 0.0_f64;
        for (first, second) in [(0, 255), (128, 129), (100, 140), (10, 250), (0, 1), (200, 190)] {
            let report = compare(&uniform(first), &uniform(second), None);
            let expected = flip_of_greys(first, second);
            assert!((report.mean - expected).abs() < 2e-3, "{first} against {second}: {} is not {expected}", report.mean);
            assert!((report.max - report.mean).abs() < 1e-4, "uniform pictures differ uniformly");
            most = most.max((report.mean - expected).abs());
        }
        println!("reached: within {most:.0e} of the formula in f64");
    }

    #[test]
    fn only_the_mask_counts() {
        let reference = uniform(60);
        let test = with_square(uniform(60), (4, 4), 6, 220);
        let far = {
            // FLIP's filters reach 10 pixels at 67 per degree: 16 from the square's far side is out of it.
            let mut mask = vec![0; (SIZE * SIZE) as usize];
            mask[(40 * SIZE) as usize..].fill(1);
            mask
        };
        let report = compare(&reference, &test, Some(&far));
        assert_eq!((report.max, report.pixels), (0.0, (8 * SIZE) as usize));

        let square = with_square(uniform(0), (4, 4), 6, 1).chunks_exact(3).map(|pixel| pixel[0]).collect::<Vec<u8>>();
        let near = compare(&reference, &test, Some(&square));
        let whole = compare(&reference, &test, None);
        assert_eq!(near.pixels, 36);
        assert_eq!(near.map, whole.map, "the map is of the whole picture");
        assert!(near.mean > 5.0 * whole.mean, "the mean over the square is not diluted: {} {}", near.mean, whole.mean);
    }

    #[test]
    fn statistics_are_those_of_the_map() {
        let report = compare(&uniform(60), &with_square(uniform(60), (20, 20), 5, 90), None);
        let mut sorted = report.map.values.clone();
        sorted.sort_by(f32::total_cmp);
        let mean = sorted.iter().map(|&value| f64::from(value)).sum::<f64>() / sorted.len() as f64;
        assert!((report.mean - mean).abs() < 1e-12);
        assert_eq!(report.max, f64::from(sorted[sorted.len() - 1]));
        assert_eq!(report.p99, f64::from(sorted[(sorted.len() as f64 * 0.99).ceil() as usize - 1]));
        assert!(report.mean < report.p99 && report.p99 < report.max, "{report:?}");
    }

    #[test]
    fn a_larger_difference_is_a_larger_error() {
        let errors: Vec<f64> =
            [70, 90, 130, 220].map(|level| compare(&uniform(60), &with_square(uniform(60), (20, 20), 5, level), None).mean).into();
        assert!(errors.is_sorted_by(|a, b| a < b), "{errors:?}");
    }

    #[test]
    fn nonsense_is_refused() {
        let pixel = Image::new(1, 1, &[0; 3]).unwrap();
        for found in [0.0, -67.0, 7.9, 513.0, f32::INFINITY, f32::NAN] {
            assert!(matches!(flip(pixel, pixel, None, found), Err(AccuracyError::PixelsPerDegree { .. })), "{found}");
        }
        assert!(matches!(flip(pixel, pixel, Some(&[0]), 67.0), Err(AccuracyError::EmptyMask { pixels: 1 })));
    }
}
