//! Eigenvalues of general matrices, balanced before.

use crate::{C64, Refused};
use nalgebra::{ComplexField, DMatrix, DVector, Schur};

/// Steps of the QR iteration before it is given up; it needs some three for each eigenvalue.
const STEPS_PER_VALUE: usize = 60;

/// Eigenvalues of a real matrix.
pub(crate) fn real(matrix: DMatrix<f64>) -> Result<Vec<C64>, Refused> {
    let (form, shift) = schur(matrix)?;
    Ok((form.complex_eigenvalues().iter())
        .map(|value| value - shift)
        .collect())
}

/// Eigenvalues of a complex matrix.
pub(crate) fn complex(matrix: DMatrix<C64>) -> Result<Vec<C64>, Refused> {
    let (form, shift) = schur(matrix)?;
    let values = form.eigenvalues().ok_or(Refused::NoEigenvalues)?;
    Ok(values.iter().map(|value| value - shift).collect())
}

/// The triangular form, and what was added to its eigenvalues.
///
/// The iteration ends where an entry is small beside its neighbours on the diagonal; between two that are nearly zero round-off of the whole
/// matrix may stay above that for ever. A shift by the size of the matrix then asks for no more than its round-off.
fn schur<T: ComplexField<RealField = f64>>(
    mut matrix: DMatrix<T>,
) -> Result<(Schur<T, nalgebra::Dyn>, f64), Refused> {
    if matrix.iter().any(|value| !value.is_finite()) {
        return Err(Refused::not_finite());
    }
    balance(&mut matrix);
    let steps = STEPS_PER_VALUE * matrix.nrows();
    if let Some(found) = Schur::try_new(matrix.clone(), f64::EPSILON, steps) {
        return Ok((found, 0.0));
    }
    let shift = matrix.norm();
    for index in 0..matrix.nrows() {
        matrix[(index, index)] += T::from_real(shift);
    }
    let found = Schur::try_new(matrix, f64::EPSILON, steps).ok_or(Refused::NoEigenvalues)?;
    Ok((found, shift))
}

/// Scales state by state with powers of two until rows and columns are of one size; eigenvalues stay. Returns the scales:
/// an eigenvector of the given matrix is that of the balanced one times them.
///
/// Source: B. N. Parlett, C. Reinsch, Numer. Math. 13 (1969) 293 (from memory).
pub(crate) fn balance<T: ComplexField<RealField = f64>>(matrix: &mut DMatrix<T>) -> DVector<f64> {
    let size = matrix.nrows();
    let mut scales = DVector::from_element(size, 1.0);
    loop {
        let mut settled = true;
        for index in 0..size {
            let own = matrix[(index, index)].clone().norm1();
            let sum = |values: f64| values - own;
            let column = sum(matrix.column(index).iter().map(|v| v.clone().norm1()).sum());
            let row = sum(matrix.row(index).iter().map(|v| v.clone().norm1()).sum());
            if column <= 0.0 || row <= 0.0 {
                continue;
            }
            let factor = 2.0_f64.powi((0.5 * (row / column).log2()).round() as i32);
            if column * factor + row / factor < 0.95 * (column + row) {
                settled = false;
                scales[index] *= factor;
                matrix.column_mut(index).scale_mut(factor);
                matrix.row_mut(index).unscale_mut(factor);
            }
        }
        if settled {
            return scales;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn badly_scaled_states_keep_their_eigenvalues() {
        // two oscillators of 30 and 2e7 rad/s as positions and velocities, coupled through the damping
        let (slow, fast) = (900.0, 4e14);
        let matrix = DMatrix::from_row_slice(
            4,
            4,
            &[
                0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, -slow, 0.0, -3.0, 0.5, 0.0, -fast, 0.5,
                -10.0,
            ],
        );
        let mut values = real(matrix.clone()).unwrap();
        values.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
        let expected = C64::new(-1.5, (900.0_f64 - 2.25).sqrt());
        let nearest = if values[0].im > 0.0 {
            values[0]
        } else {
            values[1]
        };
        // the coupling shifts it by (0.5 λ)² / fast, nothing
        assert!((nearest - expected).norm() < 1e-7, "{nearest}");
        let again = complex(matrix.map(C64::from)).unwrap();
        assert!(again.iter().any(|value| (value - expected).norm() < 1e-7));
    }
}
