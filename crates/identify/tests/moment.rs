//! The steady moment: forms distinguished, the band that holds the truth, limits and what is refused.

use crate::made_up::{Random, SENSOR, Sensor, coast_down, coasting, covered, seeds, set, steady};
use identify::Measurement;
use identify::moment::{Form, moment};
use physics::palmgren::viscous_moment;

#[test]
fn the_band_holds_a_moment_of_another_law() {
    let count = seeds(30);
    let (mut inside, mut of) = (0.0, 0.0);
    let (mut slowly, mut slowly_of) = (0.0, 0.0);
    let (mut quick, mut quick_of) = (0.0, 0.0);
    for seed in 0..count {
        let mut random = Random::new(seed);
        let scale = random.normal();
        // one slow coast-down of 20 s; or three of 3 s
        let slow = coast_down(&mut random, 20.0, 0.01, scale);
        let three: Vec<Measurement> = (0..3)
            .map(|_| coast_down(&mut random, 3.0, 0.01, scale))
            .collect();
        // noise that is alike over a second, a twentieth of the record
        let sensor = Sensor {
            length: 1.0,
            ..SENSOR
        };
        let drifting = coasting(&mut random, 20.0, 0.01, scale, &steady, &sensor);
        for (tests, inside, of) in [
            (vec![&slow], &mut inside, &mut of),
            (vec![&drifting], &mut slowly, &mut slowly_of),
            (three.iter().collect(), &mut quick, &mut quick_of),
        ] {
            let found = moment(&tests, &set(), None).unwrap();
            let (low, high) = found.curve.range();
            for k in 0..=20 {
                let speed = low + (high - low) * f64::from(k) / 20.0;
                let own = found.curve.at(speed.clamp(low, high)).unwrap();
                *of += 1.0;
                if (own.value - steady(speed)).abs() <= 2.0 * own.deviation {
                    *inside += 1.0;
                }
            }
        }
    }
    covered("M, one coast-down of 20 s", inside, of, count);
    // a smoothed noise as slow as this is no autoregression: the band is wider than it need be, never narrower
    println!("M, noise of 0.6 s: {:.1} %", 100.0 * slowly / slowly_of);
    assert!(slowly / slowly_of >= 0.93);
    covered("M, three of 3 s", quick, quick_of, count);
}

#[test]
fn the_law_that_made_the_data_wins() {
    let diameter = 2.0 * set().inner_track_radius * (1.0 + set().ball_ratio);
    let viscosity = 100e-6;
    let palmgren = |speed: f64| viscous_moment(2.0, viscosity, speed, diameter) + 3e-3;
    let skf = |speed: f64| {
        let part = speed / 100.0;
        8e-3 * part.powf(0.6) + 3e-3 + 1e-3 * part * part
    };
    // a bump that no law has
    let bump = |speed: f64| steady(speed) + 4e-3 * (-((speed - 70.0) / 12.0).powi(2)).exp();
    let truths: [(Form, &dyn Fn(f64) -> f64); 3] = [
        (Form::Palmgren, &palmgren),
        (Form::Skf, &skf),
        (Form::Spline, &bump),
    ];
    for (form, truth) in truths {
        let mut random = Random::new(7);
        let test = coasting(&mut random, 30.0, 0.01, 0.0, truth, &SENSOR);
        let found = moment(&[&test], &set(), Some(viscosity)).unwrap();
        assert_eq!(
            found.best().form,
            form,
            "{:?}",
            found
                .forms
                .iter()
                .map(|f| (f.form, f.probability))
                .collect::<Vec<_>>()
        );
        assert!(found.best().probability > 0.9);
        let sum: f64 = found.forms.iter().map(|f| f.probability).sum();
        assert!((sum - 1.0).abs() < 1e-12);
        assert!(found.best().noise_correlation >= 0.0 && found.effective_data <= found.data as f64);
        let best = found.best();
        match form {
            Form::Palmgren => {
                let names: Vec<&str> = best.parameters.iter().map(|p| p.name.as_str()).collect();
                assert_eq!(names, ["f0", "M1", "zero of coast-down"]);
                let f0 = best.parameters[0].value;
                assert!((f0.value - 2.0).abs() < 4.0 * f0.deviation && f0.deviation < 0.1);
                // what the torque cannot separate: a constant moment and a zero
                assert!(best.correlation[1][2] < -0.8, "{:?}", best.correlation);
            }
            Form::Skf => assert_eq!(best.parameters[0].name, "rolling at 100 rad/s"),
            Form::Spline => assert_eq!(best.parameters.len(), 1),
        }
    }
}

#[test]
fn nothing_is_said_outside_the_measured_speeds() {
    let mut random = Random::new(3);
    let test = coast_down(&mut random, 10.0, 0.01, 0.0);
    let found = moment(&[&test], &set(), None).unwrap();
    let (low, high) = found.curve.range();
    let measured = |f: fn(f64, f64) -> f64, from| test.speed.iter().fold(from, |a, &b| f(a, b));
    assert!(low >= measured(f64::min, f64::MAX) && high <= measured(f64::max, 0.0));
    assert!(found.curve.at(1.011 * high).is_none() && found.curve.at(0.9 * low).is_none());
    assert!(found.curve.at(high).is_some() && found.curve.at(-low).is_some());
}

#[test]
fn turning_the_other_way_gives_the_same_curve() {
    let mut random = Random::new(5);
    let test = coast_down(&mut random, 10.0, 0.01, 0.0);
    let mut turned = test.clone();
    for list in [
        &mut turned.speed,
        &mut turned.acceleration,
        &mut turned.torque,
    ] {
        list.iter_mut().for_each(|x| *x = -*x);
    }
    let (ahead, back) = (
        moment(&[&test], &set(), None).unwrap(),
        moment(&[&turned], &set(), None).unwrap(),
    );
    assert_eq!(ahead.curve, back.curve);
}

#[test]
fn up_is_set_against_down() {
    let mut random = Random::new(11);
    let down = coast_down(&mut random, 15.0, 0.01, 0.0);
    let mut same = coast_down(&mut random, 15.0, 0.01, 0.0);
    let reverse = |test: &mut Measurement| {
        for list in [&mut test.speed, &mut test.torque, &mut test.acceleration] {
            list.reverse();
        }
        test.acceleration.iter_mut().for_each(|a| *a = -*a);
        test.name = "run-up".into();
    };
    reverse(&mut same);
    let mut other = same.clone();
    other.torque.iter_mut().for_each(|t| *t += 3e-3);
    let agreeing = moment(&[&same, &down], &set(), None)
        .unwrap()
        .up_against_down
        .unwrap();
    assert!(agreeing.chance > 0.01, "{}", agreeing.chance);
    let apart = moment(&[&other, &down], &set(), None).unwrap();
    let found = apart.up_against_down.unwrap();
    // 3 N mm, two zeros of 0.3 N mm
    assert!(
        found.chance < 0.01 && (found.mean.value - 3e-3).abs() < 1.3e-3,
        "{found:?}"
    );
    assert!(
        apart
            .notes
            .iter()
            .any(|note| note.to_string().contains("speeding up")),
        "{:?}",
        apart.notes
    );
}

#[test]
fn laws_and_curves_without_a_law_agree() {
    let mut random = Random::new(17);
    let test = coast_down(&mut random, 20.0, 0.01, 0.0);
    let found = moment(&[&test], &set(), None).unwrap();
    let at: Vec<f64> = (1..15).map(|k| 10.0 * f64::from(k)).collect();
    let other = identify::steady_curve::direct(&test.speed, &test.torque, &at).unwrap();
    for (k, deviation) in other.deviation().into_iter().enumerate() {
        let own = found.curve.at(at[k]).unwrap();
        // the same zero is in both; inertia is 0.01 N mm
        assert!(
            (own.value - other.torque[k]).abs() < 3.0 * (deviation + 0.2e-3),
            "{}",
            at[k]
        );
    }
}

#[test]
fn what_cannot_be_a_steady_moment_is_refused() {
    let mut random = Random::new(1);
    let test = coast_down(&mut random, 10.0, 0.01, 0.0);
    let refused = |tests: &[&Measurement], viscosity: Option<f64>| {
        moment(tests, &set(), viscosity).err().unwrap_or_default()
    };
    assert!(refused(&[], None).contains("needs a slow test"));
    let heavy = Measurement {
        load: 100.0,
        name: "heavy".into(),
        ..test.clone()
    };
    let why = refused(&[&test, &heavy], None);
    assert!(
        why.contains("50 N") && why.contains("heavy") && why.contains("100 N"),
        "{why}"
    );
    assert!(refused(&[&test.between(0.0, 0.05)], None).contains("too short or not slow"));
    let mut one = test.clone();
    one.speed.iter_mut().for_each(|s| *s = 100.0);
    assert!(refused(&[&one], None).contains("range of speeds"));
    let mut short = test.clone();
    short.torque.pop();
    assert!(refused(&[&short], None).contains("1000 torques for 1001 times"));
    let mut broken = test.clone();
    broken.torque[5] = f64::NAN;
    assert!(refused(&[&broken], None).contains("number 5 of the torques is NaN"));
    let mut silent = test.clone();
    silent.torque.iter_mut().for_each(|t| *t = 0.0);
    silent.acceleration.iter_mut().for_each(|t| *t = 0.0);
    assert!(refused(&[&silent], None).contains("0 throughout"));
    assert!(refused(&[&test], Some(-1.0)).contains("viscosity"));
    let unknown = physics::rolling::RollingSet {
        cage_mass: f64::NAN,
        ..set()
    };
    assert!(moment(&[&test], &unknown, None).is_err());
}

#[test]
fn slow_tests_that_disagree_are_named() {
    let mut alarms = 0;
    for seed in 0..6 {
        let mut random = Random::new(500 + seed);
        let scale = random.normal();
        let mut one = coast_down(&mut random, 10.0, 0.01, scale);
        let mut other = coast_down(&mut random, 10.0, 0.01, scale);
        (one.name, other.name) = ("monday".into(), "friday".into());
        // of one bearing
        alarms += u32::from(
            moment(&[&one, &other], &set(), None)
                .unwrap()
                .unequal
                .is_some(),
        );
        // of another: half as much again
        let more = |speed: f64| 1.5 * steady(speed);
        let mut third = coasting(&mut random, 10.0, 0.01, scale, &more, &SENSOR);
        third.name = "another".into();
        let found = moment(&[&one, &other, &third], &set(), None).unwrap();
        let unequal = found.unequal.expect("a difference of a half");
        assert_eq!(unequal.tests.0, "another");
        // the ratio of the means over the common speeds, each known to a per cent or two
        assert!((unequal.ratio - 1.5).abs() < 0.1, "{unequal:?}");
        assert!(unequal.forbids_comparison());
        assert!(
            unequal.finding().to_string().contains("another"),
            "{}",
            unequal.finding()
        );
    }
    assert_eq!(alarms, 0, "of six pairs of one bearing");
}
