//! The torque that a swinging sensor felt, from its reading.

use crate::signals::mains::hum;
use crate::signals::read::Series;
use crate::signals::warning_table::SignalsWarning;
use crate::signals::{design, shaft, spectrum};
use identify::signals::zero_at_rest;
use measure::converter::{Fault, faults};
use measure::spectrum::Spectrum;
use measure::torque_sensor::{
    Clipped, DesignError, Inversion, Sensor, Torque, identify_free_response, invert,
};
use outcome::Warning;
use problem::{note, note::Note};
use scenario::{Disturbance, SensorSource, TorqueSignal};
use statistics::uncertain::Uncertain;
use std::cmp::Ordering;
use std::f64::consts::TAU;

/// What its warnings concern.
pub(crate) const TORQUE: &str = "Torque";
/// Values at the ends that are left out without a word.
const FEW: usize = 2;
/// What a spectrum shows at least: so many times the frequency of the sensor, so many orders of the shaft.
const OF_SENSOR: f64 = 3.0;
const ORDERS: f64 = 4.0;
/// Damping ratio from which on nothing swings.
const NO_SWING: f64 = 1.0;

/// Values in a period of a sensor as quick as the record shows, and the damping at which its reading is flat up to there.
const IN_A_PERIOD: f64 = 2.001;
const FLAT: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Shortest rest whose mean is a zero, s, and the deviations of a stated zero beyond which that contradicts it.
const REST: f64 = 0.1;
const CONTRADICTS: f64 = 5.0;

/// Torque, and the reading it was found from.
pub(crate) struct Estimate {
    /// The torque; none where no sensor is known.
    pub torque: Option<Torque>,
    pub sensor: Option<Sensor>,
    /// Spectrum of the reading; why there is none.
    pub spectrum: Result<Spectrum, String>,
    pub notes: Vec<Note>,
    /// Error of the torque over the frequency of the sensor; why it is not known.
    pub design: Result<Vec<DesignError>, String>,
    /// Why a part of the torque is not told, its peak with it; none where all of it is.
    pub hidden: Option<String>,
    /// What contradicts what is stated of the sensor: with its code.
    pub doubts: Vec<Warning>,
}

/// Values that are not to be trusted.
pub(crate) struct Faulty {
    /// In words.
    pub told: Vec<Note>,
    pub clipped: usize,
    pub stuck: usize,
    pub missing: usize,
    reading: Vec<f64>,
    /// Where the reading is at a limit.
    cut: Vec<Clipped>,
    /// What it tells there, in words.
    at_limit: Option<String>,
}

/// Looks for values at the limits of the converter, held values and gaps, and takes them out.
pub(crate) fn faulty(series: &Series) -> Faulty {
    let mut reading = series.values.clone();
    let (mut counts, mut stretches, mut begins) = ([0; 3], [0; 3], [f64::NAN; 3]);
    let (low, high) = range(&series.values);
    let value = |index: usize| series.values.get(index).copied().unwrap_or(f64::NAN);
    let mut cut = Vec::new();
    for fault in faults(&series.values, series.converter.as_ref()) {
        let kind = match fault.fault {
            Fault::Clipped => 0,
            // A flat top is one, though nothing is known of the converter.
            Fault::Stuck if low < high && [low, high].contains(&value(fault.first)) => 0,
            Fault::Stuck => 1,
            Fault::Missing => 2,
        };
        if stretches[kind] == 0 {
            begins[kind] = series.time(fault.first);
        }
        if kind == 0 {
            let above = value(fault.first) > 0.5 * (low + high);
            cut.push(Clipped {
                first: fault.first,
                count: fault.count,
                limit: series.converter.map_or(value(fault.first), |converter| {
                    if above {
                        converter.highest
                    } else {
                        converter.lowest
                    }
                }),
                above,
            });
        }
        counts[kind] += fault.count;
        stretches[kind] += 1;
        let end = (fault.first + fault.count).min(reading.len());
        if let Some(part) = reading.get_mut(fault.first..end) {
            part.fill(f64::NAN);
        }
    }
    let words = [
        "at the limit of the converter (clipped)",
        "held without noise (stuck)",
        "no numbers (missing)",
    ];
    let told = (0..3).filter(|&kind| counts[kind] > 0).map(|kind| {
        note!(
            "{} of {} values are {}, in {} stretches, the first at {:.6} s; they are not used",
            counts[kind],
            series.values.len(),
            words[kind],
            stretches[kind],
            begins[kind]
        )
    });
    let furthest =
        (cut.iter().map(|part| part.limit)).reduce(|a, b| if b.abs() > a.abs() { b } else { a });
    let at_limit = furthest.map(|limit| {
        format!(
            "the reading is clipped at {:.4} N mm in {} stretches, the first at {:.6} s",
            1e3 * limit,
            stretches[0],
            begins[0]
        )
    });
    Faulty {
        told: told.collect(),
        cut,
        at_limit,
        clipped: counts[0],
        stuck: counts[1],
        missing: counts[2],
        reading,
    }
}

impl Faulty {
    /// The reading without what is not to be trusted.
    pub fn reading(&self) -> &[f64] {
        &self.reading
    }

    /// What is at a limit of the part between two indices, counted from the first.
    fn cut(&self, from: usize, to: usize) -> Vec<Clipped> {
        let parts = self.cut.iter().filter_map(|part| {
            let (begin, end) = (part.first.max(from), (part.first + part.count).min(to));
            (begin < end).then(|| Clipped {
                first: begin - from,
                count: end - begin,
                ..*part
            })
        });
        parts.collect()
    }

    /// Why a mean of the torque between two times, s, would be false; none where nothing is clipped there.
    pub fn cut_between(&self, series: &Series, from: f64, to: f64) -> Option<String> {
        let inside = |part: &Clipped| {
            let last = part.first + part.count.max(1) - 1;
            series.time(part.first) <= to && series.time(last) >= from
        };
        let why = self.at_limit.as_ref()?;
        self.cut
            .iter()
            .any(inside)
            .then(|| format!("{why}: a mean of what is left would be false there"))
    }
}

/// Lowest and highest of the values that are numbers.
fn range(values: &[f64]) -> (f64, f64) {
    let known = values.iter().copied().filter(|v| v.is_finite());
    known.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| {
        (l.min(v), h.max(v))
    })
}

impl Estimate {
    pub(crate) fn of(
        series: &Series,
        faulty: &Faulty,
        wish: &TorqueSignal,
        tap: Option<&Series>,
        shaft: Option<&shaft::Estimate>,
    ) -> Result<Estimate, String> {
        let (mut notes, mut doubts) = (Vec::new(), Vec::new());
        let sensor = sensor(wish, tap, &mut notes)?;
        let torque = match sensor {
            Some(sensor) => {
                let told = (&mut notes, &mut doubts);
                Some(inverted(series, faulty, wish, sensor, shaft, told)?)
            }
            None => {
                notes.push(note!(
                    "neither sensor_frequency nor tap_file is given: the reading is shown as it is, the swing of the sensor in it"
                ));
                None
            }
        };
        let swing = sensor.map_or(0.0, |sensor| OF_SENSOR * sensor.frequency.value);
        let turns = shaft.map_or(0.0, |shaft| ORDERS * shaft.fastest.speed.abs() / TAU);
        let untold = |torque: &Torque| torque.torque.iter().any(|value| value.is_nan());
        let hidden = (faulty.at_limit.as_ref())
            .filter(|_| torque.as_ref().is_some_and(untold))
            .map(|why| {
                format!(
                    "{why}: the true one is there or beyond, by an unknown amount, and so is the largest torque"
                )
            });
        Ok(Estimate {
            hidden,
            doubts,
            design: design::errors(wish, torque.as_ref(), sensor, shaft),
            torque,
            sensor,
            spectrum: spectrum::of(
                &faulty.reading,
                series.interval,
                wish.highest_frequency,
                swing.max(turns),
            ),
            notes,
        })
    }
}

fn sensor(
    wish: &TorqueSignal,
    tap: Option<&Series>,
    notes: &mut Vec<Note>,
) -> Result<Option<Sensor>, String> {
    match (&wish.sensor, tap) {
        (
            Some(SensorSource::Given {
                sensor_frequency,
                frequency_deviation,
                damping_ratio,
                damping_deviation,
            }),
            _,
        ) => {
            if *damping_ratio >= NO_SWING {
                notes.push(note!(
                    "a damping ratio of {} is that of a sensor that does not swing, as hardly a torque arm is: one that is too large shows torques that were not; a tap would measure it (signals.torque.tap_file)",
                    damping_ratio
                ));
            }
            Ok(Some(Sensor {
                frequency: Uncertain::new(
                    *sensor_frequency,
                    sensor_frequency * frequency_deviation,
                ),
                damping_ratio: Uncertain::new(*damping_ratio, damping_ratio * damping_deviation),
            }))
        }
        (Some(SensorSource::Tap { tap_start, .. }), Some(tap)) => {
            let start = tap_start.map(|start| (start / tap.interval).ceil() as usize);
            let response =
                identify_free_response(&tap.values, tap.interval, start).map_err(|why| {
                    let told = if start.is_none() {
                        "; signals.torque.tap_start says from where on the sensor swings freely"
                    } else {
                        ""
                    };
                    format!(
                        "the tap does not identify the sensor: {}, {why}{told}",
                        tap.name
                    )
                })?;
            notes.extend(
                response
                    .notes
                    .into_iter()
                    .map(|note| note!("tap: {}", note)),
            );
            Ok(Some(response.sensor))
        }
        _ => Ok(None),
    }
}

/// A sensor as quick as the record shows: a quicker one follows at once, and its reading is the torque up to there.
fn resolved(sensor: Sensor, interval: f64, notes: &mut Vec<Note>) -> Sensor {
    let most = 1.0 / (IN_A_PERIOD * interval);
    if sensor.frequency.value <= most {
        return sensor;
    }
    notes.push(note!(
        "the sensor of {:.0} Hz is quicker than {:.0} values a second show: it is taken to follow at once, and a torque that changes within {:.0} ms is smeared; nothing is known of its swing after a sudden change",
        sensor.frequency.value, 1.0 / interval, 2e3 * IN_A_PERIOD * interval
    ));
    Sensor {
        frequency: Uncertain::exact(most),
        damping_ratio: Uncertain::exact(FLAT),
    }
}

/// Time after which a sensor swings by less than a hundredth of what it did, s.
fn settling_time(sensor: &Sensor) -> f64 {
    let decay = sensor.damping_ratio.value.min(1.0) * TAU * sensor.frequency.value;
    (100.0_f64.ln() / decay).min(1.0)
}

/// Mean of the readings before the engagement with its deviation; none of a short rest.
fn resting<'a>(readings: impl Iterator<Item = &'a f64>, interval: f64) -> Option<Uncertain> {
    let known: Vec<f64> = readings.copied().filter(|v| v.is_finite()).collect();
    let count = known.len() as f64;
    if count * interval < REST || known.len() < 8 {
        return None;
    }
    let mean = known.iter().sum::<f64>() / count;
    let square = known.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / count;
    Some(Uncertain::new(mean, square.sqrt()))
}

fn inverted(
    series: &Series,
    faulty: &Faulty,
    wish: &TorqueSignal,
    sensor: Sensor,
    shaft: Option<&shaft::Estimate>,
    (notes, doubts): (&mut Vec<Note>, &mut Vec<Warning>),
) -> Result<Torque, String> {
    let (stated, sensor) = (sensor, resolved(sensor, series.interval, notes));
    let turning = shaft
        .filter(|_| wish.disturbance != Disturbance::None)
        .map(shaft::Estimate::shaft);
    // the part that the shaft covers
    let (mut from, mut to) = (0, series.values.len());
    if let Some(shaft) = &turning {
        let inside = |time: f64| shaft.covers(time);
        from = (0..to).find(|&k| inside(series.time(k))).unwrap_or(to);
        to = (from..to)
            .rev()
            .find(|&k| inside(series.time(k)))
            .map_or(from, |k| k + 1);
        let left = series.values.len() - (to - from);
        if left > FEW {
            notes.push(note!(
                "{} values outside the record of the pickup are not used",
                left
            ));
        }
    } else if wish.disturbance != Disturbance::None && shaft.is_none() {
        notes.push(note!(
            "the speed of the shaft is not known: its disturbance once a turn stays in the torque"
        ));
    }
    let reading = faulty.reading.get(from..to).unwrap_or(&[]);
    let (low, high) = range(reading);
    let change = shaft
        .and_then(|shaft| shaft.speed.change)
        .filter(|change| change.from_rest);
    let cut = faulty.cut(from, to);
    // Where nothing is known of the zero, all of the reading may be one.
    let span = (high - low).max(high.abs()).max(low.abs());
    let mut zero = Uncertain::new(0.0, wish.zero_deviation.unwrap_or(span));
    let times: Vec<f64> = (from..to).map(|k| series.time(k)).collect();
    let settled = (shaft.and_then(shaft::Estimate::stop)).map(|stop| stop + settling_time(&stated));
    // what of the reading is of a shaft that rests: before the change, or behind a stop
    let rests = match (change, settled) {
        (Some(change), _) => {
            let end = change.engagement.0 - 3.0 * change.engagement.1;
            &reading[..times.partition_point(|time| *time < end)]
        }
        (None, Some(settled)) => &reading[times.partition_point(|time| *time < settled)..],
        (None, None) => &[],
    };
    let rest = match (change, settled) {
        (Some(_), _) => resting(rests.iter(), series.interval),
        (None, settled) => settled.and_then(|settled| zero_at_rest(&times, reading, settled)),
    };
    if let (Some(rest), Some(stated)) = (rest, wish.zero_deviation)
        && wish.disturbance != Disturbance::RunOut
        && rest.value.abs() > CONTRADICTS * stated.hypot(rest.deviation)
    {
        let note = note!(
            "while the shaft rests the reading is {:.4} N mm, which is {:.0} times the zero_deviation stated, {:.4} N mm: the zero has moved, or a run-out holds it (signals.torque.disturbance = \"run-out\"); the rest counts",
            1e3 * rest.value,
            rest.value.abs() / stated,
            1e3 * stated
        );
        let about = TORQUE.to_string();
        doubts.push(SignalsWarning::Zero { about, note }.into());
        zero.deviation = stated.hypot(rest.value);
    }
    let mut of_zero = "is as given";
    if let (Some(rest), None) = (rest, change)
        && rest.deviation < zero.deviation
    {
        zero = rest;
        of_zero = "is that of the rest behind it";
    }
    let input = Inversion {
        sensor,
        first: series.time(from),
        interval: series.interval,
        reading,
        clipped: &cut,
        shaft: turning,
        engagement: change.map(|change| Uncertain::new(change.engagement.0, change.engagement.1)),
        lock: change
            .and_then(|change| change.end)
            .map(|(time, deviation)| Uncertain::new(time, deviation)),
        zero,
        scale_deviation: wish.scale_deviation,
        disturbance_power: match wish.disturbance {
            Disturbance::Auto | Disturbance::None => None,
            Disturbance::Unbalance => Some(2.0),
            Disturbance::RunOut => Some(0.0),
        },
    };
    if !input.rests_at_first() && wish.zero_deviation.is_none() && rest.is_none() {
        notes.push(note!(
            "the shaft does not rest at first and zero_deviation is not given: the zero of the reading is not known"
        ));
    }
    if let (Some(why), true) = (
        &faulty.at_limit,
        high.partial_cmp(&low) != Some(Ordering::Greater),
    ) {
        return Err(format!(
            "{why}, and nothing that changes is left of the reading beside it"
        ));
    }
    if !input.rests_at_first() {
        notes.push(note!("the zero of the reading {}", of_zero));
    }
    let mut torque = invert(&input)?;
    notes.extend(torque.notes.iter().cloned());
    doubts.extend(torque.shown_frequency.map(|shown| {
        let hum = hum(shown, rests, series.interval);
        let note = match hum {
            Some(amplitude) => note!(
                "the reading swings at {:.1} Hz, by {:.3} N mm while the shaft rests as well: a hum of the mains, not the ringing of the sensor, which is {:.1} Hz as stated; the torque keeps its mean, its band is wider; look to the shield and the earth of the cable",
                shown, 1e3 * amplitude, sensor.frequency.value
            ),
            None => note!(
                "after the engagement the reading rings at {:.1} Hz, and {:.1} Hz is stated of the sensor (signals.torque.sensor_frequency): the torque while it rings is that of the one stated; a tap tells which is right (signals.torque.tap_file)",
                shown, sensor.frequency.value
            ),
        };
        let about = TORQUE.to_string();
        Warning::from(SignalsWarning::Ringing { about, note })
    }));
    if turning.is_none() && wish.disturbance != Disturbance::None {
        torque.hold_what_swings();
        notes.push(note!(
            "the band of the torque holds what swings in it within half a second: a disturbance once a turn may be a part of that"
        ));
    }
    Ok(torque)
}
