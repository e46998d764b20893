//! Validation: published and reference results against this program.
//!
//! The cases that ship stand in `cases/` and are part of the program; a folder of the user's own is read in
//! addition. Three things are understood there: case files of the format `auxbear.case/1` ([`case`]), the files of the
//! reference implementation ([`mod@reference`]), and nothing else: any other file is "not run".
//!
//! Laws are computed here. Whole simulations are asked of a [`Simulator`].

#![forbid(unsafe_code)]

pub mod case;
mod inputs;
pub mod kinds;
pub mod report;
pub mod simulator;

mod compare;
mod drops;
mod film_kinds;
mod friction_kinds;
mod heat;
mod json;
mod levitated;
mod machine;
mod machines;
mod points;
pub mod reference;
mod rotors;
mod scenario_kind;
mod shipped;
mod simulation;
mod spatial;

pub use machine::ReferenceMachine;
pub use report::{Report, Row, Tolerance, Verdict};
pub use simulation::Simulation;
pub use simulator::{LawsOnly, Simulator};

use problem::{Code, Problem, Result};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Largest file read, bytes.
const LARGEST_FILE: u64 = 10_000_000;
/// Most files read of one folder.
const MOST_FILES: usize = 2000;
/// Deepest folder below the one given.
const DEEPEST: usize = 8;

/// Runs the shipped cases and, with a folder, every `*.toml` and `*.json` in and below it.
pub fn run(folder: Option<&Path>, simulator: &dyn Simulator) -> Result<Report> {
    // a folder that cannot be read is refused before anything is computed
    let own = folder.map(files).transpose()?.unwrap_or_default();
    let mut rows = Vec::new();
    for (name, text) in shipped::CASES {
        rows.extend(named(name, case::rows(text, simulator)));
    }
    for (name, path) in own {
        rows.extend(named(&name, of_file(&path, simulator)));
    }
    Ok(Report::new(rows))
}

fn named(case: &str, rows: Vec<Row>) -> impl Iterator<Item = Row> {
    rows.into_iter().map(move |row| Row {
        case: case.to_string(),
        ..row
    })
}

fn of_file(path: &Path, simulator: &dyn Simulator) -> Vec<Row> {
    let size = fs::metadata(path).map(|data| data.len());
    if size.is_ok_and(|size| size > LARGEST_FILE) {
        return vec![Row::damaged(format!("larger than {LARGEST_FILE} bytes"))];
    }
    let text = match fs::read(path).map(String::from_utf8) {
        Ok(Ok(text)) => text,
        Ok(Err(_)) => return vec![Row::damaged("not UTF-8 text")],
        Err(error) => return vec![Row::damaged(format!("not readable ({error})"))],
    };
    if text.trim().is_empty() {
        return vec![Row::damaged("empty")];
    }
    let is_json = path
        .extension()
        .is_some_and(|extension| extension == "json");
    if is_json {
        of_json(&text, path, simulator)
    } else {
        of_toml(&text, simulator)
    }
}

fn of_json(text: &str, path: &Path, simulator: &dyn Simulator) -> Vec<Row> {
    match serde_json::from_str(text) {
        Err(error) => vec![Row::damaged(format!("not JSON: {error}"))],
        Ok(value) => levitated::rows(&value, path)
            .or_else(|| heat::rows(&value))
            .or_else(|| spatial::rows(&value, simulator))
            .or_else(|| machines::rows(&value, path, simulator))
            .or_else(|| reference::rows(&value, simulator))
            .unwrap_or_else(|| vec![Row::not_run(why_not(&value))]),
    }
}

/// Reference files whose model this program does not have: two keys of each, and the model.
const NOT_MODELLED: [([&str; 2], &str); 2] = [
    (
        ["faults", "base_shock"],
        "faults of axes, sensors and controllers, limits of slew, base motion, re-levitation",
    ),
    (
        ["bands", "full_slip_whirl"],
        "needed friction of dry whirl over its frequency",
    ),
];

/// Why a file that no comparison knows is not run.
fn why_not(value: &Value) -> String {
    let known = NOT_MODELLED
        .iter()
        .find(|(keys, _)| keys.iter().all(|key| value.get(key).is_some()));
    match known {
        Some((_, model)) => format!("model missing: {model}"),
        None => "a JSON file of no known format".to_string(),
    }
}

fn of_toml(text: &str, simulator: &dyn Simulator) -> Vec<Row> {
    let table: toml::Table = match toml::from_str(text) {
        Err(error) => return vec![Row::damaged(format!("not TOML: {}", error.message()))],
        Ok(table) => table,
    };
    match table.get("format").and_then(toml::Value::as_str) {
        Some(case::FORMAT) => case::rows(text, simulator),
        Some(other) => vec![Row::not_run(format!(
            "format \"{other}\", known is \"{}\"",
            case::FORMAT
        ))],
        None => vec![Row::not_run(format!(
            "a TOML file without format = \"{}\"",
            case::FORMAT
        ))],
    }
}

/// Case name and path of every file to read, by name: the file's stem, with its folders where two share a stem.
fn files(folder: &Path) -> Result<BTreeMap<String, PathBuf>> {
    if !folder.exists() {
        let problem = Problem::at_path(
            Code::FileMissing,
            folder,
            "nothing there",
            "a folder of cases is needed",
        );
        return Err(problem);
    }
    if !folder.is_dir() {
        let problem = Problem::at_path(
            Code::FileUnreadable,
            folder,
            "a file",
            "a folder of cases is needed",
        );
        return Err(problem);
    }
    let mut paths = Vec::new();
    collect(folder, 0, &mut paths).map_err(|error| {
        Problem::at_path(
            Code::FileUnreadable,
            folder,
            error.to_string(),
            "a readable folder of cases that are files is needed",
        )
    })?;
    if paths.len() > MOST_FILES {
        let found = format!("{} files of cases", paths.len());
        let allowed = format!("at most {MOST_FILES} are read at once");
        return Err(Problem::at_path(Code::FileTooLarge, folder, found, allowed));
    }
    let stem = |path: &Path| {
        path.file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned()
    };
    let mut uses: BTreeMap<String, usize> = BTreeMap::new();
    for path in &paths {
        *uses.entry(stem(path)).or_default() += 1;
    }
    for (name, _) in shipped::CASES {
        *uses.entry(name.to_string()).or_default() += 1;
    }
    Ok(paths
        .into_iter()
        .map(|path| {
            let name = if uses[&stem(&path)] == 1 {
                stem(&path)
            } else {
                path.strip_prefix(folder)
                    .unwrap_or(&path)
                    .display()
                    .to_string()
            };
            (name, path)
        })
        .collect())
}

/// Files with a known ending in and below a folder. Links are not followed and pipes not read: where one would be a case, that is an
/// error, since a case that is passed over must not look well.
fn collect(folder: &Path, depth: usize, paths: &mut Vec<PathBuf>) -> std::io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let (kind, path) = (entry.file_type()?, entry.path());
        let end = path.extension();
        let is_case = end.is_some_and(|extension| extension == "toml" || extension == "json");
        if kind.is_dir() && depth < DEEPEST {
            collect(&path, depth + 1, paths)?;
        } else if kind.is_file() && is_case {
            paths.push(path);
        } else if is_case || kind.is_symlink() && path.is_dir() {
            let what = match (kind.is_symlink(), kind.is_dir()) {
                (true, _) => "a link",
                (_, true) => "a folder too deep to be read",
                _ => "no file",
            };
            let told = format!("{}, which is {what}", path.display());
            return Err(std::io::Error::other(told));
        }
        if paths.len() > MOST_FILES {
            break;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

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
        for (name, _) in shipped::CASES {
            assert!(report.cases.iter().any(|row| row.case == *name), "{name}");
        }
    }
    #[test]
    fn a_folder_is_read_with_all_below_it() {
        let folder = folder("reading");
        let good = shipped::CASES
            .iter()
            .find(|(name, _)| *name == "palmgren_low_speed")
            .unwrap()
            .1;
        fs::write(folder.join("inner/mine.toml"), good).unwrap();
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
                r#"{"faults": "", "base_shock": "", "cases": []}"#,
                "faults of axes",
            ),
            (r#"{"bands": [], "full_slip_whirl": {}}"#, "dry whirl"),
        ] {
            let row = of_json(file, Path::new("case.json"), &LawsOnly).remove(0);
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
    #[test]
    fn the_laws_meet_the_reference_files() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation/cases/reference");
        let report = run(Some(&folder), &LawsOnly).unwrap();
        assert!(report.passed(), "{}", report.to_text());
        for (case, quantities) in [("hertz", 12), ("rolling", 6 + 12)] {
            let passed = report
                .cases
                .iter()
                .filter(|row| row.case == case && row.verdict == Verdict::Pass);
            assert_eq!(passed.count(), quantities, "{case}");
        }
    }
}
