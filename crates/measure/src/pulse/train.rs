//! Which mark passed at which edge.

use super::gap::{LONG, count as count_over, is_sure};
use super::undersampled::undersampled;
use super::wheel::Wheel;
use super::{Edges, Flank, Gap, Refusal};
use crate::quantile::median;
use problem::{note, note::Note};
use statistics::normal::MEDIAN_OF_SIZE;

/// Passages with the number of the mark that passed.
#[derive(Clone, Debug, PartialEq)]
pub struct Pulses {
    /// Instants, s, increasing.
    pub times: Vec<f64>,
    /// Standard uncertainty of each instant, s.
    pub uncertainties: Vec<f64>,
    /// Positions passed since the first pulse; positions per revolution are [`Pulses::positions`].
    pub marks: Vec<i64>,
    /// Positions per revolution: the marks of the wheel, or twice as many where both flanks are used.
    pub positions: usize,
    /// Position, from 0 to below [`Pulses::positions`], of the first mark after the left-out ones, where the wheel has some.
    pub reference: Option<usize>,
    /// First and last instant that the pickup was watched, s.
    pub watched: (f64, f64),
    /// Interval of the samples that the instants were found in, s; none where they were stamped.
    pub sample_interval: Option<f64>,
    /// Intervals in which the pickup was silent though the shaft turned, in order.
    pub gaps: Vec<Gap>,
    /// As [`Edges::unseen`].
    pub unseen: f64,
    /// Pulses that were left out or had to be assumed, as a part of all.
    pub repaired: f64,
    /// What was found wrong, and what was done about it.
    pub notes: Vec<Note>,
}

impl Pulses {
    /// Nominal angle between neighbouring positions, rad.
    pub fn pitch(&self) -> f64 {
        std::f64::consts::TAU / self.positions as f64
    }

    /// The longest row of pulses whose marks are surely counted from each other.
    pub(crate) fn joined(&self) -> std::ops::Range<usize> {
        let unsure = self.gaps.iter().filter(|gap| !gap.sure);
        let mut ends: Vec<usize> = unsure.map(|gap| gap.pulse).collect();
        ends.push(self.times.len());
        let mut longest = 0..0;
        let mut begin = 0;
        for end in ends {
            if end - begin > longest.len() {
                longest = begin..end;
            }
            begin = end;
        }
        longest
    }

    /// Position on the wheel of a pulse, 0 to below [`Pulses::positions`].
    pub fn position(&self, pulse: usize) -> usize {
        self.marks[pulse].rem_euclid(self.positions as i64) as usize
    }
}

/// Numbers the marks.
///
/// An interval much longer than both its neighbours holds marks that gave no pulse: the count goes on as if they had. Six
/// and more, or a stretch without signal, are a gap of their own ([`Gap`]): the speeds on both sides say how many they were,
/// and where they leave more than one number the gap says that the count is not sure. A
/// pulse that splits an interval in two much shorter than the neighbours is left out, and so is one that comes much too
/// early or too late. Each leaves a note. From rest on,
/// intervals shrink steadily; this alone is never taken for a fault.
pub fn number(edges: &Edges, wheel: &Wheel) -> Result<Pulses, Refusal> {
    if wheel.marks == 0 || wheel.marks > 100_000 || wheel.missing >= wheel.marks {
        return Err(Refusal::new(
            format!(
                "a wheel with {} marks, {} of them left out",
                wheel.marks, wheel.missing
            ),
            "at least one mark per revolution",
        ));
    }
    if edges.times.len() != edges.uncertainties.len() || edges.times.len() != edges.rises.len() {
        return Err(Refusal::new(
            format!(
                "{} times and {} uncertainties",
                edges.times.len(),
                edges.uncertainties.len()
            ),
            "one uncertainty and one direction for each time",
        ));
    }
    if let Some(at) = edges
        .times
        .windows(2)
        .position(|pair| pair[1] <= pair[0] || !(pair[1] - pair[0]).is_finite())
    {
        return Err(Refusal::new(
            format!(
                "time {} s follows {} s",
                edges.times[at + 1],
                edges.times[at]
            ),
            "times that increase",
        ));
    }
    if let Some(bad) = edges
        .uncertainties
        .iter()
        .find(|u| !(u.is_finite() && **u > 0.0))
    {
        return Err(Refusal::new(
            format!("an uncertainty of {bad} s"),
            "positive uncertainties",
        ));
    }
    let mut notes = edges.notes.clone();
    let both = edges.flank == Flank::Both;
    // With both flanks the rising ones are numbered, and the falling ones lie between them.
    let rises = |k: usize| edges.rises[k];
    let main: Vec<usize> = (0..edges.times.len())
        .filter(|&k| !both || rises(k))
        .collect();
    if let Some(refusal) = undersampled(&main, edges, wheel) {
        return Err(refusal);
    }
    let (kept, extra) = without_doubles(&main, &edges.times);
    if let Some(&first) = extra.first() {
        notes.push(note!(
            "{} pulses too many, the first at {:.6} s: left out",
            extra.len(),
            edges.times[first]
        ));
    }
    if let Some((stop, start)) = rest(&kept, &edges.times) {
        return Err(Refusal::new(
            format!(
                "the shaft comes to rest after {stop:.4} s and starts again before {start:.4} s"
            ),
            "a part of the record with one start from rest: give where it begins or ends (from, to)",
        ));
    }
    let kept = without_last(without_broken(kept, edges, wheel), edges);
    let mut steps = steps(&kept, &edges.times);
    let silent = silent(&kept, edges, &mut steps, wheel);
    notes.extend(silent.iter().map(in_words));
    let mut count = 0i64;
    let mut counts = vec![0i64];
    let (mut lost, mut repairs, mut first_lost) = (0usize, 0usize, None);
    let mut references = Vec::new();
    for (k, &step) in steps.iter().enumerate() {
        count += step;
        counts.push(count);
        if wheel.missing > 0 && step == wheel.missing as i64 + 1 {
            references.push(count);
        } else if step > 1 {
            let own = silent.iter().any(|gap| gap.pulse == k + 1);
            repairs += (step - 1) as usize;
            if own {
                continue;
            }
            lost += (step - 1) as usize;
            first_lost.get_or_insert(edges.times[kept[k]]);
        }
    }
    let reference = reference(&references, wheel, &mut notes);
    if let Some(time) = first_lost {
        notes.push(note!(
            "{} pulses missing, the first after {:.6} s: counted as if they had come",
            lost,
            time
        ));
    }
    if edges.unseen > HIDDEN {
        notes.push(note!(
            "the first pulse, at {:.6} s, is only {:.1} times as high as what the noise hides: marks may have passed unseen before it",
            edges.times[kept[0]], edges.unseen.recip()
        ));
    }
    let repaired = (repairs + extra.len()) as f64 / edges.times.len().max(1) as f64;
    if repaired > 0.05 {
        notes.push(note!(
            "{:.0} % of the pulses had to be repaired: do not trust this channel",
            100.0 * repaired
        ));
    }
    let (which, marks) = if both {
        with_falling(&kept, &counts, &edges.rises)
    } else {
        (kept, counts)
    };
    let (which, marks) = without_strays(which, marks, edges, &silent, &mut notes);
    let place = |time: f64| which.partition_point(|&k| edges.times[k] < time);
    let gaps = silent
        .into_iter()
        .map(|gap| Gap {
            pulse: place(gap.to),
            positions: gap.positions * if both { 2 } else { 1 },
            deviation: gap.deviation * if both { 2.0 } else { 1.0 },
            ..gap
        })
        .filter(|gap| gap.pulse > 0 && gap.pulse < which.len())
        .collect();
    Ok(Pulses {
        times: which.iter().map(|&k| edges.times[k]).collect(),
        uncertainties: which.iter().map(|&k| edges.uncertainties[k]).collect(),
        positions: wheel.marks * if both { 2 } else { 1 },
        reference: reference.map(|r| if both { 2 * r } else { r }),
        marks,
        watched: edges.watched,
        sample_interval: edges.sample_interval,
        gaps,
        unseen: edges.unseen,
        repaired,
        notes,
    })
}

/// Height at which the noise hides a pulse over that of the first one, from which on it is reported.
const HIDDEN: f64 = 0.3;

/// Edges without those that split an interval; and those left out.
fn without_doubles(main: &[usize], times: &[f64]) -> (Vec<usize>, Vec<usize>) {
    let time = |k: usize| times[main[k]];
    // How far from regular the train would be without pulse k; none where k does not look like one too many.
    let excess = |k: usize| -> Option<f64> {
        if k < 2 || k + 2 >= main.len() {
            return None;
        }
        let (left, right) = (time(k - 1) - time(k - 2), time(k + 2) - time(k + 1));
        let (a, b) = (time(k) - time(k - 1), time(k + 1) - time(k));
        let usual = (left * right).sqrt();
        let whole = (a + b) / usual;
        let small = a.min(b) < 0.6 * left.min(right);
        (small && whole > 0.55 && whole < 1.6).then(|| whole.ln().abs())
    };
    let (mut kept, mut extra) = (Vec::with_capacity(main.len()), Vec::new());
    let mut k = 0;
    while k < main.len() {
        match (excess(k), excess(k + 1)) {
            (Some(this), next) if next.is_none_or(|next| this <= next) => extra.push(main[k]),
            (Some(_), Some(_)) => {
                kept.push(main[k]);
                extra.push(main[k + 1]);
                k += 1;
            }
            _ => kept.push(main[k]),
        }
        k += 1;
    }
    (kept, extra)
}

/// Pulses without those that lie far from where their neighbours say the mark was.
///
/// The neighbours' answer is a cubic through two on each side; far is a tenth of a pitch and eight standard deviations of
/// all pulses, so that neither a start from rest nor an uneven wheel is taken for a fault.
fn without_strays(
    which: Vec<usize>,
    marks: Vec<i64>,
    edges: &Edges,
    silent: &[Gap],
    notes: &mut Vec<Note>,
) -> (Vec<usize>, Vec<i64>) {
    let times = &edges.times;
    // Pulses on both sides of a gap say nothing of each other.
    let parted = |k: usize| {
        let (from, to) = (times[which[k - 2]], times[which[k + 2]]);
        silent.iter().any(|gap| gap.from < to && gap.to > from)
    };
    let away: Vec<f64> = (0..which.len())
        .map(|k| {
            if k < 2 || k + 2 >= which.len() || parted(k) {
                return 0.0;
            }
            let others = [k - 2, k - 1, k + 1, k + 2];
            let time = |j: usize| times[which[j]];
            let expected: f64 = others
                .iter()
                .map(|&j| {
                    let rest = others.iter().filter(|&&i| i != j);
                    let weight: f64 = rest
                        .map(|&i| (time(k) - time(i)) / (time(j) - time(i)))
                        .product();
                    weight * (marks[j] - marks[k]) as f64
                })
                .sum();
            expected.abs()
        })
        .collect();
    let usual = median(away.iter().copied()) / MEDIAN_OF_SIZE;
    let stray = |k: usize| {
        let near = &away[k.saturating_sub(2)..(k + 3).min(away.len())];
        away[k] > 0.1f64.max(8.0 * usual) && near.iter().all(|&other| other <= away[k])
    };
    let strays: Vec<usize> = (0..which.len()).filter(|&k| stray(k)).collect();
    let Some(&first) = strays.first() else {
        return (which, marks);
    };
    notes.push(note!(
        "{} pulses far from where their neighbours put the mark, the first at {:.6} s: left out",
        strays.len(),
        times[which[first]]
    ));
    let kept = |k: &usize| strays.binary_search(k).is_err();
    let indices: Vec<usize> = (0..which.len()).filter(kept).collect();
    (
        indices.iter().map(|&k| which[k]).collect(),
        indices.iter().map(|&k| marks[k]).collect(),
    )
}

/// The last pulse before a rest within the record and the first one after it, where there is one: a gap to which the shaft
/// slows down and from which it speeds up again, slower on both sides than it usually is. How often it turned there is not known.
fn rest(kept: &[usize], times: &[f64]) -> Option<(f64, f64)> {
    let gaps: Vec<f64> = kept
        .windows(2)
        .map(|pair| times[pair[1]] - times[pair[0]])
        .collect();
    let usual = median(gaps.iter().copied());
    let rests = |k: usize| {
        let [c, b, a] = [gaps[k - 3], gaps[k - 2], gaps[k - 1]];
        let [x, y, z] = [gaps[k + 1], gaps[k + 2], gaps[k + 3]];
        let slows = c < b && b < a && a > 5.0 * usual;
        let starts = x > y && y > z && x > 3.0 * usual;
        slows && starts && gaps[k] > 2.0 * a.max(x)
    };
    let k = (3..gaps.len().saturating_sub(3)).find(|&k| rests(k))?;
    Some((times[kept[k]], times[kept[k + 1]]))
}

/// Positions from each pulse to the next.
fn steps(kept: &[usize], times: &[f64]) -> Vec<i64> {
    let gaps: Vec<f64> = kept
        .windows(2)
        .map(|pair| times[pair[1]] - times[pair[0]])
        .collect();
    let mut steps = vec![1i64; gaps.len()];
    for k in 0..gaps.len() {
        // The interval per position on both sides; where the next interval is a gap itself, the one after it.
        let Some(left) = k.checked_sub(1).map(|l| gaps[l] / steps[l] as f64) else {
            continue;
        };
        let Some(&next) = gaps.get(k + 1) else {
            continue;
        };
        let right = gaps
            .get(k + 2)
            .map_or(next, |&after| if next > 1.6 * after { after } else { next });
        let ratio = gaps[k] / (left * right).sqrt();
        if ratio > 1.6 && gaps[k] > 1.5 * left.max(right) && ratio < 1e6 {
            steps[k] = ratio.round() as i64;
        }
    }
    steps
}

/// Pulses without the two beside a long silence: a pickup that fails or comes back within a pulse makes a flank of its own.
fn without_broken(kept: Vec<usize>, edges: &Edges, wheel: &Wheel) -> Vec<usize> {
    let steps = steps(&kept, &edges.times);
    let beside = |k: usize| {
        let long = |k: usize| {
            let step = steps.get(k).copied().unwrap_or(0);
            step >= LONG && step != wheel.missing as i64 + 1
        };
        k.checked_sub(1).is_some_and(long) || long(k)
    };
    // A pulse between two silences, or one of few, shows nothing but itself.
    let left: Vec<usize> = (0..kept.len()).filter(|&k| !beside(k)).collect();
    if left.len() < kept.len() / 2 {
        return kept;
    }
    left.into_iter().map(|k| kept[k]).collect()
}

/// Pulses without a last one that comes too early for an even train and is followed by silence: a pickup that sticks within a
/// pulse makes a flank of its own.
fn without_last(mut kept: Vec<usize>, edges: &Edges) -> Vec<usize> {
    if let [.., a, b, c, d] = kept[..] {
        let time = |k: usize| edges.times[k];
        let (before, usual, own) = (time(b) - time(a), time(c) - time(b), time(d) - time(c));
        let is_even = (before / usual - 1.0).abs() < 0.1;
        let is_silent = edges.watched.1 - time(d) > LONG as f64 * usual;
        if is_even && is_silent && own < 0.9 * usual {
            kept.pop();
        }
    }
    kept
}

/// Long silences and stretches without signal, with the positions that passed; `steps` follow them. The pulse of a gap is here
/// that of `kept`.
fn silent(kept: &[usize], edges: &Edges, steps: &mut [i64], wheel: &Wheel) -> Vec<Gap> {
    let time = |k: usize| edges.times[kept[k]];
    let unwatched = |k: usize| {
        let next = edges.unwatched.partition_point(|u| u.1 <= time(k));
        let usual = (k > 0).then(|| time(k) - time(k - 1));
        edges
            .unwatched
            .get(next)
            .is_some_and(|u| u.0 < time(k + 1) && usual.is_none_or(|usual| u.1 - u.0 > 0.5 * usual))
    };
    let reference = wheel.missing as i64 + 1;
    let is_gap: Vec<bool> = (0..steps.len())
        .map(|k| (steps[k] >= LONG && steps[k] != reference) || unwatched(k))
        .collect();
    let mut gaps = Vec::new();
    for k in (0..steps.len()).filter(|&k| is_gap[k]) {
        // Marks from the edge away, up to the next gap.
        let (mut left, mut right) = (vec![(time(k), 0.0)], vec![(time(k + 1), 0.0)]);
        for j in (0..k).rev().take_while(|&j| !is_gap[j]) {
            let mark = left[left.len() - 1].1 - steps[j] as f64;
            left.push((time(j), mark));
        }
        for j in (k + 1..steps.len()).take_while(|&j| !is_gap[j]) {
            let mark = right[right.len() - 1].1 + steps[j] as f64;
            right.push((time(j + 1), mark));
        }
        let noise = edges.uncertainties[kept[k]].max(edges.uncertainties[kept[k + 1]]);
        let found = count_over(&left, &right, noise).filter(|found| found.0.is_finite());
        let (mean, deviation) = found.unwrap_or((steps[k] as f64, f64::INFINITY));
        // Where the sides give nothing the two intervals beside it must do.
        if found.is_some_and(|found| found.1 < 0.5 * found.0.abs()) {
            steps[k] = (mean.round() as i64).max(1);
        }
        let sure = is_sure(mean, deviation, steps[k]);
        if steps[k] >= LONG || !sure {
            gaps.push(Gap {
                from: time(k),
                to: time(k + 1),
                pulse: k + 1,
                positions: steps[k],
                deviation,
                sure,
            });
        }
    }
    gaps
}

/// A gap in words.
fn in_words(gap: &Gap) -> Note {
    let Gap { from, to, .. } = gap;
    let passed = gap.positions - 1;
    match gap.sure {
        true => note!(
            "the pickup is silent from {:.6} s to {:.6} s: {} marks passed unseen, and what is given in between follows from both sides",
            from,
            to,
            passed
        ),
        false => note!(
            "the pickup is silent from {:.6} s to {:.6} s: about {} marks passed unseen, how many is not sure; angles before and after do not join",
            from,
            to,
            passed
        ),
    }
}

/// Position after the left-out marks, from the long intervals that look like them.
fn reference(found: &[i64], wheel: &Wheel, notes: &mut Vec<Note>) -> Option<usize> {
    if wheel.missing == 0 {
        return None;
    }
    let n = wheel.marks as i64;
    let mut tally = std::collections::BTreeMap::new();
    for count in found {
        *tally.entry(count.rem_euclid(n)).or_insert(0usize) += 1;
    }
    let best = tally.iter().max_by_key(|(_, times)| **times);
    match best {
        Some((&place, &times)) if 2 * times > found.len() => {
            if times < found.len() {
                notes.push(note!(
                    "{} of {} gaps of the length of the reference gap are elsewhere: pulses missing there",
                    found.len() - times, found.len()
                ));
            }
            Some(place as usize)
        }
        _ => {
            notes.push(note!(
                "the gap of {} left-out marks was not found",
                wheel.missing
            ));
            None
        }
    }
}

/// Adds the falling edges between neighbouring rising ones; positions are doubled.
fn with_falling(kept: &[usize], counts: &[i64], rises: &[bool]) -> (Vec<usize>, Vec<i64>) {
    let (mut which, mut marks) = (Vec::new(), Vec::new());
    if let (Some(&first), Some(&count)) = (kept.first(), counts.first())
        && first == 1
        && !rises[0]
    {
        which.push(0);
        marks.push(2 * count - 1);
    }
    for (k, (&edge, &count)) in kept.iter().zip(counts).enumerate() {
        which.push(edge);
        marks.push(2 * count);
        let regular = match kept.get(k + 1) {
            Some(&next) => next == edge + 2 && !rises[edge + 1] && counts[k + 1] == count + 1,
            None => rises.get(edge + 1) == Some(&false),
        };
        if regular {
            which.push(edge + 1);
            marks.push(2 * count + 1);
        }
    }
    (which, marks)
}
