//! From a scenario to results.
//!
//! | page | subject |
//! |---|---|
//! | [`mod@build`], [`build_bearing`], [`build_spin_up`] | scenario → constants of the model |
//! | `before` | what is known before a run |
//! | [`ensemble`] | one machine or many, in lanes and threads |
//! | `drop`, `spin_up`, `torque` | runs a system and names what came out |
//! | `signals` | reads a measurement and names what it holds |
//! | [`rig`] | runs a test on a rig and writes what its logger would have written |
//! | `quantities`, `quantities_shared`, `list` | each named result with its law, source and valid range |
//! | `bearing_run`, `film`, `skid` | the bearing of a run, what its rows tell of films and sliding balls |
//! | `columns`, `columns_shared` | the history |
//! | `warnings`, `warnings_shared` | what to know before trusting the numbers |
//! | `method` | explicit or linearly implicit steps |
//! | `ending` | settings of the integration, and how a run ended |
//! | [`outcome`] | the data handed over |

mod bearing_run;
mod before;
pub mod build;
pub mod build_bearing;
pub mod build_spin_up;
mod build_traction;
mod columns;
mod columns_shared;
mod columns_spin_up;
mod drop;
mod ending;
pub mod ensemble;
mod film;
mod identify;
mod list;
mod method;
pub mod outcome;
mod quantities;
mod quantities_shared;
mod quantities_spin_up;
mod quantities_torque;
pub mod rig;
mod signals;
mod skid;
mod spin_up;
mod torque;
mod warnings;
mod warnings_shared;
mod warnings_spin_up;
mod warnings_torque;

use crate::problem::Problem;
use crate::scenario::{Drop, Rig, Scenario, SpinUp, System};
pub use measure::file::parquet::panic_is_caught;
pub use outcome::Outcome;
use std::sync::atomic::AtomicBool;

/// What a caller decides besides the scenario.
pub struct Options<'a> {
    /// Number of threads; all cores if none.
    pub threads: Option<usize>,
    /// Set to true, it stops the run at the next opportunity; what was computed is kept.
    pub interrupt: &'a AtomicBool,
    /// Called with the fraction of the run done, from 0 to 1, from any thread.
    pub progress: &'a (dyn Fn(f64) + Sync),
}

impl<'a> Options<'a> {
    /// All cores, and nobody who watches.
    pub fn unwatched(interrupt: &'a AtomicBool) -> Self {
        Options {
            threads: None,
            interrupt,
            progress: &|_| {},
        }
    }
}

/// A scenario with its machine: what could be wrong with the input has been told.
pub struct Machine<'a> {
    scenario: &'a Scenario,
    system: Built<'a>,
}

/// The machine of each system.
enum Built<'a> {
    Drop(&'a Drop, Box<build::Built>),
    SpinUp(&'a SpinUp, Box<build_spin_up::Built>),
    Torque(Box<torque::Asked<'a>>),
    Signals(Box<signals::Asked>),
    Rig(&'a Rig, Box<rig::build::Built>),
    Identify(Box<identify::Asked<'a>>),
}

/// Builds the machine that the scenario describes; runs nothing.
pub fn build(scenario: &Scenario) -> Result<Machine<'_>, Box<Problem>> {
    let system = match &scenario.system {
        System::Drop(drop) => build::drop(drop).map(|built| Built::Drop(drop, Box::new(built))),
        System::SpinUp(spin_up) => {
            build_spin_up::spin_up(spin_up).map(|built| Built::SpinUp(spin_up, Box::new(built)))
        }
        System::Torque(torque) => {
            torque::Asked::of(torque).map(|asked| Built::Torque(Box::new(asked)))
        }
        System::Signals(signals) => {
            signals::Asked::of(signals).map(|asked| Built::Signals(Box::new(asked)))
        }
        System::Identify(identify) => {
            identify::Asked::of(identify).map(|asked| Built::Identify(Box::new(asked)))
        }
        System::Rig(rig) => rig::build::rig(rig).map(|built| Built::Rig(rig, Box::new(built))),
    };
    let system = system.map_err(|problem| scenario.locate(problem))?;
    Ok(Machine { scenario, system })
}

impl Machine<'_> {
    /// Simulates it. A run that fails is an [`Outcome`] whose `stop` says where and why.
    pub fn run(&self, options: &Options) -> Outcome {
        let mut outcome = match &self.system {
            Built::Drop(drop, built) => drop::run(self.scenario, drop, built, options),
            Built::SpinUp(spin_up, built) => spin_up::run(self.scenario, spin_up, built, options),
            Built::Torque(asked) => torque::run(self.scenario, asked),
            Built::Signals(asked) => signals::run(self.scenario, asked, options),
            Built::Identify(asked) => identify::run(self.scenario, asked, options),
            Built::Rig(rig, built) => rig::run(self.scenario, rig, built, options),
        };
        let mut before = self.warnings();
        before.retain(|warning| {
            outcome
                .warnings
                .iter()
                .all(|told| told.code != warning.code)
        });
        outcome.warnings.splice(0..0, before);
        outcome
    }
}

/// Builds and simulates what the scenario describes.
pub fn run(scenario: &Scenario, options: &Options) -> Result<Outcome, Box<Problem>> {
    Ok(build(scenario)?.run(options))
}
