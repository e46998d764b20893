//! ROS34PW2, a linearly implicit method of order three for stiff problems: four stages, each one linear system.
//!
//! ```text
//!   (1/(hγ) I - J) u_i = f(t + α_i h, y + Σ a_ij u_j) + Σ c_ij u_j / h          i = 1..4, j < i
//!   y⁺ = y + Σ m_i u_i          error = Σ (m_i - m̂_i) u_i
//! ```
//! Quadratures q̇ = g(y), on which nothing depends, need no system: q⁺ = q + h Σ b_i g(Y_i) + h ∂g/∂y Σ b_i u_i.
//!
//! The last stage is the first step of Newton's iteration for y⁺ = (the other stages) + hγ f(t + h, y⁺), and the rate at the
//! new state, which the next step needs anyway, shows what the iteration's second step would change:
//!
//! ```text
//!   δ = (1/(hγ) I - J)⁻¹ (f(t + h, y⁺) - k_4/h),  k_4/h = u_4/(hγ) - Σ c_4j u_j/h
//! ```
//! δ vanishes where f is linear and J exact, and is of the third order in h else. The embedded error knows the arguments of the
//! stages alone, and that of the last one lags y⁺ by u_4 (0.18 g h² in free fall): a contact that begins in between is
//! in no stage. It is in δ: a step with δ beyond the tolerance in any channel is rejected. The system is solved only
//! where hγ (f - k_4/h) is beyond it, which stiff channels, but few others, exceed in ordinary steps.
//!
//! A W-method: its order does not rest on an exact J, so that J may leave out what is small and may be kept from an
//! earlier state. L-stable and stiffly accurate where J is exact. a, c, m follow from the coefficients α, Γ, b of the
//! source by Γ⁻¹ (Hairer, Wanner, Solving ODEs II, IV.7).
//!
//! Source: J. Rang, L. Angermann, New Rosenbrock W-methods of order 3 for partial differential algebraic equations of
//! index 1, BIT 45 (2005) 761. Coefficients checked in the tests against the order conditions of W-methods.

/// Stages of a step.
pub const STAGES: usize = 4;
/// Order of the step; the embedded one is one lower.
pub const ORDER: usize = 3;
/// γ, the diagonal of Γ.
pub const GAMMA: f64 = 0.435_866_521_508_459;

/// α: weights of the earlier stages in the argument of f.
const ALPHA: [[f64; STAGES]; STAGES] = [
    [0.0; 4],
    [0.871_733_043_016_918, 0.0, 0.0, 0.0],
    [
        0.844_570_600_153_694_23,
        -0.112_990_642_364_841_85,
        0.0,
        0.0,
    ],
    [0.0, 0.0, 1.0, 0.0],
];
/// Γ below its diagonal.
const LOWER_GAMMA: [[f64; STAGES]; STAGES] = [
    [0.0; 4],
    [-0.871_733_043_016_918, 0.0, 0.0, 0.0],
    [
        -0.903_380_570_130_440_82,
        0.054_180_672_388_095_326,
        0.0,
        0.0,
    ],
    [
        0.242_123_807_060_953_46,
        -1.223_250_583_904_514_7,
        0.545_260_255_335_102_14,
        0.0,
    ],
];
/// b: weights of the step.
pub const STEP: [f64; STAGES] = [
    0.242_123_807_060_953_46,
    -1.223_250_583_904_514_7,
    1.545_260_255_335_102,
    0.435_866_521_508_459,
];
/// b̂: weights of the embedded step.
pub const EMBEDDED: [f64; STAGES] = [
    0.378_109_031_458_193_69,
    -0.096_042_292_212_423_178,
    0.5,
    0.217_933_260_754_229_5,
];

/// The coefficients for stages that hold u, not k: no product with J is needed then.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients {
    /// Instants of the stages, in steps.
    pub instant: [f64; STAGES],
    /// a.
    pub argument: [[f64; STAGES]; STAGES],
    /// c.
    pub side: [[f64; STAGES]; STAGES],
    /// m.
    pub step: [f64; STAGES],
    /// m - m̂.
    pub error: [f64; STAGES],
}

impl Coefficients {
    /// Transforms those of the source.
    pub fn new() -> Self {
        let inverse = inverse_gamma();
        let times = |row: &[f64; STAGES]| -> [f64; STAGES] {
            std::array::from_fn(|j| (0..STAGES).map(|k| row[k] * inverse[k][j]).sum())
        };
        let mut side = [[0.0; STAGES]; STAGES];
        for i in 0..STAGES {
            for j in 0..i {
                side[i][j] = -inverse[i][j];
            }
        }
        let step = times(&STEP);
        let embedded = times(&EMBEDDED);
        Coefficients {
            instant: ALPHA.map(|row| row.iter().sum()),
            argument: ALPHA.map(|row| times(&row)),
            side,
            step,
            error: std::array::from_fn(|i| step[i] - embedded[i]),
        }
    }
}

impl Default for Coefficients {
    fn default() -> Self {
        Coefficients::new()
    }
}

/// Γ⁻¹, by substitution from the top.
fn inverse_gamma() -> [[f64; STAGES]; STAGES] {
    let mut inverse = [[0.0; STAGES]; STAGES];
    for row in 0..STAGES {
        let mut values = [0.0; STAGES];
        for (column, value) in values.iter_mut().enumerate().take(row + 1) {
            let unit = if row == column { 1.0 } else { 0.0 };
            let known: f64 = (column..row)
                .map(|k| LOWER_GAMMA[row][k] * inverse[k][column])
                .sum();
            *value = (unit - known) / GAMMA;
        }
        inverse[row] = values;
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gamma(i: usize, j: usize) -> f64 {
        LOWER_GAMMA[i][j] + if i == j { GAMMA } else { 0.0 }
    }
    fn alpha(i: usize) -> f64 {
        ALPHA[i].iter().sum()
    }
    fn gammas(i: usize) -> f64 {
        (0..STAGES).map(|j| gamma(i, j)).sum()
    }
    fn sum(weights: &[f64; STAGES], value: impl Fn(usize) -> f64) -> f64 {
        (0..STAGES).map(|i| weights[i] * value(i)).sum()
    }
    fn near(ours: f64, exact: f64) {
        // the source prints sixteen digits
        assert!((ours - exact).abs() < 2e-15, "{ours} {exact}");
    }

    #[test]
    fn order_conditions_hold_for_any_jacobian() {
        let b = &STEP;
        near(sum(b, |_| 1.0), 1.0);
        near(sum(b, alpha), 0.5);
        near(sum(b, gammas), 0.0);
        near(sum(b, |i| alpha(i).powi(2)), 1.0 / 3.0);
        let nested = |outer: &dyn Fn(usize, usize) -> f64, inner: &dyn Fn(usize) -> f64| {
            sum(b, |i| (0..STAGES).map(|j| outer(i, j) * inner(j)).sum())
        };
        near(nested(&|i, j| ALPHA[i][j], &alpha), 1.0 / 6.0);
        near(nested(&|i, j| ALPHA[i][j], &gammas), 0.0);
        near(nested(&gamma, &alpha), 0.0);
        near(nested(&gamma, &gammas), 0.0);
    }
    #[test]
    fn the_embedded_step_has_order_two_for_any_jacobian_and_not_three() {
        let b = &EMBEDDED;
        near(sum(b, |_| 1.0), 1.0);
        near(sum(b, alpha), 0.5);
        near(sum(b, gammas), 0.0);
        assert!((sum(b, |i| alpha(i).powi(2)) - 1.0 / 3.0).abs() > 1e-3);
    }
    #[test]
    fn the_last_stage_is_the_step() {
        for j in 0..STAGES {
            near(ALPHA[3][j] + gamma(3, j), STEP[j]);
        }
        near(alpha(3), 1.0);
    }
    #[test]
    fn the_transformed_coefficients_give_the_same_step() {
        // y' = λ y with J = λ: one step by k and by u
        let (h, lambda) = (0.7, -1.3);
        let mut k = [0.0; STAGES];
        for i in 0..STAGES {
            let argument: f64 = 1.0 + (0..i).map(|j| ALPHA[i][j] * k[j]).sum::<f64>();
            let coupled: f64 = (0..i).map(|j| LOWER_GAMMA[i][j] * k[j]).sum();
            k[i] = h * lambda * (argument + coupled) / (1.0 - h * lambda * GAMMA);
        }
        let by_k = 1.0 + sum(&STEP, |i| k[i]);
        let c = Coefficients::new();
        let mut u = [0.0; STAGES];
        for i in 0..STAGES {
            let argument: f64 = 1.0 + (0..i).map(|j| c.argument[i][j] * u[j]).sum::<f64>();
            let side: f64 = (0..i).map(|j| c.side[i][j] * u[j]).sum();
            u[i] = (lambda * argument + side / h) / (1.0 / (h * GAMMA) - lambda);
        }
        near(1.0 + sum(&c.step, |i| u[i]), by_k);
        // and far out along the negative axis nothing is left
        let far = -1e9;
        for i in 0..STAGES {
            let argument: f64 = 1.0 + (0..i).map(|j| c.argument[i][j] * u[j]).sum::<f64>();
            let side: f64 = (0..i).map(|j| c.side[i][j] * u[j]).sum();
            u[i] = (far * argument + side) / (1.0 / GAMMA - far);
        }
        assert!((1.0 + sum(&c.step, |i| u[i])).abs() < 1e-6);
    }
}
