//! Spikes: pulses that no mark makes.
//!
//! ```text
//!            ┌──────┐                         ┌─────┐
//!       │    │      │   a sample or two       │     │      a mark as quick as that would have had neighbours as quick
//! ──────┘────┘      └─────────────────────────┘     └──
//! ```
//! A shaft that turns passes neighbouring marks at nearly one speed, and from rest or to rest its pulses narrow or widen one way:
//! none is many times as narrow as what comes before it and as what comes after it.
//!
//! **Does not model**: spikes beside pulses that are narrow themselves; what they do to the count is seen there ([`super::number`]).

use super::flip::Flip;

/// How many times as wide as a spike the pulses beside it are.
const TIMES: usize = 4;
/// Least width of those, samples.
const WIDE: usize = 8;
/// Pulses to each side among which one is looked for: spikes may come in a row.
const BESIDE: usize = 16;
/// Largest part of the pulses that are spikes: more are marks of their own kind, as a thin one that marks the turn.
const SELDOM: f64 = 0.01;
/// Spikes that are always seldom.
const FEW: usize = 3;

/// What stands to one side of a pulse.
#[derive(Clone, Copy, PartialEq)]
enum Beside {
    Wide,
    Narrow,
    /// The record begins or ends before anything wide.
    Nothing,
}

/// The changes of level without those of spikes; how many spikes there were, and the sample of the first one.
pub(super) fn without(flips: Vec<Flip>) -> (Vec<Flip>, Option<(usize, usize)>) {
    // Width of what begins with a change of level; none where it does not end with one.
    let width = |k: usize| {
        let (begin, end) = (flips.get(k)?, flips.get(k + 1)?);
        (begin.rises != end.rises).then(|| end.sample - begin.sample)
    };
    let beside = |k: usize, own: usize, ahead: bool| {
        for away in 1..=BESIDE {
            let next = if ahead {
                Some(k + 2 * away)
            } else {
                k.checked_sub(2 * away)
            };
            match next.and_then(width) {
                Some(other) if other >= WIDE.max(TIMES * own) => return Beside::Wide,
                Some(_) => {}
                None => return Beside::Nothing,
            }
        }
        Beside::Narrow
    };
    let spike = |k: usize| {
        width(k).is_some_and(|own| {
            let sides = [beside(k, own, false), beside(k, own, true)];
            sides.contains(&Beside::Wide) && !sides.contains(&Beside::Narrow)
        })
    };
    let narrow: Vec<usize> = (0..flips.len()).filter(|&k| spike(k)).collect();
    // What a spike cuts off is narrow too: of two side by side the narrower one is the spike.
    let cut_off = |k: usize| {
        let narrower = |other: usize| {
            narrow.binary_search(&other).is_ok() && (width(other), other) < (width(k), k)
        };
        k > 0 && narrower(k - 1) || narrower(k + 1)
    };
    let spikes: Vec<usize> = narrow.iter().copied().filter(|&k| !cut_off(k)).collect();
    let most = (SELDOM * flips.len() as f64 / 2.0) as usize;
    let Some(&first) = spikes.first().filter(|_| spikes.len() <= most.max(FEW)) else {
        return (flips, None);
    };
    let (count, sample) = (spikes.len(), flips[first].sample);
    let of_spike = |k: usize| {
        let begins = |k: usize| spikes.binary_search(&k).is_ok();
        begins(k) || k > 0 && begins(k - 1)
    };
    let kept = flips.into_iter().enumerate();
    let kept = kept.filter(|(k, _)| !of_spike(*k)).map(|(_, flip)| flip);
    (kept.collect(), Some((count, sample)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flips(samples: &[usize]) -> Vec<Flip> {
        let flip = |(k, &sample): (usize, &usize)| Flip {
            sample,
            rises: k % 2 == 0,
        };
        samples.iter().enumerate().map(flip).collect()
    }

    fn left(samples: &[usize]) -> Vec<usize> {
        without(flips(samples)).0.iter().map(|f| f.sample).collect()
    }

    /// Marks so far apart, in samples, with pulses half as wide.
    fn marks(from: usize, apart: &[usize]) -> Vec<usize> {
        let begin = apart.iter().scan(from, |place, &apart| {
            let here = *place;
            *place += apart;
            Some([here, here + apart / 2])
        });
        begin.flatten().collect()
    }

    #[test]
    fn spikes_before_the_first_mark_and_one_within_a_pause_are_left_out() {
        // A start from rest: the first interval is the longest.
        let apart: Vec<usize> = (1..40).map(|k| 12 + 120 / k).collect();
        let start = marks(300, &apart);
        assert_eq!(left(&start), start);
        for spikes in [&[100, 101][..], &[50, 54, 100, 101, 170, 173]] {
            let all: Vec<usize> = spikes.iter().chain(&start).copied().collect();
            assert_eq!(left(&all), start);
        }
        let mut within = start.clone();
        within.splice(4..4, [start[3] + 5, start[3] + 6]);
        assert_eq!(left(&within), start);
    }

    #[test]
    fn a_dip_within_a_pulse_is_left_out() {
        let even = marks(300, &[40; 50]);
        let mut all = even.clone();
        all.splice(41..41, [even[40] + 9, even[40] + 11]);
        assert_eq!(left(&all), even);
    }

    #[test]
    fn pulses_as_narrow_as_those_behind_them_are_marks() {
        // From 60 samples a mark to four within a few marks, and back.
        let quick: Vec<usize> = [60, 30, 12, 6].into_iter().chain([4; 60]).collect();
        let up = marks(300, &quick);
        assert_eq!(left(&up), up);
        let slow: Vec<usize> = quick.iter().rev().copied().collect();
        let down = marks(300, &slow);
        assert_eq!(left(&down), down);
        let thin: Vec<usize> = (0..100)
            .flat_map(|k| [50 * k, 50 * k + if k % 10 == 0 { 2 } else { 20 }])
            .collect();
        assert_eq!(left(&thin), thin);
    }
}
