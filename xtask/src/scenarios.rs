//! Guard: the built command reads and runs every shipped scenario, and its kernels are compiled for the vector unit.

use crate::golden;
use crate::pages;
use crate::repository::{Outcome, Repository};
use crate::shipped::{call, program, summary_in};
use serde_json::Value;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What kernels do with numbers is inlined into functions compiled for the vector unit. Where one of these stands as a function of its
/// own, a law is compiled without the unit, and each of its products is a call.
const INLINED: [&str; 6] = [
    "_mm256_sub_pd",
    "_mm256_div_pd",
    "_mm256_sqrt_pd",
    "_mm512_sub_pd",
    "_mm512_div_pd",
    "_mm512_sqrt_pd",
];

/// Builds the command as the tests are built, then runs it on every file of `scenarios/`.
pub fn check(repository: &Repository) -> Outcome {
    let program = match program(repository) {
        Ok(program) => program,
        Err(findings) => return Outcome::new("", findings),
    };
    let folder = std::env::temp_dir().join(format!("auxbear-check-{}", std::process::id()));
    let mut findings = run_all(repository, &program, &folder);
    let opened = pages::faults(&folder, &program);
    let pages = match &opened {
        Some(_) => "their pages opened in a browser",
        None => "no page opened: no chromium here",
    };
    findings.extend(opened.unwrap_or_default());
    // Nothing depends on the folder any more; one that stays behind is no fault of the product.
    let _ = std::fs::remove_dir_all(&folder);
    match std::fs::read(&program) {
        Ok(bytes) => findings.extend(called(&bytes)),
        Err(error) => findings.push(format!("{}: {error}", program.display())),
    }
    let count = repository.below("scenarios/", ".toml").count();
    let seen = match count {
        0 => "no scenarios to run: the folder is empty".to_owned(),
        count => format!("{count} run; {pages}; kernels in the vector unit"),
    };
    Outcome::new(seen, findings)
}

/// Operations of the vector unit that a program has as functions.
fn called(program: &[u8]) -> Vec<String> {
    let text = String::from_utf8_lossy(program);
    let found = INLINED.into_iter().filter(|name| text.contains(name));
    let why = "a law of the kernels is not compiled for the vector unit: #[inline(always)] down to the last one, or Real::vectorized";
    found
        .map(|name| format!("{name} is called: {why}"))
        .collect()
}

/// Runs every file of `scenarios/` in a folder, each to `runs/NAME` in it; what is wrong with them.
pub fn run_all(repository: &Repository, program: &Path, folder: &Path) -> Vec<String> {
    let mut findings = Vec::new();
    let files: Vec<&str> = repository.below("scenarios/", "").collect();
    for file in &files {
        let copied = folder.join(file);
        let done = copied.parent().map(std::fs::create_dir_all);
        if let Some(Err(error)) = done {
            findings.push(format!("{file}: {error}"));
        }
        if let Err(error) = std::fs::copy(repository.root.join(file), &copied) {
            findings.push(format!("{file}: {error}"));
        }
    }
    let (first, after): (Vec<&str>, Vec<&str>) = (files.iter().copied())
        .filter(|file| file.ends_with(".toml"))
        .partition(|file| !reads_others(repository, file));
    for group in [first, after] {
        let next = AtomicUsize::new(0);
        let work = || {
            let mut found = Vec::new();
            while let Some(file) = group.get(next.fetch_add(1, Ordering::Relaxed)) {
                found.extend(run(repository, folder, program, file));
            }
            found
        };
        std::thread::scope(|scope| {
            let workers = [(); AT_ONCE].map(|()| scope.spawn(work));
            for worker in workers {
                let found = worker.join();
                findings.extend(found.unwrap_or_else(|_| vec!["a worker panicked".to_owned()]));
            }
        });
    }
    findings
}

/// Scenarios that run at the same time: most of them use one core.
const AT_ONCE: usize = 2;

/// Checks and runs a scenario, and compares what it writes.
fn run(repository: &Repository, folder: &Path, program: &Path, file: &str) -> Vec<String> {
    let mut findings = Vec::new();
    let name = Path::new(file).file_stem().unwrap_or_default();
    let out = folder.join("runs").join(name);
    let is_study = (repository.text(file)).is_some_and(|text| text.contains("auxbear.study/"));
    if !is_study {
        findings.extend(call(folder, program, &["check", file]));
    }
    let command = if is_study { "study" } else { "run" };
    let run = [command, file, "--quiet", "--out", &out.to_string_lossy()];
    let found = call(folder, program, &run);
    let early = ENDS_EARLY.iter().find(|(early, _)| *early == file);
    if early.is_none() {
        findings.extend(found);
    }
    let summary = std::fs::read_to_string(out.join("summary.json"));
    let faults = summary.map_or_else(
        |error| vec![format!("no summary: {error}")],
        |text| faults_of(&text, early.map(|(_, end)| *end)),
    );
    let differences = summary_in(&out)
        .map(|summary| golden::differences(repository, &name.to_string_lossy(), &summary));
    let faults = faults.into_iter().chain(differences.unwrap_or_default());
    findings.extend(faults.map(|fault| format!("{file}: {fault}")));
    findings
}

/// Whether a scenario reads the run directories of others.
fn reads_others(repository: &Repository, file: &str) -> bool {
    (repository.text(file)).is_some_and(|text| text.contains("\"../runs/"))
}

/// Largest share of the energy turned over that the ledger of a shipped scenario may miss.
const LARGEST_RESIDUAL: f64 = 1e-6;
/// The same at screening accuracy.
const LARGEST_AT_SCREENING: f64 = 2e-4;

/// Files whose run ends before its time, and how: what they show is that.
const ENDS_EARLY: [(&str, &str); 1] = [(
    "scenarios/drop_whirl_seizing.toml",
    "a node is above 350 °C",
)];

/// What a summary says against its run: it must be whole, or end as its file is there to show, and its energy must close.
fn faults_of(summary: &str, early: Option<&str>) -> Vec<String> {
    let Ok(summary) = serde_json::from_str::<Value>(summary) else {
        return vec!["its summary is no JSON".to_owned()];
    };
    let mut faults = Vec::new();
    let stop = &summary["stop"];
    match early {
        None if summary["complete"] == true => {}
        None => faults.push(format!("not complete: {stop}")),
        Some(end) => {
            if summary["complete"] != false || !stop.to_string().contains(end) {
                faults.push(format!("does not end because {end}: {stop}"));
            }
        }
    }
    if summary["members_failed"].is_number() {
        // the results of a study are spreads of its members
        if summary["members_failed"] != 0 {
            faults.push(format!("members failed: {}", summary["failed"]));
        }
        return faults;
    }
    let inputs = summary["inputs"].as_array().into_iter().flatten();
    let mut screened = inputs.filter(|input| input["path"] == "run.accuracy");
    let largest = match screened.any(|input| input["value"] == "screening") {
        true => LARGEST_AT_SCREENING,
        false => LARGEST_RESIDUAL,
    };
    match summary["quantities"]["energy_residual"]["value"].as_f64() {
        Some(residual) if residual.abs() < largest => {}
        Some(residual) => faults.push(format!(
            "its energy residual {residual:e} is not below {largest:e}"
        )),
        // nothing moves there
        None if ["torque", "signals", "identify", "rotor", "coast_down"]
            .iter()
            .any(|name| summary["system"] == *name) => {}
        None => faults.push("it has no energy residual".to_owned()),
    }
    faults
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_summary_is_held_to_its_energy() {
        let whole = |summary: &str| faults_of(summary, None);
        let summary = |complete: bool, residual: f64| {
            format!(
                "{{\"complete\": {complete}, \"quantities\": {{\"energy_residual\": {{\"value\": {residual:e}}}}}}}"
            )
        };
        assert!(whole(&summary(true, -9e-7)).is_empty());
        assert_eq!(whole(&summary(true, 2e-6)).len(), 1);
        assert_eq!(whole(&summary(false, 2e-6)).len(), 2);
        assert_eq!(whole("{}").len(), 2);
        assert!(whole("{\"system\": \"torque\", \"complete\": true}").is_empty());
        assert_eq!(whole("half").len(), 1);
        let early = summary(false, 1e-9).replace("{\"c", "{\"stop\": {\"text\": \"too hot\"}, \"c");
        assert!(faults_of(&early, Some("too hot")).is_empty());
        assert_eq!(faults_of(&early, Some("too cold")).len(), 1);
        assert_eq!(faults_of(&summary(true, 1e-9), Some("too hot")).len(), 1);
        let screened = |residual: f64| {
            summary(true, residual).replace(
                "{\"complete\"",
                "{\"inputs\": [{\"path\": \"run.accuracy\", \"value\": \"screening\"}], \"complete\"",
            )
        };
        assert!(whole(&screened(1e-4)).is_empty());
        assert_eq!(whole(&screened(3e-4)).len(), 1);
    }

    #[test]
    fn a_product_that_is_a_call_is_found() {
        assert!(called(b"\x7fELF main _mm256_set1_pd").is_empty());
        assert_eq!(called(b"\xff_RNv5_3avx13__mm256_sub_pd\0").len(), 1);
    }
}
