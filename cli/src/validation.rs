//! `auxbear validate`: prints the report, from which follows how the command ends.

use crate::console;
use crate::exit::Exit;
use auxbear::problem::Result;
use std::path::Path;
use validate::{Report, Simulation};

/// Runs the shipped cases, and those of a folder.
pub fn perform(cases: Option<&Path>, long: bool, json: bool) -> Result<Exit> {
    let report = validate::run(cases, &Simulation { long })?;
    console::print(&match json {
        true => report.to_json() + "\n",
        false => report.to_text(),
    })?;
    for problem in report.problems() {
        console::report(&problem.to_string());
    }
    Ok(exit(&report))
}

/// A damaged file is a wrong input; a case of another format is none, and fails nothing.
fn exit(report: &Report) -> Exit {
    match report.problems().next() {
        Some(_) => Exit::WrongInput,
        None if report.passed() => Exit::Done,
        None => Exit::Failed,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;
    use validate::LawsOnly;

    #[test]
    fn a_failing_case_fails_and_a_damaged_one_is_a_wrong_input() {
        let folder = tempfile::TempDir::new().unwrap();
        let with = |name: &str, text: &str| {
            fs::write(folder.path().join(name), text).unwrap();
            validate::run(Some(folder.path()), &LawsOnly).unwrap()
        };
        let report = with("other.toml", "a = 1");
        assert_eq!(exit(&report), Exit::Done);
        let text = report.to_text();
        assert!(text.contains("palmgren_low_speed") && text.contains(" 0 fail, "));
        let case = include_str!("../../crates/validate/cases/palmgren_low_speed.toml");
        let wrong = case.replace("value = \"16", "value = \"17");
        assert_eq!(exit(&with("wrong.toml", &wrong)), Exit::Failed);
        assert_eq!(exit(&with("cut.toml", "a = ")), Exit::WrongInput);
    }
}
