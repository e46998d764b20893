//! Heat, severity and life: rows of closed forms, moving sources, ball loads, wear and fatigue by their `kind`; a network of
//! bodies; printed counts of cycles; thermal reference speeds; worked life examples. Tolerances are those that each file states.

mod catalogue;
mod coast;
mod conduction;
mod cycles;
mod fatigue;
mod moving;
mod network;
mod runaway;
mod severity;
mod skid;
mod surroundings;
mod tally;
mod warm;

use super::compare::{Refusal, rows_of};
use super::json;
use super::report::Row;
use serde_json::Value;
use tally::{Compare, Tally};

/// Rows of a file; `None` when its keys are those of another.
pub(super) fn rows(value: &Value) -> Option<Vec<Row>> {
    let compare = of_file(value)?;
    let mut tally = Tally::new(value);
    let found = compare(value, &mut tally);
    Some(rows_of(
        found.map(|()| tally.into_rows()).map_err(Refusal::from),
    ))
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
    if let Some(inputs) = top.get("cases").map(|cases| &cases[0]["inputs"]) {
        return cases_of(inputs);
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

/// The comparison of a file of cases, by the inputs of the first.
fn cases_of(inputs: &Value) -> Option<Compare> {
    let has = |key: &str| !inputs[key].is_null();
    if has("E_stop") && has("race") {
        Some(skid::compare)
    } else if has("stop_speed") && has("share_M0") {
        Some(coast::compare)
    } else if has("Pd0") && has("share_M0") {
        Some(runaway::compare)
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
        tally.row(&format!("row {}", at + 1), row, |tally| {
            let kind = json::text(row, "kind")?;
            match of_kind(kind) {
                Some(compare) => compare(row, tally)?,
                None => tally.leave_out(kind, "a kind of row that is not known"),
            }
            Ok(())
        })?;
    }
    Ok(())
}
