//! `auxbear results`: what a run of a file will find, before it is run.

use crate::console;
use crate::run::listen;
use auxbear::problem::Problem;
use auxbear::scenario::{BuiltIn, STUDY_FORMAT, Scenario, StudyFile};
use std::fmt::Write;
use std::path::Path;

/// Says what stands for a part of a name that no file decides.
const PATTERNS: &str = "\n* stands for a number or name that only the run or its data decide.\n";

pub fn perform(file: &Path, sets: &[String]) -> Result<(), Box<Problem>> {
    // of a study its scenario
    let scenario = match Scenario::read(file, sets, &BuiltIn) {
        Err(problem) if problem.found.contains(STUDY_FORMAT) => StudyFile::read(file)?.scenario,
        read => read?,
    };
    listen(false);
    let results = auxbear::run::build(&scenario)?.results();
    let longest = |of: &dyn Fn(usize) -> usize| (0..results.len()).map(of).max().unwrap_or(0);
    let name = longest(&|k| results[k].name.chars().count());
    let unit = longest(&|k| results[k].unit.chars().count());
    let mut text = String::new();
    for result in &results {
        let (named, measured) = (&result.name, result.unit);
        let _ = writeln!(text, "{named:name$}  {measured:unit$}  {}", result.meaning);
    }
    if results.iter().any(|result| result.name.contains('*')) {
        text.push_str(PATTERNS);
    }
    console::print(&text)
}
