//! Errors of what comes before a picture: numbers and directions at places.

use crate::{AccuracyError, percentile};

/// How far numbers are from those they should be, in their own unit.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct FieldError {
    /// Mean of test less reference: what does not average out.
    pub bias: f64,
    /// Mean of the absolute differences.
    pub mean: f64,
    /// Root of the mean squared difference.
    pub rms: f64,
    /// 99th percentile (nearest rank) of the absolute differences.
    pub p99: f64,
    /// The largest absolute difference.
    pub max: f64,
}

/// The error of numbers given at places, as a length at each vertex: one of each at every place, in one order.
///
/// # Errors
///
/// [`FieldLength`](AccuracyError::FieldLength) if there are not as many of both, [`NoValues`](AccuracyError::NoValues) if there are none.
pub fn field_error(reference: &[f32], test: &[f32]) -> Result<FieldError, AccuracyError> {
    check_lengths(reference.len(), test.len())?;
    let differences: Vec<f64> = reference.iter().zip(test).map(|(&a, &b)| f64::from(b) - f64::from(a)).collect();
    statistics(&differences)
}

/// The angle in degrees between directions given at places, of any lengths: 0 to 180, so that `bias` is `mean`. Places at which either has no length do not count.
///
/// # Errors
///
/// As [`field_error`].
pub fn direction_error(reference: &[[f32; 3]], test: &[[f32; 3]]) -> Result<FieldError, AccuracyError> {
    check_lengths(reference.len(), test.len())?;
    let angles: Vec<f64> = reference.iter().zip(test).filter_map(|(&a, &b)| angle_deg(a, b)).collect();
    statistics(&angles)
}

fn check_lengths(reference: usize, test: usize) -> Result<(), AccuracyError> {
    if reference == test { Ok(()) } else { Err(AccuracyError::FieldLength { reference, test }) }
}

/// By the half-angle's tangent, which is exact for small angles where the arc cosine is not.
fn angle_deg(a: [f32; 3], b: [f32; 3]) -> Option<f64> {
    let (a, b) = (a.map(f64::from), b.map(f64::from));
    let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let (along_a, along_b) = (length(a), length(b));
    if along_a == 0.0 || along_b == 0.0 {
        return None;
    }
    let combined = |sign: f64| length([0, 1, 2].map(|axis| a[axis] / along_a + sign * b[axis] / along_b));
    Some(2.0 * combined(-1.0).atan2(combined(1.0)).to_degrees())
}

fn statistics(differences: &[f64]) -> Result<FieldError, AccuracyError> {
    let sizes: Vec<f32> = differences.iter().map(|difference| difference.abs() as f32).collect();
    let (p99, max) = (f64::from(percentile(&sizes, 0.99)?), f64::from(percentile(&sizes, 1.0)?));
    let mean = |of: fn(f64) -> f64| differences.iter().map(|&difference| of(difference)).sum::<f64>() / differences.len() as f64;
    Ok(FieldError { bias: mean(|d| d), mean: mean(f64::abs), rms: mean(|d| d * d).sqrt(), p99, max })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_differences() {
        let found = field_error(&[1.0, 2.0, 3.0, 4.0], &[1.0, 2.5, 2.0, 4.0]).unwrap();
        assert_eq!(found, FieldError { bias: -0.125, mean: 0.375, rms: 0.3125f64.sqrt(), p99: 1.0, max: 1.0 });
        assert_eq!(field_error(&[1.0], &[1.0, 2.0]), Err(AccuracyError::FieldLength { reference: 1, test: 2 }));
        assert_eq!(field_error(&[], &[]), Err(AccuracyError::NoValues));
    }

    #[test]
    fn angles_are_those_between_directions_of_any_length() {
        let tilted = |degrees: f32| [degrees.to_radians().cos() * 3.0, degrees.to_radians().sin() * 3.0, 0.0];
        for degrees in [0.0, 0.001, 30.0, 90.0, 179.0, 180.0] {
            let found = direction_error(&[[0.5, 0.0, 0.0]], &[tilted(degrees)]).unwrap();
            assert!((found.max - f64::from(degrees)).abs() < 2e-5, "{degrees}: {found:?}");
        }
        let found = direction_error(&[[1.0, 0.0, 0.0], [0.0; 3]], &[tilted(90.0), tilted(9.0)]).unwrap();
        assert!((found.mean - 90.0).abs() < 1e-4, "a place without direction does not count: {found:?}");
        assert_eq!(direction_error(&[[0.0; 3]], &[[1.0; 3]]), Err(AccuracyError::NoValues));
    }

    #[test]
    fn a_nan_is_seen() {
        assert!(field_error(&[f32::NAN, 0.0], &[0.0, 0.0]).unwrap().max.is_nan());
    }
}
