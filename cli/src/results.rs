//! `auxbear results`: results and columns of a run of a file, before it is run.

use crate::arguments::ScenarioArguments;
use crate::console;
use crate::run::listen;
use auxbear::problem::Result;
use auxbear::scenario::{STUDY_FORMAT, StudyFile};

/// Says what stands for a part of a name that no file decides.
const PATTERNS: &str = "\n* stands for a number or name that only the run or its data decide.\n";
/// Marks a column that a run may lack.
const OPTIONAL: &str = " (if found)";

pub fn perform(given: &ScenarioArguments) -> Result<()> {
    // of a study its scenario
    let scenario = match given.read() {
        Err(told) if told.found.contains(STUDY_FORMAT) => StudyFile::read(&given.file)?.scenario,
        read => read?,
    };
    listen(false);
    let machine = auxbear::run::build(&scenario)?;
    let (results, columns) = (machine.results(), machine.columns());
    let results = results.iter().map(|of| [&of.name, of.unit, of.meaning, ""]);
    let columns = columns.iter().map(|of| {
        let mark = if of.optional { OPTIONAL } else { "" };
        [&of.name, of.unit, &of.meaning, mark]
    });
    let listed = |rows: &[[&str; 4]]| {
        let longest = |at: usize| rows.iter().map(|row| row[at].chars().count()).max();
        let (name, unit) = (longest(0).unwrap_or(0), longest(1).unwrap_or(0));
        let lines = rows.iter().map(|[named, measured, meaning, mark]| {
            format!("{named:name$}  {measured:unit$}  {meaning}{mark}\n")
        });
        lines.collect::<String>()
    };
    let (results, columns) = (results.collect::<Vec<_>>(), columns.collect::<Vec<_>>());
    let (above, below) = (listed(&results), listed(&columns));
    let mut text = format!("{above}\nColumns of the history:\n{below}");
    if (results.iter().chain(&columns)).any(|row| row[0].contains('*')) {
        text.push_str(PATTERNS);
    }
    console::print(&text)
}
