//! Runs a spin-up.

use super::{SpinUp, SpinUpMachine};
use solve::{Ending, Observer, Settings};
use std::sync::atomic::AtomicBool;

/// Runs one machine alone, in plain numbers: the vector unit would save a second here and cost minutes of building.
pub fn simulate(
    machine: &SpinUpMachine,
    start: &[f64],
    settings: &Settings,
    observer: &mut dyn Observer<SpinUpMachine>,
    interrupt: &AtomicBool,
) -> Ending {
    solve::run::<f64, SpinUp<f64>, _>(
        &[machine],
        &[start.to_vec()],
        &mut [observer],
        settings,
        interrupt,
    )
    // one machine, one ending
    .remove(0)
}
