//! Reproducible numbers: a quasi-random sequence, pseudo-random numbers, the normal distribution.

/// Pseudo-random numbers from a seed alone: SplitMix64 (Steele, Lea, Flood 2014, from memory).
#[derive(Clone, Debug)]
pub(crate) struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    /// Uniform in (0, 1).
    pub fn uniform(&mut self) -> f64 {
        ((self.next() >> 11) as f64 + 0.5) * (1.0 / 9_007_199_254_740_992.0)
    }
    /// Standard normal.
    pub fn normal(&mut self) -> f64 {
        normal_quantile(self.uniform())
    }
}

const BASES: [u32; 8] = [2, 3, 5, 7, 11, 13, 17, 19];

/// Point `index` of Halton's sequence, shifted modulo 1, as standard normal coordinates; up to eight of them.
pub(crate) fn quasi_normal(index: u32, shift: &[f64]) -> Vec<f64> {
    (shift.iter().zip(BASES))
        .map(|(shift, base)| {
            let (mut value, mut weight, mut rest) = (*shift, 1.0, index + 1);
            while rest > 0 {
                weight /= f64::from(base);
                value += weight * f64::from(rest % base);
                rest /= base;
            }
            normal_quantile(value.fract().clamp(1e-12, 1.0 - 1e-12))
        })
        .collect()
}

/// Quantile of the standard normal distribution, relative error below 1.2e-9 (P. J. Acklam's fit, from memory).
pub(crate) fn normal_quantile(probability: f64) -> f64 {
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

/// Probability that chi-squared with so many degrees of freedom exceeds a value, after Wilson and Hilferty: within
/// 0.002 for three degrees and more.
pub(crate) fn chi_squared_exceeds(value: f64, degrees: usize) -> f64 {
    let variance = 2.0 / (9.0 * degrees.max(1) as f64);
    let z = ((value / degrees.max(1) as f64).cbrt() - 1.0 + variance) / variance.sqrt();
    normal_exceeds(z)
}

/// Probability that a standard normal number exceeds z, absolute error below 1e-7 (Abramowitz and Stegun 26.2.17,
/// from memory); in the far tail its leading term.
fn normal_exceeds(z: f64) -> f64 {
    if z < 0.0 {
        return 1.0 - normal_exceeds(-z);
    }
    let t = 1.0 / (1.0 + 0.231_641_9 * z);
    let series = t
        * (0.319_381_530
            + t * (-0.356_563_782
                + t * (1.781_477_937 + t * (-1.821_255_978 + t * 1.330_274_429))));
    (-0.5 * z * z).exp() * series / (2.0 * std::f64::consts::PI).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_and_tails_of_tables() {
        // Tables: 97.5 % at 1.959964, 99.9 % at 3.090232; chi-squared with 10 degrees exceeds 23.209 in 1 %.
        assert!((normal_quantile(0.975) - 1.959_964).abs() < 1e-6);
        assert!((normal_quantile(0.001) + 3.090_232).abs() < 1e-6);
        assert!((normal_exceeds(1.959_964) - 0.025).abs() < 1e-6);
        assert!((chi_squared_exceeds(23.209, 10) - 0.01).abs() < 5e-4);
    }
    #[test]
    fn the_sequence_fills_evenly() {
        // mean 0 and variance 1 of 512 quasi-random points: discrepancy (ln n)/n, far below 1/√512 = 0.044
        let points: Vec<_> = (0..512).map(|i| quasi_normal(i, &[0.3, 0.7])).collect();
        for axis in 0..2 {
            let mean = points.iter().map(|p| p[axis]).sum::<f64>() / 512.0;
            let square = points.iter().map(|p| p[axis] * p[axis]).sum::<f64>() / 512.0;
            assert!(
                mean.abs() < 0.02 && (square - 1.0).abs() < 0.04,
                "{mean} {square}"
            );
        }
    }
    #[test]
    fn a_seed_makes_the_numbers() {
        let draw = |seed| {
            let mut random = Random::new(seed);
            (0..5).map(|_| random.normal()).collect::<Vec<_>>()
        };
        assert_eq!(draw(7), draw(7));
        assert_ne!(draw(7), draw(8));
    }
}
