//! Tsitouras 5(4): six new stages a step, the last one shared with the next step, dense output of order four.
//!
//! Source: Ch. Tsitouras, Runge-Kutta pairs of order 5(4) satisfying only the first column simplifying assumption,
//! Comput. Math. Appl. 62 (2011) 770. Coefficients checked in the tests against the order conditions.

/// Stages of a step, the shared one counted once on each side.
pub const STAGES: usize = 7;

/// Instants of the stages, in steps.
pub const C: [f64; STAGES] = [0.0, 0.161, 0.327, 0.9, 0.980_025_540_904_509_7, 1.0, 1.0];

/// Weights of the earlier rates in each stage; the last row is the step itself.
pub const A: [[f64; 6]; STAGES] = [
    [0.0; 6],
    [0.161, 0.0, 0.0, 0.0, 0.0, 0.0],
    [
        -0.008_480_655_492_356_989,
        0.335_480_655_492_357,
        0.0,
        0.0,
        0.0,
        0.0,
    ],
    [
        2.897_153_057_105_493_5,
        -6.359_448_489_975_075,
        4.362_295_432_869_581_5,
        0.0,
        0.0,
        0.0,
    ],
    [
        5.325_864_828_439_257,
        -11.748_883_564_062_828,
        7.495_539_342_889_836_5,
        -0.092_495_066_361_755_25,
        0.0,
        0.0,
    ],
    [
        5.861_455_442_946_42,
        -12.920_969_317_847_11,
        8.159_367_898_576_159,
        -0.071_584_973_281_401,
        -0.028_269_050_394_068_383,
        0.0,
    ],
    [
        0.096_460_766_818_065_23,
        0.01,
        0.479_889_650_414_499_6,
        1.379_008_574_103_742,
        -3.290_069_515_436_081,
        2.324_710_524_099_774,
    ],
];

/// Weights of the error estimate: the step of order five less the embedded one of order four.
pub const E: [f64; STAGES] = [
    -0.001_780_011_052_225_777_14,
    -0.000_816_434_459_656_746_9,
    0.007_880_878_010_261_995,
    -0.144_711_007_173_262_9,
    0.582_357_165_452_555_2,
    -0.458_082_105_929_186_97,
    0.015_151_515_151_515_152,
];

/// Weights of the rates in the state at the fraction `theta` of a step.
#[inline(always)]
pub fn dense_weights(theta: f64) -> [f64; STAGES] {
    let t2 = theta * theta;
    let quartic = |a: f64, b: f64, c: f64| t2 * (a + theta * (b + theta * c));
    [
        theta
            + quartic(
                -2.763_706_197_274_826,
                2.913_255_461_821_912_6,
                -1.053_088_497_729_021_6,
            ),
        quartic(0.131_7, -0.223_4, 0.101_7),
        quartic(
            3.930_296_236_894_751_6,
            -5.941_033_872_131_505,
            2.490_627_285_651_252_8,
        ),
        quartic(
            -12.411_077_166_933_676,
            30.338_188_630_282_32,
            -16.548_102_889_244_902,
        ),
        quartic(
            37.509_313_416_511_04,
            -88.178_904_894_766_4,
            47.379_521_962_819_28,
        ),
        quartic(
            -27.896_526_289_197_286,
            65.091_894_674_793_66,
            -34.870_657_861_496_61,
        ),
        quartic(1.5, -4.0, 2.5),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sum(weights: &[f64], value: impl Fn(usize) -> f64) -> f64 {
        weights.iter().enumerate().map(|(i, w)| w * value(i)).sum()
    }

    #[test]
    fn stages_are_consistent() {
        for i in 0..STAGES {
            assert!((sum(&A[i], |_| 1.0) - C[i]).abs() < 1e-14);
        }
        assert!(sum(&E, |_| 1.0).abs() < 1e-15);
    }
    #[test]
    fn order_conditions_hold_to_five() {
        let b = A[6];
        for power in 0..5 {
            let exact = 1.0 / f64::from(power + 1);
            assert!((sum(&b, |i| C[i].powi(power)) - exact).abs() < 1e-14);
        }
        // Σ b_i a_ij c_j = 1/6, Σ b_i a_ij c_j² = 1/12, Σ b_i c_i a_ij c_j = 1/8, Σ b_i a_ij a_jk c_k = 1/24
        let ac = |i: usize| sum(&A[i], |j| C[j]);
        assert!((sum(&b, ac) - 1.0 / 6.0).abs() < 1e-14);
        assert!((sum(&b, |i| sum(&A[i], |j| C[j] * C[j])) - 1.0 / 12.0).abs() < 1e-14);
        assert!((sum(&b, |i| C[i] * ac(i)) - 1.0 / 8.0).abs() < 1e-14);
        assert!((sum(&b, |i| sum(&A[i], ac)) - 1.0 / 24.0).abs() < 1e-14);
    }
    #[test]
    fn dense_output_ends_on_the_step_and_has_order_four() {
        let end = dense_weights(1.0);
        for i in 0..6 {
            assert!((end[i] - A[6][i]).abs() < 1e-13);
        }
        for theta in [0.1, 0.37, 0.5, 0.93] {
            let w = dense_weights(theta);
            for power in 0..4 {
                let exact = theta.powi(power + 1) / f64::from(power + 1);
                assert!((sum(&w, |i| C[i].powi(power)) - exact).abs() < 1e-13);
            }
        }
    }
}
