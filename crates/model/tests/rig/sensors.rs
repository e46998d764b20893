//! The arm, the thermocouple, the converter.

use super::bench::{SPEED, clutch, concentric, fidelities, housing, rig, rolls, run, run_with};
use model::bearing::BearingConstants;
use model::system::rig::layout::{ARM, CAGE_ANGLE, OUTER_MOMENT, SHAFT, TEMPERATURE, THERMOCOUPLE};
use model::system::rig::taps::multiplexed;
use model::system::rig::{Disturbance, Engagement, Program, Tap};

#[test]
fn the_arm_reads_the_moment_of_the_outer_race_once_it_has_settled() {
    let mut c = concentric(
        BearingConstants::Rolling(rolls()),
        Program::ramp_and_hold(SPEED, 50.0, 5.0),
    );
    housing(&mut c).arm.disturbance = Disturbance::NONE;
    let run = run(c, 4.0, 1e-6);
    let last = run.record.rows().next_back().expect("rows");
    let (reading, moment) = (last.state[ARM], last.probe[OUTER_MOMENT]);
    // 1 s after the ramp: e^-39, and a motor that creeps to its speed with I/gain = 0.1 s
    assert!((reading / moment - 1.0).abs() < 1e-4, "{reading} {moment}");
    assert!(moment > 0.02, "25 N mm by Palmgren");
}

#[test]
fn the_arm_settles_to_two_percent_in_a_tenth_of_a_second() {
    // a step of the moment: a bearing in motion from the first instant, held at its speed by the flywheel
    let mut c = concentric(
        BearingConstants::Rolling(rolls()),
        Program::coast_down(SPEED, Some(5.0)),
    );
    clutch(&mut c).flywheel.inertia = 1e3;
    housing(&mut c).arm.disturbance = Disturbance::NONE;
    let arm = housing(&mut c).arm;
    let (frequency, ratio) = (arm.natural_frequency, arm.damping_ratio);
    let run = run(c, 0.2, 1e-7);
    let damped = frequency * (1.0 - ratio * ratio).sqrt();
    let decay = ratio * frequency;
    assert!((decay - 39.1).abs() < 1e-9);
    let mut late: f64 = 0.0;
    for row in run.record.rows() {
        let t = row.time;
        let response =
            1.0 - (-decay * t).exp() * ((damped * t).cos() + decay / damped * (damped * t).sin());
        let reading = row.state[ARM] / row.probe[OUTER_MOMENT];
        assert!(
            (reading - response).abs() < 1e-5,
            "{t}: {reading} {response}"
        );
        if t > 0.1 {
            late = late.max((reading - 1.0).abs());
        }
    }
    // e^-3.91 = 0.0200 over √(1-ζ²) = 0.954
    assert!(late < 0.0211, "{late}");
}

#[test]
fn the_disturbance_turns_with_the_shaft_and_grows_with_its_square() {
    let at = |speed: f64| {
        let mut c = concentric(
            BearingConstants::Rolling(rolls()),
            Program::coast_down(speed, Some(5.0)),
        );
        clutch(&mut c).flywheel.inertia = 1e3;
        let arm = housing(&mut c).arm;
        let run = run(c, 1.0, 1e-6);
        // e^-31 after 0.8 s: what is left is forced
        let swing = (run.record.rows())
            .filter(|row| row.time > 0.8)
            .map(|row| {
                let ratio = speed / arm.natural_frequency;
                let gain = 1.0
                    / ((1.0 - ratio * ratio).powi(2) + (2.0 * arm.damping_ratio * ratio).powi(2))
                        .sqrt();
                let behind = (2.0 * arm.damping_ratio * ratio).atan2(1.0 - ratio * ratio);
                let amplitude = 2e-3 * (speed / SPEED).powi(2) * gain;
                let expected = amplitude * (row.state[SHAFT.angle()] + 0.3 - behind).cos();
                (row.state[ARM] - row.probe[OUTER_MOMENT] - expected).abs() / amplitude
            })
            .fold(0.0, f64::max);
        assert!(swing < 1e-2, "{speed}: {swing}");
    };
    at(SPEED);
    at(60.0);
}

#[test]
fn a_run_out_is_there_at_rest_and_an_unbalance_is_not() {
    let disturbance = Disturbance {
        amplitude: 2e-3,
        reference_speed: SPEED,
        exponent: 0.0,
        phase: 0.3,
    };
    for angle in [0.0, 1.0, 4.0] {
        let at_rest = disturbance.moment(angle, 0.0);
        assert!((at_rest - 2e-3 * (angle + 0.3_f64).cos()).abs() < 1e-15);
        // and no jump where it begins to turn
        assert_eq!(at_rest, disturbance.moment(angle, 1e-9));
        for exponent in [1.0, 2.0] {
            let grows = Disturbance {
                exponent,
                ..disturbance
            };
            assert_eq!(grows.moment(angle, 0.0), 0.0);
        }
    }
    let mut c = concentric(
        BearingConstants::Rolling(rolls()),
        Program::ramp_and_hold(SPEED, 50.0, 5.0),
    );
    housing(&mut c).arm.disturbance = disturbance;
    let run = run(c, 0.1, 1e-6);
    let first = run.record.rows().next().expect("rows");
    // settled before the start
    assert_eq!(first.state[ARM], disturbance.moment(0.0, 0.0));
}

#[test]
fn the_thermocouple_follows_the_bearing() {
    let c = concentric(
        BearingConstants::Rolling(rolls()),
        Program::coast_down(SPEED, Some(5.0)),
    );
    let mut c = c;
    clutch(&mut c).flywheel.inertia = 1e4;
    let run = run(c.clone(), 20.0, 1e-6);
    let first = run.record.rows().next().expect("rows");
    let power = first.probe[model::system::rig::layout::BEARING_HEAT];
    // P/G (1 - e^(-t G/C)), and behind it by the lag
    let (fast, slow) = (
        1.0 / housing(&mut c).heat.thermocouple_lag,
        housing(&mut c).heat.conductance / housing(&mut c).heat.capacity,
    );
    for row in run.record.rows() {
        let t = row.time;
        let final_rise = power / housing(&mut c).heat.conductance;
        let rise = final_rise * (1.0 - (-slow * t).exp());
        let reading = final_rise
            * (1.0 + (slow * (-fast * t).exp() - fast * (-slow * t).exp()) / (fast - slow));
        // the flywheel of 1e4 kg m² loses 1e-5 of its speed
        assert!((row.state[TEMPERATURE] - rise).abs() < 1e-4 * final_rise);
        assert!((row.state[THERMOCOUPLE] - reading).abs() < 1e-4 * final_rise);
    }
}

#[test]
fn a_converter_samples_one_channel_after_the_other_and_changes_nothing() {
    let program = || {
        let engagement = Engagement {
            rate: 50.0,
            largest: 3.0,
        };
        Program::spin_up(SPEED, 0.005, engagement, true)
    };
    for bearing in fidelities() {
        let mut taps = multiplexed(&[SHAFT.angle(), ARM, CAGE_ANGLE, THERMOCOUPLE], 42e3);
        assert_eq!(taps[1].first, 1.0 / 42e3);
        // and one on the rows
        taps.push(Tap {
            channel: SHAFT.spin(),
            first: 0.0,
            interval: 5e-4,
        });
        let c = rig(bearing, program());
        let (plain, tapped) = (run(c.clone(), 0.05, 1e-4), run_with(c, 0.05, 1e-4, &taps));
        assert_eq!(plain.end(), tapped.end());
        let lists: Vec<_> = tapped.record.rig().taps.iter().collect();
        assert_eq!(lists.len(), 5);
        for (tap, samples) in &lists[..4] {
            let last = tap.time(samples.len() - 1);
            assert!(last <= 0.05 && 0.05 < tap.time(samples.len()), "{last}");
        }
        // shaft and cage: the same dense output as the rows
        let rows: Vec<f64> = tapped
            .record
            .rows()
            .map(|row| row.state[SHAFT.spin()])
            .collect();
        assert_eq!(&rows[..100], &lists[4].1[..100]);
        // its derivative: angle by samples, speed by rows
        let angle = lists[0].1;
        let middle = angle.len() / 2;
        let interval = lists[0].0.interval;
        let speed = (angle[middle + 1] - angle[middle - 1]) / (2.0 * interval);
        let time = lists[0].0.time(middle);
        let mut rows = tapped.record.rows();
        let before = rows.rfind(|row| row.time < time).expect("rows");
        let after = tapped
            .record
            .rows()
            .find(|row| row.time > time)
            .expect("rows");
        let between = before.state[SHAFT.spin()]..after.state[SHAFT.spin()];
        assert!(between.contains(&speed), "{speed} {between:?}");
        assert!(lists[2].1.last() > Some(&0.0), "the cage turns");
    }
}
