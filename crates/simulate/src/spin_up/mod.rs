//! Runs a spin-up and names what came out: a bearing on a [`rig`](crate::rig) without clutch and housing.

pub mod build;
mod columns;
mod quantities;
pub mod warnings;

use crate::rig::run::{RigModel, RigRun, RunInput};
use crate::simulation::Simulation;
use crate::stepping::StepRequest;
use outcome::options::Options;
use outcome::{Column, Outcome, Quantity};
use scenario::{Scenario, SpinUp};
use std::ops::Deref;

/// Tolerance of design accuracy: the energies of the shipped spin-ups close to a millionth of what is turned over.
const DESIGN: f64 = 5e-5;
/// Tolerance of linearly implicit steps at screening accuracy: what friction takes is as small as the creep of the balls.
const SCREENING: f64 = 2e-3;

/// A spin-up and its run.
pub(crate) struct Context<'a> {
    spin_up: &'a SpinUp,
    run: RigRun<'a>,
}

impl<'a> Deref for Context<'a> {
    type Target = RigRun<'a>;
    fn deref(&self) -> &RigRun<'a> {
        &self.run
    }
}

/// The columns of its history, without values.
pub fn columns(spin_up: &SpinUp, built: &RigModel) -> Vec<Column> {
    columns::history(spin_up, built, None)
}

/// The results of a spin-up, without values.
pub fn results(spin_up: &SpinUp, built: &RigModel) -> Vec<Quantity> {
    quantities::name(spin_up, built, None)
}

/// A spin-up at its start, to be driven from outside.
pub fn simulation(spin_up: &SpinUp, built: &RigModel) -> Simulation {
    let machine = built.machine.clone();
    let start = machine.start();
    let stepping = asked(spin_up, built).stepping(|| 0.0);
    Simulation::of(machine, &start, &spin_up.run, stepping)
}

/// What decides the steps of a spin-up.
fn asked<'a>(spin_up: &'a SpinUp, built: &RigModel) -> StepRequest<'a> {
    StepRequest {
        run: &spin_up.run,
        known: built.machine.tangents(),
        quickest_mode: 0.0,
        design: [DESIGN; 2],
        screening: SCREENING,
    }
}

/// What a file gives of bearing and run.
fn given(spin_up: &SpinUp) -> RunInput<'_> {
    RunInput {
        bearing: &spin_up.bearing,
        warm: spin_up.warm.as_deref(),
        run: &spin_up.run,
    }
}

/// Runs a spin-up.
pub fn run(scenario: &Scenario, spin_up: &SpinUp, built: &RigModel, options: &Options) -> Outcome {
    let stepping = asked(spin_up, built).stepping(|| 0.0);
    let run = RigRun::of(built, given(spin_up), stepping, &[], options);
    let context = Context { spin_up, run };
    let quantities = quantities::name(spin_up, built, Some(&context));
    let title = (scenario.title.clone()).unwrap_or_else(|| "Spin-up of an inner race".to_string());
    Outcome {
        system: "spin_up",
        title,
        history: columns::history(spin_up, built, Some(&context)),
        warnings: warnings::of(scenario, &context, &quantities),
        quantities,
        ..context.outcome()
    }
}
