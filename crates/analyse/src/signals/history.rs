//! The history of a measurement: what was read beside what it means.

use crate::signals::asked::{Asked, Signal};
use crate::signals::found::Found;
use measure::speed::Motion;
use outcome::Column;
use statistics::interpolation;

/// Rows of a history at equal times.
const ROWS: usize = 4000;
/// Rows more around a quick change.
const ROWS_OF_CHANGE: usize = 1500;

/// Channels over time.
pub(crate) fn columns(asked: &Asked, found: &Found) -> Vec<Column> {
    let times = times(asked, found);
    let mut columns = vec![Column {
        name: "time".to_string(),
        unit: "s",
        meaning: "time on the clock of the file".to_string(),
        values: times.clone(),
    }];
    let mut add = |name: &str, unit, meaning: &str, value: &dyn Fn(f64) -> f64| {
        columns.push(Column {
            name: name.to_string(),
            unit,
            meaning: meaning.to_string(),
            values: times.iter().map(|&time| value(time)).collect(),
        });
    };
    if let Some(shaft) = &found.shaft {
        let motions: Vec<Motion> = times.iter().map(|&time| shaft.speed.at(time)).collect();
        let (first, last) = (shaft.watched.0, shaft.told_until());
        let row = |time: f64| {
            times
                .partition_point(|t| *t < time)
                .min(times.len().saturating_sub(1))
        };
        let of = |time: f64, value: &dyn Fn(&Motion) -> f64| match motions.get(row(time)) {
            Some(motion) if time >= first && time <= last => value(motion),
            _ => f64::NAN,
        };
        let (name, meaning) = match shaft.pulses() {
            Ok(_) => (
                "shaft.pulse_speed",
                "pitch over the time between the pulses around, as raw as pulses are",
            ),
            Err(_) => ("shaft.reading", "speed as the instrument shows it"),
        };
        add(name, "rad/s", meaning, &|t| shaft.raw_speed(t));
        add(
            "shaft.angle",
            "rad",
            "angle of the shaft from the first mark that passed; of a speed from the first value or the engagement on",
            &|t| of(t, &|m| m.angle),
        );
        add("shaft.speed", "rad/s", "speed of the shaft", &|t| {
            of(t, &|m| m.speed)
        });
        add(
            "shaft.speed_deviation",
            "rad/s",
            "standard deviation of that speed",
            &|t| of(t, &Motion::speed_uncertainty),
        );
        add(
            "shaft.acceleration",
            "rad/s^2",
            "acceleration of the shaft",
            &|t| of(t, &|m| m.acceleration),
        );
        add(
            "shaft.acceleration_deviation",
            "rad/s^2",
            "standard deviation of that acceleration",
            &|t| of(t, &Motion::acceleration_uncertainty),
        );
    }
    if let Some(series) = &asked.torque {
        let reading = |time: f64| {
            let place = (time - series.first) / series.interval;
            interpolation::at_index(&series.values, place).unwrap_or(f64::NAN)
        };
        add(
            "torque.reading",
            "N m",
            "reading of the torque sensor as it is",
            &reading,
        );
    }
    if let Some(torque) = found
        .torque
        .as_ref()
        .and_then(|found| found.torque.as_ref())
    {
        let of = |time: f64, values: &[f64]| at(time, &torque.time, values);
        let change = found.shaft.as_ref().and_then(|shaft| shaft.speed.change);
        let lock = change.and_then(|change| change.end).map(|end| end.0);
        let beside = |time: f64| lock.and_then(|lock| beside_a_jump(time, lock, &torque.time));
        add(
            "torque.torque",
            "N m",
            "torque that the sensor felt; at a lock it jumps",
            &|t| match beside(t) {
                Some(k) => torque.torque[k] + torque.rate[k] * (t - torque.time[k]),
                None => of(t, &torque.torque),
            },
        );
        add(
            "torque.deviation",
            "N m",
            "standard deviation of that torque",
            &|t| match beside(t) {
                Some(k) => torque.deviation[k],
                None => of(t, &torque.deviation),
            },
        );
        add(
            "torque.disturbance",
            "N m",
            "amplitude of the disturbance once a turn",
            &|t| of(t, &torque.disturbance),
        );
        add(
            "torque.disturbance_deviation",
            "N m",
            "standard deviation of that amplitude",
            &|t| of(t, &torque.disturbance_deviation),
        );
    }
    if let Some(seen) = &found.cage {
        let cage = &seen.told;
        let of = |time: f64, values: &[f64]| at(time, &cage.time, values);
        // the slip is smooth where the shaft's speed has kinks: the cage's speed is that of the row's shaft with its slip
        let motion = |time: f64| {
            let shaft = found.shaft.as_ref()?;
            let ratio = seen.rolling_ratio;
            let slip = of(time, &cage.slip);
            let motion = shaft.speed.at(time);
            (slip.is_finite()).then_some((ratio, slip, motion))
        };
        add(
            "cage.speed",
            "rad/s",
            "speed of the cage",
            &|t| match motion(t) {
                Some((ratio, slip, motion)) => ratio * motion.speed * (1.0 - slip),
                None => of(t, &cage.speed),
            },
        );
        add(
            "cage.speed_deviation",
            "rad/s",
            "standard deviation of that speed",
            &|t| match motion(t) {
                Some((ratio, slip, motion)) => {
                    let own = ratio * motion.speed * of(t, &cage.slip_deviation);
                    own.hypot(ratio * (1.0 - slip) * motion.speed_uncertainty())
                }
                None => of(t, &cage.deviation),
            },
        );
        add(
            "cage.slip",
            "1",
            "slip of the cage: 0 where it rolls, 1 where it rests",
            &|t| of(t, &cage.slip),
        );
        add(
            "cage.slip_deviation",
            "1",
            "standard deviation of that slip",
            &|t| of(t, &cage.slip_deviation),
        );
    }
    if let Some((part, found)) = found
        .vibration
        .as_ref()
        .and_then(|part| Some((part, part.orders.as_ref()?)))
    {
        for order in &found.orders {
            let amplitude = order.amplitude();
            // a point parts the names of a column
            let name = format!("vibration.order_{}", order.order).replacen('.', "\0", 1);
            let name = name.replace('.', "_").replace('\0', ".");
            let words = format!("of order {} of the vibration, peak", order.order);
            add(
                &format!("{name}_amplitude"),
                part.unit,
                &format!("amplitude {words}"),
                &|t| at(t, &found.time, &amplitude),
            );
            add(
                &format!("{name}_deviation"),
                part.unit,
                &format!("standard deviation of the amplitude {words}"),
                &|t| at(t, &found.time, &order.deviation),
            );
        }
    }
    columns
}

/// Rows at equal times over all that was read, and closer ones around a quick change.
fn times(asked: &Asked, found: &Found) -> Vec<f64> {
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
