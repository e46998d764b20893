//! `cargo xtask bench`: the reference drop beside what a user would write instead, in CPU time. Nothing is judged.

use crate::repository::Repository;
use crate::toolchain::{cargo, quiet};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;

const SCENARIO: &str = "scenarios/reference_drop.toml";
const PEER: &str = "benchmarks/peers/scipy_lsoda.py";
const MISSING: &str = "SciPy was not run: python3 lacks it. python3 -m pip install -r benchmarks/peers/requirements.txt";
const QUANTITIES: &str = "time_to_first_contact first_impact_force inner_race_time_to_95_percent rotor_race_friction_energy";
/// The whole drop, s, and the part of it that is short enough for the peer: it holds seven contacts.
const DURATIONS: [&str; 2] = ["0.5", "0.05"];
const LANE_RUNS: usize = 32;
/// CPU time of children comes in steps of 10 ms: a block of runs this long, s, makes that one percent.
const BLOCK: f64 = 1.0;
const BLOCKS: usize = 5;

/// Measures the command given, or the release build, and prints the table.
pub fn run(program: Option<&str>) -> ExitCode {
    match measure(program) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn measure(program: Option<&str>) -> Result<(), String> {
    let repository = Repository::open()?;
    let program = match program {
        Some(path) => std::path::absolute(path).map_err(|error| format!("{path}: {error}"))?,
        None => build(&repository)?,
    };
    let out = std::env::temp_dir().join(format!("auxbear-bench-{}", std::process::id()));
    let cpuinfo = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let processor = model_name(&cpuinfo).unwrap_or(std::env::consts::ARCH);
    let clock = children_seconds().map_or("wall time, as CPU time is not told", |_| "CPU time");
    println!("{processor}, {}; {clock}", level());
    println!("{:<32}{:>16}{:>16}", "", "s a drop", "drops/s");
    let (mut alone, mut in_lanes) = (0.0, 0.0);
    for duration in DURATIONS {
        alone = cost(&repository.root, &program, &out, duration, 1)?;
        row(
            &format!("auxbear alone, {duration} s"),
            alone,
            alone.recip(),
            4,
        );
        in_lanes = cost(&repository.root, &program, &out, duration, LANE_RUNS)?;
        row(
            &format!("auxbear in lanes, {duration} s"),
            in_lanes,
            in_lanes.recip(),
            4,
        );
    }
    let summary = std::fs::read_to_string(out.join("summary.json"));
    let summary = summary.map_err(|error| format!("summary.json: {error}"))?;
    std::fs::remove_dir_all(&out).map_err(|error| error.to_string())?;

    let has_scipy = quiet(Command::new("python3").args(["-c", "import scipy"]))
        .findings
        .is_empty();
    if !has_scipy {
        println!("{MISSING}");
        return Ok(());
    }
    let mut peer = Command::new("python3");
    peer.args([PEER, "--duration", DURATIONS[1]])
        .current_dir(&repository.root);
    let peer = peer.output().map_err(|error| format!("python3: {error}"))?;
    if !peer.status.success() {
        return Err(String::from_utf8_lossy(&peer.stderr).into_owned());
    }
    let answer = String::from_utf8_lossy(&peer.stdout);
    let seconds = number(&answer, "/cpu_seconds")?;
    row(
        &format!("SciPy LSODA, {} s", DURATIONS[1]),
        seconds,
        seconds.recip(),
        4,
    );
    println!(
        "SciPy over auxbear: {:.0} alone, {:.0} in lanes",
        seconds / alone,
        seconds / in_lanes
    );
    println!("{:<32}{:>16}{:>16}", "SI units", "auxbear", "SciPy");
    for name in QUANTITIES.split(' ') {
        let ours = number(&summary, &format!("/quantities/{name}/value"))?;
        row(name, ours, number(&answer, &format!("/{name}"))?, 8);
    }
    Ok(())
}

/// The release build of the command; it lies beside the build of this tool.
pub fn build(repository: &Repository) -> Result<PathBuf, String> {
    let outcome = quiet(cargo(repository).args(["build", "--quiet", "--release", "--locked"]));
    let own = std::env::current_exe().map_err(|error| error.to_string())?;
    let name = format!("auxbear{}", std::env::consts::EXE_SUFFIX);
    let program = own
        .ancestors()
        .nth(2)
        .map(|target| target.join("release").join(name));
    program
        .filter(|path| outcome.findings.is_empty() && path.is_file())
        .ok_or_else(|| format!("no program was built\n{}", outcome.findings.join("\n")))
}

/// CPU seconds of one drop, the whole process with its files: the median of several blocks of runs.
fn cost(
    root: &Path,
    program: &Path,
    out: &Path,
    duration: &str,
    count: usize,
) -> Result<f64, String> {
    let simulate = || {
        // absent before the first run; the command never writes over a folder
        let _ = std::fs::remove_dir_all(out);
        let mut command = Command::new(program);
        command
            .args(["run", SCENARIO, "--quiet", "--threads", "1", "--out"])
            .arg(out);
        command.args(["--set", &format!("run.duration={duration} s")]);
        command.args(["--repeat", &count.to_string()]);
        let outcome = quiet(command.current_dir(root));
        if outcome.findings.is_empty() {
            Ok(())
        } else {
            Err(outcome.findings.join("\n"))
        }
    };
    let runs = (BLOCK / timed(simulate)?.max(0.01)).ceil() as usize;
    let blocks: Result<Vec<f64>, String> = (0..BLOCKS)
        .map(|_| timed(|| (0..runs).try_for_each(|_| simulate())))
        .collect();
    Ok(median(blocks?) / (runs * count) as f64)
}

/// CPU seconds that the children of this process spent during `work`; wall seconds where the system does not say.
fn timed(work: impl FnOnce() -> Result<(), String>) -> Result<f64, String> {
    let (cpu, wall) = (children_seconds(), Instant::now());
    work()?;
    let spent = cpu.and_then(|before| Some(children_seconds()? - before));
    Ok(spent.unwrap_or_else(|| wall.elapsed().as_secs_f64()))
}

fn children_seconds() -> Option<f64> {
    children_ticks(&std::fs::read_to_string("/proc/self/stat").ok()?).map(|ticks| ticks / 100.0)
}

/// User and system time of ended children in ticks of 10 ms: fields 16 and 17, counted from behind the program's name,
/// which stands in brackets and may hold anything.
fn children_ticks(stat: &str) -> Option<f64> {
    let mut fields = stat.rsplit_once(')')?.1.split_whitespace().skip(13);
    let user: f64 = fields.next()?.parse().ok()?;
    Some(user + fields.next()?.parse::<f64>().ok()?)
}

/// The number at a JSON pointer.
fn number(text: &str, pointer: &str) -> Result<f64, String> {
    let all: Value = serde_json::from_str(text).map_err(|error| error.to_string())?;
    let value = all.pointer(pointer).and_then(Value::as_f64);
    value.ok_or_else(|| format!("no number at {pointer}"))
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn row(name: &str, first: f64, second: f64, digits: usize) {
    println!("{name:<32}{first:>16.digits$}{second:>16.digits$}");
}

fn model_name(cpuinfo: &str) -> Option<&str> {
    let line = cpuinfo
        .lines()
        .find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim())
}

/// The vector unit, by the rule of `number::Level`.
fn level() -> &'static str {
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx2") {
        let is_wide = is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl");
        return if is_wide { "AVX-512" } else { "AVX2" };
    }
    "baseline"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_of_children_are_found_behind_any_program_name() {
        // proc(5): behind the name stand state (3) … stime (15), cutime (16), cstime (17)
        let stat = "7 (a) b 1) S 4 5 6 7 8 9 10 11 12 13 14 15 130 4 18";
        assert_eq!(children_ticks(stat), Some(134.0));
        assert_eq!(children_ticks("7 (a) S 4 5"), None);
    }

    #[test]
    fn the_processor_is_the_first_one_named() {
        let cpuinfo = "processor\t: 0\nmodel name\t: One @ 2.50GHz\nmodel name\t: Two\n";
        assert_eq!(model_name(cpuinfo), Some("One @ 2.50GHz"));
        assert_eq!(model_name("Features\t: fp asimd"), None);
    }

    #[test]
    fn a_number_that_is_missing_is_named() {
        let text = r#"{"a": {"value": 9.5}, "b": null}"#;
        assert_eq!(number(text, "/a/value"), Ok(9.5));
        assert_eq!(number(text, "/b"), Err("no number at /b".to_owned()));
        assert!(number("Traceback", "/a").is_err());
    }

    #[test]
    fn one_slow_block_does_not_move_the_median() {
        assert_eq!(median(vec![1.0, 90.0, 1.2, 1.1, 0.9]), 1.1);
    }
}
