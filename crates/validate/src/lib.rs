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
        Ok(value) => compared(&value, path, simulator),
    }
}

/// The rows of a reference file whose text is read. What it names is read beside its path.
pub fn compared(value: &Value, path: &Path, simulator: &dyn Simulator) -> Vec<Row> {
    levitated::rows(value, path)
        .or_else(|| heat::rows(value))
        .or_else(|| spatial::rows(value, simulator))
        .or_else(|| machines::rows(value, path, simulator))
        .or_else(|| reference::rows(value, simulator))
        .unwrap_or_else(|| vec![Row::not_run(why_not(value))])
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
