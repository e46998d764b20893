//! A qualification with its document: what it needs besides the runs, interrupted and resumed, and what it refuses.

use crate::machine::ran;
use crate::outcomes::number;
use auxbear::outcome::Spread;
use auxbear::report::study::{Directory, Qualified, Wish};
use auxbear::run::Options;
use auxbear::scenario::StudyFile;
use auxbear::study::Study;
use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use tempfile::TempDir;

const CASING: &str = include_str!("../../../scenarios/machine_casing.toml");
const ASKED: &str = "format = \"auxbear.study/1\"\nscenario = \"machine.toml\"\nseed = 3\n\
    [document]\nauthor = \"A. <Engineer>\"\ntest_case = \"shock\"\n\
    [[case]]\nname = \"power lost\"\nexpected = \"once a year\"\ndrops = 3\n\
    [design]\nkind = \"qualification\"\ndraws = 2\n\
    [[input]]\npath = \"run.case\"\nchoice = [\"power lost\", \"shock\"]\n\
    [[input]]\npath = \"contact.friction_coefficient\"\nuniform = [0.1, 0.3]\n\
    [[limit]]\ncase = \"shock\"\nquantity = \"drive_end.first_impact_force\"\nmost = \"1 MN\"\nsource = \"drawing 4711\"\n\
    [[limit]]\ncase = \"shock\"\nquantity = \"node.seal.least_distance\"\nleast = \"0.39 mm\"\n\
    [[limit]]\ncase = \"shock\"\nquantity = \"drive_end.time_to_first_contact\"\nmost = \"1 s\"\nshare = 0.5\n\
    [[requirement]]\ntext = \"Thrust is carried\"\nwhy = \"no axial motion\"\n";

/// The machine for 20 ms, its events at 2 ms, with surfaces that wear.
fn machine() -> String {
    machine_for("20 ms")
}

fn machine_for(duration: &str) -> String {
    CASING
        .replace(
            "duration = \"0.3 s\"",
            &format!("duration = \"{duration}\"\naccuracy = \"screening\""),
        )
        .replace("\"50 ms\"", "\"2 ms\"")
        .replace(
            "[mount]",
            "[contact.surface]\nwear_coefficient = \"1e-8 m^2/N\"\n\n[mount]",
        )
}

fn study(folder: &Path) -> Study {
    let machine_file = folder.join("machine.toml");
    if !machine_file.exists() {
        fs::write(machine_file, machine()).unwrap();
    }
    fs::write(folder.join("study.toml"), ASKED).unwrap();
    Study::new(StudyFile::read(&folder.join("study.toml")).unwrap()).unwrap()
}

/// Qualifies into a directory; interrupts when a stage begins.
fn qualified(folder: &Path, out: &str, until: &str) -> (Directory, Qualified) {
    let interrupt = AtomicBool::new(false);
    let directory = Directory::open(&folder.join(out), study(folder), 0).unwrap();
    let options = Options::unwatched(&interrupt);
    let wish = Wish {
        date: "2026-11-28",
        progress: &|stage, _, _| {
            interrupt.fetch_or(stage == until, Ordering::Relaxed);
        },
    };
    let qualified = directory.qualify(&options, &wish).unwrap();
    (directory, qualified)
}

#[test]
fn a_document_judges_requirements_and_says_what_they_owe_to_inputs() {
    let folder = TempDir::new().unwrap();
    // an impact that is followed for 50 ms after its event
    let machine = machine_for("64 ms");
    fs::write(folder.path().join("machine.toml"), &machine).unwrap();
    let (directory, found) = qualified(folder.path(), "out", "");
    assert!(found.complete && found.done.complete);
    // the run ends while a race slips: a force that holds so far is not shown
    assert_eq!(found.tally, [0, 1, 3]);
    let document = fs::read_to_string(&found.document).unwrap();
    for text in [
        "0 of 4 requirements met, 1 not met, 3 not shown.",
        "2 of 2 runs hold it, the worst of all runs is",
        "no run was confirmed at design accuracy",
        "end while the rotor slips on a race or bushing",
        "A. &lt;Engineer&gt;",
        "drawing 4711",
        "no source is given",
        "once a year",
        "Thrust is carried",
        "2026-11-28",
        "Few draws:",
        "2 draws have no 5 % and 95 %",
        "not in this model",
    ] {
        assert!(document.contains(text), "{text}");
    }
    assert!(!document.contains("complies"));

    // a deciding run with an input at its end is that run with this value
    let study = &directory.study;
    let (_, table) = auxbear::report::study::read(&folder.path().join("out")).unwrap();
    let known = study.little_known();
    assert_eq!(known[0].path, "contact.friction_coefficient");
    assert_eq!(known.len(), 5);
    let [low, high] = known[0].ends;
    assert!((low - 0.11).abs() < 1e-12 && (high - 0.29).abs() < 1e-12);
    let stiffness = known
        .iter()
        .find(|own| own.path == "mount.stiffness")
        .unwrap();
    assert!((stiffness.ends[0] - 1e7).abs() < 1.0 && (stiffness.ends[1] - 4e7).abs() < 4.0);
    let deciding = study.deciding(&table);
    let never = AtomicBool::new(false);
    let options = Options::unwatched(&never);
    let all: Vec<usize> = (0..deciding.len() * known.len() * 2).collect();
    let ends = study.with_ends(&deciding, &known, &all, &options);
    let owed = study.owed(&table, &known, &ends);
    let (member, force) = study.worst(&table, &study.file.limits[0]).unwrap();
    assert_eq!((owed[0].member, owed[0].value), (member, Some(force)));
    let mut sets: Vec<String> = (study.drawn(member).values.iter())
        .map(|(path, value)| format!("{path}={value}"))
        .collect();
    sets.retain(|set| !set.contains("friction_coefficient"));
    sets.push(format!("contact.friction_coefficient={high}"));
    let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
    let alone = number(&ran(&machine, &sets), "drive_end.first_impact_force");
    let seen = owed[0].ends[0][1].unwrap();
    assert!((alone / seen - 1.0).abs() < 1e-9, "{alone} {seen}");
    assert_ne!(seen, force);
}

#[test]
fn drops_in_a_row_carry_the_wear_of_those_before() {
    let folder = TempDir::new().unwrap();
    let study = study(folder.path());
    let never = AtomicBool::new(false);
    let options = Options::unwatched(&never);
    let table = study.run(&(0..study.members()).collect::<Vec<_>>(), &options);
    let rows = study.in_a_row(&table);
    assert_eq!((rows.len(), rows[0].drops), (1, 3));
    let run = |table| study.run_in_a_row::<()>(&rows, table, &options, &mut |_| Ok(()));
    let drops = run(Default::default()).unwrap();
    assert_eq!(drops.members, [0, 1, 2]);
    // the first is the member; one that was kept is not computed again
    let force = "drive_end.peak_contact_force";
    let place = table
        .members
        .iter()
        .position(|member| *member == rows[0].member)
        .unwrap();
    assert_eq!(drops.values(force)[0], table.values(force)[place]);
    let again = run(drops.part(0..1)).unwrap();
    assert!(format!("{again:?}") == format!("{drops:?}"));
    // the third by hand
    let worn = |name: &str| {
        drops.values(&format!("{name}.wear_depth"))[..2]
            .iter()
            .flatten()
            .sum::<f64>()
    };
    assert!(worn("drive_end") > 1e-8, "{}", worn("drive_end"));
    let mut sets: Vec<String> = (study.drawn(rows[0].member).values.iter())
        .map(|(path, value)| format!("{path}={value}"))
        .collect();
    for name in ["drive_end", "other_end"] {
        sets.push(format!(
            "auxiliary_bearing.{name}.contact.radial_air_clearance={} m",
            0.2e-3 + worn(name)
        ));
    }
    let angle = drops.column("input.rotor.unbalance_angle").unwrap().values[2];
    sets.push(format!("rotor.unbalance_angle={angle} rad"));
    let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
    let alone = number(&ran(&machine(), &sets), force);
    let seen = drops.values(force)[2].unwrap();
    assert!((alone / seen - 1.0).abs() < 1e-9, "{alone} {seen}");
}

#[test]
fn predicted_signals_are_those_of_the_runs() {
    let folder = TempDir::new().unwrap();
    let study = study(folder.path());
    let never = AtomicBool::new(false);
    let options = Options::unwatched(&never);
    let first = study.tested();
    assert_eq!(study.case_of(first).as_deref(), Some("shock"));
    let signals = study.predicted(&options).unwrap();
    let signal = |name: &str| signals.iter().find(|own| own.name == name).unwrap();
    let row = signal("time").values.len() - 1;
    let values = (first..first + study.draws()).map(|member| {
        let mut sets: Vec<String> = (study.drawn(member).values.iter())
            .map(|(path, value)| format!("{path}={value}"))
            .collect();
        sets.push("run.output_interval=50 us".to_string());
        let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
        let run = ran(&machine(), &sets);
        run.column("drive_end.rotor.y").unwrap().values[row]
    });
    let spread = Spread::of(values.collect()).unwrap();
    for (end, value) in ["5_percent", "median", "95_percent"]
        .iter()
        .zip(spread.quantiles)
    {
        assert_eq!(
            signal(&format!("drive_end.rotor.y.{end}")).values[row],
            value,
            "{end}"
        );
    }
}

#[test]
fn what_was_interrupted_in_any_stage_goes_on_to_the_same_document() {
    let folder = TempDir::new().unwrap();
    let (directory, whole) = qualified(folder.path(), "whole", "");
    drop(directory);
    let text = |path: &Path| fs::read_to_string(path).unwrap();
    for stage in [
        "runs with other inputs",
        "drops in a row",
        "signals of the test",
    ] {
        let out = stage.replace(' ', "_");
        let (directory, cut) = qualified(folder.path(), &out, stage);
        assert!(!cut.complete && cut.done.complete, "{stage}");
        drop(directory);
        let (_, again) = qualified(folder.path(), &out, "");
        assert!(again.complete, "{stage}");
        assert!(text(&again.document) == text(&whole.document), "{stage}");
    }
}

#[test]
fn what_a_document_cannot_be_is_refused() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("machine.toml"), machine()).unwrap();
    let refused = |from: &str, to: &str| {
        let path = folder.path().join("study.toml");
        assert!(ASKED.contains(from));
        fs::write(&path, ASKED.replace(from, to)).unwrap();
        StudyFile::read(&path).map(|_| ()).unwrap_err().to_string()
    };
    for (from, to, words) in [
        (
            "test_case = \"shock\"",
            "test_case = \"shok\"",
            "Did you mean \"shock\"?",
        ),
        (
            "name = \"power lost\"",
            "name = \"axis lost\"",
            "power lost, shock",
        ),
        ("drops = 3", "drops = 1", "case.drops"),
        ("why = \"no axial motion\"", "", "requirement.why"),
        (
            "why = \"no axial motion\"",
            "why = \" \"",
            "requirement.why",
        ),
        (
            "[design]",
            "[[case]]\nname = \"power lost\"\n[design]",
            "each case once",
        ),
        (
            "seed = 3",
            "seed = 3\nset = [\"run.case=shock\"]",
            "run.case",
        ),
        (
            "kind = \"qualification\"\ndraws = 2",
            "kind = \"monte carlo\"\nmembers = 2",
            "qualification",
        ),
    ] {
        let told = refused(from, to);
        assert!(told.contains(words), "{to}: {told}");
    }
    // what is read is written, and read again
    let path = folder.path().join("study.toml");
    fs::write(&path, ASKED).unwrap();
    let written = StudyFile::read(&path).unwrap().toml();
    fs::write(folder.path().join("scenario.toml"), machine()).unwrap();
    fs::write(&path, &written).unwrap();
    assert_eq!(StudyFile::read(&path).unwrap().toml(), written);
}
