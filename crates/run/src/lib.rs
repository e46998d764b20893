//! From a scenario to results: the one place that knows every system.
//!
//! ```text
//!   scenario ──build──▶ machine ──run──▶ outcome
//! ```
//! `simulate` integrates motions, `analyse` reads measurements, `evaluate` computes laws without motion.

#![forbid(unsafe_code)]

mod before;
mod cutoff;
mod each;
mod known;
mod measured;
pub mod study;
#[cfg(test)]
mod tests;
pub mod warnings;

pub use analyse::mount;
pub use analyse::stiffness;
use analyse::{identify, signals};
use analyse::{rotor, torque};
pub use each::each;
pub use measured::Fitted;
pub use outcome::host::start_pool;
pub use outcome::options::Options;
pub use outcome::{self, Outcome};
use outcome::{Column, Quantity};
use outcome::{host, limits};
use problem::{Code, Result};
#[cfg(feature = "files")]
pub use recording::file::parquet::panic_is_caught;
use scenario::{CASE, CoastDown, Rig, Scenario, SpinUp, System, problem_at};
pub use simulate::drop::driven::{Commands, Driven, DrivenState, Driving, Reached};
pub use simulate::drop::driven_columns::Variable;
pub use simulate::simulation::{Input, Simulation};
use simulate::{coast_down, drop, rig, spin_up};
use std::sync::Arc;
use study::kept::{Nowhere, Store};

/// A scenario with its machine: everything wrong with the input has been reported.
pub struct Machine<'a> {
    scenario: &'a Scenario,
    system: Model<'a>,
    measured: Arc<Vec<measured::Curve>>,
}

/// The machine of each system.
enum Model<'a> {
    Drop(Arc<drop::build::DropModel>, Vec<Arc<study::repeat::Member>>),
    SpinUp(&'a SpinUp, Box<rig::run::RigModel>),
    Torque(Box<torque::Request<'a>>),
    Signals(Arc<signals::Request>),
    Rig(&'a Rig, Box<rig::run::RigModel>),
    Identify(Box<identify::Request<'a>>),
    Rotor(Arc<rotor::Request>),
    CoastDown(&'a CoastDown, Box<coast_down::build::CoastDownModel>),
}

/// Builds the machine that the scenario describes; runs nothing.
pub fn build(scenario: &Scenario) -> Result<Machine<'_>> {
    let mut machine = built(scenario)?;
    let here = |problem| scenario.locate(problem);
    machine.measured = measured::read(scenario, &machine.columns())
        .map_err(here)?
        .into();
    let limits = scenario.limits_here();
    if !limits.is_empty() {
        limits::check(&limits, &machine.results(), &warnings::of(scenario)).map_err(here)?;
    }
    Ok(machine)
}

/// The machine without what its results are compared with.
fn built(scenario: &Scenario) -> Result<Machine<'_>> {
    let system = match &scenario.system {
        System::Drop(of) => drop::build::drop(of).and_then(|built| {
            let others = study::repeat::others(scenario, &built.drop)?;
            Ok(Model::Drop(Arc::new(built), others))
        }),
        System::SpinUp(of) => {
            spin_up::build::spin_up(of).map(|built| Model::SpinUp(of, Box::new(built)))
        }
        System::Torque(of) => torque::Request::of(of).map(|asked| Model::Torque(Box::new(asked))),
        System::Signals(of) => {
            signals::Request::of(of).map(|asked| Model::Signals(Arc::new(asked)))
        }
        System::Identify(of) => {
            identify::Request::of(of).map(|asked| Model::Identify(Box::new(asked)))
        }
        System::CoastDown(of) => {
            coast_down::build::alone(of).map(|built| Model::CoastDown(of, Box::new(built)))
        }
        System::Rotor(of) => rotor::Request::of(of).map(|asked| Model::Rotor(Arc::new(asked))),
        System::Rig(of) => rig::build::rig(of).map(|built| Model::Rig(of, Box::new(built))),
    };
    let system = system.map_err(|problem| scenario.locate(problem))?;
    Ok(Machine {
        scenario,
        system,
        measured: Arc::default(),
    })
}

/// The results that only the other cases of a scenario have.
///
/// # Errors
/// What is wrong with one of them, a limit of it among others.
pub fn of_other_cases(scenario: &Scenario, own: &Machine) -> Result<Vec<Quantity>> {
    let mut known = own.results();
    let count = known.len();
    let cases = scenario.system.cases();
    for case in cases.others() {
        let other = scenario.with(&[(CASE.to_string(), case.to_string())])?;
        for own in build(&other)?.results() {
            if known.iter().all(|known| known.name != own.name) {
                known.push(own);
            }
        }
    }
    Ok(known.split_off(count))
}

impl Machine<'_> {
    /// Simulates it. A run that fails is an [`Outcome`] whose `stop` says where and why.
    pub fn run(&self, options: &Options) -> Outcome {
        self.run_kept(options, &Nowhere)
    }

    /// The same; a repetition keeps its members in a store as they end, and goes on from those that are there.
    pub fn run_kept(&self, options: &Options, store: &dyn Store) -> Outcome {
        let (mut outcome, seconds) = host::timed(|| self.computed(options, store));
        outcome.work.seconds = seconds;
        self.judged(outcome)
    }

    /// How many members its run has.
    pub fn members(&self) -> usize {
        match &self.system {
            Model::Drop(built, _) => study::repeat::count(&built.drop),
            _ => 1,
        }
    }

    /// What came out of the machine that was driven from outside until now, judged as a run of it.
    pub fn outcome(&self, driven: &mut Driven) -> Outcome {
        self.judged(driven.outcome_from_outside())
    }

    /// Beside measured channels, with what was known before, and with its limits.
    fn judged(&self, mut outcome: Outcome) -> Outcome {
        measured::add(&self.measured, &mut outcome);
        outcome.work.members = outcome.work.members.max(1);
        outcome.warnings = known::joined(self.warnings().into_iter(), outcome.warnings);
        outcome.limits = limits::of(self.scenario, &outcome, &warnings::of(self.scenario));
        measured::warnings::reserve(&mut outcome.limits, &outcome.warnings);
        outcome
    }

    /// The machine at its start, to be driven from outside.
    ///
    /// # Errors
    /// Where nothing moves in time, or temperatures act on the motion.
    pub fn simulation(&self) -> Result<Simulation> {
        let driven = match &self.system {
            Model::Drop(built, _) => Simulation::of_drop(self.scenario, built),
            Model::SpinUp(of, built) => Ok(spin_up::simulation(of, built)),
            Model::Rig(of, built) => Ok(rig::simulation(of, built)),
            _ => {
                let found = self.scenario.system.name().word().to_string();
                let needed =
                    "a drop, a machine, a spin-up or a rig is needed: nothing else moves in time";
                Err(problem_at(Code::Impossible, "system", found, needed))
            }
        };
        driven.map_err(|problem| self.scenario.locate(problem))
    }

    /// The machine at its start without the controllers of its magnets, to be driven from outside with all that its run shows.
    ///
    /// # Errors
    /// Where it is no drop and no machine, takes no such commands, or is to coast on until its standstill.
    pub fn driven(&self, way: Driving) -> Result<Driven> {
        let driven = match &self.system {
            Model::Drop(built, _) => Driven::new(self.scenario, built, way),
            _ => {
                let found = self.scenario.system.name().word().to_string();
                let needed = "a drop or a machine is needed: nothing else has magnets to drive";
                Err(problem_at(Code::Impossible, "system", found, needed))
            }
        };
        driven.map_err(|problem| self.scenario.locate(problem))
    }

    fn computed(&self, options: &Options, store: &dyn Store) -> Outcome {
        match &self.system {
            Model::Drop(built, others) => self.dropped(built, others, options, store),
            Model::SpinUp(of, built) => spin_up::run(self.scenario, of, built, options),
            Model::Torque(asked) => torque::run(self.scenario, asked),
            Model::Signals(asked) => signals::run(self.scenario, asked, options),
            Model::Identify(asked) => identify::run(self.scenario, asked, options),
            Model::Rotor(asked) => rotor::run(self.scenario, asked, options),
            Model::CoastDown(of, built) => coast_down::run(self.scenario, of, built, options),
            Model::Rig(of, built) => rig::run(self.scenario, of, built, options),
        }
    }

    fn dropped(
        &self,
        built: &Arc<drop::build::DropModel>,
        others: &[Arc<study::repeat::Member>],
        options: &Options,
        store: &dyn Store,
    ) -> Outcome {
        let mut outcome = study::repeat::run(self.scenario, built, others, options, store);
        if let Some(shaft) = &built.drop.shaft {
            let changes = cutoff::changes(self.scenario, shaft, &outcome.quantities, options);
            outcome.quantities.extend(changes);
        }
        outcome
    }

    /// The columns of a run's history, without values; each `*` in a name stands for what only a run or its data decide.
    pub fn columns(&self) -> Vec<Column> {
        let mut columns = self.computed_columns();
        columns.extend(measured::columns(&self.measured, &[]));
        columns
    }

    fn computed_columns(&self) -> Vec<Column> {
        match &self.system {
            Model::Drop(built, _) => drop::columns(built),
            Model::SpinUp(of, built) => spin_up::columns(of, built),
            Model::Rig(of, built) => rig::columns(of, built),
            Model::CoastDown(_, built) => coast_down::columns(built),
            Model::Torque(asked) => torque::columns(asked),
            Model::Signals(asked) => signals::columns(asked),
            Model::Identify(asked) => identify::columns(asked),
            Model::Rotor(asked) => rotor::columns(asked),
        }
    }

    /// The results of a run, without values; each `*` in a name stands for what only a run or its data decide.
    pub fn results(&self) -> Vec<Quantity> {
        let mut results = self.computed_results();
        results.extend(measured::name(&self.measured, None));
        results
    }

    fn computed_results(&self) -> Vec<Quantity> {
        match &self.system {
            Model::Drop(built, _) => {
                let mut list = drop::results(built);
                let shaft = built.drop.shaft.as_ref();
                if shaft.is_some_and(|shaft| shaft.cutoff_check.is_some()) {
                    list.extend(cutoff::name(&list, None));
                }
                list
            }
            Model::SpinUp(of, built) => spin_up::results(of, built),
            Model::Rig(of, built) => rig::results(of, built),
            Model::CoastDown(_, built) => coast_down::results(built),
            Model::Torque(asked) => torque::results(asked),
            Model::Signals(asked) => signals::results(asked),
            Model::Identify(asked) => identify::results(asked),
            Model::Rotor(asked) => rotor::results(asked),
        }
    }
}

/// Builds and simulates what the scenario describes.
pub fn run(scenario: &Scenario, options: &Options) -> Result<Outcome> {
    Ok(build(scenario)?.run(options))
}
