//! Shafts that come from rest and to rest: what lies before the first and behind the last mark.

use crate::synthetic::pulses::pulses;
use measure::pulse::{Edges, Wheel, number};
use measure::speed::{SpeedSettings, smooth};

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
