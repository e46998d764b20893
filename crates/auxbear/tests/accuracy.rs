//! Screening accuracy against design accuracy: the means of what can be reproduced, over drops that differ in where the unbalance
//! stands at release.
//!
//! The table of the book is that of 64 members over 0.2 s: a release build with AUXBEAR_SEEDS=64.

use auxbear::outcome::Outcome;
use auxbear::run::{Options, run};
use auxbear::scenario::{BuiltIn, Scenario};
use std::sync::atomic::AtomicBool;

const DROP: &str = include_str!("../../../scenarios/reference_drop.toml");
const FLEXIBLE: &str = include_str!("../../../scenarios/amb_rig_drop.toml");

/// Drops of each accuracy, and how long they are.
fn extent() -> (u64, &'static str) {
    let given = std::env::var("AUXBEAR_SEEDS").ok();
    match given.and_then(|count| count.parse().ok()) {
        Some(members) => (members, "200 ms"),
        None => (16, "60 ms"),
    }
}

fn outcome(machine: &[&str], accuracy: &str) -> Outcome {
    let (members, duration) = extent();
    let mut sets: Vec<String> = machine.iter().map(|set| (*set).to_string()).collect();
    sets.extend([
        format!("run.accuracy={accuracy}"),
        format!("run.duration={duration}"),
        format!("repeat.count={members}"),
        "repeat.unbalance_angle=random".to_string(),
    ]);
    ran(DROP, &sets)
}

fn ran(text: &str, sets: &[String]) -> Outcome {
    let scenario = Scenario::parse(text, "drop.toml", sets, &BuiltIn).expect("it is right");
    let interrupt = AtomicBool::new(false);
    let outcome = run(&scenario, &Options::unwatched(&interrupt)).expect("it builds");
    assert!(outcome.stop.complete());
    outcome
}

/// Mean of a result over the members, and of its size.
fn mean(outcome: &Outcome, name: &str) -> [f64; 2] {
    let values = outcome.members.values(name);
    let values: Vec<f64> = values.into_iter().flatten().collect();
    assert_eq!(values.len(), outcome.members.len(), "{name}");
    let count = values.len() as f64;
    [
        values.iter().sum::<f64>() / count,
        values.iter().map(|value| value.abs()).sum::<f64>() / count,
    ]
}

/// What is compared, with the largest deviation that screening may have.
const RESULTS: [(&str, f64); 5] = [
    ("first_impact_force", 3e-4),
    ("inner_race_time_to_50_percent", 3e-4),
    ("inner_race_time_to_95_percent", 3e-4),
    ("rotor_race_friction_energy", 3e-4),
    ("dissipated_energy", 5e-4),
];

/// Compares both accuracies of a machine; `chaos` is what its own chaos adds to each bound, relative.
fn compare(name: &str, machine: &[&str], chaos: [f64; 5]) {
    let [design, screening] = ["design", "screening"].map(|accuracy| outcome(machine, accuracy));
    let mut row = format!("| {name} |");
    let mut failures = Vec::new();
    for ((result, bound), chaos) in RESULTS.into_iter().zip(chaos) {
        let [ours, expected] = [&screening, &design].map(|outcome| mean(outcome, result)[0]);
        let deviation = ours / expected - 1.0;
        row += &format!(" {deviation:+.1e} |");
        if deviation.abs() > bound + chaos {
            failures.push(format!("{result}: {ours} instead of {expected}"));
        }
    }
    let residuals = [&design, &screening].map(|outcome| mean(outcome, "energy_residual")[1]);
    let work = [&design, &screening].map(|outcome| outcome.work.rate_calls as f64);
    println!(
        "{row} {:.0e} | {:.0e} | {:.1} |",
        residuals[0],
        residuals[1],
        work[0] / work[1]
    );
    // loose balls and balls that skid leave design more than its millionth, and AB1006 says so: 2e-6
    assert!(residuals[0] < 4e-6 && residuals[1] < 2e-4, "{residuals:?}");
    assert!(failures.is_empty(), "{name}: {failures:?}");
}

#[test]
fn screening_keeps_the_means_of_the_reference_drop() {
    // 16 members instead of 64 know their means half as well
    compare("base", &[], [2e-4; 5]);
}

#[test]
fn screening_keeps_the_means_on_a_hard_mount_with_clearance_and_in_skid() {
    let hard = ["mount.stiffness=2e8 N/m"];
    let clear = ["bearing.operating_diametral_clearance=16 um"];
    let skid = [
        clear[0],
        "bearing.traction.maximum=0.02",
        "bearing.traction.reference_speed=0.5 m/s",
    ];
    compare("hard mount", &hard, [5e-4; 5]);
    // the race bounces on its loose balls before the first contact: where it stands then is chaos
    compare("clearance", &clear, [1e-2, 2e-3, 5e-3, 2e-3, 2e-3]);
    compare("skid", &skid, [1e-2, 2e-3, 5e-3, 2e-3, 2e-3]);
}

/// Modes up to 20 000 rad/s let linearly implicit steps be long; those of a file that asks for more do not, and the run says so.
#[test]
fn screening_keeps_the_first_impacts_of_a_flexible_rotor() {
    let of = |sets: &[&str]| {
        let sets = sets.iter().chain(&["run.duration=20 ms"]);
        ran(FLEXIBLE, &sets.map(ToString::to_string).collect::<Vec<_>>())
    };
    let number = |outcome: &Outcome, name: &str| outcome.number(name).expect(name);
    let explicit = |outcome: &Outcome| outcome.warnings.iter().any(|told| told.code == "AB1124");
    let (design, screening) = (of(&[]), of(&["run.accuracy=screening"]));
    let all_modes = of(&["run.accuracy=screening", "rotor.cutoff=60000 rad/s"]);
    for end in ["drive_end", "other_end"] {
        let name = format!("{end}.first_impact_force");
        let ratio = number(&screening, &name) / number(&design, &name);
        assert!((ratio - 1.0).abs() < 0.02, "{name}: {ratio}");
    }
    assert_eq!(number(&design, "rotor_cutoff"), 60e3);
    assert_eq!(number(&screening, "rotor_cutoff"), 20e3);
    assert!(number(&screening, "energy_residual").abs() < 2e-4);
    assert!(!explicit(&screening) && explicit(&all_modes));
    assert!(2 * screening.work.steps < design.work.steps);
    // a rotor that turns as fast as its modes bend keeps ten times that
    let fast = of(&["run.accuracy=screening", "rotor.speed=3000 rad/s"]);
    assert_eq!(number(&fast, "rotor_cutoff"), 30e3);
}
