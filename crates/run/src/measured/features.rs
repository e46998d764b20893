//! Features of a measured and of a predicted curve, each by one estimator for both, at the samples of the file, with their uncertainty.
//!
//! ```text
//!   force          first contact, its duration and impulse, peak       begins where it rises above a threshold
//!   displacement   first reversal, rebound to the next one             turns by more than a threshold
//!   inner race     spin-up time                                        95 % of the rotor's speed at the release
//!   x and y        phase at the release, first contact, whirl          of a point in the plane
//! ```
//! Instants and extrema come from local fits whose windows follow the noise of the channel; the predicted curve has none. A force may jump: its
//! contact begins and ends anywhere between two samples. The phase of the measured orbit is that of the stretch before the release.

use super::before::Before;
use super::{Compared, Curve, GAP, NO_DEVIATION, NOTHING_COMMON, Run, root_mean_square};
use outcome::list::{List, origins, results};
use statistics::interpolation::between;
use statistics::local_fit::{Crossing, Samples, Side};
use statistics::noise::Noise;
use statistics::uncertain::Uncertain;
use std::array::from_fn;
use std::f64::consts::TAU;

type Feature = Result<Uncertain, String>;

/// Share of the predicted range that a threshold is at least.
const THRESHOLD: f64 = 0.02;
/// Deviations of an extremum of noise beyond the largest expected one that still count as noise.
const BEYOND: f64 = 1.0;
/// Amplitudes of the orbit before the release that the threshold of a reversal is at least: it moves by two.
const ORBITS: f64 = 3.0;
/// Deviations of its noise that the threshold of a force is at least.
const CONTACT_NOISE: f64 = 2.0;
/// Share of full speed at which a race has spun up.
const SPUN_UP: f64 = 0.95;
/// Samples a turn that a whirl needs.
const A_TURN: f64 = 8.0;
/// Samples a turn of the rotor that show the sense of a whirl, also of one that is three times as fast.
const OF_THE_ROTOR: f64 = 4.0;
/// The whirl counts outside this share of the clearance, as `whirl_turns` does.
const WHIRLS: f64 = 0.5;
/// Standard uncertainties of the orbit from which on it has a phase.
const SHOWN: f64 = 3.0;

const LATE: &str = "the file begins after the release";
const AT_GAP: &str = "the channel has a gap at the release";

fn no(why: &str) -> Feature {
    Err(why.to_string())
}

/// Features of the measured and of the predicted curve, and whether the noise of the former is known.
type Both<const N: usize> = ([[Feature; N]; 2], bool);

/// A table of features.
type Table<const N: usize> = fn(&mut List, &(), Option<&[Result<f64, String>; N]>);

/// Adds a table five times: measured with its uncertainty, predicted, the difference with its uncertainty, these where noise is known.
fn sides<const N: usize>(list: &mut List, name: &str, table: Table<N>, both: Option<Both<N>>) {
    let sides = both.map(|([measured, predicted], known)| {
        let difference = from_fn(|k| Ok(measured[k].clone()?.minus(predicted[k].clone()?)));
        let value = |of: &[Feature; N]| from_fn(|k| of[k].clone().map(|own| own.value));
        let spread = |of: &[Feature; N]| {
            let known = known.then_some(()).ok_or(NO_DEVIATION);
            from_fn(|k| {
                of[k]
                    .clone()
                    .and_then(|own| known.map(|()| own.deviation).map_err(str::to_string))
            })
        };
        let [measured, difference] = [measured, difference].map(|own| [value(&own), spread(&own)]);
        [
            measured.to_vec(),
            vec![value(&predicted)],
            difference.to_vec(),
        ]
        .concat()
    });
    let names = "measured uncertainty predicted difference difference_uncertainty";
    for (k, side) in names.split(' ').enumerate() {
        let own = sides.as_ref().map(|sides| &sides[k]);
        list.named(&[name, side], |list| table(list, &(), own));
    }
}

impl Compared {
    /// What noise alone does not reach, from its highest to its lowest value among so many, nor the orbit before the release, and a share of
    /// the range of the prediction.
    fn threshold(&self) -> f64 {
        let largest = (2.0 * (self.time.len().max(2) as f64).ln()).sqrt();
        let noise = 2.0 * (largest + BEYOND) * self.deviation().unwrap_or(0.0);
        let orbit = self
            .before
            .orbit
            .map_or(0.0, |[x, y]| x.value.hypot(y.value));
        noise.max(THRESHOLD * self.range()).max(ORBITS * orbit)
    }
    /// Whether it begins more than two samples after the release.
    fn begins_late(&self) -> bool {
        matches!(self.time[..], [first, second, ..] if first > 2.0 * (second - first))
    }
    /// Features of the measured curve, with the mean before the release, and of the predicted one, without noise; of both up to the first gap.
    fn both<const N: usize>(
        &self,
        of: impl Fn(Samples, Option<Uncertain>) -> [Feature; N],
    ) -> Both<N> {
        let Before { mean, noise, .. } = &self.before;
        let own = noise.clone().unwrap_or_default();
        // the estimator of the measured curve, so that what it smooths away is the same of both
        let sides = [
            (&self.measured, *mean, false),
            (&self.predicted, None, true),
        ];
        let rows = (self.gap).map_or(self.time.len(), |gap| {
            self.time.partition_point(|time| *time <= gap)
        });
        let times = &self.time[..rows];
        let why = match self.gap {
            _ if self.time.is_empty() => Some(NOTHING_COMMON),
            _ if self.begins_late() => Some(LATE),
            Some(gap) if gap <= 0.0 || rows == 0 => Some(AT_GAP),
            _ => None,
        };
        let sides = sides.map(|(values, mean, is_exact)| {
            if let Some(why) = why {
                return from_fn(|_| no(why));
            }
            let samples = Samples {
                times,
                values: &values[..rows],
                noise: &own,
            };
            let exact = |found: Uncertain| match is_exact {
                true => Uncertain::exact(found.value),
                false => found,
            };
            let before_gap = |why: String| match self.gap {
                Some(_) => format!("{why} before the first gap of the channel"),
                None => why,
            };
            of(samples, mean).map(|own| own.map(exact).map_err(before_gap))
        });
        (sides, noise.is_some())
    }
}

/// Features of one channel by what its column is.
pub(super) fn of_curve(list: &mut List, curve: &Curve, run: Option<(&Compared, &Run)>) {
    let (name, column) = (curve.name.as_str(), curve.given.column.as_str());
    let ends = |ends: &[&str]| ends.iter().any(|end| column.ends_with(end));
    match curve.unit {
        "N" if ends(&["force"]) => {
            let of = run.map(|(own, _)| own.both(|samples, mean| impact(own, samples, mean)));
            sides(list, name, force, of);
        }
        "m" if ends(&[".x", ".y"]) => {
            let of = run.map(|(own, _)| {
                let both = own.both(|samples, _| turning(own, samples));
                paired(own, both)
            });
            sides(list, name, displacement, of);
        }
        "rad/s" if ends(&["inner_race.speed"]) => {
            let of =
                run.map(|(own, run)| own.both(|samples, _| [spin_up(own, samples, run.spin())]));
            sides(list, name, speed, of);
        }
        _ => {}
    }
}

/// First sample after the release.
fn first(times: &[f64]) -> usize {
    times
        .partition_point(|time| *time < 0.0)
        .min(times.len() - 1)
}

/// Time to 95 % of a speed; without a rotor of the largest predicted one.
fn spin_up(own: &Compared, samples: Samples, spin: f64) -> Feature {
    let sizes = |values: &[f64]| values.iter().map(|own| own.abs()).collect::<Vec<f64>>();
    let full = match spin {
        0.0 => sizes(&own.predicted).into_iter().fold(0.0, f64::max),
        spin => spin,
    };
    let values = &sizes(samples.values);
    let samples = Samples { values, ..samples };
    let crossing = samples.crossing(SPUN_UP * full, first(samples.times), Side::Around);
    let time = crossing.map(|own| own.time);
    time.ok_or_else(|| "the curve does not cross 95 % of the speed beyond its noise".to_string())
}

/// First contact, its duration and impulse, and the peak of a force above its mean before the release.
fn impact(own: &Compared, samples: Samples, mean: Option<Uncertain>) -> [Feature; 4] {
    let first = first(samples.times);
    let level = (THRESHOLD * own.range()).max(CONTACT_NOISE * own.deviation().unwrap_or(0.0));
    let alone = Uncertain::new(samples.values[first], samples.noise.deviation);
    let base = mean.unwrap_or(alone);
    let values: Vec<f64> = samples.values.iter().map(|own| own - base.value).collect();
    let samples = Samples {
        values: &values,
        ..samples
    };
    let largest = (0..values.len()).max_by(|a, b| values[*a].total_cmp(&values[*b]));
    let peak = samples.extremum(largest.unwrap_or(first), 1.0, 0).value;
    let peak = match own.gap {
        None => Ok(Uncertain::new(
            peak.value,
            peak.deviation.hypot(base.deviation),
        )),
        Some(_) => no("the largest force need not be"),
    };
    let Some(begin) = samples.jump(level, 1.0, first) else {
        let none = || no("the force does not rise above the threshold");
        return [none(), none(), none(), peak];
    };
    let end = samples.jump(level, -1.0, begin.row);
    let end = end.ok_or("the force does not fall below its threshold again".to_string());
    let impulse = end.clone().map(|end| {
        let (from, to) = (begin.row.saturating_sub(1), end.row);
        let time = |row: usize| samples.times[row.clamp(from, to)];
        let weight = |row: usize| 0.5 * (time(row + 1) - time(row.saturating_sub(1)));
        let weights: Vec<f64> = (from..=to).map(weight).collect();
        let sum = samples.noise.weighted(&weights, &values[from..=to]);
        // where between two samples it begins and ends is not known: by that times the force there, on a line through two samples
        let edge = |edge: Crossing, row: usize, next: usize| {
            edge.time.deviation * (1.5 * values[row] - 0.5 * values[next])
        };
        let begins = edge(begin, begin.row, (begin.row + 1).min(to));
        let ends = edge(end, to - 1, to.saturating_sub(2));
        let offset = base.deviation * weights.iter().sum::<f64>();
        Uncertain::new(
            sum.value,
            sum.deviation.hypot(offset).hypot(begins).hypot(ends),
        )
    });
    let lasts = end.map(|end| end.time.minus(begin.time));
    [Ok(begin.time), lasts, impulse, peak]
}

/// Instant of the first reversal of a displacement, and how far it comes back until the next.
fn turning(own: &Compared, samples: Samples) -> [Feature; 2] {
    let first = first(samples.times);
    let rows = reversals(&samples.values[first..], own.threshold());
    let found = |k: usize| {
        let (row, sense) = rows
            .get(k)
            .ok_or("the displacement does not turn by more than the threshold")?;
        Ok::<_, String>(samples.extremum(first + row, *sense, first))
    };
    let apart = found(1).and_then(|next| Ok(next.value.minus(found(0)?.value)));
    let rebound = apart.map(|own| Uncertain::new(own.value.abs(), own.deviation));
    [found(0).map(|own| own.time), rebound]
}

/// Extrema of both curves where they are those of one motion: of one sense, and nearer to each other than half of the way to the next one.
fn paired(own: &Compared, (mut sides, known): Both<2>) -> Both<2> {
    if own.time.is_empty() {
        return (sides, known);
    }
    let start = first(&own.time);
    let [measured, predicted] =
        [&own.measured, &own.predicted].map(|values| reversals(&values[start..], own.threshold()));
    let apart = match (&measured[..], &predicted[..]) {
        ([one, ..], [other, next, ..]) => {
            let time = |row: usize| own.time[start + row];
            let half = 0.5 * (time(next.0) - time(other.0));
            one.1 != other.1 || (time(one.0) - time(other.0)).abs() > half
        }
        _ => false,
    };
    if apart {
        sides[0] = from_fn(|_| no("its first reversal is not that of the prediction"));
    }
    (sides, known)
}

/// Rows of the extrema between which values change by more than a threshold, with 1 of a maximum and -1 of a minimum.
fn reversals(values: &[f64], least: f64) -> Vec<(usize, f64)> {
    let (mut rows, mut sense, mut extreme) = (Vec::new(), 0.0, (0, values[0]));
    for (row, value) in values.iter().enumerate() {
        let ahead = value - extreme.1;
        if sense == 0.0 {
            if ahead.abs() > least {
                (sense, extreme) = (ahead.signum(), (row, *value));
            }
        } else if sense * ahead > 0.0 {
            extreme = (row, *value);
        } else if -sense * ahead > least {
            rows.push((extreme.0, sense));
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

/// Points of both curves at the samples of the channel along x.
struct Points {
    time: Vec<f64>,
    /// Measured and predicted.
    sides: [Vec<[f64; 2]>; 2],
    /// Noise of both channels as one; none where that of one is not known.
    noise: Option<Noise>,
}

impl Orbit<'_> {
    fn points(&self, run: &Run) -> Points {
        let [x, y] = self.axes.map(|axis| &run.all[axis]);
        let noise = x.before.noise.clone().zip(y.deviation());
        let mut points = Points {
            time: Vec::new(),
            sides: [Vec::new(), Vec::new()],
            noise: noise.map(|(x, y)| Noise {
                deviation: x.deviation.hypot(y) / 2_f64.sqrt(),
                ..x
            }),
        };
        for (row, time) in x.time.iter().enumerate() {
            let measured = run.curves[self.axes[1]].at(time + run.release);
            let predicted = between(&y.time, &y.predicted, *time);
            if let Some(predicted) = predicted.filter(|_| measured.is_finite()) {
                points.time.push(*time);
                points.sides[0].push([x.measured[row], measured]);
                points.sides[1].push([x.predicted[row], predicted]);
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

    /// The measured synchronous orbit along both axes.
    fn orbit(&self, run: &Run) -> [Option<[Uncertain; 2]>; 2] {
        self.axes.map(|axis| run.all[axis].before.orbit)
    }

    /// Whether the measured orbit before the release turns against the rotor, beyond its noise: by the sign of the area that it surrounds.
    fn is_backward(&self, run: &Run) -> bool {
        let [Some(x), Some(y)] = self.orbit(run) else {
            return false;
        };
        let value = |k: usize| [x[k].value, y[k].value];
        let size = |k: usize| {
            [
                x[k].deviation * y[1 - k].value,
                x[1 - k].value * y[k].deviation,
            ]
        };
        let area = value(0)[0] * value(1)[1] - value(1)[0] * value(0)[1];
        let deviation = [size(0), size(1)]
            .concat()
            .iter()
            .map(|own| own * own)
            .sum::<f64>();
        area < -SHOWN * deviation.sqrt()
    }

    /// Phases at the release, rad: of the measured orbit before it and of the run there.
    fn phases(&self, run: &Run) -> [Feature; 2] {
        let measured = self.orbit(run).map(|own| own.map(|own| own[0]));
        let predicted =
            ["x", "y"].map(|axis| run.at(&format!("{}.{axis}", self.place), run.release));
        let [measured, mut predicted] = [measured, predicted.map(|own| own.map(Uncertain::exact))]
            .map(|point| {
                let [Some(x), Some(y)] = point else {
                    return no("the file does not show a turn before the release");
                };
                let radius = x.value.hypot(y.value);
                if radius <= SHOWN * x.deviation.max(y.deviation) {
                    return no(
                        "the orbit at the release is not above three standard uncertainties",
                    );
                }
                let across = (x.deviation * y.value).hypot(y.deviation * x.value) / radius;
                Ok(Uncertain::new(y.value.atan2(x.value), across / radius))
            });
        if let (Ok(measured), Ok(phase)) = (&measured, &mut predicted) {
            // the difference of two phases is the shorter way
            phase.value += TAU * ((measured.value - phase.value) / TAU).round();
        }
        [measured, predicted]
    }

    /// Phase at the release, first contact and whirl of both curves, and whether their noise is known.
    fn features(&self, run: &Run) -> Both<3> {
        let points = self.points(run);
        let known = points.noise.is_some();
        if points.time.is_empty() || run.all[self.axes[0]].begins_late() {
            return (from_fn(|_| from_fn(|_| no(LATE))), known);
        }
        let interval = self.axes.map(|axis| run.curves[axis].interval());
        let is_coarse = interval[0].max(interval[1]) * run.spin() * OF_THE_ROTOR > TAU;
        let noise = &points.noise.unwrap_or_default();
        let gaps = self
            .axes
            .map(|axis| run.all[axis].gap.unwrap_or(f64::INFINITY));
        let rows = (points.time).partition_point(|time| *time <= gaps[0].min(gaps[1]));
        let of = |(of, is_exact): (&Vec<[f64; 2]>, bool)| {
            let Some(clearance) = self.clearance(run) else {
                return from_fn(|_| no("no bearing with a clearance is at this place"));
            };
            let values: &Vec<f64> = &of.iter().map(|[x, y]| x.hypot(*y)).collect();
            let times = &points.time;
            let radii = Samples {
                times,
                values,
                noise,
            };
            let before_gap = Samples {
                times: &times[..rows],
                values: &values[..rows],
                noise,
            };
            let contact = (rows > 0)
                .then(|| before_gap.crossing(clearance, first(before_gap.times), Side::Before));
            let contact = contact.flatten().map(|own| own.time);
            let turns = match is_coarse {
                true => no("fewer than four samples a turn of the rotor do not show the sense"),
                false => whirl(radii, of, WHIRLS * clearance, GAP * interval[0]),
            };
            let exact = |found: Uncertain| match is_exact {
                true => Uncertain::exact(found.value),
                false => found,
            };
            let found = [
                contact.ok_or_else(|| {
                    "the curve does not cross the clearance beyond its noise, or has a gap before"
                        .to_string()
                }),
                turns,
            ];
            found.map(|own| own.map(exact))
        };
        let mut others = points.sides.iter().zip([false, true]).map(of);
        let sides = self.phases(run).map(|phase| {
            let [contact, turns] = others.next().unwrap_or_else(|| from_fn(|_| no(LATE)));
            [phase, contact, turns]
        });
        (sides, known)
    }

    fn error(&self, run: &Run) -> Result<f64, String> {
        let points = self.points(run);
        let [measured, predicted] = &points.sides;
        let both = measured.iter().zip(predicted);
        let apart = both.map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]));
        root_mean_square(apart, NOTHING_COMMON)
    }
}

/// Net angle about the line of levitation over the time of the stretches outside a radius that go round once at least, which bounces do not; of
/// each stretch the noise of both ends is left. Samples further apart than the longest interval end a stretch.
pub(super) fn whirl(radii: Samples, points: &[[f64; 2]], radius: f64, longest: f64) -> Feature {
    let (mut angle, mut time, mut rows, mut ends) = (0.0_f64, 0.0, 0, 0.0);
    let step = |row: usize| radii.times[row + 1] - radii.times[row];
    let is_outside = |row: usize| radii.values[row] >= radius;
    let goes_on = |row: usize| {
        row + 1 < points.len() && is_outside(row) && is_outside(row + 1) && step(row) <= longest
    };
    let mut begin = 0;
    for last in (0..points.len()).filter(|row| !goes_on(*row)) {
        let turned = (begin..last).map(|row| {
            let [from, to] = [points[row], points[row + 1]];
            (from[0] * to[1] - from[1] * to[0]).atan2(from[0] * to[0] + from[1] * to[1])
        });
        let turned: f64 = turned.sum();
        if turned.abs() >= TAU {
            angle += turned;
            time += radii.times[last] - radii.times[begin];
            rows += last - begin;
            ends += radii.values[begin].powi(-2) + radii.values[last].powi(-2);
        }
        begin = last + 1;
    }
    match rows {
        0 => no("it goes round less than once before it comes within half the clearance"),
        _ if angle.abs() * A_TURN > TAU * rows as f64 => no("fewer than eight samples a turn"),
        _ => Ok(Uncertain::new(
            angle / time,
            radii.noise.deviation * ends.sqrt() / time,
        )),
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

/// Of the pairs that show it: phases at the release, measured and predicted, rad, and whether the measured orbit turns against the rotor.
pub(super) fn phases(curves: &[Curve], run: &Run) -> Vec<(String, [Uncertain; 2], bool)> {
    let pairs = orbits(curves).into_iter().filter_map(|own| {
        let [measured, predicted] = own.phases(run).map(Result::ok);
        let is_backward = own.is_backward(run);
        Some((own.name, [measured?, predicted?], is_backward))
    });
    pairs.collect()
}

results! {
    fn force(setup: &(), of: &[Result<f64, String>; 4]) {
        "measured.*.first_contact.*": number "s", CONTACT, "first contact by the force, after the release" in measured_features "first contact" => of[0].clone();
        "measured.*.contact_duration.*": number "s", CONTACT, "duration of the first contact" in measured_features "duration of the first contact" => of[1].clone();
        "measured.*.impulse.*": number "N s", IMPULSE, "impulse of the first contact" in measured_features "impulse of the first contact" => of[2].clone();
        "measured.*.peak.*": number "N", PEAK, "largest force" in measured_features "largest force" => of[3].clone();
    }
    fn displacement(setup: &(), of: &[Result<f64, String>; 2]) {
        "measured.*.first_reversal.*": number "s", REVERSAL, "first reversal after the release" in measured_features "first reversal" => of[0].clone();
        "measured.*.rebound.*": number "m", REVERSAL, "displacement from the first reversal to the next" in measured_features "rebound" => of[1].clone();
    }
    fn speed(setup: &(), of: &[Result<f64, String>; 1]) {
        "measured.*.spin_up_time.*": number "s", SPIN_UP, "time to 95 % of the speed, after the release" in measured_features "spin-up to 95 %" => of[0].clone();
    }
    fn error(setup: &(), of: &Result<f64, String>) {
        "measured.*.orbit_error": number "m", ORBIT_ERROR, "root mean square distance of the measured from the predicted centre" in measured_difference "rms difference" => of.clone();
    }
    fn orbit(setup: &(), of: &[Result<f64, String>; 3]) {
        "measured.*.phase_at_release.*": number "rad", PHASE, "angle of the orbit at the release" in measured_features "phase at the release [deg]" => of[0].clone();
        "measured.*.first_contact.*": number "s", CROSSING, "first contact by the orbit, after the release" in measured_features "first contact" => of[1].clone();
        "measured.*.whirl_frequency.*": number "rad/s", WHIRL, "mean rate of the whirl" in measured_features "whirl frequency [Hz]" => of[2].clone();
    }
}

const HERE: &str = "crates/run/src/measured/features.rs";
const LOCAL: &str = "crates/statistics/src/local_fit.rs";

origins! {
    CONTACT: law "force above its mean before the release passes max(2 s, 0.02 R) between two samples, in their middle, and stays beyond by more than noise; s the deviation of the channel, R the range of the prediction",
        source HERE,
        valid "uncertain by the interval over sqrt(12) and by the noise over the slope; time_to_first_contact of the prediction is that of the gap on dense output";
    IMPULSE: law "∫F dt over the first contact, by trapezoids over its samples",
        source HERE,
        valid "samples that resolve the contact; uncertain by its ends, the noise and the mean before the release";
    PEAK: law "largest force above its mean before the release, vertex of the local fit there",
        source LOCAL,
        valid "peak_contact_force of the prediction is that of dense output";
    REVERSAL: law "first extremum from the release on, and the change from it to the next, by local fits; each turns by more than max(2 (1 + sqrt(2 ln n)) s, 0.02 R, 3 a)",
        source LOCAL,
        valid "s the deviation of the channel, n its samples, R the range of the prediction, a the amplitude of its orbit before the release";
    SPIN_UP: law "|ω_i| by a local fit reaches 95 % of the predicted rotor speed at the release, without a rotor of the largest predicted speed",
        source LOCAL,
        valid "noise below what the race ends above that speed";
    ORBIT_ERROR: law "sqrt(mean |c_measured - c_predicted|^2) over the samples",
        source HERE,
        valid "errors of place and of phase alike";
    PHASE: law "atan2(y, x) of the synchronous orbit of the 64 turns before the release at most; the predicted one of the centre at the release, within half a turn of the measured one",
        source "crates/run/src/measured/before.rs",
        valid "an orbit above three standard uncertainties; the angle of the unbalance at the release is an input";
    CROSSING: law "distance from the line of levitation, by a local fit before it, reaches the radial air clearance",
        source LOCAL,
        valid "a race that is centred until then, sensors whose zero is the line of levitation";
    WHIRL: law "net angle about the line of levitation over the time of all stretches outside half the clearance that go round once or more",
        source HERE,
        valid "bounces, which go round less, do not count; eight samples a turn or more, and four a turn of the rotor";
}
