//! A run of a rig: the solver lands on what its program does, and ends a step where its [clutch](super::clutch) changes.

use super::RigMachine;
use super::machine::Rig;
use number::{Level, Real, Task};
use solve::{Ending, Observer, Settings};
use std::sync::atomic::AtomicBool;

/// Runs a rig from its start; the times of the settings are those of its program, and start at 0.
pub fn simulate(
    machine: &RigMachine,
    settings: &Settings,
    observer: &mut dyn Observer<RigMachine>,
    interrupt: &AtomicBool,
) -> Ending {
    simulate_on(Level::detect(), machine, settings, observer, interrupt)
}

/// The same on a level of the vector unit: every one gives the same bits.
///
/// # Panics
/// When this machine does not have the level.
pub fn simulate_on(
    level: Level,
    machine: &RigMachine,
    settings: &Settings,
    observer: &mut dyn Observer<RigMachine>,
    interrupt: &AtomicBool,
) -> Ending {
    level.run_one(Run {
        machine,
        settings,
        observer,
        interrupt,
    })
}

struct Run<'a, 'o> {
    machine: &'a RigMachine,
    settings: &'a Settings,
    observer: &'a mut (dyn Observer<RigMachine> + 'o),
    interrupt: &'a AtomicBool,
}

impl Task for Run<'_, '_> {
    type Output = Ending;
    fn run<R: Real>(self) -> Ending {
        let mut endings = solve::run::<R, Rig<R>, _>(
            &solve::BOGACKI_SHAMPINE,
            &[self.machine],
            &[self.machine.start()],
            &mut [self.observer],
            self.settings,
            self.interrupt,
        );
        // one machine, one ending
        endings.remove(0)
    }
}
