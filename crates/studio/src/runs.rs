//! The runs of a folder as a table: inputs that differ, first results, limits, date, and whether the input has changed since.

use crate::folder::{Folder, changed, stamp};
use crate::jobs::run_name;
use auxbear::report::directory::{page_run, read};
use auxbear::report::page;
use auxbear::study::Study;
use auxbear::{BuiltIn, Scenario, StudyFile};
use indexmap::IndexMap;
use serde::Deserialize;
use serde_json::{Map, Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::{Mutex, PoisonError};
use std::{fs, io};

/// Most inputs that a table has as columns.
const MOST_INPUTS: usize = 12;

/// What was read of runs, by their directory and its last change.
#[derive(Default)]
pub struct Runs {
    read: Mutex<BTreeMap<String, (u128, Value)>>,
    /// Values that files give now, by name and system of a run, and last change.
    files: Mutex<BTreeMap<String, (u128, Option<Now>)>>,
    /// What studies ask now with their limits named, by name and what their files say.
    studies: Mutex<BTreeMap<String, (String, Option<String>)>>,
}

/// Paths with their values as written.
type InputTexts = BTreeMap<String, String>;

/// What a file gives now: its inputs, and its resolved text.
#[derive(Clone)]
struct Now {
    inputs: InputTexts,
    text: String,
}

/// What lists begin with that stand behind the inputs of a resolved file.
const LISTS: [&str; 3] = ["[vary]", "[[limit]]", "[[measured]]"];

impl Runs {
    /// Every run and study of the folder, the last first, with the inputs in which they differ.
    pub fn table(&self, folder: &Folder) -> Value {
        let files: BTreeMap<String, String> = folder
            .files()
            .into_iter()
            .map(|file| (run_name(&file.name), file.name))
            .collect();
        let mut rows: Vec<Value> = Vec::new();
        for (name, path) in directories(folder) {
            let summary = path.join("summary.json");
            let at = stamp(&summary);
            let mut cache = self.read.lock().unwrap_or_else(PoisonError::into_inner);
            let known = cache
                .get(&name)
                .filter(|(then, _)| *then == at)
                .map(|(_, row)| row.clone());
            let mut row = match known {
                Some(row) => row,
                None => {
                    let row = row_of(&path, &summary)
                        .unwrap_or_else(|error| json!({ "broken": error.to_string() }));
                    cache.insert(name.clone(), (at, row.clone()));
                    row
                }
            };
            drop(cache);
            row["directory"] = json!(name);
            row["date"] = json!(changed(&summary));
            if let Some(file) = files.get(stem(&name)) {
                row["file"] = json!(file);
                row["differs"] = match row["study"] == true {
                    true => json!(self.differences_of_study(folder, file, &path)),
                    false => json!(self.differences(folder, file, &row, &path)),
                };
            }
            rows.push(row);
        }
        rows.sort_by_key(|row| std::cmp::Reverse(row["date"].as_u64()));
        let mut differing = differing(&rows);
        let more = differing.len().saturating_sub(MOST_INPUTS);
        differing.truncate(MOST_INPUTS);
        for row in &mut rows {
            // the table shows those alone
            let inputs = row["inputs"].take();
            let own = inputs.as_object().map(|inputs| {
                let own = inputs.iter().filter(|(path, _)| differing.contains(*path));
                own.map(|(path, value)| (path.clone(), value.clone()))
                    .collect::<Map<_, _>>()
            });
            row["inputs"] = json!(own);
        }
        json!({ "rows": rows, "inputs": differing, "more": more })
    }

    /// In which inputs a file differs now from what a run was computed with: path, then, now; where in none, the first line of its limits
    /// and measured channels that does. None where it cannot be read now.
    fn differences(
        &self,
        folder: &Folder,
        file: &str,
        row: &Value,
        directory: &Path,
    ) -> Option<Vec<[String; 3]>> {
        let path = folder.root().join(file);
        let at = stamp(&path);
        let system = row["system"].as_str().unwrap_or_default();
        let name = format!("{file} {system}");
        let mut cache = self.files.lock().unwrap_or_else(PoisonError::into_inner);
        let known = cache.get(&name).filter(|(then, _)| *then == at);
        let now = match known {
            Some((_, now)) => now.clone(),
            None => {
                let now = given(&path, system);
                cache.insert(name, (at, now.clone()));
                now
            }
        }?;
        let then = row["inputs"].as_object()?;
        let missing = || "not given".to_string();
        let before = |path: &String| then.get(path).and_then(Value::as_str);
        let paths: BTreeSet<&String> = now.inputs.keys().chain(then.keys()).collect();
        let changed = paths.into_iter().filter_map(|path| {
            let (before, now) = (before(path), now.inputs.get(path));
            (before != now.map(String::as_str)).then(|| {
                let [before, now] = [before.map(str::to_string), now.cloned()];
                [
                    path.clone(),
                    before.unwrap_or_else(missing),
                    now.unwrap_or_else(missing),
                ]
            })
        });
        let mut changed: Vec<[String; 3]> = changed.collect();
        let lines = |text: &str| -> Vec<String> {
            let lines = text.lines().filter(|line| !line.is_empty());
            let lists = lines.skip_while(|line| !LISTS.contains(line));
            lists.map(str::to_string).collect()
        };
        if changed.is_empty()
            && let Ok(text) = fs::read_to_string(directory.join("scenario.toml"))
        {
            changed.extend(first_apart(
                "limits or measured channels",
                &lines(&text),
                &lines(&now.text),
            ));
        }
        Some(changed)
    }

    /// Which of its two files have changed since a study was computed; none where they cannot be read now.
    fn differences_of_study(
        &self,
        folder: &Folder,
        file: &str,
        directory: &Path,
    ) -> Option<Vec<[String; 3]>> {
        let now = StudyFile::read(&folder.root().join(file)).ok()?;
        let scenario = now.scenario.resolved.toml();
        let asked = now.toml();
        let said = format!("{asked}{scenario}");
        let mut cache = self.studies.lock().unwrap_or_else(PoisonError::into_inner);
        let known = cache.get(file).filter(|(then, _)| *then == said);
        let named = match known {
            Some((_, named)) => named.clone(),
            None => {
                // a run has its limits by the names of results
                let named = Study::new(now).ok().map(|study| study.file.toml());
                cache.insert(file.to_string(), (said, named.clone()));
                named
            }
        };
        // members that were added are no other study, and the head is the version
        let compared = |text: &str| -> Vec<String> {
            let lines = text
                .lines()
                .filter(|line| !line.starts_with("added = ") && !line.starts_with('#'));
            lines.map(str::to_string).collect()
        };
        let files = [
            ("study.toml", named.unwrap_or(asked)),
            ("scenario.toml", scenario),
        ];
        let changed = files.into_iter().filter_map(|(name, now)| {
            let then = compared(&fs::read_to_string(directory.join(name)).ok()?);
            first_apart(name.trim_end_matches(".toml"), &then, &compared(&now))
        });
        Some(changed.collect())
    }
}

/// The first line in which two texts differ, under a name.
fn first_apart(name: &str, then: &[String], now: &[String]) -> Option<[String; 3]> {
    let at = then.iter().zip(now).position(|(then, now)| then != now);
    let at = at.or((then.len() != now.len()).then_some(then.len().min(now.len())))?;
    let line = |lines: &[String]| lines.get(at).cloned().unwrap_or_default();
    Some([name.to_string(), line(then), line(now)])
}

/// What the file of a scenario gives now, as the summary of a run of a system says it: the analysis of a machine's rotor is one of its own.
fn given(path: &Path, system: &str) -> Option<Now> {
    let mut scenario = Scenario::read(path, &[], &BuiltIn).ok()?;
    if system != scenario.system.name().word()
        && let Some(alone) = scenario.rotor_alone()
    {
        scenario = alone.ok()?;
    }
    let nothing = auxbear::Outcome {
        system: scenario.system.name().word(),
        pictures: vec![crate::check::no_picture()],
        ..auxbear::Outcome::default()
    };
    let run = page_run("", &scenario, &nothing).ok()?;
    let summary: Value = serde_json::from_str(&run.summary_json).ok()?;
    Some(Now {
        inputs: inputs_of(&summary),
        text: scenario.resolved.toml(),
    })
}

/// Inputs that a summary names, but for those that change no result or follow from others.
fn inputs_of(summary: &Value) -> InputTexts {
    let inputs = summary["inputs"].as_array().into_iter().flatten();
    let inputs = inputs.filter(|input| input["mark"] != "derived");
    let pair = |input: &Value| {
        Some((
            input["path"].as_str()?.to_string(),
            input["value"].as_str()?.to_string(),
        ))
    };
    let words = ["format", "title", "description"];
    inputs
        .filter_map(pair)
        .filter(|(path, _)| !words.contains(&path.as_str()))
        .collect()
}

/// Name of a run directory without the number of a repetition.
fn stem(directory: &str) -> &str {
    let name = directory.rsplit('/').next().unwrap_or(directory);
    match name.rsplit_once('-') {
        Some((stem, number)) if number.parse::<u32>().is_ok() => stem,
        _ => name,
    }
}

/// Directories of finished runs: those below `runs`, and others two steps below the folder.
fn directories(folder: &Folder) -> Vec<(String, std::path::PathBuf)> {
    let mut found = Vec::new();
    let mut look = vec![(String::new(), folder.root().to_path_buf())];
    while let Some((name, path)) = look.pop() {
        let entries = fs::read_dir(&path).into_iter().flatten().flatten();
        for entry in entries {
            let own = entry.file_name().to_string_lossy().into_owned();
            let below = if name.is_empty() {
                own.clone()
            } else {
                format!("{name}/{own}")
            };
            let path = entry.path();
            let unfinished = own.ends_with(".partial") || own.starts_with('.');
            if unfinished || !path.is_dir() || folder.path(&below).is_err() {
                continue;
            }
            if path.join("summary.json").is_file() {
                found.push((below, path));
            } else if below.matches('/').count() == 0 {
                look.push((below, path));
            }
        }
    }
    found
}

/// What the table has of a run.
fn row_of(path: &Path, summary: &Path) -> io::Result<Value> {
    let text = fs::read_to_string(summary)?;
    let summary: Value = serde_json::from_str(&text)?;
    let study = path.join("study.toml").exists();
    let quantities = serde_json::from_str::<Ordered>(&text)?.quantities;
    let headline = |(name, quantity): (&String, &Value)| {
        let words = quantity["shown"]["headline"].as_str()?;
        let short = name.rsplit('.').next().unwrap_or(name);
        Some(
            json!({ "name": name, "short": short.replace('_', " "), "words": words, "value": quantity["value"], "unit": quantity["unit"] }),
        )
    };
    let results: Vec<Value> = quantities.iter().filter_map(headline).collect();
    // a qualification judges its cases, each by all limits
    let cases = summary["design"] == "qualification";
    let judged = if cases { "ranking" } else { "limits" };
    let verdict = |word: &str| {
        let judged = summary[judged].as_array().into_iter().flatten();
        judged.filter(|own| own["verdict"] == word).count()
    };
    let inputs = inputs_of(&summary);
    let shown = |name: &str| path.join(name).is_file();
    Ok(json!({
        "title": summary["title"],
        "system": if cases { json!("qualification") } else if study { json!("study") } else { summary["system"].clone() },
        "complete": summary["complete"],
        "stop": summary["stop"]["text"],
        "results": results,
        "limits": { "of": if cases { "cases" } else { "limits" }, "pass": verdict("pass"), "fail": verdict("fail"), "open": verdict("undecided") },
        "warnings": summary["warnings"].as_array().map_or(0, Vec::len),
        "version": summary["version"],
        "document": shown("document.html"),
        "study": study,
        "inputs": inputs,
    }))
}

/// Results of a summary in the order of the report.
#[derive(Deserialize)]
struct Ordered {
    quantities: IndexMap<String, Value>,
}

/// Inputs in which runs of one system differ.
fn differing(rows: &[Value]) -> Vec<String> {
    let mut values: BTreeMap<(&str, &str), (usize, BTreeSet<&str>)> = BTreeMap::new();
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for row in rows {
        let system = row["system"].as_str().unwrap_or_default();
        *counts.entry(system).or_default() += 1;
        for (path, value) in row["inputs"].as_object().into_iter().flatten() {
            let own = values.entry((system, path)).or_default();
            own.0 += 1;
            own.1.insert(value.as_str().unwrap_or_default());
        }
    }
    let differ = values
        .iter()
        .filter(|((system, _), (count, own))| own.len() > 1 || *count < counts[system]);
    let mut differ: Vec<String> = differ.map(|((_, path), _)| path.to_string()).collect();
    // by the steps of their paths: what is of the whole machine before what is of one of its parts
    differ.sort_by_key(|path| (path.matches('.').count(), path.clone()));
    differ.dedup();
    differ
}

/// The page of runs side by side.
///
/// # Errors
/// Directories that are no runs.
pub fn compared(folder: &Folder, names: &[String]) -> Result<String, String> {
    let run = |name: &String| read(&folder.path(name)?).map_err(|problem| problem.to_string());
    let runs = names.iter().map(run).collect::<Result<Vec<_>, _>>()?;
    Ok(page::html(&runs))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_repetition_belongs_to_the_file_of_the_first() {
        for (directory, name) in [
            ("runs/drop", "drop"),
            ("runs/drop-12", "drop"),
            ("runs/my-drop", "my-drop"),
            ("runs/old-drop-2", "old-drop"),
        ] {
            assert_eq!(stem(directory), name);
        }
    }

    /// What a machine has in lists makes its runs stale as well: unbalance, magnets, events.
    #[test]
    fn inputs_of_a_machine_are_those_of_its_parts_too() {
        let place = tempfile::tempdir().unwrap();
        let path = place.path().join("machine.toml");
        let text = include_str!("../../../scenarios/machine_axis_lost.toml");
        fs::write(&path, text).unwrap();
        let inputs = given(&path, "machine").unwrap().inputs;
        for (name, value) in [
            ("rotor.unbalance.wheel.amount", "10 g mm"),
            (
                "levitation.magnet.drive_end.position_stiffness",
                "1.6e5 N/m",
            ),
            ("event.braking.torque", "2 N m"),
            ("rotor.speed", "6000 rpm"),
        ] {
            assert_eq!(inputs.get(name).map(String::as_str), Some(value), "{name}");
        }
        assert!(inputs.keys().any(|name| name.ends_with("proportional")));
        assert!(inputs.keys().any(|name| name.ends_with("outer_diameter")));
    }

    #[test]
    fn only_inputs_that_differ_within_a_system_are_columns() {
        let row = |system: &str, a: &str, b: &str| json!({ "system": system, "inputs": { "a": a, "b": b } });
        let rows = [
            row("drop", "1", "2"),
            row("drop", "1", "3"),
            row("rotor", "9", "9"),
        ];
        assert_eq!(differing(&rows).into_iter().collect::<Vec<_>>(), ["b"]);
    }
}
