//! Made-up tests of a greased 6005 whose truth is known, from other laws than the pages assume: a steady moment with a Stribeck
//! part, noise that is a smoothed white one beside a white one (not an autoregression), a sensor that is not linear.
#![allow(dead_code)] // each test file uses a part

use identify::{CageTrace, Measurement};
use physics::rolling::RollingSet;
use std::f64::consts::{PI, TAU};

/// Seeds of a coverage test: few here, more where `AUXBEAR_SEEDS` says so.
pub fn seeds(few: u64) -> u64 {
    std::env::var("AUXBEAR_SEEDS")
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(few)
}

/// Asserts a coverage; with few seeds the bound is wider by what chance allows.
pub fn covered(name: &str, inside: f64, of: f64, seeds: u64) {
    let part = inside / of;
    println!("{name}: {:.1} % of {of} with {seeds} seeds", 100.0 * part);
    // values of one seed share their errors: three deviations of a binomial with one value a seed
    let chance = if seeds >= 400 {
        0.0
    } else {
        3.0 * (0.95 * 0.05 / seeds as f64).sqrt()
    };
    assert!(part >= 0.90 - chance, "{name}: {part}");
    if seeds >= 400 {
        assert!(part <= 0.985, "{name}: {part}");
    }
}

/// Random numbers: Marsaglia's xorshift with a multiplier, and Box and Muller's normal numbers.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        let mut random = Self(0x9e37_79b9_7f4a_7c15 ^ seed.wrapping_mul(0xd134_2543_de82_ef95) | 1);
        for _ in 0..8 {
            random.uniform();
        }
        random
    }
    pub fn uniform(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1u64 << 53) as f64
    }
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (TAU * self.uniform()).cos()
    }
    /// Noise of deviation 1: nine tenths of its power smoothed with a raised cosine, a tenth white. The integral of its
    /// correlation is 0.6 of the raised cosine's length.
    pub fn coloured(&mut self, count: usize, interval: f64, length: f64) -> Vec<f64> {
        let taps = (length / interval).round().max(1.0) as usize;
        let weights: Vec<f64> = (0..taps)
            .map(|k| 1.0 - (TAU * (k as f64 + 0.5) / taps as f64).cos())
            .collect();
        let size = weights.iter().map(|w| w * w).sum::<f64>().sqrt();
        let white: Vec<f64> = (0..count + taps).map(|_| self.normal()).collect();
        (0..count)
            .map(|k| {
                let smooth: f64 = weights.iter().zip(&white[k..]).map(|(w, x)| w * x).sum();
                0.9_f64.sqrt() * smooth / size + 0.1_f64.sqrt() * self.normal()
            })
            .collect()
    }
}

/// A 6005: 10 balls of 1.05 g, cage 8 g.
pub fn set() -> RollingSet<f64> {
    RollingSet {
        inner_track_radius: 14.825e-3,
        ball_ratio: 3.175 / 14.825,
        balls_mass: 10.0 * 1.0524e-3,
        cage_mass: 8e-3,
    }
}

/// The true steady moment, N m: a power 0.55, a constant, and a Stribeck part. None of the forms.
pub fn steady(speed: f64) -> f64 {
    let x = speed.abs();
    (8e-3 + 15e-3 * (x / 150.0).powf(0.55) + 2e-3 * (-x / 15.0).exp()).copysign(speed)
}

/// Correlation time of the torque, s, and the length of noise that has it.
pub const CORRELATION: f64 = 0.03;
const LENGTH: f64 = 0.05;

/// What a sensor adds.
pub struct Sensor {
    pub noise: f64,
    /// Length of the raised cosine that smooths the noise, s.
    pub length: f64,
    pub zero: f64,
    pub scale: f64,
}

/// 0.5 N mm of noise, 0.3 N mm of zero, 1 % of scale.
pub const SENSOR: Sensor = Sensor {
    noise: 0.5e-3,
    length: LENGTH,
    zero: 0.3e-3,
    scale: 0.01,
};

/// A reading of true torques: `scale_error` in deviations, common to all tests of one sensor.
pub fn read(
    random: &mut Random,
    torque: &[f64],
    interval: f64,
    sensor: &Sensor,
    scale_error: f64,
) -> Vec<f64> {
    let zero = sensor.zero * random.normal();
    let noise = random.coloured(torque.len(), interval, sensor.length);
    torque
        .iter()
        .zip(noise)
        .map(|(t, n)| {
            // 0.2 % of non-linearity over 30 N mm
            let bent = t * (1.0 + 0.002 * (PI * t / 30e-3).sin());
            bent * (1.0 + sensor.scale * scale_error) + zero + sensor.noise * n
        })
        .collect()
}

/// A test of true motion and true torque.
#[allow(clippy::too_many_arguments)] // what a rig has
pub fn measured(
    random: &mut Random,
    name: &str,
    time: Vec<f64>,
    speed: &[f64],
    acceleration: &[f64],
    torque: &[f64],
    sensor: &Sensor,
    scale_error: f64,
) -> Measurement {
    let interval = time[1] - time[0];
    let count = time.len();
    let quickest = acceleration.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
    let reading = read(random, torque, interval, sensor, scale_error);
    let own_speed = random.coloured(count, interval, 0.01);
    let own_rate = random.coloured(count, interval, 0.01);
    // 0.1 rad/s where the shaft turns, 1 % of the acceleration's peak while it is quick, a thousandth else
    let speed_deviation: Vec<f64> = speed
        .iter()
        .map(|s| if *s == 0.0 { 0.0 } else { 0.1 })
        .collect();
    let rate_deviation: Vec<f64> = acceleration
        .iter()
        .map(|a| {
            if a.abs() > 0.02 * quickest {
                0.01 * quickest
            } else {
                1e-3 * quickest
            }
        })
        .collect();
    Measurement {
        name: name.into(),
        load: 50.0,
        speed: speed
            .iter()
            .zip(&speed_deviation)
            .zip(&own_speed)
            .map(|((s, d), n)| s + d * n)
            .collect(),
        acceleration: acceleration
            .iter()
            .zip(&rate_deviation)
            .zip(&own_rate)
            .map(|((a, d), n)| a + d * n)
            .collect(),
        torque_deviation: reading
            .iter()
            .map(|t| sensor.noise.hypot(sensor.zero).hypot(sensor.scale * t))
            .collect(),
        torque: reading,
        speed_deviation,
        acceleration_deviation: rate_deviation,
        time,
        zero_deviation: sensor.zero,
        scale_deviation: sensor.scale,
        correlation_time: vec![CORRELATION; count],
        engagement: None,
        engagement_deviation: 0.0,
        rest_before: None,
        cage: None,
        temperature: None,
    }
}

/// A coast-down from 150 to 3 rad/s in so many seconds: the speed falls as under a constant and a linear drag.
pub fn coast_down(random: &mut Random, lasts: f64, interval: f64, scale_error: f64) -> Measurement {
    coasting(random, lasts, interval, scale_error, &steady, &SENSOR)
}

/// A coast-down with a given moment.
pub fn coasting(
    random: &mut Random,
    lasts: f64,
    interval: f64,
    scale_error: f64,
    moment: &dyn Fn(f64) -> f64,
    sensor: &Sensor,
) -> Measurement {
    let time: Vec<f64> = (0..=(lasts / interval).round() as usize)
        .map(|k| k as f64 * interval)
        .collect();
    let part = |t: f64| 1.0 - t / lasts;
    let speed: Vec<f64> = time
        .iter()
        .map(|t| 3.0 + 147.0 * (0.6 * part(*t) + 0.4 * part(*t).powi(2)))
        .collect();
    let acceleration: Vec<f64> = time
        .iter()
        .map(|t| -147.0 / lasts * (0.6 + 0.8 * part(*t)))
        .collect();
    let inertia = set().outer_inertia();
    let torque: Vec<f64> = speed
        .iter()
        .zip(&acceleration)
        .map(|(s, a)| moment(*s) - inertia * a)
        .collect();
    measured(
        random,
        "coast-down",
        time,
        &speed,
        &acceleration,
        &torque,
        sensor,
        scale_error,
    )
}

/// Speed and acceleration of a spin-up to 150 rad/s with a peak acceleration, engaged at 0.2 s; half a period of a raised cosine.
pub fn profile(peak: f64) -> impl Fn(f64) -> (f64, f64) {
    let lasts = 2.0 * 150.0 / peak;
    move |time: f64| {
        let u = ((time - 0.2) / lasts).clamp(0.0, 1.0);
        let inside = u > 0.0 && u < 1.0;
        (
            150.0 * (u - (TAU * u).sin() / TAU),
            if inside {
                0.5 * peak * (1.0 - (TAU * u).cos())
            } else {
                0.0
            },
        )
    }
}

/// The true F of accelerated balls, N: 0.07 to 0.1 mN s²/rad.
pub fn friction(speed: f64, acceleration: f64) -> f64 {
    (7e-5 + 3e-5 * (speed / 150.0).powi(2)) * acceleration.abs()
}

/// A spin-up with rolling balls, and its true F.
pub fn rolling_spin_up(
    random: &mut Random,
    peak: f64,
    hold: f64,
    scale_error: f64,
) -> (Measurement, Vec<f64>) {
    rolling_with(random, peak, hold, scale_error, &friction)
}

/// A spin-up with rolling balls of a given F over speed and acceleration, and that F.
pub fn rolling_with(
    random: &mut Random,
    peak: f64,
    hold: f64,
    scale_error: f64,
    friction: &dyn Fn(f64, f64) -> f64,
) -> (Measurement, Vec<f64>) {
    let interval = 1e-3;
    let lasts = 0.2 + 300.0 / peak + hold;
    let time: Vec<f64> = (0..(lasts / interval) as usize)
        .map(|k| k as f64 * interval)
        .collect();
    let motion = profile(peak);
    let (speed, acceleration): (Vec<f64>, Vec<f64>) = time.iter().map(|t| motion(*t)).unzip();
    let set = set();
    let truth: Vec<f64> = speed
        .iter()
        .zip(&acceleration)
        .map(|(s, a)| friction(*s, *a))
        .collect();
    let torque: Vec<f64> = (0..time.len())
        .map(|k| {
            let traction = set.outer_traction(set.rolling(acceleration[k]), truth[k]);
            let moment = if speed[k] == 0.0 {
                0.0
            } else {
                steady(speed[k])
            };
            set.outer_moment(moment, traction)
        })
        .collect();
    let mut test = measured(
        random,
        &format!("{peak} rad/s²"),
        time,
        &speed,
        &acceleration,
        &torque,
        &SENSOR,
        scale_error,
    );
    test.engagement = Some(0.2);
    (test, truth)
}

/// A spin-up whose cage lags.
pub struct Lagging {
    pub test: Measurement,
    /// True slip at the times of the cage signal.
    pub slip: Vec<f64>,
    /// What the bearing dissipates from the engagement to the end of the record's first `until` seconds, J.
    pub loss: f64,
    pub until: f64,
    /// True torque at the times of the test, N m.
    pub torque: Vec<f64>,
    /// True spin over that of rolling, at the times of the test.
    pub spin_ratio: Vec<f64>,
}

/// The cage follows the race with a lag of first order; balls grip outside, or lag themselves by `skid` at first.
pub fn lagging_spin_up(random: &mut Random, peak: f64, lag: f64, skid: f64) -> Lagging {
    let set = set();
    let (s, radius) = (set.ball_ratio, set.inner_track_radius);
    let fine = 2e-5;
    let steps_a_value = 50;
    let motion = profile(peak);
    let until = 0.2 + 300.0 / peak + 8.0 * lag;
    let count = ((until + 0.1) / fine) as usize;
    let mut cage = 0.0;
    let (mut work, mut kinetic) = (0.0, 0.0);
    let (mut time, mut speed, mut acceleration, mut torque) = (vec![], vec![], vec![], vec![]);
    let (mut cage_speed, mut spin_ratio) = (vec![], vec![]);
    for k in 0..count {
        let t = k as f64 * fine;
        let (own, rate) = motion(t);
        let target = set.cage_speed(own);
        let cage_rate = (target - cage) / lag;
        // a ball that skids on both races lags by a part that fades
        let fading = |t: f64| skid * (-(t - 0.2) / (4.0 * lag)).exp();
        let factor = if t > 0.2 { 1.0 - fading(t) } else { 1.0 };
        let factor_rate = if t > 0.2 {
            fading(t) / (4.0 * lag)
        } else {
            0.0
        };
        let spin = (1.0 + s) * cage / s * factor;
        let spin_rate = (1.0 + s) / s * (cage_rate * factor + cage * factor_rate);
        let motion = physics::rolling::Acceleration {
            ball_spin: spin_rate,
            cage: cage_rate,
        };
        let moment = if own == 0.0 { 0.0 } else { steady(own) };
        // no pocket friction beside M; work of the inner race by (6), not by the momentum that the page uses
        let inner = set.inner_moment(moment, set.inner_traction(motion, 0.0));
        let outer = set.outer_moment(moment, set.outer_traction(motion, 0.0));
        if t < until {
            work += inner * own * fine;
            kinetic = 0.5 * (set.balls_mass + set.cage_mass) * (radius * (1.0 + s) * cage).powi(2)
                + 0.2 * set.balls_mass * (s * radius * spin).powi(2);
        }
        if k % steps_a_value == 0 {
            time.push(t);
            speed.push(own);
            acceleration.push(rate);
            torque.push(outer);
            cage_speed.push(cage);
            spin_ratio.push(if own > 0.0 {
                spin / set.ball_spin(own)
            } else {
                1.0
            });
        }
        cage += fine * cage_rate;
    }
    let scale_error = random.normal();
    let mut test = measured(
        random,
        "lagging",
        time.clone(),
        &speed,
        &acceleration,
        &torque,
        &SENSOR,
        scale_error,
    );
    test.engagement = Some(0.2);
    // cage: 0.25 rad/s, errors alike over 4 ms
    let noise = random.coloured(time.len(), 1e-3, 0.004);
    let slip = speed
        .iter()
        .zip(&cage_speed)
        .map(|(own, cage)| {
            if *own > 0.0 {
                1.0 - cage / set.cage_speed(*own)
            } else {
                0.0
            }
        })
        .collect();
    test.cage = Some({
        let (speed, deviation) = (
            cage_speed
                .iter()
                .zip(&noise)
                .map(|(c, n)| c + 0.25 * n)
                .collect(),
            vec![0.25; time.len()],
        );
        CageTrace::independent(time, speed, deviation)
    });
    Lagging {
        test,
        slip,
        loss: work - kinetic,
        until,
        torque,
        spin_ratio,
    }
}
