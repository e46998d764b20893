//! Flexible rotors on two bearings, ball by ball: what a simulated second of a drop costs, alone and in lanes.

use super::clock::median;
use super::page::three;
use super::program::Task;
use super::{Bench, quantity};

const MACHINES: [(&str, &str); 3] = [
    (
        "rig, 52 elements, 61807 and 6007",
        "scenarios/amb_rig_drop.toml",
    ),
    ("compressor, two 6017", "scenarios/machine_compressor.toml"),
    ("expander, 6009 and 6010", "scenarios/machine_expander.toml"),
];
/// A second of each drop: the fall, the impacts, and rolling.
const SECONDS: f64 = 1.0;
/// Machines of a run in lanes: all lanes of the widest vector unit, once.
const MEMBERS: usize = 8;
/// Runs of each, as they take seconds.
const RUNS: usize = 3;

impl Bench {
    /// Machines of all sizes at both accuracies.
    pub(super) fn machines(&mut self) -> Result<(), String> {
        self.page
            .heading("Flexible rotors on two bearings, ball by ball");
        self.page.line(&format!(
            "The first {SECONDS} s of each drop, medians of {RUNS} runs; in lanes {MEMBERS} machines at once, per machine."
        ));
        self.page.line("");
        self.page.table([
            "machine, accuracy",
            "coordinates",
            "CPU s a simulated second, alone",
            "in lanes",
            "alone over lanes",
            "energy residual, alone",
            "in lanes",
        ]);
        for (name, scenario) in MACHINES {
            for accuracy in ["design", "screening"] {
                let settings = [
                    format!("run.duration={SECONDS} s"),
                    format!("run.accuracy={accuracy}"),
                ];
                let mut found = Vec::new();
                for count in [1, MEMBERS] {
                    let settings = &settings;
                    let task = Task {
                        scenario,
                        settings,
                        count,
                    };
                    let runs = (0..RUNS).map(|_| self.program.block(task, 1));
                    let seconds = median(runs.collect::<Result<_, _>>()?);
                    let summary = self.program.summary()?;
                    found.push((
                        seconds / (SECONDS * count as f64),
                        quantity(&summary, "energy_residual")?,
                        quantity(&summary, "coordinates")?,
                    ));
                }
                let [(alone, left, coordinates), (lanes, left_in_lanes, _)] = found[..] else {
                    continue;
                };
                self.page.row(&[
                    format!("{name}, {accuracy}"),
                    coordinates.to_string(),
                    three(alone),
                    three(lanes),
                    three(alone / lanes),
                    format!("{left:.0e}"),
                    format!("{left_in_lanes:.0e}"),
                ]);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_machines_ship() {
        for (_, scenario) in MACHINES {
            let path = format!("{}/../{scenario}", env!("CARGO_MANIFEST_DIR"));
            let text = std::fs::read_to_string(path).unwrap();
            assert!(text.contains("system = \"machine\""), "{scenario}");
        }
    }
}
