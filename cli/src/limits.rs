//! What is printed of the limits: a line each with its verdict.

use crate::console;
use crate::digits::of_result;
use auxbear::outcome::{Judged, Outcome};

/// The verdicts as a table; nothing where there are none.
pub fn text(outcome: &Outcome) -> String {
    let rows: Vec<[String; 4]> = outcome.limits.iter().map(row).collect();
    match rows.is_empty() {
        true => String::new(),
        false => format!("limits:\n{}", console::table(&rows)),
    }
}

/// "most 3 kN".
pub fn bound(judged: &Judged) -> String {
    let Judged { limit, unit, .. } = judged;
    format!(
        "{} {}",
        limit.side.word(),
        of_result(&limit.quantity, limit.bound, unit)
    )
}

fn row(judged: &Judged) -> [String; 4] {
    let limit = &judged.limit;
    let value = judged.value.map_or("-".to_string(), |value| {
        of_result(&limit.quantity, value, judged.unit)
    });
    [
        format!("  {}", judged.verdict.word()),
        limit.quantity.replace(['_', '.'], " "),
        format!("{value}, at {}", bound(judged)),
        judged.why.clone(),
    ]
}
