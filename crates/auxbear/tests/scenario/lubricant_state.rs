//! The slow state of the lubricant in scenarios: what is read, what is refused.

use super::files::{SPIN_UP, read, spin_up};
use auxbear::scenario::LubricantState;
use std::f64::consts::TAU;

const GREASE: &str = r#"
[bearing.moment]
law = "palmgren"
lubrication = "grease"
viscosity = "100 mm^2/s"

[bearing.lubricant_state]
kind = "grease and films"
rested_factor = 0.3
build_up_turns = 0.7
worked_factor = 0.7
breakdown_time = "3.5 s"
recovery_time = "600 s"
film_heat_capacity = "0.5 J/K"
film_conductance = "0.25 W/K"
drag_temperature_coefficient = "0.03 1/K"
traction_temperature_coefficient = "0.01 1/K"
"#;

/// A spin-up with grease and films.
fn good() -> String {
    format!("{SPIN_UP}{GREASE}")
}

fn state(sets: &[&str]) -> Option<LubricantState> {
    let scenario = read(&good(), sets).unwrap_or_else(|problem| panic!("{problem}"));
    spin_up(scenario).bearing.lubricant_state
}

fn message(sets: &[&str]) -> String {
    read(&good(), sets).expect_err("it was accepted")
}

#[test]
fn grease_and_films_are_read_in_si() {
    let state = state(&[]).expect("it has one");
    let (grease, films) = (state.grease.unwrap(), state.films.unwrap());
    assert!((grease.build_up_angle - 0.7 * TAU).abs() < 1e-15);
    assert_eq!((grease.breakdown_time, grease.recovery_time), (3.5, 600.0));
    assert_eq!((films.heat_capacity, films.conductance), (0.5, 0.25));
    assert_eq!(films.traction_coefficient, 0.01);
    assert_eq!((state.build_up, state.breakdown), (0.0, 0.0));
}

#[test]
fn a_resolved_file_gives_the_same_state_again() {
    let first = read(&good(), &["bearing.lubricant_state.start=worked"]).unwrap();
    let again = read(&first.resolved.toml(), &[]).unwrap();
    assert_eq!(first.system, again.system);
}

#[test]
fn the_start_is_rested_worked_given_or_after_a_rest() {
    let start = |sets: &[&str]| {
        let state = state(sets).expect("it has one");
        (state.build_up, state.breakdown)
    };
    assert_eq!(start(&["bearing.lubricant_state.start=worked"]), (1.0, 1.0));
    let left = (-0.5_f64).exp();
    let after = [
        "bearing.lubricant_state.start=after rest",
        "bearing.lubricant_state.rest_before=300 s",
    ];
    assert_eq!(start(&after), (left, left));
    let given = [
        "bearing.lubricant_state.start=given",
        "bearing.lubricant_state.initial_build_up=0.9",
        "bearing.lubricant_state.initial_breakdown=0.2",
    ];
    assert_eq!(start(&given), (0.9, 0.2));
    // a time at rest without the word that asks for it
    let lost = message(&["bearing.lubricant_state.rest_before=300 s"]);
    assert!(lost.contains("bearing.lubricant_state.start"), "{lost}");
}

#[test]
fn nothing_changes_unless_asked_for() {
    let good = good();
    let plain = good.split("[bearing.lubricant_state]").next().unwrap();
    let read = spin_up(read(plain, &[]).unwrap());
    assert_eq!(read.bearing.lubricant_state, None);
}

#[test]
fn what_has_no_meaning_is_refused_where_it_stands() {
    let without_law = good()
        .lines()
        .filter(|line| !line.starts_with("lubrication") && !line.starts_with("viscosity"))
        .collect::<Vec<_>>()
        .join("\n")
        .replace("law = \"palmgren\"", "law = \"none\"");
    let nothing = read(&without_law, &[]).expect_err("it was accepted");
    assert!(
        nothing.contains("bearing.lubricant_state.kind"),
        "{nothing}"
    );
    assert!(nothing.contains("friction moment"), "{nothing}");
    // 9 ns: no slow state
    let fast = message(&["bearing.lubricant_state.film_heat_capacity=2e-9 J/K"]);
    assert!(fast.contains("film_heat_capacity"), "{fast}");
    let fast = message(&["bearing.lubricant_state.breakdown_time=1 us"]);
    assert!(
        fast.contains("breakdown_time") && fast.contains("1 ms"),
        "{fast}"
    );
    for (set, key) in [
        ("rested_factor=0", "rested_factor"),
        ("worked_factor=-1", "worked_factor"),
        ("build_up_turns=0", "build_up_turns"),
        ("recovery_time=0 s", "recovery_time"),
        ("film_conductance=0 W/K", "film_conductance"),
        (
            "drag_temperature_coefficient=-0.1 1/K",
            "drag_temperature_coefficient",
        ),
        ("breakdown_time=3 m", "breakdown_time"),
    ] {
        let problem = message(&[&format!("bearing.lubricant_state.{set}")]);
        assert!(problem.contains(key), "{problem}");
    }
    // balls that roll have no traction
    let rolling = message(&["bearing.fidelity=rolling"]);
    assert!(
        rolling.contains("traction_temperature_coefficient"),
        "{rolling}"
    );
}
