//! How many marks passed while the pickup was silent, and whether that is sure.
//!
//! ```text
//! each side    n(t) = c₀ + c₁ x + c₂ x²,   by least squares through the marks beside the gap  →  rate r, its slope s at the edge
//! over the gap n = T (r₁ + r₂)/2 + T² (s₁ - s₂)/12        (the rate as the cubic through both edges)
//! variance     of the two fits + (s₁ - s₂)² T⁴/720 + (r₂ - r₁ - T (s₁ + s₂)/2)² T²/12
//! ```
//! The last two terms are what the motion may have done unseen: a slope that jumps once, and a step of the rate that the slopes
//! do not explain, each at any instant of the gap with the same probability. The first has the cubic as its mean and, with the
//! jump after a part x, the error `(s₁ - s₂) T² (x (1 - x)/2 - 1/12)`, whose variance is `1/120 - 1/144 = 1/720`; the second is
//! off by the step times `T (x - ½)`.
//!
//! Source: derived here.
//!
//! **Does not model**: a shaft that brakes and speeds up again in the gap, so that both edges look as if nothing had been.

use statistics::linear::inverse;

/// Marks that did not come, in an interval between two that did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Last instant before and first one after it, s.
    pub from: f64,
    /// First instant after it, s.
    pub to: f64,
    /// Number of the first pulse after it.
    pub pulse: usize,
    /// Positions from the last pulse before to the first one after, as counted.
    pub positions: i64,
    /// Standard deviation of that count before it is rounded; infinite where a side is too short to count.
    pub deviation: f64,
    /// Whether no other count is likely.
    pub sure: bool,
}

/// Positions over an interval from which on it is a gap of its own, and not a mark or some that failed.
pub(super) const LONG: i64 = 6;

/// Deviations of the count that must lie with one whole number: what is beyond has a probability of 5e-4.
const BAND: f64 = 3.5;

/// Fewest and most marks on one side of a gap that give the rate there.
const FEWEST: usize = 8;
const MOST: usize = 512;

/// What one side of a gap gives at its edge.
#[derive(Clone, Copy, Debug)]
struct Side {
    /// Mark, its rate and the slope of that, at the edge; the mark from the one that passed there.
    value: [f64; 3],
    covariance: [[f64; 3]; 3],
}

/// Count over a gap with its standard deviation, from instants on both sides: each with its mark counted from the edge, in order
/// away from the edge, s; `noise` is the standard uncertainty of an instant, s.
pub(super) fn count(left: &[(f64, f64)], right: &[(f64, f64)], noise: f64) -> Option<(f64, f64)> {
    let length = right.first()?.0 - left.first()?.0;
    let (a, b) = (side(left, length, noise)?, side(right, length, noise)?);
    Some(over(&a, &b, length))
}

/// Whether a count is the only likely one.
pub(super) fn is_sure(mean: f64, deviation: f64, count: i64) -> bool {
    (mean - count as f64).abs() + BAND * deviation < 0.5
}

fn over(a: &Side, b: &Side, length: f64) -> (f64, f64) {
    let before = [1.0, 0.5 * length, length * length / 12.0];
    let after = [-1.0, 0.5 * length, -length * length / 12.0];
    let mean: f64 = (0..3)
        .map(|i| before[i] * a.value[i] + after[i] * b.value[i])
        .sum();
    let fits = quadratic(&a.covariance, &before) + quadratic(&b.covariance, &after);
    let bend = (a.value[2] - b.value[2]) * length * length;
    let step = (b.value[1] - a.value[1] - 0.5 * length * (a.value[2] + b.value[2])) * length;
    (
        mean,
        (fits + bend * bend / 720.0 + step * step / 12.0).sqrt(),
    )
}

fn quadratic(covariance: &[[f64; 3]; 3], row: &[f64; 3]) -> f64 {
    let lines = covariance.iter().zip(row);
    lines
        .map(|(line, a)| a * line.iter().zip(row).map(|(c, b)| c * b).sum::<f64>())
        .sum::<f64>()
        .max(0.0)
}

/// The fit over as many marks as give the count best: the noise falls with their number, and what a parabola does not follow
/// rises. The latter is what a cubic says otherwise.
fn side(marks: &[(f64, f64)], length: f64, noise: f64) -> Option<Side> {
    let weights = [1.0, 0.5 * length, length * length / 12.0];
    let mut best: Option<(f64, Side)> = None;
    let mut size = FEWEST;
    loop {
        let own = &marks[..size.min(marks.len())];
        if own.len() < FEWEST {
            break;
        }
        if let Some(side) = fitted(own, noise, &weights) {
            let variance = quadratic(&side.covariance, &weights);
            if best.as_ref().is_none_or(|best| variance < best.0) {
                best = Some((variance, side));
            }
        }
        if size >= marks.len().min(MOST) {
            break;
        }
        size = size * 3 / 2;
    }
    best.map(|best| best.1)
}

fn fitted(marks: &[(f64, f64)], noise: f64, weights: &[f64; 3]) -> Option<Side> {
    let edge = marks[0].0;
    let reach = marks[marks.len() - 1].0 - edge;
    let points: Vec<(f64, f64)> = marks.iter().map(|m| ((m.0 - edge) / reach, m.1)).collect();
    // The passage at the edge itself may be that of a pickup that failed or came back.
    let (three, spread) = polynomial::<3>(&points[1..])?;
    let (four, _) = polynomial::<4>(&points[1..])?;
    let away: Vec<f64> = points[1..]
        .iter()
        .map(|&(x, n)| n - (three[0] + x * (three[1] + x * three[2])))
        .collect();
    let count = away.len() as f64;
    let square = away.iter().map(|e| e * e).sum::<f64>() / (count - 3.0);
    // Errors that last over many marks, as those of an eccentric wheel, count as few: signs that change at every second mark
    // are those of white noise.
    let turns = away.windows(2).filter(|e| e[0] * e[1] < 0.0).count();
    let lasting = (0.5 * count / (turns as f64 + 1.0)).max(1.0);
    let stated = noise * three[1].abs() / reach.abs();
    let variance = lasting * square.max(stated * stated);
    let scale = [1.0, reach.recip(), 2.0 / (reach * reach)];
    let value: [f64; 3] = std::array::from_fn(|i| three[i] * scale[i]);
    let mut covariance: [[f64; 3]; 3] = std::array::from_fn(|i| {
        std::array::from_fn(|j| variance * spread[i][j] * scale[i] * scale[j])
    });
    let bend: f64 = (0..3)
        .map(|i| weights[i] * (four[i] - three[i]) * scale[i])
        .sum();
    covariance[0][0] += bend * bend;
    Some(Side { value, covariance })
}

/// Coefficients of a polynomial by least squares, and the inverse of its normal matrix.
#[allow(clippy::needless_range_loop)] // rows and columns by number read like the formula
fn polynomial<const N: usize>(points: &[(f64, f64)]) -> Option<([f64; N], [[f64; N]; N])> {
    let (mut square, mut right) = ([[0.0; N]; N], [0.0; N]);
    for &(x, y) in points {
        let powers: [f64; N] = std::array::from_fn(|i| x.powi(i as i32));
        for i in 0..N {
            right[i] += powers[i] * y;
            for j in 0..N {
                square[i][j] += powers[i] * powers[j];
            }
        }
    }
    let square = inverse(square, 1e-13)?;
    let found: [f64; N] =
        std::array::from_fn(|i| (0..N).map(|j| square[i][j] * right[j]).sum::<f64>());
    found
        .iter()
        .all(|x| x.is_finite())
        .then_some((found, square))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rate and slope that are known exactly.
    fn exact(rate: f64, slope: f64) -> Side {
        Side {
            value: [0.0, rate, slope],
            covariance: [[0.0; 3]; 3],
        }
    }

    #[test]
    fn a_motion_that_turns_somewhere_in_the_gap_has_the_deviation_that_is_derived() {
        // An even rate that falls from anywhere in a gap of 0.2 s on: mean and variance over that place.
        let (length, slope) = (0.2, -400.0);
        let (mut first, mut second, places) = (0.0, 0.0, 2000);
        for k in 0..places {
            let left = length * (k as f64 + 0.5) / places as f64;
            let end = 1400.0 + slope * left;
            let truth = 1400.0 * length + 0.5 * slope * left * left;
            let (mean, deviation) = over(&exact(1400.0, 0.0), &exact(end, slope), length);
            assert!((truth - mean).abs() < 3.0 * deviation);
            // What the cubic does not know: its own slopes say the step.
            first += truth - mean;
            second += (truth - mean).powi(2) / deviation.powi(2);
        }
        assert!((first / places as f64).abs() < 0.02 * 400.0 * 0.04 / 12.0);
        assert!(second / (places as f64) < 1.0, "{second}");
        // Evenly changing rates leave nothing open.
        let (mean, deviation) = over(&exact(1400.0, -400.0), &exact(1320.0, -400.0), length);
        assert!((mean - 272.0).abs() < 1e-9 && deviation < 1e-9);
    }
}
