//! `cargo xtask bench`: the reference drop, a flexible rotor and one bearing beside what a user would write instead, in CPU time. Nothing is judged.

pub mod against;
mod clock;
mod machines;
mod page;
mod peer;
mod program;
mod rotor;

use crate::repository::Repository;
use page::{Page, signed, three};
use peer::{CVODE, EXUDYN, Peer, ROSS, SCIPY, number};
pub use program::given_or_built;
use program::{Program, Task};
use serde_json::Value;
use std::path::PathBuf;
use std::process::Command;

const RESULTS: &str = "benchmarks/RESULTS.md";
const DROP: &str = "scenarios/reference_drop.toml";
/// The reference drop without the catalogue's ring around it.
const ANY_BALLS: &str = "benchmarks/ball_count.toml";
/// The whole drop, s, and the part of it that is reproducible: it holds seven contacts and the spin-up.
const WHOLE: &str = "0.5";
const PART: &str = "0.05";
/// Reference speed of ball traction, m/s: that of the scenario, and one that makes the equations stiff.
const TRACTION: &str = "0.1";
const STIFF_TRACTION: &str = "0.001";
/// Tolerance of the program's own runs, that of stiff traction, and that of the reference.
const TOLERANCE: &str = "1e-4";
const STIFF_TOLERANCE: &str = "1e-3";
const REFERENCE_TOLERANCE: &str = "1e-7";
/// Relative tolerances of the peers for equal error (benchmarks/README.md).
const CVODE_TOLERANCE: &str = "3e-4";
const CVODE_STIFF_TOLERANCE: &str = "3e-5";
const SCIPY_TOLERANCE: &str = "5e-4";
const BALLS: [usize; 4] = [7, 10, 20, 40];
const LANE_RUNS: usize = 32;
const PEER_RUNS: usize = 3;

/// The reproducible quantities: heading, where summary and peers have it, factor to the unit of the heading.
const QUANTITIES: [(&str, &str, f64); 6] = [
    ("first impact, N", "first_impact_force", 1.0),
    ("second contact, µs", "contact_start_times/1", 1e6),
    ("third contact, µs", "contact_start_times/2", 1e6),
    ("race at 50 %, µs", "inner_race_time_to_50_percent", 1e6),
    ("race at 95 %, µs", "inner_race_time_to_95_percent", 1e6),
    ("friction energy, mJ", "rotor_race_friction_energy", 1e3),
];

/// Measures the command given, or the release build; prints the tables and writes them to `benchmarks/RESULTS.md`.
pub fn run(program: Option<&str>) -> Result<(), String> {
    let repository = Repository::open()?;
    let program = given_or_built(&repository, program)?;
    let mut bench = Bench {
        program: Program::new(&repository.root, program),
        root: repository.root.clone(),
        page: Page::default(),
        peers: Vec::new(),
    };
    bench.page.line("# Measured");
    bench.page.line("");
    bench.page.line("Written by `cargo xtask bench`; what is compared, and why at these tolerances: [README.md](README.md).");
    bench.page.line("");
    bench.page.line(&clock::machine());
    for peer in [CVODE, SCIPY, ROSS, EXUDYN] {
        match peer.missing() {
            None => bench.peers.push(peer),
            Some(line) => {
                bench.page.line("");
                bench.page.line(&line);
            }
        }
    }
    bench.reference_drop()?;
    bench.stiff_traction()?;
    bench.number_of_balls()?;
    bench.rotor()?;
    bench.machines()?;
    bench.ball_bearing()?;
    bench.instructions()?;
    repository.write(RESULTS, bench.page.text())
}

struct Bench {
    root: PathBuf,
    program: Program,
    page: Page,
    peers: Vec<Peer>,
}

impl Bench {
    /// The reference drop as it stands: whole and in part.
    fn reference_drop(&mut self) -> Result<(), String> {
        self.page.heading("Reference drop");
        let cvode = self.peer_named(CVODE.name);
        let mut versions = Vec::new();
        for duration in [WHOLE, PART] {
            let settings = drop_settings(duration, TRACTION, TOLERANCE);
            let mut others = Vec::new();
            if let Some(index) = cvode {
                let answer = self.ask(index, duration, TRACTION, CVODE_TOLERANCE, PEER_RUNS)?;
                versions.push(answer.clone());
                others.push((index, answer));
            }
            if let Some(index) = self.peer_named(SCIPY.name).filter(|_| duration == PART) {
                let answer = self.ask(index, duration, TRACTION, SCIPY_TOLERANCE, 1)?;
                versions.push(answer.clone());
                others.push((index, answer));
            }
            self.compare(duration, &settings, &others)?;
            if duration == PART {
                self.deviations(TRACTION, TOLERANCE, &others)?;
            }
        }
        let mut versions: Vec<String> = versions.iter().map(Peer::versions).collect();
        versions.dedup();
        for line in versions {
            self.page.line("");
            self.page.line(&format!("Versions: {line}."));
        }
        Ok(())
    }

    /// The same with traction that is nearly Coulomb's.
    fn stiff_traction(&mut self) -> Result<(), String> {
        self.page.heading(&format!(
            "Stiff traction: reference speed {STIFF_TRACTION} m/s"
        ));
        let settings = drop_settings(PART, STIFF_TRACTION, STIFF_TOLERANCE);
        let mut others = Vec::new();
        if let Some(index) = self.peer_named(CVODE.name) {
            let tolerance = CVODE_STIFF_TOLERANCE;
            others.push((
                index,
                self.ask(index, PART, STIFF_TRACTION, tolerance, PEER_RUNS)?,
            ));
        }
        self.compare(PART, &settings, &others)?;
        self.deviations(STIFF_TRACTION, STIFF_TOLERANCE, &others)
    }

    /// How the cost grows with the number of balls.
    fn number_of_balls(&mut self) -> Result<(), String> {
        self.page.heading("Number of balls");
        self.page.line("The whole drop of `benchmarks/ball_count.toml`: the same balls on a larger pitch circle.");
        self.page.line("");
        self.page.table([
            "balls",
            "pitch diameter, mm",
            "CPU s a drop",
            "in lanes",
            "right-hand sides",
            "µs each",
            "µs each in lanes",
        ]);
        for balls in BALLS {
            let pitch = pitch_millimetres(balls);
            let settings = [
                format!("run.duration={WHOLE} s"),
                format!("bearing.ball_count={balls}"),
                format!("bearing.pitch_diameter={pitch} mm"),
            ];
            let task = |count| Task {
                scenario: ANY_BALLS,
                settings: &settings,
                count,
            };
            let alone = self.program.cost(task(1))?;
            let calls = self.program.rate_calls()?;
            let lanes = self.program.cost(task(LANE_RUNS))?;
            let lane_calls = self.program.rate_calls()? / LANE_RUNS as f64;
            self.page.row(&[
                balls.to_string(),
                pitch.to_string(),
                three(alone),
                three(lanes),
                calls.to_string(),
                three(alone / calls * 1e6),
                three(lanes / lane_calls * 1e6),
            ]);
        }
        Ok(())
    }

    /// Instructions of a whole drop over its right-hand sides, where the machine counts them.
    fn instructions(&mut self) -> Result<(), String> {
        self.page.heading("Instructions");
        let settings = drop_settings(WHOLE, TRACTION, TOLERANCE);
        for count in [1, LANE_RUNS] {
            let mut counter = Command::new("perf");
            counter.args(["stat", "-x,", "-e", "instructions:u", "--"]);
            counter.arg(self.program.path());
            self.program
                .arguments(&mut counter, drop_of(&settings, count));
            let counted = counter
                .output()
                .ok()
                .and_then(|output| counted(&String::from_utf8_lossy(&output.stderr)));
            let Some(instructions) = counted else {
                self.page.line("Not counted: `perf stat -e instructions:u` is absent or the machine does not count.");
                return Ok(());
            };
            let each = instructions / self.program.rate_calls()?;
            self.page.line(&format!(
                "- {count} drops, whole process over right-hand sides of one lane: {each:.0}"
            ));
        }
        Ok(())
    }

    /// Table of costs and ratios for drops of one duration.
    fn compare(
        &mut self,
        duration: &str,
        settings: &[String],
        others: &[(usize, Value)],
    ) -> Result<(), String> {
        let alone = self.program.cost(drop_of(settings, 1))?;
        let lanes = self.program.cost(drop_of(settings, LANE_RUNS))?;
        let mut lines = vec![("auxbear, alone", alone), ("auxbear, in lanes", lanes)];
        for (index, answer) in others {
            lines.push((self.peers[*index].name, number(answer, "/cpu_seconds")?));
        }
        self.page.table([
            &format!("drop of {duration} s") as &str,
            "CPU s",
            "drops per core-second",
            "over alone",
            "over lanes",
        ]);
        for (name, seconds) in lines {
            self.page.row(&[
                name.to_owned(),
                three(seconds),
                three(seconds.recip()),
                three(seconds / alone),
                three(seconds / lanes),
            ]);
        }
        self.page.line("");
        Ok(())
    }

    /// Table of deviations from the program's own results at the tolerance of the reference.
    fn deviations(
        &mut self,
        traction: &str,
        tolerance: &str,
        others: &[(usize, Value)],
    ) -> Result<(), String> {
        let reference = self.summary_of(&drop_settings(PART, traction, REFERENCE_TOLERANCE))?;
        let own = self.summary_of(&drop_settings(PART, traction, tolerance))?;
        let title = "deviation in the drop of 0.05 s";
        self.page.table(
            [title]
                .into_iter()
                .chain(QUANTITIES.map(|(name, _, _)| name)),
        );
        let mut sides = vec![(format!("auxbear, {tolerance}"), own)];
        for (index, answer) in others {
            let rtol = number(answer, "/rtol")?;
            let name = format!("{}, {rtol:e}", self.peers[*index].name);
            sides.push((name, answer.clone()));
        }
        for (name, answer) in sides {
            let mut cells = vec![name];
            for (_, key, factor) in QUANTITIES {
                let deviation = quantity(&answer, key)? - quantity(&reference, key)?;
                cells.push(signed(deviation * factor));
            }
            self.page.row(&cells);
        }
        Ok(())
    }

    fn peer_named(&self, name: &str) -> Option<usize> {
        self.peers.iter().position(|peer| peer.name == name)
    }

    fn ask(
        &self,
        index: usize,
        duration: &str,
        traction: &str,
        tolerance: &str,
        runs: usize,
    ) -> Result<Value, String> {
        let words = format!("--duration {duration} --traction-speed {traction} --rtol {tolerance}");
        let words: Vec<&str> = words.split(' ').collect();
        self.peers[index].run(&self.root, &words, runs)
    }

    fn summary_of(&self, settings: &[String]) -> Result<Value, String> {
        self.program.simulate(drop_of(settings, 1))?;
        self.program.summary()
    }
}

/// So many reference drops.
fn drop_of(settings: &[String], count: usize) -> Task<'_> {
    Task {
        scenario: DROP,
        settings,
        count,
    }
}

fn drop_settings(duration: &str, traction: &str, tolerance: &str) -> [String; 4] {
    // explicit steps are not exact where friction is stiff, and not taken there unless asked for
    let method = match traction {
        STIFF_TRACTION => "auto",
        _ => "explicit",
    };
    [
        format!("run.duration={duration} s"),
        format!("bearing.traction.reference_speed={traction} m/s"),
        // both sides of the table, alone and in lanes, by the same steps
        format!("run.method={method}"),
        format!("run.tolerance={tolerance}"),
    ]
}

/// The pitch circle of the 6005, and as dense a row of balls where ten are not enough.
fn pitch_millimetres(balls: usize) -> f64 {
    3.6 * balls.max(10) as f64
}

/// A quantity of a summary, where values stand one level deeper, or of a peer's answer.
fn quantity(answer: &Value, key: &str) -> Result<f64, String> {
    let (name, entry) = key.split_once('/').unwrap_or((key, ""));
    let entry = if entry.is_empty() {
        String::new()
    } else {
        format!("/{entry}")
    };
    let deeper = format!("/quantities/{name}/value{entry}");
    number(answer, &deeper).or_else(|_| number(answer, &format!("/{key}")))
}

/// The count in the answer of `perf stat -x,`: the field before the name of the event.
fn counted(answer: &str) -> Option<f64> {
    let line = answer.lines().find(|line| line.contains("instructions"))?;
    line.split(',').next()?.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_that_is_missing_is_named() {
        let all: Value = serde_json::from_str(r#"{"a": {"value": 9.5}, "b": null}"#).unwrap();
        assert_eq!(number(&all, "/a/value"), Ok(9.5));
        assert_eq!(number(&all, "/b"), Err("no number at /b".to_owned()));
    }

    #[test]
    fn quantities_are_found_in_summaries_and_in_answers_of_peers() {
        let ours = r#"{"quantities": {"t": {"value": [1, 2]}, "f": {"value": 3}}}"#;
        let ours: Value = serde_json::from_str(ours).unwrap();
        let theirs: Value = serde_json::from_str(r#"{"t": [4, 5], "f": 6}"#).unwrap();
        assert_eq!(quantity(&ours, "t/1"), Ok(2.0));
        assert_eq!(quantity(&ours, "f"), Ok(3.0));
        assert_eq!(quantity(&theirs, "t/1"), Ok(5.0));
        assert_eq!(quantity(&theirs, "f"), Ok(6.0));
        assert!(quantity(&theirs, "g").is_err());
    }

    #[test]
    fn instructions_are_read_or_known_to_be_uncounted() {
        assert_eq!(
            counted("123456,,instructions:u,998,100.00,,"),
            Some(123_456.0)
        );
        assert_eq!(counted("<not supported>,,instructions:u,0,100.00,,"), None);
        assert_eq!(counted("perf: not found"), None);
    }

    #[test]
    fn balls_keep_the_room_that_they_have_in_a_6005() {
        // 40 balls of 6.35 mm on 144 mm: 452 mm of circumference for 254 mm of balls, as 10 on 36 mm
        assert_eq!(
            [7, 10, 20, 40].map(pitch_millimetres),
            [36.0, 36.0, 72.0, 144.0]
        );
    }
}
