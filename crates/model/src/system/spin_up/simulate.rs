//! Runs a spin-up.

use super::{SpinUp, SpinUpMachine};
use solve::{Ending, Observer, Settings, Steps};
use std::sync::atomic::AtomicBool;

/// Runs one machine alone, in plain numbers: the vector unit would save a second here and cost minutes of building.
pub fn simulate(
    machine: &SpinUpMachine,
    start: &[f64],
    settings: &Settings,
    steps: Steps,
    observer: &mut dyn Observer<SpinUpMachine>,
    interrupt: &AtomicBool,
) -> Ending {
    let run = match steps {
        Steps::Explicit => solve::run::<f64, SpinUp<f64>, _>,
        Steps::Implicit => solve::run_implicit::<f64, SpinUp<f64>, _>,
    };
    run(
        &[machine],
        &[start.to_vec()],
        &mut [observer],
        settings,
        interrupt,
    )
    // one machine, one ending
    .remove(0)
}
