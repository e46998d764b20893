//! Runs a test on a rig, names what came out, and writes what its logger would have written.
//!
//! | page | subject |
//! |---|---|
//! | [`build`] | scenario → constants of the model |
//! | `chain` | from what happened to what the logger writes |
//! | `raw_file` | the raw file, and the file that says what its channels are |
//! | `columns`, `quantities`, `warnings` | what happened, by names |

pub mod build;
mod chain;
mod columns;
mod context;
mod quantities;
mod raw_file;
pub(crate) mod warnings;

use crate::options::Options;
use crate::result::outcome::{Members, Outcome, Picture, Work};
use crate::scenario::{Rig, RigProgram, Scenario};
use crate::simulate::ending::{settings, stop};
use crate::simulate::rig::context::Context;
use crate::simulate::stepping;
use build::Built;
use chain::{Happened, Sampled};
use model::system::rig::layout::{ARM, CAGE_ANGLE, SHAFT, THERMOCOUPLE};
use model::system::rig::record::Keep;
use model::system::rig::{Record, simulate_with_progress};
use std::time::Instant;

/// Runs a test.
pub(crate) fn run(scenario: &Scenario, rig: &Rig, built: &Built, options: &Options) -> Outcome {
    let machine = &built.machine;
    let clock = Instant::now();
    let taps = chain::taps(rig);
    let end = rig.run.duration;
    let keep = Keep {
        end,
        interval: Some(rig.run.output_interval),
        taps: &taps,
    };
    let mut record = Record::new(machine, &keep);
    let run = simulate_with_progress(
        machine,
        &settings(&rig.run),
        &mut record,
        options.interrupt,
        options.progress,
    );
    let seconds = clock.elapsed().as_secs_f64();
    let happened = happened(rig, &record);
    let raw = chain::raw(rig, &happened);
    let context = Context {
        rig,
        built,
        start: &run.start,
        record: &record,
        ending: &run.ending,
        mode: run.mode,
        clipped: raw
            .iter()
            .filter(|channel| channel.clipped > 0)
            .map(|channel| (channel.name, channel.clipped))
            .collect(),
    };
    let title = (scenario.title.clone()).unwrap_or_else(|| "Test on a rig".to_string());
    let quantities = quantities::name(&context);
    let rolling_cage_ratio = machine.constants.bearing.rolling_cage_ratio();
    Outcome {
        system: "rig",
        history: columns::history(&context),
        contacts: Vec::new(),
        warnings: warnings::of(scenario, &context, &quantities),
        quantities,
        stop: stop(&run.ending),
        work: Work {
            members: 1,
            steps: run.ending.work.accepted,
            rejected: run.ending.work.rejected,
            rate_calls: run.ending.work.rate_calls,
            seconds,
            method: Some(stepping::EXPLICIT),
        },
        members: Members::default(),
        drawn: Vec::new(),
        limits: Vec::new(),
        pictures: vec![Picture {
            bearing: String::new(),
            clearance: None,
            pressure_limit: Some(rig.bearing.hertz_pressure_limit),
            rolling_cage_ratio,
            balls: rig.bearing.ball_count,
        }],
        files: raw_file::files(rig, &title, raw, rolling_cage_ratio, rested(rig, &happened)),
        title,
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

fn happened(rig: &Rig, record: &Record) -> Happened {
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
    Happened {
        shaft_angle: sampled(SHAFT),
        shaft_speed: sampled(SHAFT + 1),
        arm: sampled(ARM),
        cage_angle: sampled(CAGE_ANGLE),
        thermocouple: sampled(THERMOCOUPLE),
        begin: chain::begin(rig),
    }
}
