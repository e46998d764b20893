//! Runs a test on a rig, names what came out, and writes what its logger would have written.
//!
//! | page | subject |
//! |---|---|
//! | [`build`] | scenario → constants of the model |
//! | `chain` | from what happened to what the logger writes |
//! | `raw_file` | the raw file, and the file that says what its channels are |
//! | `thermocouple` | its reading of an outer race whose temperature a network gives |
//! | `columns`, `quantities`, `warnings` | what happened, by names |

pub mod build;
mod chain;
mod columns;
mod context;
mod quantities;
mod raw_file;
mod thermocouple;
pub mod warnings;

use crate::bearing::warm::Followed;
use crate::bearing::warming::{Warming, Watched};
use crate::ending::{settings, stop};
use crate::rig::context::Context;
use crate::stepping;
use build::Built;
use chain::{Happened, Sampled};
use model::system::rig::layout::{ARM, CAGE_ANGLE, SHAFT, THERMOCOUPLE};
use model::system::rig::record::Keep;
use model::system::rig::{Record, RigMachine, simulate};
use outcome::options::Options;
use outcome::{Column, Outcome, Picture, Quantity, Work};
use scenario::{Rig, RigProgram, Scenario};
use std::iter;
use thermal::bearing_network::OUTER_RACE;
use thermocouple::Bead;

/// The columns of its history, without values.
pub fn columns(rig: &Rig, built: &Built) -> Vec<Column> {
    columns::history(rig, built, None)
}

/// The results of a test, without values.
pub fn results(rig: &Rig, built: &Built) -> Vec<Quantity> {
    quantities::name(rig, built, None)
}

/// Runs a test.
pub fn run(scenario: &Scenario, rig: &Rig, built: &Built, options: &Options) -> Outcome {
    let machine = &built.machine;
    let taps = chain::taps(rig);
    let end = rig.run.duration;
    let keep = Keep {
        end,
        interval: Some(rig.run.output_interval),
        taps: &taps,
    };
    let (given, part) = (rig.warm.as_deref(), built.warm.as_deref());
    let warming = Warming::of(given, &rig.bearing, part);
    let mut watched = Watched::new(Record::new(machine, &keep), warming, end, options);
    let settings = settings(&rig.run);
    let ending = simulate(machine, &settings, &mut watched, options.interrupt);
    let (mut record, warming, at_end) = watched.finish(machine, &ending);
    record.finish(&at_end, ending.time, &ending.state);
    let bead = warming.as_ref().map(|warming| bead(rig, warming));
    let happened = happened(rig, &record, bead.as_ref());
    let raw = chain::raw(rig, &happened);
    let context = Context {
        rig,
        built,
        start: &machine.start(),
        record: &record,
        ending: &ending,
        warming: warming.as_ref(),
        bead: bead.as_ref(),
        clipped: raw
            .iter()
            .filter(|channel| channel.clipped > 0)
            .map(|channel| (channel.name, channel.clipped))
            .collect(),
    };
    let title = (scenario.title.clone()).unwrap_or_else(|| "Test on a rig".to_string());
    let quantities = quantities::name(rig, built, Some(&context));
    let rolling_cage_ratio = machine.constants.bearing.rolling_cage_ratio();
    Outcome {
        system: "rig",
        history: columns::history(rig, built, Some(&context)),
        warnings: warnings::of(scenario, &context, &quantities),
        quantities,
        stop: stop(&ending),
        work: Work {
            steps: ending.work.accepted,
            rejected: ending.work.rejected,
            rate_calls: ending.work.rate_calls,
            method: Some(stepping::EXPLICIT),
            ..Work::default()
        },
        pictures: vec![Picture {
            bearing: String::new(),
            clearance: None,
            pressure_limit: Some(rig.bearing.hertz_pressure_limit),
            rolling_cage_ratio,
            balls: rig.bearing.ball_count,
        }],
        files: raw_file::files(rig, &title, raw, rolling_cage_ratio, rested(rig, &happened)),
        title,
        ..Outcome::default()
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
fn bead(rig: &Rig, warming: &Warming<RigMachine>) -> Bead {
    let Followed { heated, warmth, .. } = warming.followed();
    let course = (warmth.course.iter()).map(|(time, nodes)| (*time, nodes[OUTER_RACE]));
    Bead::new(
        rig.temperature.lag,
        iter::once((0.0, heated.part.start)).chain(course),
    )
}

fn happened(rig: &Rig, record: &Record, bead: Option<&Bead>) -> Happened {
    // a logger keeps whole scans
    let scans = record.taps.iter().map(|(_, values)| values.len()).min();
    let sampled = |channel: usize| {
        let tap = record.taps.iter().find(|(tap, _)| tap.channel == channel);
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
