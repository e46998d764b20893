//! Which steps a drop takes, and that threads change nothing.

use auxbear::outcome::Value;
use auxbear::run::{Options, Outcome, run};
use auxbear::scenario::{BuiltIn, Scenario, template};
use std::sync::atomic::AtomicBool;

/// A drop of the starting file, until after its first impact.
fn outcome(sets: &[&str], threads: usize) -> Outcome {
    let text = template("drop").expect("a drop has a starting file");
    let mut all = vec![String::from("run.duration=10 ms")];
    all.extend(sets.iter().map(|set| (*set).to_string()));
    let scenario = Scenario::parse(&text, "drop.toml", &all, &BuiltIn).expect("it is right");
    let interrupt = AtomicBool::new(false);
    let options = Options {
        threads: Some(threads),
        ..Options::unwatched(&interrupt)
    };
    run(&scenario, &options).expect("it builds")
}

fn method(outcome: &Outcome) -> &'static str {
    outcome.work.method.expect("something moves")
}

const STIFF: &str = "bearing.traction.reference_speed=0.001 m/s";

#[test]
fn stiff_friction_takes_implicit_steps_by_itself() {
    assert!(method(&outcome(&[], 1)).contains("explicit"));
    let stiff = outcome(&[STIFF], 1);
    assert!(method(&stiff).contains("implicit"), "{:?}", stiff.work);
    assert!(stiff.stop.complete());
    let forced = outcome(&[STIFF, "run.method=explicit"], 1);
    assert!(method(&forced).contains("explicit"));
    assert!(forced.work.steps > 5 * stiff.work.steps);
    let rolling = outcome(&["bearing.fidelity=rolling", "run.method=implicit"], 1);
    assert!(
        method(&rolling).contains("explicit"),
        "balls that roll have no friction to be stiff"
    );
}

#[test]
fn implicit_members_are_the_same_on_any_number_of_threads() {
    let sets = [STIFF, "repeat.count=5"];
    let (one, three) = (outcome(&sets, 1), outcome(&sets, 3));
    assert_eq!(one.members.len(), 5);
    assert_eq!(one.members, three.members);
    assert_eq!(one.quantities, three.quantities);
}

/// Machines that differ in their constants, of which some take more steps than others.
const TOLERANCES: [&str; 4] = [
    "repeat.unbalance_angle=random",
    "repeat.friction_coefficient_deviation=0.3",
    "repeat.mount_stiffness_deviation=0.2",
    "repeat.radial_air_clearance_deviation=0.05",
];

fn ensemble(count: usize, threads: usize) -> Outcome {
    let count = format!("repeat.count={count}");
    let mut sets = TOLERANCES.to_vec();
    sets.push(&count);
    outcome(&sets, threads)
}

#[test]
fn machines_of_an_ensemble_depend_on_seed_and_number_alone() {
    let whole = ensemble(40, 1);
    assert_eq!(whole.members.len(), 40);
    // other threads, other lanes, other company
    assert_eq!(whole.members, ensemble(40, 3).members);
    let few = ensemble(7, 2).members;
    assert!((0..7).all(|k| whole.members.row(k).eq(few.row(k))));
}

#[test]
fn tolerances_of_the_machine_spread_what_they_should() {
    let spread = |outcome: &Outcome, name: &str| {
        let quantity = outcome.quantity(name);
        quantity.and_then(|q| q.spread).expect("repeated")
    };
    let (varied, chaos) = (
        ensemble(64, 2),
        outcome(&["repeat.count=16", "repeat.unbalance_angle=as given"], 2),
    );
    // the fall takes √(2 c/g): half of a clearance's 5 %
    let fall = spread(&varied, "time_to_first_contact");
    let share = fall.standard_deviation / fall.mean;
    // a deviation of 64 members is known within 9 %
    assert!((share / 0.025 - 1.0).abs() < 0.35, "{share}");
    let still = spread(&chaos, "time_to_first_contact");
    assert!(still.standard_deviation < 1e-5 * still.mean, "{still:?}");
    let [low, median, high] = spread(&varied, "first_impact_force").quantiles;
    assert!(low < 0.95 * median && high > 1.05 * median);
}

/// A release chooses no angle of the rotor: members draw theirs, after all that the file varies, and member 0 has the one given.
#[test]
fn members_draw_the_unbalance_angle_evenly_unless_told_otherwise() {
    let drawn = |more: &[&str]| {
        let sets = [&["repeat.count=65"][..], more].concat();
        outcome(&sets, 2).drawn
    };
    let usual = drawn(&[]);
    assert!(usual[0].is_empty(), "member 0 is the machine as given");
    let angle = |draws: &Vec<(String, String)>| {
        let (path, value) = draws.last().expect("it is drawn");
        assert_eq!(path, "rotor.unbalance_angle");
        units::parse_quantity(value).expect("an angle").value_si
    };
    let angles: Vec<f64> = usual[1..].iter().map(angle).collect();
    assert!(
        angles
            .iter()
            .all(|angle| (0.0..std::f64::consts::TAU).contains(angle))
    );
    // sums of 64 even angles have components of deviation √32: 3.5 of them
    for turn in [1.0, 2.0] {
        let sum = |of: fn(f64) -> f64| angles.iter().map(|angle| of(turn * angle)).sum::<f64>();
        assert!(sum(f64::cos).hypot(sum(f64::sin)) < 3.5 * 32.0_f64.sqrt());
    }
    assert_eq!(drawn(&["repeat.unbalance_angle=random"]), usual);
    let given = drawn(&["repeat.unbalance_angle=as given"]);
    assert!(given.iter().all(Vec::is_empty));
    // what else is varied draws what it drew without the angle
    let friction = "repeat.friction_coefficient_deviation=0.2";
    let both = drawn(&[friction]);
    let alone = drawn(&[friction, "repeat.unbalance_angle=as given"]);
    assert!((1..65).all(|k| both[k][0] == alone[k][0] && both[k].len() == 2));
    // a distribution of the user's own takes its place
    let own = drawn(&["vary.rotor.unbalance_angle={ uniform = [\"1 rad\", \"2 rad\"] }"]);
    assert!(
        own[1..]
            .iter()
            .all(|draws| draws.len() == 1 && (1.0..2.0).contains(&angle(draws)))
    );
}

/// Air clearances, mm, from 0.25 to 0.31: some of 200, or as many as AUXBEAR_CLEARANCES says. Those between are of the 200
/// at which an implicit step once passed over the first impact, or lie where it did in another machine.
fn clearances() -> Vec<f64> {
    let count = std::env::var("AUXBEAR_CLEARANCES").ok();
    let count = count.and_then(|count| count.parse().ok()).unwrap_or(9);
    let even = |k: usize| 0.25 + 0.06 * k as f64 / (count.max(2) - 1) as f64;
    let passed_over = [123, 124, 125, 126, 127].map(|k| 0.25 + 0.06 * f64::from(k) / 199.0);
    let elsewhere = [0.2970, 0.2975, 0.2980, 0.2985];
    (0..count)
        .map(even)
        .chain(passed_over)
        .chain(elsewhere)
        .collect()
}

#[test]
fn the_first_impact_is_met_wherever_it_lies_in_an_implicit_step() {
    let text = include_str!("../../../scenarios/reference_drop.toml");
    let drop = |clearance: f64, sets: &[&str]| {
        let mut all = vec![
            String::from("run.duration=8.5 ms"),
            String::from("run.output_interval=0.02 ms"),
            String::from("bearing.traction.reference_speed=5 mm/s"),
            format!("contact.radial_air_clearance={clearance} mm"),
        ];
        all.extend(sets.iter().map(|set| (*set).to_string()));
        let scenario = Scenario::parse(text, "drop.toml", &all, &BuiltIn).expect("it is right");
        let interrupt = AtomicBool::new(false);
        run(&scenario, &Options::unwatched(&interrupt)).expect("it builds")
    };
    let value = |outcome: &Outcome, name: &str| {
        let quantity = outcome.quantity(name);
        match quantity.map(|quantity| &quantity.value) {
            Some(Value::Number(value)) => *value,
            other => panic!("{name}: {other:?}"),
        }
    };
    for clearance in clearances() {
        let ours = drop(clearance, &[]);
        assert!(method(&ours).contains("implicit"));
        let residual = value(&ours, "energy_residual");
        assert!(residual.abs() < 1e-6, "{clearance}: {residual}");
        let heats = (ours.history.iter()).filter(|column| column.name.starts_with("energy.heat."));
        for heat in heats {
            let end = heat.values.last().expect("rows");
            let fall = heat
                .values
                .windows(2)
                .map(|two| two[0] - two[1])
                .fold(0.0, f64::max);
            assert!(
                fall <= 1e-6 * end,
                "{clearance}: {} falls by {fall} J of {end}",
                heat.name
            );
        }
        let explicit = drop(clearance, &["run.method=explicit", "run.tolerance=1e-5"]);
        let [ours, theirs] = [&ours, &explicit].map(|run| value(run, "first_impact_force"));
        assert!(
            (ours / theirs - 1.0).abs() < 1e-3,
            "{clearance}: {ours} {theirs}"
        );
    }
}
