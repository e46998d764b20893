//! Repeatable numbers: pseudo-random ones from a seed, and a sequence that fills a space evenly.

use crate::normal::quantile;
use rand_distr::{Distribution, Open01, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

/// Pseudo-random numbers of a seed: xoshiro256++.
#[derive(Clone, Debug)]
pub struct Random(Xoshiro256PlusPlus);

impl Random {
    /// From a seed alone: the same seed gives the same numbers.
    pub fn new(seed: u64) -> Self {
        Self(Xoshiro256PlusPlus::seed_from_u64(seed))
    }

    /// Uniform in (0, 1).
    pub fn uniform(&mut self) -> f64 {
        Open01.sample(&mut self.0)
    }

    /// Normal of mean 0 and deviation 1.
    pub fn normal(&mut self) -> f64 {
        StandardNormal.sample(&mut self.0)
    }
}

/// Bases of the sequence, one a dimension.
const BASES: [usize; 8] = [2, 3, 5, 7, 11, 13, 17, 19];

/// A coordinate of a point of Halton's sequence as a normal number of mean 0 and deviation 1.
///
/// - `index`: of the point, from 1 on
/// - `dimension`: of the coordinate, from 0 on; the ninth is alike the first
///
/// Source: Halton, Numer. Math. 2 (1960) 84 (from memory).
pub fn quasi_normal(index: usize, dimension: usize) -> f64 {
    let base = BASES[dimension % BASES.len()];
    let (mut left, mut part, mut x) = (index, 1.0, 0.0);
    while left > 0 {
        part /= base as f64;
        x += part * (left % base) as f64;
        left /= base;
    }
    quantile(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sequence_fills_evenly() {
        // the first n = b^k points are i/n, i from 1 to n - 1, which cancel about ½, and 1/(b n): their sum is its normal number;
        // the variance lacks or has too much what lies beyond 1/(2n) at both ends, 2 (c φ(c) + Q(c)), about (c² + 2)/n
        for (dimension, power) in [(0, 9), (1, 6), (4, 3)] {
            let base = BASES[dimension];
            let count = base.pow(power);
            let n = count as f64;
            let points: Vec<f64> = (1..=count).map(|k| quasi_normal(k, dimension)).collect();
            let mean = points.iter().sum::<f64>() / n;
            let square = points.iter().map(|x| x * x).sum::<f64>() / n;
            let ends = (quantile(0.5 / n).powi(2) + 2.0) / n;
            assert!((mean - quantile(1.0 / (base as f64 * n)) / n).abs() < 1e-12);
            assert!((square - 1.0).abs() < ends, "{square} {ends}");
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
        let mut random = Random::new(1);
        // 2000 of variance 1/12 about ½: 5 deviations of the mean
        let mean = (0..2000).map(|_| random.uniform()).sum::<f64>() / 2000.0;
        assert!((mean - 0.5).abs() < 5.0 * (12.0_f64 * 2000.0).sqrt().recip());
    }
}
