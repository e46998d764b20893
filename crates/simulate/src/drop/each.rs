//! Many drops of machines that differ: each a single run, in lanes and threads with those of its kind.

use crate::drop::build::{self, Built};
use crate::drop::context::{Context, Setup};
use crate::drop::ensemble::{self, Finished, Member, Plan};
use crate::drop::feedback::Following;
use crate::drop::members::{Kind, kind_of, share_lanes};
use crate::drop::method::stepping;
use crate::drop::{run_out, warnings};
use crate::ending::{settings_at, stop};
use crate::stepping::Stepping;
use model::system::machine::RotorMachine;
use outcome::Single;
use outcome::options::Options;
use problem::Problem;
use rayon::prelude::*;
use scenario::{Drop, Scenario};
use std::sync::{Arc, Mutex};

/// A drop that is ready to run.
pub struct One<'a> {
    /// What was written.
    pub scenario: &'a Scenario,
    /// The drop in it.
    pub built: Built,
    machine: Arc<RotorMachine>,
    stepping: Stepping,
    kind: Kind,
}

/// Builds a drop of its scenario.
pub fn one<'a>(scenario: &'a Scenario, given: &Drop) -> Result<One<'a>, Box<Problem>> {
    let built = build::drop(given)?;
    let machine = Arc::new(RotorMachine::new(built.constants.clone()));
    Ok(One {
        scenario,
        stepping: stepping(&built, machine.tangents()),
        kind: kind_of(scenario),
        built,
        machine,
    })
}

/// Runs all of them; they stand in their order.
pub fn run(all: &[One], options: &Options) -> Vec<Single> {
    // those that can share lanes and settings
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (k, one) in all.iter().enumerate() {
        let fits = |group: &&mut Vec<usize>| {
            let first = &all[group[0]];
            first.kind == one.kind
                && first.stepping == one.stepping
                && first.built.drop.run == one.built.drop.run
                && share_lanes(&first.machine, &one.machine)
        };
        match groups.iter_mut().find(fits) {
            Some(group) => group.push(k),
            None => groups.push(vec![k]),
        }
    }
    let done = Mutex::new(vec![0.0; groups.len()]);
    let of_group = |(at, group): (usize, &Vec<usize>)| {
        let progress = |fraction: f64| {
            if let Ok(mut done) = done.lock() {
                done[at] = fraction * group.len() as f64;
                (options.progress)(done.iter().sum::<f64>() / all.len() as f64);
            }
        };
        together(all, group, options, &progress)
    };
    let finished: Vec<Vec<Single>> = groups.par_iter().enumerate().map(of_group).collect();
    let mut list: Vec<Option<Single>> = all.iter().map(|_| None).collect();
    for (place, result) in groups
        .into_iter()
        .flatten()
        .zip(finished.into_iter().flatten())
    {
        list[place] = Some(result);
    }
    list.into_iter().flatten().collect()
}

/// Drops of one kind.
fn together(
    all: &[One],
    group: &[usize],
    options: &Options,
    progress: &(dyn Fn(f64) + Sync),
) -> Vec<Single> {
    let members: Vec<Member> = group.iter().map(|k| member(&all[*k])).collect();
    let first = &all[group[0]];
    let finished = ensemble::run(
        &members,
        &Plan {
            settings: settings_at(&first.built.drop.run, first.stepping.tolerance),
            steps: first.stepping.steps,
            interval: first.built.drop.run.output_interval,
            until_rolling: first.built.drop.run_out.is_some(),
            // those of the pool in which this is called
            threads: None,
            interrupt: options.interrupt,
            progress,
        },
    );
    let named = |(k, finished): (&usize, &Finished)| {
        let one = &all[*k];
        let context = Context {
            setup: Setup {
                built: &one.built,
                machine: &one.machine,
            },
            finished,
            members: 1,
        };
        let after = run_out::after(&context, options.interrupt);
        let quantities = run_out::quantities(&context, after.as_ref());
        let ended = match &after {
            Some(after) => after.stop.clone(),
            None => stop(&finished.ending),
        };
        Single {
            quantities,
            warnings: warnings::of(one.scenario, &[context], &[after]),
            stop: ended,
        }
    };
    group.iter().zip(&finished).map(named).collect()
}

/// The machine with its start; its history is not kept.
fn member(one: &One) -> Member {
    let start = match &one.built.shaft {
        Some(shaft) => one.machine.start_with(&shaft.position, &shaft.velocity),
        None => one.machine.start(),
    };
    Member {
        machine: one.machine.clone(),
        following: Following::of(&one.built.drop).map(Arc::new),
        start,
        keep_rows: false,
        kind: 0,
    }
}
