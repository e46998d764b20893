//! Torque over speed from slow runs: by the sensor, and by inertia times the slope of the speed.

use super::read::Series;
use super::{shaft, torque};
use crate::scenario::{InertiaSource, SteadySignal, TorqueSignal};
use measure::steady_curve::{
    Difference, SteadyCurve, compare, direct, inertia_from_bifilar, inertia_from_known_torque,
    inertia_from_pendulum, inertial,
};
use measure::uncertain::Uncertain;

/// Values of the speed that a curve is drawn from, at most.
const MOST: usize = 2000;

/// What a torque of a reading whose zero is not told lacks.
const NO_ZERO: &str = "the zero of the reading is not known: signals.torque.zero_deviation is not given, so that the torque by the sensor may be off by any constant, which its band does not hold";

/// Curves of a slow run; each has its reason where there is none.
pub(super) struct Found {
    pub inertia: Result<Uncertain, String>,
    /// Torque of the sensor while the speed falls.
    pub direct: Result<SteadyCurve, String>,
    /// Inertia times the slope of the speed while it falls.
    pub inertial: Result<SteadyCurve, String>,
    /// Torque of the sensor while the speed rises.
    pub up: Result<SteadyCurve, String>,
    pub direct_less_inertial: Result<Difference, String>,
    pub up_less_down: Result<Difference, String>,
    pub speed: Vec<f64>,
    pub notes: Vec<String>,
}

impl Found {
    pub fn of(
        wish: &SteadySignal,
        shaft: &shaft::Found,
        reading: Option<(&Series, &torque::Faulty, Option<&torque::Found>)>,
        sensor: Option<&TorqueSignal>,
    ) -> Result<Found, String> {
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
        let inertial = inertia
            .clone()
            .and_then(|inertia| inertial(first, interval, &speeds, inertia, &speed));
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
                notes.extend(curve.notes.iter().map(|note| format!("{name}: {note}")));
            }
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
            notes.push(NO_ZERO.to_string());
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
        Ok(Found {
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
    found: Option<&torque::Found>,
) -> (Vec<f64>, Vec<f64>) {
    match found.and_then(|found| found.torque.as_ref()) {
        Some(torque) => (torque.time.clone(), torque.torque.clone()),
        None => {
            let times = (0..series.values.len()).map(|k| series.time(k));
            (times.collect(), faulty.reading().to_vec())
        }
    }
}

/// First time, interval and speeds of whole turns around equal times: the errors of the marks drop out of them.
fn speeds(part: (f64, f64), shaft: &shaft::Found) -> Result<(f64, f64, Vec<f64>), String> {
    let times = &shaft.pulses.times;
    let marks = &shaft.pulses.marks;
    let turn = shaft.pulses.positions as i64;
    let begin = times.partition_point(|t| *t < part.0);
    let end = times.partition_point(|t| *t <= part.1);
    let few = || "fewer than 20 turns of the shaft lie in the part that is looked at".to_string();
    let (Some(first), Some(last)) = (
        marks.get(begin),
        end.checked_sub(1).and_then(|e| marks.get(e)),
    ) else {
        return Err(few());
    };
    let turns = (last - first) / turn;
    if turns < 20 {
        return Err(few());
    }
    let (from, to) = (times[begin], times[end - 1]);
    let count = (turns as usize).min(MOST);
    let interval = (to - from) / count as f64;
    let speed = |time: f64| {
        let middle = times.partition_point(|t| *t < time).min(times.len() - 1);
        let low = marks.partition_point(|mark| *mark < marks[middle] - turn / 2);
        let high = marks.partition_point(|mark| *mark < marks[low] + turn);
        match (times.get(high), marks.get(high)) {
            (Some(after), Some(mark)) if *mark == marks[low] + turn && low < high => {
                std::f64::consts::TAU / (after - times[low])
            }
            _ => f64::NAN,
        }
    };
    let values = (0..count).map(|k| speed(from + (k as f64 + 0.5) * interval));
    Ok((from + 0.5 * interval, interval, values.collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

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
