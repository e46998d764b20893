//! Machines whose rotor bends: states with their derivative (`machine_rhs_points.json`), a run-up through a critical speed
//! (`machine_runup.json`), a drop onto two bearings (`machine_drop_flexible.json`), mounts of every part
//! (`machine_mounts.json`), and the friction that dry whirl needs (`machine_whirl.json`). Tolerances are those that each file states.

mod drop;
mod faults;
mod faults_given;
mod faults_watch;
mod given;
mod json;
mod mounts;
mod points;
mod run_up;
mod whirl;

use super::compare::{Refusal, rows_of};
use super::report::Row;
use super::simulator::Simulator;
use serde_json::Value;
use std::path::Path;

/// Rows of a file; `None` when its keys are those of another.
pub(super) fn rows(value: &Value, path: &Path, simulator: &dyn Simulator) -> Option<Vec<Row>> {
    let top = value.as_object()?;
    let has = |keys: &[&str]| keys.iter().all(|key| top.contains_key(*key));
    let rows = if has(&["machines", "rotor", "names"]) {
        points::rows as fn(&Value, &Path) -> Result<Vec<Row>, Refusal>
    } else if has(&["kinds", "motions", "results"]) {
        mounts::rows
    } else if has(&["supports", "runs", "rotor", "unbalance"]) {
        run_up::rows
    } else if has(&["magnets", "start", "beta_added", "bearings"]) {
        drop::rows
    } else if has(&["full_slip_whirl", "contact_node", "race"]) {
        whirl::rows
    } else if has(&["cases", "loop", "faults", "stop"]) {
        faults::rows
    } else {
        return None;
    };
    if let Err(why) = simulator.machines() {
        return Some(vec![Row::not_run(why)]);
    }
    Some(rows_of(rows(value, path)))
}
