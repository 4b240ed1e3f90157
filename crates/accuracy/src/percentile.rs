//! The nearest-rank percentile.

use crate::AccuracyError;

/// The smallest of `values` that at least `fraction` of them do not exceed (nearest rank, never interpolated): 0 gives the least,
/// 1 the greatest, 0.99 the 99th percentile.
///
/// Ordered by [`f32::total_cmp`], so that the result is the same for every order of the input, and a NaN counts above infinity
/// and shows in the high percentiles instead of hiding. Linear time on average.
///
/// # Errors
///
/// [`NoValues`](AccuracyError::NoValues) for an empty slice, [`NotAFraction`](AccuracyError::NotAFraction) for a fraction outside
/// 0 to 1 or NaN.
pub fn percentile(values: &[f32], fraction: f64) -> Result<f32, AccuracyError> {
    if values.is_empty() {
        return Err(AccuracyError::NoValues);
    }
    if !(0.0..=1.0).contains(&fraction) {
        return Err(AccuracyError::NotAFraction { found: fraction });
    }
    let count = values.len() as f64;
    let mut rank = (fraction * count).ceil();
    // The product may be rounded up past a whole number: 0.07 · 100 is 7.000000000000001, yet 7 of 100 are enough.
    if (rank - 1.0) / count >= fraction {
        rank -= 1.0;
    }
    let index = (rank as usize).saturating_sub(1).min(values.len() - 1);
    let mut ordered = values.to_vec();
    Ok(*ordered.select_nth_unstable_by(index, f32::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_are_those_of_a_sorted_list() {
        let values: Vec<f32> = (1..=200).rev().map(|value| value as f32).collect();
        for (fraction, expected) in [(0.0, 1.0), (0.005, 1.0), (0.0051, 2.0), (0.5, 100.0), (0.99, 198.0), (0.995, 199.0), (1.0, 200.0)] {
            assert_eq!(percentile(&values, fraction), Ok(expected), "at {fraction}");
        }
        assert_eq!(percentile(&[7.0], 0.3), Ok(7.0));
    }

    #[test]
    fn a_rounded_rank_is_mended() {
        let values: Vec<f32> = (1..=100).map(|value| value as f32).collect();
        for rank in 1..=100u8 {
            assert_eq!(percentile(&values, f64::from(rank) / 100.0), Ok(f32::from(rank)));
        }
    }

    #[test]
    fn a_nan_is_seen() {
        assert!(percentile(&[0.0, f32::NAN, 1.0], 1.0).unwrap().is_nan());
        assert_eq!(percentile(&[0.0, f32::NAN, 1.0], 0.5), Ok(1.0));
    }

    #[test]
    fn nonsense_is_refused() {
        assert_eq!(percentile(&[], 0.5), Err(AccuracyError::NoValues));
        assert_eq!(percentile(&[1.0], 99.0), Err(AccuracyError::NotAFraction { found: 99.0 }));
        assert!(matches!(percentile(&[1.0], f64::NAN), Err(AccuracyError::NotAFraction { .. })));
    }
}
