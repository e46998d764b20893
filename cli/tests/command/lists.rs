//! Everything but runs: help, starting files, checks, the catalogue, validation.

use crate::place::Place;
use std::fs;
use std::process::Stdio;

#[test]
fn help_names_what_is_there_and_nothing_else() {
    let place = Place::new();
    let called = place.call(&["--help"]).done();
    for command in [
        "run", "torque", "signals", "identify", "check", "new", "schema", "report", "validate",
        "explain", "bearings", "rotor", "import", "study", "qualify", "service", "mount", "fmu",
        "studio",
    ] {
        assert!(called.out.contains(&format!("\n  {command} ")), "{command}");
        place.call(&[command, "--help"]).done();
    }
}

#[test]
fn the_starting_file_is_written_or_printed_and_reads() {
    let place = Place::new();
    let printed = place.call(&["new", "drop"]).done().out;
    place.call(&["new", "drop", "mine.toml"]).done();
    assert_eq!(
        fs::read_to_string(place.path("mine.toml")).unwrap(),
        printed
    );
    place.call(&["check", "mine.toml"]).done();
    for kind in ["spin_up", "torque", "rig"] {
        place.call(&["new", kind, "other.toml"]).done();
        place.call(&["check", "other.toml"]).done();
        fs::remove_file(place.path("other.toml")).unwrap();
    }
}

#[test]
fn check_prints_a_file_that_checks_to_itself() {
    let place = Place::new();
    let once = place
        .call(&["check", "drop.toml", "--set", "rotor.mass=9 kg"])
        .done();
    assert!(once.out.contains("mass = \"9 kg\""));
    assert!(
        once.out
            .contains("acceleration = { value = \"9.81 m/s^2\", from = \"default\" }")
    );
    fs::write(place.path("resolved.toml"), &once.out).unwrap();
    let twice = place.call(&["check", "resolved.toml"]).done();
    // Defaults have become given values; the values themselves stay.
    let value = |line: &str| line.split(" #").next().unwrap().to_string();
    let values = |text: &str| -> Vec<String> {
        let kept = text.lines().filter(|line| !line.starts_with('#'));
        kept.map(value).collect()
    };
    assert_eq!(values(&once.out), values(&twice.out));
    assert_eq!(place.names(), ["resolved.toml"]);
}

#[test]
fn a_reader_that_leaves_early_is_no_error() {
    let place = Place::new();
    for words in [
        &["new", "drop"][..],
        &["check", "drop.toml"],
        &["bearings", "show", "6005"],
        &["--help"],
    ] {
        let mut child = place
            .command(words)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{words:?}");
        assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    }
}

/// One call with files of every kind: it computes all that ships. How each kind alone ends is asked in `cli/src/validation.rs`.
#[test]
fn validation_reports_cases_that_fail_are_damaged_or_of_another_format() {
    let place = Place::new();
    fs::create_dir(place.path("cases")).unwrap();
    let case = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../crates/validate/cases/palmgren_low_speed.toml"
    );
    let wrong = fs::read_to_string(case)
        .unwrap()
        .replace("value = \"16", "value = \"17");
    for (name, text) in [
        ("other.toml", "a = 1"),
        ("wrong.toml", &wrong),
        ("cut.json", "{\"a\": "),
        ("empty.toml", ""),
        ("broken.toml", "format = \"auxb"),
    ] {
        fs::write(place.path("cases").join(name), text).unwrap();
    }
    let called = place.call(&["validate", "--json", "--cases", "cases"]);
    assert_eq!(called.code, Some(2), "{called:?}");
    let damaged = called.err.matches("error[AB0310]").count();
    assert_eq!(damaged, 3, "{called:?}");
    let report: serde_json::Value = serde_json::from_str(&called.out).unwrap();
    let rows = report["cases"].as_array().unwrap();
    let cases = |verdict: &str| -> Vec<&str> {
        let rows = rows.iter().filter(|row| row["verdict"] == verdict);
        rows.filter_map(|row| row["case"].as_str()).collect()
    };
    assert!(cases("pass").len() > 10);
    let failed = cases("fail");
    assert!(
        !failed.is_empty() && failed.iter().all(|case| *case == "wrong"),
        "{failed:?}"
    );
    let long = "published_flywheel_spin_down";
    assert_eq!(cases("not run"), ["broken", "cut", "empty", "other", long]);
}
