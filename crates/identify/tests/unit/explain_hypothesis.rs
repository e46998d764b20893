use super::super::record::LeastWidth;
use super::super::steady::known;
use super::*;

/// A bearing with a flat curve of 20 N mm, and a test that holds 150 rad/s for 4 s and then rests.
fn with_test(check: impl Fn(&Bearing, &Trial)) {
    let steady = known(vec![1.0, 150.0], vec![20e-3, 20e-3]);
    let set = RollingSet {
        inner_track_radius: 14.8e-3,
        ball_ratio: 0.214,
        balls_mass: 10.5e-3,
        cage_mass: 8e-3,
    };
    let speed =
        |t: f64| 150.0 * (t / 0.02).clamp(0.0, 1.0) * (1.0 - (t - 4.0) / 0.5).clamp(0.0, 1.0);
    let settings = Settings::default();
    let bearing = Bearing::new(&steady, 150.0, &set, &settings, false);
    let test = Trial::planned(
        &speed,
        6.0,
        &LeastWidth::even(0.02),
        &bearing.table,
        set.outer_inertia(),
    );
    check(&bearing, &test);
}

#[test]
fn grease_builds_up_over_cage_angle_and_breaks_down_over_time() {
    with_test(|bearing, test| {
        let (fresh, worked, angle, time) = (0.6, 0.7, 10.0, 1.5);
        let grease = Grease {
            rested_factor: fresh,
            build_up_angle: angle,
            worked_factor: worked,
            breakdown_time: time,
            recovery_time: f64::INFINITY,
        };
        let factors: Vec<f64> = grease_factor(grease, test, bearing.set).collect();
        for (step, factor) in test.steps.iter().zip(factors) {
            let middle = step.elapsed - 0.5 * step.duration;
            if !(0.05..4.0).contains(&middle) {
                continue;
            }
            // closed forms: the cage has turned ω_c (t - 10 ms) after a ramp of 20 ms
            let turned = bearing.set.cage_speed(150.0) * (middle - 0.01);
            let build_up = 1.0 - (-turned / angle).exp();
            let breakdown = 1.0 - (-middle / time).exp();
            let expected = (fresh + (1.0 - fresh) * build_up) * (1.0 - (1.0 - worked) * breakdown);
            // the breakdown waits some ms for the cage to turn: 0.01 s/1.5 s of 30 %
            assert!((factor - expected).abs() < 3e-3, "{middle}");
        }
    });
}

#[test]
fn another_steady_moment_has_another_level_and_another_load_part() {
    with_test(|bearing, test| {
        // of a curve that is 10 N mm and 10 more with the speed: 1.2 and 1.32 of it at 150 and 75 rad/s, so d = 0.36
        let grown = known(vec![1.0, 150.0], vec![10e-3, 20e-3]);
        let table = Continued(&grown).table(150.0);
        for (speed, factor) in [(150.0, 1.2), (75.0, 1.32)] {
            let moment = table.at(speed).0;
            let step = Step {
                steady: moment,
                ..test.steps[test.steps.len() / 3]
            };
            let expected = factor * moment;
            let found = another_moment(&[1.2, 1.1], &step, &table);
            assert!((found / expected - 1.0).abs() < 5e-3, "{speed} {found}");
        }
        // held: its ratio at the highest speed, and no part of inertia
        let coordinates = [1.2_f64, 1.1].map(f64::ln);
        let scale = [2.0_f64, 1.25].map(|high| high.ln() / 1.644_853_627);
        let z = [coordinates[0] / scale[0], coordinates[1] / scale[1]];
        let tests = std::slice::from_ref(test);
        let torque = Hypothesis::AnotherMoment.predict(&z, tests, bearing).torque;
        let held = (test.bins.iter())
            .position(|bin| bin.from > 1.0)
            .expect("a hold");
        assert!((torque[held] - 24e-3).abs() < 1e-9, "{}", torque[held]);
    });
}

#[test]
fn a_test_after_a_rest_begins_with_what_is_left() {
    with_test(|bearing, test| {
        let bearing = Bearing {
            repeated: true,
            table: bearing.table.clone(),
            ..*bearing
        };
        // medians of the priors: fresh, worked; a recovery of √(30·36000) s
        let size = Hypothesis::Grease.parameters(&bearing).len();
        let values = Hypothesis::Grease.values(&vec![0.0; size], &bearing);
        let recovery = (30.0_f64 * 36_000.0).sqrt();
        assert!(
            (Hypothesis::Grease.recovery(&values, &bearing).unwrap() / recovery - 1.0).abs() < 1e-9
        );
        let after = |rest: f64| {
            let test = Trial {
                rest_before: Some(rest),
                ..test.clone()
            };
            let tests = std::slice::from_ref(&test);
            Hypothesis::Grease
                .predict(&vec![0.0; size], tests, &bearing)
                .torque
        };
        let rested = Hypothesis::Grease
            .predict(&vec![0.0; size], std::slice::from_ref(test), &bearing)
            .torque;
        // after many recoveries all is as after a long rest
        for (long, rested) in after(50.0 * recovery).iter().zip(&rested) {
            assert!((long - rested).abs() < 1e-12);
        }
        // at once: built up and worked from the first turn on, M1 + g_w M0 of a flat curve of 20 N mm
        let reference = bearing.table.reference;
        let expected = reference * (1.0 - values[0] + values[0] * values[2]);
        let held = (test.bins.iter()).position(|bin| bin.from > 0.1).unwrap();
        assert!((after(0.0)[held] / expected - 1.0).abs() < 1e-3);
        // half of it left: b = w = ½ at the begin, so early torque lies between
        let half = after(recovery * 2.0_f64.ln())[held];
        assert!(half > rested[held].min(expected) && half < reference);
    });
}

#[test]
fn at_rest_only_a_drift_is_left_and_a_slow_sensor_follows() {
    with_test(|bearing, test| {
        let tests = std::slice::from_ref(test);
        let end = test.bins.len() - 1;
        let stop = (test.bins.iter())
            .position(|bin| bin.from > 4.49)
            .expect("a rest after the run-down");
        for form in Explanation::ALL.into_iter().flat_map(Hypothesis::of) {
            let size = form.parameters(bearing).len();
            let torque = form.predict(&vec![0.0; size], tests, bearing).torque;
            match form {
                Hypothesis::Drift { sign } => assert!(sign * torque[end] > 1e-3),
                // after 1.5 s of rest five time constants (0.22 s) have passed
                Hypothesis::SlowSensor => {
                    assert!(torque[stop] > 1e-3 && torque[end].abs() < 1e-4);
                }
                _ => assert!(torque[end].abs() < 1e-4, "{form:?} {}", torque[end]),
            }
        }
    });
}
