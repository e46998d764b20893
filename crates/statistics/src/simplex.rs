//! The lowest point of a function of a few variables without derivatives.
//!
//! Source: Nelder and Mead, A simplex method for function minimization, Computer Journal 7 (1965) 308 (from memory).

use std::array::from_fn;
use std::cell::Cell;

/// Lowest point found and the value there.
///
/// Starts from `start` with steps `step` along each axis; stops at the end of the round in which `calls` evaluations are reached,
/// or when the values at the corners differ by less than `tolerance`. A value that is not a number counts as infinitely high.
pub fn lowest<const N: usize>(
    start: [f64; N],
    step: [f64; N],
    tolerance: f64,
    calls: usize,
    mut function: impl FnMut(&[f64; N]) -> f64,
) -> ([f64; N], f64) {
    let used = Cell::new(0);
    let mut valued = |point: [f64; N]| {
        used.set(used.get() + 1);
        let value = function(&point);
        (point, if value.is_nan() { f64::INFINITY } else { value })
    };
    let mut corners = vec![valued(start)];
    for axis in 0..N {
        let mut point = start;
        point[axis] += step[axis];
        corners.push(valued(point));
    }
    loop {
        corners.sort_by(|a, b| a.1.total_cmp(&b.1));
        let (best, worst) = (corners[0], corners[N]);
        if used.get() >= calls || worst.1 - best.1 < tolerance {
            return best;
        }
        let centre: [f64; N] =
            from_fn(|i| corners[..N].iter().map(|c| c.0[i]).sum::<f64>() / N as f64);
        let along = |reach: f64| from_fn(|i| centre[i] + reach * (worst.0[i] - centre[i]));
        let reflected = valued(along(-1.0));
        if reflected.1 < best.1 {
            let expanded = valued(along(-2.0));
            corners[N] = if expanded.1 < reflected.1 {
                expanded
            } else {
                reflected
            };
        } else if reflected.1 < corners[N - 1].1 {
            corners[N] = reflected;
        } else {
            let contracted = valued(along(if reflected.1 < worst.1 { -0.5 } else { 0.5 }));
            if contracted.1 < reflected.1.min(worst.1) {
                corners[N] = contracted;
            } else {
                for corner in &mut corners[1..] {
                    *corner = valued(from_fn(|i| 0.5 * (best.0[i] + corner.0[i])));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_bottom_of_a_curved_valley_is_found() {
        let (point, value) = super::lowest([-1.2, 1.0], [0.3, 0.3], 1e-14, 2000, |p| {
            (1.0 - p[0]).powi(2) + 100.0 * (p[1] - p[0] * p[0]).powi(2)
        });
        assert!(value < 1e-12 && (point[0] - 1.0).abs() < 1e-5 && (point[1] - 1.0).abs() < 1e-5);
    }
}
