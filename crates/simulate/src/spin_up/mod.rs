//! Runs a spin-up and names what came out.

pub mod build;
pub(crate) mod columns;
pub(crate) mod context;
pub(crate) mod quantities;
pub mod warnings;

use crate::bearing::warming::{Warming, Watched};
use crate::ending::{settings_at, stop};
use crate::spin_up::build::Built;
use crate::spin_up::context::{Context, asked};
use crate::stepping::Stepping;
use model::system::spin_up::SpinUpMachine;
use model::system::spin_up::record::Record;
use model::system::spin_up::simulate::simulate;
use outcome::options::Options;
use outcome::{Column, Outcome, Picture, Quantity, Work};
use scenario::{Scenario, SpinUp};
use solve::Ending;

/// The columns of its history, without values.
pub fn columns(spin_up: &SpinUp, built: &Built) -> Vec<Column> {
    columns::history(spin_up, built, None)
}

/// The results of a spin-up, without values.
pub fn results(spin_up: &SpinUp, built: &Built) -> Vec<Quantity> {
    quantities::name(spin_up, built, None)
}

/// Runs a spin-up.
pub fn run(scenario: &Scenario, spin_up: &SpinUp, built: &Built, options: &Options) -> Outcome {
    let start = built.machine.start();
    let stepping = asked(spin_up, built).stepping(|| 0.0);
    let (record, ending, warming) = integrate(built, &start, (spin_up, stepping), options);
    let context = Context {
        spin_up,
        built,
        start: &start,
        record: &record,
        ending: &ending,
        warming: warming.as_ref(),
    };
    let quantities = quantities::name(spin_up, built, Some(&context));
    Outcome {
        system: "spin_up",
        title: scenario
            .title
            .clone()
            .unwrap_or_else(|| "Spin-up of an inner race".to_string()),
        history: columns::history(spin_up, built, Some(&context)),
        warnings: warnings::of(scenario, &context, &quantities),
        quantities,
        stop: stop(&ending),
        work: Work {
            steps: ending.work.accepted,
            rejected: ending.work.rejected,
            rate_calls: ending.work.rate_calls,
            method: Some(stepping.name()),
            ..Work::default()
        },
        pictures: vec![Picture {
            bearing: String::new(),
            clearance: None,
            pressure_limit: Some(spin_up.bearing.hertz_pressure_limit),
            rolling_cage_ratio: built.machine.constants.bearing.rolling_cage_ratio(),
            balls: spin_up.bearing.ball_count,
        }],
        ..Outcome::default()
    }
}

fn integrate<'a>(
    built: &'a Built,
    start: &[f64],
    (spin_up, stepping): (&'a SpinUp, Stepping),
    options: &Options<'a>,
) -> (Record, Ending, Option<Warming<'a, SpinUpMachine>>) {
    let machine = &built.machine;
    let settings = settings_at(&spin_up.run, stepping.tolerance);
    let end = settings.end;
    let record = Record::new(machine, end, spin_up.run.output_interval, true);
    let (given, part) = (spin_up.warm.as_deref(), built.warm.as_deref());
    let warming = Warming::of(given, &spin_up.bearing, part);
    let mut watched = Watched::new(record, warming, end, options);
    let (steps, interrupt) = (stepping.steps, options.interrupt);
    let ending = simulate(machine, start, &settings, steps, &mut watched, interrupt);
    let (mut record, warming, at_end) = watched.finish(machine, &ending);
    record.finish(&at_end, ending.time, &ending.state);
    (record, ending, warming)
}
