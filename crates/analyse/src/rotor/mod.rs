//! A flexible rotor: mass properties, modes, critical speeds, response to unbalance, sag, stiffness map.
//!
//! The computations stand in the crate `rotor`; here they are asked for, named and turned into columns. Nothing is integrated.
//!
//! Not modelled: torsion, axial motion, stress stiffening, shafts that are not round, supports that hold the slope.

pub(crate) mod levitated;
pub(crate) mod quantities;
pub(crate) mod request;
pub(crate) mod rolling;
pub mod warnings;
pub(crate) mod whirl;

use crate::interruptible::{INTERRUPTED, interruptible};
pub use crate::rotor::request::Request;
use crate::rotor::request::{Analyses, Motion, sense};
use outcome::columns::{Columns, columns};
use outcome::options::Options;
use outcome::{Column, Outcome, Picture, Quantity, Stop};
use scenario::Scenario;
use std::sync::Arc;

/// The columns of its history, without values.
pub fn columns(asked: &Request) -> Vec<Column> {
    history(asked, None)
}

/// The results of such an analysis, without values.
pub fn results(asked: &Request) -> Vec<Quantity> {
    quantities::name(asked, None)
}

/// Computes everything and names it.
pub fn run(scenario: &Scenario, asked: &Arc<Request>, options: &Options) -> Outcome {
    let own = Arc::clone(asked);
    // an eigenproblem knows of no interrupt: its thread is left
    let found = interruptible(options.interrupt, move || {
        own.find().map_err(|error| error.to_string())
    });
    let (reason, text) = match &found {
        Ok(_) => ("finished", "Everything asked for was computed.".to_string()),
        Err(why) if why == INTERRUPTED => {
            let text = "Interrupted before the analysis had an answer.";
            (INTERRUPTED, text.to_string())
        }
        Err(why) => ("diverged", format!("The analysis has no answer: {why}.")),
    };
    let found = found.as_ref().ok();
    Outcome {
        system: "rotor",
        title: scenario
            .title
            .clone()
            .unwrap_or_else(|| "Rotor".to_string()),
        quantities: found.map_or_else(Vec::new, |found| quantities::name(asked, Some(found))),
        history: found.map_or_else(Vec::new, |found| history(asked, Some(found))),
        warnings: found.map_or_else(Vec::new, |found| warnings::of(asked, found)),
        stop: Stop {
            reason,
            time: 0.0,
            text,
        },
        pictures: vec![Picture {
            bearing: String::new(),
            clearance: None,
            pressure_limit: None,
            rolling_cage_ratio: 0.0,
            balls: 0,
        }],
        ..Outcome::default()
    }
}

/// The curves over speed, which is the first column.
fn history(asked: &Request, found: Option<&Analyses>) -> Vec<Column> {
    let rolling = asked.rolling.as_ref().and_then(|own| own.as_ref().ok());
    let rolled = found.and_then(|found| found.rolling.as_deref());
    let own = found.iter().flat_map(|found| found.speeds.iter());
    let others = rolled.iter().flat_map(|own| own.found.speeds.iter());
    let mut rows: Vec<f64> = own.chain(others).copied().collect();
    rows.sort_by(f64::total_cmp);
    rows.dedup();
    let mut table = Columns::over(&rows);
    columns! { table, |row| "speed": "rad/s", "speed of the rotor" => *row; }
    over_speed(&mut table, "", asked, found);
    if let Some(rolling) = rolling {
        let begin = format!("{}.", rolling::results::ON);
        over_speed(
            &mut table,
            &begin,
            &rolling.asked,
            rolled.map(|own| &own.found),
        );
    }
    table.list
}

/// Branches and responses, their names after what begins them.
fn over_speed(table: &mut Columns<f64>, begin: &str, asked: &Request, found: Option<&Analyses>) {
    // speeds close to critical ones are of the responses alone
    let at = |speeds: &[f64], speed: f64| speeds.binary_search_by(|own| own.total_cmp(&speed)).ok();
    let diagram = found.map(|found| &found.diagram);
    let branches: Vec<(String, Option<&rotor::Branch>)> = match diagram {
        Some(diagram) => (1..)
            .zip(&diagram.branches)
            .map(|(number, branch): (usize, _)| (number.to_string(), Some(branch)))
            .collect(),
        None => vec![("*".to_string(), None)],
    };
    for (number, branch) in branches {
        let of = |speed: f64, value: fn(&rotor::Mode) -> f64| {
            let row = diagram.and_then(|own| at(&own.speeds, speed));
            let mode = row.and_then(|row| branch?.modes[row].as_ref());
            mode.map_or(f64::NAN, value)
        };
        columns! { table, |row|
            "{begin}branch_{number}.frequency": "rad/s", "damped natural frequency of branch {number}" => of(*row, rotor::Mode::frequency);
            "{begin}branch_{number}.damping_ratio": "1", "damping ratio of branch {number}" => of(*row, rotor::Mode::damping_ratio);
            "{begin}branch_{number}.whirl": "1", "whirl of branch {number}: 1 forward, -1 backward, 0 planar" => of(*row, |mode| sense(mode.whirl));
        }
    }
    if !asked.responds() {
        return;
    }
    let of = |speed: f64, value: &dyn Fn(&rotor::Response) -> f64| {
        let response = found.and_then(|found| {
            let row = at(&found.speeds, speed)?;
            found.responses[row].as_ref()
        });
        response.map_or(f64::NAN, value)
    };
    for watched in asked.watched() {
        let (name, motion) = (&watched.name, watched.motion);
        let (what, label) = name.split_once('.').unwrap_or_default();
        let meaning = match what {
            "force" => {
                format!("force of {label} on what it holds under unbalance: half the longer axis")
            }
            "relative" => format!(
                "response to unbalance of the shaft in its housing at {label}: half the longer axis of the orbit"
            ),
            _ => format!("response to unbalance at {label}: half the longer axis of the orbit"),
        };
        columns! { table, |row|
            "{begin}{name}.amplitude": motion.unit(), "{meaning}" => of(*row, &|response| motion.amplitude(response));
        }
        if let Motion::Of(coordinate) = motion {
            columns! { table, |row|
                "{begin}{name}.lag": "rad", "how far x at {label} is behind the mark that phases count from" => of(*row, &|response| response.lag(coordinate));
            }
        }
    }
}
