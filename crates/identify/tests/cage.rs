//! Slip of the cage and spin of the balls.

use crate::made_up::{Random, covered, lagging_spin_up, rolling_spin_up, seeds, set, steady};
use identify::moment::SteadyMoment;
use identify::skid::skid;
use identify::slip::{Established, cage_slip};
use identify::{CageTrace, Measurement};

/// A steady moment without error.
fn exact() -> SteadyMoment {
    let speed: Vec<f64> = (0..400).map(|k| 0.4 * f64::from(k)).collect();
    SteadyMoment {
        load: 50.0,
        moment: speed.iter().map(|s| steady(*s)).collect(),
        covariance: vec![vec![0.0; 400]; 400],
        scale_deviation: 0.0,
        speed,
    }
}

#[test]
fn the_true_slip_lies_in_its_band() {
    let count = seeds(30);
    let (mut inside, mut of, mut bracketed) = (0.0, 0.0, 0.0);
    for seed in 0..count {
        let mut random = Random::new(7000 + seed);
        let lag = 0.01 + 0.04 * random.uniform();
        let run = lagging_spin_up(&mut random, 7200.0, lag, 0.0);
        let found = cage_slip(&run.test, &set()).unwrap();
        for point in &found.points {
            let k = (point.time / 1e-3).round() as usize;
            of += 1.0;
            if (point.slip.value - run.slip[k]).abs() <= 2.0 * point.slip.deviation {
                inside += 1.0;
            }
        }
        assert!(found.slipped.unwrap() > 0.999);
        let last = run.slip.iter().rposition(|s| s.abs() > 0.01).unwrap();
        let truth = run.test.time[last];
        match found.established {
            Established::At {
                time,
                earliest,
                latest,
            } => {
                assert!(earliest <= time && latest.is_none_or(|latest| time <= latest));
                if truth >= earliest - 2e-3 && latest.is_none_or(|latest| truth <= latest + 2e-3) {
                    bracketed += 1.0;
                }
            }
            // the record ends in doubt
            Established::Never => {
                bracketed += f64::from(u8::from(
                    truth > run.test.time[run.test.time.len() - 1] - 0.15,
                ))
            }
            Established::Throughout => panic!("seed {seed}"),
        }
    }
    covered("S", inside, of, count);
    println!("time of rolling within its earliest and latest: {bracketed} of {count}");
    // the band of a last crossing is no confidence interval: values alike over 4 ms cross late
    assert!(bracketed >= 0.8 * count as f64);
}

#[test]
fn a_rolling_cage_never_slipped() {
    let mut random = Random::new(9);
    let (mut test, _) = rolling_spin_up(&mut random, 7200.0, 0.2, 0.0);
    test.cage = Some(CageTrace::independent(
        test.time.clone(),
        test.speed.iter().map(|s| set().cage_speed(*s)).collect(),
        vec![0.005; test.time.len()],
    ));
    test.speed_deviation = vec![0.01; test.time.len()];
    let found = cage_slip(&test, &set()).unwrap();
    assert_eq!(found.established, Established::Throughout);
    assert!(found.slipped.unwrap() < 0.05, "{:?}", found.slipped);
    // slip is reported only where the shaft turns
    assert!(found.points.iter().all(|p| p.time > 0.2));
    // a cage at rest: slip 1, never established
    test.cage
        .as_mut()
        .unwrap()
        .speed
        .iter_mut()
        .for_each(|s| *s = 0.0);
    let found = cage_slip(&test, &set()).unwrap();
    assert_eq!(found.established, Established::Never);
    assert!(
        found
            .points
            .iter()
            .all(|p| p.slip.value == 1.0 && p.slipping == 1.0)
    );
}

#[test]
fn without_a_cage_signal_slip_is_not_known() {
    let (test, _) = rolling_spin_up(&mut Random::new(9), 7200.0, 0.2, 0.0);
    assert!(
        cage_slip(&test, &set())
            .unwrap_err()
            .contains("without a cage signal")
    );
    let elsewhere = CageTrace::independent(vec![100.0, 101.0], vec![60.0; 2], vec![0.1; 2]);
    let test = Measurement {
        cage: Some(elsewhere),
        ..test
    };
    assert!(
        cage_slip(&test, &set())
            .unwrap_err()
            .contains("does not turn")
    );
}

#[test]
fn skidding_balls_are_reported_only_by_a_good_torque() {
    let (mut right, mut wrong) = (0, 0);
    let count = 8;
    for seed in 0..count {
        for amount in [0.0, 0.8] {
            let run = lagging_spin_up(&mut Random::new(8000 + seed), 7200.0, 0.02, amount);
            // a lab's sensor: nothing beyond the spin-up
            let found = skid(&run.test, &exact(), &set(), None).unwrap();
            assert!(
                found.known_until.is_none_or(|t| t < 0.3),
                "{:?}",
                found.known_until
            );
            // one a hundred times better, and a bearing whose F is known to be small
            let reading: Vec<f64> = run
                .test
                .torque
                .iter()
                .zip(&run.torque)
                .map(|(own, exact)| exact + 0.01 * (own - exact))
                .collect();
            let test = Measurement {
                torque: reading,
                torque_deviation: vec![0.007e-3; run.test.time.len()],
                zero_deviation: 0.003e-3,
                scale_deviation: 0.0,
                ..run.test.clone()
            };
            let found = skid(&test, &exact(), &set(), Some(0.002)).unwrap();
            // after the cage has caught up, before the balls have
            for point in found
                .points
                .iter()
                .filter(|p| p.time > 0.33 && p.time < 0.35)
            {
                let k = (point.time / 1e-3).round() as usize;
                let truth = run.spin_ratio[k];
                assert!((point.spin_ratio.value - truth).abs() < 4.0 * point.spin_ratio.deviation);
                match point.skidding {
                    Some(p) if (p > 0.5) == (truth < 0.9) => right += 1,
                    Some(_) => wrong += 1,
                    None => {}
                }
            }
        }
    }
    println!("ball skid reported rightly {right} times, wrongly {wrong} times");
    assert!(right > 100 && wrong * 20 < right, "{right} {wrong}");
}

#[test]
fn a_skid_needs_cage_and_engagement() {
    let run = lagging_spin_up(&mut Random::new(1), 7200.0, 0.02, 0.0);
    let without = Measurement {
        engagement: None,
        engagement_deviation: 0.0,
        rest_before: None,
        ..run.test.clone()
    };
    assert!(
        skid(&without, &exact(), &set(), None)
            .unwrap_err()
            .contains("engagement")
    );
    let without = Measurement {
        cage: None,
        ..run.test
    };
    assert!(
        skid(&without, &exact(), &set(), None)
            .unwrap_err()
            .contains("cage signal")
    );
}
