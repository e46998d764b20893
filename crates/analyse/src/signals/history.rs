//! The history of a measurement: what was read beside what it means.

use crate::signals::estimate::Estimate;
use crate::signals::request::{Request, Signal};
use crate::signals::{cage, shaft};
use measure::cage_speed::CageSpeed;
use measure::order::Order;
use measure::speed::Motion;
use measure::torque_sensor::Torque;
use outcome::Column;
use outcome::columns::{Columns, columns};
use recording::unit::unit_in_si;
use scenario::{PickupKind, SpeedSignal};
use statistics::interpolation;

/// Rows of a history at equal times.
const ROWS: usize = 4000;
/// Rows more around a quick change.
const ROWS_OF_CHANGE: usize = 1500;

/// Channels over time; what an estimator refuses has none.
pub(crate) fn columns(asked: &Request, found: Option<&Estimate>) -> Vec<Column> {
    let times = found.map_or_else(Vec::new, |found| times(asked, found));
    let mut table = Columns::over(&times);
    columns! { table, |time| "time": "s", "time on the clock of the file" => *time; }
    let signals = &asked.signals;
    let shaft = found.and_then(|found| found.shaft.as_deref());
    if let Some(speed) = &signals.speed {
        let there = found.map(|_| shaft.is_some());
        table.optional(there, |table| of_shaft(table, &times, speed, shaft));
    }
    if let Some(series) = &asked.torque {
        let reading = |time: f64| {
            let place = (time - series.first) / series.interval;
            interpolation::at_index(&series.values, place).unwrap_or(f64::NAN)
        };
        columns! { table, |time| "torque.reading": "N m", "reading of the torque sensor as it is" => reading(*time); }
    }
    if (signals.torque.as_ref()).is_some_and(|torque| torque.sensor.is_some()) {
        let torque = found.and_then(|found| found.torque.as_ref()?.torque.as_ref());
        let there = found.map(|_| torque.is_some());
        table.optional(there, |table| of_torque(table, torque, shaft));
    }
    if signals.cage.is_some() {
        let cage = found.and_then(|found| found.cage.as_ref());
        let there = found.map(|_| cage.is_some());
        table.optional(there, |table| of_cage(table, cage, shaft));
    }
    if let (Some(wish), Some(series)) = (&signals.vibration, &asked.vibration) {
        let unit = unit_in_si(&series.unit).0;
        let orders = found.and_then(|found| found.vibration.as_ref()?.orders.as_ref());
        for (k, order) in wish.orders.iter().enumerate() {
            let own = orders.map(|found| (&found.time, &found.orders[k]));
            let there = found.map(|_| own.is_some());
            // a point parts the names of a column
            let name = format!("{order}").replace('.', "_");
            table.optional(there, |table| of_order(table, (&name, *order, unit), own));
        }
    }
    table.list
}

/// Motion of the shaft.
fn of_shaft(
    table: &mut Columns<f64>,
    times: &[f64],
    wish: &SpeedSignal,
    shaft: Option<&shaft::Estimate>,
) {
    let motions: Vec<Motion> = (shaft.iter())
        .flat_map(|shaft| times.iter().map(|&time| shaft.speed.at(time)))
        .collect();
    let told = shaft.map(|shaft| shaft.watched.0..=shaft.told_until());
    let of = |time: &f64, value: fn(&Motion) -> f64| {
        let row = times.partition_point(|t| t < time);
        let inside = told.as_ref().is_some_and(|told| told.contains(time));
        let motion = motions.get(row.min(times.len() - 1));
        motion.filter(|_| inside).map_or(f64::NAN, value)
    };
    let raw = |time: &f64| shaft.map_or(f64::NAN, |shaft| shaft.raw_speed(*time));
    let shows_speed = matches!(wish.kind, PickupKind::Speed { .. });
    columns! { table, |time|
        "shaft.pulse_speed": "rad/s", "pitch over the time between the pulses around, as raw as pulses are" when !shows_speed => raw(time);
        "shaft.reading": "rad/s", "speed as the instrument shows it" when shows_speed => raw(time);
        "shaft.angle": "rad", "angle of the shaft from the first mark that passed; of a speed from the first value or the engagement on"
            => of(time, |motion| motion.angle);
        "shaft.speed": "rad/s", "speed of the shaft" => of(time, |motion| motion.speed);
        "shaft.speed_deviation": "rad/s", "standard deviation of that speed" => of(time, Motion::speed_uncertainty);
        "shaft.acceleration": "rad/s^2", "acceleration of the shaft" => of(time, |motion| motion.acceleration);
        "shaft.acceleration_deviation": "rad/s^2", "standard deviation of that acceleration" => of(time, Motion::acceleration_uncertainty);
    }
}

/// Torque without the swing of its sensor.
fn of_torque(table: &mut Columns<f64>, torque: Option<&Torque>, shaft: Option<&shaft::Estimate>) {
    let change = shaft.and_then(|shaft| shaft.speed.change);
    let lock = change.and_then(|change| change.end).map(|end| end.0);
    let of = |time: &f64, values: fn(&Torque) -> &[f64]| {
        torque.map_or(f64::NAN, |torque| at(*time, &torque.time, values(torque)))
    };
    let beside = |time: &f64| {
        let torque = torque?;
        Some((torque, beside_a_jump(*time, lock?, &torque.time)?))
    };
    columns! { table, |time|
        "torque.torque": "N m", "torque that the sensor felt; at a lock it jumps" => match beside(time) {
            Some((torque, k)) => torque.torque[k] + torque.rate[k] * (time - torque.time[k]),
            None => of(time, |torque| &torque.torque),
        };
        "torque.deviation": "N m", "standard deviation of that torque" => match beside(time) {
            Some((torque, k)) => torque.deviation[k],
            None => of(time, |torque| &torque.deviation),
        };
        "torque.disturbance": "N m", "amplitude of the disturbance once a turn" => of(time, |torque| &torque.disturbance);
        "torque.disturbance_deviation": "N m", "standard deviation of that amplitude" => of(time, |torque| &torque.disturbance_deviation);
    }
}

/// Speed and slip of the cage.
fn of_cage(
    table: &mut Columns<f64>,
    cage: Option<&cage::Estimate>,
    shaft: Option<&shaft::Estimate>,
) {
    let of = |time: &f64, values: fn(&CageSpeed) -> &[f64]| {
        cage.map_or(f64::NAN, |cage| {
            at(*time, &cage.told.time, values(&cage.told))
        })
    };
    // the slip is smooth where the shaft's speed has kinks: the cage's speed is that of the row's shaft with its slip
    let motion = |time: &f64| {
        let ratio = cage?.rolling_ratio;
        let slip = of(time, |cage| &cage.slip);
        let motion = shaft?.speed.at(*time);
        (slip.is_finite()).then_some((ratio, slip, motion))
    };
    columns! { table, |time|
        "cage.speed": "rad/s", "speed of the cage" => match motion(time) {
            Some((ratio, slip, motion)) => ratio * motion.speed * (1.0 - slip),
            None => of(time, |cage| &cage.speed),
        };
        "cage.speed_deviation": "rad/s", "standard deviation of that speed" => match motion(time) {
            Some((ratio, slip, motion)) => {
                let own = ratio * motion.speed * of(time, |cage| &cage.slip_deviation);
                own.hypot(ratio * (1.0 - slip) * motion.speed_uncertainty())
            }
            None => of(time, |cage| &cage.deviation),
        };
        "cage.slip": "1", "slip of the cage: 0 where it rolls, 1 where it rests" => of(time, |cage| &cage.slip);
        "cage.slip_deviation": "1", "standard deviation of that slip" => of(time, |cage| &cage.slip_deviation);
    }
}

/// An order of the vibration, with its times.
fn of_order(
    table: &mut Columns<f64>,
    (name, order, unit): (&str, f64, &'static str),
    found: Option<(&Vec<f64>, &Order)>,
) {
    let amplitude = found.map(|(_, order)| order.amplitude());
    let of = |time: &f64, values: Option<&Vec<f64>>| match found.zip(values) {
        Some(((times, _), values)) => at(*time, times, values),
        None => f64::NAN,
    };
    columns! { table, |time|
        "vibration.order_{name}_amplitude": unit, "amplitude of order {order} of the vibration, peak" => of(time, amplitude.as_ref());
        "vibration.order_{name}_deviation": unit, "standard deviation of the amplitude of order {order} of the vibration, peak"
            => of(time, found.map(|(_, order)| &order.deviation));
    }
}

/// Rows at equal times over all that was read, and closer ones around a quick change.
fn times(asked: &Request, found: &Estimate) -> Vec<f64> {
    let mut spans = Vec::new();
    for signal in [&asked.speed, &asked.cage].into_iter().flatten() {
        match signal {
            Signal::Sampled(series) => spans.push((series.first, series.last())),
            Signal::Stamped(stamps) => {
                if let (Some(first), Some(last)) = (stamps.times.first(), stamps.times.last()) {
                    spans.push((*first, *last));
                }
            }
        }
    }
    spans.extend(
        asked
            .torque
            .iter()
            .chain(&asked.vibration)
            .map(|series| (series.first, series.last())),
    );
    let first = spans
        .iter()
        .map(|span| span.0)
        .fold(f64::INFINITY, f64::min);
    let last = spans
        .iter()
        .map(|span| span.1)
        .fold(f64::NEG_INFINITY, f64::max);
    if last.partial_cmp(&first) != Some(std::cmp::Ordering::Greater) {
        return Vec::new();
    }
    let grid = |from: f64, to: f64, rows: usize| {
        (0..=rows).map(move |k| from + (to - from) * k as f64 / rows as f64)
    };
    let mut times: Vec<f64> = grid(first, last, ROWS).collect();
    if let Some(change) = found.shaft.as_ref().and_then(|shaft| shaft.speed.change) {
        let begin = change.engagement.0;
        let length = change.end.map_or(0.1, |end| end.0 - begin).max(1e-3);
        let (from, to) = (
            (begin - length).max(first),
            (begin + 4.0 * length).min(last),
        );
        if to > from {
            times.extend(grid(from, to, ROWS_OF_CHANGE));
        }
    }
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

/// The one of two neighbouring times, by its index, that is on the same side of a jump between them.
fn beside_a_jump(time: f64, jump: f64, times: &[f64]) -> Option<usize> {
    let next = times.partition_point(|t| *t <= time);
    let (before, after) = (next.checked_sub(1)?, next);
    let between = times[before] < jump && jump <= *times.get(after)?;
    between.then_some(if time < jump { before } else { after })
}

/// Value at a time among times that rise; not-a-number outside.
fn at(time: f64, times: &[f64], values: &[f64]) -> f64 {
    interpolation::between(times, values, time).unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_beside_a_jump_takes_the_value_of_its_side() {
        let times = [0.0, 1.0, 2.0];
        assert_eq!(beside_a_jump(1.2, 1.5, &times), Some(1));
        assert_eq!(beside_a_jump(1.5, 1.5, &times), Some(2));
        assert_eq!(beside_a_jump(1.9, 1.5, &times), Some(2));
        // none between its neighbours, and beyond the ends
        for time in [0.5, -1.0, 2.5] {
            assert_eq!(beside_a_jump(time, 1.5, &times), None);
        }
    }
}
