//! Runs a test on a rig, names what came out, and writes what its logger would have written.
//!
//! | page | subject |
//! |---|---|
//! | [`build`] | scenario → constants of the model |
//! | [`run`](mod@run) | a run of a bearing on a rig, of a spin-up or of a test |
//! | `chain` | from what happened to what the logger writes |
//! | `raw_file` | the raw file, and the file that says what its channels are |
//! | `thermocouple` | its reading of an outer race whose temperature a network gives |
//! | `columns`, `quantities`, `warnings` | what happened, by names |

pub mod build;
mod chain;
mod columns;
mod quantities;
mod raw_file;
pub mod run;
mod thermocouple;
pub mod warnings;

use crate::bearing::warm::Followed;
use crate::ending::DESIGN;
use crate::simulation::Simulation;
use crate::stepping::Stepping;
use chain::{Happened, Sampled};
use model::system::rig::Taps;
use model::system::rig::layout::{ARM, CAGE_ANGLE, SHAFT, THERMOCOUPLE};
use outcome::options::Options;
use outcome::{Column, Outcome, Quantity};
use run::{RigModel, RigRun, RunInput};
use scenario::{Rig, RigProgram, Scenario};
use solve::Steps;
use std::iter;
use std::ops::Deref;
use thermal::bearing_network::OUTER_RACE;
use thermocouple::Bead;

/// A test and its run.
pub(crate) struct Context<'a> {
    rig: &'a Rig,
    run: RigRun<'a>,
    /// What the thermocouple reads of an outer race whose temperature a network follows.
    bead: Option<Bead>,
    /// Values that the converter could not hold, with the channel's name.
    clipped: Vec<(&'static str, usize)>,
}

impl<'a> Deref for Context<'a> {
    type Target = RigRun<'a>;
    fn deref(&self) -> &RigRun<'a> {
        &self.run
    }
}

/// The columns of its history, without values.
pub fn columns(rig: &Rig, built: &RigModel) -> Vec<Column> {
    columns::history(rig, built, None)
}

/// The results of a test, without values.
pub fn results(rig: &Rig, built: &RigModel) -> Vec<Quantity> {
    quantities::name(rig, built, None)
}

/// What a file gives of bearing and run.
fn given(rig: &Rig) -> RunInput<'_> {
    RunInput {
        bearing: &rig.bearing,
        warm: rig.warm.as_deref(),
        run: &rig.run,
    }
}

/// Explicit steps of design accuracy: the logger reads between them.
const STEPPING: Stepping = Stepping {
    steps: Steps::Explicit,
    tolerance: DESIGN,
};

/// A test at its start, to be driven from outside.
pub fn simulation(rig: &Rig, built: &RigModel) -> Simulation {
    let machine = built.machine.clone();
    let start = machine.start();
    Simulation::of(machine, &start, &rig.run, STEPPING)
}

/// Runs a test.
pub fn run(scenario: &Scenario, rig: &Rig, built: &RigModel, options: &Options) -> Outcome {
    let run = RigRun::of(built, given(rig), STEPPING, &chain::taps(rig), options);
    let bead = run.followed().map(|followed| bead(rig, &followed));
    let happened = happened(rig, &run.rig().taps, bead.as_ref());
    let raw = chain::raw(rig, &happened);
    let clipped = raw.iter().filter(|channel| channel.clipped > 0);
    let context = Context {
        rig,
        bead,
        clipped: clipped
            .map(|channel| (channel.name, channel.clipped))
            .collect(),
        run,
    };
    let title = (scenario.title.clone()).unwrap_or_else(|| "Test on a rig".to_string());
    let quantities = quantities::name(rig, built, Some(&context));
    let cage_ratio = built.machine.constants.bearings[0]
        .bearing
        .rolling_cage_ratio();
    Outcome {
        system: "rig",
        history: columns::history(rig, built, Some(&context)),
        warnings: warnings::of(scenario, &context, &quantities),
        quantities,
        files: raw_file::files(rig, &title, raw, cage_ratio, rested(rig, &happened)),
        title,
        ..context.outcome()
    }
}

/// Time at rest before the second of two spin-ups, s; none of one spin-up, or where the shaft never came to rest.
fn rested(rig: &Rig, happened: &Happened) -> Option<f64> {
    let RigProgram::RepeatAfterRest {
        engage_again_at, ..
    } = rig.program
    else {
        return None;
    };
    let angle = &happened.shaft_angle;
    let again = ((engage_again_at - angle.first) / angle.interval) as usize;
    let before = angle.values.get(..again.min(angle.values.len()))?;
    let last = before.last()?;
    let turning = (before.iter()).rposition(|angle| (angle - last).abs() > STANDING)?;
    let stopped = angle.first + angle.interval * (turning + 1) as f64;
    (stopped + angle.interval < engage_again_at).then_some(engage_again_at - stopped)
}

/// Angle within which a shaft counts as standing, rad: no mark of a pickup is as fine.
const STANDING: f64 = 1e-3;

/// The thermocouple on an outer race of a network.
fn bead(rig: &Rig, followed: &Followed) -> Bead {
    let Followed { heated, warmth, .. } = followed;
    let course = (warmth.course.iter()).map(|(time, nodes)| (*time, nodes[OUTER_RACE]));
    Bead::new(
        rig.temperature.lag,
        iter::once((0.0, heated.part.start)).chain(course),
    )
}

fn happened(rig: &Rig, taps: &Taps, bead: Option<&Bead>) -> Happened {
    // a logger keeps whole scans
    let scans = taps.iter().map(|(_, values)| values.len()).min();
    let sampled = |channel: usize| {
        let tap = taps.iter().find(|(tap, _)| tap.channel == channel);
        tap.map_or_else(Sampled::default, |(tap, values)| Sampled {
            first: tap.first,
            interval: tap.interval,
            values: values[..scans.unwrap_or(0)].to_vec(),
        })
    };
    let mut thermocouple = sampled(THERMOCOUPLE);
    if let Some(bead) = bead {
        let start = bead.at(0.0);
        for (k, value) in thermocouple.values.iter_mut().enumerate() {
            let time = thermocouple.first + k as f64 * thermocouple.interval;
            *value = bead.at(time) - start;
        }
    }
    Happened {
        shaft_angle: sampled(SHAFT.angle()),
        shaft_speed: sampled(SHAFT.spin()),
        arm: sampled(ARM),
        cage_angle: sampled(CAGE_ANGLE),
        thermocouple,
        begin: chain::begin(rig),
    }
}
