//! Bearings in space: whole states with their derivative (`spatial_rhs_points.json`).
//!
//! State of the files: bodies of 13 numbers (rotor, inner ring, outer ring, cages), balls x v w in the frame of the machine, energy
//! accounts. Tolerances are those that each file states.

mod given;
mod points;

use super::compare::rows_of;
use super::report::Row;
use super::simulator::Simulator;
use serde_json::Value;

/// Rows of a file; `None` when its keys are those of another.
pub(super) fn rows(value: &Value, simulator: &dyn Simulator) -> Option<Vec<Row>> {
    let top = value.as_object()?;
    let has = |keys: &[&str]| keys.iter().all(|key| top.contains_key(*key));
    let rows = if has(&["points", "per_ball", "globals", "layout"]) {
        points::rows
    } else {
        return None;
    };
    if let Err(why) = simulator.machines() {
        return Some(vec![Row::not_run(why)]);
    }
    Some(rows_of(rows(value).map_err(Into::into)))
}
