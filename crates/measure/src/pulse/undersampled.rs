//! Marks that come faster than samples can show them.
//!
//! ```text
//! marks at the rate m, samples at the rate s: shown are |m - k s|, at most s/2
//! ```
//! A mark that passes within less than two samples is shown as a slower one, and a shaft that slows down through m = s seems to
//! come to rest and to start again. What is shown reaches two samples a mark on the way there; a shaft whose marks were all seen
//! has more at its fastest.
//!
//! **Does not see**: marks that were too fast from the first sample to the last and never changed.

use super::{Edges, Refusal, Wheel};
use crate::quantile::median;
use std::f64::consts::TAU;

/// Samples a mark up to which marks are at the limit of the sampling. Wheels are uneven, and flanks hide between samples: three and
/// more can be read.
const LIMIT: f64 = 2.2;
/// Samples a mark below which two crossings are one mark in noise.
const ONE: f64 = 1.5;
/// Marks in a row at the limit, and those of them that may be off it.
const ROW: usize = 12;
const OFF: usize = 2;

/// Why the marks cannot be read, where they come as fast as two samples each.
///
/// - `marks`: the edges of marks, one a mark
pub(super) fn undersampled(marks: &[usize], edges: &Edges, wheel: &Wheel) -> Option<Refusal> {
    let interval = edges.sample_interval?;
    let gaps: Vec<f64> = (marks.windows(2))
        .map(|pair| (edges.times[pair[1]] - edges.times[pair[0]]) / interval)
        .collect();
    let at_limit = |row: &[f64]| {
        let off = row.iter().filter(|gap| !(ONE..=LIMIT + 0.8).contains(*gap));
        off.count() <= OFF && median(row.iter().copied()) < LIMIT
    };
    let first = gaps.windows(ROW).position(at_limit)?;
    let rate = 1.0 / interval;
    let limit = 0.5 * rate / wheel.marks as f64;
    Some(Refusal::new(
        format!(
            "at {:.4} s a mark passes every {:.2} samples, and faster ones would be shown as slower ones, to a stop that was none: {:.0} samples a second cannot hold {} marks above {:.0} rpm ({:.1} rad/s)",
            edges.times[marks[first]],
            median(gaps[first..first + ROW].iter().copied()),
            rate,
            wheel.marks,
            60.0 * limit,
            TAU * limit
        ),
        "four samples a mark at the largest speed, fewer marks, or a counter that stamps them (kind = \"edges\")",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pulse::{Flank, edges, number};

    /// A pickup at 60 marks of a shaft that slows down evenly from 150 rad/s in 10 s.
    fn refusal(rate: f64) -> Option<String> {
        let signal = |t: f64| {
            let angle = 150.0 * t - 7.5 * t * t;
            if (60.0 * angle).sin() > 0.0 { 5.0 } else { 0.0 }
        };
        let samples: Vec<f64> = (0..(9.5 * rate) as usize)
            .map(|k| signal(k as f64 / rate))
            .collect();
        let found = edges(0.0, 1.0 / rate, &samples, Flank::Rising).unwrap();
        let wheel = Wheel {
            marks: 60,
            missing: 0,
        };
        number(&found, &wheel)
            .err()
            .map(|refusal| refusal.to_string())
    }

    #[test]
    fn too_few_samples_are_no_stop() {
        // 1432 marks a second at first
        for rate in [500.0, 1000.0, 2000.0] {
            let why = refusal(rate).unwrap();
            assert!(why.contains("cannot hold 60 marks"), "{rate}: {why}");
        }
        // 500 samples a second hold 250 marks, 4.17 turns
        assert!(refusal(500.0).unwrap().contains("above 250 rpm"));
        assert_eq!(refusal(10_000.0), None);
        assert_eq!(refusal(5000.0), None);
    }
}
