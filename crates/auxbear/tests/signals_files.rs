//! Measurement files through their front: units of times, clocks, names, cuts.

use crate::measurement_file::{TORQUE, problem, table};
use crate::outcomes::number;
use auxbear::outcome::Outcome;
use auxbear::run::{Options, build, run};
use auxbear::scenario::{BuiltIn, Scenario};
use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;

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
    assert!(shown.contains("\"torque#1\" is the first"), "{shown}");
}

/// What a signals file makes of a text file.
fn outcome(name: &str, content: &str, more: &str) -> Outcome {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join(name), content).unwrap();
    let text = format!(
        "format = \"auxbear.scenario/1\"\nsystem = \"signals\"\n[signals]\nfile = \"{name}\"\n{more}"
    );
    let file = folder.path().join("a.toml");
    fs::write(&file, text).unwrap();
    let scenario = Scenario::read(&file, &[], &BuiltIn).unwrap();
    run(&scenario, &Options::unwatched(&AtomicBool::new(false))).unwrap()
}

const SPEED: &str =
    "[signals.speed]\nchannel = \"speed\"\nkind = \"speed\"\nquick_change = \"none\"\n";

#[test]
fn one_of_two_channels_of_a_name_is_chosen_by_its_place() {
    let mut text = String::from("time [s],speed [rad/s],speed [rad/s]\n");
    for k in 0..200 {
        let time = f64::from(k) * 0.01;
        text += &format!("{time:.2},{:.4},{:.4}\n", 100.0 - time, 50.0 - 2.0 * time);
    }
    for (place, peak, slope) in [(1, 100.0, -1.0), (2, 50.0, -2.0)] {
        let more = SPEED.replace("\"speed\"\nkind", &format!("\"speed#{place}\"\nkind"));
        let outcome = outcome("run.csv", &text, &more);
        assert!((number(&outcome, "peak_speed") - peak).abs() < 1e-3);
        assert!((number(&outcome, "peak_acceleration") - slope).abs() < 1e-3);
    }
    let more = SPEED.replace("\"speed\"\nkind", "\"speed#3\"\nkind");
    assert!(problem("run.csv", &text, &more).contains("AB0304"));
}

/// A coast-down from 150 rad/s in 8 s to 1/e, at times that are off by parts of 10 ms, in rad/s with 4 digits.
fn coast(time: impl Fn(u32) -> Option<f64>) -> String {
    let mut text = String::from("time [s],speed [rad/s]\n");
    for time in (0..400).filter_map(time) {
        text += &format!("{time:.6},{:.4}\n", 150.0 * (-time / 8.0).exp());
    }
    text
}

#[test]
fn a_speed_needs_rising_times_only() {
    let early = |k: u32| f64::from(k * 7 % 11) / 11.0 - 0.5;
    let jitter = coast(|k| Some(f64::from(k) * 0.01 + 0.004 * early(k)));
    let gap = coast(|k| (!(100..151).contains(&k)).then_some(f64::from(k) * 0.01));
    for (text, told) in [
        (&jitter, "uneven times"),
        (&gap, "the gaps 0.990000 to 1.510000 s"),
    ] {
        let outcome = outcome("run.csv", text, SPEED);
        // The true slope at the start, and a time of the first value that may be off by 2 ms of it.
        assert!((number(&outcome, "peak_acceleration") + 18.75).abs() < 0.03);
        assert!((number(&outcome, "peak_speed") - 150.0).abs() < 0.05);
        let all = format!("{:?}", outcome.warnings);
        assert!(all.contains(told), "{all}");
    }
    // A part before the gap has none; a torque has no use for one across it.
    let before = outcome("run.csv", &gap, &format!("to = \"0.9 s\"\n{SPEED}"));
    assert!(before.warnings.is_empty(), "{:?}", before.warnings);
    let torque = gap.replace("speed [rad/s]", "torque [N mm]");
    let shown = problem("run.csv", &torque, TORQUE);
    assert!(
        shown.contains("a gap of 0.520000 s behind 0.990000 s"),
        "{shown}"
    );
    let fine = outcome("run.csv", &torque, &format!("to = \"0.9 s\"\n{TORQUE}"));
    assert!(!format!("{:?}", fine.warnings).contains("AB0305"));
    let falls = gap.replace("1.600000", "1.500000");
    assert!(problem("run.csv", &falls, SPEED).contains("rise from value to value"));
}

/// A logic analyser writes a row at each change of any of its lines.
#[test]
fn a_line_of_0_and_1_gives_the_instants_of_one_flank() {
    // 8 marks a turn at 10 turns a second, high for a third; another line changes in between.
    let mut changes: Vec<(f64, usize)> = (0..480)
        .flat_map(|k| {
            [
                (0.1 + f64::from(k) / 80.0, 0),
                (0.1 + (f64::from(k) + 0.3) / 80.0, 0),
            ]
        })
        .chain((0..90).map(|k| (0.0503 + 0.0667 * f64::from(k), 1)))
        .collect();
    changes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut text = String::from("Time [s],Channel 0,Channel 1\n0.000000000,0,1\n");
    let mut lines = [0, 1];
    for (time, line) in changes {
        lines[line] = 1 - lines[line];
        text += &format!("{time:.9},{},{}\n", lines[0], lines[1]);
    }
    let wish = "[signals.speed]\nchannel = \"Channel 0\"\nkind = \"edges\"\nstamp_deviation = \"1 us\"\nmarks_per_revolution = 8\nquick_change = \"none\"\n";
    for flank in ["rising", "falling", "centre"] {
        let outcome = outcome("run.csv", &text, &format!("{wish}flank = \"{flank}\"\n"));
        assert_eq!(number(&outcome, "pulse_count"), 480.0, "{flank}");
        let peak = number(&outcome, "peak_speed");
        assert!(
            (peak - 20.0 * std::f64::consts::PI).abs() < 0.02,
            "{flank}: {peak}"
        );
    }
}

#[test]
fn rotational_speeds_and_torques_are_understood_in_the_units_of_workshops() {
    let mut text = String::from("time [s],speed,torque\n");
    for k in 0..200 {
        let time = f64::from(k) * 0.01;
        text += &format!("{time:.2},{:.4},2\n", 1500.0 - 60.0 * time);
    }
    for unit in ["1 1/min", "1 r/min", "1 U/min", "1 RPM", "1 min^-1"] {
        let more = SPEED.replace("kind =", &format!("scale = \"{unit}\"\nkind ="));
        let peak = number(&outcome("run.csv", &text, &more), "peak_speed");
        assert!(
            (peak - 50.0 * std::f64::consts::PI).abs() < 1e-3,
            "{unit}: {peak}"
        );
    }
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
