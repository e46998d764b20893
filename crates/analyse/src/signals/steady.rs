//! Torque over speed from slow runs: by the sensor, and by inertia times the slope of the speed.

use crate::signals::read::Series;
use crate::signals::{shaft, torque};
use identify::coasting::Windage;
use identify::steady_curve::{Difference, SteadyCurve, compare, direct, inertial};
use measure::inertia::{inertia_from_bifilar, inertia_from_known_torque, inertia_from_pendulum};
use problem::{note, note::Note};
use scenario::{InertiaSource, SteadySignal, TorqueSignal};
use statistics::uncertain::Uncertain;

/// Values of the speed that a curve is drawn from, at most; and at least of a shaft that turns few times, whose turns overlap then:
/// the fit sees that their errors are alike.
const MOST: usize = 2000;
const LEAST: usize = 96;
/// Fewest turns of the shaft that show how its speed changes.
const TURNS: i64 = 10;
/// Fewest values of a speed channel in the part.
const FEWEST: usize = 32;
/// Part by which the torque by the slope of the speed may differ from that of the sensor, and deviations: beyond both it is no
/// matter of the bands.
const BESIDE: f64 = 0.3;
const APART: f64 = 3.0;

/// What a torque of a reading whose zero is not told lacks.
const NO_ZERO: &str = "the zero of the reading is not known: signals.torque.zero_deviation is not given, so that the torque by the sensor may be off by any constant, which its band does not hold";

/// Curves of a slow run; each has its reason where there is none.
pub(crate) struct Estimate {
    pub inertia: Result<Uncertain, String>,
    /// Torque of the sensor while the speed falls.
    pub direct: Result<SteadyCurve, String>,
    /// Inertia times the slope of the speed while it falls.
    pub inertial: Result<SteadyCurve, String>,
    /// Torque of the sensor while the speed rises.
    pub up: Result<SteadyCurve, String>,
    pub direct_less_inertial: Result<Difference, String>,
    pub up_less_down: Result<Difference, String>,
    /// What brakes the shaft without the bearing; it is taken out of `inertial`.
    pub windage: Result<Windage, String>,
    pub speed: Vec<f64>,
    pub notes: Vec<Note>,
    /// Why marks, inertia or scale may be wrong.
    pub doubt: Option<Note>,
}

impl Estimate {
    pub fn of(
        wish: &SteadySignal,
        shaft: &shaft::Estimate,
        reading: Option<(&Series, &torque::Faulty, Option<&torque::Estimate>)>,
        sensor: Option<&TorqueSignal>,
        windage: Result<Windage, String>,
    ) -> Result<Estimate, String> {
        let (first, interval, speeds) = speeds((wish.from, wish.to), shaft)?;
        let known = || speeds.iter().copied().filter(|v| v.is_finite());
        let low = known().fold(f64::INFINITY, f64::min);
        let high = known().fold(f64::NEG_INFINITY, f64::max);
        if high.partial_cmp(&low) != Some(std::cmp::Ordering::Greater) {
            return Err("the shaft does not turn in the part that is looked at".to_string());
        }
        // The ends of a record tell a curve least.
        let margin = 0.02 * (high - low);
        let steps = (wish.points - 1) as f64;
        let speed: Vec<f64> = (0..wish.points)
            .map(|k| low + margin + (high - low - 2.0 * margin) * k as f64 / steps)
            .collect();
        let inertia = wish
            .inertia
            .as_ref()
            .ok_or_else(|| "no inertia is given".to_string())
            .and_then(inertia);
        let mut inertial = inertia
            .clone()
            .and_then(|inertia| inertial(first, interval, &speeds, inertia, &speed));
        match (&mut inertial, &windage, &wish.windage) {
            (Ok(curve), Ok(windage), _) => windage.taken_out(curve),
            (Ok(_), Err(why), Some(_)) => {
                inertial = Err(format!("the windage is not known: {why}"));
            }
            _ => (),
        }
        let by_sensor = |part: (f64, f64)| {
            let (series, faulty, found) =
                reading.ok_or_else(|| "signals.torque.channel is not given".to_string())?;
            if let Some(why) = faulty.cut_between(series, part.0, part.1) {
                return Err(why);
            }
            let (time, torque) = torques(series, faulty, found);
            let inside = |t: f64| t >= part.0 && t <= part.1;
            let rows = || time.iter().zip(&torque).filter(|(t, _)| inside(**t));
            let turning: Vec<f64> = rows().map(|(t, _)| shaft.speed.at(*t).speed).collect();
            let felt: Vec<f64> = rows().map(|(_, m)| *m).collect();
            direct(&turning, &felt, &speed)
        };
        let mut direct = by_sensor((wish.from, wish.to));
        let mut up = match wish.up_from.zip(wish.up_to) {
            Some(part) => by_sensor(part),
            None => Err("signals.steady.up_from is not given".to_string()),
        };
        let mut notes = Vec::new();
        for (name, curve) in [
            ("by the sensor", &direct),
            ("by the slope of the speed", &inertial),
            ("up", &up),
        ] {
            if let Ok(curve) = curve {
                notes.extend(
                    curve
                        .notes
                        .iter()
                        .map(|note| note!("{}: {}", name, note.clone())),
                );
            }
        }
        // Asked for by its inertia, and not there though the other curve is.
        if let (Some(_), Err(why)) = (&wish.inertia, &inertial) {
            notes.push(note!("by the slope of the speed: no curve: {}", why));
        }
        let set = |first: &Result<SteadyCurve, String>, second: &Result<SteadyCurve, String>| match (
            first, second,
        ) {
            (Ok(first), Ok(second)) => compare(first, second),
            (Err(why), _) | (_, Err(why)) => Err(why.clone()),
        };
        if let (Err(by_sensor), Err(by_slope)) = (&direct, &inertial) {
            return Err(format!(
                "by the sensor: {by_sensor}; by the slope of the speed: {by_slope}"
            ));
        }
        // Zero and scale of the sensor are the same up and down; beside the inertia they count.
        let up_less_down = set(&up, &direct);
        let found = reading.and_then(|(_, _, found)| found?.torque.as_ref());
        let zero = match found {
            Some(torque) => Some(torque.zero.deviation),
            None => sensor.and_then(|s| s.zero_deviation),
        };
        if zero.is_none() && (direct.is_ok() || up.is_ok()) {
            notes.push(note!("{}", NO_ZERO));
        }
        let against = match zero {
            Some(_) => Ok(()),
            None => Err(NO_ZERO.to_string()),
        };
        let zero = zero.unwrap_or(0.0);
        for curve in [&mut direct, &mut up].into_iter().flatten() {
            curve.zero_deviation = zero;
            curve.scale_deviation = sensor.map_or(0.0, |sensor| sensor.scale_deviation);
        }
        let doubt = match (&direct, &inertial) {
            (Ok(direct), Ok(inertial)) => beside(direct, inertial),
            _ => None,
        };
        Ok(Estimate {
            windage,
            doubt,
            direct_less_inertial: set(&direct, &inertial).and_then(|all| against.map(|()| all)),
            up_less_down,
            inertia,
            direct,
            inertial,
            up,
            speed,
            notes,
        })
    }
}

/// What is odd of a torque by the sensor beside that by the slope of the speed: a wrong number of marks makes the second wrong by its
/// square or as much, a wrong inertia or scale by a factor.
fn beside(direct: &SteadyCurve, inertial: &SteadyCurve) -> Option<Note> {
    let difference = compare(inertial, direct).ok()?;
    let level = |curve: &SteadyCurve| {
        let known = |k: &usize| direct.torque[*k].is_finite() && inertial.torque[*k].is_finite();
        let common: Vec<usize> = (0..curve.torque.len()).filter(known).collect();
        common.iter().map(|k| curve.torque[*k]).sum::<f64>() / common.len().max(1) as f64
    };
    let ratio = level(inertial) / level(direct);
    let apart = difference.mean.value.abs() > APART * difference.mean.deviation;
    (apart && (ratio - 1.0).abs() > BESIDE).then(|| match ratio < 0.0 {
        true => note!(
            "by the slope of the speed it is {:.2} times the torque of the sensor: the sign of the torque is reversed (signals.torque.scale = \"-1 N mm\" for a channel in N mm)",
            ratio
        ),
        false => note!(
            "by the slope of the speed it is {:.2} times the torque of the sensor: signals.speed.marks_per_revolution (or the unit of a speed), signals.steady.inertia or the scale of the torque is wrong, or more than the bearing brakes the shaft (signals.steady.windage_*)",
            ratio
        ),
    })
}

/// First time and interval of the speeds of a shaft that coasts, s; the speeds, rad/s; what coasts.
type Coasted = ((f64, f64), Vec<f64>, Uncertain);

/// Speeds of a coast-down at equal times, and the inertia of what coasts: first time, interval, speeds, inertia.
pub(crate) fn coasted(wish: &SteadySignal, shaft: &shaft::Estimate) -> Result<Coasted, String> {
    let source = wish.inertia.as_ref();
    let inertia =
        inertia(source.ok_or_else(|| "signals.steady.inertia is not given".to_string())?)?;
    let (first, interval, speeds) = speeds((wish.from, wish.to), shaft)?;
    Ok(((first, interval), speeds, inertia))
}

/// The windage that is asked for; `run` is what was found in the run without bearing, where one is named.
pub(crate) fn windage(
    wish: &SteadySignal,
    run: impl FnOnce() -> Result<SteadyCurve, String>,
) -> Result<Windage, String> {
    match &wish.windage {
        None => Err("signals.steady.windage_* is not given".to_string()),
        Some(scenario::Windage::Law {
            constant,
            linear,
            quadratic,
            deviation,
        }) => Ok(Windage::Law {
            coefficients: [*constant, *linear, *quadratic],
            deviation: *deviation,
        }),
        Some(scenario::Windage::Run(_)) => run().map(Windage::Curve),
    }
}

fn inertia(source: &InertiaSource) -> Result<Uncertain, String> {
    let of = Uncertain::new;
    let found = match *source {
        InertiaSource::Given {
            inertia,
            inertia_deviation,
        } => of(inertia, inertia * inertia_deviation),
        InertiaSource::Pendulum {
            test_mass,
            test_mass_deviation,
            test_arm,
            test_arm_deviation,
            test_period,
            test_period_deviation,
            test_amplitude,
            test_gravity,
        } => inertia_from_pendulum(
            of(test_mass, test_mass_deviation),
            of(test_arm, test_arm_deviation),
            of(test_period, test_period_deviation),
            test_amplitude,
            test_gravity,
        ),
        InertiaSource::Bifilar {
            test_mass,
            test_mass_deviation,
            string_distance,
            string_distance_deviation,
            string_length,
            string_length_deviation,
            test_period,
            test_period_deviation,
            test_gravity,
        } => inertia_from_bifilar(
            of(test_mass, test_mass_deviation),
            of(string_distance, string_distance_deviation),
            of(string_length, string_length_deviation),
            of(test_period, test_period_deviation),
            test_gravity,
        ),
        InertiaSource::KnownTorque {
            test_torque,
            test_torque_deviation,
            acceleration_with,
            acceleration_with_deviation,
            acceleration_without,
            acceleration_without_deviation,
        } => inertia_from_known_torque(
            of(test_torque, test_torque_deviation),
            of(acceleration_with, acceleration_with_deviation),
            of(acceleration_without, acceleration_without_deviation),
        ),
    };
    match found.is_sound() && found.value > 0.0 {
        true => Ok(found),
        false => Err(format!(
            "the test of the inertia gives {} kg m^2: its values contradict each other",
            units::number_text((found.value * 1e9).round() / 1e9)
        )),
    }
}

/// Torque over time: without the sensor's swing where that is known, else the reading.
fn torques(
    series: &Series,
    faulty: &torque::Faulty,
    found: Option<&torque::Estimate>,
) -> (Vec<f64>, Vec<f64>) {
    match found.and_then(|found| found.torque.as_ref()) {
        Some(torque) => (torque.time.clone(), torque.torque.clone()),
        None => {
            let times = (0..series.values.len()).map(|k| series.time(k));
            (times.collect(), faulty.reading().to_vec())
        }
    }
}

/// First time, interval and speeds of whole turns at equal times: the errors of the marks drop out of them.
///
/// The mean speed of a turn is that of its middle in time, not in angle: where a turn takes long these are far apart.
fn speeds(part: (f64, f64), shaft: &shaft::Estimate) -> Result<(f64, f64, Vec<f64>), String> {
    let pulses = match &shaft.seen {
        shaft::MotionSource::Marks { pulses, .. } => pulses,
        shaft::MotionSource::Channel(channel) => return shown(part, channel),
    };
    let (times, marks) = (&pulses.times, &pulses.marks);
    let turn = pulses.positions as i64;
    let begin = times.partition_point(|t| *t < part.0);
    let end = times.partition_point(|t| *t <= part.1);
    let few = || {
        format!(
            "fewer than {TURNS} turns of the shaft lie from {} s to {} s, and how its speed changes does not show: give a longer part (signals.steady.from, to)",
            part.0, part.1
        )
    };
    let (Some(first), Some(last)) = (
        marks.get(begin),
        end.checked_sub(1).and_then(|e| marks.get(e)),
    ) else {
        return Err(few());
    };
    let turns = (last - first) / turn;
    if turns < TURNS {
        return Err(few());
    }
    let (from, to) = (times[begin], times[end - 1]);
    let count = (turns as usize).max(LEAST.min(end - begin)).min(MOST);
    let interval = (to - from) / count as f64;
    let at = (0..count).map(|k| from + (k as f64 + 0.5) * interval);
    let values = of_turns(times, marks, turn, at);
    Ok(trimmed(from + 0.5 * interval, interval, values))
}

/// Without what is not known at both ends: half a turn has no mean.
fn trimmed(first: f64, interval: f64, values: Vec<f64>) -> (f64, f64, Vec<f64>) {
    let known = |value: &f64| value.is_finite();
    let begin = values.iter().position(known).unwrap_or(0);
    let end = values.iter().rposition(known).map_or(0, |last| last + 1);
    let inside = values.get(begin..end).unwrap_or(&[]).to_vec();
    (first + begin as f64 * interval, interval, inside)
}

/// The same of a speed that an instrument shows: means over equal times, by as much earlier as it shows them late.
fn shown(part: (f64, f64), channel: &shaft::Channel) -> Result<(f64, f64, Vec<f64>), String> {
    let series = &channel.series;
    let place = |time: f64| {
        let place = (time + channel.late - series.first) / series.interval;
        (place.ceil().max(0.0) as usize).min(series.values.len())
    };
    let (begin, end) = (place(part.0), place(part.1));
    let count = end.saturating_sub(begin);
    if count < FEWEST {
        return Err(format!(
            "{count} values of the speed lie from {} s to {} s, and {FEWEST} are needed: give a longer part (signals.steady.from, to), or more values a second",
            part.0, part.1
        ));
    }
    let size = count.div_ceil(MOST);
    let mean = |values: &[f64]| {
        let known: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
        known.iter().sum::<f64>() / known.len() as f64
    };
    let means = series.values[begin..end].chunks_exact(size).map(mean);
    let interval = size as f64 * series.interval;
    let first = series.time(begin) - channel.late + 0.5 * (interval - series.interval);
    Ok(trimmed(first, interval, means.collect()))
}

/// Speeds at rising times, rad/s: a straight line between the middles of two neighbouring turns; not-a-number where marks are
/// missing.
///
/// A speed that bends is off its mean over a time T by `Ω'' T²/24`, told by the turn before and the one after.
fn of_turns(times: &[f64], marks: &[i64], turn: i64, at: impl Iterator<Item = f64>) -> Vec<f64> {
    let at_mark = |mark: i64| {
        let pulse = marks.partition_point(|own| *own < mark);
        (marks.get(pulse) == Some(&mark)).then(|| times[pulse])
    };
    // Middle, length and mean speed of the turn from a mark on.
    let mean = |mark: i64| -> Option<(f64, f64, f64)> {
        let (from, to) = (at_mark(mark)?, at_mark(mark + turn)?);
        let length = to - from;
        Some((0.5 * (from + to), length, std::f64::consts::TAU / length))
    };
    let bend = |mark: i64| -> Option<f64> {
        let (a, b, c) = (mean(mark - turn)?, mean(mark)?, mean(mark + turn)?);
        let slope = |a: (f64, f64, f64), b: (f64, f64, f64)| (b.2 - a.2) / (b.0 - a.0);
        Some(2.0 * (slope(b, c) - slope(a, b)) / (c.0 - a.0))
    };
    // Middle, length and speed there of each turn that is whole.
    let turns: Vec<(f64, f64, f64)> = marks
        .iter()
        .filter_map(|&mark| {
            let (middle, length, speed) = mean(mark)?;
            // The last turn bends as the one before it.
            let near = [mark, mark - turn, mark + turn].into_iter().find_map(bend);
            let bent = near.unwrap_or(0.0) * length * length / 24.0;
            Some((middle, length, speed - bent))
        })
        .collect();
    at.map(|time| {
        let next = turns.partition_point(|turn| turn.0 <= time);
        let about = next
            .checked_sub(1)
            .and_then(|k| turns.get(k).zip(turns.get(next)));
        match about {
            // Farther apart there is a silence between them.
            Some((before, after)) if after.0 - before.0 < 1.5 * before.1 => {
                let part = (time - before.0) / (after.0 - before.0);
                before.2 + part * (after.2 - before.2)
            }
            _ => f64::NAN,
        }
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_speed_of_a_turn_is_that_of_its_middle_in_time() {
        // Braked evenly from 12 to 6 rad/s in 6 s, with marks that are off: Ω = 12 - t.
        let place = |mark: i64| f64::from(mark as i32) + 0.1 * f64::from((mark * 7 % 3) as i32);
        let time = |angle: f64| 12.0 - (144.0 - 2.0 * angle).sqrt();
        let marks: Vec<i64> = (0..50).collect();
        let times: Vec<f64> = marks
            .iter()
            .map(|mark| time(place(*mark) * std::f64::consts::TAU / 6.0))
            .collect();
        let at: Vec<f64> = (1..=4).map(f64::from).collect();
        let found = of_turns(&times, &marks, 6, at.iter().copied());
        for (time, speed) in at.iter().zip(found) {
            assert!((speed - (12.0 - time)).abs() < 1e-9, "{time}: {speed}");
        }
        // Beyond the middles of the first turn and the last one nothing is told, nor in a silence of a turn.
        let silent: Vec<usize> = (0..50).filter(|k| !(20..26).contains(k)).collect();
        let times: Vec<f64> = silent.iter().map(|&k| times[k]).collect();
        let marks: Vec<i64> = silent.iter().map(|&k| k as i64).collect();
        let outside = [0.1, times[20] - 0.1];
        let found = of_turns(&times, &marks, 6, outside.into_iter());
        assert!(found.iter().all(|speed| speed.is_nan()), "{found:?}");
    }

    #[test]
    fn a_speed_that_bends_is_not_its_mean_over_a_turn() {
        // Ω = 12 e^(-t/2): the mean of a second is 1 % above the speed in its middle.
        let time = |angle: f64| -2.0 * (1.0 - angle / 24.0).ln();
        let marks: Vec<i64> = (0..20).collect();
        let times: Vec<f64> = marks
            .iter()
            .map(|mark| time(*mark as f64 * std::f64::consts::TAU / 6.0))
            .collect();
        let at = 1.2;
        let truth = 12.0 * (-0.5f64 * at).exp();
        let found = of_turns(&times, &marks, 6, std::iter::once(at))[0];
        assert!((found / truth - 1.0).abs() < 1.5e-3, "{found} {truth}");
    }

    #[test]
    fn an_inertia_that_cannot_be_is_refused() {
        let known = InertiaSource::KnownTorque {
            test_torque: 0.02,
            test_torque_deviation: 0.0,
            acceleration_with: -10.0,
            acceleration_with_deviation: 0.0,
            acceleration_without: 10.0,
            acceleration_without_deviation: 0.0,
        };
        assert!(inertia(&known).is_err());
        // A ring of 0.4 kg and 50 mm on two strings 50 mm apart and 1.2 m long: I = m r², T from the law.
        let (m, r, g, d, l) = (0.4, 0.05_f64, 9.81, 0.05_f64, 1.2);
        let period = (16.0 * std::f64::consts::PI.powi(2) * l * m * r * r / (m * g * d * d)).sqrt();
        let bifilar = InertiaSource::Bifilar {
            test_mass: m,
            test_mass_deviation: 0.0,
            string_distance: d,
            string_distance_deviation: 0.0,
            string_length: l,
            string_length_deviation: 0.0,
            test_period: period,
            test_period_deviation: 0.0,
            test_gravity: g,
        };
        assert!((inertia(&bifilar).unwrap().value / (m * r * r) - 1.0).abs() < 1e-12);
    }
}
