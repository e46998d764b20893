//! Bogacki-Shampine 3(2): three new stages a step, the last one shared with the next step, cubic dense output.
//!
//! ```text
//!   k1 = f(y)                          (the last stage of the step before)
//!   k2 = f(y + ½ h k1)
//!   k3 = f(y + ¾ h k2)
//!   y⁺ = y + h (2 k1 + 3 k2 + 4 k3)/9        k4 = f(y⁺)
//!   error = h (-5 k1/72 + k2/12 + k3/9 - k4/8)
//! ```
//! Source: P. Bogacki, L. F. Shampine, A 3(2) pair of Runge-Kutta formulas, Appl. Math. Lett. 2 (1989) 321.
//! Coefficients checked in the tests against the order conditions. Dense output is the cubic through both states with
//! both rates (Hermite).

/// Stages of a step, the shared one counted once on each side.
pub const STAGES: usize = 4;
/// Order of the step; the embedded one is one lower.
pub const ORDER: usize = 3;

/// Instants of the stages, in steps.
pub const C: [f64; STAGES] = [0.0, 0.5, 0.75, 1.0];

/// Weights of the earlier rates in each stage; the last row is the step itself.
pub const A: [[f64; STAGES - 1]; STAGES] = [
    [0.0; 3],
    [0.5, 0.0, 0.0],
    [0.0, 0.75, 0.0],
    [2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0],
];

/// Weights of the error estimate: the step of order three less the embedded one of order two.
pub const E: [f64; STAGES] = [-5.0 / 72.0, 1.0 / 12.0, 1.0 / 9.0, -1.0 / 8.0];

/// Weights of dense output at a fraction θ of a step:
/// y(θ) = y + change·(y⁺ - y) + h (first·k1 + last·k4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DenseWeights {
    /// Of the change of the state over the step.
    pub change: f64,
    /// Of the rate at the start.
    pub first: f64,
    /// Of the rate at the end.
    pub last: f64,
}

/// The weights at the fraction `theta` of a step: the Hermite cubic.
#[inline(always)]
pub fn dense_weights(theta: f64) -> DenseWeights {
    let square = theta * theta;
    DenseWeights {
        change: square * (3.0 - 2.0 * theta),
        first: theta * (1.0 - theta) * (1.0 - theta),
        last: square * (theta - 1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Weights of the four rates in the state at a fraction of a step.
    fn rate_weights(theta: f64) -> [f64; STAGES] {
        let w = dense_weights(theta);
        let [b1, b2, b3] = A[3];
        [
            w.change * b1 + w.first,
            w.change * b2,
            w.change * b3,
            w.last,
        ]
    }
    fn sum(weights: &[f64], value: impl Fn(usize) -> f64) -> f64 {
        weights.iter().enumerate().map(|(i, w)| w * value(i)).sum()
    }

    #[test]
    fn stages_are_consistent() {
        for i in 0..STAGES {
            assert!((sum(&A[i], |_| 1.0) - C[i]).abs() < 1e-15);
        }
        assert!(sum(&E, |_| 1.0).abs() < 1e-16);
    }
    #[test]
    fn the_inner_stages_start_from_the_rates_before_them_alone() {
        assert_eq!((A[1][1], A[1][2]), (0.0, 0.0));
        assert_eq!((A[2][0], A[2][2]), (0.0, 0.0));
    }
    #[test]
    fn order_conditions_hold_to_three() {
        let b = A[3];
        for power in 0..3 {
            let exact = 1.0 / f64::from(power + 1);
            assert!((sum(&b, |i| C[i].powi(power)) - exact).abs() < 1e-15);
        }
        // Σ b_i a_ij c_j = 1/6
        assert!((sum(&b, |i| sum(&A[i], |j| C[j])) - 1.0 / 6.0).abs() < 1e-15);
    }
    #[test]
    fn the_embedded_step_has_order_two_and_not_three() {
        let embedded = |i: usize| if i < 3 { A[3][i] - E[i] } else { -E[3] };
        let moment = |power: i32| {
            (0..STAGES)
                .map(|i| embedded(i) * C[i].powi(power))
                .sum::<f64>()
        };
        assert!((moment(0) - 1.0).abs() < 1e-15 && (moment(1) - 0.5).abs() < 1e-15);
        assert!((moment(2) - 1.0 / 3.0).abs() > 1e-3);
    }
    #[test]
    fn dense_output_meets_both_ends_with_their_rates() {
        assert_eq!(rate_weights(0.0), [0.0; STAGES]);
        let end = rate_weights(1.0);
        for i in 0..3 {
            assert!((end[i] - A[3][i]).abs() < 1e-15);
        }
        assert_eq!(end[3], 0.0);
        // its slope is the first rate at the start and the last one at the end
        let h = 1e-6;
        let slope = |a: [f64; STAGES], b: [f64; STAGES], i: usize| (b[i] - a[i]) / h;
        for i in 0..STAGES {
            let at_start = slope(rate_weights(0.0), rate_weights(h), i);
            let at_end = slope(rate_weights(1.0 - h), end, i);
            // differences over 1e-6: a few times that
            assert!((at_start - f64::from(u8::from(i == 0))).abs() < 1e-5);
            assert!((at_end - f64::from(u8::from(i == 3))).abs() < 1e-5);
        }
    }
    #[test]
    fn dense_output_has_order_three_along_the_solution() {
        for theta in [0.2_f64, 0.5, 0.8] {
            let w = rate_weights(theta);
            for power in 0..3 {
                let exact = theta.powi(power + 1) / f64::from(power + 1);
                let ours = (0..STAGES).map(|i| w[i] * C[i].powi(power)).sum::<f64>();
                assert!((ours - exact).abs() < 1e-15, "{theta} {power}");
            }
        }
    }
}
