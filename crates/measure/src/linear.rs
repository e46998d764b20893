//! Small linear systems, a handful of unknowns.

/// Inverse of a symmetric positive matrix, by elimination; none where a pivot falls to a part of the first one, and the matrix
/// is as good as singular.
pub(crate) fn inverse<const N: usize>(mut a: [[f64; N]; N], least: f64) -> Option<[[f64; N]; N]> {
    let largest = a[0][0];
    for p in 0..N {
        let pivot = a[p][p];
        if pivot.is_nan() || pivot <= least * largest {
            return None;
        }
        a[p][p] = 1.0;
        a[p].iter_mut().for_each(|value| *value /= pivot);
        let row = a[p];
        for (_, line) in a.iter_mut().enumerate().filter(|(i, _)| *i != p) {
            let factor = line[p];
            line[p] = 0.0;
            line.iter_mut()
                .zip(&row)
                .for_each(|(x, r)| *x -= factor * r);
        }
    }
    Some(a)
}

/// Solution of a small system by elimination with pivots; none if it is singular.
pub(crate) fn solved<const N: usize>(a: &[[f64; N]; N], b: &[f64; N]) -> Option<[f64; N]> {
    let (mut a, mut x) = (*a, *b);
    let size = (0..N).map(|i| a[i][i].abs()).fold(0.0, f64::max);
    for column in 0..N {
        let pivot =
            (column..N).max_by(|&i, &j| a[i][column].abs().total_cmp(&a[j][column].abs()))?;
        let found = a[pivot][column].abs();
        if found <= 1e-13 * size || found.is_nan() {
            return None;
        }
        a.swap(column, pivot);
        x.swap(column, pivot);
        for row in column + 1..N {
            let factor = a[row][column] / a[column][column];
            let source = a[column];
            for (value, from) in a[row].iter_mut().zip(&source) {
                *value -= factor * from;
            }
            x[row] -= factor * x[column];
        }
    }
    for row in (0..N).rev() {
        let rest: f64 = (row + 1..N).map(|j| a[row][j] * x[j]).sum();
        x[row] = (x[row] - rest) / a[row][row];
    }
    Some(x)
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
    fn a_solution_is_one_whatever_the_order_of_the_rows() {
        let right = [1.0, -2.0, 0.5, 3.0];
        let x = solved(&A, &right).unwrap();
        for (row, b) in A.iter().zip(right) {
            let sum: f64 = row.iter().zip(x).map(|(a, x)| a * x).sum();
            assert!((sum - b).abs() < 1e-14);
        }
        let turned = solved(&[A[3], A[2], A[1], A[0]], &[3.0, 0.5, -2.0, 1.0]).unwrap();
        assert!(x.iter().zip(turned).all(|(a, b)| (a - b).abs() < 1e-14));
        assert!(solved(&[[1.0, 2.0], [2.0, 4.0]], &[1.0, 1.0]).is_none());
    }
}
