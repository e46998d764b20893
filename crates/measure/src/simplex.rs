//! The lowest point of a function of a few variables without derivatives.
//!
//! Source: Nelder and Mead, A simplex method for function minimization, Computer Journal 7 (1965) 308 (from memory).

/// Lowest point found and the value there.
///
/// Starts from `start` with steps `step` along each axis; stops after `calls` evaluations or when the values at the corners
/// differ by less than `tolerance`. A value that is not a number counts as infinitely high.
pub(crate) fn lowest<const N: usize>(
    start: [f64; N],
    step: [f64; N],
    tolerance: f64,
    calls: usize,
    mut function: impl FnMut(&[f64; N]) -> f64,
) -> ([f64; N], f64) {
    let mut count = 0;
    let mut value_at = |point: &[f64; N]| {
        count += 1;
        let value = function(point);
        (if value.is_nan() { f64::INFINITY } else { value }, count)
    };
    let mut corners = vec![(start, value_at(&start).0)];
    for axis in 0..N {
        let mut point = start;
        point[axis] += step[axis];
        let value = value_at(&point).0;
        corners.push((point, value));
    }
    loop {
        corners.sort_by(|a, b| a.1.total_cmp(&b.1));
        let (best, worst) = (corners[0], corners[N]);
        if worst.1 - best.1 < tolerance {
            return best;
        }
        let mut centre = [0.0; N];
        for (point, _) in &corners[..N] {
            for (c, p) in centre.iter_mut().zip(point) {
                *c += p / N as f64;
            }
        }
        let along = |reach: f64| {
            let mut point = centre;
            for (p, w) in point.iter_mut().zip(&worst.0) {
                *p += reach * (w - *p);
            }
            point
        };
        let reflected = along(-1.0);
        let (at_reflected, used) = value_at(&reflected);
        if used >= calls {
            return if at_reflected < best.1 {
                (reflected, at_reflected)
            } else {
                best
            };
        }
        if at_reflected < best.1 {
            let expanded = along(-2.0);
            let at_expanded = value_at(&expanded).0;
            corners[N] = if at_expanded < at_reflected {
                (expanded, at_expanded)
            } else {
                (reflected, at_reflected)
            };
        } else if at_reflected < corners[N - 1].1 {
            corners[N] = (reflected, at_reflected);
        } else {
            let contracted = along(if at_reflected < worst.1 { -0.5 } else { 0.5 });
            let at_contracted = value_at(&contracted).0;
            if at_contracted < at_reflected.min(worst.1) {
                corners[N] = (contracted, at_contracted);
            } else {
                for corner in corners.iter_mut().skip(1) {
                    for (p, b) in corner.0.iter_mut().zip(&best.0) {
                        *p = 0.5 * (*p + b);
                    }
                    corner.1 = value_at(&corner.0).0;
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
