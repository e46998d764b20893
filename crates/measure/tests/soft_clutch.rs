//! Clutches that do not give the smooth bells of `speed_coverage.rs`: a torque that rises evenly from nothing and ends with
//! the lock, an even one, one that breaks away before it rises, one that begins with the square of time, one that is doubled.
//!
//! The acceleration jumps at the lock, and what the shaft does before its first marks is hidden: with 60 marks it takes a
//! fifth to a third of the spin-up until the first one comes. The band of the engagement must say so.

use std::f64::consts::TAU;

use crate::synthetic::wheel::Random;
use measure::pulse::{Edges, Wheel, number};
use measure::speed::{Speed, SpeedSettings, smooth};

/// Acceleration over the engagement, as a part of its peak; both from 0 to 1.
type Shape = fn(f64) -> f64;

/// A torque that rises evenly from nothing and ends with the lock.
const RAMP: Shape = |x| x;
/// An even torque.
const EVEN: Shape = |_| 1.0;
/// A torque that breaks away, then rises.
const BREAKS_AWAY: Shape = |x| 0.2 + 0.8 * x;
/// A torque that begins with the square of time.
const LATE: Shape = |x| x * x;

/// A torque that is doubled halfway.
const DOUBLED: Shape = |x| if x < 0.5 { 0.5 } else { 1.0 };

/// A motor that follows an even ramp with a lag of a fiftieth of its length, at both ends.
const LAGS: Shape = |x| {
    let run = |x: f64| 1.0 - (-50.0 * x).exp();
    if x < 0.9 {
        run(x)
    } else {
        run(0.9) * (-50.0 * (x - 0.9)).exp()
    }
};

/// Speed that is reached, rad/s.
const REACHED: f64 = 150.0;

/// A wheel and how long the clutch slips.
#[derive(Clone, Copy)]
struct Rig {
    marks: usize,
    /// Slip of the clutch, s.
    length: f64,
    /// Noise of the instants, s.
    noise: f64,
    /// Speed before the engagement, rad/s.
    before: f64,
}

const RIGS: [Rig; 5] = [
    rig(60, 0.228, 5e-6),
    rig(60, 0.0414, 5e-6),
    rig(60, 0.0259, 5e-6),
    rig(12, 0.228, 5e-6),
    rig(360, 0.0259, 3e-7),
];

const fn rig(marks: usize, length: f64, noise: f64) -> Rig {
    Rig {
        marks,
        length,
        noise,
        before: 0.0,
    }
}

/// A spin-up whose angle, speed and acceleration are known at any time.
struct Truth {
    engage: f64,
    lock: f64,
    peak: f64,
    start: f64,
    before: f64,
    /// Acceleration, gain of speed and angle over the engagement at equal parts of it, peak and length one.
    table: Vec<[f64; 3]>,
}

const PARTS: usize = 20_000;

impl Truth {
    fn new(shape: Shape, rig: &Rig, r: &mut Random) -> Truth {
        let h = 1.0 / PARTS as f64;
        let mut table = vec![[shape(0.0), 0.0, 0.0]];
        for k in 1..=PARTS {
            let [a, v, x] = table[k - 1];
            let next = shape(k as f64 * h);
            let speed = v + 0.5 * h * (a + next);
            table.push([next, speed, x + h * v + h * h * (2.0 * a + next) / 6.0]);
        }
        let engage = 0.2 + 0.05 * r.uniform();
        Truth {
            engage,
            lock: engage + rig.length,
            peak: (REACHED - rig.before) / (table[PARTS][1] * rig.length),
            start: TAU * r.uniform(),
            before: rig.before,
            table,
        }
    }

    /// Angle, speed, acceleration.
    fn at(&self, time: f64) -> [f64; 3] {
        let length = self.lock - self.engage;
        let x = (time - self.engage) / length;
        let along = self.start + self.before * time;
        if x <= 0.0 {
            return [along, self.before, 0.0];
        }
        let place = x.min(1.0) * PARTS as f64;
        let (k, u) = (place as usize, place.fract());
        let (a, b) = (self.table[k], self.table[(k + 1).min(PARTS)]);
        let mix = |i: usize| a[i] + u * (b[i] - a[i]);
        let gain = mix(1) * self.peak * length;
        [
            along + mix(2) * self.peak * length * length + gain * (time - self.lock).max(0.0),
            self.before + gain,
            if x < 1.0 { mix(0) * self.peak } else { 0.0 },
        ]
    }

    fn passing(&self, angle: f64, end: f64) -> Option<f64> {
        if self.at(end)[0] < angle {
            return None;
        }
        let (mut low, mut high) = (0.0, end);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.at(middle)[0] < angle {
                low = middle
            } else {
                high = middle
            }
        }
        Some(high)
    }
}

fn estimate(shape: Shape, rig: &Rig, seed: u64) -> (Truth, Speed) {
    let mut r = Random::new(seed ^ 0x50f7);
    let truth = Truth::new(shape, rig, &mut r);
    let pitch = TAU / rig.marks as f64;
    let end = truth.lock + 0.4;
    let first = (truth.start / pitch).floor() as i64 + 1;
    let times: Vec<f64> = (first..)
        .map_while(|mark| truth.passing(mark as f64 * pitch, end))
        .map(|t| t + rig.noise * r.normal())
        .collect();
    let found = Edges::stamped(times, rig.noise, Some((0.0, end))).unwrap();
    let wheel = Wheel {
        marks: rig.marks,
        missing: 0,
    };
    let pulses = number(&found, &wheel).unwrap();
    let speed = smooth(&pulses, None, &SpeedSettings::default()).unwrap();
    (truth, speed)
}

/// Parts of instants, or of spin-ups, whose truth lies within two standard deviations, and errors as parts of length and peak.
#[derive(Clone, Copy, Debug, Default)]
struct Score {
    speed: f64,
    acceleration: f64,
    engagement: f64,
    engagement_error: f64,
    engagement_band: f64,
    peak_error: f64,
    rms_error: f64,
}

/// Instants in the slip and a quarter of it beyond, at which the band is asked.
const POINTS: usize = 60;

fn score(shape: Shape, rig: &Rig, seed: u64) -> Score {
    let (truth, speed) = estimate(shape, rig, seed);
    let change = speed.change.unwrap();
    let error = change.engagement.0 - truth.engage;
    let mut score = Score {
        engagement: f64::from(u8::from(error.abs() < 2.0 * change.engagement.1)),
        engagement_error: error.abs() / rig.length,
        engagement_band: change.engagement.1 / rig.length,
        ..Score::default()
    };
    let (mut square, mut within) = (0.0, 0.0);
    for k in 0..POINTS {
        let time = truth.engage + 1.25 * rig.length * (k as f64 + 0.5) / POINTS as f64;
        let (motion, wanted) = (speed.at(time), truth.at(time));
        let off = motion.acceleration - wanted[2];
        let inside =
            |off: f64, band: f64| f64::from(u8::from(off.abs() < 2.0 * band)) / POINTS as f64;
        score.speed += inside(motion.speed - wanted[1], motion.speed_uncertainty());
        score.acceleration += inside(off, motion.acceleration_uncertainty());
        if time < truth.lock {
            square += off * off;
            within += 1.0;
        }
    }
    let top = (0..=1000)
        .map(|k| truth.engage + rig.length * f64::from(k) / 1000.0)
        .fold(0.0f64, |top, time| top.max(speed.at(time).acceleration));
    score.peak_error = (top / truth.peak - 1.0).abs();
    score.rms_error = (square / within).sqrt() / truth.peak;
    score
}

/// Spin-ups of each rig. The whole number is run in a release build with `AUXBEAR_SEEDS=400`.
fn seeds() -> u64 {
    std::env::var("AUXBEAR_SEEDS")
        .ok()
        .and_then(|seeds| seeds.parse().ok())
        .unwrap_or(6)
}

/// Least parts inside the band, of instants and of engagements.
struct Promise {
    instants: f64,
    engagements: f64,
    /// Most of the medians of both errors.
    errors: f64,
}

fn covers(name: &str, shape: Shape, rigs: &[Rig], promise: &Promise) {
    for rig in rigs {
        let scores: Vec<Score> = (0..seeds()).map(|seed| score(shape, rig, seed)).collect();
        let mean = |of: fn(&Score) -> f64| scores.iter().map(of).sum::<f64>() / scores.len() as f64;
        let median = |of: fn(&Score) -> f64| {
            let mut values: Vec<f64> = scores.iter().map(of).collect();
            values.sort_by(f64::total_cmp);
            values[values.len() / 2]
        };
        let (speed, acceleration, engagement) = (
            mean(|s| s.speed),
            mean(|s| s.acceleration),
            mean(|s| s.engagement),
        );
        let (peak, rms) = (median(|s| s.peak_error), median(|s| s.rms_error));
        println!(
            "{name}, {} marks, {:.0} ms: inside speed {:.1} %, acceleration {:.1} %, engagement {:.1} %; medians: engagement off {:.2} %, band {:.2} % of the slip, peak {:.2} %, rms {:.2} %",
            rig.marks,
            1e3 * rig.length,
            100.0 * speed,
            100.0 * acceleration,
            100.0 * engagement,
            100.0 * median(|s| s.engagement_error),
            100.0 * median(|s| s.engagement_band),
            100.0 * peak,
            100.0 * rms
        );
        assert!(
            speed >= promise.instants && acceleration >= promise.instants,
            "{name} {}: {speed} {acceleration}",
            rig.marks
        );
        assert!(engagement >= promise.engagements, "{name}: {engagement}");
        assert!(
            peak < promise.errors && rms < promise.errors,
            "{name}: {peak} {rms}"
        );
    }
}

#[test]
fn a_torque_that_rises_evenly() {
    covers("ramp", RAMP, &RIGS, &CLOSE);
}

#[test]
fn an_even_torque() {
    covers("even", EVEN, &RIGS, &CLOSE);
}

#[test]
fn a_torque_that_breaks_away() {
    covers("breaks away", BREAKS_AWAY, &RIGS, &CLOSE);
}

#[test]
fn a_torque_that_begins_with_the_square_of_time() {
    covers("late", LATE, &RIGS, &VAGUE);
}

#[test]
fn a_slow_ramp_that_begins_and_ends_with_a_lag() {
    // Corners of a tenth of a second in a ramp of five that is silent between them.
    let slow = rig(60, 5.0, 5e-6);
    let (mut inside, mut count) = (0, 0);
    for seed in 0..12 {
        let (truth, speed) = estimate(LAGS, &slow, seed);
        let change = speed.change.unwrap();
        let off = change.engagement.0 - truth.engage;
        println!(
            "{seed}: engagement off {:.1} ± {:.1} ms",
            1e3 * off,
            1e3 * change.engagement.1
        );
        assert!(off.abs() < 3.0 * change.engagement.1, "{change:?}");
        // The start, the ramp, the corner and what follows it.
        let spots = [
            0.1, 0.15, 0.2, 0.3, 0.5, 1.0, 2.0, 3.0, 4.0, 4.4, 4.5, 4.55, 4.6, 4.7, 4.9, 5.3,
        ];
        for time in spots.map(|t| truth.engage + t) {
            let (motion, wanted) = (speed.at(time), truth.at(time));
            let off = (motion.speed - wanted[1]) / motion.speed_uncertainty();
            let also = (motion.acceleration - wanted[2]) / motion.acceleration_uncertainty();
            inside += usize::from(off.abs() < 2.0) + usize::from(also.abs() < 2.0);
            count += 2;
        }
    }
    let part = inside as f64 / count as f64;
    println!("slow ramp: {:.1} % inside", 100.0 * part);
    assert!(part > 0.85, "{part}");
}

#[test]
fn a_torque_that_is_doubled_halfway() {
    covers("doubled", DOUBLED, &RIGS, &SMEARED);
}

#[test]
fn a_torque_that_rises_evenly_on_a_turning_shaft() {
    let turning = [
        Rig {
            before: 40.0,
            ..RIGS[0]
        },
        Rig {
            before: 40.0,
            ..RIGS[2]
        },
    ];
    covers("turning", RAMP, &turning, &CLOSE);
}

/// Starts that the estimator carries along: 24 seeds hold 23 or all engagements.
const CLOSE: Promise = Promise {
    instants: 0.9,
    engagements: 0.9,
    errors: 0.03,
};
/// A start that is softer than any of them: the first mark comes after a third of the slip, and nothing shows the
/// time before it but what is expected of clutches.
const VAGUE: Promise = Promise {
    instants: 0.88,
    engagements: 0.58,
    errors: 0.05,
};
/// A second jump within the slip, which the estimator does not know: it is smeared over some marks.
const SMEARED: Promise = Promise {
    instants: 0.8,
    engagements: 0.9,
    errors: 0.15,
};
