//! A spin-up as a user meets it.

use crate::place::Place;
use std::fs;

/// The quantities of a spin-up that are always there.
const ALWAYS: [&str; 14] = [
    "inner_race_time_to_95_percent",
    "cage_time_to_95_percent_of_rolling",
    "peak_inner_race_moment",
    "peak_outer_race_moment",
    "law_moment_at_end",
    "traction_capacity",
    "cage_slip_at_end",
    "balls_skid",
    "bearing_dissipated_energy",
    "outer_race_energy_printed",
    "outer_race_energy_corrected",
    "outer_race_energy_exact",
    "path_term",
    "angular_momentum_residual",
];

/// A folder with `spin_up.toml`, the starting file of the program itself.
fn place() -> Place {
    let place = Place::new();
    place.call(&["new", "spin_up", "spin_up.toml"]).done();
    place
}

/// Runs the starting file for 4 ms at the accuracy that its energies are checked with.
fn short_run(place: &Place, out: &str) {
    let words = [
        "run",
        "spin_up.toml",
        "--set",
        "run.duration=4 ms",
        "--out",
        out,
    ];
    let called = place.call(&words).done();
    assert!(called.out.contains("balls skid"), "{called:?}");
}

#[test]
fn a_run_directory_is_whole_and_its_energies_close() {
    let place = place();
    short_run(&place, "a");
    let summary = place.summary("a");
    assert_eq!(summary["system"], "spin_up");
    assert_eq!(summary["complete"], true);
    assert!(summary["clearance_radius_m"].is_null());
    for name in ALWAYS {
        let quantity = &summary["quantities"][name];
        assert!(quantity["unit"].is_string(), "{name}");
        if quantity["value"].is_null() {
            assert!(quantity["why"].is_string(), "{name}");
        }
    }
    let value = |name: &str| summary["quantities"][name]["value"].as_f64().unwrap();
    // the bound of shipped scenarios: a tolerance that misses more is too loose for any statement on energies
    assert!(value("energy_residual").abs() < 1e-6);
    assert!(value("bearing_dissipated_energy") > 0.0);
    let run = place.read("a");
    let rows = run.columns[0].values.len();
    for column in &run.columns {
        assert_eq!(column.values.len(), rows, "{}", column.name);
        assert!(!column.unit.is_empty() && !column.meaning.is_empty());
        let finite = column.values.iter().all(|value| value.is_finite());
        assert!(finite, "{}", column.name);
    }
    let names = [
        "bearing.outer_race.moment",
        "bearing.cage.slip",
        "rotor.speed",
    ];
    for name in names {
        assert!(
            run.columns.iter().any(|column| column.name == name),
            "{name}"
        );
    }
}

#[test]
fn the_resolved_scenario_gives_the_same_history_bit_for_bit() {
    let place = place();
    short_run(&place, "a");
    place
        .call(&["run", "a/scenario.toml", "--out", "b", "--quiet"])
        .done();
    assert!(place.history_bits("a") == place.history_bits("b"));
}

#[test]
fn what_a_spin_up_does_not_have_is_refused() {
    let place = place();
    place
        .call(&["run", "spin_up.toml", "--repeat", "4"])
        .refused(&[
            "AB0110",
            "repeat.count",
            "system = \"drop\"",
            "Only drops are repeated so far",
            "--set PATH=VALUE",
        ]);
    short_run(&place, "a");
    place
        .call(&["report", "a", "--out", "a.svg"])
        .refused(&["AB0109", "no drop"]);
    place.call(&["report", "a", "--out", "a.html"]).done();
    let page = fs::read_to_string(place.path("a.html")).unwrap();
    assert!(page.contains("spin_up"));
}

/// Words that give a bearing whose balls lose so much that a braked race would have no answer.
const LOSSY: [&str; 6] = [
    "--set",
    "bearing.fidelity=rolling",
    "--set",
    "bearing.acceleration_loss.kind=proportional",
    "--set",
    "bearing.acceleration_loss.per_acceleration=1 N s^2/rad",
];

#[test]
fn a_machine_that_cannot_be_built_leaves_nothing_behind() {
    let place = Place::new();
    let text = r#"format = "auxbear.scenario/1"
system = "spin_up"

[drive]
kind = "sliding rotor"
radial_load = "100 N"
rotor_speed = "1000 rad/s"

[bearing]
name = "6005"
operating_diametral_clearance = "-4 um"

[bearing.moment]
law = "palmgren"
f0 = 2.0
f1_factor = 0.0005
f1_exponent = 0.5
viscosity = "40 mm^2/s"
"#;
    fs::write(place.path("lossy.toml"), text).unwrap();
    for command in ["run", "check"] {
        let mut words = vec![command, "lossy.toml"];
        words.extend(LOSSY);
        let expected =
            "error[AB0211]: lossy.toml, --set: bearing.acceleration_loss.per_acceleration: found";
        place.call(&words).refused(&[expected]);
        assert_eq!(place.names(), ["lossy.toml"]);
    }
}

#[test]
fn check_reports_a_load_above_the_static_rating() {
    let place = place();
    let words = [
        "check",
        "spin_up.toml",
        "--set",
        "bearing.static_load_rating=1 kN",
    ];
    let reported = |load: &str| {
        let mut words = words.to_vec();
        words.extend(["--set", load]);
        place.call(&words).done().err
    };
    assert!(!reported("drive.radial_load=0.9 kN").contains("AB1029"));
    let found = reported("drive.radial_load=100 kN");
    assert!(
        found.contains("warning[AB1029]: The static radial load of 100000 N is 100.0 times"),
        "{found}"
    );
}
