//! What members show of the share of all such runs: bounds by the binomial law.
//!
//! Sources: Clopper and Pearson, Biometrika 26 (1934) 404 (one-sided bounds); Wilson, J. Am. Stat. Assoc. 22 (1927) 209 (both from
//! memory)

/// Confidence with which a share of runs is judged, each bound by itself.
pub const CONFIDENCE: f64 = 0.95;
/// Most members that are counted for how many would decide.
pub const MOST_MEMBERS: usize = 100_000;
/// Normal number beyond which 2.5 % lie.
const TWO_SIDED: f64 = 1.959_963_984_540_054;

/// Both ends of the 95 % interval of a probability, where `count` of `members` independent runs show it.
///
/// Its coverage is about 95 % also for rare events; it is not below 95 % for each probability, as that of [`at_least_shown`] is.
///
/// Source: Wilson (1927)
pub fn wilson(count: usize, members: usize) -> [f64; 2] {
    if members == 0 {
        return [0.0, 1.0];
    }
    let (n, z) = (members as f64, TWO_SIDED);
    let p = count as f64 / n;
    let middle = p + z * z / (2.0 * n);
    let half = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
    let scale = 1.0 + z * z / n;
    // the ends of none and of all are exact
    match count {
        0 => [0.0, (middle + half) / scale],
        all if all == members => [(middle - half) / scale, 1.0],
        _ => [(middle - half) / scale, (middle + half) / scale],
    }
}

/// Members that count for something other than one that must show an event for its probability to be told.
pub const FEWEST: usize = 10;

/// Probability of an event and both ends of its 95 % interval, from members of which each counts for its weight (of mean 1) where it
/// shows the event and for nothing where it does not. None where fewer than [`FEWEST`] show it.
///
/// ```text
///   p = Σ w/n,   s² = Σ (w - p)²/(n (n - 1)),   p e^(±1.96 s/p)        the logarithm of p scatters evenly
/// ```
pub fn weighted(shown: &[f64]) -> Option<(f64, [f64; 2])> {
    let n = shown.len() as f64;
    if shown.iter().filter(|weight| **weight > 0.0).count() < FEWEST {
        return None;
    }
    let p = shown.iter().sum::<f64>() / n;
    let squares: f64 = shown.iter().map(|weight| (weight - p).powi(2)).sum();
    let spread = (squares / (n * (n - 1.0))).sqrt();
    let factor = (TWO_SIDED * spread / p).exp();
    Some((p.min(1.0), [p / factor, (p * factor).min(1.0)]))
}

/// Whether so many that hold show that the share of all is reached.
pub fn shows_reached(share: f64, hold: usize, members: usize) -> bool {
    chance_of_as_many(share, hold, members) <= 1.0 - CONFIDENCE
}

/// Whether so few that hold show that the share of all is missed.
pub fn shows_missed(share: f64, hold: usize, members: usize) -> bool {
    chance_of_as_many(1.0 - share, members - hold, members) <= 1.0 - CONFIDENCE
}

/// Least share of all runs that so many of the members show.
pub fn at_least_shown(hold: usize, members: usize) -> f64 {
    if hold == 0 {
        return 0.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        match shows_reached(middle, hold, members) {
            true => low = middle,
            false => high = middle,
        }
    }
    low
}

/// Largest share of all runs that so many of the members allow.
pub fn at_most_shown(hold: usize, members: usize) -> f64 {
    1.0 - at_least_shown(members - hold, members)
}

/// How many more members would decide if the same share of them held; none if too many.
pub fn more_members(share: f64, hold: usize, members: usize) -> Option<usize> {
    let decided = |count: usize| {
        let held = (hold as f64 / members as f64 * count as f64).round() as usize;
        shows_reached(share, held, count) || shows_missed(share, held, count)
    };
    let (mut low, mut high) = (members, 2 * members.max(1));
    while !decided(high) {
        (low, high) = (high, 2 * high);
        if low > MOST_MEMBERS {
            return None;
        }
    }
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        match decided(middle) {
            true => high = middle,
            false => low = middle,
        }
    }
    Some(high - members)
}

/// Probability that of `members` independent runs `hold` or more hold where each does with probability `share`.
fn chance_of_as_many(share: f64, hold: usize, members: usize) -> f64 {
    if hold == 0 || share >= 1.0 {
        return 1.0;
    }
    if share <= 0.0 {
        return 0.0;
    }
    // ln of the terms of the binomial law: their products leave the range of a number
    let odds = (share / (1.0 - share)).ln();
    let mut term = members as f64 * (1.0 - share).ln();
    let mut sum = 0.0;
    for k in 0..=members {
        if k >= hold {
            sum += term.exp();
        }
        term += ((members - k) as f64 / (k + 1) as f64).ln() + odds;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bounds_are_those_of_tables() {
        // Clopper and Pearson, one-sided 95 %: 0.05^(1/n) where all hold
        for members in [1, 10, 59, 300] {
            let shown = at_least_shown(members, members);
            assert!((shown - 0.05_f64.powf(1.0 / members as f64)).abs() < 1e-12);
            assert_eq!(at_most_shown(members, members), 1.0);
        }
        // the beta quantiles of 8 of 10 (R: qbeta(0.05, 8, 3), qbeta(0.95, 9, 2)): 0.4930987, 0.9632286
        assert!((at_least_shown(8, 10) - 0.493_098_7).abs() < 1e-6);
        assert!((at_most_shown(8, 10) - 0.963_228_6).abs() < 1e-6);
        // a sum of thousands of terms is still a probability
        assert!((chance_of_as_many(0.5, 1, 50_000) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn what_would_decide_decides() {
        let more = more_members(0.9, 28, 30).unwrap();
        let members = 30 + more;
        let hold = (28.0 / 30.0 * members as f64).round() as usize;
        assert!(shows_reached(0.9, hold, members));
        assert_eq!(more_members(0.9, 9 * MOST_MEMBERS / 10, MOST_MEMBERS), None);
    }

    /// The interval holds the probabilities p with |count/n - p| <= z √(p (1 - p)/n): its ends are equal to it.
    #[test]
    fn wilson_inverts_the_normal_test() {
        for (count, members) in [(3, 40), (0, 25), (25, 25), (5, 5000)] {
            let n = members as f64;
            for end in wilson(count, members)
                .into_iter()
                .filter(|p| *p > 1e-12 && *p < 1.0 - 1e-12)
            {
                let distance = (count as f64 / n - end).abs();
                assert!((distance - TWO_SIDED * (end * (1.0 - end) / n).sqrt()).abs() < 1e-12);
            }
        }
        assert_eq!(wilson(0, 0), [0.0, 1.0]);
    }
}
