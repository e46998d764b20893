//! A run of a rig: the solver lands on what is done to it, and ends a step where its [clutch](super::clutch) changes.

use super::machine::{Rig, RigMachine};
use number::{Level, Real, Task};
use solve::{Ending, Observer, Settings, Steps};
use std::sync::atomic::AtomicBool;

/// Runs a rig from its start, with the steps of that kind; the settings start at 0.
pub fn simulate(
    machine: &RigMachine,
    settings: &Settings,
    steps: Steps,
    observer: &mut dyn Observer<RigMachine>,
    interrupt: &AtomicBool,
) -> Ending {
    let run = Run {
        machine,
        start: machine.start(),
        settings,
        steps,
        observer,
        interrupt,
    };
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
    /// Explicit, or linearly implicit: without a clutch.
    pub steps: Steps,
    /// Who watches it.
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
    match run.steps {
        Steps::Implicit => {
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
        Steps::Explicit | Steps::Extended => level.run_one(run),
    }
}

impl Task for Run<'_, '_> {
    type Output = Ending;
    fn run<R: Real>(self) -> Ending {
        let scheme = self.steps.scheme().unwrap_or(&solve::BOGACKI_SHAMPINE);
        let mut endings = solve::run::<R, Rig<R>, _>(
            scheme,
            &[self.machine],
            &[self.start],
            &mut [self.observer],
            self.settings,
            self.interrupt,
        );
        endings.remove(0)
    }
}
