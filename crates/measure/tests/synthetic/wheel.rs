//! A made-up rig whose truth is known, built on other models than the estimators assume.
//!
//! | here | what the estimators assume |
//! |---|---|
//! | acceleration: bells of five families, some with a jump at the start, a kink or a second hump | integrated white noise between two knots |
//! | after the lock: a decaying torsional oscillation, drag, a ripple once per revolution | a quiet motion |
//! | noise of the signal: first-order autoregressive, steps of a 14-bit converter | white |
//! | instants of the converter and of the counter: jitter, in part slow | exact, or white |
//! | sensor: curved characteristic, a lag, amplitude that differs from mark to mark, drifting level | straight, constant |
//! | wheel: random errors and an eccentricity | known after calibration |
#![allow(dead_code)]

use std::f64::consts::{PI, TAU};

/// A stream of random numbers of its own (splitmix64).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Random {
        Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d)
    }

    /// From 0 to below 1.
    pub fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.uniform()
    }

    pub fn normal(&mut self) -> f64 {
        (-2.0 * (1.0 - self.uniform()).ln()).sqrt() * (TAU * self.uniform()).cos()
    }
}

/// A motion on a fine grid.
pub struct Truth {
    step: f64,
    angle: Vec<f64>,
    speed: Vec<f64>,
    acceleration: Vec<f64>,
    /// Engagement and lock, s.
    pub engage: f64,
    pub lock: f64,
    pub peak: f64,
}

/// Rest, a spin-up to `speed` with the peak acceleration `peak`, then `after` seconds of running.
pub fn spin_up(seed: u64, speed: f64, peak: f64, after: f64) -> Truth {
    let mut r = Random::new(seed);
    let kind = seed % 5;
    let (a, b, c) = (r.uniform(), r.uniform(), r.uniform());
    let raw = move |x: f64| -> f64 {
        match kind {
            0 => (PI * x.powf(0.8 + 0.45 * a)).sin().powi(2),
            1 => x.powf(1.0 + 1.2 * a) * (1.0 - x).powf(1.0 + 1.2 * b),
            2 => (PI * x).sin().powf(1.2 + a),
            3 => (0.1 + 0.2 * a) * (1.0 - x) + (PI * x).sin().powf(1.6 + 0.8 * b),
            _ => {
                let hump = (-((x - 0.45 - 0.2 * b) / (0.12 + 0.06 * c)).powi(2)).exp();
                (PI * x).sin().powi(2) * (0.75 + 0.25 * a * hump)
            }
        }
    };
    let (top, mean) = height(raw);
    spun(&mut r, raw, speed, speed / (peak * mean / top), after)
}

/// The same with an acceleration of a given shape over the slip, and a given length of it, s.
pub fn shaped(seed: u64, shape: impl Fn(f64) -> f64, speed: f64, length: f64, after: f64) -> Truth {
    spun(&mut Random::new(seed), shape, speed, length, after)
}

/// Top and mean of a shape.
fn height(raw: impl Fn(f64) -> f64) -> (f64, f64) {
    let many = 4000;
    let values: Vec<f64> = (0..=many).map(|k| raw(k as f64 / many as f64)).collect();
    let top = values.iter().copied().fold(0.0, f64::max);
    (top, values.iter().sum::<f64>() / many as f64)
}

fn spun(r: &mut Random, raw: impl Fn(f64) -> f64, speed: f64, length: f64, after: f64) -> Truth {
    let (top, mean) = height(&raw);
    let peak = speed / (length * mean / top);
    let step = (length / 4000.0).min(2e-5);
    let engage = r.between(0.04, 0.06) + length * r.uniform();
    let drag = r.between(10.0, 40.0);
    let (ring, ring_rate, ring_time) = (
        peak * r.between(0.0, 0.012),
        TAU * r.between(60.0, 140.0),
        0.02,
    );
    let (ripple, ripple_phase) = (r.between(0.0, 3.0), r.between(0.0, TAU));
    let lock = engage + length;
    let count = ((lock + after) / step) as usize + 2;
    let (mut angle, mut spin) = (r.between(0.0, 5.0), 0.0);
    let mut truth = Truth {
        step,
        angle: Vec::with_capacity(count),
        speed: Vec::with_capacity(count),
        acceleration: Vec::with_capacity(count),
        engage,
        lock,
        peak,
    };
    for k in 0..count {
        let t = k as f64 * step;
        let x = (t - engage) / length;
        let acceleration = if x <= 0.0 {
            0.0
        } else if x < 1.0 {
            peak * raw(x) / top
        } else {
            let s = t - lock;
            ring * (-s / ring_time).exp() * (ring_rate * s).sin() - drag * spin / speed
                + ripple * (angle + ripple_phase).sin()
        };
        if let Some(&last) = truth.acceleration.last() {
            let next = spin + 0.5 * step * (last + acceleration);
            angle += step * spin + step * step * (2.0 * last + acceleration) / 6.0;
            spin = next;
        }
        truth.angle.push(angle);
        truth.speed.push(spin);
        truth.acceleration.push(acceleration);
    }
    truth
}

impl Truth {
    pub fn end(&self) -> f64 {
        self.step * (self.angle.len() - 2) as f64
    }

    fn cell(&self, time: f64) -> (usize, f64) {
        let place = (time / self.step).max(0.0);
        let k = (place as usize).min(self.angle.len() - 2);
        (k, place - k as f64)
    }

    pub fn angle(&self, time: f64) -> f64 {
        let (k, x) = self.cell(time);
        let h = x * self.step;
        self.angle[k] + h * self.speed[k] + 0.5 * h * h * self.acceleration[k]
    }

    pub fn speed(&self, time: f64) -> f64 {
        let (k, x) = self.cell(time);
        self.speed[k] + x * (self.speed[k + 1] - self.speed[k])
    }

    pub fn acceleration(&self, time: f64) -> f64 {
        let (k, x) = self.cell(time);
        self.acceleration[k] + x * (self.acceleration[k + 1] - self.acceleration[k])
    }

    /// Largest acceleration of the spin-up.
    pub fn top(&self) -> f64 {
        self.acceleration.iter().copied().fold(0.0, f64::max)
    }

    /// Instant at which an angle is passed, forward only.
    fn passing(&self, angle: f64) -> Option<f64> {
        let k = self.angle.partition_point(|&a| a < angle);
        if k == 0 || k >= self.angle.len() {
            return None;
        }
        let (mut low, mut high) = (self.step * (k - 1) as f64, self.step * k as f64);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if self.angle(middle) < angle {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(0.5 * (low + high))
    }
}

/// Errors of a wheel, rad: random ones and an eccentricity.
pub fn wheel(r: &mut Random, marks: usize, random: f64, eccentric: f64) -> Vec<f64> {
    let phase = r.between(0.0, TAU);
    (0..marks)
        .map(|k| random * r.normal() + eccentric * (TAU * k as f64 / marks as f64 + phase).sin())
        .collect()
}

/// The signal of an optical pickup, sampled `rate` times a second.
pub fn pickup(truth: &Truth, seed: u64, marks: usize, rate: f64) -> Vec<f64> {
    let mut r = Random::new(seed ^ 0xabcd_ef01);
    let pitch = TAU / marks as f64;
    let errors = wheel(&mut r, marks, 5e-4, 1e-3);
    let brightness: Vec<f64> = (0..marks).map(|_| 1.0 + 0.04 * r.normal()).collect();
    let duty = r.between(0.38, 0.55);
    let width = r.between(0.05, 0.1) * pitch;
    let curve = r.between(-0.1, 0.1);
    let (drift, drift_rate) = (r.between(0.0, 0.6), TAU * r.between(0.5, 3.0));
    let spread = r.between(0.01, 0.03);
    let lag = 15e-6;
    let count = (truth.end() * rate) as usize;
    let (mut noise, memory) = (0.0, 0.6f64);
    (0..count)
        .map(|k| {
            let time = k as f64 / rate;
            let angle = truth.angle(time + 1e-6 * r.normal() - lag);
            let nearest = (angle / pitch).floor() as i64;
            let light: f64 = (nearest - 1..=nearest + 1)
                .map(|mark| {
                    let at = mark.rem_euclid(marks as i64) as usize;
                    let rise = mark as f64 * pitch + errors[at];
                    let fall = rise + duty * pitch;
                    0.5 * brightness[at]
                        * (((angle - rise) / width).tanh() - ((angle - fall) / width).tanh())
                })
                .sum();
            noise = memory * noise + (1.0 - memory * memory).sqrt() * spread * r.normal();
            let volts = 5.0 * (light + curve * light * light)
                + 0.4
                + drift * (drift_rate * time).sin()
                + noise;
            let bit = 20.0 / 16384.0;
            (volts / bit).round() * bit
        })
        .collect()
}

/// What an optical pickup shows of a wheel whose marks are off by a hundredth of their pitch, and whose flanks take a tenth.
pub fn optical(truth: &Truth, seed: u64, marks: usize, rate: f64) -> Vec<f64> {
    let mut random = Random::new(seed ^ 0x77);
    let count = marks as f64;
    let mut places: Vec<f64> = (0..marks)
        .map(|k| k as f64 + 0.01 * random.normal())
        .collect();
    places.push(places[0] + count);
    (0..(truth.end() * rate) as usize)
        .map(|k| {
            let turned = truth.angle(k as f64 / rate) / TAU * count;
            let inside = turned - ((turned - places[0]) / count).floor() * count;
            let after = places.partition_point(|place| *place <= inside);
            let after = after.clamp(1, marks);
            let (left, right) = (places[after - 1], places[after]);
            let phase = TAU * (inside - left) / (right - left);
            let volts = 2.5 * (1.0 + (6.0 * phase.cos()).tanh()) + 0.05 * random.normal();
            let bit = 20.0 / 16384.0;
            (volts / bit).round() * bit
        })
        .collect()
}

/// Time stamps of a counter with a clock of 10 MHz.
pub fn stamps(truth: &Truth, seed: u64, marks: usize) -> Vec<f64> {
    let mut r = Random::new(seed ^ 0x1357_9bdf);
    let pitch = TAU / marks as f64;
    let errors = wheel(&mut r, marks, 1e-4, 3e-4);
    let first = (truth.angle(0.0) / pitch).floor() as i64 + 1;
    let (mut slow, clock) = (0.0, 1e-7);
    let mut times = Vec::new();
    for mark in first.. {
        let angle = mark as f64 * pitch + errors[mark.rem_euclid(marks as i64) as usize];
        let Some(time) = truth.passing(angle) else {
            if mark > first + 2 { break } else { continue }
        };
        slow = 0.8 * slow + 0.6 * 0.3e-6 * r.normal();
        times.push(((time + slow + 0.3e-6 * r.normal()) / clock).floor() * clock);
    }
    times
}
