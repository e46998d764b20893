//! A flexible rotor on linear supports beside a rotordynamics package, and one bearing beside a multibody package.

use super::page::three;
use super::peer::{EXUDYN, Peer, ROSS, number};
use super::program::Task;
use super::{Bench, LANE_RUNS, PEER_RUNS, quantity};
use serde_json::Value;

/// The rotor of the linear analysis, and the first words of its tables that change.
const ROTOR: &str = "scenarios/rotor_52_elements.toml";
const SUPPORT: &str = "[[rotor.support]]\n";
/// What makes a time run of it: supports that stay, no weight, rings that the rotor does not reach.
const STAYS: &str = "[[rotor.support]]\nafter_release = \"stays\"\n";
const RUN: &str = r#"
[gravity]
acceleration = "0 m/s^2"
[contact]
bore_diameter = "36 mm"
radial_air_clearance = "0.5 mm"
friction_coefficient = 0.15
[mount]
stiffness = "2e7 N/m"
damping = "2000 N s/m"
moving_mass = "0.15 kg"
[bearing]
fidelity = "bushing"
[[auxiliary_bearing]]
name = "a"
[auxiliary_bearing.contact]
node = "auxiliary_a"
[[auxiliary_bearing]]
name = "b"
[auxiliary_bearing.contact]
node = "auxiliary_b"
[run]
duration = "0.3 s"
"#;
/// Words of the rotordynamics package: how the row is called, time step, s, and modes, 0 for the whole model.
const STEPS: [(&str, &str, &str); 4] = [
    ("whole, 318 degrees of freedom, 0.1 ms", "1e-4", "0"),
    ("24 modes, 0.1 ms", "1e-4", "24"),
    ("24 modes, 0.02 ms", "2e-5", "24"),
    ("24 modes, 0.01 ms", "1e-5", "24"),
];
/// The same for both sides, s.
const SECONDS: f64 = 0.3;

const BEARING: &str = "scenarios/spin_up_6010.toml";
/// Tolerances of the program, steps of the other, s.
const TOLERANCES: [&str; 3] = ["1e-4", "1e-5", "1e-6"];
const BEARING_STEPS: [&str; 3] = ["1e-5", "5e-6", "1e-6"];

impl Bench {
    /// The 52-element rotor whirls in its unbalance at 12 000 rpm, on springs and dampers.
    pub(super) fn rotor(&mut self) -> Result<(), String> {
        self.page.heading("Rotor of 52 elements on linear supports");
        let mut rows = Vec::new();
        let mut steady = None;
        if let Some(index) = self.peer_named(ROSS.name) {
            let mut versions = String::new();
            for (name, step, modes) in STEPS {
                let seconds = SECONDS.to_string();
                let words = ["--duration", &seconds, "--step", step, "--modes", modes];
                let answer = self.peers[index].run(&self.root, &words, PEER_RUNS)?;
                let cost = number(&answer, "/cpu_seconds")? / SECONDS;
                rows.push((
                    format!("{}, {name}", ROSS.name),
                    cost,
                    Some(number(&answer, "/middle_amplitude")?),
                ));
                steady = Some(number(&answer, "/middle_amplitude_in_frequency")?);
                versions = Peer::versions(&answer);
            }
            self.page.line(&format!("Versions: {versions}."));
            self.page.line("");
        }
        let text = std::fs::read_to_string(self.root.join(ROTOR));
        let text = time_run(&text.map_err(|error| format!("{ROTOR}: {error}"))?)?;
        let file = std::env::temp_dir().join(format!("auxbear-bench-{}.toml", std::process::id()));
        std::fs::write(&file, text).map_err(|error| error.to_string())?;
        let own = self.own_rows(&file.to_string_lossy());
        let _ = std::fs::remove_file(&file);
        let mut all = own?;
        all.append(&mut rows);
        self.page.table([
            "rotor on supports",
            "CPU s a simulated second",
            "largest displacement of the middle, µm",
            "over the response in frequency, less 1",
        ]);
        for (name, cost, amplitude) in all {
            let off = amplitude.zip(steady).map(|(own, exact)| own / exact - 1.0);
            self.page.row(&[
                name,
                three(cost),
                amplitude.map_or(String::new(), |metres| format!("{:.4}", metres * 1e6)),
                off.map_or(String::new(), |off| format!("{off:+.0e}")),
            ]);
        }
        Ok(())
    }

    /// Name, CPU seconds a simulated second, amplitude of each way of this program.
    fn own_rows(&self, file: &str) -> Result<Vec<(String, f64, Option<f64>)>, String> {
        let mut rows = Vec::new();
        for accuracy in ["design", "screening"] {
            let settings = [format!("run.accuracy={accuracy}")];
            for (count, how) in [(1, "alone"), (LANE_RUNS, "in lanes")] {
                let scenario = file;
                let settings = &settings;
                let cost = self.program.cost(Task {
                    scenario,
                    settings,
                    count,
                })?;
                let amplitude = if count == 1 {
                    let summary = self.program.summary()?;
                    Some(quantity(&summary, "node.middle.largest_displacement")?)
                } else {
                    None
                };
                rows.push((
                    format!("auxbear, {accuracy}, {how}"),
                    cost / SECONDS,
                    amplitude,
                ));
            }
        }
        Ok(rows)
    }

    /// A 6010 between rigid grooves, stepped to 400 rad/s: 4 ms.
    pub(super) fn ball_bearing(&mut self) -> Result<(), String> {
        self.page.heading("Ball bearing brought to speed");
        let mut rows: Vec<(String, f64, f64)> = Vec::new();
        for tolerance in TOLERANCES {
            let settings = [format!("run.tolerance={tolerance}")];
            let task = Task {
                scenario: BEARING,
                settings: &settings,
                count: 1,
            };
            let cost = self.program.cost(task)?;
            let summary = self.program.summary()?;
            let reached = quantity(&summary, "cage_time_to_95_percent_of_rolling")?;
            rows.push((format!("auxbear, {tolerance}"), cost, reached));
        }
        if let Some(index) = self.peer_named(EXUDYN.name) {
            let mut answer = Value::Null;
            for step in BEARING_STEPS {
                answer = self.peers[index].run(&self.root, &["--step", step], PEER_RUNS)?;
                rows.push((
                    format!("{}, steps of {step} s", EXUDYN.name),
                    number(&answer, "/cpu_seconds")?,
                    number(&answer, "/cage_at_95_percent")?,
                ));
            }
            self.page
                .line(&format!("Versions: {}.", Peer::versions(&answer)));
            self.page.line("");
        }
        self.page
            .table(["spin-up of 4 ms", "CPU s", "cage at 95 % of rolling, µs"]);
        for (name, cost, reached) in rows {
            self.page
                .row(&[name, three(cost), format!("{:.2}", reached * 1e6)]);
        }
        Ok(())
    }
}

/// A time run of the rotor, from its linear analysis.
fn time_run(analysis: &str) -> Result<String, String> {
    let lost = || format!("{ROTOR} is no longer what the benchmark takes it for");
    let (before, rest) = analysis.split_once("[analysis]\n").ok_or_else(lost)?;
    let (_, after) = rest.split_once("\n[[").ok_or_else(lost)?;
    let before = before.replace("\"rotor\"", "\"machine\"");
    let after = after.replace(SUPPORT, STAYS);
    if !before.contains("\"machine\"") || after.matches("\"stays\"").count() != 2 {
        return Err(lost());
    }
    Ok(format!("{before}[[{after}{RUN}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_rotor_becomes_a_run_on_supports_that_stay() {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../scenarios/rotor_52_elements.toml"
        );
        let text = time_run(&std::fs::read_to_string(path).unwrap()).unwrap();
        assert!(text.contains("system = \"machine\"") && !text.contains("[analysis]"));
        assert!(time_run("system = \"rotor\"\n[analysis]\n[[rotor.node]]\n").is_err());
    }
}
