//! Small systems of equations, and the balance of a ring by damped Newton steps.

use super::ring::NoEquilibrium;

/// Solves A x = b by elimination with the largest pivot; none where A is singular.
pub(super) fn solve<const N: usize>(mut a: [[f64; N]; N], mut b: [f64; N]) -> Option<[f64; N]> {
    for k in 0..N {
        let pivot = (k..N).max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs()))?;
        a.swap(k, pivot);
        b.swap(k, pivot);
        if a[k][k] == 0.0 || !a[k][k].is_finite() {
            return None;
        }
        for i in k + 1..N {
            let factor = a[i][k] / a[k][k];
            let (above, below) = a.split_at_mut(i);
            for (value, pivot) in below[0][k..].iter_mut().zip(&above[k][k..]) {
                *value -= factor * pivot;
            }
            b[i] -= factor * b[k];
        }
    }
    for k in (0..N).rev() {
        let known: f64 = (k + 1..N).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - known) / a[k][k];
    }
    b.iter().all(|x| x.is_finite()).then_some(b)
}

/// What a bearing does to its displaced ring: the load, its slope, and the largest load of a ball.
pub(super) struct Reaction<T> {
    pub load: [f64; 5],
    pub slope: [[f64; 5]; 5],
    pub largest: f64,
    pub found: T,
}

/// Displacement at which a bearing balances a load from outside, with what was found there.
pub(super) struct Balance {
    /// Load from outside.
    pub outside: [f64; 5],
    /// Arm by which moments count as forces and tilts as shifts, m.
    pub arm: f64,
    /// A stiffness of the size of the bearing's, N/m.
    pub stiffness: f64,
}

/// Longest step of the ring, m.
const LONGEST_STEP: f64 = 5e-6;
/// Share of the load to which the iteration balances it.
const BALANCED: f64 = 1e-11;
/// The same where rounding is met: places of balls are known to 4e-18 m.
pub(super) const ROUNDING: f64 = 1e-8;

impl Balance {
    /// Damped steps from a displacement: the damping fades with what is left of the load.
    pub(super) fn find<T>(
        &self,
        start: [f64; 5],
        mut reaction: impl FnMut([f64; 5]) -> Result<Reaction<T>, NoEquilibrium>,
    ) -> Result<([f64; 5], Reaction<T>), NoEquilibrium> {
        let lengths = [1.0, 1.0, 1.0, self.arm, self.arm];
        let size = |list: [f64; 5], power: i32| {
            let each = list.iter().zip(lengths);
            each.fold(0.0_f64, |most, (value, length)| {
                most.max((value * length.powi(power)).abs())
            })
        };
        let mut u = start;
        let (mut damping, mut before) = (self.stiffness, f64::INFINITY);
        for _ in 0..600 {
            let at = reaction(u)?;
            let left: [f64; 5] = std::array::from_fn(|k| at.load[k] + self.outside[k]);
            let share = size(left, -1) / at.largest.max(size(self.outside, -1)).max(1e-6);
            let mut matrix = at.slope.map(|row| row.map(|slope| -slope));
            for (k, length) in lengths.iter().enumerate() {
                matrix[k][k] += damping * length * length;
            }
            let step = solve(matrix, left);
            let longest = step.map_or(f64::INFINITY, |step| size(step, 1));
            // near the balance, what no longer shrinks is rounding
            let rounding = share < ROUNDING && share > 0.5 * before;
            if share < BALANCED || longest < 1e-17 || rounding {
                return Ok((u, at));
            }
            before = share;
            let Some(step) = step else {
                damping = damping.max(1.0) * 10.0;
                continue;
            };
            for (value, step) in u.iter_mut().zip(&step) {
                *value += (LONGEST_STEP / longest).min(1.0) * step;
            }
            damping = self.stiffness * (share * share).min(1e-2);
        }
        Err(NoEquilibrium::Ring)
    }
}

#[cfg(test)]
mod tests {
    use super::solve;

    #[test]
    fn a_system_is_solved_and_a_singular_one_refused() {
        let a = [[0.0, 2.0, 1.0], [1.0, -1.0, 3.0], [4.0, 0.5, -2.0]];
        let x = solve(a, [7.0, 8.0, -1.0]).unwrap();
        for (row, b) in a.iter().zip([7.0, 8.0, -1.0]) {
            let sum: f64 = row.iter().zip(x).map(|(a, x)| a * x).sum();
            assert!((sum - b).abs() < 1e-14);
        }
        assert_eq!(solve([[1.0, 2.0], [2.0, 4.0]], [1.0, 1.0]), None);
    }
}
