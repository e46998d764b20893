//! Many single runs of scenarios that differ.

use crate::measured::Curve;
use crate::{Machine, build, built, known};
use outcome::Outcome;
use outcome::host::{self, in_pool};
use outcome::options::Options;
use problem::Result;
use scenario::Scenario;
use simulate::drop::each::{self, One};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Runs each scenario once; drops of one kind share lanes, but for those beside measured channels, whose histories would fill the memory.
/// A scenario that could not be read or built is a result that says
/// why; histories are not kept. The numbers of one depend on its scenario alone.
pub fn each(scenarios: &[Result<Scenario>], options: &Options) -> Vec<Outcome> {
    in_pool(options.threads, || of_pool(scenarios, options))
}

fn of_pool(scenarios: &[Result<Scenario>], options: &Options) -> Vec<Outcome> {
    let curves = curves_of(scenarios);
    let stage = |k: usize| stage(&scenarios[k], &curves, options);
    let after = |one: &One, made: Outcome| Outcome {
        warnings: known::with_those_before(one.scenario, &one.built.drop, made.warnings),
        ..made
    };
    staged(scenarios.len(), stage, after, options)
}

/// Runs so many drops, those of one kind in the lanes of each other; a stage gives one, or what came out already.
pub(crate) fn staged<'a>(
    count: usize,
    stage: impl Fn(usize) -> Result<One<'a>, Box<Outcome>> + Sync,
    after: impl Fn(&One, Outcome) -> Outcome,
    options: &Options,
) -> Vec<Outcome> {
    let done = AtomicUsize::new(0);
    let all: Vec<usize> = (0..count).collect();
    let stages = host::each(&all, |_, k| {
        let stage = stage(*k);
        if stage.is_err() {
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            (options.progress)(done as f64 / count as f64);
        }
        stage
    });
    let before = done.into_inner();
    let mut drops = Vec::new();
    let mut list: Vec<Option<Outcome>> = Vec::new();
    for stage in stages {
        list.push(stage.map(|one| drops.push(one)).err().map(|made| *made));
    }
    let progress = |fraction: f64| {
        let here = before as f64 + fraction * drops.len() as f64;
        (options.progress)(here / count as f64);
    };
    let plan = Options {
        progress: &progress,
        ..*options
    };
    let mut made = drops.iter().zip(each::run(&drops, &plan));
    for place in list.iter_mut().filter(|place| place.is_none()) {
        *place = made.next().map(|(one, made)| after(one, made));
    }
    drop(made);
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
fn stage<'a>(
    scenario: &'a Result<Scenario>,
    curves: &Arc<Vec<Curve>>,
    options: &Options,
) -> Result<One<'a>, Box<Outcome>> {
    let scenario = match scenario {
        Ok(scenario) => scenario,
        Err(problem) => return Err(Outcome::not_built(problem).into()),
    };
    if let Some(drop) = scenario.drop().filter(|_| scenario.measured.is_empty()) {
        return each::one(scenario, drop)
            .map_err(|problem| Box::new(Outcome::not_built(&scenario.locate(problem))));
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
        Err(problem) => Outcome::not_built(&problem).into(),
    })
}
