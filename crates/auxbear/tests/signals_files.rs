//! Measurement files through their front: units of times, clocks, names, cuts.

use crate::measurement_file::{TORQUE, problem, table};
use auxbear::run::build;
use auxbear::scenario::{BuiltIn, Scenario};
use std::fs;
use std::path::Path;

/// Times without a unit are taken only as the scenario says: an instant of 3 is not three seconds by itself.
#[test]
fn times_without_a_unit_are_asked_for() {
    let bare = table("N mm", &|_| None).replace("s,N mm\n", ",N mm\n");
    assert_eq!(
        problem("run.csv", &bare, TORQUE),
        "error[AB0306]: a.toml:6: signals.torque.channel: found run.csv, times in channel \"time\" without a unit; their unit is needed: signals.time_unit = \"s\", or in the file, as in \"time [s]\""
    );
    let edges = "[signals.speed]\nchannel = \"time\"\nkind = \"edges\"\nstamp_deviation = \"1 us\"\nmarks_per_revolution = 60\n";
    let shown = problem("run.csv", &bare, edges);
    assert!(
        shown.contains("AB0306") && shown.contains("signals.time_unit"),
        "{shown}"
    );
    // 40 rows of 1 ms: with the key the clock is that of the unit
    for (unit, rate) in [("s", 1e3), ("ms", 1e6)] {
        let shown = problem(
            "run.csv",
            &bare,
            &format!("time_unit = \"{unit}\"\n{TORQUE}highest_frequency = \"1e9 Hz\"\n"),
        );
        let half = format!("to {} Hz is needed", 0.5 * rate);
        assert!(shown.contains(&half), "{shown}");
    }
}

/// An interval in the scenario beside a clock of the file is checked against it.
#[test]
fn an_interval_that_contradicts_the_file_is_reported() {
    let shown = problem(
        "run.csv",
        &table("N mm", &|_| None),
        &format!("sample_interval = \"0.1 ms\"\n{TORQUE}"),
    );
    assert_eq!(
        shown,
        "error[AB0305]: a.toml:5: signals.sample_interval: found run.csv, channel \"torque\", whose clock has an interval of 1000 us, beside 100 us here; leave signals.sample_interval away: the file states the clock of its channels"
    );
    // the same interval is no contradiction
    let same = problem(
        "run.csv",
        &table("N mm", &|_| None),
        &format!("sample_interval = \"1 ms\"\n{TORQUE}highest_frequency = \"1e9 Hz\"\n"),
    );
    assert!(same.contains("highest_frequency"), "{same}");
}

#[test]
fn two_channels_of_one_name_are_reported() {
    let shown = problem(
        "run.csv",
        "time,torque,torque\ns,N mm,N mm\n0,1,2\n0.1,2,3\n0.2,3,4\n",
        TORQUE,
    );
    assert!(
        shown.contains("2 channels \"torque\", the first two as numbers 2 and 3 of 3"),
        "{shown}"
    );
}

/// A crash cut the file before the channel came: the message says so.
#[test]
fn a_channel_that_a_cut_took_away_is_reported_with_the_cut() {
    let whole = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/data/spin_up.tdms");
    let bytes = fs::read(whole).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.toml");
    fs::write(
        &file,
        format!("format = \"auxbear.scenario/1\"\nsystem = \"signals\"\n[signals]\nfile = \"cut.tdms\"\n{TORQUE}"),
    )
    .unwrap();
    let mut shown = Vec::new();
    for part in [60, 200, 400, 800] {
        fs::write(folder.path().join("cut.tdms"), &bytes[..part]).unwrap();
        let scenario = Scenario::read(&file, &[], &BuiltIn).unwrap();
        if let Err(problem) = build(&scenario) {
            shown.push(problem.to_string());
        }
    }
    println!("{shown:#?}");
    assert!(!shown.is_empty());
    for text in shown.iter().filter(|text| text.contains("AB0304")) {
        assert!(text.contains("What was not read: "), "{text}");
    }
    assert!(
        shown.iter().any(|text| text.contains("AB0304")),
        "{shown:?}"
    );
}
