//! The border of a linearly implicit step: a small symmetric system, a lane each, whose rows are velocities; positions follow.

use crate::bearing::tangents::{ENTRIES, ROWS};
use crate::body::BodyAt;
use number::Real;

/// L D Lᵀ of a symmetric positive matrix in its lower triangle, without pivots: L below the diagonal and its transpose above, so
/// that both substitutions go along rows; the reciprocals of D on the diagonal.
#[inline(always)]
pub(super) fn factor<R: Real>(a: &mut [R], n: usize) {
    for k in 0..n {
        let inverse = a[k * (n + 1)].recip();
        a[k * (n + 1)] = inverse;
        for j in k + 1..n {
            a[k * n + j] = a[j * n + k];
        }
        let (above, below) = a.split_at_mut((k + 1) * n);
        let column = &mut above[k * (n + 1) + 1..];
        for (i, row) in below.chunks_exact_mut(n).enumerate() {
            let factor = column[i] * inverse;
            row[k] = factor;
            for (entry, unscaled) in row[k + 1..].iter_mut().zip(&column[..=i]) {
                *entry -= factor * *unscaled;
            }
        }
        for entry in column {
            *entry *= inverse;
        }
    }
}

/// Solves with those factors, in place.
///
/// A step solves four times and waits for one value after the other: of a point rotor in one or two bearings, and of a flexible one in two, the
/// number of rows is known when this is compiled, and they stay in registers.
#[inline(always)]
pub(super) fn solve<R: Real>(a: &[R], n: usize, side: &mut [R]) {
    match n {
        2 => solve_rows::<R, 2>(a, side),
        9 => solve_rows::<R, 9>(a, side),
        15 => solve_rows::<R, 15>(a, side),
        17 => solve_rows::<R, 17>(a, side),
        _ => solve_along(a, n, side),
    }
}

/// The same of so many rows.
#[inline(always)]
fn solve_rows<R: Real, const N: usize>(a: &[R], side: &mut [R]) {
    let (rows, _) = a.as_chunks::<N>();
    let (side, _) = side.as_chunks_mut::<N>();
    let mut u = side[0];
    for k in 0..N {
        let value = u[k];
        u[k] = value * rows[k][k];
        for i in k + 1..N {
            u[i] -= rows[k][i] * value;
        }
    }
    for k in (0..N).rev() {
        for i in 0..k {
            u[i] -= rows[k][i] * u[k];
        }
    }
    side[0] = u;
}

/// The same of any number of rows.
#[inline(always)]
fn solve_along<R: Real>(a: &[R], n: usize, side: &mut [R]) {
    for (k, row) in a.chunks_exact(n).enumerate() {
        let (known, rest) = side.split_at_mut(k + 1);
        let value = known[k];
        known[k] = value * row[k];
        for (entry, factor) in rest.iter_mut().zip(&row[k + 1..]) {
            *entry -= *factor * value;
        }
    }
    for (k, row) in a.chunks_exact(n).enumerate().rev() {
        let (rest, known) = side.split_at_mut(k);
        let value = known[0];
        for (entry, factor) in rest.iter_mut().zip(row) {
            *entry -= *factor * value;
        }
    }
}

/// u of a body's velocities, and of its position, whose right-hand sides stand there.
#[inline(always)]
pub(super) fn follow<R: Real>(side: &mut [R], body: BodyAt, velocity: [R; 2], inverse_g: R) {
    if body == BodyAt::STILL {
        return;
    }
    let channels = body.centre().into_iter().zip(body.velocity());
    for ((place, rate), velocity) in channels.zip(velocity) {
        side[place] = (side[place] + velocity) * inverse_g;
        side[rate] = velocity;
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
