//! A run of a rig: the solver lands on what is done to it, and ends a step where its [clutch](super::clutch) changes.

use super::machine::{Rig, RigMachine};
use number::{Level, Real, Task};
use solve::{Ending, Observer, Scheme, Settings, Steps};
use std::sync::atomic::AtomicBool;

/// Runs a rig on the widest vector unit there is.
pub fn simulate(run: Run<'_, '_>) -> Ending {
    simulate_on(Level::detect(), run)
}

/// A run.
pub struct Run<'a, 'o> {
    /// The rig.
    pub machine: &'a RigMachine,
    /// Its state at the start.
    pub start: Vec<f64>,
    /// Of the integration.
    pub settings: &'a Settings,
    /// Explicit; linearly implicit where [`RigMachine::tangents`] knows what is stiff, else that panics.
    pub steps: Steps,
    /// Its observer.
    pub observer: &'a mut (dyn Observer<RigMachine> + 'o),
    /// Stops it when true.
    pub interrupt: &'a AtomicBool,
}

/// Runs a rig on a level of the vector unit: every one gives the same bits. Linearly implicit steps are in plain numbers: the
/// vector unit would save a second here and cost minutes of building.
///
/// # Panics
/// When this machine does not have the level.
pub fn simulate_on(level: Level, run: Run<'_, '_>) -> Ending {
    match run.steps.scheme() {
        None => {
            let mut endings = solve::run_implicit::<f64, Rig<f64>, _>(
                &[run.machine],
                &[run.start],
                &mut [run.observer],
                run.settings,
                run.interrupt,
            );
            // one machine, one ending
            endings.remove(0)
        }
        Some(scheme) => level.run_one(Explicit(scheme, run)),
    }
}

/// Explicit steps of a scheme.
struct Explicit<'a, 'o>(&'static Scheme, Run<'a, 'o>);

impl Task for Explicit<'_, '_> {
    type Output = Ending;
    fn run<R: Real>(self) -> Ending {
        let Explicit(scheme, run) = self;
        let mut endings = solve::run::<R, Rig<R>, _>(
            scheme,
            &[run.machine],
            &[run.start],
            &mut [run.observer],
            run.settings,
            run.interrupt,
        );
        endings.remove(0)
    }
}
