//! Heat, severity and life: rows of closed forms, moving sources, ball loads, wear and fatigue by their `kind`; a network of
//! bodies; printed counts of cycles; thermal reference speeds; worked life examples. Tolerances are those that each file states.

mod catalogue;
mod conduction;
mod cycles;
mod fatigue;
mod json;
mod moving;
mod network;
mod severity;
mod surroundings;
mod tally;

use super::report::Row;
use serde_json::Value;
use tally::Tally;

/// Compares a row of its kind.
type Compare = fn(&Value, &mut Tally) -> Result<(), String>;

/// Rows of a file; `None` when its keys are those of another.
pub(super) fn rows(value: &Value) -> Option<Vec<Row>> {
    let compare = of_file(value)?;
    let mut tally = Tally::new(value);
    Some(match compare(value, &mut tally) {
        Ok(()) => tally.into_rows(),
        Err(error) => {
            let row = Row::wrong(format!("wrong: {error}"));
            vec![Row {
                damaged: true,
                ..row
            }]
        }
    })
}

/// The comparison of a whole file, by its keys.
fn of_file(value: &Value) -> Option<Compare> {
    let top = value.as_object()?;
    let has = |keys: &[&str]| keys.iter().all(|key| top.contains_key(*key));
    if has(&["capacity", "links", "grounds", "rows"]) {
        return Some(network::compare);
    }
    if has(&["series", "results"]) && value["results"]["counts_by_range"].is_object() {
        return Some(cycles::by_range);
    }
    let rows = top.get("rows")?.as_array()?;
    let any = |of: &dyn Fn(&Value) -> bool| rows.iter().any(of);
    if any(&|row| {
        row["kind"]
            .as_str()
            .is_some_and(|kind| of_kind(kind).is_some())
    }) {
        Some(by_kind)
    } else if any(&|row| row["reference_speed_rpm"].is_number() && row["bore_mm"].is_number()) {
        Some(surroundings::compare)
    } else if any(&catalogue::is_example) {
        Some(catalogue::compare)
    } else {
        None
    }
}

fn of_kind(kind: &str) -> Option<Compare> {
    conduction::of_kind(kind)
        .or_else(|| moving::of_kind(kind))
        .or_else(|| severity::of_kind(kind))
        .or_else(|| fatigue::of_kind(kind))
        .or_else(|| cycles::of_kind(kind))
}

fn by_kind(file: &Value, tally: &mut Tally) -> Result<(), String> {
    for (at, row) in json::list(file, "rows")?.iter().enumerate() {
        let place = format!("row {}", at + 1);
        let named = |error| format!("{place}: {error}");
        let kind = json::text(row, "kind").map_err(named)?;
        tally.place.clone_from(&place);
        match of_kind(kind) {
            Some(compare) => compare(row, tally).map_err(named)?,
            None => tally.leave_out(kind, "a kind of row that is not known"),
        }
    }
    Ok(())
}
