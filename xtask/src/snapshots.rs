//! Snapshots of what every shipped scenario gives, `xtask/snapshots`: a change that should move nothing leaves them as they are, and the difference
//! of one that moves something is its list of changes. `cargo xtask golden` writes them; they hold to the bit on one machine, so no check compares them.
//!
//! ```text
//!   NAME.numbers   each result: place, unit, value as the 64 bits of a double or absent; warning codes with their count; how the run ended; its work;
//!                  columns of its history with units and a hash of their values
//!   NAME.words     hashes of each text: laws, sources, ranges, warnings, resolved inputs
//!   new.words      hashes of the starting files
//! ```

use crate::repository::Repository;
use crate::{golden, scenarios, shipped};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;

const FOLDER: &str = "xtask/snapshots";

/// Keys whose texts are no words.
const CODES: [&str; 8] = [
    "unit", "code", "reason", "mark", "verdict", "quantity", "side", "method",
];
/// What differs from run to run.
const PASSING: [&str; 2] = ["wall_s", "version"];

/// FNV-1a of bytes.
fn hash(bytes: impl IntoIterator<Item = u8>) -> String {
    let mix = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    format!(
        "{:016x}",
        bytes.into_iter().fold(0xcbf2_9ce4_8422_2325, mix)
    )
}

fn bits(value: &Value) -> Option<String> {
    match value {
        Value::Null => Some("absent".to_owned()),
        Value::Bool(value) => Some(value.to_string()),
        Value::Number(number) => Some(format!("{:016x}", number.as_f64()?.to_bits())),
        _ => None,
    }
}

/// A place inside another.
fn below(place: &str, name: &str) -> String {
    format!("{place}/{name}").trim_start_matches('/').to_owned()
}

/// The lines of both snapshots of a run.
#[derive(Default)]
struct Lines {
    numbers: String,
    words: String,
}

impl Lines {
    /// What stands at a place of a summary, whose keys have their order in its text; words of an object together.
    fn add(&mut self, text: &str, place: &str, value: &Value) {
        let last = place.rsplit('/').next().unwrap_or_default();
        if PASSING.contains(&last) {
            return;
        }
        match value {
            Value::Object(map) => {
                let mut keys: Vec<&String> = map.keys().collect();
                keys.sort_by_key(|key| text.find(&format!("\"{key}\":")));
                let kept = |key: &str| ![&CODES[..], &PASSING[..]].concat().contains(&key);
                let (words, keys): (Vec<&String>, Vec<&String>) =
                    (keys.into_iter()).partition(|key| map[*key].is_string() && kept(key));
                if !words.is_empty() {
                    let bytes = words.iter().filter_map(|key| map[*key].as_str());
                    let hash = hash(bytes.flat_map(str::bytes));
                    let _ = writeln!(self.words, "{place} {hash}");
                }
                for key in keys {
                    self.add(text, &below(place, key), &map[key]);
                }
            }
            Value::Array(_) if last == "warnings" => self.warnings(value),
            Value::Array(list) => match list.iter().map(bits).collect::<Option<Vec<_>>>() {
                Some(all) => {
                    let hash = hash(all.concat().into_bytes());
                    let _ = writeln!(self.numbers, "{place} {} values {hash}", all.len());
                }
                None => {
                    for (index, value) in list.iter().enumerate() {
                        let named = ["path", "name", "key"].map(|key| value[key].as_str());
                        let named = named.into_iter().flatten().next();
                        let at = named.map_or(index.to_string(), str::to_owned);
                        self.add(text, &below(place, &at), value);
                    }
                }
            },
            Value::String(words) if CODES.contains(&last) => {
                let _ = writeln!(self.numbers, "{place} {words}");
            }
            Value::String(words) => {
                let _ = writeln!(self.words, "{place} {}", hash(words.bytes()));
            }
            other => {
                let _ = writeln!(self.numbers, "{place} {}", bits(other).unwrap_or_default());
            }
        }
    }

    fn warnings(&mut self, all: &Value) {
        let mut counts = BTreeMap::new();
        for warning in all.as_array().into_iter().flatten() {
            let code = warning["code"].as_str().unwrap_or_default();
            *counts.entry(code.to_owned()).or_insert(0) += 1;
            let text = warning["text"].as_str().unwrap_or_default();
            let _ = writeln!(self.words, "warning {code} {}", hash(text.bytes()));
        }
        for (code, count) in counts {
            let _ = writeln!(self.numbers, "warning {code} {count}");
        }
    }

    /// Columns of a history as a table of texts.
    fn columns(&mut self, table: &str) {
        let mut rows = table.lines().map(|line| line.split(','));
        let Some(head) = rows.next() else { return };
        let mut columns: Vec<(&str, String)> = head.map(|name| (name, String::new())).collect();
        for row in rows {
            for ((_, values), cell) in columns.iter_mut().zip(row) {
                values.push_str(cell);
                values.push(',');
            }
        }
        for (name, values) in columns {
            let _ = writeln!(self.numbers, "column {name} {}", hash(values.into_bytes()));
        }
    }
}

/// Runs the scenarios, writes golden values and snapshots.
pub fn write() -> Result<(), String> {
    let repository = Repository::open()?;
    let program = shipped::program(&repository).map_err(|lines| lines.join("\n"))?;
    // the same each time: resolved files have paths in it
    let folder = std::env::temp_dir().join("auxbear-golden");
    let _ = std::fs::remove_dir_all(&folder);
    // what differs from the values before is what this is called for
    scenarios::run_all(&repository, &program, &folder);
    let runs = folder.join("runs");
    let golden = golden::of_runs(&repository, &runs)?;
    of_runs(&repository, &program, &runs)?;
    let _ = std::fs::remove_dir_all(&folder);
    repository.write(golden::FILE, &golden)
}

/// Snapshots of all runs in a folder.
fn of_runs(repository: &Repository, program: &Path, runs: &Path) -> Result<(), String> {
    let folder = repository.root.join(FOLDER);
    let told = |path: &Path, error: std::io::Error| format!("{}: {error}", path.display());
    std::fs::create_dir_all(&folder).map_err(|error| told(&folder, error))?;
    let save = |name: &str, kind: &str, text: &str| {
        repository.write(&format!("{FOLDER}/{name}.{kind}"), text)
    };
    let scenarios = repository.below("scenarios/", ".toml");
    for file in scenarios {
        let name = Path::new(file).file_stem().unwrap_or_default();
        let name = name.to_string_lossy();
        let run = runs.join(&*name);
        let path = run.join("summary.json");
        let text = std::fs::read_to_string(&path).map_err(|error| told(&path, error))?;
        let summary = serde_json::from_str(&text).map_err(|error| format!("{file}: {error}"))?;
        let mut lines = Lines::default();
        lines.add(&text, "", &summary);
        if let Ok(resolved) = std::fs::read(run.join("scenario.toml")) {
            let _ = writeln!(lines.words, "resolved {}", hash(resolved));
        }
        let tables = run.join("csv");
        let export = Command::new(program)
            .arg("export")
            .arg(&run)
            .arg("--csv")
            .output();
        export.map_err(|error| format!("auxbear export: {error}"))?;
        if let Ok(history) = std::fs::read_to_string(tables.join("history.csv")) {
            lines.columns(&history);
        }
        let _ = std::fs::remove_dir_all(&tables);
        let column = "\ncolumn ";
        let before = repository.text(&format!("{FOLDER}/{name}.numbers"));
        let had = before.is_some_and(|text| text.contains(column));
        if (had || run.join("history.parquet").exists()) && !lines.numbers.contains(column) {
            return Err(format!(
                "{file}: its run has no columns of a history; is the disk full?"
            ));
        }
        save(&name, "numbers", &lines.numbers)?;
        save(&name, "words", &lines.words)?;
    }
    save("new", "words", &starting_files(program)?)
}

/// Hashes of the starting files of each kind that `auxbear new` knows.
fn starting_files(program: &Path) -> Result<String, String> {
    let run = |words: &[&str]| {
        let output = Command::new(program).args(words).output();
        output.map_err(|error| format!("auxbear {}: {error}", words.join(" ")))
    };
    let help = run(&["new", "--help"])?.stdout;
    let help = String::from_utf8_lossy(&help);
    let kinds = help.lines().find_map(|line| line.split_once("describe: "));
    let mut lines = String::new();
    for kind in kinds.map_or("", |(_, kinds)| kinds).split(", ") {
        let _ = writeln!(lines, "{kind} {}", hash(run(&["new", kind.trim()])?.stdout));
    }
    Ok(lines)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_snapshot_sees_every_bit_and_tells_numbers_from_words() {
        let of = |value: f64, law: &str| {
            let summary = json!({ "quantities": { "force": { "value": value, "unit": "N", "law": law } },
                "warnings": [{ "code": "AB1", "text": "one" }], "work": { "steps": 3, "wall_s": 0.1 } });
            let mut lines = Lines::default();
            lines.add(&summary.to_string(), "", &summary);
            lines.columns("time [s],x [m]\n0,1\n1,2\n");
            lines
        };
        let (one, other) = (of(1.0, "F = m a"), of(1.0 + f64::EPSILON, "F = m b"));
        assert!(one.numbers != other.numbers && one.words != other.words);
        assert!(
            one.numbers
                .contains("quantities/force/value 3ff0000000000000\n")
        );
        assert!(one.numbers.contains("quantities/force/unit N\n"));
        assert!(one.numbers.contains("warning AB1 1\n") && one.numbers.contains("column x [m] "));
        assert!(!one.numbers.contains("wall_s"));
        assert_eq!(one.numbers, of(1.0, "F = m b").numbers);
    }
}
