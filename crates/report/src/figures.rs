//! Figures of the results of runs that an older version made: their summaries do not say which figures show a result, and the
//! tables of their scenarios do.

use super::summary::shown;
use scenario::{BuiltIn, Scenario};
use std::path::Path;

/// A summary with the figures of its results; as it is where it has them, or where its scenario cannot be built any more.
pub(super) fn with_figures(summary: String, scenario: &Path) -> String {
    let summary = with_present_names(summary);
    if summary.contains("\"shown\":") {
        return summary;
    }
    let Ok(scenario) = Scenario::read(scenario, &[], &BuiltIn) else {
        return summary;
    };
    let Ok(machine) = run::build(&scenario) else {
        return summary;
    };
    const AFTER: &str = "\n  \"warnings\":";
    let (mut quantities, rest) = match summary.split_once(AFTER) {
        Some((quantities, rest)) => (quantities.to_string(), rest),
        None => return summary,
    };
    for result in machine.results() {
        let begin = format!("\n    \"{}\": {{", result.name);
        if let Ok(figures) = serde_json::to_string(&shown(&result)) {
            quantities = quantities.replacen(&begin, &format!("{begin}\"shown\": {figures},"), 1);
        }
    }
    quantities + AFTER + rest
}

/// The same whose results have the names of now: those of a coast-down began with `run_out.` once.
fn with_present_names(summary: String) -> String {
    match summary.contains("run_out.") {
        true => summary
            .replace("\"run_out.", "\"coast_down.")
            .replace(".run_out.", ".coast_down."),
        false => summary,
    }
}
