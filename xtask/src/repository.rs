//! The files of the repository as git sees them.

use std::path::{Path, PathBuf};
use std::process::Command;

/// What one guard saw: a short count for its line, and everything that is wrong.
pub struct Outcome {
    /// What was looked at, for the line of a guard that found nothing.
    pub seen: String,
    /// One entry each, `path:line: what is wrong` where there is a place.
    pub findings: Vec<String>,
}

impl Outcome {
    /// All findings as one error, where there are any.
    pub fn result(self) -> Result<(), String> {
        match self.findings.as_slice() {
            [] => Ok(()),
            findings => Err(findings.join("\n")),
        }
    }

    /// An outcome with a text for the line and its findings.
    pub fn new(seen: impl Into<String>, findings: Vec<String>) -> Self {
        Self {
            seen: seen.into(),
            findings,
        }
    }
}

/// The checkout: its root and the files that belong to it.
pub struct Repository {
    /// The folder that holds the workspace manifest.
    pub root: PathBuf,
    /// Tracked files and new ones that git does not ignore, relative to the root, `/` between folders, sorted.
    pub files: Vec<String>,
}

impl Repository {
    /// Finds the checkout that this tool was started in.
    pub fn open() -> Result<Self, String> {
        let manifest = std::env::var("CARGO_MANIFEST_DIR")
            .unwrap_or_else(|_| env!("CARGO_MANIFEST_DIR").to_owned());
        let root = Path::new(&manifest)
            .parent()
            .ok_or_else(|| format!("{manifest} has no parent folder"))?
            .to_owned();
        let listing = Command::new("git")
            .args("ls-files -z --cached --others --exclude-standard".split(' '))
            .current_dir(&root)
            .output()
            .map_err(|error| format!("git could not be started: {error}"))?;
        if !listing.status.success() {
            return Err(format!(
                "git ls-files failed: {}",
                String::from_utf8_lossy(&listing.stderr).trim()
            ));
        }
        let mut files: Vec<String> = String::from_utf8_lossy(&listing.stdout)
            .split('\0')
            .filter(|name| !name.is_empty() && root.join(name).is_file())
            .map(str::to_owned)
            .collect();
        files.sort();
        files.dedup();
        Ok(Self { root, files })
    }

    /// The text of a file, or `None` when it is not UTF-8 or cannot be read.
    pub fn text(&self, file: &str) -> Option<String> {
        std::fs::read_to_string(self.root.join(file)).ok()
    }

    /// Writes a file.
    pub fn write(&self, file: &str, text: &str) -> Result<(), String> {
        std::fs::write(self.root.join(file), text).map_err(|error| format!("{file}: {error}"))
    }

    /// The files below a folder (written with a closing `/`) whose name ends as given.
    pub fn below<'a>(
        &'a self,
        folder: &'a str,
        ending: &'a str,
    ) -> impl Iterator<Item = &'a str> + 'a {
        self.files
            .iter()
            .map(String::as_str)
            .filter(move |file| file.starts_with(folder) && file.ends_with(ending))
    }
}

/// Whether a file was written elsewhere and is kept as it came.
pub fn is_vendored(file: &str) -> bool {
    file.split('/').any(|folder| folder == "vendor")
}
