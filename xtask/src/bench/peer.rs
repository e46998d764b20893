//! What users would write instead: scripts whose last line is one JSON object.

use super::clock::median;
use crate::toolchain::quiet;
use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// A script and what it needs.
pub struct Peer {
    /// How tables call it.
    pub name: &'static str,
    script: &'static str,
    modules: &'static str,
}

/// SciPy with NumPy.
pub const SCIPY: Peer = Peer {
    name: "SciPy LSODA, NumPy",
    script: "benchmarks/peers/scipy_lsoda.py",
    modules: "scipy",
};

/// CVODE with a compiled right-hand side.
pub const CVODE: Peer = Peer {
    name: "CVODE BDF, Numba",
    script: "benchmarks/peers/cvode_numba.py",
    modules: "numba, scipy, sksundae",
};

/// Newmark steps of a rotordynamics package.
pub const ROSS: Peer = Peer {
    name: "ROSS, Newmark",
    script: "benchmarks/peers/ross_time.py",
    modules: "ross",
};

/// The ball bearing of a multibody package.
pub const EXUDYN: Peer = Peer {
    name: "EXUDYN, generalised α",
    script: "benchmarks/peers/exudyn_bearing.py",
    modules: "exudyn",
};

impl Peer {
    /// Whether Python finds what the script needs; a line that says so where it does not.
    pub fn missing(&self) -> Option<String> {
        let import = format!("import {}", self.modules);
        let outcome = quiet(Command::new("python3").args(["-c", &import]));
        (!outcome.findings.is_empty()).then(|| {
            format!(
                "{}: not installed, python3 lacks {}. python3 -m pip install -r benchmarks/peers/requirements.txt",
                self.name, self.modules
            )
        })
    }

    /// What the script answers; of several runs the answer is the last one with the median of their seconds.
    pub fn run(&self, root: &Path, words: &[&str], runs: usize) -> Result<Value, String> {
        let mut seconds = Vec::new();
        let mut answer = Value::Null;
        for _ in 0..runs {
            let mut command = Command::new("python3");
            command.arg(self.script).args(words).current_dir(root);
            let output = command
                .output()
                .map_err(|error| format!("python3: {error}"))?;
            if !output.status.success() {
                return Err(String::from_utf8_lossy(&output.stderr).into_owned());
            }
            // packages print what they miss before
            let printed = String::from_utf8_lossy(&output.stdout);
            let last = printed.lines().last().unwrap_or_default();
            answer = serde_json::from_str(last).map_err(|error| error.to_string())?;
            seconds.push(number(&answer, "/cpu_seconds")?);
        }
        answer["cpu_seconds"] = median(seconds).into();
        Ok(answer)
    }

    /// Versions of what the script used: every entry that is a text, but for the method.
    pub fn versions(answer: &Value) -> String {
        let entries = answer.as_object().into_iter().flatten();
        let versions: Vec<String> = entries
            .filter(|(name, _)| *name != "method")
            .filter_map(|(name, value)| Some(format!("{name} {}", value.as_str()?)))
            .collect();
        versions.join(", ")
    }
}

/// The number at a JSON pointer.
pub fn number(all: &Value, pointer: &str) -> Result<f64, String> {
    let value = all.pointer(pointer).and_then(Value::as_f64);
    value.ok_or_else(|| format!("no number at {pointer}"))
}
