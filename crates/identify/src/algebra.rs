//! Factors of symmetric positive matrices, and sums that the estimators share.

use nalgebra::{Cholesky, DMatrix, DVector, DVectorView, DVectorViewMut, Dyn};

/// Lower factor L of a symmetric positive matrix A = L Lᵀ: of a covariance, or of a curvature.
#[derive(Clone, Debug)]
pub(crate) struct Factor {
    cholesky: Cholesky<f64, Dyn>,
    /// ln det A.
    pub log_determinant: f64,
}

impl Factor {
    /// Factor of a symmetric matrix, of which the lower half is read; none where it is not positive.
    pub fn of(matrix: DMatrix<f64>) -> Option<Self> {
        let cholesky = Cholesky::new(matrix)?;
        let log_determinant = cholesky.ln_determinant();
        log_determinant.is_finite().then_some(Self {
            cholesky,
            log_determinant,
        })
    }

    /// L⁻¹ v in place: components of unit variance where v has the covariance A.
    pub fn whiten(&self, vector: &mut [f64]) {
        self.whiten_from(0, vector);
    }

    /// The same where all entries before `first` are 0.
    pub fn whiten_from(&self, first: usize, vector: &mut [f64]) {
        let lower = self.cholesky.l_dirty();
        lower
            .view_range(first.., first..)
            .solve_lower_triangular_unchecked_mut(&mut view(&mut vector[first..]));
    }

    /// L⁻ᵀ v in place.
    pub fn unwhiten_transposed(&self, vector: &mut [f64]) {
        let lower = self.cholesky.l_dirty();
        lower.tr_solve_lower_triangular_unchecked_mut(&mut view(vector));
    }

    /// A⁻¹ v in place.
    pub fn solve(&self, vector: &mut [f64]) {
        self.cholesky.solve_mut(&mut view(vector));
    }

    /// A⁻¹ v.
    pub fn solved(&self, vector: &DVector<f64>) -> DVector<f64> {
        self.cholesky.solve(vector)
    }

    /// A⁻¹.
    pub fn inverse(&self) -> DMatrix<f64> {
        self.cholesky.inverse()
    }

    /// vᵀ A v.
    pub fn square_of(&self, vector: &[f64]) -> f64 {
        let lower = self.cholesky.l_dirty();
        (lower.column_iter().enumerate())
            .map(|(k, column)| {
                let below = DVectorView::from_slice(&vector[k..], vector.len() - k);
                column.rows_range(k..).dot(&below).powi(2)
            })
            .sum()
    }
}

fn view(vector: &mut [f64]) -> DVectorViewMut<'_, f64> {
    let size = vector.len();
    DVectorViewMut::from_slice(vector, size)
}

/// Scalar product.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    DVectorView::from_slice(a, a.len()).dot(&DVectorView::from_slice(b, b.len()))
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
    fn a_factor_solves_and_knows_determinant_and_squares() {
        // By hand: L = [[2,0,0],[1,3,0],[-1,½,1]], det = 36.
        let matrix =
            DMatrix::from_row_slice(3, 3, &[4.0, 2.0, -2.0, 2.0, 10.0, 0.5, -2.0, 0.5, 2.25]);
        let factor = Factor::of(matrix.clone()).expect("positive definite");
        assert!((factor.log_determinant - 36_f64.ln()).abs() < 1e-14);
        let right = [1.0, -2.0, 3.0];
        let mut solution = right;
        factor.solve(&mut solution);
        let back = &matrix * DVector::from_row_slice(&solution);
        assert!(back.iter().zip(right).all(|(a, b)| (a - b).abs() < 1e-13));
        // L⁻¹ (1, -2, 3) by hand: ½, -5/6, 3 + ½ + 5/12
        let mut white = right;
        factor.whiten(&mut white);
        for (found, expected) in white.iter().zip([0.5, -2.5 / 3.0, 3.5 + 1.25 / 3.0]) {
            assert!((found - expected).abs() < 1e-14, "{white:?}");
        }
        // the same of (0, -2, 3) from its second entry on, and L⁻ᵀ L⁻¹ = A⁻¹
        let (mut whole, mut part) = ([0.0, -2.0, 3.0], [0.0, -2.0, 3.0]);
        factor.whiten(&mut whole);
        factor.whiten_from(1, &mut part);
        assert_eq!(whole, part);
        factor.unwhiten_transposed(&mut white);
        assert!(
            white
                .iter()
                .zip(solution)
                .all(|(a, b)| (a - b).abs() < 1e-14)
        );
        // (1,1,2): 4 + 10 + 9 + 2·(2 - 4 + 1)
        assert!((factor.square_of(&[1.0, 1.0, 2.0]) - 21.0).abs() < 1e-13);
    }
    #[test]
    fn what_is_not_positive_has_no_factor() {
        for wrong in [[1.0, 2.0, 2.0, 1.0], [f64::NAN; 4], [f64::INFINITY; 4]] {
            assert!(Factor::of(DMatrix::from_row_slice(2, 2, &wrong)).is_none());
        }
    }
    #[test]
    fn large_exponents_do_not_overflow() {
        assert!((log_sum_exp(&[1000.0, 1000.0]) - 1000.0 - 2_f64.ln()).abs() < 1e-12);
        assert_eq!(log_sum_exp(&[]), f64::NEG_INFINITY);
    }
}
