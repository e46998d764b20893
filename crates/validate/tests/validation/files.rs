//! What is read of a folder of cases.

use crate::{shipped, shipped_text};
use problem::Code;
use serde_json::json;
use std::fs;
use std::path::{Path, PathBuf};
use validate::{LawsOnly, Verdict, compared, run};

fn folder(name: &str) -> PathBuf {
    let folder =
        std::env::temp_dir().join(format!("auxbear-validate-{}-{name}", std::process::id()));
    fs::create_dir_all(folder.join("inner")).unwrap();
    folder
}

#[test]
fn every_shipped_law_passes() {
    let report = run(None, &LawsOnly).unwrap();
    assert!(report.passed(), "{}", report.to_text());
    // all that is not run waits for a simulation
    let waits = report
        .cases
        .iter()
        .filter(|row| row.verdict == Verdict::NotRun);
    assert!(waits.clone().all(|row| row.why == "needs a simulation"));
    assert_eq!(waits.count(), 20);
    let mut cases: Vec<_> = report.cases.iter().map(|row| &row.case).collect();
    cases.dedup();
    let mut shipped = shipped();
    shipped.sort();
    assert_eq!(cases, shipped.iter().collect::<Vec<_>>());
}
#[test]
fn a_folder_is_read_with_all_below_it() {
    let folder = folder("reading");
    let good = shipped_text("palmgren_low_speed");
    fs::write(folder.join("inner/mine.toml"), &good).unwrap();
    fs::write(
        folder.join("free_fall.toml"),
        good.replace("16 N mm", "17 N mm"),
    )
    .unwrap();
    fs::write(folder.join("later.toml"), good.replace("case/1", "case/9")).unwrap();
    fs::write(folder.join("context.toml"), "a = 1").unwrap();
    fs::write(folder.join("broken.toml"), "a = ").unwrap();
    fs::write(folder.join("list.json"), "[1, 2]").unwrap();
    fs::write(folder.join("broken.json"), "{").unwrap();
    fs::write(folder.join("bytes.toml"), [0xff, 0xfe]).unwrap();
    fs::write(folder.join("empty.toml"), " \n").unwrap();
    fs::write(folder.join("notes.txt"), "not read").unwrap();
    let report = run(Some(&folder), &LawsOnly).unwrap();
    fs::remove_dir_all(&folder).unwrap();
    let find = |case: &str| {
        let row = report.cases.iter().find(|row| row.case == case);
        row.unwrap_or_else(|| panic!("no row of {case}"))
    };
    assert_eq!(find("mine").verdict, Verdict::Pass);
    // shares its stem with a shipped case
    assert_eq!(find("free_fall.toml").verdict, Verdict::Fail);
    for (case, why) in [
        ("later", "auxbear.case/9"),
        ("context", "without format"),
        ("broken.toml", "not TOML"),
        ("broken.json", "not JSON"),
        ("list", "no known format"),
        ("bytes", "not UTF-8"),
        ("empty", "empty"),
    ] {
        assert_eq!(find(case).verdict, Verdict::NotRun, "{case}");
        assert!(find(case).why.contains(why), "{case}: {}", find(case).why);
    }
    assert!(report.cases.iter().all(|row| row.case != "notes"));
    // of another format is no damage
    let damaged: Vec<String> = report.problems().map(|problem| problem.file).collect();
    assert_eq!(damaged, ["broken.json", "broken.toml", "bytes", "empty"]);
}
#[cfg(unix)]
#[test]
fn a_case_that_is_a_link_is_not_passed_over() {
    let folder = folder("links");
    fs::write(folder.join("inner/mine.txt"), "a = 1").unwrap();
    let link = |name: &str, to: &str| {
        std::os::unix::fs::symlink(folder.join(to), folder.join(name)).unwrap();
    };
    link("notes", "inner/mine.txt");
    assert!(run(Some(&folder), &LawsOnly).is_ok());
    link("mine.toml", "inner/mine.txt");
    let told = run(Some(&folder), &LawsOnly).unwrap_err().to_string();
    assert!(told.contains("mine.toml, which is a link"), "{told}");
    fs::remove_file(folder.join("mine.toml")).unwrap();
    link("more", "inner");
    let told = run(Some(&folder), &LawsOnly).unwrap_err().to_string();
    fs::remove_dir_all(&folder).unwrap();
    assert!(told.contains("more, which is a link"), "{told}");
}
#[test]
fn a_file_without_its_model_names_it() {
    for (file, model) in [
        (
            json!({"faults": "", "base_shock": "", "cases": []}),
            "faults of axes",
        ),
        (json!({"bands": [], "full_slip_whirl": {}}), "dry whirl"),
    ] {
        let row = compared(&file, Path::new("case.json"), &LawsOnly).remove(0);
        assert_eq!((row.verdict, row.damaged), (Verdict::NotRun, false));
        assert!(row.why.contains(model), "{}", row.why);
    }
}
#[test]
fn no_folder_is_one_message() {
    let nowhere = run(Some(Path::new("/nowhere/cases")), &LawsOnly).unwrap_err();
    assert_eq!(nowhere.code, Code::FileMissing);
    let file = run(Some(Path::new(file!())), &LawsOnly);
    assert!(file.is_err());
}
