//! A test put together from the pulses of a shaft and a torque without its sensor's swing.

use identify::CageTrace;
use identify::signals::{Signals, measurement};
use identify::slip::cage_slip;
use measure::pulse::{Edges, Wheel, number};
use measure::speed::{Speed, SpeedSettings, Transient, smooth};
use measure::torque_sensor::Torque;
use physics::rolling::RollingSet;
use statistics::uncertain::Uncertain;
use std::f64::consts::TAU;

const MARKS: usize = 60;
/// The record ends here, s.
const END: f64 = 13.0;
/// What the reading shows without torque, N m.
const OFFSET: f64 = 1.5e-3;

/// A coast-down from 150 rad/s with 15 rad/s² that stops at 10 s, seen by 60 marks.
fn coast_down() -> Speed {
    let mark = TAU / MARKS as f64;
    let times: Vec<f64> = (1..)
        .map(|k| f64::from(k) * mark)
        .take_while(|angle| *angle < 750.0)
        .map(|angle| 10.0 - (2.0 * (750.0 - angle) / 15.0).sqrt())
        .collect();
    let edges = Edges::stamped(times, 1e-6, Some((0.0, END))).unwrap();
    let wheel = Wheel {
        marks: MARKS,
        missing: 0,
    };
    let pulses = number(&edges, &wheel).unwrap();
    let settings = SpeedSettings {
        transient: Transient::None,
        ..SpeedSettings::default()
    };
    smooth(&pulses, None, &settings).unwrap()
}

/// 20 N mm while it turns and a reading that is off by [`OFFSET`], with a ripple of 0.1 N mm.
fn torque(interval: f64) -> Torque {
    let count = (END / interval) as usize;
    let time: Vec<f64> = (0..count).map(|k| k as f64 * interval).collect();
    let all = |value: f64| vec![value; count];
    Torque {
        torque: (time.iter())
            .map(|t| OFFSET + 1e-4 * (7.0 * t).sin() + if *t < 10.0 { 20e-3 } else { 0.0 })
            .collect(),
        // noise of 0.4 beside the zero's 3 N mm
        deviation: all(3e-3_f64.hypot(0.4e-3)),
        rate: all(0.0),
        rate_deviation: all(20e-3),
        disturbance: all(0.0),
        disturbance_deviation: all(0.0),
        disturbance_power: 0.0,
        zero: Uncertain::new(0.0, 3e-3),
        noise: 0.4e-3,
        shown_frequency: None,
        notes: Vec::new(),
        time,
    }
}

fn signals<'a>(speed: &'a Speed, torque: &'a Torque) -> Signals<'a> {
    Signals {
        name: "coast-down",
        load: 60.0,
        speed,
        fastest: 150.0,
        silence: 2.0 * TAU / MARKS as f64,
        torque,
        scale_deviation: 0.01,
        cage: None,
        settling_time: 0.5,
        rest_before: None,
    }
}

#[test]
fn behind_its_last_pulse_a_shaft_rests_and_the_reading_shows_its_zero() {
    let (speed, torque) = (coast_down(), torque(1e-3));
    let found = measurement(&signals(&speed, &torque));
    assert!(found.sound().is_ok());
    let at = |time: f64| (time * 1e3) as usize;
    // it turns as it does, and rests from the last pulse on, some hundredths of a second before 10 s
    assert!((found.speed[at(4.0)] - 90.0).abs() < 0.05);
    assert_eq!(
        (found.speed[at(10.1)], found.acceleration[at(10.1)]),
        (0.0, 0.0)
    );
    // just behind it the last speed is still open, later a hundredth of a rad/s
    let last = speed.at(speed.range().1).speed;
    assert!(found.speed_deviation[at(10.1)] > last && found.speed_deviation[at(11.0)] == 0.01);
    // the offset is gone, but for what the ripple leaves of a mean over 2.6 s
    assert!((found.torque[at(4.0)] - 20e-3 - 1e-4 * 28_f64.sin()).abs() < 3e-5);
    // its deviation is the scatter of means over a third of a second, not the 3 N mm from before
    assert!(found.zero_deviation < 1e-4 && found.zero_deviation > 1e-5);
    let expected = 0.4e-3_f64.hypot(found.zero_deviation);
    assert!((found.torque_deviation[at(4.0)] / expected - 1.0).abs() < 1e-9);
    assert!((found.correlation_time[at(4.0)] - 2.0 * 0.4e-3 / 20e-3).abs() < 1e-9);
}

#[test]
fn a_record_that_ends_while_the_shaft_turns_has_no_rest() {
    let speed = coast_down();
    let mut torque = torque(1e-3);
    let count = 9_800;
    for list in [&mut torque.time, &mut torque.torque, &mut torque.deviation] {
        list.truncate(count);
    }
    torque.rate_deviation.truncate(count);
    let found = measurement(&signals(&speed, &torque));
    // the last pulses lie behind its end: nothing is at rest, and the zero is as uncertain as it was
    assert!(found.speed.iter().all(|speed| *speed > 0.0));
    assert_eq!(found.zero_deviation, 3e-3);
    assert!((found.torque[4_000] - 20e-3 - OFFSET).abs() < 1.1e-4);
}

#[test]
fn many_times_are_thinned_alike() {
    let (speed, quick) = (coast_down(), torque(1e-4));
    let found = measurement(&signals(&speed, &quick));
    // 130 000 times, every seventh
    assert_eq!(found.time.len(), 130_000_usize.div_ceil(7));
    assert!((found.time[1] - 7e-4).abs() < 1e-12);
    assert!(found.sound().is_ok());
}

/// Where a clutch engages, and where it locks, s.
const ENGAGED: f64 = 1.0;
const LOCKED: f64 = ENGAGED + 2.0 * 150.0 / 9000.0;

/// From rest to 150 rad/s by an acceleration that rises evenly to 9000 rad/s², seen by 360 stamped marks.
fn spin_up() -> (Speed, impl Fn(f64) -> f64) {
    let length = LOCKED - ENGAGED;
    let turned = 9000.0 / (6.0 * length) * length.powi(3);
    let mark = TAU / 360.0;
    let times: Vec<f64> = (1..)
        .map(|k| f64::from(k) * mark)
        .map(|angle| match angle < turned {
            true => ENGAGED + (angle * 6.0 * length / 9000.0).cbrt(),
            false => LOCKED + (angle - turned) / 150.0,
        })
        .take_while(|time| *time < 3.0)
        .collect();
    let edges = Edges::stamped(times, 1e-6, Some((0.0, 3.0))).unwrap();
    let wheel = Wheel {
        marks: 360,
        missing: 0,
    };
    let speed = smooth(
        &number(&edges, &wheel).unwrap(),
        None,
        &SpeedSettings::default(),
    )
    .unwrap();
    let truth =
        move |time: f64| 0.5 * 9000.0 / length * (time.clamp(ENGAGED, LOCKED) - ENGAGED).powi(2);
    (speed, truth)
}

#[test]
fn a_cage_that_rolls_at_the_lock_does_not_slip() {
    let (speed, truth) = spin_up();
    let change = speed.change.expect("a spin-up");
    let (begin, lock) = (change.engagement.0, change.end.expect("it locks").0);
    // rows 1.6 ms apart, as of a torque arm of 30 Hz; the torque falls from -10 to 25 N mm at the lock
    let mut reading = torque(1.6e-3);
    let count = reading.time.partition_point(|t| *t < 2.9);
    for list in [
        &mut reading.time,
        &mut reading.torque,
        &mut reading.deviation,
        &mut reading.rate,
        &mut reading.rate_deviation,
    ] {
        list.truncate(count);
    }
    for (k, time) in reading.time.iter().enumerate() {
        let inside = *time > begin && *time < lock;
        reading.rate[k] = if inside { -200.0e-3 } else { 0.0 };
        reading.torque[k] = match *time {
            t if t < begin => 0.0,
            t if t < lock => -0.2 * (t - begin),
            _ => 25e-3,
        };
    }
    let found = measurement(&Signals {
        fastest: 150.0,
        ..signals(&speed, &reading)
    });
    assert!(found.sound().is_ok());
    let line = |list: &[f64], time: f64| {
        let next = found.time.partition_point(|t| *t <= time);
        let share = (time - found.time[next - 1]) / (found.time[next] - found.time[next - 1]);
        list[next - 1] + share * (list[next] - list[next - 1])
    };
    for k in 0..2000 {
        let time = begin + 1e-3 + 5e-5 * f64::from(k);
        let (own, deviation) = (line(&found.speed, time), line(&found.speed_deviation, time));
        // half a deviation for the line, three for the pulses; a line over the lock is 3.6 rad/s off
        assert!(
            (own - truth(time)).abs() < 3.5 * deviation.max(0.01),
            "{time}: {own}, not {}",
            truth(time)
        );
    }
    // on either side of the lock the torque is that of the side
    for (by, expected) in [(-2e-4, -0.2 * (lock - begin)), (2e-4, 25e-3)] {
        let own = line(&found.torque, lock + by);
        assert!(
            (own - expected).abs() < 0.1e-3,
            "{by}: {own}, not {expected}"
        );
    }
    let set = RollingSet {
        inner_track_radius: 14.8e-3,
        ball_ratio: 0.214,
        balls_mass: 10.5e-3,
        cage_mass: 8e-3,
    };
    let at: Vec<f64> = (1..30).map(|k| lock + 1e-3 * f64::from(k - 10)).collect();
    let rolling = at.iter().map(|time| set.cage_speed(truth(*time))).collect();
    let trace = CageTrace::independent(at.clone(), rolling, vec![0.05; at.len()]);
    let test = identify::Measurement {
        cage: Some(trace),
        ..found
    };
    let slip = cage_slip(&test, &set).unwrap();
    assert!(slip.slipped.unwrap() < 1e-3, "{:?}", slip.slipped);
}
