//! `auxbear torque`, and a file of the same system.

use crate::place::Place;
use std::fs;

#[test]
fn a_name_gives_a_table_and_a_run_directory() {
    let place = Place::new();
    let called = place.call(&["torque", "6005"]).done();
    for part in ["Torque of a 6005", "N mm", "t_O", "11500 rad/s^2"] {
        assert!(called.out.contains(part), "{part}: {}", called.out);
    }
    assert!(called.err.contains("warning[AB1013]"), "{}", called.err);
    let summary = place.summary("runs/torque-6005");
    assert_eq!(summary["system"], "torque");
    assert_eq!(summary["complete"], true);
    let run = place.read("runs/torque-6005");
    assert_eq!(run.columns[0].name, "speed");
    for column in &run.columns {
        assert_eq!(column.values.len(), 200, "{}", column.name);
        assert!(!column.unit.is_empty() && !column.meaning.is_empty());
    }
    let page = fs::read_to_string(place.path("runs/torque-6005/report.html")).unwrap();
    assert!(page.contains("torqueMomentSection"));
    // the resolved file gives the same run
    let file = "runs/torque-6005/scenario.toml";
    place.call(&["run", file, "--out", "b", "--quiet"]).done();
    assert!(place.history_bits("runs/torque-6005") == place.history_bits("b"));
}

#[test]
fn words_of_the_command_line_are_values_of_the_file() {
    let place = Place::new();
    let called = place.call(&[
        "torque",
        "6005",
        "--law",
        "palmgren",
        "--law",
        "skf",
        "--speed-to",
        "150 rad/s",
        "--load",
        "80 N",
        "--load",
        "400 N",
        "--acceleration",
        "-1300 rad/s^2",
        "--temperature",
        "60 degC",
        "--temperature",
        "80 degC",
        "--lubricant",
        "thin: 32 mm^2/s at 40 degC, 5.4 mm^2/s at 100 degC",
        "--lubricant",
        "ISO VG 68, 8.7 mm^2/s at 100 degC",
        "--set",
        "bearing.moment.f0=2",
        "--out",
        "a",
    ]);
    let called = called.done();
    for part in ["-1300 rad/s^2", "400 N", "skf", "thin", "60 degC"] {
        assert!(called.out.contains(part), "{part}: {}", called.out);
    }
    let file = r#"
format = "auxbear.scenario/1"
system = "torque"
[torque]
speed_to = "150 rad/s"
accelerations = "-1300 rad/s^2"
loads = ["80 N", "400 N"]
temperatures = ["60 degC", "80 degC"]
laws = ["palmgren", "skf"]
lubricants = ["thin: 32 mm^2/s at 40 degC, 5.4 mm^2/s at 100 degC", "ISO VG 68, 8.7 mm^2/s at 100 degC"]
[bearing]
name = "6005"
[bearing.moment]
law = "palmgren"
f0 = 2
temperature = "60 degC"
"#;
    fs::write(place.path("same.toml"), file).unwrap();
    place
        .call(&["run", "same.toml", "--out", "b", "--quiet"])
        .done();
    assert!(place.history_bits("a") == place.history_bits("b"));
    let quantities = |directory: &str| place.summary(directory)["quantities"].clone();
    assert_eq!(quantities("a"), quantities("b"));
}

#[test]
fn wrong_words_are_refused_and_leave_nothing() {
    let place = Place::new();
    for (words, parts) in [
        (&["torque", "6o05"][..], &["AB0201", "6o05"][..]),
        (
            &["torque", "6005", "--load", "80"],
            &["AB0103", "torque.loads"],
        ),
        (
            &["torque", "6005", "--temperature", "60 degC"],
            &["AB0110", "temperature"],
        ),
        (
            &[
                "torque",
                "6005",
                "--lubricant",
                "ISO VG 68",
                "--temperature",
                "90 degC",
            ],
            &["AB0208", "ISO VG 68"],
        ),
        (
            &["torque", "6005", "--law", "palmgen"],
            &["AB0108", "\"palmgren\""],
        ),
        (
            &[
                "torque",
                "6005",
                "--law",
                "skf",
                "--set",
                "bearing.moment.lubrication=oil mist",
            ],
            &["AB0208", "oil mist"],
        ),
    ] {
        place.call(words).refused(parts);
    }
    assert_eq!(place.names(), [""; 0]);
}

#[test]
fn a_users_own_bearing_has_a_torque() {
    let place = Place::new();
    let file = r#"
format = "auxbear.bearings/1"
[[bearing]]
name = "mine"
type = { value = "deep groove", assumed = "a test" }
ball_material = { value = "steel", assumed = "a test" }
bore_diameter = { value = "25 mm", assumed = "a test" }
outer_diameter = { value = "47 mm", assumed = "a test" }
ball_count = { value = 10, assumed = "a test" }
ball_diameter = { value = "6.35 mm", assumed = "a test" }
pitch_diameter = { value = "36 mm", assumed = "a test" }
cage_mass = { value = "5 g", assumed = "a test" }
static_load_rating = { value = "6.55 kN", assumed = "a test" }
"#;
    fs::write(place.path("mine.toml"), file).unwrap();
    let words = ["torque", "mine", "--catalogue", "mine.toml", "--out", "a"];
    place.call(&words).refused(&["AB0107", "bearing.moment"]);
    let words = [&words[..], &["--set", "bearing.moment.series=60"]].concat();
    place.call(&words).done();
}

#[test]
fn the_shipped_file_runs() {
    let place = Place::new();
    let shipped = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenarios/torque_6005.toml");
    let called = place.call(&["run", shipped, "--out", "a"]).done();
    for part in [
        "at 150 rad/s, 80 N, 100 mm^2/s, 40 degC",
        "-10.2",
        "ISO VG 220",
    ] {
        assert!(called.out.contains(part), "{part}: {}", called.out);
    }
}
