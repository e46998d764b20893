//! Repeatable numbers: a stream of pseudo-random ones from a seed, a sequence that fills a space evenly, and numbers that a seed and counters make
//! without state, so that any of them can be computed without those before it.

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

/// The finaliser of SplitMix64: neighbours share nothing.
fn mixed(mut x: u64) -> u64 {
    x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// 64 bits of a seed and two counters.
pub fn bits(seed: u64, first: u64, second: u64) -> u64 {
    mixed(mixed(mixed(seed) ^ first) ^ second)
}

/// Uniform in (0, 1), from a seed and two counters.
pub fn uniform(seed: u64, first: u64, second: u64) -> f64 {
    let whole = bits(seed, first, second) >> 11;
    (whole as f64 + 0.5) / (1_u64 << 53) as f64
}

/// A whole number below `count`, from a seed and two counters.
pub fn below(count: usize, seed: u64, first: u64, second: u64) -> usize {
    // for counts below 2^32 no number is more frequent by more than 2^-32
    ((u128::from(bits(seed, first, second)) * count as u128) >> 64) as usize
}

/// Place of `index` in a permutation of `count` things that the key alone decides: a Feistel network on the smallest even
/// number of bits that holds them, walked until it lands among them.
pub fn permuted(index: usize, count: usize, key: u64) -> usize {
    let bits_needed = usize::BITS - count.saturating_sub(1).leading_zeros();
    let half = bits_needed.div_ceil(2).max(1);
    let mask = (1_u64 << half) - 1;
    let mut x = index as u64;
    loop {
        let (mut left, mut right) = (x >> half, x & mask);
        for round in 0..4 {
            (left, right) = (right, left ^ (bits(key, right, round) & mask));
        }
        x = (left << half) | right;
        if x < count as u64 {
            return x as usize;
        }
    }
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

    #[test]
    fn a_permutation_takes_every_place_once() {
        for count in [1, 2, 3, 7, 64, 1000] {
            let mut places: Vec<usize> = (0..count).map(|k| permuted(k, count, 5)).collect();
            assert!(count < 7 || places.iter().enumerate().any(|(k, place)| k != *place));
            places.sort_unstable();
            assert!(places.into_iter().eq(0..count));
        }
    }

    #[test]
    fn neighbouring_counters_are_uncorrelated() {
        let count = 10_000;
        let of = |k: u64, column: u64| uniform(1, k, column) - 0.5;
        let product = |a: (u64, u64), b: (u64, u64)| {
            let sum: f64 = (0..count)
                .map(|k| of(k + a.0, a.1) * of(k + b.0, b.1))
                .sum();
            sum / count as f64 * 12.0
        };
        // a correlation of 10000 pairs has deviation 0.01: 4 of these
        assert!(product((0, 0), (1, 0)).abs() < 0.04);
        assert!(product((0, 0), (0, 1)).abs() < 0.04);
        assert!((product((0, 0), (0, 0)) - 1.0).abs() < 0.04);
    }
}
