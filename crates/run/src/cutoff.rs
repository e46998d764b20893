//! What twice `rotor.cutoff` would change, no bound of what all modes would: the beginning of a drop as it is, and once more with twice the cutoff.

use outcome::list::results;
use outcome::list::{List, origins};
use outcome::options::Options;
use outcome::{Outcome, Quantity};
use problem::Problem;
use scenario::Scenario;
use simulate::drop::{Shaft, each};

/// What is compared: the impact that high modes feel most, and where the rotor goes.
const COMPARED: [&str; 2] = ["first_impact_force", "max_rotor_displacement"];

/// Relative changes of results by twice the cutoff; nothing where the scenario does not ask.
pub(super) fn changes(
    scenario: &Scenario,
    shaft: &Shaft,
    known: &[Quantity],
    options: &Options,
) -> Vec<Quantity> {
    let Some(time) = shaft.cutoff_check else {
        return Vec::new();
    };
    let tried = both(scenario, time, options);
    name(known, Some(&tried.map_err(|problem| problem.to_string())))
}

/// The beginning of a drop until a time, s, as it is and with twice the cutoff.
fn both(scenario: &Scenario, time: f64, options: &Options) -> Result<Vec<Outcome>, Box<Problem>> {
    let set = |path: &str, value: f64, unit: &str| {
        let value = units::number_text(value);
        (path.to_string(), format!("\"{value} {unit}\""))
    };
    let one = ("repeat.count".to_string(), "1".to_string());
    let short = scenario.with(&[set("run.duration", time, "s"), one])?;
    let once = built(&short)?;
    let cutoff = once.built.shaft.as_ref().map_or(0.0, |shaft| shaft.cutoff);
    let doubled = short.with(&[set("rotor.cutoff", 2.0 * cutoff, "rad/s")])?;
    let quiet = Options {
        progress: &|_| {},
        rows: None,
        ..*options
    };
    let twice = built(&doubled)?;
    Ok(each::run(&[once, twice], &quiet))
}

fn built(scenario: &Scenario) -> Result<each::One<'_>, Box<Problem>> {
    match scenario.drop() {
        Some(drop) => each::one(scenario, drop),
        None => unreachable!("neither duration nor cutoff makes another system of a drop"),
    }
}

/// Both runs, or why there are none.
pub(super) type Tried = Result<Vec<Outcome>, String>;

/// Names these changes, each after what changes; without both runs those of any.
pub(super) fn name(known: &[Quantity], tried: Option<&Tried>) -> Vec<Quantity> {
    let mut list = List::default();
    let names = known.iter().map(|quantity| quantity.name.as_str());
    let last = |name: &str| COMPARED.contains(&name.rsplit('.').next().unwrap_or(name));
    for name in names.filter(|name| last(name)) {
        let changed = tried.map(|tried| changed(tried, name));
        list.named(&[name], |list| change(list, &(), changed.as_ref()));
    }
    list.quantities
}

/// What a result has changed by, over it.
fn changed(tried: &Tried, name: &str) -> Result<f64, String> {
    let found = tried.as_ref().map_err(String::clone)?;
    let value = |k: usize| {
        let run = found.get(k).filter(|run| run.stop.complete())?;
        run.number(name)
    };
    match (value(0), value(1)) {
        (Some(before), Some(after)) if before != 0.0 => Ok(after / before - 1.0),
        _ => {
            let part = found.iter().find(|run| !run.stop.complete());
            let none = "one of the two runs has no such result; a longer rotor.cutoff_check may";
            Err(part.map_or(none, |run| &run.stop.text).to_string())
        }
    }
}

results! {
    fn change(setup: &(), changed: &Result<f64, String>) {
        "cutoff_change.*": number "", CHANGE, "change of a result with twice as many modes" => changed.clone();
    }
}

origins! {
    CHANGE: law "change on doubling: the result with twice rotor.cutoff over that with rotor.cutoff, less 1, both until rotor.cutoff_check",
        source "crates/run/src/cutoff.rs",
        valid "not an error: all modes may change a result by more, and the other way, above all with a cutoff below the default; later contacts are chaotic";
}
