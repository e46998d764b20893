//! Doubts: each wrong set of tests is named with its numbers, and a sound one raises none.

use crate::made_up::{Random, coast_down, rolling_spin_up, set, steady};
use identify::data_checks::{CheckSettings, Finding, doubts};
use identify::moment::SteadyMoment;
use identify::{CageTrace, Measurement};
use statistics::uncertain::Uncertain;

fn curve(factor: f64) -> SteadyMoment {
    let speed: Vec<f64> = (0..400).map(|k| 0.4 * f64::from(k)).collect();
    SteadyMoment {
        load: 50.0,
        moment: speed.iter().map(|s| factor * steady(*s)).collect(),
        // 0.2 N mm that all speeds share
        covariance: vec![vec![4e-8; 400]; 400],
        scale_deviation: 0.01,
        speed,
    }
}

fn test(seed: u64) -> Measurement {
    let mut test = rolling_spin_up(&mut Random::new(seed), 7200.0, 5.0, 0.0).0;
    test.cage = Some(CageTrace::independent(
        test.time.clone(),
        test.speed.iter().map(|s| set().cage_speed(*s)).collect(),
        vec![0.25; test.time.len()],
    ));
    test
}

fn said(tests: &[&Measurement], steady: &SteadyMoment, settings: &CheckSettings) -> Vec<Finding> {
    let found = doubts(tests, Some(steady), &set(), settings).unwrap();
    for doubt in &found {
        // the name of the test stands before what is found
        let finding = doubt.finding.note().to_string();
        let named = doubt
            .test
            .as_ref()
            .is_some_and(|test| finding.contains(test));
        assert!(finding.len() > 30 && !named, "{finding}");
    }
    found.into_iter().map(|doubt| doubt.finding).collect()
}

fn stated() -> CheckSettings {
    CheckSettings {
        wanted_speed: Some(140.0),
        ball_count: Some(10),
        moment_per_kelvin: Some(Uncertain::new(-0.025, 0.0075)),
    }
}

#[test]
fn sound_tests_raise_no_doubt() {
    // three deviations, three comparisons a test: about one false doubt in a hundred tests
    let mut raised = 0;
    for seed in 0..20 {
        raised += said(&[&test(seed)], &curve(1.0), &stated()).len();
    }
    assert!(raised <= 1, "{raised}");
}

#[test]
fn a_test_that_never_reaches_the_speed() {
    let settings = CheckSettings {
        wanted_speed: Some(180.0),
        ..stated()
    };
    let found = said(&[&test(1)], &curve(1.0), &settings);
    let [
        Finding::NeverReaches {
            reached, wanted, ..
        },
    ] = &found[..]
    else {
        panic!("{found:?}")
    };
    assert!((reached - 150.0).abs() < 1.0 && *wanted == 180.0);
}

#[test]
fn a_coast_down_of_another_bearing() {
    let found = said(&[&test(2)], &curve(1.6), &stated());
    let [
        Finding::ForeignSteadyMoment {
            difference,
            ratio,
            speed,
            ..
        },
    ] = &found[..]
    else {
        panic!("{found:?}")
    };
    assert!((ratio - 1.0 / 1.6).abs() < 0.05 && (speed - 150.0).abs() < 1.0);
    // a lubricant may be in another state; beyond a factor of two explanations are not compared
    for (factor, forbids) in [(1.6, false), (3.0, true), (0.4, true)] {
        let found = said(&[&test(2)], &curve(factor), &stated());
        let forbidden = found.iter().any(Finding::forbids_comparison);
        assert_eq!(forbidden, forbids, "{factor}: {found:?}");
    }
    // 0.6 of 23 N mm
    assert!((difference.value + 0.6 * steady(150.0)).abs() < 1.5e-3);
    let other_load = SteadyMoment {
        load: 100.0,
        ..curve(1.0)
    };
    let found = said(&[&test(2)], &other_load, &stated());
    assert!(
        matches!(&found[..], [Finding::LoadOfSteadyMoment { load, steady_load, .. }] if *load == 50.0 && *steady_load == 100.0)
    );
}

#[test]
fn tests_at_different_loads() {
    let heavy = Measurement {
        load: 100.0,
        name: "heavy".into(),
        ..test(4)
    };
    let found = said(&[&test(3), &heavy], &curve(1.0), &stated());
    let Finding::MixedLoads { loads } = &found[0] else {
        panic!("{found:?}")
    };
    assert_eq!(loads[1], ("heavy".to_string(), 100.0));
}

#[test]
fn a_cage_signal_of_the_wrong_ball_count() {
    for (given, fits) in [(10u32, 9u32), (10, 11), (9, 10), (10, 7), (8, 16)] {
        let mut wrong = test(6);
        let factor = f64::from(fits) / f64::from(given);
        wrong
            .cage
            .as_mut()
            .unwrap()
            .speed
            .iter_mut()
            .for_each(|s| *s *= factor);
        let settings = CheckSettings {
            ball_count: Some(given),
            ..stated()
        };
        let found = said(&[&wrong], &curve(1.0), &settings);
        let [
            Finding::WrongBallCount {
                stated: a,
                fits: b,
                ratio,
                ..
            },
        ] = &found[..]
        else {
            panic!("{found:?}")
        };
        assert_eq!((*a, *b), (given, fits));
        assert!((ratio.value - factor).abs() < 0.01);
    }
    // 4 % off fits no count of ten
    let mut odd = test(6);
    odd.cage
        .as_mut()
        .unwrap()
        .speed
        .iter_mut()
        .for_each(|s| *s *= 0.96);
    let found = said(&[&odd], &curve(1.0), &stated());
    assert!(
        matches!(found[..], [Finding::CageNeverRolls { .. }]),
        "{found:?}"
    );
}

#[test]
fn a_cage_that_skids_in_the_hold_is_not_miscounted() {
    // 0.8 of rolling in the hold, as eight of ten balls would be, 0.9 while it runs down for longer than it was held
    let mut skids = test(6);
    let (end, down) = (skids.time[skids.time.len() - 1], 8.0);
    let hold = skids.time.len();
    for k in 1..8000 {
        let time = 1e-3 * f64::from(k);
        let left = 1.0 - time / down;
        skids.time.push(end + time);
        let speed = skids.speed[hold - 1] * left;
        skids.speed.push(speed);
        skids.acceleration.push(-skids.speed[hold - 1] / down);
        for list in [
            &mut skids.speed_deviation,
            &mut skids.acceleration_deviation,
            &mut skids.torque,
            &mut skids.torque_deviation,
            &mut skids.correlation_time,
        ] {
            list.push(list[hold - 1]);
        }
    }
    let speeds: Vec<f64> = (skids.time.iter().zip(&skids.speed))
        .map(|(time, speed)| set().cage_speed(*speed) * if *time > end { 0.9 } else { 0.8 })
        .collect();
    skids.cage = Some(CageTrace::independent(
        skids.time.clone(),
        speeds,
        vec![0.25; skids.time.len()],
    ));
    let found = said(&[&skids], &curve(1.0), &stated());
    let cages: Vec<&Finding> = (found.iter())
        .filter(|finding| finding.note().to_string().contains("cage settles"))
        .collect();
    let [Finding::CageNeverRolls { ratio, .. }] = cages[..] else {
        panic!("{found:?}")
    };
    assert!((ratio.value - 0.8).abs() < 0.01, "{ratio}");
    // a constant ratio may be a count; beside a slip that is known it is none
    let mut wrong = test(6);
    let cage = wrong.cage.as_mut().unwrap();
    cage.speed.iter_mut().for_each(|speed| *speed *= 0.8);
    let found = said(&[&wrong], &curve(1.0), &stated());
    assert!(matches!(
        found[..],
        [Finding::WrongBallCount { fits: 8, .. }]
    ));
    let wrong = doubts(&[&wrong], None, &set(), &stated())
        .unwrap()
        .remove(0);
    let beside = wrong.beside_a_slip();
    assert!(matches!(beside.finding, Finding::CageNeverRolls { .. }));
    assert!(
        !beside
            .finding
            .note()
            .to_string()
            .contains("balls would make it roll")
    );
}

#[test]
fn a_temperature_that_explains_everything() {
    // 20 % below M, and 10 K: 1 to 4 % a kelvin take 10 to 33 % off M
    let mut warm = test(7);
    let rise: Vec<f64> = warm
        .time
        .iter()
        .map(|t| 10.0 * (1.0 - (-t / 0.5_f64).exp()))
        .collect();
    warm.temperature = Some(rise);
    let found = said(&[&warm], &curve(1.25), &stated());
    let explained = |found: &[Finding]| {
        found
            .iter()
            .any(|d| matches!(d, Finding::TemperatureExplains { .. }))
    };
    assert!(explained(&found), "{found:?}");
    // by the moment itself: 2 % ± ½ % a kelvin take up to 26 % within two deviations, 1 % takes 10 %
    for (change, explains) in [
        (Uncertain::new(-0.02, 0.005), true),
        (Uncertain::new(-0.02, 0.0), true),
        (Uncertain::new(-0.01, 0.0), false),
    ] {
        let by_moment = CheckSettings {
            moment_per_kelvin: Some(change),
            ..stated()
        };
        let found = said(&[&warm], &curve(1.25), &by_moment);
        assert_eq!(explained(&found), explains, "{change:?}");
    }
    // 1 K explains 4 % at most
    let mut cool = warm.clone();
    cool.temperature
        .as_mut()
        .unwrap()
        .iter_mut()
        .for_each(|t| *t *= 0.1);
    assert!(!explained(&said(&[&cool], &curve(1.25), &stated())));
    // warmer and *more* torque: not by viscosity
    assert!(!explained(&said(&[&warm], &curve(0.8), &stated())));
}

#[test]
fn a_torque_that_has_not_settled_and_a_record_too_short() {
    let mut drifting = test(8);
    for (torque, time) in drifting.torque.iter_mut().zip(&drifting.time) {
        *torque -= 2e-3 * (time - 0.2).max(0.0);
    }
    let found = said(&[&drifting], &curve(1.0), &stated());
    let change = found.iter().find_map(|d| match d {
        Finding::NotSettled { change, over, .. } => Some((change.value, *over)),
        _ => None,
    });
    // 2 N mm/s over a quarter of 5 s
    let (change, over) = change.unwrap_or_else(|| panic!("{found:?}"));
    assert!((over - 1.25).abs() < 0.02 && (change + 2.5e-3).abs() < 0.4e-3);
    let short = test(9).between(0.0, 1.0);
    let found = said(&[&short], &curve(1.0), &stated());
    assert!(
        matches!(found[..], [Finding::TooShort { lasts, needed, .. }] if needed == 4.0 && (lasts - 0.77).abs() < 0.02),
        "{found:?}"
    );
}

#[test]
fn speeds_outside_the_steady_moment() {
    let mut narrow = curve(1.0);
    narrow.speed.iter_mut().for_each(|s| *s *= 0.75);
    let found = said(&[&test(10)], &narrow, &stated());
    assert!(
        matches!(&found[..], [Finding::OutsideMoment { part, range, .. }] if *part > 0.9 && range.1 < 120.0)
            && found[0].forbids_comparison(),
        "{found:?}"
    );
}

#[test]
fn broken_measurements_are_refused_not_doubted() {
    let mut broken = test(1);
    broken.speed[3] = f64::INFINITY;
    assert!(
        doubts(&[&broken], None, &set(), &stated())
            .unwrap_err()
            .contains("number 3 of the speeds")
    );
    assert!(doubts(&[], None, &set(), &stated()).unwrap().is_empty());
    let still = Measurement {
        speed: vec![0.0; test(1).time.len()],
        ..test(1)
    };
    assert!(doubts(&[&still], Some(&curve(1.0)), &set(), &stated()).is_ok());
}

#[test]
fn a_reading_of_the_wrong_sign_or_unit_is_named() {
    use identify::data_checks::reading;
    let mut random = Random::new(21);
    let test = coast_down(&mut random, 10.0, 0.01, 0.0);
    let times = |factor: f64| {
        let mut other = test.clone();
        other.zero_deviation *= factor.abs();
        for list in [&mut other.torque, &mut other.torque_deviation] {
            list.iter_mut().for_each(|value| *value *= factor);
        }
        (other.torque_deviation.iter_mut()).for_each(|value| *value = value.abs());
        other
    };
    for viscosity in [None, Some(100e-6)] {
        assert_eq!(reading(&test, &set(), viscosity), None);
        // a bearing that has ten times the friction of its law is a bad one, no wrong unit
        assert_eq!(reading(&times(10.0), &set(), viscosity), None);
        let reversed = reading(&times(-1.0), &set(), viscosity).expect("it drives");
        assert!(
            matches!(&reversed.finding, Finding::Reversed { moment, .. } if moment.value < 0.0)
        );
        assert!(
            (reversed.finding.note().to_string()).contains("signals.torque.scale = \"-1 N mm\"")
        );
        for (factor, named) in [(1e3, "factor of 1e3 "), (1e-3, "factor of 1e-3 ")] {
            let wrong = reading(&times(factor), &set(), viscosity).expect("no such bearing");
            assert!(wrong.finding.forbids_comparison());
            let said = wrong.finding.note().to_string();
            assert!(said.contains(named), "{said}");
        }
    }
}
