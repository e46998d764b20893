//! Sliding friction between rotor and race.

mod made_up;

use identify::SetDeviation;
use identify::rotor_friction::{Race, RubbingSpinUp, rotor_friction};
use made_up::{Random, covered, seeds, set, steady};
use measure::uncertain::Uncertain;

const BORE: f64 = 12.5e-3;
const RACE_INERTIA: f64 = 2e-5;

/// The true coefficient over slip.
fn friction(slip: f64) -> f64 {
    0.12 + 0.06 * (-slip / 4.0).exp()
}

struct Drop {
    run: RubbingSpinUp,
    truth: Vec<f64>,
}

/// A race that a rotor of 1000 rad/s spins up, under a load that swings and sometimes lifts.
fn dropped(random: &mut Random, noisy: bool) -> Drop {
    let set = set();
    let noise = f64::from(u8::from(noisy));
    let (rotor, step) = (1000.0, 1e-5);
    let mut speed = 0.0;
    let (mut time, mut truth) = (vec![], vec![]);
    let (mut race, mut rates, mut loads) = (vec![], vec![], vec![]);
    let mut k = 0;
    while speed < 990.0 && k < 200_000 {
        let t = f64::from(k) * step;
        let load = (60.0 * (1.0 + 1.2 * (300.0 * t).sin())).max(0.0);
        let slip = BORE * (rotor - speed);
        let moment = if speed > 0.0 { steady(speed) } else { 0.0 };
        let drive = BORE * friction(slip) * load;
        let rate = ((drive - moment) / (RACE_INERTIA + set.inner_inertia())).max(if speed > 0.0 {
            f64::MIN
        } else {
            0.0
        });
        if k % 50 == 0 {
            time.push(t);
            race.push(speed);
            rates.push(rate);
            loads.push(load);
            truth.push(friction(slip));
        }
        speed += rate * step;
        k += 1;
    }
    let count = time.len();
    let rate_noise = random.coloured(count, 5e-4, 4e-3);
    let load_noise = random.coloured(count, 5e-4, 4e-3);
    let speed_noise = random.coloured(count, 5e-4, 4e-3);
    let deviation = 100.0;
    Drop {
        run: RubbingSpinUp {
            name: "drop".into(),
            race_speed: race
                .iter()
                .zip(&speed_noise)
                .map(|(s, n)| Uncertain::new(s + noise * 0.5 * n, 0.5))
                .collect(),
            race_acceleration: rates
                .iter()
                .zip(&rate_noise)
                .map(|(a, n)| Uncertain::new(a + noise * deviation * n, deviation))
                .collect(),
            rotor_speed: vec![Uncertain::new(rotor, 0.1); count],
            load: loads
                .iter()
                .zip(&load_noise)
                // no contact is known to be none
                .map(|(w, n)| {
                    if *w > 0.0 {
                        Uncertain::new(w + noise * n, 1.0)
                    } else {
                        Uncertain::exact(0.0)
                    }
                })
                .collect(),
            correlation_time: 2.4e-3,
            time,
        },
        truth,
    }
}

#[test]
fn the_true_coefficient_lies_in_its_band() {
    let count = seeds(100);
    let (mut inside, mut of, mut mean_inside, mut mean_of) = (0.0, 0.0, 0.0, 0.0);
    for seed in 0..count {
        let mut random = Random::new(11_000 + seed);
        let drop = dropped(&mut random, true);
        // what the user believes: 5 % of M, 2 % of the race's inertia, 0.5 % of the bore
        let (m, i, r) = (random.normal(), random.normal(), random.normal());
        let law = |speed: f64, _: f64| {
            let own = if speed > 0.0 { steady(speed) } else { 0.0 };
            Some(Uncertain::new(own * (1.0 + 0.05 * m), 0.05 * own))
        };
        let race = Race {
            inertia: Uncertain::new(RACE_INERTIA * (1.0 + 0.02 * i), 0.02 * RACE_INERTIA),
            bore_radius: Uncertain::new(BORE * (1.0 + 0.005 * r), 0.005 * BORE),
            set: set(),
            set_deviation: SetDeviation::default(),
            steady_moment: &law,
            friction: &|_, _| Some(Uncertain::exact(0.0)),
            least_load: 15.0,
            least_slip: 0.5,
        };
        let found = rotor_friction(&drop.run, &race).unwrap();
        for point in &found.points {
            let k = drop.run.time.iter().position(|t| *t == point.time).unwrap();
            of += 1.0;
            if (point.friction.value - drop.truth[k]).abs() <= 2.0 * point.friction.deviation {
                inside += 1.0;
            }
        }
        for mean in found.over_slip(6) {
            mean_of += 1.0;
            if (mean.friction.value - friction(mean.slip.value)).abs()
                <= 2.0 * mean.friction.deviation
            {
                mean_inside += 1.0;
            }
        }
    }
    covered("μ over time", inside, of, count);
    covered("μ over slip", mean_inside, mean_of, count);
}

fn exact_race<'a>(
    steady_moment: &'a dyn Fn(f64, f64) -> Option<Uncertain>,
    friction: &'a dyn Fn(f64, f64) -> Option<Uncertain>,
) -> Race<'a> {
    Race {
        inertia: Uncertain::exact(RACE_INERTIA),
        bore_radius: Uncertain::exact(BORE),
        set: set(),
        set_deviation: SetDeviation::default(),
        steady_moment,
        friction,
        least_load: 15.0,
        least_slip: 0.5,
    }
}

#[test]
fn without_noise_it_is_the_formula() {
    let drop = dropped(&mut Random::new(0), false);
    let law = |speed: f64, _: f64| {
        Some(Uncertain::exact(if speed > 0.0 {
            steady(speed)
        } else {
            0.0
        }))
    };
    let none = |_: f64, _: f64| Some(Uncertain::exact(0.0));
    let race = exact_race(&law, &none);
    let found = rotor_friction(&drop.run, &race).unwrap();
    assert!(found.notes.is_empty());
    for point in &found.points {
        let k = drop.run.time.iter().position(|t| *t == point.time).unwrap();
        assert!((point.friction.value - drop.truth[k]).abs() < 1e-12);
    }
    // nothing where the load lifts
    let lifted = drop.run.load.iter().filter(|w| w.value < 15.0).count();
    assert!(lifted > 0 && found.points.len() <= drop.run.time.len() - lifted);
    // an F that is there and not known makes μ too small by share F/(R_0 W), and is told
    let unknown = |_: f64, _: f64| None;
    let race = exact_race(&law, &unknown);
    assert!(rotor_friction(&drop.run, &race).unwrap().notes[0].contains("taken as 0"));
    let newton = |_: f64, _: f64| Some(Uncertain::exact(1.0));
    let race = exact_race(&law, &newton);
    let with = rotor_friction(&drop.run, &race).unwrap();
    let k = drop
        .run
        .time
        .iter()
        .position(|t| *t == with.points[5].time)
        .unwrap();
    let more = set().pocket_friction_arm() / (BORE * drop.run.load[k].value);
    assert!((with.points[5].friction.value - found.points[5].friction.value - more).abs() < 1e-12);
}

#[test]
fn a_moment_that_is_not_known_leaves_a_gap_and_says_so() {
    let drop = dropped(&mut Random::new(0), false);
    // a curve up to 300 rad/s
    let law = |speed: f64, _: f64| (speed <= 300.0).then(|| Uncertain::exact(steady(speed)));
    let none = |_: f64, _: f64| Some(Uncertain::exact(0.0));
    let found = rotor_friction(&drop.run, &exact_race(&law, &none)).unwrap();
    assert!(found.notes[0].contains("left out"));
    let least = found
        .points
        .iter()
        .fold(f64::MAX, |a, p| a.min(p.slip.value));
    assert!(least >= BORE * 699.0);
    let nothing = |_: f64, _: f64| None;
    assert!(
        rotor_friction(&drop.run, &exact_race(&nothing, &none))
            .unwrap_err()
            .contains("never slide")
    );
    let mut race = exact_race(&law, &none);
    race.inertia = Uncertain::exact(0.0);
    assert!(
        rotor_friction(&drop.run, &race)
            .unwrap_err()
            .contains("inertia of the race is missing")
    );
    let mut short = drop.run.clone();
    short.load.pop();
    assert!(
        rotor_friction(&short, &exact_race(&law, &none))
            .unwrap_err()
            .contains("loads for")
    );
}
