//! The results of a machine are known before its run.

use super::*;
use outcome::Stop;
use scenario::BuiltIn;
use std::path::Path;
use std::sync::atomic::AtomicBool;

/// A pattern stands for any number of results.
fn fits(known: &Quantity, found: &Quantity) -> bool {
    let name = match known.name.split_once('*') {
        Some((start, end)) => found.name.starts_with(start) && found.name.ends_with(end),
        None => known.name == found.name,
    };
    name && (known.unit, known.meaning, known.awaited) == (found.unit, found.meaning, found.awaited)
}

/// Runs a shipped scenario and compares the names of its results with those known before.
fn checked(file: &str, sets: &[&str], interrupt: bool) -> Stop {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../scenarios/{file}.toml"));
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    let scenario = Scenario::read(&path, &sets, &BuiltIn).expect(file);
    let machine = build(&scenario).expect(file);
    let known = machine.results();
    let interrupt = AtomicBool::new(interrupt);
    let outcome = machine.run(&Options::unwatched(&interrupt));
    let mut found = outcome.quantities.iter().peekable();
    for known in &known {
        if known.name.contains('*') {
            while found.next_if(|found| fits(known, found)).is_some() {}
        } else {
            let next = found.next().map(|found| (fits(known, found), &found.name));
            assert_eq!(next, Some((true, &known.name)), "{file}");
        }
    }
    assert_eq!(found.next(), None, "{file}");
    outcome.stop
}

#[test]
fn the_results_of_every_shipped_machine_in_time_are_known_before_its_run() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let mut count = 0;
    for entry in folder.read_dir().expect("it is shipped") {
        let path = entry.expect("it is shipped").path();
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let Ok(scenario) = Scenario::read(&path, &[], &BuiltIn) else {
            continue;
        };
        let in_time = matches!(
            scenario.system,
            System::Drop(_) | System::SpinUp(_) | System::Rig(_) | System::CoastDown(_)
        );
        if in_time && path.extension().is_some_and(|end| end == "toml") {
            let once = ["repeat.count=1"];
            let sets = &once[..usize::from(matches!(scenario.system, System::Drop(_)))];
            checked(&name, sets, true);
            count += 1;
        }
    }
    assert!(count >= 27, "{count}");
}

#[test]
fn they_are_those_of_a_run_that_ends() {
    for (file, sets) in [
        ("spin_up_warming", &["run.duration=50 ms"][..]),
        ("rig_test_3_warming", &["run.duration=300 ms"]),
        ("coast_down_closing", &[]),
        ("drop_whirl_closing", &["run.duration=20 ms"]),
        ("two_bearings_drop", &["run.duration=20 ms"]),
        ("amb_rig_drop", &["run.duration=2 ms"]),
    ] {
        assert!(checked(file, sets, false).complete(), "{file}");
    }
}
