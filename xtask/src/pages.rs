//! Part of the guard of the scenarios: a browser opens reports of every kind, and no script of them fails.

use crate::shipped::call;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// One run of each kind, and one with several bearings.
const OPENED: [&str; 12] = [
    "coast_down_closing",
    "rigid_drop",
    "two_bearings_drop",
    "spin_up_6005",
    "torque_6005",
    "rig_test_2",
    "signals_spin_up",
    "identify_paper_tests",
    "rotor_levitated",
    "rotor_overhung",
    "machine_expander",
    "vertical_flywheel",
];

/// Runs that a comparison shows: of one kind and of another.
const COMPARED: [&[&str]; 2] = [
    &["rigid_drop", "angular_contact_drop", "full_complement_drop"],
    &["rigid_drop", "rig_test_2"],
];

const BROWSERS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// Words of the browser: a page has 4000 ms to draw itself, on a clock that does not wait.
const WORDS: &str = "--headless --no-sandbox --disable-gpu --enable-logging=stderr --virtual-time-budget=4000 --dump-dom";

/// Opens reports of the runs in a folder; none where there is no browser.
pub fn faults(folder: &Path, program: &Path) -> Option<Vec<String>> {
    let browser = BROWSERS.into_iter().find(|name| {
        let asked = Command::new(name)
            .arg("--version")
            .stdin(Stdio::null())
            .output();
        asked.is_ok_and(|output| output.status.success())
    })?;
    let runs = folder.join("runs");
    let mut findings = Vec::new();
    let mut pages: Vec<PathBuf> = (OPENED.iter())
        .map(|name| runs.join(name).join("report.html"))
        .filter(|page| page.exists())
        .collect();
    for (number, names) in COMPARED.into_iter().enumerate() {
        let directories = names.iter().map(|name| runs.join(name));
        let directories: Vec<String> = directories
            .filter(|directory| directory.exists())
            .map(|directory| directory.to_string_lossy().into_owned())
            .collect();
        if directories.len() < names.len() {
            continue;
        }
        let page = folder.join(format!("comparison_{number}.html"));
        let out = page.to_string_lossy().into_owned();
        let mut arguments = vec!["report"];
        arguments.extend(directories.iter().map(String::as_str));
        arguments.extend(["--out", &out]);
        findings.extend(call(folder, program, &arguments));
        pages.push(page);
    }
    for page in pages {
        let name = page.strip_prefix(folder).unwrap_or(&page).display();
        let faults = opened(browser, &page).into_iter();
        findings.extend(faults.map(|fault| format!("{name}: {fault}")));
    }
    Some(findings)
}

/// What the console of the browser says of a page, and which of its parts could not be drawn.
fn opened(browser: &str, page: &Path) -> Vec<String> {
    let output = Command::new(browser)
        .args(WORDS.split(' '))
        .arg(format!("file://{}", page.display()))
        .stdin(Stdio::null())
        .output();
    match output {
        Err(error) => vec![format!("{browser}: {error}")],
        Ok(output) => read(
            &String::from_utf8_lossy(&output.stdout),
            &String::from_utf8_lossy(&output.stderr),
        ),
    }
}

fn read(document: &str, log: &str) -> Vec<String> {
    let mut faults: Vec<String> = (log.lines())
        .filter(|line| line.contains(":CONSOLE"))
        .map(str::to_owned)
        .collect();
    // the words of a part that failed are in its section, and in the script that makes them
    let failed = document.matches("<section id=\"failed-").count();
    if failed > 0 {
        faults.push(format!("{failed} parts could not be drawn"));
    }
    let empty = document.matches("</h2></section>").count();
    if empty > 0 {
        faults.push(format!("{empty} sections without content"));
    }
    if !document.contains("<h1>") {
        faults.push("no title was drawn".to_owned());
    }
    faults
}

#[cfg(test)]
mod tests {
    use super::read;

    #[test]
    fn a_script_that_fails_is_a_fault() {
        assert!(read("<h1>a</h1>", "[1:2:WARNING:gpu.cc(3)] none\n").is_empty());
        let log =
            "[1:2:INFO:CONSOLE(9)] \"Uncaught ReferenceError: lines is not defined\", source: x";
        assert_eq!(read("<h1>a</h1>", log).len(), 1);
        assert_eq!(
            read("<h1>a</h1><section id=\"failed-orbitSection\">", "").len(),
            1
        );
        assert_eq!(
            read("<h1>a</h1><section><h2>Orbit</h2></section>", "").len(),
            1
        );
        assert_eq!(read("<main id=\"report\"></main>", "").len(), 1);
    }
}
