//! Features of a measured and of a predicted curve, each by one estimator for both, at the same rows.
//!
//! ```text
//!   force          first contact, its duration and impulse, peak       begins where it rises above a threshold
//!   displacement   first reversal, rebound to the next one             turns by more than a threshold
//!   inner race     spin-up time                                        95 % of the rotor's speed at the release
//!   x and y        phase at the release, first contact, whirl          of a point in the plane
//! ```
//! The threshold is six standard deviations of the channel, and a fiftieth of the range of the prediction at least.

use super::{Compared, Curve, NOTHING_COMMON, Run, root_mean_square};
use outcome::list::{List, origins, results};
use statistics::interpolation::between;
use std::array::from_fn;
use std::f64::consts::TAU;

type Found = Result<f64, String>;

/// Standard deviations of a threshold, and the share of the predicted range that it is at least.
const THRESHOLD: (f64, f64) = (6.0, 0.02);
/// Share of full speed at which a race has spun up.
const SPUN_UP: f64 = 0.95;
/// Rows a turn that a whirl needs.
const A_TURN: f64 = 8.0;
/// The whirl counts outside this share of the clearance, as `whirl_turns` does.
const WHIRLS: f64 = 0.5;

const LATE: &str = "the file begins after the release";

fn no(why: &str) -> Found {
    Err(why.to_string())
}

/// Adds a table three times: measured, predicted, difference.
fn sides<const N: usize>(
    list: &mut List,
    name: &str,
    table: fn(&mut List, &(), Option<&[Found; N]>),
    both: Option<[[Found; N]; 2]>,
) {
    let all = both.map(|[measured, predicted]| {
        let difference = from_fn(|k| Ok(measured[k].clone()? - predicted[k].clone()?));
        [measured, predicted, difference]
    });
    for (k, side) in (0..).zip(["measured", "predicted", "difference"]) {
        let own = all.as_ref().map(|all| &all[k]);
        list.named(&[name, side], |list| table(list, &(), own));
    }
}

impl Compared {
    fn threshold(&self) -> f64 {
        let (deviations, share) = THRESHOLD;
        (deviations * self.deviation.unwrap_or(0.0)).max(share * self.range())
    }
    /// Whether it begins more than two rows after an instant.
    fn begins_late(&self, time: f64) -> bool {
        matches!(self.time[..], [first, second, ..] if first > time + 2.0 * (second - first))
    }
    /// The first row from an instant on.
    fn row(&self, time: f64) -> usize {
        self.time.partition_point(|own| *own < time)
    }
}

/// Row and instant at which values reach a level, straight between rows; from a row on.
fn reached(time: &[f64], values: &[f64], level: f64, from: usize) -> Option<(usize, f64)> {
    let row = (from..values.len()).find(|row| values[*row] >= level)?;
    if row == from {
        return Some((row, time[row]));
    }
    let (before, after) = (values[row - 1], values[row]);
    let share = (level - before) / (after - before);
    Some((row, time[row - 1] + share * (time[row] - time[row - 1])))
}

/// Features of one channel by what its column is.
pub(super) fn of_curve(list: &mut List, curve: &Curve, run: Option<(&Compared, &Run)>) {
    let (name, column) = (curve.name.as_str(), curve.given.column.as_str());
    let ends = |ends: &[&str]| ends.iter().any(|end| column.ends_with(end));
    let values = |own: &'_ Compared| [own.measured.clone(), own.predicted.clone()];
    match curve.unit {
        "N" if ends(&["force"]) => {
            let of = |(own, run): (&Compared, &Run)| {
                values(own).map(|values| impact(own, &values, run.release))
            };
            sides(list, name, force, run.map(of));
        }
        "m" if ends(&[".x", ".y"]) => {
            let of = |(own, run): (&Compared, &Run)| {
                values(own).map(|values| turning(own, &values, run.release))
            };
            sides(list, name, displacement, run.map(of));
        }
        "rad/s" if ends(&["inner_race.speed"]) => {
            let of = |(own, run): (&Compared, &Run)| {
                values(own).map(|values| [spin_up(own, &values, run)])
            };
            sides(list, name, speed, run.map(of));
        }
        _ => {}
    }
}

/// Time to 95 % of the rotor's speed at the release; without a rotor of the largest predicted speed.
fn spin_up(own: &Compared, values: &[f64], run: &Run) -> Found {
    if own.begins_late(run.release) {
        return no(LATE);
    }
    let largest = |values: &[f64]| {
        values
            .iter()
            .fold(0.0, |most: f64, own| most.max(own.abs()))
    };
    let rotor = run
        .outcome
        .column("rotor.speed")
        .zip(run.outcome.column("time"));
    let full = rotor.and_then(|(speed, time)| between(&time.values, &speed.values, run.release));
    let level = SPUN_UP * full.map_or_else(|| largest(&own.predicted), f64::abs);
    let speeds: Vec<f64> = values.iter().map(|value| value.abs()).collect();
    let time = reached(&own.time, &speeds, level, own.row(run.release));
    let time = time.map(|(_, time)| time - run.release);
    time.ok_or_else(|| "95 % of the speed is not reached".to_string())
}

/// First contact, its duration and impulse, and the peak of a force.
fn impact(own: &Compared, values: &[f64], release: f64) -> [Found; 4] {
    if values.is_empty() {
        return from_fn(|_| no(NOTHING_COMMON));
    }
    if own.begins_late(release) {
        return from_fn(|_| no(LATE));
    }
    let (first, level) = (own.row(release).min(values.len() - 1), own.threshold());
    // what a load cell shows before the release
    let base = values[..=first].iter().sum::<f64>() / (first + 1) as f64;
    let excess: Vec<f64> = values.iter().map(|value| value - base).collect();
    let peak = excess.iter().copied().fold(0.0, f64::max);
    let Some((row, begin)) = reached(&own.time, &excess, level, first) else {
        let none = || no("the force does not rise above the threshold");
        return [none(), none(), none(), Ok(peak)];
    };
    let below: Vec<f64> = excess.iter().map(|value| -value).collect();
    let end = reached(&own.time, &below, -level, row);
    let lasts = || "the contact lasts to the end".to_string();
    let impulse = end.map(|(last, _)| {
        let step = |k: usize| 0.5 * (excess[k] + excess[k - 1]) * (own.time[k] - own.time[k - 1]);
        (row.max(1)..=last).map(step).sum()
    });
    [
        Ok(begin - release),
        end.map(|(_, end)| end - begin).ok_or_else(lasts),
        impulse.ok_or_else(lasts),
        Ok(peak),
    ]
}

/// Instant of the first reversal of a displacement, and how far it comes back until the next.
fn turning(own: &Compared, values: &[f64], release: f64) -> [Found; 2] {
    if own.begins_late(release) {
        return from_fn(|_| no(LATE));
    }
    let first = own.row(release);
    let rows = reversals(values.get(first..).unwrap_or_default(), own.threshold());
    let row = |k: usize| rows.get(k).map(|row| first + row);
    let none = || "the displacement does not turn by more than the threshold".to_string();
    let rebound = row(0)
        .zip(row(1))
        .map(|(at, next)| (values[next] - values[at]).abs());
    [
        row(0).map(|row| own.time[row] - release).ok_or_else(none),
        rebound.ok_or_else(none),
    ]
}

/// Rows of the extrema between which values change by more than a threshold.
fn reversals(values: &[f64], least: f64) -> Vec<usize> {
    let Some(start) = values.first() else {
        return Vec::new();
    };
    let (mut rows, mut sense, mut extreme) = (Vec::new(), 0.0, (0, *start));
    for (row, value) in values.iter().enumerate() {
        let ahead = value - extreme.1;
        if sense == 0.0 {
            if ahead.abs() > least {
                (sense, extreme) = (ahead.signum(), (row, *value));
            }
        } else if sense * ahead > 0.0 {
            extreme = (row, *value);
        } else if -sense * ahead > least {
            rows.push(extreme.0);
            (sense, extreme) = (-sense, (row, *value));
        }
    }
    rows
}

/// Channels along x and y of one place.
struct Orbit<'a> {
    /// What results call it, and the column of both without the axis.
    name: String,
    place: &'a str,
    axes: [usize; 2],
}

fn orbits(curves: &[Curve]) -> Vec<Orbit<'_>> {
    let pairs = curves.iter().enumerate().filter_map(|(x, curve)| {
        let place = curve.given.column.strip_suffix(".x")?;
        let other = format!("{place}.y");
        let beside = |own: &Curve| own.given.column == other && own.given.drop == curve.given.drop;
        let axes = [x, curves.iter().position(beside)?];
        let name = curve.given.of_drop(place);
        Some(Orbit { name, place, axes })
    });
    pairs.collect()
}

/// Points of both curves at the rows that both channels cover.
struct Points {
    time: Vec<f64>,
    /// Measured and predicted.
    sides: [Vec<[f64; 2]>; 2],
    deviation: f64,
}

impl Orbit<'_> {
    fn points(&self, run: &Run) -> Points {
        let [x, y] = self.axes.map(|axis| &run.all[axis]);
        let mut points = Points {
            time: Vec::new(),
            sides: [Vec::new(), Vec::new()],
            deviation: (x.deviation.into_iter().chain(y.deviation)).fold(0.0, f64::max),
        };
        for (row, time) in x.time.iter().enumerate() {
            let other = y.row(*time);
            if y.time.get(other) == Some(time) {
                points.time.push(*time);
                points.sides[0].push([x.measured[row], y.measured[other]]);
                points.sides[1].push([x.predicted[row], y.predicted[other]]);
            }
        }
        points
    }

    /// Radial air clearance where it is the rotor in a bearing.
    fn clearance(&self, run: &Run) -> Option<f64> {
        let bearing = self.place.strip_suffix("rotor")?.trim_end_matches('.');
        let mut pictures = run.outcome.pictures.iter();
        let own = pictures.find(|picture| picture.bearing == bearing);
        own?.clearance
    }

    /// Phase at the release, first contact and whirl of both curves.
    fn features(&self, run: &Run) -> [[Found; 3]; 2] {
        let points = self.points(run);
        if run.all[self.axes[0]].begins_late(run.release) {
            return from_fn(|_| from_fn(|_| no(LATE)));
        }
        let clearance = self.clearance(run);
        let interval = self.axes.map(|axis| run.curves[axis].interval());
        let interval = interval[0].max(interval[1]);
        let first = points.time.partition_point(|own| *own < run.release);
        let [measured, mut predicted] = [0, 1].map(|side| {
            let of: &[[f64; 2]] = &points.sides[side];
            let radii: Vec<f64> = of.iter().map(|[x, y]| x.hypot(*y)).collect();
            let phase = match radii.get(first) {
                None => no("the file does not cover the release"),
                Some(radius) if *radius <= THRESHOLD.0 * points.deviation => {
                    no("the orbit at the release is not above six standard deviations")
                }
                Some(0.0) => no("there is no orbit at the release"),
                Some(_) => Ok(of[first][1].atan2(of[first][0])),
            };
            let Some(clearance) = clearance else {
                let why = "no bearing with a clearance is at this place";
                return [phase, no(why), no(why)];
            };
            let contact = reached(&points.time, &radii, clearance, first);
            let contact = contact.map(|(_, time)| time - run.release);
            let contact = contact.ok_or_else(|| "the clearance is not crossed".to_string());
            // the predicted curve has no samples but the rows
            let interval = [interval, 0.0][side];
            let turns = whirl(&points.time, of, WHIRLS * clearance, interval);
            [phase, contact, turns]
        });
        if let (Ok(measured), Ok(phase)) = (&measured[0], &mut predicted[0]) {
            // the difference of two phases is the shorter way
            *phase += TAU * ((measured - *phase) / TAU).round();
        }
        [measured, predicted]
    }

    fn error(&self, run: &Run) -> Found {
        let points = self.points(run);
        let [measured, predicted] = &points.sides;
        let both = measured.iter().zip(predicted);
        let apart = both.map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]));
        root_mean_square(apart, NOTHING_COMMON)
    }
}

/// Net angle about the line of levitation over the time outside a radius, of what is sampled at an interval.
fn whirl(time: &[f64], points: &[[f64; 2]], radius: f64, interval: f64) -> Found {
    let (mut angle, mut outside, mut rows) = (0.0_f64, 0.0, 0);
    for row in 1..points.len() {
        let [from, to] = [points[row - 1], points[row]];
        if [from, to].iter().any(|[x, y]| x.hypot(*y) < radius) {
            continue;
        }
        angle += (from[0] * to[1] - from[1] * to[0]).atan2(from[0] * to[0] + from[1] * to[1]);
        outside += time[row] - time[row - 1];
        rows += 1;
    }
    match angle.abs() >= TAU {
        true if angle.abs() * A_TURN * interval.max(outside / f64::from(rows)) > TAU * outside => {
            no("fewer than eight rows or samples a turn")
        }
        true => Ok(angle / outside),
        false => no("it goes round less than once outside half the clearance"),
    }
}

/// Results of pairs of channels along x and y.
pub(super) fn of_orbits(list: &mut List, curves: &[Curve], run: Option<&Run>) {
    for own in orbits(curves) {
        list.named(&[&own.name], |list| {
            error(list, &(), run.map(|run| own.error(run)).as_ref())
        });
        sides(list, &own.name, orbit, run.map(|run| own.features(run)));
    }
}

/// Phases at the release of the pairs that show them: measured and predicted, rad.
pub(super) fn phases(curves: &[Curve], run: &Run) -> Vec<(String, [f64; 2])> {
    let pairs = orbits(curves).into_iter().filter_map(|own| {
        let [measured, predicted] = own.features(run).map(|[phase, ..]| phase.ok());
        Some((own.name, [measured?, predicted?]))
    });
    pairs.collect()
}

results! {
    fn force(setup: &(), of: &[Found; 4]) {
        "measured.*.first_contact.*": number "s", CONTACT, "first contact by the force, after the release" in measured_features "first contact" => of[0].clone();
        "measured.*.contact_duration.*": number "s", CONTACT, "duration of the first contact" in measured_features "duration of the first contact" => of[1].clone();
        "measured.*.impulse.*": number "N s", IMPULSE, "impulse of the first contact" in measured_features "impulse of the first contact" => of[2].clone();
        "measured.*.peak.*": number "N", PEAK, "largest force" in measured_features "largest force" => of[3].clone();
    }
    fn displacement(setup: &(), of: &[Found; 2]) {
        "measured.*.first_reversal.*": number "s", REVERSAL, "first reversal after the release" in measured_features "first reversal" => of[0].clone();
        "measured.*.rebound.*": number "m", REVERSAL, "displacement from the first reversal to the next" in measured_features "rebound" => of[1].clone();
    }
    fn speed(setup: &(), of: &[Found; 1]) {
        "measured.*.spin_up_time.*": number "s", SPIN_UP, "time to 95 % of the speed, after the release" in measured_features "spin-up to 95 %" => of[0].clone();
    }
    fn error(setup: &(), of: &Found) {
        "measured.*.orbit_error": number "m", ORBIT_ERROR, "root mean square distance of the measured from the predicted centre" in measured_difference "rms difference" => of.clone();
    }
    fn orbit(setup: &(), of: &[Found; 3]) {
        "measured.*.phase_at_release.*": number "rad", PHASE, "angle of the orbit at the release" in measured_features "phase at the release" => of[0].clone();
        "measured.*.first_contact.*": number "s", CROSSING, "first contact by the orbit, after the release" in measured_features "first contact" => of[1].clone();
        "measured.*.whirl_frequency.*": number "rad/s", WHIRL, "mean rate of the whirl" in measured_features "whirl frequency [Hz]" => of[2].clone();
    }
}

const HERE: &str = "crates/run/src/measured/features.rs";

origins! {
    CONTACT: law "force above its mean before the release exceeds max(6 s, 0.02 R), s the deviation of the channel, R the range of the prediction; ends where it falls below",
        source HERE,
        valid "at the rows, straight between them; time_to_first_contact of the prediction is that of the gap on dense output";
    IMPULSE: law "∫F dt over the first contact, by trapezoids over its rows",
        source HERE,
        valid "rows that resolve the contact";
    PEAK: law "largest force above its mean before the release, at the rows",
        source HERE,
        valid "noise raises the measured one; peak_contact_force of the prediction is that of dense output";
    REVERSAL: law "first extremum from the release on, and the change from it to the next; each turns by more than max(6 s, 0.02 R)",
        source HERE,
        valid "s the deviation of the channel, R the range of the prediction";
    SPIN_UP: law "first instant at which |ω_i| reaches 95 % of the predicted rotor speed at the release, without a rotor of the largest predicted speed",
        source HERE,
        valid "noise may reach the level early";
    ORBIT_ERROR: law "sqrt(mean |c_measured - c_predicted|^2) over the rows",
        source HERE,
        valid "errors of place and of phase alike";
    PHASE: law "atan2(y, x) about the line of levitation at the first row after the release; the predicted one within half a turn of the measured one",
        source HERE,
        valid "an orbit above six standard deviations; the angle of the unbalance at the release is an input";
    CROSSING: law "distance from the line of levitation reaches the radial air clearance",
        source HERE,
        valid "a race that is centred until then, sensors whose zero is the line of levitation";
    WHIRL: law "net angle about the line of levitation over the time outside half the clearance",
        source HERE,
        valid "once round at least; eight rows a turn or more";
}
