//! Rainflow: rows with all cycles, and a printed example with counts by range.

use super::tally::{Compare, Tally};
use crate::json::{list, numbers, within};
use physics::rainflow::rainflow;
use serde_json::Value;

/// Longest series: cycles are sought for each other, pair by pair.
const LONGEST: usize = 5000;

/// The comparison of a kind of row.
pub(super) fn of_kind(kind: &str) -> Option<Compare> {
    (kind == "rainflow ASTM E1049-85 (range, mean, count)").then_some(every_cycle as Compare)
}

fn series(value: &Value) -> Result<Vec<f64>, String> {
    let series = numbers(value, "series")?;
    if series.len() > LONGEST {
        return Err(format!("series has more than {LONGEST} points"));
    }
    Ok(series)
}

fn every_cycle(row: &Value, tally: &mut Tally) -> Result<(), String> {
    let mut ours = rainflow(&series(row)?);
    let cycles = list(row, "cycles")?;
    tally.add(
        "rainflow: cycles",
        "",
        cycles.len() as f64,
        ours.len() as f64,
    )?;
    for cycle in cycles {
        let [range, mean, count] = [0, 1, 2].map(|at| cycle[at].as_f64().unwrap_or(f64::NAN));
        if !(range + mean + count).is_finite() {
            return Err("a cycle is no range, mean, count".to_string());
        }
        let off = |cycle: &physics::rainflow::Cycle| {
            (cycle.range - range).abs() + (cycle.mean - mean).abs() + (cycle.count - count).abs()
        };
        let nearest = (0..ours.len()).min_by(|a, b| off(&ours[*a]).total_cmp(&off(&ours[*b])));
        let Some(nearest) = nearest else { break };
        let found = ours.swap_remove(nearest);
        tally.add("rainflow: range", "", range, found.range)?;
        // A mean near 0 is the rounding of a difference: its measure is the range.
        let mut allowed = tally.allowed()?;
        allowed.absolute = allowed.absolute.max(allowed.relative * range.abs());
        tally.add_by("rainflow: mean", "", mean, found.mean, allowed);
        tally.add("rainflow: count", "", count, found.count)?;
    }
    Ok(())
}

/// Compares a file with counts by range.
pub(super) fn by_range(file: &Value, tally: &mut Tally) -> Result<(), String> {
    let ours = rainflow(&series(file)?);
    let printed = &file["results"]["counts_by_range"];
    let keys = printed.as_object().ok_or("counts_by_range is no table")?;
    let mut total = 0.0;
    for key in keys.keys() {
        let range: f64 = match key.parse() {
            Ok(range) if f64::is_finite(range) => range,
            _ => return Err(format!("range {key} is no number")),
        };
        let count = within(printed, key, 0.0, f64::INFINITY)?;
        total += count;
        tally.place = format!("range {key}");
        let same = ours
            .iter()
            .filter(|cycle| (cycle.range - range).abs() <= 1e-9 * range.abs());
        let found: f64 = same.map(|cycle| cycle.count).sum();
        tally.add("cycles of a range", "", count, found)?;
    }
    tally.place = "all ranges".to_string();
    let found = ours.iter().map(|cycle| cycle.count).sum();
    tally.add("cycles in all", "", total, found)
}
