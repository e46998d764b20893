//! Where the directory of a run stands where nobody says, and what an earlier run has left there.

use super::directory::{NewDirectory, SCENARIO, SUMMARY, exists, locked, partial_of};
use scenario::Scenario;
use std::fs;
use std::path::{Path, PathBuf};

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
        was_interrupted(path, &resolved) || !exists(path) && partial_of(path).is_some_and(left)
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

/// Whether a directory has members of a run of this scenario.
pub(super) fn has_members_of(path: &Path, resolved: &str) -> bool {
    NewDirectory::has_members(path)
        && fs::read_to_string(path.join(SCENARIO)).is_ok_and(|there| there == resolved)
}

/// Whether a run directory is that of a repetition of this scenario which the user ended.
pub(super) fn was_interrupted(path: &Path, resolved: &str) -> bool {
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
    has_members_of(path, resolved) && fs::read(path.join(SUMMARY)).is_ok_and(|text| ended(&text))
}
