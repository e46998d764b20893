//! What comparisons with reference files share.

use super::report::{Row, Tolerance, Verdict};
use serde::Deserialize;
use serde_json::Value;

/// Why nothing of a file is compared.
#[derive(Debug)]
pub(super) enum Refusal {
    /// It needs a model that this program does not have.
    NotModelled(String),
    /// It is wrong.
    Wrong(String),
}

impl<T: Into<String>> From<T> for Refusal {
    fn from(why: T) -> Self {
        Refusal::Wrong(why.into())
    }
}

/// The rows of a file, or the one that says why there are none.
pub(super) fn rows_of(found: Result<Vec<Row>, Refusal>) -> Vec<Row> {
    found.unwrap_or_else(|refusal| {
        vec![match refusal {
            Refusal::NotModelled(why) => Row::not_run(format!("model missing: {why}")),
            Refusal::Wrong(why) => Row {
                damaged: true,
                ..Row::wrong(format!("wrong: {why}"))
            },
        }]
    })
}

/// What a law or a model says against its inputs.
pub(super) fn told(error: impl std::fmt::Display) -> String {
    error.to_string()
}

/// Whether there is a `null` in it, at any depth.
fn has_null(value: &Value) -> bool {
    match value {
        Value::Array(list) => list.iter().any(has_null),
        Value::Object(table) => table.values().any(has_null),
        other => other.is_null(),
    }
}

/// Reads a part of a reference file.
pub(super) fn part<T: for<'de> Deserialize<'de>>(value: &Value) -> Result<T, String> {
    T::deserialize(value).map_err(|error| error.to_string())
}

/// Keeps, of many comparisons under one name, the one that deviates most against its tolerance.
#[derive(Clone, Default)]
pub(super) struct Worst {
    rows: Vec<(Row, usize)>,
}

/// Comparisons under one tolerance, with its reason.
pub(super) struct Under<'a> {
    worst: &'a mut Worst,
    tolerance: Tolerance,
    why: String,
}

impl Under<'_> {
    /// Compares two numbers, theirs and ours.
    pub(super) fn add(&mut self, quantity: &str, unit: &str, [theirs, ours]: [f64; 2]) {
        let (tolerance, why) = (self.tolerance, self.why.as_str());
        let row = Row::compared(quantity, unit, theirs, ours, tolerance, why);
        self.worst.add(row);
    }
}

impl Worst {
    /// Comparisons under a tolerance.
    pub(super) fn under(&mut self, tolerance: Tolerance, why: impl Into<String>) -> Under<'_> {
        Under {
            worst: self,
            tolerance,
            why: why.into(),
        }
    }
    /// Adds the comparisons of a row of a file. One that lacks a number where the file has `null` is left out by itself.
    pub(super) fn row(
        &mut self,
        place: &str,
        row: &Value,
        compare: impl FnOnce(&mut Self) -> Result<(), String>,
    ) -> Result<(), String> {
        let before = self.clone();
        match compare(self) {
            Err(why) if has_null(row) => {
                *self = before;
                self.add(Row::not_run(format!("it has a null: {why}")).of(place, ""));
                Ok(())
            }
            other => other.map_err(|why| format!("{place}: {why}")),
        }
    }
    /// Whether a row has a `null`; then it is left out.
    pub(super) fn lacks(&mut self, place: &str, row: &Value) -> bool {
        if has_null(row) {
            self.add(Row::not_run("it has a null").of(place, ""));
        }
        has_null(row)
    }
    /// Adds a comparison. With a value that is no number in the file nothing is compared.
    pub(super) fn add(&mut self, row: Row) {
        let row = match row.reference {
            Some(reference) if reference.is_nan() => {
                let why = format!("null in the file; {}", row.why);
                Row::not_run(why).of(row.quantity, row.unit)
            }
            _ => row,
        };
        let idle = |row: &Row| (row.verdict == Verdict::NotRun).then(|| row.why.clone());
        let excess = |row: &Row| match (row.deviation, row.tolerance) {
            (Some(deviation), _) if deviation.is_nan() => f64::INFINITY,
            (Some(0.0), _) => 0.0,
            (Some(deviation), Some(tolerance)) => deviation / tolerance,
            _ => 0.0,
        };
        match self
            .rows
            .iter_mut()
            .find(|(known, _)| known.quantity == row.quantity && idle(known) == idle(&row))
        {
            None => self.rows.push((row, 1)),
            Some((known, count)) => {
                *count += 1;
                if excess(&row) > excess(known) {
                    *known = row;
                }
            }
        }
    }
    /// The worst of each name, with how many there were.
    pub(super) fn into_rows(self) -> Vec<Row> {
        self.rows
            .into_iter()
            .map(|(mut row, count)| {
                row.why = match row.verdict {
                    Verdict::NotRun => format!("{count} of them: {}", row.why),
                    _ if count > 1 => format!("worst of {count}: {}", row.why),
                    _ => row.why,
                };
                row
            })
            .collect()
    }
}

/// A comparison where at least one side says that the event does not happen.
pub(super) fn never(
    quantity: impl Into<String>,
    unit: &str,
    reference: Option<f64>,
    ours: Option<f64>,
) -> Row {
    let row = Row {
        reference,
        ours,
        ..Row::wrong("happens on one side only").of(quantity, unit)
    };
    match (reference, ours) {
        (None, None) => Row {
            verdict: Verdict::Pass,
            why: "must not happen, and does not".into(),
            ..row
        },
        _ => row,
    }
}
