//! Speed and acceleration of the shaft from the pulses of its pickup, or from a speed that an instrument shows.

use crate::signals::read::Series;
use crate::signals::request::Signal;
use measure::pulse::{
    Edges, Flank, Gap, Marks, Pitch, Pulses, Wheel, calibrate, check_marks, edges, number,
};
use measure::shaft::Shaft;
use measure::speed::{Instrument, Motion, Speed, SpeedSettings, Transient, smooth, smooth_channel};
use problem::{note, note::Note};
use scenario::{PickupFlank, PickupKind, SpeedSignal};
use statistics::interpolation;
use std::f64::consts::{PI, TAU};

/// Longest interval of the shaft's angle for other estimators, s: the angle between is a cubic through angle and speed.
const LONGEST_INTERVAL: f64 = 1e-3;
/// Shortest.
const SHORTEST_INTERVAL: f64 = 2e-4;
/// Most intervals, for each pulse and at least: a record of few pulses over hours has no motion in a millisecond.
const INTERVALS_PER_PULSE: usize = 256;
const FEWEST_INTERVALS: usize = 100_000;
/// Marks that would have passed behind the last one, had the shaft not stopped.
const SILENT_MARKS: f64 = 2.0;
/// Part by which the largest speed may differ from the one that was set: drives slip by some per cent, wheels differ by a mark.
const BESIDE_SET: f64 = 0.15;
/// Intervals of a record at which its largest values are looked for.
const LOOKS: usize = 4000;

/// The motion of the shaft.
pub(crate) struct Estimate {
    pub speed: Speed,
    /// What it was found from.
    pub seen: MotionSource,
    /// Where the acceleration is largest: in the quick change in its direction, by size where there is none.
    pub peak: Motion,
    /// Where the largest speed is.
    pub fastest: Motion,
    pub notes: Vec<Note>,
    /// Why the marks per revolution may be wrong.
    pub doubt: Option<Note>,
    /// First and last time that was watched, s.
    pub watched: (f64, f64),
    interval: f64,
    angle: Vec<f64>,
    rate: Vec<f64>,
    deviation: Vec<f64>,
}

/// What a motion was found from.
pub(crate) enum MotionSource {
    /// Marks that passed.
    Marks {
        pulses: Pulses,
        /// Errors of the wheel.
        pitch: Option<Pitch>,
    },
    /// A speed.
    Channel(Channel),
}

/// A speed that an instrument shows.
pub(crate) struct Channel {
    /// What it showed, rad/s.
    pub series: Series,
    /// Time by which it shows a steady change late, s: its delay and its time constant.
    pub late: f64,
    /// Standard deviation of the noise of one value, rad/s.
    pub noise: f64,
    /// Smallest step between values, rad/s; 0 where they come in none.
    pub step: f64,
    /// When a shaft that rests at the end was last seen to turn, s.
    stop: Option<f64>,
    /// Why a quick change may be the instrument's.
    pub doubt: Option<Note>,
}

/// A motion and what it was found from, before it is looked at.
struct Smoothed {
    speed: Speed,
    seen: MotionSource,
    notes: Vec<Note>,
    doubt: Option<Note>,
    watched: (f64, f64),
}

fn settings(wish: &SpeedSignal) -> SpeedSettings {
    SpeedSettings {
        transient: match wish.quick_change {
            true => match (wish.change_from, wish.change_to) {
                (Some(from), Some(to)) => Transient::Within(from, to),
                _ => Transient::Auto,
            },
            false => Transient::None,
        },
        wanted: wish.wanted,
        latency: wish.delay_deviation,
        ripple: wish.ripple,
    }
}

/// The motion by the marks of a wheel.
fn by_marks(
    signal: &Signal,
    wish: &SpeedSignal,
    watched: Option<(f64, f64)>,
) -> Result<Smoothed, String> {
    let words = |refusal: measure::pulse::Refusal| refusal.to_string();
    let found = passages(signal, wish, watched)?;
    let wheel = Wheel {
        marks: wish.marks_per_revolution,
        missing: wish.missing_marks,
    };
    let pulses = number(&found, &wheel).map_err(words)?;
    // A warning, not a refusal: two wheels on one shaft, or a wheel with equal parts, show another number too.
    let mut notes = Vec::new();
    let doubt = match check_marks(&pulses) {
        Marks::Contradicted(why) => Some(words(why).into()),
        // One mark or two have no pattern of their own.
        Marks::Unclear(why) if wish.marks_per_revolution > 2 && wish.set_speed.is_none() => {
            notes.push(note!(
                "the number of marks could not be checked: {}; the speed that was set would check it (signals.speed.set_speed)",
                why
            ));
            None
        }
        Marks::Unclear(_) | Marks::Shown => None,
    };
    let pitch = match wish.calibration {
        true => calibrate(&pulses)
            .map_err(|why| {
                notes.push(note!(
                    "the errors of the marks are not taken out: {}",
                    words(why)
                ))
            })
            .ok(),
        false => None,
    };
    let speed = smooth(&pulses, pitch.as_ref(), &settings(wish)).map_err(words)?;
    if let Some(odd) = pitch.as_ref().and_then(|pitch| pitch.odd) {
        notes.push(note!(
            "mark {} from the first one seen is out of line with the others; it is allowed for",
            odd
        ));
    }
    Ok(Smoothed {
        watched: pulses.watched,
        speed,
        seen: MotionSource::Marks { pulses, pitch },
        notes,
        doubt,
    })
}

/// The motion by a speed that an instrument shows.
fn by_channel(
    signal: &Signal,
    wish: &SpeedSignal,
    instrument: Instrument,
) -> Result<Smoothed, String> {
    let Signal::Sampled(series) = signal else {
        return Err(OTHER_KIND.to_string());
    };
    let asked = measure::speed::Channel {
        first: series.first,
        interval: series.interval,
        values: &series.values,
        instrument,
    };
    let shown = smooth_channel(&asked, &settings(wish)).map_err(|refusal| refusal.to_string())?;
    let lag = instrument
        .bandwidth
        .map_or(0.0, |bandwidth| 1.0 / (TAU * bandwidth));
    Ok(Smoothed {
        watched: (series.first, series.last()),
        seen: MotionSource::Channel(Channel {
            series: series.clone(),
            late: instrument.delay + lag,
            noise: shown.noise,
            step: shown.step,
            stop: shown.stop,
            doubt: shown.doubt,
        }),
        speed: shown.speed,
        notes: Vec::new(),
        doubt: None,
    })
}

impl Estimate {
    /// `watched`: time over which another channel was recorded, for instants that state none of their own.
    pub(super) fn of(
        signal: &Signal,
        wish: &SpeedSignal,
        watched: Option<(f64, f64)>,
    ) -> Result<Estimate, String> {
        let Smoothed {
            speed,
            seen,
            mut notes,
            doubt,
            watched,
        } = match wish.kind {
            PickupKind::Speed {
                bandwidth,
                delay,
                resolution,
                noise,
                ..
            } => {
                let instrument = Instrument {
                    bandwidth,
                    delay,
                    resolution,
                    noise,
                };
                by_channel(signal, wish, instrument)?
            }
            _ => by_marks(signal, wish, watched)?,
        };
        notes.splice(0..0, speed.notes.iter().cloned());
        let (first, last) = watched;
        let seen_values = match &seen {
            MotionSource::Marks { pulses, .. } => pulses.times.len(),
            MotionSource::Channel(channel) => channel.series.values.len(),
        };
        let most = (INTERVALS_PER_PULSE * seen_values).max(FEWEST_INTERVALS) as f64;
        let interval = ((last - first) / 20_000.0)
            .clamp(SHORTEST_INTERVAL, LONGEST_INTERVAL)
            .max((last - first) / most);
        let count = ((last - first) / interval).ceil() as usize + 1;
        let motions = (0..count).map(|k| speed.at(first + k as f64 * interval));
        let (mut angle, mut rate, mut deviation) = (Vec::new(), Vec::new(), Vec::new());
        for motion in motions {
            angle.push(motion.angle);
            rate.push(motion.speed);
            deviation.push(motion.speed_uncertainty());
        }
        let looked = |from: f64, to: f64, size: &dyn Fn(&Motion) -> f64| {
            let at = |k: usize| speed.at(from + (to - from) * k as f64 / LOOKS as f64);
            let known = |motion: &Motion| {
                let hidden = |gap: &Gap| motion.time > gap.from && motion.time < gap.to;
                !speed.gaps().any(hidden)
            };
            (0..=LOOKS)
                .map(at)
                .filter(known)
                .max_by(|a, b| size(a).total_cmp(&size(b)))
        };
        let range = speed.range();
        let change = speed
            .change
            .map(|change| (change.engagement.0, change.end.map_or(range.1, |end| end.0)));
        let peak = match change {
            // what swings back behind an engagement, or a release, is no part of the spin-up
            Some((from, to)) => {
                let way = 1.0_f64.copysign(speed.at(to).speed - speed.at(from).speed);
                looked(from, to, &|motion| way * motion.acceleration)
            }
            None => looked(range.0, range.1, &|motion| motion.acceleration.abs()),
        };
        let fastest = looked(range.0, range.1, &|motion| motion.speed.abs());
        let (Some(peak), Some(fastest)) = (peak, fastest) else {
            return Err("the record has no length".to_string());
        };
        Ok(Estimate {
            peak,
            fastest,
            notes,
            doubt,
            watched,
            interval,
            angle,
            rate,
            deviation,
            seen,
            speed,
        })
    }

    /// The shaft as other estimators take it.
    pub fn shaft(&self) -> Shaft<'_> {
        Shaft {
            first: self.watched.0,
            interval: self.interval,
            angle: &self.angle,
            speed: &self.rate,
            speed_deviation: &self.deviation,
        }
    }

    /// Last time at which a motion is known, s: a mark's time behind the last one; of a channel its last value.
    pub fn told_until(&self) -> f64 {
        let (pulses, watched) = match &self.seen {
            MotionSource::Marks { pulses, .. } => (pulses, self.watched.1),
            MotionSource::Channel(_) => return self.watched.1,
        };
        let Some(last) = pulses.times.last() else {
            return watched;
        };
        let speed = self.speed.at(*last).speed.abs();
        watched.min(last + SILENT_MARKS * pulses.pitch() / speed.max(f64::MIN_POSITIVE))
    }

    /// When a shaft that rests at the end was last seen to turn, s; of marks none.
    pub fn stop(&self) -> Option<f64> {
        match &self.seen {
            MotionSource::Channel(channel) => channel.stop,
            MotionSource::Marks { .. } => None,
        }
    }
    /// Angle without a sign of turning from which on the shaft counts as stopped, rad: some marks; of a channel none where it
    /// shows the rest, and any where it does not.
    pub fn silence(&self) -> f64 {
        match &self.seen {
            MotionSource::Marks { pulses, .. } => SILENT_MARKS * pulses.pitch(),
            MotionSource::Channel(channel) if channel.stop.is_some() => 0.0,
            MotionSource::Channel(_) => f64::INFINITY,
        }
    }

    /// The pulses, where marks were seen; else why there are none.
    pub fn pulses(&self) -> Result<&Pulses, String> {
        match &self.seen {
            MotionSource::Marks { pulses, .. } => Ok(pulses),
            MotionSource::Channel(_) => {
                Err("signals.speed.channel holds a speed, not marks".to_string())
            }
        }
    }

    /// Mean speed of the record, rad/s.
    pub fn mean_speed(&self) -> f64 {
        let (from, to) = self.speed.range();
        (self.speed.at(to).angle - self.speed.at(from).angle) / (to - from)
    }

    /// Largest error of a mark over the pitch.
    pub fn largest_mark_error(&self) -> Result<f64, String> {
        let pulses = self.pulses()?;
        match &self.seen {
            MotionSource::Marks {
                pitch: Some(pitch), ..
            } => {
                let sizes = pitch.errors.iter().map(|error| error.abs());
                Ok(sizes.fold(0.0, f64::max) / pulses.pitch())
            }
            _ => Err("the marks were not calibrated".to_string()),
        }
    }

    /// Speed between the two pulses around a time, or as the instrument shows it, rad/s; not-a-number outside them.
    pub fn raw_speed(&self, time: f64) -> f64 {
        match &self.seen {
            MotionSource::Marks { pulses, .. } => {
                let next = pulses.times.partition_point(|t| *t <= time);
                if next == 0 || next >= pulses.times.len() {
                    return f64::NAN;
                }
                let marks = (pulses.marks[next] - pulses.marks[next - 1]) as f64;
                marks * pulses.pitch() / (pulses.times[next] - pulses.times[next - 1])
            }
            MotionSource::Channel(Channel { series, .. }) => {
                interpolation::at_index(&series.values, (time - series.first) / series.interval)
                    .unwrap_or(f64::NAN)
            }
        }
    }

    /// What is odd of the largest speed beside the one that was set, where it is.
    pub fn beside_set(&self, wish: &SpeedSignal) -> Option<Note> {
        let set = wish.set_speed?;
        let ratio = self.fastest.speed.abs() / set;
        if (ratio - 1.0).abs() <= BESIDE_SET {
            return None;
        }
        let rpm = |speed: f64| (speed * 30.0 / PI * 10.0).round() / 10.0;
        let marks = wish.marks_per_revolution as f64 * ratio;
        let fits = match wish.kind {
            PickupKind::Speed { .. } => note!(
                "the unit of the channel (signals.speed.scale) or signals.speed.set_speed is wrong, or the test did not come there"
            ),
            _ if marks.round() >= 1.0 => note!(
                "{} marks per revolution instead of {} would fit (signals.speed.marks_per_revolution); else signals.speed.set_speed is wrong, or the test did not come there",
                marks.round(),
                wish.marks_per_revolution
            ),
            _ => note!("signals.speed.marks_per_revolution or signals.speed.set_speed is wrong"),
        };
        Some(note!(
            "the largest speed is {} rpm, and {} rpm were set, a ratio of {:.3}; {}",
            rpm(self.fastest.speed.abs()),
            rpm(set),
            ratio,
            fits
        ))
    }
}

/// What a channel that was read as another kind is refused with.
const OTHER_KIND: &str = "the channel was read as another kind than asked for";

fn passages(
    signal: &Signal,
    wish: &SpeedSignal,
    watched: Option<(f64, f64)>,
) -> Result<Edges, String> {
    let found = match (signal, wish.kind) {
        (Signal::Sampled(series), PickupKind::Analog { flank }) => edges(
            series.first,
            series.interval,
            &series.values,
            match flank {
                PickupFlank::Rising => Flank::Rising,
                PickupFlank::Falling => Flank::Falling,
                PickupFlank::Both => Flank::Both,
                PickupFlank::Centre => Flank::Centre,
            },
        ),
        (
            Signal::Stamped(stamps),
            PickupKind::Edges {
                stamp_deviation, ..
            },
        ) => Edges::stamped(
            stamps.times.clone(),
            stamp_deviation,
            around(stamps, watched),
        )
        .map(|mut edges| {
            if stamps.missing > 0 {
                edges.notes.push(note!(
                    "{} instants are no numbers and were left out",
                    stamps.missing
                ));
            }
            edges
        }),
        _ => return Err(OTHER_KIND.to_string()),
    };
    found.map_err(|refusal| refusal.to_string())
}

/// A recorded time that holds all instants.
fn around(
    stamps: &crate::signals::read::Stamps,
    watched: Option<(f64, f64)>,
) -> Option<(f64, f64)> {
    let (from, to) = watched?;
    let (first, last) = (stamps.times.first()?, stamps.times.last()?);
    Some((from.min(*first), to.max(*last)))
}
