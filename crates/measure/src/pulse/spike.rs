//! Spikes: pulses that no mark makes.
//!
//! ```text
//!            ┌──────┐                         ┌─────┐
//!       │    │      │   a sample or two       │     │      a mark as quick as that would have had neighbours as quick
//! ──────┘────┘      └─────────────────────────┘     └──
//! ```
//! A shaft that turns passes neighbouring marks at nearly one speed, so that their pulses are nearly as wide as each other.
//!
//! **Does not model**: spikes beside pulses that are narrow themselves; what they do to the count is seen there ([`super::number`]).

use super::edge::Flip;

/// Widest spike, samples.
const NARROW: usize = 2;
/// Spikes in a row at most: quick marks are as narrow.
const ROW: usize = 3;
/// Least width of the pulses beside it, samples.
const WIDE: usize = 8;
/// Largest part of the pulses that are spikes: more are marks of their own kind, as a thin one that tells the turn.
const SELDOM: f64 = 0.01;
/// Spikes that are always seldom.
const FEW: usize = 3;

/// The changes of level without those of spikes; how many spikes there were, and the sample of the first one.
pub(super) fn without(flips: Vec<Flip>) -> (Vec<Flip>, Option<(usize, usize)>) {
    // Width of what begins with a change of level; none where it does not end with one.
    let width = |k: usize| {
        let (begin, end) = (flips.get(k)?, flips.get(k + 1)?);
        (begin.rises != end.rises).then(|| end.sample - begin.sample)
    };
    // How many as narrow stand in a row to one side, and the width of what comes behind them, where the record goes on.
    let beside = |k: usize, ahead: bool| {
        let mut place = k;
        for narrow in 0..=ROW {
            let next = if ahead {
                Some(place + 2)
            } else {
                place.checked_sub(2)
            };
            match next.and_then(|next| Some((next, width(next)?))) {
                Some((next, own)) if own <= NARROW => place = next,
                Some((_, own)) => return (narrow, Some(own)),
                None => return (narrow, None),
            }
        }
        (ROW, None)
    };
    let spike = |k: usize| {
        let [left, right] = [beside(k, false), beside(k, true)];
        let known = || [left.1, right.1].into_iter().flatten();
        width(k).is_some_and(|own| own <= NARROW)
            && left.0 + 1 + right.0 <= ROW
            && known().count() > 0
            && known().all(|other| other >= WIDE)
    };
    let spikes: Vec<usize> = (0..flips.len()).filter(|&k| spike(k)).collect();
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

    #[test]
    fn a_spike_before_the_first_mark_and_one_within_a_pause_are_left_out() {
        assert_eq!(left(&[100, 101, 300, 320, 340, 358]), [300, 320, 340, 358]);
        assert_eq!(left(&[300, 320, 330, 331, 340, 358]), [300, 320, 340, 358]);
        let three = [50, 51, 100, 101, 170, 171, 300, 320, 340, 358];
        assert_eq!(left(&three), [300, 320, 340, 358]);
    }

    #[test]
    fn a_dip_within_a_pulse_is_left_out() {
        assert_eq!(left(&[300, 310, 312, 320, 340, 358]), [300, 320, 340, 358]);
    }

    #[test]
    fn pulses_as_narrow_as_their_neighbours_are_marks() {
        let quick = [300, 302, 305, 307, 310, 312];
        assert_eq!(left(&quick), quick);
        let quickly = [300, 320, 330, 332, 336, 338, 342, 344, 348, 350, 354, 356];
        assert_eq!(left(&quickly), quickly);
        let thin: Vec<usize> = (0..100)
            .flat_map(|k| [50 * k, 50 * k + if k % 10 == 0 { 2 } else { 20 }])
            .collect();
        assert_eq!(left(&thin), thin);
    }
}
