//! Studies that are interrupted, late or damaged: nothing is lost, nothing is judged that is not there.

use auxbear::outcome::Verdict;
use auxbear::report::study::{Directory, Done};
use auxbear::run::{Options, each};
use auxbear::scenario::{BuiltIn, Scenario, StudyFile, template};
use auxbear::study::Study;
use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use tempfile::TempDir;

const STUDY: &str = r#"format = "auxbear.study/1"
scenario = "drop.toml"
set = ["run.duration=20 ms", "run.accuracy=screening"]
seed = 3
[design]
kind = "monte carlo"
members = 130
[[input]]
path = "contact.friction_coefficient"
lognormal = 0.2
[[limit]]
quantity = "first_impact_force"
most = "1 N"
[question]
results = ["first_impact_force", "inner_race_time_to_50_percent"]
"#;

/// Limits name results that an analysis of some seconds has, so a member's machine is built as long.
#[test]
fn an_interrupt_ends_the_analysis_that_limits_ask_for() {
    let rotor = "format = \"auxbear.scenario/1\"\nsystem = \"rotor\"\n[rotor]\nspeed = \"1000 rad/s\"\n\
        [analysis]\nspeed_to = \"2000 rad/s\"\ncutoff = \"1e9 rad/s\"\nspeed_count = 200\n\
        [[rotor.section]]\nlength = \"1 m\"\nouter_diameter = \"50 mm\"\nmaterial = \"steel\"\nelements = 30\n\
        [[rotor.support]]\nat = \"0 m\"\nstiffness = \"1 MN/m\"\ndamping = \"100 N s/m\"\n\
        [[rotor.support]]\nat = \"1 m\"\nstiffness = \"1 MN/m\"\ndamping = \"100 N s/m\"\n\
        [[limit]]\nquantity = \"mode_1.frequency\"\nleast = \"1 rad/s\"\n";
    let scenario = Scenario::parse(rotor, "rotor.toml", &[], &BuiltIn);
    let interrupt = AtomicBool::new(false);
    let single = std::thread::scope(|scope| {
        scope.spawn(|| {
            std::thread::sleep(Duration::from_millis(800));
            interrupt.store(true, Ordering::Relaxed);
        });
        let begin = Instant::now();
        let singles = each(&[scenario], &Options::unwatched(&interrupt));
        assert!(
            begin.elapsed() < Duration::from_secs(3),
            "{:?}",
            begin.elapsed()
        );
        singles.into_iter().next().unwrap()
    });
    assert_eq!(single.stop.reason, "interrupted");
}

fn folder(study: &str) -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("study.toml"), study).unwrap();
    fs::write(folder.path().join("drop.toml"), template("drop").unwrap()).unwrap();
    folder
}

fn directory(folder: &Path, out: &str) -> Directory {
    let study = Study::new(StudyFile::read(&folder.join("study.toml")).unwrap()).unwrap();
    Directory::open(&folder.join(out), study, 0).unwrap()
}

/// Runs it until a share of its members is there.
fn until(folder: &Path, out: &str, share: f64) -> Done {
    let interrupt = AtomicBool::new(share == 0.0);
    let stop = |there: f64| {
        if there >= share * 130.0 {
            interrupt.store(true, Ordering::Relaxed);
        }
    };
    let options = Options {
        threads: Some(1),
        ..Options::unwatched(&interrupt)
    };
    directory(folder, out).run(&options, &stop).unwrap()
}

fn whole(folder: &Path, out: &str) -> Done {
    until(folder, out, f64::INFINITY)
}

fn table(folder: &Path, out: &str) -> String {
    fs::read_to_string(folder.join(out).join("members.csv")).unwrap()
}

#[test]
fn what_had_ended_when_a_study_is_interrupted_is_kept() {
    let held = "[[limit]]\nquantity = \"first_impact_force\"\nmost = \"1e9 N\"\n[question]";
    let folder = folder(&STUDY.replace("[question]", held));
    let path = folder.path();
    let none = until(path, "none", 0.0);
    assert_eq!(none.answer.members, 0);
    // without a member nothing passes and nothing fails
    assert_eq!(none.answer.limits[0].judged.verdict, Verdict::Undecided);

    whole(path, "straight");
    let mut there = 0;
    for share in [0.2, 0.6] {
        let some = until(path, "cut", share);
        assert!(
            there < some.answer.members && some.answer.members < 130,
            "{share}: {}",
            some.answer.members
        );
        there = some.answer.members;
        assert!(!some.complete);
        let verdicts = some.answer.limits.iter().map(|limit| limit.judged.verdict);
        // what is broken stays so; the members that have not run may break the other
        assert_eq!(
            verdicts.collect::<Vec<_>>(),
            [Verdict::Fail, Verdict::Undecided]
        );
        assert_eq!(directory(path, "cut").there, there);
    }
    assert!(there % 64 != 0, "a block is kept in part");
    let all = whole(path, "cut");
    assert!(all.complete);
    assert_eq!(all.answer.limits[1].judged.verdict, Verdict::Pass);
    assert_eq!(table(path, "cut"), table(path, "straight"));
    let parts = |out: &str| fs::read(path.join(out).join("members/0001.parquet")).unwrap();
    assert!(parts("cut") == parts("straight"));
}

#[test]
fn parts_computed_elsewhere_are_those_computed_here() {
    // what no member of a part has, such as an impact force before the first contact, is in none of its columns
    let folder = folder(&STUDY.replace("run.duration=20 ms", "run.duration=6 ms"));
    let path = folder.path();
    whole(path, "here");
    let away = directory(path, "away");
    let never = AtomicBool::new(false);
    for part in away.open_parts().unwrap() {
        let bytes = auxbear::report::study::part(&away.study, part, &Options::unwatched(&never));
        away.put(part, &bytes.unwrap().unwrap()).unwrap();
    }
    away.finish(&Options::unwatched(&never)).unwrap();
    assert_eq!(table(path, "away"), table(path, "here"));
    let parts = |out: &str| fs::read(path.join(out).join("members/0000.parquet")).unwrap();
    assert!(parts("away") == parts("here"));
}

#[test]
fn an_instant_that_does_not_come_is_judged_as_in_a_single_run() {
    let limit = "quantity = \"inner_race_time_to_50_percent\"";
    for (bound, verdict) in [("5 ms", Verdict::Fail), ("50 ms", Verdict::Undecided)] {
        let text = STUDY.replace(
            "quantity = \"first_impact_force\"\nmost = \"1 N\"",
            &format!("{limit}\nmost = \"{bound}\""),
        );
        let folder = folder(&text.replace("members = 130", "members = 4"));
        let done = whole(folder.path(), "out");
        let judged = &done.answer.limits[0].judged;
        assert_eq!(judged.verdict, verdict, "{bound}: {}", judged.why);
    }
}

#[test]
fn members_with_a_warning_break_its_limit() {
    let first = "quantity = \"first_impact_force\"\nmost = \"1 N\"";
    // whether the rotor bends is said by all of them
    let limits =
        "warning = \"AB1126\"\n[[limit]]\nwarning = \"AB2300\"\n[[limit]]\nseverity = \"destroys\"";
    let text = STUDY
        .replace(first, limits)
        .replace("duration=20 ms", "duration=100 ms");
    let folder = folder(&text.replace("members = 130", "members = 4"));
    let done = whole(folder.path(), "out");
    let limits = done.answer.limits.iter();
    let judged: Vec<_> = limits
        .map(|own| (own.judged.verdict, own.judged.hold))
        .collect();
    // friction starts whirl at some angles of the unbalance, and the patch has no width here
    let undecided = (Verdict::Undecided, 0);
    assert_eq!(judged, [(Verdict::Fail, 0), (Verdict::Pass, 4), undecided]);
}

#[test]
fn damaged_and_foreign_parts_are_found() {
    let folder = folder(STUDY);
    let path = folder.path();
    whole(path, "out");
    let part = |number: usize| path.join(format!("out/members/{number:04}.parquet"));
    let refused = || {
        let told =
            directory(path, "out").run(&Options::unwatched(&AtomicBool::new(false)), &|_| {});
        told.err()
            .map(|problem| problem.to_string())
            .unwrap_or_default()
    };
    let first = fs::read(part(0)).unwrap();
    let second = fs::read(part(1)).unwrap();
    fs::write(part(1), &first).unwrap();
    assert!(
        refused().contains("other members than those of this part"),
        "{}",
        refused()
    );
    for at in (4..second.len()).step_by(second.len() / 40) {
        let mut flipped = second.clone();
        flipped[at] ^= 1;
        fs::write(part(1), &flipped).unwrap();
        let told = match Directory::open(
            &path.join("out"),
            Study::new(StudyFile::read(&path.join("study.toml")).unwrap()).unwrap(),
            0,
        ) {
            Ok(open) => open
                .run(&Options::unwatched(&AtomicBool::new(false)), &|_| {})
                .err()
                .map(|problem| problem.to_string()),
            Err(problem) => Some(problem.to_string()),
        };
        match told {
            Some(told) => assert!(told.contains("AB2205"), "byte {at}: {told}"),
            // what stands in the file besides the values
            None => {
                fs::write(part(1), &second).unwrap();
                let flipped_table = table(path, "out");
                whole(path, "out");
                assert_eq!(flipped_table, table(path, "out"), "byte {at}");
            }
        }
    }
}

#[test]
fn a_sweep_of_an_inclined_shaft_has_no_verdict() {
    let text = STUDY
        .replace(
            "run.duration=20 ms",
            "run.duration=20 ms\", \"gravity.acceleration=9 m/s^2",
        )
        .replace("members = 130", "members = 4");
    let text = text.replace("most = \"1 N\"", "most = \"1 MN\"");
    let folder = folder(&text);
    let judged = whole(folder.path(), "out").answer.limits[0].judged.clone();
    assert_eq!(judged.verdict, Verdict::Undecided);
    assert!(judged.why.contains("AB1095"), "{}", judged.why);
}
