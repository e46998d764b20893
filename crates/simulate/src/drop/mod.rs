//! Runs a drop and names what came out.

mod body;
pub mod build;
pub(crate) mod columns;
pub(crate) mod context;
pub mod each;
pub mod ensemble;
mod feedback;
mod glide;
mod layers;
pub(crate) mod magnets;
mod magnets_in_time;
pub mod members;
pub(crate) mod method;
mod mount;
mod mount_results;
pub(crate) mod orders;
pub(crate) mod quantities;
mod returns;
pub(crate) mod run_out;
mod run_out_warnings;
pub mod shaft;
pub mod shaft_results;
mod slow_time;
pub(crate) mod surfaces;
mod torque;
pub mod warning_table;
pub(crate) mod warnings;
mod went;
mod window;
mod windows;

pub use body::{Drop, Shaft};

use crate::bearing::races::{LIFE_BY_POINT, without_count};
use crate::drop::build::Built;
use crate::drop::context::{Context, Setup};
use crate::drop::ensemble::{Finished, Member, Plan};
use crate::drop::members::Varied;
use crate::drop::run_out::After;
use crate::ending::settings_at;
use crate::stepping::Stepping;
use model::system::machine::RotorMachine;
use outcome::options::Options;
use outcome::{Column, Contact, Members, Outcome, Picture, Quantity, Spread, Stop, Value, Work};
use rayon::prelude::*;
use scenario::Scenario;
use std::time::Instant;

/// The columns of its history, without values.
pub fn columns(built: &Built) -> Vec<Column> {
    let machine = &RotorMachine::new(built.constants.clone());
    let setup = Setup { built, machine };
    columns::history(setup, None)
}

/// The results of a drop, without values.
pub fn results(built: &Built) -> Vec<Quantity> {
    let machine = &RotorMachine::new(built.constants.clone());
    let setup = Setup { built, machine };
    let mut list = quantities::name(setup, None);
    if built.drop.run_out.is_some() {
        list.extend(run_out::results(setup));
    }
    list.extend(orders::named(setup.parts(), None));
    list
}

/// Runs a drop.
pub fn run(scenario: &Scenario, built: &Built, varied: &[Varied], options: &Options) -> Outcome {
    let drop = &built.drop;
    let count = drop.repeat.count.max(1) as usize;
    let members: Vec<Member> = members::of(built, varied);
    let stepping = method::stepping(built, members[0].machine.tangents());
    let clock = Instant::now();
    let finished = ensemble::run(
        &members,
        &Plan {
            settings: settings_at(&drop.run, stepping.tolerance),
            steps: stepping.steps,
            interval: drop.run.output_interval,
            until_rolling: drop.run_out.is_some(),
            threads: options.threads,
            interrupt: options.interrupt,
            progress: options.progress,
        },
    );

    let given = |k: usize| {
        let own = k.checked_sub(1).and_then(|k| varied.get(k));
        own.map_or(built, |varied| &varied.built)
    };
    let context = |k: usize| Context {
        setup: Setup {
            built: given(k),
            machine: &members[k].machine,
        },
        finished: &finished[k],
        members: count,
    };
    let contexts: Vec<Context> = (0..count).map(context).collect();
    let first = &contexts[0];
    let after: Vec<Option<After>> = (contexts.par_iter())
        .map(|context| run_out::after(context, options.interrupt))
        .collect();
    let seconds = clock.elapsed().as_secs_f64();
    let stop_of = |k: usize| match &after[k] {
        Some(after) => after.stop.clone(),
        None => magnets::stop(&contexts[k]),
    };
    let name = |k: usize| {
        let mut list = run_out::quantities(&contexts[k], after[k].as_ref());
        if !stop_of(k).complete() {
            without_count(&mut list);
        }
        list
    };
    let mut named = name(0);
    let mut table = Members::ended_at(drop.run.duration);
    let mut drawn = Vec::new();
    if count > 1 {
        // a member that did not end as planned would pull every mean
        let whole = || (0..count).filter(|k| stop_of(*k).complete());
        if !varied.is_empty() {
            let draws = |k: usize| k.checked_sub(1).map(|k| varied[k].drawn.clone());
            drawn = whole().map(|k| draws(k).unwrap_or_default()).collect();
        }
        let all: Vec<Vec<Quantity>> = whole().map(name).collect();
        for quantity in &mut named {
            if quantity.name.ends_with(LIFE_BY_POINT) {
                quantity.value = mean_of(&all, &quantity.name);
            }
        }
        for results in all {
            table.push(results);
        }
        let least = chaotic_from(scenario, drop);
        for quantity in &mut named {
            quantity.spread =
                Spread::of(table.values(&quantity.name).into_iter().flatten().collect());
            let deviation = quantity.spread.map_or(0.0, |of| of.relative_deviation());
            quantity.chaotic = least.is_some_and(|least| deviation > least)
                // what a ledger misses is an error of the integration, and has no size of its own
                && !quantity.name.ends_with("residual");
        }
    }
    let history = columns::history(first.setup, Some(first));
    let counted = Some((history.as_slice(), first.counted_from()));
    named.extend(orders::named(first.setup.parts(), counted));
    Outcome {
        system: scenario.system.name().word(),
        title: scenario
            .title
            .clone()
            .unwrap_or_else(|| "Drop of a levitated rotor".to_string()),
        quantities: named,
        history,
        contacts: contacts(first),
        warnings: warnings::of(scenario, &contexts, &after),
        stop: worst_stop(count, &stop_of),
        work: work(&finished, &after, seconds, stepping),
        members: table,
        drawn,
        limits: Vec::new(),
        pictures: (0..drop.auxiliary_bearings.len())
            .map(|k| picture(first, k))
            .collect(),
        files: Vec::new(),
    }
}

/// Mean of a list over the members that have it.
fn mean_of(members: &[Vec<Quantity>], name: &str) -> Value {
    let lists = members
        .iter()
        .flatten()
        .filter_map(|found| match &found.value {
            Value::List(values) if found.name == name => Some(values),
            _ => None,
        });
    let (mut sum, mut count) = (Vec::new(), 0.0);
    for values in lists {
        sum.resize(values.len(), 0.0);
        for (sum, value) in sum.iter_mut().zip(values) {
            *sum += value;
        }
        count += 1.0;
    }
    Value::List(sum.into_iter().map(|sum: f64| sum / count).collect())
}

/// Relative deviation of members that starts make chaotic: below it no reader sees it.
const SEEN: f64 = 1e-3;
/// How much larger than that of the starts it must be at least.
const AMPLIFIED: f64 = 1e3;

/// Relative deviation of the members from which a result is chaotic: far above that of their starts. None where their machines
/// differ, which is another reason to differ.
fn chaotic_from(scenario: &Scenario, drop: &Drop) -> Option<f64> {
    if !scenario.vary.is_empty() {
        return None;
    }
    let clearances = drop.auxiliary_bearings.iter();
    let smallest = clearances
        .map(|part| part.contact.radial_air_clearance)
        .fold(f64::INFINITY, f64::min);
    let repeat = &drop.repeat;
    let of_starts = (repeat.rotor_position_deviation / smallest).max(repeat.ball_angle_deviation);
    Some(SEEN.max(AMPLIFIED * of_starts))
}

/// What pictures need of an auxiliary bearing.
fn picture(context: &Context, k: usize) -> Picture {
    let part = &context.setup.machine.constants.bearings[k];
    let given = context.setup.given(k);
    Picture {
        bearing: part.name.clone(),
        clearance: Some(given.contact.radial_air_clearance),
        pressure_limit: (given.bearing.as_ref()).map(|bearing| bearing.hertz_pressure_limit),
        rolling_cage_ratio: part.bearing.rolling_cage_ratio(),
        balls: part.bearing.balls(),
    }
}

/// The contacts of all auxiliary bearings, in order.
fn contacts(context: &Context) -> Vec<Contact> {
    let mut all: Vec<Contact> = (context.setup.parts().enumerate())
        .flat_map(|(k, name)| {
            context.record(k).contacts.iter().map(move |c| Contact {
                bearing: name.to_string(),
                start: c.start,
                end: c.end,
                peak_force: c.peak_force,
                peak_time: c.peak_time,
            })
        })
        .collect();
    all.sort_by(|a, b| a.start.total_cmp(&b.start));
    all
}

/// The ending of the unperturbed run; if that is whole, of the first member that is not.
fn worst_stop(members: usize, stop_of: &dyn Fn(usize) -> Stop) -> Stop {
    let first = stop_of(0);
    if !first.complete() || members == 1 {
        return first;
    }
    let all = || (0..members).map(stop_of);
    match all().enumerate().find(|(_, stop)| !stop.complete()) {
        Some((k, mut stop)) => {
            stop.text = format!(
                "Member {k} of the repetition: {} {} of {members} members are whole; only these enter the spread.",
                stop.text,
                all().filter(Stop::complete).count(),
            );
            stop
        }
        None => first,
    }
}

fn work(finished: &[Finished], after: &[Option<After>], seconds: f64, stepping: Stepping) -> Work {
    let mut work = Work {
        members: finished.len(),
        seconds,
        method: Some(stepping.name()),
        ..Work::default()
    };
    work.steps = after.iter().flatten().map(|after| after.steps).sum();
    for member in finished {
        work.steps += member.ending.work.accepted;
        work.rejected += member.ending.work.rejected;
        work.rate_calls += member.ending.work.rate_calls;
    }
    work
}
