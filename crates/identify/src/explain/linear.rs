//! Small dense linear algebra: Cholesky factors of covariances.

/// Lower factor L of a symmetric positive definite matrix, A = L Lᵀ; rows one after the other.
#[derive(Clone, Debug)]
pub(crate) struct Cholesky {
    size: usize,
    lower: Vec<f64>,
    /// ln det A.
    pub log_determinant: f64,
}

impl Cholesky {
    /// Factor of a symmetric matrix, rows one after the other; none where it is not positive definite.
    pub fn of(matrix: &[f64], size: usize) -> Option<Self> {
        let mut lower = vec![0.0; size * size];
        let mut log_determinant = 0.0;
        for i in 0..size {
            for j in 0..=i {
                let (row, column) = (&lower[i * size..i * size + j], &lower[j * size..]);
                let sum = matrix[i * size + j] - dot(row, &column[..j]);
                if i == j {
                    // NaN fails as well
                    if sum.is_nan() || sum <= 0.0 {
                        return None;
                    }
                    lower[i * size + i] = sum.sqrt();
                    log_determinant += sum.ln();
                } else {
                    lower[i * size + j] = sum / lower[j * size + j];
                }
            }
        }
        Some(Self {
            size,
            lower,
            log_determinant,
        })
    }

    /// L⁻¹ v in place: components of unit variance where v has the covariance A.
    pub fn whiten(&self, vector: &mut [f64]) {
        self.whiten_from(0, vector);
    }

    /// The same where all entries before `first` are 0.
    pub fn whiten_from(&self, first: usize, vector: &mut [f64]) {
        for i in first..self.size {
            let row = &self.lower[i * self.size + first..i * self.size + i];
            vector[i] = (vector[i] - dot(row, &vector[first..i])) / self.lower[i * self.size + i];
        }
    }

    /// L⁻ᵀ v in place.
    pub fn unwhiten_transposed(&self, vector: &mut [f64]) {
        for i in (0..self.size).rev() {
            vector[i] /= self.lower[i * self.size + i];
            let value = vector[i];
            for (j, entry) in vector[..i].iter_mut().enumerate() {
                *entry -= self.lower[i * self.size + j] * value;
            }
        }
    }

    /// A⁻¹ v in place.
    pub fn solve(&self, vector: &mut [f64]) {
        self.whiten(vector);
        self.unwhiten_transposed(vector);
    }

    /// vᵀ A v.
    pub fn square_of(&self, vector: &[f64]) -> f64 {
        (0..self.size)
            .map(|column| {
                let sum: f64 = (column..self.size)
                    .map(|row| self.lower[row * self.size + column] * vector[row])
                    .sum();
                sum * sum
            })
            .sum()
    }
}

/// Scalar product; four sums side by side, so that the machine need not wait for each addition.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (a_parts, b_parts) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = (a_parts.remainder().iter())
        .zip(b_parts.remainder())
        .map(|(x, y)| x * y)
        .sum();
    for (x, y) in a_parts.zip(b_parts) {
        for lane in 0..4 {
            sums[lane] += x[lane] * y[lane];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// ln Σ exp(values); -∞ of nothing.
pub(crate) fn log_sum_exp(values: &[f64]) -> f64 {
    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if largest == f64::NEG_INFINITY {
        return largest;
    }
    largest
        + values
            .iter()
            .map(|value| (value - largest).exp())
            .sum::<f64>()
            .ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_factor_gives_back_its_matrix() {
        // By hand: L = [[2,0,0],[1,3,0],[-1,½,1]], det = 36.
        let matrix = [4.0, 2.0, -2.0, 2.0, 10.0, 0.5, -2.0, 0.5, 2.25];
        let factor = Cholesky::of(&matrix, 3).expect("positive definite");
        assert!((factor.log_determinant - 36_f64.ln()).abs() < 1e-14);
        let mut vector = [1.0, -2.0, 3.0];
        factor.solve(&mut vector);
        for (row, expected) in matrix.chunks(3).zip([1.0, -2.0, 3.0]) {
            assert!((dot(row, &vector) - expected).abs() < 1e-13);
        }
        // (1,1,2): 4 + 10 + 9 + 2·(2 - 4 + 1)
        assert!((factor.square_of(&[1.0, 1.0, 2.0]) - 21.0).abs() < 1e-13);
    }
    #[test]
    fn an_indefinite_matrix_has_no_factor() {
        assert!(Cholesky::of(&[1.0, 2.0, 2.0, 1.0], 2).is_none());
        assert!(Cholesky::of(&[f64::NAN], 1).is_none());
    }
    #[test]
    fn large_exponents_do_not_overflow() {
        assert!((log_sum_exp(&[1000.0, 1000.0]) - 1000.0 - 2_f64.ln()).abs() < 1e-12);
        assert_eq!(log_sum_exp(&[]), f64::NEG_INFINITY);
    }
}
