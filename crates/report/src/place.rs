//! Where the directory of a run stands where nobody says, and what an earlier run has left there.

use super::directory::{HISTORY, REPORT, SCENARIO, SUMMARY, exists, locked, partial_of};
use super::members::MEMBERS;
use problem::{Code, Problem, open_file};
use scenario::Scenario;
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// The directory that a run gets where none is asked for: `runs/NAME`, or `runs/NAME-2` and so on where that is taken.
pub fn free_path(name: &str) -> PathBuf {
    free_path_in(Path::new(RUNS), name)
}

/// The same for a run of a scenario: that of a repetition of it that was killed or interrupted, where it comes first.
pub fn path_of_run(name: &str, scenario: &Scenario) -> PathBuf {
    let resolved = scenario.resolved.toml();
    let goes_on = |path: &PathBuf| {
        let left =
            |partial: PathBuf| has_members_of(&partial, &resolved) && locked(&partial).is_ok();
        was_interrupted(path, Some(&resolved))
            || !exists(path) && partial_of(path).is_some_and(left)
    };
    places(Path::new(RUNS), name)
        .find(|path| is_free(path) || goes_on(path))
        .unwrap_or_default()
}

/// Folder of the run directories that nobody gave another place.
pub const RUNS: &str = "runs";

/// The same in a folder of run directories.
pub fn free_path_in(runs: &Path, name: &str) -> PathBuf {
    places(runs, name)
        .find(|path| is_free(path))
        .unwrap_or_default()
}

/// Names of run directories in a folder, in the order in which they are taken.
fn places<'a>(runs: &'a Path, name: &'a str) -> impl Iterator<Item = PathBuf> + 'a {
    let others = (2..).map(move |number| runs.join(format!("{name}-{number}")));
    std::iter::once(runs.join(name)).chain(others)
}

fn is_free(path: &Path) -> bool {
    !exists(path) && !partial_of(path).is_some_and(|path| exists(&path))
}

/// Whether a directory has members of a repetition.
pub fn has_members(path: &Path) -> bool {
    let entries = fs::read_dir(path.join(MEMBERS)).into_iter().flatten();
    let mut names = entries.flatten().map(|entry| entry.file_name());
    names.any(|name| name.to_string_lossy().ends_with(".parquet"))
}

/// Whether a directory is one of a repetition of this scenario, whose files have not changed.
pub(super) fn has_members_of(path: &Path, resolved: &str) -> bool {
    let members = path.join(MEMBERS);
    let known = || fs::read_to_string(members.join(FILES)).unwrap_or_default();
    members.is_dir()
        && fs::read_to_string(path.join(SCENARIO)).is_ok_and(|there| there == resolved)
        && known() == hashes(resolved)
}

/// Members of something else stand where a repetition is to begin.
pub(super) fn of_another(partial: &Path) -> Box<Problem> {
    let found = "members of another run, which was killed or interrupted: of other values, or of other contents of a file that it reads";
    let needed =
        "the same file and values go on from them; choose another --out, or remove this one";
    Problem::at_path(Code::OutputExists, partial, found, needed)
}

/// Hash of a text.
pub(super) fn hash_of(text: &str) -> String {
    format!("{:x}", Sha256::digest(text))
}

/// Hashes of the files that members depend on, beside them.
pub(super) const FILES: &str = "files.sha256";

/// Hashes of the files that a resolved text names, as `sha256sum` writes them; nothing where it names none.
pub(super) fn hashes(resolved: &str) -> String {
    fn named(value: &toml::Value, all: &mut BTreeSet<PathBuf>) {
        match value {
            toml::Value::String(text) => {
                let path = Path::new(text);
                if path.is_absolute() && path.is_file() {
                    all.insert(path.to_path_buf());
                }
            }
            toml::Value::Array(list) => list.iter().for_each(|own| named(own, all)),
            toml::Value::Table(table) => table.values().for_each(|own| named(own, all)),
            _ => {}
        }
    }
    let mut all = BTreeSet::new();
    if let Ok(table) = toml::from_str(resolved) {
        named(&toml::Value::Table(table), &mut all);
    }
    let line = |path: PathBuf| {
        let mut hash = Sha256::new();
        let read = open_file(&path).and_then(|mut file| io::copy(&mut file, &mut hash));
        let hash = read.map_or(String::new(), |_| format!("{:x}", hash.finalize()));
        format!("{hash}  {}\n", path.display())
    };
    all.into_iter().map(line).collect()
}

/// What stands in a run directory that the run of before did not write, such as its exports: they stay as they are.
pub fn besides(directory: &Path) -> Vec<String> {
    let own = [SCENARIO, SUMMARY, HISTORY, REPORT, MEMBERS];
    let entries = fs::read_dir(directory).into_iter().flatten().flatten();
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    let mut names: Vec<String> = names.filter(|name| !own.contains(&&**name)).collect();
    names.sort();
    names
}

/// Whether a run directory is that of a repetition which the user ended; of this scenario, where one is given.
pub(super) fn was_interrupted(path: &Path, resolved: Option<&str>) -> bool {
    #[derive(serde::Deserialize)]
    struct Ended {
        stop: Reason,
    }
    #[derive(serde::Deserialize)]
    struct Reason {
        reason: String,
    }
    let ended = |text: &Vec<u8>| {
        serde_json::from_slice::<Ended>(text).is_ok_and(|own| own.stop.reason == "interrupted")
    };
    let is_of = resolved.map_or_else(
        || has_members(path),
        |resolved| has_members_of(path, resolved),
    );
    is_of && fs::read(path.join(SUMMARY)).is_ok_and(|text| ended(&text))
}
