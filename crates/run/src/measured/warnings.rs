//! What a comparison with measured channels does not show.

use super::{Curve, Run, features, first_contact};
use outcome::{Judged, Verdict, Warning};
use problem::warning::Severity;
use std::f64::consts::PI;

/// Difference of orbit phases at the release from which on impacts differ by it, rad, and in standard uncertainties.
const APART: (f64, f64) = (PI / 18.0, 3.0);
/// A deviation that is given differs from the scatter before the release from this ratio on.
const OTHER: f64 = 2.0;
/// A sample that stands alone is no edge of a contact where it is so many times farther off than any of the prediction.
const FARTHER: f64 = 3.0;
/// Deviations of its noise that the prediction of a channel moves by at least, for its range to say something.
const MOVES: f64 = 8.0;
/// A range of measured values is another one from this ratio on.
const SIZE: f64 = 4.0;
/// A straight line explains a channel that differs from its prediction by this share of its range, where it leaves so much of the difference.
const DIFFERS: f64 = 0.02;
const LEAVES: f64 = 0.5;
/// Share of a run that is compared, at least.
const LEAST: f64 = 0.5;
/// Rows are coarser than the file from this ratio of intervals on.
const COARSER: f64 = 1.5;

problem::warnings! {
    /// Of measured channels beside predicted columns.
    pub enum MeasuredWarning {
        Coarse { part: text, interval: "s", rows: "s" } "AB2340" Note ("Channel of {part} is sampled every {:.3} ms, the run has a row every {:.3} ms: the prediction is straight between its rows. Choose run.output_interval as the interval of the file.", 1e3 * interval, 1e3 * rows);
        PhaseDiffers { part: text, measured: "rad", uncertainty: "rad", predicted: "rad" } "AB2341" Uncertain ("Orbit of {part} at the release: measured at {:.0}° ± {:.0}°, predicted at {:.0}°. The angle of the unbalance at the release is an input (rotor.unbalance_angle), and a clock that is off by the time of that angle (clock_offset) shows the same: impacts differ by either.", measured.to_degrees(), uncertainty.to_degrees().ceil(), predicted.to_degrees());
        PhaseUnknown "AB2342" Note ("The measured channels do not show the phase of the orbit at the release. Impacts after the first depend on the angle of the unbalance at the release, an input (rotor.unbalance_angle).");
        PartOfRun { part: text, from: "s", to: "s", end: "s" } "AB2343" Note ("File of {part} covers {from:.4} s to {to:.4} s of a run of {end:.4} s: compared there.");
        Gaps { part: text, gaps: "", from: "s", to: "s" } "AB2344" Uncertain ("Channel of {part} has gaps ({gaps:.0}), the first from {from:.4} s to {to:.4} s: nothing is compared there, and features are those before the first one.");
        OtherNoise { part: text, given: "of the column", found: "of the column" } "AB2346" Uncertain ("Channel of {part}: measured.deviation is {given:.2e}, and its values before the release scatter by {found:.2e} about mean and synchronous orbit. Misfit and uncertainties count by the first.");
        Alone { part: text, count: "", share: "1", at: "s" } "AB2347" Uncertain ("Channel of {part}: {count:.0} samples ({:.2} %) stand alone by more than 8 deviations of its noise, the first at {at:.4} s, and the prediction has no such ones: faults of the record, or motion that its interval does not resolve. They count in misfit, features and estimates as all others do.", 100.0 * share);
        Held { part: text, count: "", from: "s", to: "s", moves: "of the column" } "AB2349" Invalid ("Channel of {part} keeps its value from {from:.4} s to {to:.4} s ({count:.0} samples), where the prediction moves by {moves:.2e}: dead, stuck or at the end of its range. What is compared there is not the machine.");
        OtherSize { part: text, ratio: "1" } "AB2350" Invalid ("Channel of {part} covers {ratio:.2e} times the range of the prediction: its unit, its scale or the channel is another one, or the machine does not do what this run predicts.");
        Rescaled { part: text, slope: "1", offset: "of the column", left: "1" } "AB2351" Uncertain ("Channel of {part} is nearest to {slope:.3} times the prediction and {offset:.2e} beside it; that leaves {:.0} % of the difference. Its scale or its zero is another one, or an input of the run acts alike: misfit, features and estimates take it as it is.", 100.0 * left);
        Uncovered { part: text, share: "1", contact: "s" } "AB2352" Invalid ("File of {part} has values in {:.0} % of the run from its first contact on, predicted at {contact:.4} s: the impacts are not compared, whatever its misfit. A shorter run.duration ends the run with the file.", 100.0 * share);
        Backward { part: text } "AB2348" Invalid ("The orbit of {part} before the release turns against the rotor: x and y exchanged, or one of them of the wrong sign (scale = -1). Only between two critical speeds of unequal supports does unbalance make such an orbit. What is compared here is a mirrored motion.");
    }
}

pub(super) fn of(curves: &[Curve], run: &Run) -> Vec<Warning> {
    use MeasuredWarning::{
        Alone, Backward, Coarse, Gaps, Held, OtherNoise, OtherSize, PartOfRun, PhaseDiffers,
        PhaseUnknown, Rescaled, Uncovered,
    };
    let mut list: Vec<MeasuredWarning> = Vec::new();
    let time = run
        .outcome
        .column("time")
        .map_or(&[][..], |time| &time.values);
    let (Some(begin), Some(end)) = (time.first(), time.last()) else {
        return Vec::new();
    };
    let mean = |times: &[f64]| (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64;
    let contact = run.release + first_contact(run.outcome).unwrap_or(0.0);
    for (index, curve) in curves.iter().enumerate() {
        let part = || curve.name.clone();
        let (interval, [from, to]) = (mean(&curve.times), curve.span());
        let rows = if time.len() > 1 { mean(time) } else { interval };
        if rows > COARSER * interval {
            let part = part();
            list.push(Coarse {
                part,
                interval,
                rows,
            });
        }
        let mut gaps = curve.gaps(*begin, *end);
        if let Some([from, to]) = gaps.next() {
            list.push(Gaps {
                part: part(),
                gaps: 1.0 + gaps.count() as f64,
                from,
                to,
            });
        }
        let own = &run.all[index];
        if let (Some(given), Some(found), Some(_)) =
            (own.deviation(), own.before.scatter, &curve.given.deviation)
        {
            let ratio = given / found;
            if !(1.0 / OTHER..OTHER).contains(&ratio) {
                let part = part();
                list.push(OtherNoise { part, given, found });
            }
        }
        if let Some((count, first, moves)) = own.held() {
            let time = |row: usize| own.time[row] + run.release;
            let (part, count) = (part(), count as f64);
            let (from, to) = (time(first), time(first + count as usize - 1));
            list.push(Held {
                part,
                count,
                from,
                to,
                moves,
            });
        }
        let ([measured, predicted], noise) = (own.ranges(), MOVES * own.deviation().unwrap_or(0.0));
        let smaller = predicted > noise && measured < predicted / SIZE;
        // a unit that is a thousand times another one enlarges the noise as well
        let larger = predicted > 1e-3 * noise && measured - noise > SIZE * predicted;
        if smaller || larger {
            let (part, ratio) = (part(), measured / predicted);
            list.push(OtherSize { part, ratio });
        } else if let (Some([slope, offset, left]), Ok(differs)) = (own.line(), own.relative())
            // what falls is bounded by clearances; speeds and forces follow friction and damping
            && curve.unit == "m"
            && left < LEAVES
            && differs > DIFFERS
        {
            let part = part();
            list.push(Rescaled {
                part,
                slope,
                offset,
                left,
            });
        }
        let [alone, expected] = [&own.measured, &own.predicted].map(|values| own.alone(values));
        let farthest = |of: &[(usize, f64)]| of.iter().fold(0.0, |most: f64, own| most.max(own.1));
        let is_more =
            alone.len() > 2 * expected.len() || farthest(&alone) > FARTHER * farthest(&expected);
        if let (Some((first, _)), true) = (alone.first(), is_more) {
            list.push(Alone {
                part: part(),
                count: alone.len() as f64,
                share: alone.len() as f64 / own.time.len() as f64,
                at: own.time[*first] + run.release,
            });
        }
        let share = own.covered;
        if share < LEAST {
            list.push(Uncovered {
                part: part(),
                share,
                contact,
            });
        } else if from > begin + interval || to < end - interval {
            let (part, from, to, end) = (part(), from.max(*begin), to.min(*end), *end);
            list.push(PartOfRun {
                part,
                from,
                to,
                end,
            });
        }
    }
    let phases = features::phases(curves, run);
    if phases.is_empty() && ["drop", "machine"].contains(&run.outcome.system) {
        list.push(PhaseUnknown);
    }
    for (part, [measured, predicted], is_backward) in phases {
        if is_backward {
            list.push(Backward { part });
            continue;
        }
        let apart = measured.minus(predicted);
        if apart.value.abs() > APART.0.max(APART.1 * apart.deviation) {
            list.push(PhaseDiffers {
                part,
                measured: measured.value,
                uncertainty: measured.deviation,
                predicted: predicted.value,
            });
        }
    }
    list.into_iter().map(Warning::from).collect()
}

/// A comparison that is not one of the machine with its prediction holds no limit.
pub(crate) fn reserve(limits: &mut [Judged], warnings: &[Warning]) {
    let declared = MeasuredWarning::DECLARED.iter();
    let invalid = declared.filter(|own| own.severity == Severity::Invalid);
    let codes: Vec<&str> = invalid.map(|own| own.code).collect();
    let found = warnings.iter().find(|own| codes.contains(&own.code));
    let Some(found) = found else {
        return;
    };
    let compares = |own: &&mut Judged| {
        own.verdict == Verdict::Pass && own.limit.quantity.starts_with(super::MEASURED)
    };
    for judged in limits.iter_mut().filter(compares) {
        judged.verdict = Verdict::Undecided;
        judged.why = format!("{}: {}", found.code, found.text);
    }
}
