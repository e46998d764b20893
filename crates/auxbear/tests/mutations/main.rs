//! Files that were damaged or typed wrong in every way that a mutator finds: whatever they are, they are read or refused,
//! without a panic, without end, within a gigabyte.
//!
//! `AUXBEAR_MUTATIONS` is the number of mutations of each kind of input, `AUXBEAR_MUTATED_RUNS` that of runs of each system;
//! the long form takes 100000 and 1000. What is found is kept below the target's folder for tests, `mutations/`.

mod inputs;
mod mutator;
mod readers;
mod runs;
#[path = "../../../recording/fuzz/touch.rs"]
mod touch;
mod watch;

use std::path::PathBuf;

/// A folder of the repository.
fn repository(path: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(path)
}

/// The files in a folder with an ending, by name.
fn files(folder: &str, ending: &str) -> Vec<(PathBuf, Vec<u8>)> {
    let mut paths: Vec<PathBuf> = std::fs::read_dir(repository(folder))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|own| own == ending))
        .collect();
    paths.sort();
    let read = |path: PathBuf| {
        let bytes = std::fs::read(&path).unwrap();
        (path, bytes)
    };
    let found: Vec<_> = paths.into_iter().map(read).collect();
    assert!(!found.is_empty(), "no {ending} in {folder}");
    found
}
