//! Speed and acceleration of the shaft from the pulses of its pickup.

use crate::analyse::signals::asked::Signal;
use crate::scenario::{PickupFlank, PickupKind, SpeedSignal};
use measure::pulse::{
    EdgeSettings, Edges, Flank, Gap, Marks, Pitch, Pulses, Wheel, calibrate, check_marks, edges,
    number,
};
use measure::shaft::Shaft;
use measure::speed::{Motion, Speed, SpeedSettings, Transient, smooth};

/// Longest interval of the shaft's angle for other estimators, s: the angle between is a cubic through angle and speed.
const LONGEST_INTERVAL: f64 = 1e-3;
/// Shortest.
const SHORTEST_INTERVAL: f64 = 2e-4;
/// Most intervals, for each pulse and at least: a record of few pulses over hours has no motion in a millisecond.
const INTERVALS_PER_PULSE: usize = 256;
const FEWEST_INTERVALS: usize = 100_000;
/// Marks that would have passed behind the last one, had the shaft not stopped.
pub(crate) const SILENT_MARKS: f64 = 2.0;
/// Intervals of a record at which its largest values are looked for.
const LOOKS: usize = 4000;

/// The motion of the shaft.
pub(crate) struct Found {
    pub speed: Speed,
    pub pulses: Pulses,
    pub pitch: Option<Pitch>,
    /// Where the acceleration is largest: in the quick change in its direction, by size where there is none.
    pub peak: Motion,
    /// Where the largest speed is.
    pub fastest: Motion,
    pub notes: Vec<String>,
    /// Why the marks per revolution may be wrong.
    pub doubt: Option<String>,
    first: f64,
    interval: f64,
    angle: Vec<f64>,
    rate: Vec<f64>,
    deviation: Vec<f64>,
}

impl Found {
    /// `watched`: time over which another channel was recorded, for instants that tell none of their own.
    pub(super) fn of(
        signal: &Signal,
        wish: &SpeedSignal,
        watched: Option<(f64, f64)>,
    ) -> Result<Found, String> {
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
            Marks::Contradicted(why) => Some(words(why)),
            // One mark or two have no pattern of their own.
            Marks::Unclear(why) if wish.marks_per_revolution > 2 => {
                notes.push(format!("the number of marks could not be checked: {why}"));
                None
            }
            Marks::Unclear(_) | Marks::Shown => None,
        };
        let pitch = match wish.calibration {
            true => calibrate(&pulses)
                .map_err(|why| {
                    notes.push(format!("the errors of the marks are not taken out: {why}"))
                })
                .ok(),
            false => None,
        };
        let settings = SpeedSettings {
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
            ..SpeedSettings::default()
        };
        let speed = smooth(&pulses, pitch.as_ref(), &settings).map_err(words)?;
        notes.splice(0..0, speed.notes.iter().cloned());
        if let Some(odd) = pitch.as_ref().and_then(|pitch| pitch.odd) {
            notes.push(format!("mark {odd} from the first one seen is out of line with the others; it is allowed for"));
        }
        let (first, last) = pulses.watched;
        let most = (INTERVALS_PER_PULSE * pulses.times.len()).max(FEWEST_INTERVALS) as f64;
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
            let told = |motion: &Motion| {
                let hidden = |gap: &Gap| motion.time > gap.from && motion.time < gap.to;
                !speed.gaps().any(hidden)
            };
            (0..=LOOKS)
                .map(at)
                .filter(told)
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
        Ok(Found {
            peak,
            fastest,
            notes,
            doubt,
            first,
            interval,
            angle,
            rate,
            deviation,
            pulses,
            pitch,
            speed,
        })
    }

    /// The shaft as other estimators take it.
    pub fn shaft(&self) -> Shaft<'_> {
        Shaft {
            first: self.first,
            interval: self.interval,
            angle: &self.angle,
            speed: &self.rate,
            speed_deviation: &self.deviation,
        }
    }

    /// Last time at which the pulses tell of a motion, s: a mark's time behind the last one.
    pub fn told_until(&self) -> f64 {
        let watched = self.pulses.watched.1;
        let Some(last) = self.pulses.times.last() else {
            return watched;
        };
        let speed = self.speed.at(*last).speed.abs();
        watched.min(last + SILENT_MARKS * self.pulses.pitch() / speed.max(f64::MIN_POSITIVE))
    }

    /// Speed between the two pulses around a time, rad/s; not-a-number outside them.
    pub fn pulse_speed(&self, time: f64) -> f64 {
        let next = self.pulses.times.partition_point(|t| *t <= time);
        if next == 0 || next >= self.pulses.times.len() {
            return f64::NAN;
        }
        let marks = (self.pulses.marks[next] - self.pulses.marks[next - 1]) as f64;
        marks * self.pulses.pitch() / (self.pulses.times[next] - self.pulses.times[next - 1])
    }
}

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
            &EdgeSettings {
                flank: match flank {
                    PickupFlank::Rising => Flank::Rising,
                    PickupFlank::Falling => Flank::Falling,
                    PickupFlank::Both => Flank::Both,
                    PickupFlank::Centre => Flank::Centre,
                },
                ..EdgeSettings::default()
            },
        ),
        (Signal::Stamped(stamps), PickupKind::Edges { stamp_deviation }) => Edges::stamped(
            stamps.times.clone(),
            stamp_deviation,
            around(stamps, watched),
        )
        .map(|mut edges| {
            if stamps.missing > 0 {
                edges.notes.push(format!(
                    "{} instants are no numbers and were left out",
                    stamps.missing
                ));
            }
            edges
        }),
        _ => return Err("the channel was read as another kind than asked for".to_string()),
    };
    found.map_err(|refusal| refusal.to_string())
}

/// A recorded time that holds all instants.
fn around(
    stamps: &crate::analyse::signals::read::Stamps,
    watched: Option<(f64, f64)>,
) -> Option<(f64, f64)> {
    let (from, to) = watched?;
    let (first, last) = (stamps.times.first()?, stamps.times.last()?);
    Some((from.min(*first), to.max(*last)))
}
