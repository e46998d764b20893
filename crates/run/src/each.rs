//! Many single runs of scenarios that differ.

use crate::{build, known};
use outcome::options::{Options, bounded};
use outcome::{Single, Stop};
use problem::Problem;
use rayon::prelude::*;
use scenario::{Scenario, System};
use simulate::drop::each::{self, One};
use std::sync::atomic::{AtomicUsize, Ordering};

fn not_built(problem: &Problem) -> Single {
    Single {
        quantities: Vec::new(),
        warnings: Vec::new(),
        stop: Stop {
            reason: "not built",
            time: 0.0,
            text: problem.to_string(),
        },
    }
}

/// Runs each scenario once; drops of one kind share lanes. A scenario that could not be read or built is a result that says
/// why. The numbers of one depend on its scenario alone.
pub fn each(scenarios: &[Result<Scenario, Box<Problem>>], options: &Options) -> Vec<Single> {
    let all = || of_pool(scenarios, options);
    let pool = (options.threads).map(|n| {
        rayon::ThreadPoolBuilder::new()
            .num_threads(bounded(n))
            .build()
    });
    match pool {
        Some(Ok(pool)) => pool.install(all),
        // the machine refuses more threads: the shared pool gives the same numbers
        _ => all(),
    }
}

/// A scenario on its way.
enum Stage<'a> {
    Drop(Box<One<'a>>),
    Done(Single),
}

fn of_pool(scenarios: &[Result<Scenario, Box<Problem>>], options: &Options) -> Vec<Single> {
    let done = AtomicUsize::new(0);
    let stages: Vec<Stage> = (scenarios.par_iter())
        .map(|scenario| {
            let stage = staged(scenario, options);
            if matches!(stage, Stage::Done(_)) {
                let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                (options.progress)(done as f64 / scenarios.len() as f64);
            }
            stage
        })
        .collect();
    let before = done.into_inner();
    let mut places = Vec::new();
    let mut drops = Vec::new();
    let mut list: Vec<Option<Single>> = Vec::new();
    for (k, stage) in stages.into_iter().enumerate() {
        list.push(match stage {
            Stage::Done(single) => Some(single),
            Stage::Drop(one) => {
                places.push(k);
                drops.push(*one);
                None
            }
        });
    }
    let progress = |fraction: f64| {
        let here = before as f64 + fraction * drops.len() as f64;
        (options.progress)(here / scenarios.len() as f64);
    };
    let plan = Options {
        progress: &progress,
        ..*options
    };
    let singles = each::run(&drops, &plan).into_iter().zip(&drops);
    for (place, (mut single, one)) in places.into_iter().zip(singles) {
        single.warnings = known::with_those_before(one.scenario, &one.built.drop, single.warnings);
        list[place] = Some(single);
    }
    list.into_iter().flatten().collect()
}

/// Builds a drop; runs anything else at once, on the thread that has it.
fn staged<'a>(scenario: &'a Result<Scenario, Box<Problem>>, options: &Options) -> Stage<'a> {
    let scenario = match scenario {
        Ok(scenario) => scenario,
        Err(problem) => return Stage::Done(not_built(problem)),
    };
    if let System::Drop(drop) = &scenario.system {
        return match each::one(scenario, drop) {
            Ok(one) => Stage::Drop(Box::new(one)),
            Err(problem) => Stage::Done(not_built(&scenario.locate(problem))),
        };
    }
    let unwatched = Options {
        threads: Some(1),
        interrupt: options.interrupt,
        progress: &|_| {},
    };
    Stage::Done(match build(scenario) {
        Ok(machine) => {
            let outcome = machine.run(&unwatched);
            Single {
                quantities: outcome.quantities,
                warnings: outcome.warnings,
                stop: outcome.stop,
            }
        }
        Err(problem) => not_built(&problem),
    })
}
