//! A command that is measured: its runs, what they cost, and what they counted.

use super::clock::{median, timed};
use crate::repository::Repository;
use crate::toolchain::{cargo, quiet};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicU32, Ordering};

/// CPU time of children comes in steps of 10 ms: a block of runs this long, s, makes that one percent.
const BLOCK: f64 = 1.0;
const BLOCKS: usize = 5;

/// A command, where it runs, and the folder that its results are written to and removed from.
pub struct Program {
    root: PathBuf,
    path: PathBuf,
    out: PathBuf,
}

/// What is run: a scenario, what is set in it, and the number of machines.
#[derive(Clone, Copy)]
pub struct Task<'a> {
    pub scenario: &'a str,
    pub settings: &'a [String],
    pub count: usize,
}

/// The command given, or the release build.
pub fn given_or_built(repository: &Repository, program: Option<&str>) -> Result<PathBuf, String> {
    match program {
        Some(path) => std::path::absolute(path).map_err(|error| format!("{path}: {error}")),
        None => build(repository),
    }
}

/// The release build of the command; it lies beside the build of this tool.
pub fn build(repository: &Repository) -> Result<PathBuf, String> {
    let outcome = quiet(cargo(repository).args(["build", "--quiet", "--release", "--locked"]));
    let program = target()?.join("release").join(executable());
    if outcome.findings.is_empty() && program.is_file() {
        Ok(program)
    } else {
        let findings = outcome.findings.join("\n");
        Err(format!("no program was built\n{findings}"))
    }
}

/// The folder of the builds that this tool came from.
pub fn target() -> Result<PathBuf, String> {
    let own = std::env::current_exe().map_err(|error| error.to_string())?;
    let folder = own.ancestors().nth(2).map(Path::to_owned);
    folder.ok_or_else(|| format!("{} lies in no folder of builds", own.display()))
}

/// The file name of the command.
pub fn executable() -> String {
    format!("auxbear{}", std::env::consts::EXE_SUFFIX)
}

impl Program {
    /// A command that runs in a folder.
    pub fn new(root: &Path, path: PathBuf) -> Self {
        // two commands may be measured in turns
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let folder = format!("auxbear-bench-{}-{number}", std::process::id());
        Program {
            root: root.to_owned(),
            path,
            out: std::env::temp_dir().join(folder),
        }
    }
    /// Where the command is.
    pub fn path(&self) -> &Path {
        &self.path
    }
    /// CPU seconds of one machine, the whole process with its files: the median of several blocks of runs.
    pub fn cost(&self, task: Task) -> Result<f64, String> {
        let runs = runs_in_a_block(self.block(task, 1)?);
        let blocks: Result<Vec<f64>, String> =
            (0..BLOCKS).map(|_| self.block(task, runs)).collect();
        Ok(median(blocks?) / (runs * task.count) as f64)
    }
    /// CPU seconds of so many runs.
    pub fn block(&self, task: Task, runs: usize) -> Result<f64, String> {
        timed(|| (0..runs).try_for_each(|_| self.simulate(task)))
    }
    /// One run.
    pub fn simulate(&self, task: Task) -> Result<(), String> {
        let mut command = Command::new(&self.path);
        self.arguments(&mut command, task);
        quiet(&mut command).result()
    }
    /// The words of one run, for this command or one that starts it.
    pub fn arguments(&self, command: &mut Command, task: Task) {
        // absent before the first run; the command never writes over a folder
        let _ = std::fs::remove_dir_all(&self.out);
        command.current_dir(&self.root);
        let words = ["run", task.scenario, "--quiet", "--threads", "1", "--out"];
        command.args(words).arg(&self.out);
        if task.count > 1 {
            command.args(["--repeat", &task.count.to_string()]);
            command.args(["--set", "repeat.unbalance_angle=as given"]);
        }
        for setting in task.settings {
            command.args(["--set", setting]);
        }
    }
    /// The summary of the last run.
    pub fn summary(&self) -> Result<Value, String> {
        let text = std::fs::read_to_string(self.out.join("summary.json"));
        let text = text.map_err(|error| format!("summary.json: {error}"))?;
        serde_json::from_str(&text).map_err(|error| error.to_string())
    }
    /// Right-hand sides of the last run.
    pub fn rate_calls(&self) -> Result<f64, String> {
        let calls = self.summary()?["work"]["rate_calls"].as_f64();
        calls.ok_or_else(|| "no right-hand sides were counted".to_owned())
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.out);
    }
}

/// How many runs of so many seconds make a block.
pub fn runs_in_a_block(seconds: f64) -> usize {
    (BLOCK / seconds.max(0.01)).ceil() as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_is_long_enough_for_a_clock_of_ten_milliseconds() {
        assert_eq!(runs_in_a_block(0.0), 100);
        assert_eq!(runs_in_a_block(0.3), 4);
        assert_eq!(runs_in_a_block(2.0), 1);
    }
}
