//! The border of a linearly implicit step: a small symmetric system, a lane each, whose rows are velocities; positions follow.

use crate::bearing::tangents::{ENTRIES, ROWS};
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

/// u of a body's velocities, and of its position, whose right-hand sides stand there.
#[inline(always)]
pub(super) fn follow<R: Real>(side: &mut [R], body: usize, velocity: [R; 2], inverse_g: R) {
    for i in 0..2 {
        side[body + i] = (side[body + i] + velocity[i]) * inverse_g;
        side[body + 2 + i] = velocity[i];
    }
}

/// u of an angle and of its spin, which stands behind it.
#[inline(always)]
pub(super) fn turn<R: Real>(side: &mut [R], angle: usize, spin: R, inverse_g: R) {
    side[angle] = (side[angle] + spin) * inverse_g;
    side[angle + 1] = spin;
}

/// Takes a row that does not move out of the border.
#[inline(always)]
pub(super) fn hold<R: Real>(border: &mut [R], n: usize, held: usize) {
    for other in 0..n {
        let (row, column) = (held.max(other), held.min(other));
        border[row * n + column] = R::zero();
    }
    border[held * (n + 1)] = R::one();
}

/// Adds a bearing's entries, on and above the diagonal row by row, to the rows from `own` on.
#[inline(always)]
pub(super) fn add_bearing<R: Real>(border: &mut [R], n: usize, own: usize, entries: &[R; ENTRIES]) {
    let mut entry = 0;
    for row in 0..ROWS {
        for column in row..ROWS {
            border[(own + column) * n + own + row] += entries[entry];
            entry += 1;
        }
    }
}
