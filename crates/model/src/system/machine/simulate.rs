//! Runs machines: one with its balls in groups, several side by side in lanes.
//!
//! The observers are trait objects, so that the kernels of all shapes of numbers are compiled here, once.

use super::{Machines, RotorMachine};
use number::{Level, Real, Task};
pub use solve::Steps;
use solve::{Ending, Observer, Settings};
use std::sync::atomic::AtomicBool;

/// What a vector register holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Balls of one machine: machines one after the other.
    Balls,
    /// Machines, one in each lane.
    Machines,
}

/// Machines to run.
#[derive(Clone, Copy)]
pub struct Runs<'a> {
    /// Machines with the same laws and the same states.
    pub machines: &'a [&'a RotorMachine],
    /// The state of each at the start.
    pub starts: &'a [Vec<f64>],
    /// Of the integration.
    pub settings: Settings,
    /// Explicit or linearly implicit.
    pub steps: Steps,
    /// Stops everything when true.
    pub interrupt: &'a AtomicBool,
}

/// Who watches the machines, one each.
pub type Observers<'a, 'b> = &'a mut [&'b mut dyn Observer<RotorMachine>];

/// Runs machines on the widest vector unit there is; how each ended, in their order.
pub fn simulate(runs: Runs, observers: Observers) -> Vec<Ending> {
    let shape = match runs.machines.len() {
        1 => Shape::Balls,
        _ => Shape::Machines,
    };
    simulate_on(Level::detect(), shape, runs, observers)
}

/// The same on a level of the vector unit and in a shape: all give the same bits.
///
/// # Panics
/// When this machine does not have the level.
pub fn simulate_on(level: Level, shape: Shape, runs: Runs, observers: Observers) -> Vec<Ending> {
    let work = SideBySide { runs, observers };
    match shape {
        Shape::Balls => level.run_one(work),
        Shape::Machines => level.run_many(work),
    }
}

struct SideBySide<'a, 'b, 'c> {
    runs: Runs<'a>,
    observers: Observers<'b, 'c>,
}

impl Task for SideBySide<'_, '_, '_> {
    type Output = Vec<Ending>;
    fn run<R: Real>(self) -> Vec<Ending> {
        let SideBySide { runs, observers } = self;
        let Runs {
            machines,
            starts,
            settings,
            interrupt,
            steps,
        } = runs;
        match steps.scheme() {
            Some(scheme) => solve::run::<R, Machines<R>, _>(
                scheme, machines, starts, observers, &settings, interrupt,
            ),
            None => solve::run_implicit::<R, Machines<R>, _>(
                machines, starts, observers, &settings, interrupt,
            ),
        }
    }
}
