//! Numbers that a seed and counters make: no state, so any of them can be computed without those before it.

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
