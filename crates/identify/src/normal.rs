//! The normal distribution.

use std::f64::consts::TAU;

/// Probability that a normal number of mean 0 and deviation 1 is below z.
///
/// Source: Abramowitz and Stegun 26.2.17, error below 1e-7 (from memory).
pub(crate) fn below(z: f64) -> f64 {
    let t = 1.0 / (1.0 + 0.231_641_9 * z.abs());
    let series = t
        * (0.319_381_530
            + t * (-0.356_563_782
                + t * (1.781_477_937 + t * (-1.821_255_978 + t * 1.330_274_429))));
    let tail = density(z) * series;
    if z >= 0.0 { 1.0 - tail } else { tail }
}

/// Density of a normal number of mean 0 and deviation 1.
pub(crate) fn density(z: f64) -> f64 {
    (-0.5 * z * z).exp() / TAU.sqrt()
}

/// Probability that |x| is above a limit, x normal.
pub(crate) fn beyond(value: f64, deviation: f64, limit: f64) -> f64 {
    if deviation > 0.0 {
        below((value - limit) / deviation) + below((-limit - value) / deviation)
    } else if value.abs() > limit {
        1.0
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_quantiles() {
        // tables of the normal distribution
        for (z, p) in [
            (0.0, 0.5),
            (1.0, 0.841_344_746),
            (-1.959_964, 0.025),
            (3.0, 0.998_650_102),
        ] {
            assert!((below(z) - p).abs() < 1.5e-7, "{z}");
        }
        assert!((beyond(0.0, 1.0, 1.959_964) - 0.05).abs() < 3e-7);
        assert_eq!((beyond(2.0, 0.0, 1.0), beyond(-0.5, 0.0, 1.0)), (1.0, 0.0));
    }
}
