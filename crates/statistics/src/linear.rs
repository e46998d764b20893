//! Small symmetric positive systems, a handful of unknowns.

use nalgebra::{Cholesky, Const, SMatrix, SVector};

/// Factor of a symmetric positive matrix; none where a pivot falls to a part of a size, and the matrix is as good as singular.
fn factor<const N: usize>(
    a: &[[f64; N]; N],
    least: f64,
    size: f64,
) -> Option<Cholesky<f64, Const<N>>> {
    let factor = SMatrix::<f64, N, N>::from(*a).cholesky()?;
    // the pivots of an elimination are the squares of the factor's diagonal
    let pivots = factor.l_dirty().diagonal();
    let sound = pivots.iter().all(|pivot| pivot * pivot > least * size);
    sound.then_some(factor)
}

/// Inverse of a symmetric positive matrix; none where a pivot falls to a part of the first one.
pub fn inverse<const N: usize>(a: [[f64; N]; N], least: f64) -> Option<[[f64; N]; N]> {
    Some(factor(&a, least, a[0][0])?.inverse().into())
}

/// Solution of a symmetric positive system; none where it is as good as singular.
pub fn solved<const N: usize>(a: &[[f64; N]; N], b: &[f64; N]) -> Option<[f64; N]> {
    let largest = (0..N).map(|i| a[i][i]).fold(0.0, f64::max);
    let factor = factor(a, 1e-13, largest)?;
    Some(factor.solve(&SVector::from(*b)).into())
}

/// Lower triangle L with L Lᵀ = A; none where the matrix is not positive.
pub fn lower<const N: usize>(a: &[[f64; N]; N]) -> Option<[[f64; N]; N]> {
    let factor = SMatrix::<f64, N, N>::from(*a).cholesky()?;
    // nalgebra's arrays are by columns
    Some(factor.l().transpose().into())
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: [[f64; 4]; 4] = [
        [4.0, 1.0, 0.5, 0.0],
        [1.0, 3.0, 0.2, 0.1],
        [0.5, 0.2, 2.0, 0.3],
        [0.0, 0.1, 0.3, 1.0],
    ];

    #[test]
    fn an_inverse_is_one() {
        let b = inverse(A, 1e-12).unwrap();
        for cell in 0..16 {
            let (i, j) = (cell / 4, cell % 4);
            let product: f64 = (0..4).map(|k| A[i][k] * b[k][j]).sum();
            assert!((product - f64::from(u8::from(i == j))).abs() < 1e-14);
        }
        assert!(inverse([[1.0; 4]; 4], 1e-12).is_none());
    }

    #[test]
    fn a_solution_is_one() {
        let right = [1.0, -2.0, 0.5, 3.0];
        let x = solved(&A, &right).unwrap();
        for (row, b) in A.iter().zip(right) {
            let sum: f64 = row.iter().zip(x).map(|(a, x)| a * x).sum();
            assert!((sum - b).abs() < 1e-14);
        }
        assert!(solved(&[[1.0, 2.0], [2.0, 1.0]], &[1.0, 1.0]).is_none());
        assert!(solved(&[[1.0, 2.0], [2.0, 4.0]], &[1.0, 1.0]).is_none());
    }

    #[test]
    fn a_triangle_is_by_rows() {
        let a = [[4.0, 2.0, -2.0], [2.0, 10.0, 0.5], [-2.0, 0.5, 2.25]];
        // by hand
        let expected = [[2.0, 0.0, 0.0], [1.0, 3.0, 0.0], [-1.0, 0.5, 1.0]];
        assert_eq!(lower(&a), Some(expected));
        assert_eq!(lower(&[[1.0, 2.0], [2.0, 4.0]]), None);
    }
}
