//! From a scenario to results.
//!
//! | page | subject |
//! |---|---|
//! | [`build`], [`build_bearing`], [`build_spin_up`] | scenario → constants of the model |
//! | [`ensemble`] | one machine or many, in lanes and threads |
//! | `drop`, `spin_up`, `torque` | runs a system and names what came out |
//! | `quantities`, `list` | each named result with its law, source and valid range |
//! | `columns` | the history |
//! | `warnings`, `warnings_shared` | what to know before trusting the numbers |
//! | `ending` | settings of the integration, and how a run ended |
//! | [`outcome`] | the data handed over |

pub mod build;
pub mod build_bearing;
pub mod build_spin_up;
mod columns;
mod columns_spin_up;
mod drop;
mod ending;
pub mod ensemble;
mod list;
pub mod outcome;
mod quantities;
mod quantities_spin_up;
mod quantities_torque;
mod spin_up;
mod torque;
mod warnings;
mod warnings_shared;
mod warnings_spin_up;
mod warnings_torque;

use crate::problem::Problem;
use crate::scenario::{Scenario, System};
pub use outcome::Outcome;
use std::sync::atomic::AtomicBool;

/// What a caller decides besides the scenario.
pub struct Options<'a> {
    /// Number of threads; all cores if none.
    pub threads: Option<usize>,
    /// Set to true, it stops the run at the next opportunity; what was computed is kept.
    pub interrupt: &'a AtomicBool,
    /// Told what is being computed and the fraction of it done, from 0 to 1, from any thread.
    pub progress: &'a (dyn Fn(Phase, f64) + Sync),
}

impl<'a> Options<'a> {
    /// All cores, and nobody who watches.
    pub fn unwatched(interrupt: &'a AtomicBool) -> Self {
        Options {
            threads: None,
            interrupt,
            progress: &|_, _| {},
        }
    }
}

/// What a caller waits for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The steady run that tells the share of the friction moment. It may last longer than foreseen.
    SteadyRun,
    /// The run itself.
    Run,
}

impl Phase {
    /// For people.
    pub fn name(self) -> &'static str {
        match self {
            Phase::SteadyRun => "steady run for the friction moment",
            Phase::Run => "run",
        }
    }
}

/// Simulates what the scenario describes. A run that fails is an [`Outcome`] whose `stop` says where and why.
pub fn run(scenario: &Scenario, options: &Options) -> Result<Outcome, Box<Problem>> {
    match &scenario.system {
        System::Drop(drop) => drop::run(scenario, drop, options),
        System::SpinUp(spin_up) => spin_up::run(scenario, spin_up, options),
        System::Torque(torque) => torque::run(scenario, torque),
    }
}
