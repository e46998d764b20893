//! Machines whose rotor bends: states with their derivative (`machine_rhs_points.json`), a run-up through a critical speed
//! (`machine_runup.json`), a drop onto two bearings (`machine_drop_flexible.json`), mounts of every part
//! (`machine_mounts.json`), and the friction that dry whirl needs (`machine_whirl.json`). Tolerances are those that each file states.

mod drop;
mod faults;
mod faults_given;
mod faults_watch;
mod given;
mod mounts;
mod points;
mod run_up;
mod whirl;

use super::compare::{Refusal, rows_of};
use super::report::Row;
use super::simulator::Simulator;
use model::system::machine::RotorMachine;
use model::system::machine::simulate::{Runs, Steps, simulate};
use serde_json::Value;
use solve::{Ending, Observer, Settings, Stop};
use std::path::Path;
use std::sync::atomic::AtomicBool;

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

/// Runs a machine by explicit steps until `end`, s, from a first step in s; an error where it ends before.
fn run_to(
    end: f64,
    machine: &RotorMachine,
    start: &[f64],
    (tolerance, first_step): (f64, f64),
    watch: &mut impl Observer<RotorMachine>,
) -> Result<Ending, String> {
    let runs = Runs {
        machines: &[machine],
        starts: &[start.to_vec()],
        settings: Settings {
            start: 0.0,
            end,
            tolerance,
            first_step,
            largest_step: 1e-3,
            step_limit: 100_000_000,
        },
        steps: Steps::Explicit,
        interrupt: &AtomicBool::new(false),
    };
    let ending = simulate(runs, &mut [watch]).remove(0);
    match ending.stop {
        Stop::Finished => Ok(ending),
        stop => Err(format!("the run ended at {} s: {stop:?}", ending.time)),
    }
}
