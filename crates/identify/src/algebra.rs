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
#[path = "../tests/unit/algebra.rs"]
mod tests;
