//! Guard: says whether the reference cases beside the checkout were compared; where their folder is absent they are skipped.

use crate::repository::{Outcome, Repository};
use std::path::Path;

/// Where the tests look for them.
const FOLDER: &str = "../shared/cases";

/// Counts the cases; their absence is no fault.
pub fn check(repository: &Repository) -> Outcome {
    let folder = Path::new(&repository.root).join(FOLDER);
    let said = match count(&folder) {
        0 => format!("skipped: {FOLDER} is not there, and tests that read it compare nothing"),
        count => format!("{count} files in {FOLDER}, read by tests"),
    };
    Outcome::new(said, Vec::new())
}

/// Files of cases below a folder; none where it cannot be read.
fn count(folder: &Path) -> usize {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return 0;
    };
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    paths
        .map(|path| match path.is_dir() {
            true => count(&path),
            false => usize::from(
                path.extension()
                    .is_some_and(|end| end == "toml" || end == "json"),
            ),
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cases_are_counted_in_folders_and_an_absent_folder_has_none() {
        let here = Path::new(env!("CARGO_MANIFEST_DIR"));
        // its own manifest
        assert_eq!(
            count(here),
            1 + usize::from(here.join("golden.json").exists())
        );
        assert_eq!(count(&here.join("nowhere")), 0);
    }
}
