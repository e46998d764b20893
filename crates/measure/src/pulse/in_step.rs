//! Pulses in step with the sampling: their errors are one error.
//!
//! ```text
//! samples   |    |    |    |    |    |    |    |    |      a flank that lies between two samples may be anywhere there;
//! flanks      ┘    .    .    ┘    .    .    ┘              three samples a mark, and a little: each lies a little later
//! ```
//! Where a mark takes a whole number of samples, all but exactly, flank after flank hides between two samples, and each is off
//! by what the one before was off. The pulses then follow the clock of the sampler and not the shaft, and a mean of many is no
//! better than one. Of such a row some are kept, with deviations that let all of them together count as one.
//! Marks that take a whole number of samples two by two or three by three do the same.

use super::Pulses;

/// Smallest uncertainty of an instant that hides between two samples, in samples.
const HIDES: f64 = 0.03;
/// Samples a mark up to which a flank that a sample meets shares its error too: it lies where the shape learnt of it says, and the
/// error of that is the same wherever a sample meets it. Two by two the others meet it elsewhere, and in a short row soon.
const SHORT: f64 = 10.0;
/// Pulses of a row from which on it is long.
const LONG: usize = 64;
/// Least error of such a place, samples.
const SHAPE: f64 = 0.02;
/// Fewest pulses of a row. Where the shaft leaves the step sooner the errors have the mean of no error.
const ROW: usize = 8;
/// Pulses of a row for one that is kept: what the shaft does meanwhile is to be seen.
const EVERY: usize = 16;
/// Within which the places of a row lie between two samples, in samples: a flank that hides between them is nowhere else.
const WITHIN: f64 = 0.6;
/// Marks that may take a whole number of samples together. The errors of q marks in step are a q-th of those of one.
const MARKS: usize = 3;

impl Pulses {
    /// The pulses with few left of each row that is in step with the sampling, and the deviation that those of a row have besides
    /// their own, s; none where there is no such row.
    pub(crate) fn out_of_step(&self) -> Option<(Pulses, Vec<f64>)> {
        let interval = self.sample_interval?;
        let n = self.times.len();
        let mut kept = vec![true; n];
        let mut shared = vec![0.0; n];
        for together in 1..=MARKS {
            let mut seen = vec![false; n];
            for first in 0..n {
                if seen[first] {
                    continue;
                }
                let all = self.row(first, together, together == 1, interval, &kept);
                let row = match all.len() >= LONG {
                    true => all,
                    false => self.row(first, together, false, interval, &kept),
                };
                row.iter().for_each(|&k| seen[k] = true);
                if row.len() >= ROW {
                    row.iter().for_each(|&k| kept[k] = false);
                    let some = row.len().div_ceil(EVERY);
                    for part in 0..some {
                        let k = row[(2 * part + 1) * row.len() / (2 * some)];
                        kept[k] = true;
                        let own = self.uncertainties[k];
                        let all = own.max(SHAPE * interval) * (some as f64).sqrt();
                        shared[k] = (all * all - own * own).sqrt();
                    }
                }
            }
        }
        // What begins and ends the record says how long it rested.
        if let ([first, .., last], true) = (&mut kept[..], n > 1) {
            (*first, *last) = (true, true);
        }
        let left: Vec<usize> = (0..n).filter(|&k| kept[k]).collect();
        let shared = left.iter().map(|&k| shared[k]).collect();
        (left.len() < n).then(|| (self.only(&left), shared))
    }

    /// Pulses from one on that hide between samples in the same place, so many marks apart; also those that a sample meets.
    fn row(
        &self,
        first: usize,
        together: usize,
        also_met: bool,
        interval: f64,
        kept: &[bool],
    ) -> Vec<usize> {
        let step = |k: usize| {
            let next = (k + 1).min(kept.len() - 1).max(1);
            (self.times[next] - self.times[next - 1]) / interval
        };
        let met = |k: usize| also_met && step(k) < SHORT;
        let shares = |k: usize| self.uncertainties[k] > HIDES * interval || met(k);
        let hides = |k: usize| kept[k] && shares(k);
        let mut row = vec![first];
        if !hides(first) {
            return row;
        }
        let apart = |to: usize| (self.times[to] - self.times[first]) / interval;
        let beyond = first + (ROW - 1) * together;
        if beyond >= kept.len() {
            return row;
        }
        let whole = (apart(beyond) / (ROW - 1) as f64).round();
        let (mut low, mut high) = (0.0f64, 0.0f64);
        loop {
            let last = row[row.len() - 1];
            let next = last + together;
            if next >= kept.len()
                || !hides(next)
                || self.marks[next] - self.marks[last] != together as i64
            {
                return row;
            }
            let place = apart(next) - whole * row.len() as f64;
            (low, high) = (low.min(place), high.max(place));
            if high - low > WITHIN {
                return row;
            }
            row.push(next);
        }
    }

    /// Some of the pulses, in order.
    fn only(&self, left: &[usize]) -> Pulses {
        let gaps = self.gaps.iter().map(|gap| super::Gap {
            pulse: left.partition_point(|&k| k < gap.pulse),
            ..*gap
        });
        Pulses {
            times: left.iter().map(|&k| self.times[k]).collect(),
            uncertainties: left.iter().map(|&k| self.uncertainties[k]).collect(),
            marks: left.iter().map(|&k| self.marks[k]).collect(),
            gaps: gaps.collect(),
            ..self.clone()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Edges, Flank, Wheel, number};
    use super::*;

    /// Pulses that take so many samples, and hide between them by so much.
    fn train(count: usize, samples: f64, hidden: f64) -> Pulses {
        let interval = 1e-4;
        let times: Vec<f64> = (0..count).map(|k| k as f64 * samples * interval).collect();
        let edges = Edges {
            uncertainties: vec![hidden * interval; count],
            rises: vec![true; count],
            flank: Flank::Rising,
            watched: (0.0, times[count - 1]),
            sample_interval: Some(interval),
            unseen: 0.0,
            unwatched: Vec::new(),
            notes: Vec::new(),
            times,
        };
        let wheel = Wheel {
            marks: 60,
            missing: 0,
        };
        number(&edges, &wheel).unwrap()
    }

    #[test]
    fn a_row_in_step_counts_as_one_pulse() {
        let all = train(322, 4.0, 0.15);
        let (left, shared) = all.out_of_step().unwrap();
        // The first and the last stay, and one of sixteen between.
        let inner = 1..left.times.len() - 1;
        assert_eq!(inner.len(), 21);
        let weight: f64 = inner
            .map(|k| (0.15e-4 / left.uncertainties[k].hypot(shared[k])).powi(2))
            .sum();
        assert!((weight - 1.0).abs() < 1e-9, "{weight}");
        for (time, mark) in left.times.iter().zip(&left.marks) {
            assert!((time - *mark as f64 * 4e-4).abs() < 1e-12);
        }
    }

    #[test]
    fn two_by_two_is_in_step_too() {
        assert!(train(100, 4.5, 0.15).out_of_step().is_some());
    }

    #[test]
    fn pulses_that_a_sample_meets_or_that_pass_all_places_are_left_alone() {
        assert!(train(100, 12.0, 0.01).out_of_step().is_none());
        assert!(train(100, 4.4, 0.15).out_of_step().is_none());
        // In step for fewer than eight: 0.6 of a sample is passed in six.
        assert!(train(100, 4.1, 0.15).out_of_step().is_none());
    }
}
