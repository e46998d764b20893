//! The normal distribution, and that of sums of its squares.

use std::f64::consts::{SQRT_2, TAU};

/// Median of |x| of normal numbers of mean 0 and deviation 1: a deviation that outliers hardly move is a median over this.
pub const MEDIAN_OF_SIZE: f64 = 0.6745;

/// Probability that a normal number of mean 0 and deviation 1 is below z.
pub fn below(z: f64) -> f64 {
    0.5 * libm::erfc(-z / SQRT_2)
}

/// Density of a normal number of mean 0 and deviation 1.
pub fn density(z: f64) -> f64 {
    (-0.5 * z * z).exp() / TAU.sqrt()
}

/// Probability that |x| is above a limit, x normal.
pub fn beyond(value: f64, deviation: f64, limit: f64) -> f64 {
    if deviation > 0.0 {
        below((value - limit) / deviation) + below((-limit - value) / deviation)
    } else if value.abs() > limit {
        1.0
    } else {
        0.0
    }
}

/// Quantile of the standard normal distribution, relative error below 1.2e-9 (P. J. Acklam's fit, from memory).
pub fn quantile(probability: f64) -> f64 {
    const A: [f64; 6] = [
        -3.969_683_028_665_376e1,
        2.209_460_984_245_205e2,
        -2.759_285_104_469_687e2,
        1.383_577_518_672_69e2,
        -3.066_479_806_614_716e1,
        2.506_628_277_459_239,
    ];
    const B: [f64; 6] = [
        -5.447_609_879_822_406e1,
        1.615_858_368_580_409e2,
        -1.556_989_798_598_866e2,
        6.680_131_188_771_972e1,
        -1.328_068_155_288_572e1,
        1.0,
    ];
    const C: [f64; 6] = [
        -7.784_894_002_430_293e-3,
        -3.223_964_580_411_365e-1,
        -2.400_758_277_161_838,
        -2.549_732_539_343_734,
        4.374_664_141_464_968,
        2.938_163_982_698_783,
    ];
    const D: [f64; 5] = [
        7.784_695_709_041_462e-3,
        3.224_671_290_700_398e-1,
        2.445_134_137_142_996,
        3.754_408_661_907_416,
        1.0,
    ];
    let polynomial = |c: &[f64], x: f64| c.iter().fold(0.0, |sum, c| sum * x + c);
    let tail = |p: f64| {
        let q = (-2.0 * p.ln()).sqrt();
        polynomial(&C, q) / polynomial(&D, q)
    };
    if probability < 0.02425 {
        tail(probability)
    } else if probability > 1.0 - 0.02425 {
        -tail(1.0 - probability)
    } else {
        let q = probability - 0.5;
        q * polynomial(&A, q * q) / polynomial(&B, q * q)
    }
}

/// Probability that the sum of the squares of so many normal numbers of deviation 1 is above a value: 1 for none of them. The number
/// need not be whole.
///
/// Source: Wilson and Hilferty, PNAS 17, 1931 (from memory); within 0.003.
pub fn squares_above(value: f64, count: f64) -> f64 {
    if count <= 0.0 {
        return 1.0;
    }
    let variance = 2.0 / (9.0 * count);
    below(-((value / count).cbrt() - 1.0 + variance) / variance.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probabilities_are_those_of_tables() {
        for (z, p) in [
            (0.0, 0.5),
            (1.0, 0.841_344_746),
            (-1.959_964, 0.025),
            (3.0, 0.998_650_102),
        ] {
            assert!((below(z) - p).abs() < 5e-9, "{z}");
        }
        assert!((beyond(0.0, 1.0, 1.959_964) - 0.05).abs() < 1e-8);
        assert_eq!((beyond(2.0, 0.0, 1.0), beyond(-0.5, 0.0, 1.0)), (1.0, 0.0));
        // Far out no digit is lost.
        assert!((below(-10.0) / 7.619_853_024e-24 - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_quantile_turns_a_probability_back() {
        for p in [1e-9, 0.001, 0.02, 0.2, 0.5, 0.7, 0.98, 0.999] {
            assert!((below(quantile(p)) / p - 1.0).abs() < 1e-7, "{p}");
        }
    }

    #[test]
    fn sums_of_squares_are_those_of_tables() {
        // 5 % points for 1, 10, 20 numbers, and the 1 % point for 10.
        for (count, point, p) in [
            (1.0, 3.841, 0.05),
            (10.0, 18.307, 0.05),
            (20.0, 31.410, 0.05),
            (10.0, 23.209, 0.01),
        ] {
            assert!((squares_above(point, count) - p).abs() < 3e-3, "{count}");
        }
        assert_eq!(squares_above(1.0, 0.0), 1.0);
    }
}
