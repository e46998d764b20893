//! Reproducible numbers: a quasi-random sequence, pseudo-random numbers.

use measure::normal::quantile;

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
        quantile(self.uniform())
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
            quantile(value.fract().clamp(1e-12, 1.0 - 1e-12))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

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
