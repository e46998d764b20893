//! Cage speed from passing balls and from vibration, against synthetic truth.

use crate::synthetic::rig::{Random, SpinUp, median};
use measure::cage_speed::{CageSpeed, Line, QuickChange, from_pulses, from_vibration};
use measure::shaft::Shaft;
use std::f64::consts::TAU;

const RATIO: f64 = 0.41;
const BALLS: usize = 10;

/// Shaft and cage over some seconds: the shaft's speed swings a little, the slip falls from `first` to `last` and wanders.
struct Truth {
    angle: Vec<f64>,
    speed: Vec<f64>,
    interval: f64,
    first: f64,
    last: f64,
    wander: [(f64, f64, f64); 3],
    /// Slip by collisions in the pockets and its integral, at the same times: correlated over 0.15 s, 0.05 % rms.
    rough: Vec<(f64, f64)>,
}

impl Truth {
    fn new(random: &mut Random, length: f64) -> Self {
        let interval = 0.002;
        let (a, f, p) = (
            1.0 + random.uniform(),
            0.5 + random.uniform(),
            TAU * random.uniform(),
        );
        let times = (0..(length / interval) as usize + 2).map(|k| k as f64 * interval);
        let angle = times
            .clone()
            .map(|t| 150.0 * t - a / (TAU * f) * (TAU * f * t + p).cos())
            .collect();
        let speed = times.map(|t| 150.0 + a * (TAU * f * t + p).sin()).collect();
        let wander =
            [0.4, 1.1, 2.9].map(|f| (0.001 * random.normal() / f, f, TAU * random.uniform()));
        let keep = (-interval / 0.15_f64).exp();
        let (mut value, mut sum) = (5e-4 * random.normal(), 0.0);
        let rough = (0..(length / interval) as usize + 2)
            .map(|_| {
                let now = (value, sum);
                let next = keep * value + 5e-4 * (1.0 - keep * keep).sqrt() * random.normal();
                sum += 0.5 * interval * (value + next);
                value = next;
                now
            })
            .collect();
        Self {
            rough,
            angle,
            speed,
            interval,
            first: 0.03 + 0.02 * random.uniform(),
            last: 0.004,
            wander,
        }
    }

    fn shaft(&self) -> Shaft<'_> {
        Shaft {
            first: 0.0,
            interval: self.interval,
            angle: &self.angle,
            speed: &self.speed,
            speed_deviation: &[],
        }
    }

    /// Slip and its integral over time.
    fn slip(&self, t: f64) -> (f64, f64) {
        let decay = 0.6;
        let mut slip = self.last + (self.first - self.last) * (-t / decay).exp();
        let mut sum = self.last * t + (self.first - self.last) * decay * (1.0 - (-t / decay).exp());
        for (a, f, p) in self.wander {
            slip += a * (TAU * f * t + p).sin();
            sum += a / (TAU * f) * (p.cos() - (TAU * f * t + p).cos());
        }
        let place = (t / self.interval).clamp(0.0, (self.rough.len() - 2) as f64);
        let (k, u) = (place as usize, place.fract());
        let (a, b) = (self.rough[k], self.rough[k + 1]);
        let between = a.0 + u * (b.0 - a.0);
        (
            slip + between,
            sum + a.1 + 0.5 * u * self.interval * (a.0 + between),
        )
    }

    fn cage(&self, t: f64) -> (f64, f64) {
        let shaft = self.shaft();
        let (slip, sum) = self.slip(t);
        // The shaft's swing of 1 % of its speed is left out of the product under the integral: exact enough for a truth that is
        // defined by its angle; the speed is the derivative of that angle.
        (
            RATIO * (shaft.angle_at(t) - 150.0 * sum),
            RATIO * (shaft.speed_at(t) - 150.0 * slip),
        )
    }
}

/// Times at which balls pass: spacing errors of 0.5 % of a pitch, clock of 42 kS/s, jitter of 30 µs in two colours.
fn passings(truth: &Truth, random: &mut Random, length: f64) -> Vec<f64> {
    let pitch = TAU / BALLS as f64;
    let spacing: Vec<f64> = (0..BALLS)
        .map(|_| 0.005 * pitch * random.normal())
        .collect();
    let start = pitch * random.uniform();
    let noise = random.coloured(2000, 0.2, 0.5);
    let (mut times, mut t) = (Vec::new(), 0.0);
    for n in 0..2000 {
        let target = start + n as f64 * pitch + spacing[n % BALLS];
        for _ in 0..20 {
            let (angle, speed) = truth.cage(t);
            t += (target - angle) / speed;
            t = t.clamp(0.0, length + 0.1);
        }
        if t > length {
            break;
        }
        times.push(((t + 30e-6 * noise[n]) * 42_000.0).round() / 42_000.0);
    }
    times
}

/// Vibration: the line, modulated in amplitude by the cage, an order-1 and an order-2 line, noise of two colours 3 dB above it.
fn vibration(truth: &Truth, random: &mut Random, rate: f64, length: f64) -> Vec<f64> {
    let count = (rate * length) as usize;
    let noise = random.coloured(count, 0.5, 0.9);
    let (p1, p2) = (TAU * random.uniform(), TAU * random.uniform());
    (0..count)
        .map(|k| {
            let t = k as f64 / rate;
            let (cage, _) = truth.cage(t);
            let shaft = truth.shaft().angle_at(t);
            let line = (1.0 + 0.3 * (cage + p1).cos()) * (BALLS as f64 * cage + p2).cos();
            line + 0.8 * (shaft + p2).cos() + 0.3 * (2.0 * shaft).cos() + 1.0 * noise[k] + 0.5
        })
        .collect()
}

fn covered(found: &CageSpeed, truth: &Truth) -> (usize, usize, f64) {
    let (mut inside, mut count, mut squares) = (0, 0, 0.0);
    for ((&t, &speed), &deviation) in found.time.iter().zip(&found.speed).zip(&found.deviation) {
        let error = speed - truth.cage(t).1;
        inside += usize::from(error.abs() <= 2.0 * deviation);
        squares += error * error;
        count += 1;
    }
    (inside, count, (squares / count as f64).sqrt())
}

fn over_seeds(name: &str, seeds: u64, one: impl Fn(u64) -> (usize, usize, f64) + Sync) {
    let part = |range: std::ops::Range<u64>| range.map(&one).collect::<Vec<_>>();
    let all = std::thread::scope(|scope| {
        let second = scope.spawn(|| part(seeds / 2..seeds));
        let mut all = part(0..seeds / 2);
        all.extend(second.join().expect("no panic"));
        all
    });
    let (inside, count) = all.iter().fold((0, 0), |(i, c), s| (i + s.0, c + s.1));
    let share = inside as f64 / count as f64;
    let error = median(all.iter().map(|s| s.2).collect());
    println!(
        "{name}: {share:.3} of {count} values inside two deviations, median error {error:.4} rad/s of 61"
    );
    assert!((0.90..=0.98).contains(&share), "{name}: {share}");
}

#[test]
fn two_deviations_cover_the_cage_speed_from_passings() {
    over_seeds("passings", 400, |seed| {
        let mut random = Random::new(seed);
        let truth = Truth::new(&mut random, 4.0);
        let times = passings(&truth, &mut random, 4.0);
        let found = from_pulses(&times, &truth.shaft(), BALLS, RATIO, None).expect("found");
        covered(&found, &truth)
    });
}

#[test]
fn two_deviations_cover_the_cage_speed_from_vibration() {
    over_seeds("vibration", 400, |seed| {
        let mut random = Random::new(seed);
        let truth = Truth::new(&mut random, 4.0);
        let signal = vibration(&truth, &mut random, 2000.0, 4.0);
        let line = Line {
            ratio: RATIO,
            order: BALLS as f64,
            lowest_slip: -0.02,
            highest_slip: 0.1,
            engagement: Some(0.0),
        };
        let found =
            from_vibration(0.0, 1.0 / 2000.0, &signal, &truth.shaft(), &line).expect("found");
        covered(&found, &truth)
    });
}

/// A spin-up in 25 ms whose cage comes to speed with 40 ms: the first passings are far apart and none is missing.
#[test]
fn two_deviations_cover_a_cage_that_lags() {
    let spin = SpinUp::to_150(0.1, 0.025, 11_500.0);
    let times = (0..1100).map(|k| k as f64 * 1e-3);
    let angle: Vec<f64> = times.clone().map(|t| spin.angle(t)).collect();
    let speed: Vec<f64> = times.map(|t| spin.speed(t)).collect();
    let shaft = Shaft {
        first: 0.0,
        interval: 1e-3,
        angle: &angle,
        speed: &speed,
        speed_deviation: &[],
    };
    let h = 1e-5;
    // Cage speed and angle on a fine grid: ω' = (ratio Ω (1 - 0.01 - rough) - ω)/40 ms, rough slip of 0.2 % over 30 ms.
    let turning = |random: &mut Random| {
        let (mut cage, mut turned, mut rough, mut path) = (0.0, 0.0, 0.0, Vec::new());
        let keep = (-h / 0.03_f64).exp();
        for k in 0..100_000 {
            path.push((turned, cage));
            rough = keep * rough + 2e-3 * (1.0 - keep * keep).sqrt() * random.normal();
            let target = (0.99 - rough) * RATIO * spin.speed(k as f64 * h);
            cage += h * (target - cage) / 0.04;
            turned += h * cage;
        }
        path
    };
    over_seeds("lagging cage", 400, |seed| {
        let mut random = Random::new(seed);
        let pitch = TAU / BALLS as f64;
        let path = turning(&mut random);
        let spacing: Vec<f64> = (0..BALLS)
            .map(|_| 0.005 * pitch * random.normal())
            .collect();
        let start = pitch * random.uniform();
        let mut passings = Vec::new();
        for (k, (angle, _)) in path.iter().enumerate() {
            let n = passings.len();
            if *angle >= start + n as f64 * pitch + spacing[n % BALLS] {
                passings.push(k as f64 * h + 30e-6 * random.normal());
            }
        }
        let found = from_pulses(
            &passings,
            &shaft,
            BALLS,
            RATIO,
            Some(QuickChange {
                engagement: 0.1,
                lock: None,
            }),
        )
        .expect("found");
        assert!(
            !found
                .notes
                .iter()
                .any(|n| n.to_string().contains("missing")),
            "{:?}",
            found.notes
        );
        let (mut inside, mut count, mut squares) = (0, 0, 0.0);
        for ((&t, &speed), &deviation) in found.time.iter().zip(&found.speed).zip(&found.deviation)
        {
            let error = speed - path[((t / h) as usize).min(path.len() - 1)].1;
            inside += usize::from(error.abs() <= 2.0 * deviation);
            squares += error * error;
            count += 1;
        }
        (inside, count, (squares / f64::from(count as u32)).sqrt())
    });
}

#[test]
fn missing_and_double_passings_are_counted_and_repaired() {
    let mut random = Random::new(3);
    let truth = Truth::new(&mut random, 4.0);
    let mut times = passings(&truth, &mut random, 4.0);
    let whole = from_pulses(&times, &truth.shaft(), BALLS, RATIO, None).expect("found");
    times.remove(200);
    times.remove(120);
    times.remove(119);
    times.insert(50, times[50] - 4e-4);
    let found = from_pulses(&times, &truth.shaft(), BALLS, RATIO, None).expect("found");
    assert!(
        found
            .notes
            .iter()
            .any(|n| n.to_string().starts_with("3 passings are missing")),
        "{:?}",
        found.notes
    );
    assert!(
        found
            .notes
            .iter()
            .any(|n| n.to_string().starts_with("1 passings came double")),
        "{:?}",
        found.notes
    );
    // Three of 388 passings less change the error by little.
    assert!(covered(&found, &truth).2 < 1.2 * covered(&whole, &truth).2);
}

/// A ratio that is 2 % wrong is slip: the cage speed must not care.
#[test]
fn the_speed_does_not_hang_on_the_ratio() {
    let mut random = Random::new(4);
    let truth = Truth::new(&mut random, 4.0);
    let times = passings(&truth, &mut random, 4.0);
    let right = from_pulses(&times, &truth.shaft(), BALLS, RATIO, None).expect("found");
    let wrong = from_pulses(&times, &truth.shaft(), BALLS, 1.02 * RATIO, None).expect("found");
    for k in 0..right.speed.len() {
        assert!((right.speed[k] - wrong.speed[k]).abs() < right.deviation[k]);
    }
    let middle = right.slip.len() / 2;
    assert!((wrong.slip[middle] - right.slip[middle] - 0.02 / 1.02).abs() < 0.002);
}

#[test]
fn what_holds_no_line_is_reported() {
    let mut random = Random::new(5);
    let truth = Truth::new(&mut random, 4.0);
    let noise = random.coloured(8000, 0.5, 0.9);
    let line = Line {
        ratio: RATIO,
        order: BALLS as f64,
        lowest_slip: -0.02,
        highest_slip: 0.1,
        engagement: None,
    };
    let shown = from_vibration(0.0, 1.0 / 2000.0, &noise, &truth.shaft(), &line)
        .expect_err("noise holds no line");
    assert!(shown.contains("no line between the slips"), "{shown}");
}

#[test]
fn what_cannot_be_followed_is_refused() {
    let mut random = Random::new(6);
    let truth = Truth::new(&mut random, 1.0);
    let shaft = truth.shaft();
    assert!(
        from_pulses(&[0.1, 0.2], &shaft, BALLS, RATIO, None)
            .expect_err("few")
            .contains("at least 8")
    );
    assert!(
        from_pulses(&[0.2, 0.1], &shaft, BALLS, RATIO, None)
            .expect_err("order")
            .contains("in order")
    );
    let line = Line {
        ratio: RATIO,
        order: BALLS as f64,
        lowest_slip: -0.02,
        highest_slip: 0.1,
        engagement: None,
    };
    assert!(
        from_vibration(0.0, 0.01, &[0.0; 100], &shaft, &line)
            .expect_err("slow")
            .contains("values a second")
    );
    assert!(
        from_vibration(0.0, 0.001, &[], &shaft, &line)
            .expect_err("empty")
            .contains("too short")
    );
    assert!(
        from_vibration(9.0, 0.001, &[0.0; 100], &shaft, &line)
            .expect_err("apart")
            .contains("too short")
    );
}

/// A rolling cage through a spin-up in which fewer than two balls pass: it is given between them.
#[test]
fn a_rolling_cage_is_followed_through_a_quick_spin_up() {
    let (mut inside, mut count) = (0, 0);
    for seed in 0..20 {
        let mut random = Random::new(seed);
        // From rest at 0.2 s, evenly rising acceleration for 41 ms to 150 rad/s.
        let (begin, length, top) = (0.2, 0.041, 150.0);
        let speed = |t: f64| top * ((t - begin) / length).clamp(0.0, 1.0).powi(2);
        let angle = |t: f64| {
            let x = ((t - begin) / length).clamp(0.0, 1.0);
            top * length * x.powi(3) / 3.0 + top * (t - begin - length).max(0.0)
        };
        let interval = 2e-4;
        let times = (0..15_000).map(|k| f64::from(k) * interval);
        let (angles, speeds): (Vec<f64>, Vec<f64>) = times.map(|t| (angle(t), speed(t))).unzip();
        let shaft = Shaft {
            first: 0.0,
            interval,
            angle: &angles,
            speed: &speeds,
            speed_deviation: &[],
        };
        let pitch = TAU / BALLS as f64;
        let start = pitch * random.uniform();
        let mut passed = Vec::new();
        let mut next = 1.0;
        for (k, angle) in angles.iter().enumerate() {
            let here = start + RATIO * angle;
            while here >= next * pitch {
                passed.push(k as f64 * interval + 2e-5 * random.normal());
                next += 1.0;
            }
        }
        let found = from_pulses(
            &passed,
            &shaft,
            BALLS,
            RATIO,
            Some(QuickChange {
                engagement: begin,
                lock: None,
            }),
        )
        .unwrap();
        let rises = found
            .time
            .iter()
            .filter(|t| (begin..begin + length).contains(*t));
        assert!(rises.count() > 15, "a value every 2 ms");
        for ((time, value), band) in found.time.iter().zip(&found.speed).zip(&found.deviation) {
            if *time > begin && *time < begin + 3.0 * length {
                let off = (value - RATIO * speed(*time)).abs();
                assert!(off < 1.5, "seed {seed}: {off} at {time}");
                inside += usize::from(off < 2.0 * band);
                count += 1;
            }
        }
    }
    let part = inside as f64 / count as f64;
    println!(
        "rolling cage in a quick spin-up: {:.1} % inside",
        100.0 * part
    );
    assert!(part > 0.9, "{part}");
}
