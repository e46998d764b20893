//! Sliding friction between rotor and race.

use crate::made_up::{Random, covered, seeds, set, steady};
use identify::SetDeviation;
use identify::rotor_friction::{Race, RubbingSpinUp, rotor_friction};
use statistics::uncertain::Uncertain;

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
            air_clearance: Uncertain::exact(0.0),
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
        air_clearance: Uncertain::exact(0.0),
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
    // an F that is there and not known makes μ too small by share F/(R_0 W), and is reported
    let unknown = |_: f64, _: f64| None;
    let race = exact_race(&law, &unknown);
    assert!(
        rotor_friction(&drop.run, &race).unwrap().notes[0]
            .to_string()
            .contains("taken as 0")
    );
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
    assert!(found.notes[0].to_string().contains("left out"));
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

/// Inertia of the race of an unbalanced rotor, kg m², and its steady moment, N m.
const LIGHT_RACE: f64 = 3.9e-6;
const MOMENT: f64 = 0.06;

/// A race that a rotor of 1250 rad/s and 0.25 mm of air clearance brings up under a weight that its unbalance swings by four tenths
/// with every turn, read with a constant load; then it creeps for some turns.
///
/// It is up after some 70 ms of 5 ms a turn.
fn unbalanced(clearance: f64) -> RubbingSpinUp {
    let (rotor, step, weight) = (1250.0, 2e-6, 80.0);
    let inertia = LIGHT_RACE + set().inner_inertia();
    let mut speed = 0.0;
    let (mut time, mut race, mut rates) = (vec![], vec![], vec![]);
    for k in 0..60_000 {
        let t = f64::from(k) * step;
        let load = weight * (1.0 + 0.4 * (rotor * t + 0.3).sin());
        let slip = (BORE - clearance) * rotor - BORE * speed;
        let rate = (BORE * creeping(slip) * load - MOMENT) / inertia;
        if k % 20 == 0 {
            time.push(t);
            race.push(Uncertain::exact(speed));
            rates.push(Uncertain::exact(rate));
        }
        speed += rate * step;
    }
    RubbingSpinUp {
        name: "unbalanced".into(),
        rotor_speed: vec![Uncertain::exact(rotor); time.len()],
        load: vec![Uncertain::new(weight, 0.01 * weight); time.len()],
        race_speed: race,
        race_acceleration: rates,
        correlation_time: 0.12,
        time,
    }
}

/// A coefficient that fades where the rotor hardly slides.
fn creeping(slip: f64) -> f64 {
    0.15 * (slip / 0.05).tanh()
}

#[test]
fn what_the_unbalance_swings_averages_out_of_whole_turns() {
    let clearance = 0.25e-3;
    let run = unbalanced(clearance);
    let law = |_: f64, _: f64| Some(Uncertain::exact(MOMENT));
    let none = |_: f64, _: f64| Some(Uncertain::exact(0.0));
    let mut race = exact_race(&law, &none);
    race.air_clearance = Uncertain::exact(clearance);
    race.inertia = Uncertain::exact(LIGHT_RACE);
    race.least_slip = 1e-3;
    let found = rotor_friction(&run, &race).unwrap();
    // single points swing by the whole of it
    let sliding = |p: &&identify::rotor_friction::FrictionPoint| p.slip.value > 1.0;
    let worst = (found.points.iter().filter(sliding))
        .map(|p| (p.friction.value - 0.15).abs())
        .fold(0.0, f64::max);
    assert!(worst > 0.05, "{worst}");
    assert!(
        found
            .notes
            .iter()
            .any(|note| note.to_string().contains("within a turn"))
    );
    let means = found.over_slip(20);
    assert!(means.len() >= 8, "{means:?}");
    for mean in &means {
        let (own, slip) = (mean.friction, mean.slip);
        assert!(own.deviation > 0.0014 * own.value / 0.15 && own.deviation < 0.02);
        if slip.value > 1.0 {
            // 0.06 of swing over 2π of a turn
            assert!((own.value - 0.15).abs() < 0.005, "{mean:?}");
        } else {
            // the slip at which it is reported, within the slips of its turns
            let (low, high) = (
                creeping(slip.value - 2.0 * slip.deviation),
                creeping(slip.value + 2.0 * slip.deviation),
            );
            assert!(
                own.value > low - 0.003 && own.value < high + 0.003,
                "{mean:?}"
            );
        }
    }
    // it ends creeping, where friction carries M: μ = M/(R_0 W)
    let creep = means[0];
    assert!((creep.friction.value - 0.06).abs() < 0.004, "{creep:?}");
    // reported at the slip at which it lies; W swings μ between 0.043 and 0.1 there
    assert!(
        (creep.friction.value - creeping(creep.slip.value)).abs() < 0.01,
        "{creep:?}"
    );
    // a rotor taken as wide as the bore slides by ω c0 more
    race.air_clearance = Uncertain::exact(0.0);
    let wide = rotor_friction(&run, &race).unwrap();
    let off = wide.points[0].slip.value - found.points[0].slip.value;
    assert!((off - 1250.0 * clearance).abs() < 1e-9, "{off}");
    race.air_clearance = Uncertain::exact(BORE);
    assert!(
        rotor_friction(&run, &race)
            .unwrap_err()
            .contains("air clearance")
    );
}

#[test]
fn less_than_a_turn_holds_the_whole_swing_in_its_band() {
    let whole = unbalanced(0.25e-3);
    // half a turn of 5 ms
    let from = whole.time.partition_point(|t| *t < 10.0e-3);
    let to = whole.time.partition_point(|t| *t < 12.5e-3);
    let run = RubbingSpinUp {
        time: whole.time[from..to].to_vec(),
        race_speed: whole.race_speed[from..to].to_vec(),
        race_acceleration: whole.race_acceleration[from..to].to_vec(),
        rotor_speed: whole.rotor_speed[from..to].to_vec(),
        load: whole.load[from..to].to_vec(),
        ..whole
    };
    let law = |_: f64, _: f64| Some(Uncertain::exact(MOMENT));
    let none = |_: f64, _: f64| Some(Uncertain::exact(0.0));
    let mut race = exact_race(&law, &none);
    race.air_clearance = Uncertain::exact(0.25e-3);
    race.inertia = Uncertain::exact(LIGHT_RACE);
    let found = rotor_friction(&run, &race).unwrap();
    assert!(
        found
            .notes
            .iter()
            .any(|note| note.to_string().contains("less than a turn"))
    );
    let (mean, means) = (found.mean(), found.over_slip(20));
    assert!(means.len() == 1, "{means:?}");
    assert!(mean.friction.deviation > 0.01, "{mean:?}");
    assert!((mean.friction.value - 0.15).abs() < 3.0 * mean.friction.deviation);
}
