//! Bearings in space: whole states with their derivative (`spatial_rhs_points.json`), equilibria with stiffness
//! (`spatial_quasistatic.json`), published equilibria by ISO/TS 16281 and on exact tori (`spatial_iso16281.json`), drops
//! (`spatial_drops.json`).
//!
//! State of the files: bodies of 13 numbers (rotor, inner ring, outer ring, cages), balls x v w in the frame of the machine, energy
//! accounts. Tolerances are those that each file states.

mod drops;
mod given;
mod points;
mod statics;

use super::compare::rows_of;
use super::report::Row;
use super::simulator::Simulator;
use serde_json::Value;

/// Rows of a file; `None` when its keys are those of another.
pub(super) fn rows(value: &Value, simulator: &dyn Simulator) -> Option<Vec<Row>> {
    let top = value.as_object()?;
    let has = |keys: &[&str]| keys.iter().all(|key| top.contains_key(*key));
    let rows = if has(&["points", "per_ball", "globals", "layout"]) {
        points::rows as fn(&Value) -> Result<Vec<Row>, String>
    } else if has(&["rows", "duplex", "params_steel"]) {
        statics::quasi_static
    } else if has(&["rows", "inputs", "note"]) {
        statics::iso16281
    } else if has(&["cases", "layout", "tol"]) {
        drops::rows
    } else {
        return None;
    };
    if let Err(why) = simulator.machines() {
        return Some(vec![Row::not_run(why)]);
    }
    Some(rows_of(rows(value).map_err(Into::into)))
}
