//! Systems of a few dozen equations.

/// A symmetric positive definite matrix as the product of a lower triangle and its transpose (Cholesky).
pub(super) struct Factor {
    rows: Vec<Vec<f64>>,
}

impl Factor {
    /// Of the matrix whose entries on and below the diagonal are `entry(row, column)`.
    pub(super) fn of(size: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let mut rows: Vec<Vec<f64>> = Vec::with_capacity(size);
        for row in 0..size {
            let mut line: Vec<f64> = Vec::with_capacity(row + 1);
            for (column, above) in rows.iter().enumerate() {
                line.push((entry(row, column) - dot(&line, above)) / above[column]);
            }
            let diagonal = entry(row, row);
            // Rounding may leave less than nothing of a row that others say all about.
            let rest = (diagonal - dot(&line, &line)).max(1e-12 * diagonal).max(f64::MIN_POSITIVE);
            line.push(rest.sqrt());
            rows.push(line);
        }
        Self { rows }
    }

    /// Solves with the triangle.
    pub(super) fn forward(&self, right: &[f64]) -> Vec<f64> {
        let mut solved: Vec<f64> = Vec::with_capacity(right.len());
        for (index, (row, value)) in self.rows.iter().zip(right).enumerate() {
            solved.push((value - dot(row, &solved)) / row[index]);
        }
        solved
    }

    /// Solves with the triangle's transpose.
    pub(super) fn backward(&self, mut right: Vec<f64>) -> Vec<f64> {
        for (index, row) in self.rows.iter().enumerate().rev() {
            let value = right[index] / row[index];
            right[..index].iter_mut().zip(row).for_each(|(right, entry)| *right -= value * entry);
            right[index] = value;
        }
        right
    }

    /// Half the logarithm of the determinant.
    pub(super) fn log_root_determinant(&self) -> f64 {
        self.rows.iter().filter_map(|row| row.last()).map(|&diagonal| libm::log(diagonal)).sum()
    }
}

/// Over the shorter of the two.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_solves() {
        // [[4, 2, 0], [2, 5, 1], [0, 1, 3]] times (1, -2, 3).
        let matrix = [[4.0, 2.0, 0.0], [2.0, 5.0, 1.0], [0.0, 1.0, 3.0]];
        let factor = Factor::of(3, |row, column| matrix[row][column]);
        let solved = factor.backward(factor.forward(&[0.0, -5.0, 7.0]));
        assert!(solved.iter().zip([1.0, -2.0, 3.0]).all(|(a, b)| (a - b).abs() < 1e-12), "{solved:?}");
        let determinant: f64 = 4.0 * (5.0 * 3.0 - 1.0) - 2.0 * (2.0 * 3.0);
        assert!((factor.log_root_determinant() - 0.5 * determinant.ln()).abs() < 1e-12);
    }

    #[test]
    fn a_row_given_twice_stays_finite() {
        let factor = Factor::of(2, |_, _| 1.0);
        assert!(factor.backward(factor.forward(&[1.0, 1.0])).iter().all(|value| value.is_finite()));
    }
}
