//! Shafts that come from rest and to rest: what lies before the first and behind the last mark.

#[path = "synthetic/pulses.rs"]
mod made;
#[path = "synthetic/wheel.rs"]
mod synthetic;

use made::pulses;
use measure::pulse::{Edges, Wheel, number};
use measure::speed::{Speed, SpeedSettings, smooth};
use synthetic::Random;

/// Speed and angle on a fine grid of a shaft that friction brakes, `rate` rad/s² and even down to a creeping that dies away
/// at some tenths of a rad/s, after a torque over time of its own, rad/s².
struct Braked {
    step: f64,
    speed: Vec<f64>,
    angle: Vec<f64>,
}

impl Braked {
    fn new(first: f64, rate: f64, seconds: f64, torque: impl Fn(f64) -> f64) -> Braked {
        let step = 1e-5;
        let (mut speed, mut angle) = (vec![first], vec![0.0]);
        for k in 0..(seconds / step) as usize {
            let now = speed[k];
            let next = now + step * (torque(k as f64 * step) - rate * (now / 0.4).tanh());
            speed.push(next);
            angle.push(angle[k] + 0.5 * step * (now + next));
        }
        Braked { step, speed, angle }
    }

    fn of(&self, values: &[f64], time: f64) -> f64 {
        let place = (time / self.step).clamp(0.0, (values.len() - 2) as f64);
        let k = place as usize;
        values[k] + (place - k as f64) * (values[k + 1] - values[k])
    }

    fn speed(&self, time: f64) -> f64 {
        self.of(&self.speed, time)
    }

    fn acceleration(&self, time: f64) -> f64 {
        (self.speed(time + 1e-4) - self.speed(time - 1e-4)) / 2e-4
    }
}

#[test]
fn a_shaft_that_stops_comes_to_rest_within_its_band_and_never_turns_back() {
    let (mut inside, mut count) = (0, 0);
    for seed in 0..20 {
        let truth = Braked::new(8.0 + 0.1 * seed as f64, 5.5, 4.0, |_| 0.0);
        let train = pulses(60, 4.0, 1e-5, seed, |t| truth.of(&truth.angle, t));
        let last = *train.times.last().unwrap();
        let speed = smooth(&train, None, &SpeedSettings::default()).unwrap();
        for k in 0..100 {
            // From the last mark to long after the stop.
            let time = last + 0.01 * k as f64;
            let motion = speed.at(time);
            assert!(motion.speed >= 0.0, "{motion:?}");
            for (error, deviation) in [
                (motion.speed - truth.speed(time), motion.speed_uncertainty()),
                (
                    motion.acceleration - truth.acceleration(time),
                    motion.acceleration_uncertainty(),
                ),
            ] {
                inside += usize::from(error.abs() < 2.0 * deviation + 1e-9);
                count += 1;
            }
        }
        // A second after the last mark it rests, and that is known.
        assert!(speed.at(last + 1.0).speed_uncertainty() < 1e-2);
    }
    let part = inside as f64 / count as f64;
    println!("stop: {:.1} % inside", 100.0 * part);
    assert!(part > 0.93, "{part}");
}

#[test]
fn a_signal_that_is_lost_is_no_stop() {
    // 100 rad/s with 5 rad/s²; the last second of the record has no marks.
    let train = pulses(60, 2.0, 1e-6, 3, |t| 100.0 * t - 2.5 * t * t);
    let cut = train.times.partition_point(|&t| t < 1.0);
    let found = Edges::stamped(train.times[..cut].to_vec(), 1e-6, Some((0.0, 2.0))).unwrap();
    let wheel = Wheel {
        marks: 60,
        missing: 0,
    };
    let train = number(&found, &wheel).unwrap();
    let speed = smooth(&train, None, &SpeedSettings::default()).unwrap();
    let later = speed.at(1.2);
    assert!((later.speed - 94.0).abs() < 0.5, "{later:?}");
}

#[test]
fn friction_that_a_rising_torque_must_overcome_widens_the_engagement() {
    // A clutch from 0.2 s on rises to 1300 rad/s² in 0.228 s against 10 rad/s², then lets go: the shaft coasts to its stop.
    let clutch = |t: f64| {
        if (0.2..0.428).contains(&t) {
            1300.0 * (t - 0.2) / 0.228
        } else {
            0.0
        }
    };
    let truth = Braked::new(0.0, 10.0, 20.0, clutch);
    for seed in 0..4 {
        let train = pulses(60, 20.0, 1e-6, seed, |t| truth.of(&truth.angle, t));
        let speed = smooth(&train, None, &SpeedSettings::default()).unwrap();
        let (engagement, deviation) = speed.change.unwrap().engagement;
        println!("engagement {engagement:.5} ± {deviation:.5}");
        // The marks look as if the motion had begun a millisecond later; the lock is found to some hundredths of one.
        assert!(engagement - 0.2 > 5e-4, "{engagement}");
        let (lock, _) = speed.change.unwrap().end.unwrap();
        assert!((lock - 0.428).abs() < 2e-4, "{lock}");
        assert!((engagement - 0.2) < 2.0 * deviation, "{deviation}");
        assert!(deviation < 2e-3, "{deviation}");
        for time in [0.205, 0.21, 0.22, 0.23] {
            let motion = speed.at(time);
            let error = (motion.speed - truth.speed(time)).abs();
            assert!(error < 2.0 * motion.speed_uncertainty(), "{motion:?}");
        }
    }
}

#[test]
fn a_turning_shaft_is_found_before_its_first_mark_with_its_band() {
    for seed in 0..10 {
        // The first mark passes a millisecond after the beginning of the record.
        let train = pulses(60, 5.0, 2e-6, seed, |t| 150.0 * t - 12.5 * t * t - 0.1);
        let speed = smooth(&train, None, &SpeedSettings::default()).unwrap();
        let (now, earlier) = (speed.at(train.times[0]), speed.at(0.0));
        assert!(
            (earlier.speed - 150.0).abs() < 3.0 * earlier.speed_uncertainty(),
            "{earlier:?}"
        );
        assert!(
            (earlier.acceleration + 25.0).abs() < 3.0 * earlier.acceleration_uncertainty(),
            "{earlier:?}"
        );
        // The band of the first mark, not that of a shaft whose state is known.
        assert!(earlier.speed_uncertainty() > 0.9 * now.speed_uncertainty());
    }
}

/// Asserts that paths drawn at random have the mean and the deviations of the motion at each instant, and that the covariance
/// of an instant with itself is that of the motion.
fn drawn_as_given(speed: &Speed, times: &[f64], many: usize) {
    let mut random = Random::new(5);
    let paths: Vec<Vec<[f64; 3]>> = (0..many)
        .map(|_| {
            let uniform = random.uniform();
            speed.draw(times, uniform, &mut || random.normal())
        })
        .collect();
    for (k, &time) in times.iter().enumerate() {
        let motion = speed.at(time);
        let wanted = [motion.angle, motion.speed, motion.acceleration];
        let own = speed.covariance(time, time);
        for i in 0..3 {
            let deviation = motion.covariance[i][i].sqrt();
            assert!(
                (own[i][i].max(0.0).sqrt() - deviation).abs() < 1e-4 * deviation + 1e-9,
                "{time} {i}: {} {deviation}",
                own[i][i].sqrt()
            );
            let mean = paths.iter().map(|path| path[k][i]).sum::<f64>() / many as f64;
            let square = paths
                .iter()
                .map(|path| (path[k][i] - mean).powi(2))
                .sum::<f64>();
            let spread = (square / many as f64).sqrt();
            println!(
                "{time:.4} {i}: {:.4} ± {deviation:.4}, drawn {mean:.4} ± {spread:.4}",
                wanted[i]
            );
            // Four deviations of a mean of so many; of a deviation, which the tails of a mixture make twice as uncertain.
            let few = 4.0 / (many as f64).sqrt();
            assert!(
                (mean - wanted[i]).abs() < few * deviation + 1e-9,
                "{time} {i}"
            );
            assert!(
                (spread - deviation).abs() < 2.0 * few / 2f64.sqrt() * deviation + 1e-9,
                "{time} {i}: {spread} {deviation}"
            );
        }
    }
}

#[test]
fn paths_from_rest_to_rest_are_drawn_as_the_motion_is_given() {
    // A clutch from 0.2 s on brings the shaft to 40 rad/s in 0.2 s against 40 rad/s², then lets go.
    let clutch = |t: f64| {
        if (0.2..0.4).contains(&t) {
            480.0 * (t - 0.2) / 0.2
        } else {
            0.0
        }
    };
    let truth = Braked::new(0.0, 40.0, 3.0, clutch);
    let train = pulses(36, 3.0, 5e-6, 2, |t| truth.of(&truth.angle, t));
    let speed = smooth(&train, None, &SpeedSettings::default()).unwrap();
    let change = speed.change.unwrap();
    let (engagement, first) = (change.engagement.0, train.times[0]);
    // Rest, the engagement, what lies hidden before the first mark, and the change.
    drawn_as_given(
        &speed,
        &[0.1, engagement, 0.5 * (engagement + first), first, 0.33],
        1000,
    );
    // The last interval, the stop and behind it.
    let n = train.times.len();
    let (before, last) = (train.times[n - 2], train.times[n - 1]);
    drawn_as_given(
        &speed,
        &[
            0.5 * (before + last),
            last,
            last + 0.03,
            last + 0.1,
            last + 0.5,
        ],
        600,
    );
    // What a stop hides is one error: neighbours behind it err together.
    let pair = speed.covariance(last + 0.03, last + 0.031)[1][1];
    let alone = speed.at(last + 0.03).covariance[1][1];
    assert!(pair > 0.8 * alone && pair < 1.2 * alone, "{pair} {alone}");
}

#[test]
fn paths_of_a_turning_shaft_are_drawn_before_its_first_mark_too() {
    let train = pulses(12, 1.0, 5e-5, 4, |t| 60.0 * t + 20.0 * t * t - 0.5);
    let speed = smooth(&train, None, &SpeedSettings::default()).unwrap();
    let first = train.times[0];
    drawn_as_given(&speed, &[0.0, 0.5 * first, first, first + 0.01], 800);
    let (there, back) = (speed.covariance(0.0, first), speed.covariance(first, 0.0));
    assert_eq!(there[1][2], back[2][1]);
    // The speed before the first mark is that at it, but for what changed since.
    let alone = (speed.at(0.0).covariance[1][1] * speed.at(first).covariance[1][1]).sqrt();
    assert!(
        there[1][1] > 0.5 * alone && there[1][1] < alone,
        "{there:?} {alone}"
    );
}
