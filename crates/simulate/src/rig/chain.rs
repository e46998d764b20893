//! From what happened on a rig to the values that its logger writes.
//!
//! ```text
//!   pickup, ball pass   angle ─ marks with errors ─ signal 0..1 ─ + noise ─ converter
//!   torque              reading of the arm y ─ (1 + e)(1 + c y²/range²) ─ + zero + drift ─ + noise ─ converter
//!   temperature         bead ─ + ambient ─ + noise ─ converter
//!   converter           channel k of K at k/f, then every K/f: rounded to its steps, clipped at its range
//! ```
//! The seed decides the places of marks and the noise; each channel has its own stream, so one that is taken away leaves the
//! others as they were.
//!
//! Does not model: hum, a filter before the converter, cross-talk between channels.

use model::sensor::Marks;
use model::system::rig::Tap;
use model::system::rig::layout::{ARM, CAGE_ANGLE, SHAFT, THERMOCOUPLE};
use model::system::rig::taps::multiplexed;
use scenario::{Rig, RigArm, RigPickupKind, RigProgram};
use statistics::random::Random;

/// Values of something at equal times.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Sampled {
    /// Time of the first, s.
    pub first: f64,
    /// Interval, s.
    pub interval: f64,
    /// The values.
    pub values: Vec<f64>,
}

impl Sampled {
    fn time(&self, index: usize) -> f64 {
        self.first + index as f64 * self.interval
    }
}

/// What happened, at the times at which each channel is taken.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Happened {
    /// Angle of the shaft, rad.
    pub shaft_angle: Sampled,
    /// Speed of the shaft at the same times, rad/s.
    pub shaft_speed: Sampled,
    /// Reading of the arm, N m.
    pub arm: Sampled,
    /// Angle of the cage, rad; empty where no sensor sees it.
    pub cage_angle: Sampled,
    /// Rise of the thermocouple, K.
    pub thermocouple: Sampled,
    /// When the shaft began to move, s: the drift of the zero begins there.
    pub begin: f64,
}

/// A channel of the raw file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RawChannel {
    /// Name with its group.
    pub name: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// What it is.
    pub description: String,
    /// Interval, s; none where the values are instants.
    pub interval: Option<f64>,
    /// The values.
    pub values: Vec<f64>,
    /// Number of values beyond the range of the converter.
    pub clipped: usize,
}

/// Whether the pickup has a channel of the converter, or a counter.
pub(crate) fn analog(rig: &Rig) -> bool {
    matches!(rig.pickup.kind, RigPickupKind::Analog { .. })
}

/// When the shaft begins to move, s.
pub(crate) fn begin(rig: &Rig) -> f64 {
    match rig.program {
        RigProgram::SpinUp { engage_at, .. } | RigProgram::RepeatAfterRest { engage_at, .. } => {
            engage_at
        }
        RigProgram::CoastDown { .. } | RigProgram::RampAndHold { .. } => 0.0,
    }
}

/// Everything that the logger writes.
pub(crate) fn raw(rig: &Rig, happened: &Happened) -> Vec<RawChannel> {
    let mut converted = vec![torque(rig, happened)];
    converted.extend(ball_pass(rig, happened));
    converted.push(temperature(rig, happened));
    let pickup = pickup(rig, happened);
    match rig.pickup.kind {
        RigPickupKind::Analog { .. } => converted.insert(0, pickup),
        // a counter has no turn among the channels of the converter
        RigPickupKind::Edges { .. } => converted.push(pickup),
    }
    converted
}

/// Streams of random numbers, one for each purpose.
#[derive(Clone, Copy)]
enum Stream {
    Marks = 1,
    Pickup,
    Torque,
    Balls,
    BallPass,
    Temperature,
}

/// Standard normal numbers of a stream.
fn normal(rig: &Rig, stream: Stream) -> impl FnMut() -> f64 {
    // streams far apart: golden-ratio steps of 2^64
    let seed = (rig.logger.seed).wrapping_add((stream as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let mut random = Random::new(seed);
    move || random.normal()
}

/// A converter channel over a range.
struct Converter {
    low: f64,
    high: f64,
    step: f64,
    clipped: usize,
}

impl Converter {
    fn over(low: f64, high: f64, bits: u32) -> Self {
        Converter {
            low,
            high,
            step: (high - low) / 2.0_f64.powi(bits as i32),
            clipped: 0,
        }
    }
    fn convert(&mut self, value: f64) -> f64 {
        // the highest code is one step below the end of the range
        let (least, most) = (self.low, self.high - self.step);
        if value < least || value > most {
            self.clipped += 1;
        }
        self.low + ((value.clamp(least, most) - self.low) / self.step).round() * self.step
    }
}

/// Height of a pulse, V, and range of the converter to both sides, V.
const PULSE: f64 = 5.0;
const VOLTS: f64 = 10.0;

/// A channel whose converter gets `signal` of each value.
fn converted(
    (name, unit): (&'static str, &'static str),
    description: String,
    of: &Sampled,
    mut converter: Converter,
    mut signal: impl FnMut(f64, f64) -> f64,
) -> RawChannel {
    let value = |(index, value): (usize, &f64)| converter.convert(signal(of.time(index), *value));
    let values = of.values.iter().enumerate().map(value).collect();
    RawChannel {
        name,
        unit,
        description,
        interval: Some(of.interval),
        values,
        clipped: converter.clipped,
    }
}

fn marks(count: usize, deviation: f64, mut normal: impl FnMut() -> f64) -> Marks {
    let errors: Vec<f64> = (0..count).map(|_| deviation * normal()).collect();
    Marks::new(&errors)
}

fn pickup(rig: &Rig, happened: &Happened) -> RawChannel {
    let wheel = marks(
        rig.pickup.marks,
        rig.pickup.mark_deviation,
        normal(rig, Stream::Marks),
    );
    let mut noise = normal(rig, Stream::Pickup);
    match rig.pickup.kind {
        RigPickupKind::Analog { noise: part } => converted(
            ("rig/tacho", "V"),
            format!("optical pickup, {} marks", rig.pickup.marks),
            &happened.shaft_angle,
            Converter::over(-VOLTS, VOLTS, rig.logger.bits),
            |_, angle| PULSE * (wheel.signal(angle) + part * noise()),
        ),
        RigPickupKind::Edges { stamp_deviation } => RawChannel {
            name: "rig/tacho",
            unit: "s",
            description: format!("instants of marks, {} a turn", rig.pickup.marks),
            interval: None,
            values: {
                let stamp = |time| time + stamp_deviation * noise();
                let mut stamps: Vec<f64> =
                    instants(happened, &wheel).into_iter().map(stamp).collect();
                // a counter writes its marks in order
                stamps.sort_by(f64::total_cmp);
                stamps
            },
            clipped: 0,
        },
    }
}

/// When the marks passed, s: the angle between two samples is a cubic through angle and speed. Forward motion only.
fn instants(happened: &Happened, wheel: &Marks) -> Vec<f64> {
    let (angle, speed) = (&happened.shaft_angle, &happened.shaft_speed);
    let mut instants = Vec::new();
    let Some(first) = angle.values.first() else {
        return instants;
    };
    // the first mark that is still to come
    let mut mark = (wheel.pitches(*first) + 0.25).floor() as i64 + 1;
    for k in 1..angle.values.len().min(speed.values.len()) {
        let cubic = Cubic::between(
            (angle.values[k - 1], speed.values[k - 1]),
            (angle.values[k], speed.values[k]),
            angle.interval,
        );
        while wheel.rise(mark) <= angle.values[k] {
            let part = cubic.reaches(wheel.rise(mark));
            instants.push(angle.time(k - 1) + part * angle.interval);
            mark += 1;
        }
    }
    instants
}

/// A cubic through two values with their slopes, over 0 to 1.
struct Cubic {
    start: (f64, f64),
    end: (f64, f64),
}

impl Cubic {
    fn between(start: (f64, f64), end: (f64, f64), interval: f64) -> Self {
        Cubic {
            start: (start.0, start.1 * interval),
            end: (end.0, end.1 * interval),
        }
    }
    fn at(&self, x: f64) -> f64 {
        let ((a, da), (b, db)) = (self.start, self.end);
        let y = 1.0 - x;
        a * (1.0 + 2.0 * x) * y * y + da * x * y * y + b * (3.0 - 2.0 * x) * x * x - db * x * x * y
    }
    /// Where a rising cubic reaches a value between its ends.
    fn reaches(&self, value: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        // 50 halvings: far below any counter
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if self.at(middle) < value {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
}

fn torque(rig: &Rig, happened: &Happened) -> RawChannel {
    let arm = &rig.arm;
    let mut noise = normal(rig, Stream::Torque);
    converted(
        ("rig/torque", "N m"),
        "torque arm".to_string(),
        &happened.arm,
        Converter::over(-arm.range, arm.range, rig.logger.bits),
        |time, reading| shown(arm, reading, time - happened.begin) + arm.noise * noise(),
    )
}

/// What the arm's gauges show of its reading, N m, so long after the shaft began to move, s.
fn shown(arm: &RigArm, reading: f64, since: f64) -> f64 {
    let share = reading / arm.range;
    let drift = arm.zero_drift * (1.0 - (-since.max(0.0) / arm.drift_time).exp());
    reading * (1.0 + arm.scale_error) * (1.0 + arm.curvature * share * share) + arm.zero + drift
}

fn ball_pass(rig: &Rig, happened: &Happened) -> Option<RawChannel> {
    let sensor = rig.ball_pass?;
    let balls = marks(
        rig.bearing.ball_count,
        sensor.place_deviation,
        normal(rig, Stream::Balls),
    );
    let mut noise = normal(rig, Stream::BallPass);
    Some(converted(
        ("rig/ball_pass", "V"),
        "sensor at the outer race".to_string(),
        &happened.cage_angle,
        Converter::over(-VOLTS, VOLTS, rig.logger.bits),
        |_, angle| PULSE * (balls.signal(angle) + sensor.noise * noise()),
    ))
}

/// Range of the thermocouple's amplifier, K.
const COLDEST: f64 = 223.15;
const HOTTEST: f64 = 473.15;

fn temperature(rig: &Rig, happened: &Happened) -> RawChannel {
    let node = &rig.temperature;
    let mut noise = normal(rig, Stream::Temperature);
    converted(
        ("rig/temperature", "K"),
        "thermocouple at the outer race".to_string(),
        &happened.thermocouple,
        Converter::over(COLDEST, HOTTEST, rig.logger.bits),
        |_, rise| node.ambient + rise + node.noise * noise(),
    )
}

/// What the converter samples: the channels in turn. A counter sees the shaft as often as a channel would; its speed beside
/// the angle gives what lies between.
pub(crate) fn taps(rig: &Rig) -> Vec<Tap> {
    let analog = analog(rig);
    let mut channels = Vec::new();
    if analog {
        channels.push(SHAFT.angle());
    }
    channels.push(ARM);
    if rig.ball_pass.is_some() {
        channels.push(CAGE_ANGLE);
    }
    channels.push(THERMOCOUPLE);
    let mut taps = multiplexed(&channels, rig.logger.total_rate);
    if !analog {
        let interval = taps[0].interval;
        taps.extend([SHAFT.angle(), SHAFT.spin()].map(|channel| Tap {
            channel,
            first: 0.0,
            interval,
        }));
    }
    taps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_converter_rounds_to_its_steps_and_counts_what_it_clips() {
        let mut converter = Converter::over(-10.0, 10.0, 14);
        let step = 20.0 / 16_384.0;
        assert!((converter.convert(1.0) - 1.0).abs() <= 0.5 * step);
        assert_eq!(converter.convert(11.0), 10.0 - step);
        assert_eq!(converter.convert(-10.5), -10.0);
        assert_eq!(converter.clipped, 2);
    }

    #[test]
    fn marks_of_an_even_acceleration_pass_when_they_should() {
        let (rate, interval, count) = (11_500.0, 1e-4, 130);
        let sampled = |of: &dyn Fn(f64) -> f64| Sampled {
            first: 0.0,
            interval,
            values: (0..count).map(|k| of(f64::from(k) * interval)).collect(),
        };
        let happened = Happened {
            shaft_angle: sampled(&|t| 0.5 * rate * t * t),
            shaft_speed: sampled(&|t| rate * t),
            ..Happened::default()
        };
        let wheel = Marks::new(&[0.0; 60]);
        let found = instants(&happened, &wheel);
        assert!(found.len() > 5);
        for (k, time) in found.iter().enumerate() {
            let angle = (k as f64 + 0.75) / 60.0 * std::f64::consts::TAU;
            // a parabola is a cubic: nothing but the halvings and rounding is left
            assert!((time - (2.0 * angle / rate).sqrt()).abs() < 1e-12, "{k}");
        }
    }
}
