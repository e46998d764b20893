//! Whatever a file can hold is answered or refused with a sentence: nothing panics, nothing that is reported is not a number.

use crate::made_up::{Random, set};
use identify::data_checks::{CheckSettings, doubts};
use identify::dissipation::dissipation;
use identify::loss::{LossMap, LossSettings, Rolling, loss};
use identify::moment::{SteadyMoment, moment};
use identify::skid::skid;
use identify::slip::cage_slip;
use identify::{CageTrace, Measurement, SetDeviation};
use physics::rolling::RollingSet;
use proptest::prelude::*;

/// Numbers that files hold.
fn odd(random: &mut Random) -> f64 {
    let plain = 100.0 * random.normal();
    match (random.uniform() * 24.0) as u32 {
        0 => 0.0,
        1 => 1e300 * random.normal(),
        2 => 1e-300,
        3 => 1e12 * random.normal(),
        4 => -plain,
        _ => plain,
    }
}

/// A measurement of nonsense; `wild` of 1 has everything odd, 0 a plausible frame.
fn nonsense(random: &mut Random, count: usize, wild: f64) -> Measurement {
    let mut time = 0.0;
    let mut list = |scale: f64| -> Vec<f64> {
        (0..count)
            .map(|_| {
                if random.uniform() < wild {
                    odd(random)
                } else {
                    scale * random.normal()
                }
            })
            .collect()
    };
    let (speed, acceleration, torque) = (list(100.0), list(300.0), list(0.02));
    let positive = |list: Vec<f64>| -> Vec<f64> { list.into_iter().map(f64::abs).collect() };
    let (a, b, c) = (
        positive(list(0.1)),
        positive(list(1.0)),
        positive(list(1e-3)),
    );
    let cage = CageTrace::independent(
        (0..count).map(|k| 0.011 * k as f64).collect(),
        list(40.0),
        positive(list(0.2)),
    );
    let temperature = list(5.0);
    let correlation_time = positive(list(0.1));
    Measurement {
        name: "nonsense".into(),
        load: odd(random).abs(),
        time: (0..count)
            .map(|_| {
                time += 1e-6 + random.uniform() * 0.02;
                time
            })
            .collect(),
        speed,
        speed_deviation: a,
        acceleration,
        acceleration_deviation: b,
        torque,
        torque_deviation: c,
        zero_deviation: 1e-4,
        scale_deviation: 0.01,
        correlation_time,
        engagement: (random.uniform() < 0.7).then(|| random.uniform()),
        engagement_deviation: 0.0,
        rest_before: None,
        cage: (random.uniform() < 0.7).then_some(cage),
        temperature: Some(temperature),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]
    #[test]
    fn nonsense_is_answered_or_refused(seed in any::<u64>(), count in 1usize..120, wild in 0.0..0.3_f64) {
        let mut random = Random::new(seed);
        let wild = if seed % 3 == 0 { 0.0 } else { wild };
        let (test, other) = (nonsense(&mut random, count, wild), nonsense(&mut random, count, wild));
        let curve = SteadyMoment {
            load: 50.0,
            speed: vec![0.0, 50.0, 1e6],
            moment: vec![odd(&mut random), 0.02, 0.03],
            covariance: vec![vec![1e-8; 3]; 3],
            scale_deviation: 0.01,
        };
        let set = RollingSet { cage_mass: odd(&mut random), ..set() };
        for tests in [vec![&test], vec![&test, &other]] {
            if let Ok(found) = moment(&tests, &set, None) {
                prop_assert!(found.curve.sound().is_ok());
                prop_assert!(found.forms.iter().all(|f| (0.0..=1.0).contains(&f.probability)));
            }
            let _ = doubts(&tests, Some(&curve), &set, &CheckSettings { ball_count: Some(0), ..CheckSettings::default() });
        }
        let settings = LossSettings {
            rolling: if seed % 2 == 0 { Rolling::Stated } else { Rolling::ByCage },
            ..LossSettings::default()
        };
        if let Ok(found) = loss(&test, &curve, &set, &settings) {
            prop_assert_eq!(found.points.len(), test.time.len());
            if let Ok(map) = LossMap::fitted(&[(&test, &found)], &curve, &set, &settings) {
                let _ = map.at(odd(&mut random), odd(&mut random));
            }
        }
        let _ = dissipation(&test, &set, &SetDeviation::default(), None);
        let _ = dissipation(&test, &set, &SetDeviation::default(), Some((odd(&mut random), odd(&mut random))));
        if let Ok(found) = cage_slip(&test, &set) {
            prop_assert!(found.slipped.is_none_or(|p| (0.0..=1.0).contains(&p)));
        }
        if let Ok(found) = skid(&test, &curve, &set, None) {
            prop_assert!(found.skidded.is_none_or(|p| (0.0..=1.0).contains(&p)));
        }
    }
}
