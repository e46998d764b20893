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
    let (machines, starts, mut observers) = ([machine], [start.to_vec()], [observer]);
    let mut endings = match steps.scheme() {
        Some(scheme) => solve::run::<f64, SpinUp<f64>, _>(
            scheme,
            &machines,
            &starts,
            &mut observers,
            settings,
            interrupt,
        ),
        None => solve::run_implicit::<f64, SpinUp<f64>, _>(
            &machines,
            &starts,
            &mut observers,
            settings,
            interrupt,
        ),
    };
    // one machine, one ending
    endings.remove(0)
}
