//! Small symmetric systems, a lane each.

use number::Real;

/// L D Lᵀ of a symmetric positive matrix in its lower triangle, without pivots; the reciprocals of D on the diagonal.
#[inline(always)]
pub(super) fn factor<R: Real>(a: &mut [R], n: usize) {
    for k in 0..n {
        let inverse = a[k * (n + 1)].recip();
        for i in k + 1..n {
            let below = a[i * n + k];
            let factor = below * inverse;
            // the columns behind still hold the unscaled entries
            for j in k + 1..=i {
                a[i * n + j] -= factor * a[j * n + k];
            }
        }
        for i in k + 1..n {
            a[i * n + k] *= inverse;
        }
        a[k * (n + 1)] = inverse;
    }
}

/// Solves with those factors, in place.
#[inline(always)]
pub(super) fn solve<R: Real>(a: &[R], n: usize, side: &mut [R]) {
    for i in 1..n {
        let mut value = side[i];
        for j in 0..i {
            value -= a[i * n + j] * side[j];
        }
        side[i] = value;
    }
    for i in 0..n {
        side[i] *= a[i * (n + 1)];
    }
    for i in (0..n).rev() {
        let mut value = side[i];
        for j in i + 1..n {
            value -= a[j * n + i] * side[j];
        }
        side[i] = value;
    }
}
