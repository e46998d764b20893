//! A folder of its own for each test, and the command run in it.

use auxbear::report::directory;
use auxbear::report::page::PageRun;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder with `drop.toml`, the starting file of the program itself.
pub struct Place(tempfile::TempDir);

impl Place {
    pub fn new() -> Place {
        let place = Place(tempfile::tempdir().unwrap());
        let text = auxbear::scenario::template("drop").unwrap();
        fs::write(place.path("drop.toml"), text).unwrap();
        place
    }

    pub fn folder(&self) -> &Path {
        self.0.path()
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder().join(name)
    }

    pub fn command(&self, words: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_auxbear"));
        command.args(words).current_dir(self.folder());
        command
    }

    pub fn call(&self, words: &[&str]) -> Called {
        Called::of(self.command(words).output().unwrap())
    }

    /// Runs `drop.toml` for 12 ms, past the first contact, with more words.
    pub fn short_run(&self, words: &[&str]) -> Called {
        let mut all = vec!["run", "drop.toml", "--set", "run.duration=12 ms"];
        all.extend(words);
        self.call(&all)
    }

    /// The names in the folder, sorted, without `drop.toml`.
    pub fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(self.folder())
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .filter(|name| name != "drop.toml")
            .collect();
        names.sort();
        names
    }

    pub fn summary(&self, directory: &str) -> Value {
        let text = fs::read_to_string(self.path(directory).join("summary.json")).unwrap();
        serde_json::from_str(&text).unwrap()
    }

    pub fn read(&self, directory: &str) -> PageRun {
        directory::read(&self.path(directory)).unwrap()
    }

    /// Every value of the history as its bits.
    pub fn history_bits(&self, directory: &str) -> Vec<(String, Vec<u64>)> {
        let bits = |values: Vec<f64>| values.into_iter().map(f64::to_bits).collect();
        self.read(directory)
            .columns
            .into_iter()
            .map(|column| (column.name, bits(column.values)))
            .collect()
    }
}

/// What a call printed and how it ended.
#[derive(Debug)]
pub struct Called {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

impl Called {
    pub fn of(output: Output) -> Called {
        Called {
            code: output.status.code(),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        }
    }

    /// Fails unless the call ended well.
    #[track_caller]
    pub fn done(self) -> Called {
        assert_eq!(self.code, Some(0), "{self:?}");
        self
    }

    /// Fails unless the call was refused as wrong input with one line that holds these parts.
    #[track_caller]
    pub fn refused(self, parts: &[&str]) {
        assert_eq!(self.code, Some(2), "{self:?}");
        assert_eq!(self.out, "");
        assert_eq!(self.err.lines().count(), 1, "{}", self.err);
        for part in parts {
            assert!(self.err.contains(part), "{part} in {}", self.err);
        }
    }
}
