//! Many single runs of scenarios that differ.

use crate::measured::Curve;
use crate::{Machine, build, built, known};
use outcome::host::{self, in_pool};
use outcome::options::Options;
use outcome::{Outcome, Stop};
use problem::{Problem, Result};
use scenario::Scenario;
use simulate::drop::each::{self, One};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

fn not_built(problem: &Problem) -> Box<Outcome> {
    Box::new(Outcome {
        stop: Stop {
            reason: "not built",
            time: 0.0,
            text: problem.to_string(),
        },
        ..Outcome::default()
    })
}

/// Runs each scenario once; drops of one kind share lanes, but for those beside measured channels, whose histories would fill the memory.
/// A scenario that could not be read or built is a result that says
/// why; histories are not kept. The numbers of one depend on its scenario alone.
pub fn each(scenarios: &[Result<Scenario>], options: &Options) -> Vec<Outcome> {
    in_pool(options.threads, || of_pool(scenarios, options))
}

fn of_pool(scenarios: &[Result<Scenario>], options: &Options) -> Vec<Outcome> {
    let done = AtomicUsize::new(0);
    let curves = curves_of(scenarios);
    let stages = host::each(scenarios, |_, scenario| {
        let stage = staged(scenario, &curves, options);
        if stage.is_err() {
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            (options.progress)(done as f64 / scenarios.len() as f64);
        }
        stage
    });
    let before = done.into_inner();
    let mut places = Vec::new();
    let mut drops = Vec::new();
    let mut list: Vec<Option<Outcome>> = Vec::new();
    for (k, stage) in stages.into_iter().enumerate() {
        list.push(match stage {
            Err(outcome) => Some(*outcome),
            Ok(one) => {
                places.push(k);
                drops.push(one);
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
    let made = each::run(&drops, &plan).into_iter().zip(&drops);
    for (place, (mut outcome, one)) in places.into_iter().zip(made) {
        outcome.warnings =
            known::with_those_before(one.scenario, &one.built.drop, outcome.warnings);
        list[place] = Some(outcome);
    }
    host::discard(drops);
    list.into_iter().flatten().collect()
}

/// The measured channels that these scenarios have in common; what is wrong with them was reported when the first was built.
fn curves_of(scenarios: &[Result<Scenario>]) -> Arc<Vec<Curve>> {
    let mut measured = (scenarios.iter().flatten()).filter(|own| !own.measured.is_empty());
    let machine = measured.find_map(|scenario| build(scenario).ok());
    machine.map(|machine| machine.measured).unwrap_or_default()
}

/// Builds a drop; runs anything else, and a drop beside measured channels, at once, on the thread that has it.
fn staged<'a>(
    scenario: &'a Result<Scenario>,
    curves: &Arc<Vec<Curve>>,
    options: &Options,
) -> Result<One<'a>, Box<Outcome>> {
    let scenario = match scenario {
        Ok(scenario) => scenario,
        Err(problem) => return Err(not_built(problem)),
    };
    if let Some(drop) = scenario.drop().filter(|_| scenario.measured.is_empty()) {
        return each::one(scenario, drop).map_err(|problem| not_built(&scenario.locate(problem)));
    }
    let unwatched = Options {
        threads: Some(1),
        controllers: options.controllers,
        ..Options::unwatched(options.interrupt)
    };
    let machine = match scenario.measured.is_empty() {
        true => build(scenario),
        // their files were read once
        false => built(scenario).map(|machine| Machine {
            measured: curves.clone(),
            ..machine
        }),
    };
    Err(match machine {
        Ok(machine) => Box::new(Outcome {
            history: Vec::new(),
            files: Vec::new(),
            ..machine.run(&unwatched)
        }),
        Err(problem) => not_built(&problem),
    })
}
