//! What is worth its cost.

/// Which of some points (cost, error), less of both being better, no other point beats: none costs as little or less and errs as little or less, one of them less. Of equal points the first.
///
/// In order of rising cost, and so of falling error. A point that is not finite is beaten by all.
pub fn pareto_front(points: &[(f64, f64)]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).filter(|&index| points[index].0.is_finite() && points[index].1.is_finite()).collect();
    // The sort is stable: of equal points the first stays in front.
    order.sort_by(|&a, &b| points[a].0.total_cmp(&points[b].0).then(points[a].1.total_cmp(&points[b].1)));
    let mut least = f64::INFINITY;
    order.retain(|&index| {
        points[index].1 < least && {
            least = points[index].1;
            true
        }
    });
    order
}

/// Which of some rows of numbers, less of each being better, no other row beats: none is as little or less in all of them and less in one. Of equal rows the first; a row with a number
/// that is not finite is beaten by all. In order, in quadratic time.
///
/// ```
/// // Milliseconds, bytes, error: the last is as slow and as large as the second and errs more.
/// let settings = [[2.0, 8.0, 0.1], [1.0, 9.0, 0.2], [1.0, 9.0, 0.3]];
/// assert_eq!(pelage_accuracy::unbeaten(&settings.map(Vec::from)), [0, 1]);
/// ```
pub fn unbeaten(rows: &[Vec<f64>]) -> Vec<usize> {
    let finite = |row: &[f64]| row.iter().all(|number| number.is_finite());
    let no_more = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| a <= b);
    let beats =
        |(other, by): (usize, &Vec<f64>), index: usize| finite(by) && no_more(by, &rows[index]) && (by != &rows[index] || other < index);
    (0..rows.len())
        .filter(|&index| finite(&rows[index]) && !rows.iter().enumerate().any(|row| row.0 != index && beats(row, index)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_front_is_what_nothing_beats() {
        let points =
            [(5.0, 1.0), (1.0, 9.0), (3.0, 4.0), (3.0, 3.0), (4.0, 3.0), (2.0, 9.0), (3.0, 3.0), (f64::NAN, 0.0), (0.0, f64::INFINITY)];
        assert_eq!(pareto_front(&points), [1, 3, 0]);
        assert_eq!(pareto_front(&[]), Vec::<usize>::new());
    }

    proptest! {
        #[test]
        fn of_two_numbers_the_unbeaten_are_the_front(points in proptest::collection::vec((0u8..12, 0u8..12), 0..40)) {
            let points: Vec<(f64, f64)> = points.into_iter().map(|(a, b)| (f64::from(a), f64::from(b))).collect();
            let mut front = pareto_front(&points);
            front.sort_unstable();
            prop_assert_eq!(unbeaten(&points.iter().map(|&(a, b)| vec![a, b]).collect::<Vec<_>>()), front);
        }

        #[test]
        fn every_point_is_on_the_front_or_beaten_by_one_that_is(points in proptest::collection::vec((0u8..12, 0u8..12), 0..40)) {
            let points: Vec<(f64, f64)> = points.into_iter().map(|(a, b)| (f64::from(a), f64::from(b))).collect();
            let front = pareto_front(&points);
            for (index, point) in points.iter().enumerate() {
                let beaten = |by: &usize| *by != index && points[*by].0 <= point.0 && points[*by].1 <= point.1;
                prop_assert_eq!(front.iter().any(beaten), !front.contains(&index));
            }
        }
    }
}
