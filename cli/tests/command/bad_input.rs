//! Wrong input: one message, exit status 2, nothing written.

use crate::place::{Called, Place};
use std::fs;

#[test]
fn a_folder_instead_of_a_file() {
    let place = Place::new();
    fs::create_dir(place.path("folder.toml")).unwrap();
    let called = place.call(&["run", "folder.toml"]);
    called.refused(&["error[AB0002]: folder.toml: found a folder"]);
    assert_eq!(place.names(), ["folder.toml"]);
}

#[test]
fn a_file_that_is_not_there() {
    let place = Place::new();
    place.call(&["run", "dorp.toml"]).refused(&["AB0001"]);
    place.call(&["check", "dorp.toml"]).refused(&["AB0001"]);
    assert!(place.names().is_empty());
}

#[test]
fn bytes_that_are_no_text() {
    let place = Place::new();
    fs::write(place.path("old.toml"), b"title = \"\xe4\"\n").unwrap();
    let called = place.call(&["run", "old.toml"]);
    called.refused(&["error[AB0003]: old.toml:1", "UTF-8"]);
    assert_eq!(place.names(), ["old.toml"]);
}

#[test]
fn an_unknown_key_names_the_near_one() {
    let place = Place::new();
    let text = fs::read_to_string(place.path("drop.toml")).unwrap();
    let wrong = text.replacen("\nmass =", "\nmas =", 1);
    let line = wrong.lines().position(|l| l.starts_with("mas =")).unwrap() + 1;
    fs::write(place.path("wrong.toml"), wrong).unwrap();
    let place_named = format!("error[AB0101]: wrong.toml:{line}: rotor.mas");
    let called = place.call(&["run", "wrong.toml"]);
    called.refused(&[&place_named, "Did you mean \"rotor.mass\"?"]);
    assert_eq!(place.names(), ["wrong.toml"]);
}

#[test]
fn overrides_are_checked_like_the_file() {
    let place = Place::new();
    for (set, parts) in [
        ("rotor.mass=8", ["AB0103", "--set: rotor.mass"]),
        ("rotor.mass=8 mm", ["AB0105", "--set: rotor.mass"]),
        ("rotor.mass=-8 kg", ["AB0106", "--set: rotor.mass"]),
        ("rotor.mas=8 kg", ["AB0101", "mass"]),
        ("rotor.mass", ["AB0113", "--set"]),
        ("bearing.name=6995", ["AB0201", "6005"]),
    ] {
        let called = place.call(&["run", "drop.toml", "--set", set]);
        called.refused(&parts);
        place
            .call(&["check", "drop.toml", "--set", set])
            .refused(&parts);
    }
    assert!(place.names().is_empty());
}

#[test]
fn the_number_of_repeats_is_checked_like_the_file() {
    let place = Place::new();
    for count in ["0", "-1", "many", "1000000000"] {
        let called = place.call(&["run", "drop.toml", &format!("--repeat={count}")]);
        called.refused(&["repeat.count", "--set"]);
    }
    assert!(place.names().is_empty());
}

#[test]
fn words_that_are_no_command() {
    let place = Place::new();
    for words in [
        &["rnu", "drop.toml"][..],
        &["run"],
        &["run", "drop.toml", "--ouput", "x"],
        &["studio", "--port", "many"],
        &[],
    ] {
        let called = place.call(words);
        assert_eq!(called.code, Some(2), "{called:?}");
        assert!(called.err.contains("help"), "{called:?}");
    }
    assert!(place.names().is_empty());
}

#[test]
fn results_are_never_written_over_others() {
    let place = Place::new();
    fs::create_dir(place.path("taken")).unwrap();
    fs::write(place.path("taken/mine.txt"), "mine").unwrap();
    let called = place.call(&["run", "drop.toml", "--out", "taken"]);
    called.refused(&["error[AB0301]: taken: found", "--out", "remove"]);
    fs::write(place.path("file"), "mine").unwrap();
    let called = place.call(&["run", "drop.toml", "--out", "file"]);
    called.refused(&["error[AB0301]: file"]);
    // a directory that no run left behind, and one that another run holds
    fs::create_dir(place.path("half.partial")).unwrap();
    fs::write(place.path("half.partial/mine.txt"), "mine").unwrap();
    let called = place.call(&["run", "drop.toml", "--out", "half"]);
    called.refused(&["error[AB0301]: half.partial", "another run"]);
    fs::remove_file(place.path("half.partial/mine.txt")).unwrap();
    let held = fs::File::open(place.path("half.partial")).unwrap();
    held.try_lock().unwrap();
    let called = place.call(&["run", "drop.toml", "--out", "half"]);
    called.refused(&["error[AB0301]: half.partial", "another run"]);
    assert_eq!(place.names(), ["file", "half.partial", "taken"]);
    assert_eq!(fs::read_dir(place.path("taken")).unwrap().count(), 1);
}

#[test]
fn what_a_killed_run_left_behind_is_taken_over() {
    let place = Place::new();
    fs::create_dir(place.path("run.partial")).unwrap();
    fs::write(place.path("run.partial/scenario.toml"), "old").unwrap();
    fs::write(place.path("run.partial/history.parquet"), "old").unwrap();
    place.short_run(&["--out", "run"]).done();
    assert_eq!(place.names(), ["run"]);
    assert!(place.read("run").columns.len() > 1);
}

/// Output that the system refuses is an error; a reader that has left is none.
#[cfg(target_os = "linux")]
#[test]
fn output_that_cannot_be_written_is_an_error() {
    for words in [
        &["check", "drop.toml"][..],
        &["torque", "6005", "--out", "torque"],
        &["bearings", "list"],
        &["new", "drop"],
        &["schema", "drop"],
        &["--help"],
        &["run", "--help"],
    ] {
        let place = Place::new();
        let full = fs::OpenOptions::new()
            .write(true)
            .open("/dev/full")
            .unwrap();
        let output = place.command(words).stdout(full).output().unwrap();
        let called = Called::of(output);
        assert_eq!(called.code, Some(1), "{words:?}: {called:?}");
        assert!(
            called.err.contains("error[AB0302]: standard output"),
            "{called:?}"
        );
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        fs::remove_dir_all(place.path("torque")).ok();
        let output = place.command(words).stdout(writer).output().unwrap();
        let called = Called::of(output);
        assert_eq!(called.code, Some(0), "{words:?}: {called:?}");
        assert!(!called.err.contains("error"), "{called:?}");
    }
}

/// A pipe may wait for ever, a device never end.
#[cfg(unix)]
#[test]
fn pipes_and_devices_are_refused_at_once() {
    let place = Place::new();
    let made = std::process::Command::new("mkfifo")
        .arg(place.path("pipe"))
        .status();
    assert!(made.unwrap().success());
    let text = auxbear::scenario::template("signals").unwrap();
    fs::write(place.path("signals.toml"), text).unwrap();
    for input in ["pipe", "/dev/zero", "/dev/null"] {
        let file = format!("signals.file={input}");
        let file = file.as_str();
        for words in [
            &["check", input][..],
            &["bearings", "list", "--catalogue", input],
            &["torque", "6005", "--catalogue", input],
            &["signals", "signals.toml", "--set", file],
        ] {
            let called = place.call(words);
            assert_eq!(called.code, Some(2), "{words:?}: {called:?}");
            assert!(
                called.err.contains("a pipe, a socket or a device"),
                "{called:?}"
            );
        }
    }
}

#[test]
fn a_place_that_cannot_be_written_is_found_before_the_run() {
    let place = Place::new();
    fs::write(place.path("file"), "").unwrap();
    for out in ["file/run", "..", "/proc/run"] {
        let called = place.call(&["run", "drop.toml", "--out", out]);
        called.refused(&["error[AB030"]);
    }
    for words in [
        &["run", "drop.toml", "--out", "file/run"][..],
        &["new", "drop", "file/drop.toml"],
    ] {
        place
            .call(words)
            .refused(&["error[AB0307]: file", "nothing can be made there"]);
    }
    assert_eq!(place.names(), ["file"]);
}

#[test]
fn a_number_of_threads_that_is_none() {
    let place = Place::new();
    for threads in ["0", "-1", "1.5", "many", "99999999999999999999"] {
        let called = place.call(&["run", "drop.toml", "--threads", threads]);
        called.refused(&[
            "error[AB0106]: auxbear run: --threads: found",
            threads,
            "a whole number from 1 on is needed",
        ]);
    }
    assert!(place.names().is_empty());
}

#[test]
fn a_dash_is_the_standard_output() {
    let place = Place::new();
    let printed = place.call(&["new", "drop", "-"]).done().out;
    assert_eq!(printed, place.call(&["new", "drop"]).done().out);
    assert!(printed.contains("system = \"drop\""), "{printed}");
    assert!(place.names().is_empty());
}

#[test]
fn starting_files_of_other_kinds() {
    let place = Place::new();
    place
        .call(&["new", "mount"])
        .refused(&["AB0112", "\"mount\"", "planned"]);
    place
        .call(&["new", "drpo"])
        .refused(&["AB0108", "Did you mean \"drop\"?"]);
    let called = place.call(&["new", "drop", "drop.toml"]);
    called.refused(&["error[AB0301]: drop.toml"]);
}

#[test]
fn a_bearing_that_nobody_knows() {
    let place = Place::new();
    let called = place.call(&["bearings", "show", "6x06"]);
    called.refused(&["AB0201", "\"6x06\"", "6000, 6000 hybrid, 6001"]);
}

#[test]
fn a_report_of_what_is_no_run() {
    let place = Place::new();
    place
        .call(&["report", "nothing"])
        .refused(&["error[AB0001]: nothing"]);
    place
        .call(&["report", "drop.toml"])
        .refused(&["error[AB0006]: drop.toml"]);
    fs::create_dir(place.path("empty")).unwrap();
    place
        .call(&["report", "empty"])
        .refused(&["error[AB0001]: empty"]);
}

#[test]
fn a_folder_of_cases_that_is_not_there() {
    let place = Place::new();
    place
        .call(&["validate", "--cases", "nothing"])
        .refused(&["AB0001"]);
}
