//! Symmetric positive matrices, small and dense, by rows.

/// A matrix by rows.
pub(crate) type Matrix = Vec<Vec<f64>>;

/// A matrix of zeros.
pub(crate) fn zeros(rows: usize, columns: usize) -> Matrix {
    vec![vec![0.0; columns]; rows]
}

/// Lower factor of a symmetric positive matrix; none if it is not positive.
pub(crate) fn cholesky(mut a: Matrix) -> Option<Matrix> {
    for i in 0..a.len() {
        let (above, rest) = a.split_at_mut(i);
        let row = &mut rest[0];
        for j in 0..i {
            let sum: f64 = row[..j]
                .iter()
                .zip(&above[j][..j])
                .map(|(x, y)| x * y)
                .sum();
            row[j] = (row[j] - sum) / above[j][j];
        }
        let left = row[i] - row[..i].iter().map(|x| x * x).sum::<f64>();
        if left.is_nan() || left <= 0.0 || left.is_infinite() {
            return None;
        }
        row[i] = left.sqrt();
        row[i + 1..].fill(0.0);
    }
    Some(a)
}

/// Solves L x = b.
pub(crate) fn forward(factor: &Matrix, right: &[f64]) -> Vec<f64> {
    let mut x: Vec<f64> = Vec::with_capacity(right.len());
    for (row, b) in factor.iter().zip(right) {
        let i = x.len();
        let sum: f64 = row[..i].iter().zip(&x).map(|(l, x)| l * x).sum();
        x.push((b - sum) / row[i]);
    }
    x
}

/// Solves L Lᵀ x = b.
pub(crate) fn solved(factor: &Matrix, right: &[f64]) -> Vec<f64> {
    let mut x = forward(factor, right);
    for i in (0..x.len()).rev() {
        let value = x[i] / factor[i][i];
        x[i] = value;
        for (j, xj) in x.iter_mut().enumerate().take(i) {
            *xj -= factor[i][j] * value;
        }
    }
    x
}

/// Inverse of the matrix of a factor.
pub(crate) fn inverse(factor: &Matrix) -> Matrix {
    let n = factor.len();
    (0..n)
        .map(|i| {
            let mut unit = vec![0.0; n];
            unit[i] = 1.0;
            solved(factor, &unit)
        })
        .collect()
}

/// Logarithm of the determinant of the matrix of a factor.
pub(crate) fn log_determinant(factor: &Matrix) -> f64 {
    2.0 * factor
        .iter()
        .enumerate()
        .map(|(i, row)| row[i].ln())
        .sum::<f64>()
}

/// Sum of products.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// aᵀ C b.
pub(crate) fn between(a: &[f64], matrix: &Matrix, b: &[f64]) -> f64 {
    a.iter()
        .zip(matrix)
        .filter(|(x, _)| **x != 0.0)
        .map(|(x, row)| x * dot(row, b))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_factor_solves_inverts_and_counts() {
        // det 3·(20 - 9) - 1·(5 - 6) + 2·(3 - 8) = 24, by hand.
        let a = vec![
            vec![3.0, 1.0, 2.0],
            vec![1.0, 4.0, 3.0],
            vec![2.0, 3.0, 5.0],
        ];
        let factor = cholesky(a.clone()).unwrap();
        assert!((log_determinant(&factor) - 24_f64.ln()).abs() < 1e-14);
        let x = solved(&factor, &[1.0, -2.0, 0.5]);
        for (row, b) in a.iter().zip([1.0, -2.0, 0.5]) {
            assert!((dot(row, &x) - b).abs() < 1e-14);
        }
        let back = inverse(&factor);
        assert!((between(&[1.0, 0.0, 0.0], &back, &[1.0, 0.0, 0.0]) - 11.0 / 24.0).abs() < 1e-14);
        assert!(cholesky(vec![vec![1.0, 2.0], vec![2.0, 1.0]]).is_none());
    }
}
