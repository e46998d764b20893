//! What comparisons with reference files share.

use super::report::Row;
use serde::Deserialize;
use serde_json::Value;

/// Reads a part of a reference file.
pub(super) fn part<T: for<'de> Deserialize<'de>>(value: &Value) -> Result<T, String> {
    T::deserialize(value).map_err(|error| error.to_string())
}

/// Keeps, of many comparisons under one name, the one that deviates most against its tolerance.
#[derive(Default)]
pub(super) struct Worst {
    rows: Vec<(Row, usize)>,
}

impl Worst {
    /// Adds a comparison.
    pub(super) fn add(&mut self, row: Row) {
        let excess = |row: &Row| match (row.deviation, row.tolerance) {
            (Some(deviation), _) if deviation.is_nan() => f64::INFINITY,
            (Some(0.0), _) => 0.0,
            (Some(deviation), Some(tolerance)) => deviation / tolerance,
            _ => 0.0,
        };
        match self
            .rows
            .iter_mut()
            .find(|(known, _)| known.quantity == row.quantity)
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
                if count > 1 {
                    row.why = format!("worst of {count}: {}", row.why);
                }
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
            verdict: super::report::Verdict::Pass,
            why: "must not happen, and does not".into(),
            ..row
        },
        _ => row,
    }
}
