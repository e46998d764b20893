//! Machines whose rotor bends: states with their derivative (`machine_rhs_points.json`), a run-up through a critical speed
//! (`machine_runup.json`), a drop onto two bearings (`machine_drop_flexible.json`), and mounts of every part
//! (`machine_mounts.json`). Tolerances are those that each file states.

mod drop;
mod given;
mod mounts;
mod points;
mod run_up;

use super::report::Row;
use super::simulator::Simulator;
use number::Vec2;
use serde_json::Value;
use std::path::Path;

/// Rows of a file; `None` when its keys are those of another.
pub(super) fn rows(value: &Value, path: &Path, simulator: &dyn Simulator) -> Option<Vec<Row>> {
    let top = value.as_object()?;
    let has = |keys: &[&str]| keys.iter().all(|key| top.contains_key(*key));
    let rows = if has(&["machines", "rotor", "names"]) {
        points::rows as fn(&Value, &Path) -> Result<Vec<Row>, String>
    } else if has(&["kinds", "motions", "results"]) {
        mounts::rows
    } else if has(&["supports", "runs", "rotor", "unbalance"]) {
        run_up::rows
    } else if has(&["magnets", "start", "beta_added", "bearings"]) {
        drop::rows
    } else {
        return None;
    };
    if let Err(why) = simulator.machines() {
        return Some(vec![Row::not_run(why)]);
    }
    Some(rows(value, path).unwrap_or_else(|error| {
        let row = Row::wrong(format!("wrong: {error}"));
        vec![Row {
            damaged: true,
            ..row
        }]
    }))
}

fn list<'a>(value: &'a Value, key: &str) -> Result<&'a [Value], String> {
    let list = value[key].as_array().map(Vec::as_slice);
    list.ok_or_else(|| format!("{key} is no list"))
}
fn number(value: &Value, key: &str) -> Result<f64, String> {
    let number = value[key].as_f64().filter(|number| number.is_finite());
    number.ok_or_else(|| format!("{key} is no number"))
}
/// So many numbers.
fn numbers<const N: usize>(value: &Value, key: &str) -> Result<[f64; N], String> {
    let found = value[key].as_array().map(Vec::as_slice).unwrap_or_default();
    let found: Option<Vec<f64>> = found.iter().map(Value::as_f64).collect();
    let found = found.and_then(|list| <[f64; N]>::try_from(list).ok());
    found.ok_or_else(|| format!("{key} is no list of {N} numbers"))
}
fn pair(value: &Value) -> Result<Vec2<f64>, String> {
    match (value[0].as_f64(), value[1].as_f64()) {
        (Some(x), Some(y)) => Ok(Vec2::new(x, y)),
        _ => Err("an entry is no pair of numbers".to_string()),
    }
}
fn pairs(value: &Value, key: &str, count: usize) -> Result<Vec<Vec2<f64>>, String> {
    let found = list(value, key)?;
    if found.len() != count {
        return Err(format!("{key} has {} entries, not {count}", found.len()));
    }
    found.iter().map(pair).collect()
}
