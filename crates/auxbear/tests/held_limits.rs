//! The heat that must be taken from the nodes of a bearing to hold them at their limits, in whatever is computed in time.

use crate::outcomes::number;
use auxbear::outcome::{Outcome, Value};
use auxbear::run::{Options, run};
use auxbear::scenario::{BuiltIn, Scenario};
use std::sync::atomic::AtomicBool;

const SPIN_UP: &str = include_str!("../../../scenarios/spin_up_warming.toml");
const RIG: &str = include_str!("../../../scenarios/rig_test_3_warming.toml");
const COAST_DOWN: &str = include_str!("../../../scenarios/coast_down_closing.toml");
const UNTIL_STANDSTILL: &str = include_str!("../../../scenarios/drop_until_standstill.toml");
const DROP: &str = include_str!("../../../scenarios/drop_whirl_closing.toml");

fn ran(text: &str, sets: &[&str]) -> Outcome {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    let scenario = Scenario::parse(text, "held.toml", &sets, &BuiltIn).unwrap();
    let never = AtomicBool::new(false);
    run(&scenario, &Options::unwatched(&never)).unwrap()
}

fn value<'a>(outcome: &'a Outcome, name: &str) -> &'a Value {
    let found = outcome.quantity(name);
    &found.unwrap_or_else(|| panic!("{name}")).value
}

fn list<'a>(outcome: &'a Outcome, name: &str) -> &'a [f64] {
    match value(outcome, name) {
        Value::List(values) => values,
        other => panic!("{name}: {other:?}"),
    }
}

fn has(outcome: &Outcome, code: &str) -> bool {
    outcome.warnings.iter().any(|warning| warning.code == code)
}

/// Σ P Δt of the curve of a node, J; the first span begins at most 10 ms before its end.
fn under(outcome: &Outcome, node: &str) -> [f64; 2] {
    let (times, powers) = (
        list(outcome, "held_times"),
        list(outcome, &format!("{node}_powers_to_take")),
    );
    let steps = times.windows(2).zip(&powers[1..]);
    let sum: f64 = steps.map(|(pair, power)| power * (pair[1] - pair[0])).sum();
    [sum, sum + 11e-3 * powers[0]]
}

#[test]
fn to_hold_the_oil_of_a_spin_up_all_must_be_taken_that_a_lake_of_it_would_keep() {
    // without M1 all of the moment heats the oil, at any temperature
    let sets = [
        "run.duration=2 s",
        "heat.feedback=none",
        "bearing.moment.f1_factor=0",
    ];
    let limited = ran(
        SPIN_UP,
        &[&sets[..], &["heat.lubricant_limit=25.0001 degC"]].concat(),
    );
    let lake = ran(
        SPIN_UP,
        &[&sets[..], &["heat.lubricant_mass=1000 kg"]].concat(),
    );
    let taken = number(&limited, "lubricant_energy_to_take");
    let kept = number(&lake, "stored_heat_in_lubricant");
    assert!(
        kept > 5.0 && (taken / kept - 1.0).abs() < 1e-3,
        "{taken} {kept}"
    );
    let [least, most] = under(&limited, "lubricant");
    assert!((least..=most).contains(&taken), "{least} {taken} {most}");
    // it rises with the speed and falls as nothing but the mean torque goes on
    let peak = number(&limited, "lubricant_heat_to_take");
    let powers = list(&limited, "lubricant_powers_to_take");
    assert_eq!(powers.iter().copied().fold(0.0, f64::max), peak);
    assert!(has(&limited, "AB2310") && number(&limited, "lubricant_limit_time") < 0.1);
    // it tells, and changes nothing
    let free = ran(SPIN_UP, &sets);
    for name in [
        "peak_lubricant_temperature",
        "heat_made",
        "heat_to_surroundings",
    ] {
        assert_eq!(number(&free, name), number(&limited, name), "{name}");
    }
}

#[test]
fn a_node_that_never_gets_there_needs_nothing_and_has_no_curve() {
    let outcome = ran(
        SPIN_UP,
        &["run.duration=0.5 s", "heat.lubricant_limit=25.05 degC"],
    );
    assert!(number(&outcome, "lubricant_energy_to_take") > 0.0);
    assert!(
        matches!(value(&outcome, "balls_heat_to_take"), Value::None { why } if why.contains("below its limit"))
    );
    let curve = outcome
        .quantities
        .iter()
        .find(|q| q.name == "balls_powers_to_take");
    assert!(curve.is_none());
    let free = ran(SPIN_UP, &["run.duration=0.5 s"]);
    assert!(list(&free, "held_times").is_empty());
}

#[test]
fn drops_and_rigs_tell_it_too_and_lanes_the_same() {
    let sets = ["run.duration=0.3 s", "heat.race_limit=25.5 degC"];
    let drop = ran(DROP, &sets);
    let name = "inner_race_energy_to_take";
    let taken = number(&drop, name);
    // half of the friction of rotor and race, beside what the balls send
    let made = number(&drop, "heat_made_in_inner_race");
    assert!(taken > 0.5 * made && taken < 1.5 * made, "{taken} {made}");
    let [least, most] = under(&drop, "inner_race");
    assert!((least..=most).contains(&taken), "{least} {taken} {most}");
    let many = ran(DROP, &[&sets[..], &["repeat.count=8"]].concat());
    assert_eq!(
        many.members.values(name)[0].unwrap().to_bits(),
        taken.to_bits()
    );

    let rig = ran(
        RIG,
        &["run.duration=2 s", "heat.lubricant_limit=25.01 degC"],
    );
    assert!(number(&rig, "lubricant_energy_to_take") > 0.0);
}

/// What a rotor that bounces makes until it rolls is taken too: the way through the windows is held as the drop was.
#[test]
fn what_is_taken_goes_on_from_the_drop_through_the_windows_of_its_coast_down() {
    let out = ran(UNTIL_STANDSTILL, &["heat.lubricant_limit=30 degC"]);
    let powers = list(&out, "coast_down.lubricant_powers_to_take");
    let times = list(&out, "coast_down.held_times");
    let limit = number(&out, "coast_down.lubricant_limit_time");
    let start = number(&out, "coast_down.start_time");
    assert!(times[0] < start, "{} before {start}: windows", times[0]);
    // once there, the oil is held all the way to where the rotor rolls
    let mut bouncing = times
        .iter()
        .zip(powers)
        .filter(|(time, _)| **time > limit + 2.0);
    let mut bouncing = bouncing.by_ref().take_while(|(time, _)| **time < start);
    assert!(bouncing.all(|(_, power)| *power > 1.0), "{powers:?}");
    let until = times.partition_point(|time| *time <= start);
    let taken: f64 = (1..until)
        .map(|k| powers[k] * (times[k] - times[k - 1]))
        .sum();
    let all = number(&out, "coast_down.lubricant_energy_to_take");
    assert!(taken > 0.2 * all, "{taken} of {all}");
}

/// Where the heat of a friction moment goes follows its parts, also under a preload that the weight knows nothing of.
#[test]
fn heat_of_preloaded_balls_goes_to_balls_and_races_as_laws_of_a_coast_down_say() {
    let [both, clearance] = [
        "bearing.moment.f0=2",
        "bearing.operating_diametral_clearance=-20 um",
    ];
    let law = ran(
        COAST_DOWN,
        &[
            both,
            clearance,
            "rotor.mass=20.394 kg",
            "rotor.speed=150 rad/s",
            "coast_down.longest=1 s",
        ],
    );
    let column = |name: &str| {
        let found = law.history.iter().find(|one| one.name == name);
        found.unwrap_or_else(|| panic!("{name}")).values[0]
    };
    let moment = column("load_dependent.moment");
    // without preload it is a ninth
    assert!(moment > 2e-3, "{moment}");
    for fidelity in ["planar", "rolling"] {
        let fidelity = format!("bearing.fidelity={fidelity}");
        let sets = [both, clearance, fidelity.as_str(), "run.duration=2 s"];
        let run = ran(SPIN_UP, &sets);
        let by_node = list(&run, "steady_moment_heat_by_node");
        let heat: f64 = [1, 2, 5].map(|node| by_node[node]).iter().sum();
        let turned = 150.0 * (2.0 - 0.5 * 0.04);
        let ratio = heat / (moment * turned);
        assert!((0.94..1.06).contains(&ratio), "{fidelity} {ratio} {heat}");
        assert!((by_node[2] / heat - 0.5).abs() < 1e-9);
    }
}
