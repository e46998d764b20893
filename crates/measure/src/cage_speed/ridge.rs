//! Cage speed from a line in a vibration or proximity signal.
//!
//! The signal is turned back by the phase of a rolling cage; what remains of the line is a slow rotation. Its rate is found
//! coarsely as the best path of slip through short spectra over the travel of the line, taken out, and the rest of the phase is
//! smoothed.
//!
//! What else the same signal could be, and what is done about it:
//!
//! - another path through the spectra: where its chance is above 5 % the ridge has no value;
//! - a phase that lost a cycle in every cell of P periods: its slip is wrong by 1/P, which is further from the path than half of
//!   that: such values are left out, as is every slip outside the range that is looked for;
//! - a cycle lost or won once, which noise of the phase does: its chance is in the deviation, and reported where it counts;
//! - another line in the range, at an order of the shaft or beside the ridge: above half of the ridge's amplitude, more than a
//!   sideline by modulation can have, nothing shows which is the cage's, and both are refused; a weaker one is reported;
//! - a line of the shaft at the very order of the ridge, which looks the same: it is reported.
//!
//! A line above half of the sampling rate folds to where it is not; that is for the filter before the converter.

use super::CageSpeed;
use super::cells::{Cell, Signal};
use super::path::{APART, HOP, LENGTH, OVERLAPS, Path, RIVAL_HALF, Rival, followed, rival};
use super::phase::Deviations;
use crate::quantile::median;
use crate::shaft::Shaft;
use problem::{note, note::Note};
use std::f64::consts::{PI, TAU};

/// Where a line is expected.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// Speed of a rolling cage over that of the shaft, 1.
    pub ratio: f64,
    /// Cycles of the line in a turn of the cage: the number of balls, or a multiple.
    pub order: f64,
    /// Lowest slip that is looked for, 1; a little below 0 allows for a ratio that is not exact.
    pub lowest_slip: f64,
    /// Highest slip that is looked for, 1.
    pub highest_slip: f64,
    /// Time after which slip may change fast, s.
    pub engagement: Option<f64>,
}

/// Slip above which a line is too slow to be separated from the mean of the signal.
const NEAR_REST: f64 = 0.98;
/// Chance of another path above which the ridge has no value.
const DOUBT: f64 = 0.05;
/// Power of a line over that of noise in a spectrum below which it is lost.
const LOST: f64 = 4.0;
/// Spectra over which that is averaged, on either side.
const NEAR: usize = 4;
/// Periods of a cell in which the phase is read, and the power over noise in a spectrum that the shorter ones need: below it
/// the phase has a noise of more than 0.45 rad, of which one value in 7 million passes half a turn.
const PERIODS: [(f64, f64); 3] = [(4.0, 15.0), (8.0, 7.5), (16.0, 0.0)];
/// Share of the record that must be left.
const LEAST_SHARE: f64 = 0.2;
/// Amplitudes of another line over that of the ridge from which on it is refused, and reported.
const REFUSED: f64 = 0.5;
const REPORTED: f64 = 0.25;
/// Distance from the ridge from which on a line beside it is another, as a slip.
const BESIDE: f64 = 0.02;
/// Cells over which a cycle that is lost turns into slip.
const MEMORY: usize = 8;
/// How near a ridge is to an order of the shaft that could be it, as a slip.
const AT_ORDER: f64 = 1e-3;

/// Speed of a cage from a signal that holds a line near ball pass.
///
/// `signal` at equal `interval` from the time `first` on, s; NaN where there is none. Values are returned about one in four
/// periods of the line, of a weak line one in 8 or 16; they are NaN where the line is lost, may be another, or leaves the slips
/// that are looked for. Other lines near it (shaft orders) should be removed before. The error says why no cage speed is found.
pub fn from_vibration(
    first: f64,
    interval: f64,
    signal: &[f64],
    shaft: &Shaft,
    line: &Line,
) -> Result<CageSpeed, String> {
    shaft.check()?;
    refuse(interval, line)?;
    let turned = signal_of(first, interval, signal, shaft, line)?;
    let travel = turned.travel();
    let least = 2.0 * LENGTH;
    if travel < least {
        return Err(format!(
            "the signal is too short to follow a line: {travel:.0} periods of it are common to it and the shaft, {least:.0} are needed"
        ));
    }
    let slips = (line.lowest_slip, line.highest_slip.min(NEAR_REST));
    let middle = 0.5 * (slips.0 + slips.1);
    let coarse = turned.cells(HOP, OVERLAPS, |_| middle);
    let path =
        followed(&coarse, middle, slips).ok_or("the signal is too short to follow a line")?;
    let standing = standing(&path);
    let share = |kept: &dyn Fn(usize) -> bool| {
        let kept = (0..path.slip.len()).filter(|&k| kept(k)).count();
        kept as f64 / path.slip.len() as f64
    };
    let in_doubt = 1.0 - share(&|k| path.doubt[k] <= DOUBT);
    let lost = 1.0 - share(&|k| standing[k] >= LOST);
    let usable = |k: usize| path.doubt[k] <= DOUBT && standing[k] >= LOST;
    if share(&usable) < LEAST_SHARE {
        return Err(format!(
            "no line between the slips {:.3} and {:.3} stands out of the noise so that it can be followed: it is lost during {:.0} % of the record, and another path is as likely during {:.0} %",
            slips.0,
            slips.1,
            100.0 * lost,
            100.0 * in_doubt
        ));
    }
    let mut notes = Vec::new();
    if lost > 0.0 {
        notes.push(note!(
            "the line is lost in noise during {:.1} % of the record: there is no value there",
            100.0 * lost
        ));
    }
    if in_doubt > 0.0 {
        notes.push(note!(
            "another path of the line is as likely during {:.1} % of the record: there is no value there",
            100.0 * in_doubt
        ));
    }
    notes.extend(rivals(&turned, &path, usable, slips)?);
    // Fine: cells that do not overlap, so that white noise stays white.
    let mut known: Vec<f64> = (0..path.slip.len())
        .filter(|&k| usable(k))
        .map(|k| standing[k])
        .collect();
    known.sort_by(f64::total_cmp);
    let typical = known[known.len() / 3];
    let periods = PERIODS
        .iter()
        .find(|(_, needed)| typical >= *needed)
        .map_or(16.0, |(periods, _)| *periods);
    let fine = turned.cells(periods, 1, |t| path.smooth_at(t));
    let travel_of = |cell: usize| (cell as f64 + 0.5) * periods;
    let kept: Vec<usize> = (0..fine.len()).filter(|&k| fine[k].count > 0.0).collect();
    let time: Vec<f64> = kept.iter().map(|&k| fine[k].time).collect();
    let usable: Vec<bool> = kept
        .iter()
        .map(|&k| usable(path.nearest(travel_of(k))))
        .collect();
    let slip: Vec<f64> = kept.iter().map(|&k| path.slip_at(travel_of(k))).collect();
    // Against one slip, so that all that the slip does is seen by what smooths it.
    let steady = median(slip.iter().copied());
    let removed: Vec<f64> = time
        .iter()
        .map(|&t| -steady * line.ratio * shaft.speed_at(t))
        .collect();
    let seen: Vec<Cell> = kept.iter().map(|&k| fine[k]).collect();
    let sizes: Vec<f64> = kept
        .iter()
        .map(|&k| standing[path.nearest(travel_of(k))])
        .collect();
    let (turns, weight) = phases(&seen, &sizes, &usable);
    let mut gone = Gone {
        path: &path,
        steady,
        travel: 0.0,
        turned: 0.0,
    };
    let deviation: Vec<f64> = kept
        .iter()
        .zip(&turns)
        .map(|(&k, turn)| turned.direction() * TAU * (turn - gone.until(travel_of(k))) / line.order)
        .collect();
    let edge = 0.02 * (slips.1 - slips.0);
    let at_edge = slip
        .iter()
        .filter(|s| **s < slips.0 + edge || **s > slips.1 - edge)
        .count();
    if at_edge * 50 > slip.len() {
        notes.push(note!(
            "the line runs along the limit of the slip that is looked for"
        ));
    }
    let data = Deviations {
        time: &time,
        deviation: &deviation,
        weight: &weight,
        removed: &removed,
        engagement: line.engagement,
        lock: None,
        from_rest: false,
    };
    let mut found = data.smoothed(shaft, line.ratio, notes)?;
    let noise: Vec<f64> = weight
        .iter()
        .map(|weight| found.noise * line.order * weight.sqrt())
        .collect();
    let mean = found.noise * line.order;
    // At 0.45 rad one value in 7 million passes half a turn by noise alone; the model's own wander comes on top.
    if mean > 0.45 {
        found.notes.push(note!(
            "the line's phase has a noise of {:.2} rad: it may have lost or won whole cycles, whose chance is in the band",
            mean
        ));
    }
    with_lost_cycles(&mut found, &noise, periods);
    let cut = |k: usize| {
        let away = (found.slip[k] - slip[k]).abs();
        let outside = !(slips.0..=slips.1).contains(&found.slip[k]);
        (outside || away > APART.min(0.5 / periods), !usable[k])
    };
    let cuts: Vec<(bool, bool)> = (0..found.slip.len()).map(cut).collect();
    for (k, _) in cuts.iter().enumerate().filter(|(_, cut)| cut.0 || cut.1) {
        for list in [
            &mut found.speed,
            &mut found.deviation,
            &mut found.slip,
            &mut found.slip_deviation,
        ] {
            list[k] = f64::NAN;
        }
    }
    let left = cuts.iter().filter(|cut| cut.0 && !cut.1).count();
    if left > 0 {
        found.notes.push(note!(
            "the line leaves the slips from {:.3} to {:.3}, or its path, during {:.1} % of the time: there is no value there",
            slips.0, slips.1, 100.0 * left as f64 / cuts.len() as f64
        ));
    }
    let gone = cuts.iter().filter(|cut| cut.0 || cut.1).count();
    if ((cuts.len() - gone) as f64) < LEAST_SHARE * cuts.len() as f64 {
        return Err(format!(
            "the line cannot be followed within the slips {:.3} to {:.3} for more than {:.0} % of the time",
            slips.0,
            slips.1,
            100.0 - 100.0 * gone as f64 / cuts.len() as f64
        ));
    }
    found.notes.extend(at_order(&found, turned.periods));
    Ok(found)
}

fn signal_of<'a>(
    first: f64,
    interval: f64,
    signal: &'a [f64],
    shaft: &'a Shaft,
    line: &Line,
) -> Result<Signal<'a>, String> {
    let (from, to) = (
        first.max(shaft.first),
        (first + signal.len() as f64 * interval).min(shaft.last()),
    );
    if to <= from || to.is_nan() || from.is_nan() {
        return Err(
            "the signal is too short to follow a line: it and the shaft have no time in common"
                .into(),
        );
    }
    let fastest = line.ratio * line.order * shaft.fastest() / TAU;
    if fastest <= 0.0 {
        return Err("the shaft does not turn".into());
    }
    let highest = fastest * (1.0 - line.lowest_slip).max(1.0);
    if highest * interval > 0.4 {
        return Err(format!(
            "the line at up to {highest:.0} Hz needs more than {:.0} values a second",
            2.5 * highest
        ));
    }
    let begin = ((from - first) / interval).ceil().max(0.0) as usize;
    let end = (((to - first) / interval) as usize).min(signal.len());
    let part = (begin.min(end), end);
    let seen = signal[part.0..part.1].iter().filter(|v| v.is_finite());
    let mean = seen.clone().sum::<f64>() / seen.count().max(1) as f64;
    Ok(Signal {
        first,
        interval,
        values: signal,
        part,
        mean,
        shaft,
        periods: line.ratio * line.order,
    })
}

fn refuse(interval: f64, line: &Line) -> Result<(), String> {
    if !(interval > 0.0 && interval.is_finite()) {
        return Err("the interval of the signal must be positive and finite".into());
    }
    if !(line.ratio > 0.0 && line.ratio.is_finite() && line.order >= 1.0 && line.order.is_finite())
    {
        return Err("ratio and order of the line must be positive".into());
    }
    if !(line.lowest_slip < line.highest_slip.min(NEAR_REST)
        && line.lowest_slip >= -1.0
        && line.highest_slip <= 1.0)
    {
        return Err("the slip that is looked for must be a range within -1 and 1".into());
    }
    Ok(())
}

/// Power of the line over that of noise, averaged over some spectra.
fn standing(path: &Path) -> Vec<f64> {
    let count = path.strength.len();
    (0..count)
        .map(|k| {
            let near = &path.strength[k.saturating_sub(NEAR)..(k + NEAR + 1).min(count)];
            near.iter().sum::<f64>() / near.len() as f64
        })
        .collect()
}

/// Turns by which a path lags one slip.
struct Gone<'a> {
    path: &'a Path,
    steady: f64,
    travel: f64,
    turned: f64,
}

impl Gone<'_> {
    /// Turns until a travel that does not fall from call to call.
    fn until(&mut self, travel: f64) -> f64 {
        let parts = ((travel - self.travel) / HOP).ceil().max(1.0) as usize;
        let step = (travel - self.travel) / parts as f64;
        for k in 0..parts {
            let middle = self.travel + (k as f64 + 0.5) * step;
            self.turned += step * (self.path.smooth_at(middle) - self.steady);
        }
        self.travel = travel;
        self.turned
    }
}

/// Phases against the path, in turns without jumps, not-a-number where they are not usable; and their relative variance, from
/// the power of the line over that of noise around each cell.
fn phases(cells: &[Cell], standing: &[f64], usable: &[bool]) -> (Vec<f64>, Vec<f64>) {
    let mut before = 0.0_f64;
    let turns = cells
        .iter()
        .zip(usable)
        .map(|(cell, usable)| {
            if !usable {
                return f64::NAN;
            }
            let turn = cell.value[1].atan2(cell.value[0]) / TAU;
            before = turn + (before - turn).round();
            before
        })
        .collect();
    let known = |standing: &f64| standing.max(LOST);
    let inverse: f64 = standing.iter().map(|s| 1.0 / known(s)).sum();
    let mean = standing.len() as f64 / inverse;
    let weight = standing.iter().map(|s| mean / known(s)).collect();
    (turns, weight)
}

/// Refuses or reports another line in the range beside the ridge.
///
/// `usable` spectra of the path, `slips` that are looked for.
fn rivals(
    turned: &Signal,
    path: &Path,
    usable: impl Fn(usize) -> bool,
    slips: (f64, f64),
) -> Result<Option<Note>, String> {
    let slip = |travel: f64| path.smooth_at(travel);
    // Turned back by its own slip the ridge is what changes slowly.
    let mut cells = turned.cells(HOP, OVERLAPS, slip);
    for (k, cell) in cells.iter_mut().enumerate() {
        if !usable(path.nearest((k as f64 + 0.5 * OVERLAPS as f64) * HOP)) {
            cell.value = [0.0; 2];
        }
    }
    let reach = RIVAL_HALF / 2;
    let mut powers = 0.0;
    let rest: Vec<Cell> = (0..cells.len())
        .map(|k| {
            let near = &cells[k.saturating_sub(reach)..(k + reach + 1).min(cells.len())];
            let mean = |axis: usize| {
                near.iter().map(|cell| cell.value[axis]).sum::<f64>() / near.len() as f64
            };
            let ridge = [mean(0), mean(1)];
            powers += ridge[0].powi(2) + ridge[1].powi(2);
            let value = cells[k].value;
            Cell {
                value: [value[0] - ridge[0], value[1] - ridge[1]],
                ..cells[k]
            }
        })
        .collect();
    let amplitude = (powers / cells.len().max(1) as f64).sqrt();
    let mean =
        (0..cells.len()).map(|k| slip(k as f64 * HOP)).sum::<f64>() / cells.len().max(1) as f64;
    // The same turned back by one slip, against which an order of the shaft stands still.
    let middle = 0.5 * (slips.0 + slips.1);
    let mut turn = 0.0;
    let still: Vec<Cell> = rest
        .iter()
        .enumerate()
        .map(|(k, cell)| {
            let (sine, cosine) = (TAU * turn).sin_cos();
            turn += HOP * (slip((k as f64 + 0.5) * HOP + 1.0) - middle);
            let [real, imaginary] = cell.value;
            Cell {
                value: [
                    real * cosine + imaginary * sine,
                    imaginary * cosine - real * sine,
                ],
                ..*cell
            }
        })
        .collect();
    let fixed = rival(&still, middle, slips).map(|found| (found.slip, found, "at the slip"));
    let moving = rival(&rest, 0.0, (slips.0 - mean, slips.1 - mean))
        .filter(|found| found.slip.abs() > BESIDE)
        .map(|found| (mean + found.slip, found, "beside it, about the slip"));
    let stronger = |a: &Rival, b: &Rival| a.amplitude.total_cmp(&b.amplitude);
    let Some((at, found, how)) = [fixed, moving]
        .into_iter()
        .flatten()
        .max_by(|a, b| stronger(&a.1, &b.1))
    else {
        return Ok(None);
    };
    let part = found.amplitude / amplitude.max(f64::MIN_POSITIVE);
    let order = turned.periods * (1.0 - at);
    let text = note!(
        "beside the line about the slip {:.3} there is another {} {:.3} (order {:.2} of the shaft) with {:.0} % of its amplitude",
        mean,
        how,
        at,
        order,
        100.0 * part
    );
    if part > REFUSED {
        return Err(format!(
            "{text}: nothing shows which of the two is the cage's; a narrower range of slip would"
        ));
    }
    Ok((part > REPORTED).then_some(text))
}

/// Reports where the ridge stays at an order of the shaft.
fn at_order(found: &CageSpeed, periods: f64) -> Option<Note> {
    let slips = || found.slip.iter().copied().filter(|v| v.is_finite());
    slips().next()?;
    let slip = median(slips());
    let deviations = found.slip_deviation.iter().copied();
    let deviation = median(deviations.filter(|v| v.is_finite()));
    let limit = AT_ORDER.max(2.0 * deviation);
    let order = (periods * (1.0 - slip)).round();
    let steady = median(slips().map(|s| (s - slip).abs())) < 0.5 * limit;
    let at = order >= 1.0 && (periods * (1.0 - slip) - order).abs() < limit * periods;
    (steady && at).then(|| {
        note!(
            "the line stays at order {} of the shaft: a line of the shaft itself looks the same",
            order
        )
    })
}

/// Adds to the deviations what a cycle that noise loses or wins would do.
///
/// `noise` of the phase of each value, rad, of cells of so many periods.
fn with_lost_cycles(found: &mut CageSpeed, noise: &[f64], periods: f64) {
    // The next phase is predicted with about as much error again: one and a quarter of its noise in all.
    let chances: Vec<f64> = noise
        .iter()
        .map(|noise| statistics::normal::beyond(0.0, 1.25 * noise, PI))
        .collect();
    for k in 0..found.slip.len() {
        let near = &chances[k.saturating_sub(MEMORY / 2)..(k + MEMORY / 2 + 1).min(chances.len())];
        let chance = near.iter().sum::<f64>().min(1.0);
        let jump = chance.sqrt() / (MEMORY as f64 * periods);
        let rolling = found.speed[k] / (1.0 - found.slip[k]);
        if jump > 0.1 * found.slip_deviation[k] && rolling.is_finite() {
            found.deviation[k] = found.deviation[k].hypot(jump * rolling);
            found.slip_deviation[k] = found.slip_deviation[k].hypot(jump);
        }
    }
}
