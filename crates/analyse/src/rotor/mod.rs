//! A flexible rotor: mass properties, modes, critical speeds, response to unbalance, sag, stiffness map.
//!
//! The computations stand in the crate `rotor`; here they are asked for, named and turned into columns. Nothing is integrated.
//!
//! Not modelled: torsion, axial motion, stress stiffening, shafts that are not round, supports that hold the slope.

pub(crate) mod asked;
pub(crate) mod levitated;
pub(crate) mod quantities;
pub mod warnings;

use crate::interruptible::{INTERRUPTED, interruptible};
pub use crate::rotor::asked::Asked;
use crate::rotor::asked::{Found, Motion, sense};
use outcome::options::Options;
use outcome::{Column, Members, Outcome, Picture, Quantity, Stop, Work};
use scenario::Scenario;
use std::sync::Arc;
use std::time::Instant;

/// The results of such an analysis, without values.
pub fn results(asked: &Asked) -> Vec<Quantity> {
    quantities::name(asked, None)
}

/// Computes everything and names it.
pub fn run(scenario: &Scenario, asked: &Arc<Asked>, options: &Options) -> Outcome {
    let clock = Instant::now();
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
        history: found.map_or_else(Vec::new, |found| history(asked, found)),
        contacts: Vec::new(),
        warnings: found.map_or_else(Vec::new, |found| warnings::of(asked, found)),
        stop: Stop {
            reason,
            time: 0.0,
            text,
        },
        work: Work {
            members: 1,
            seconds: clock.elapsed().as_secs_f64(),
            ..Work::default()
        },
        members: Members::default(),
        drawn: Vec::new(),
        limits: Vec::new(),
        pictures: vec![Picture {
            bearing: String::new(),
            clearance: None,
            pressure_limit: None,
            rolling_cage_ratio: 0.0,
            balls: 0,
        }],
        files: Vec::new(),
    }
}

/// The curves over speed, which is the first column.
fn history(asked: &Asked, found: &Found) -> Vec<Column> {
    let diagram = &found.diagram;
    let mut columns = vec![Column {
        name: "speed".to_string(),
        unit: "rad/s",
        meaning: "speed of the rotor".to_string(),
        values: found.speeds.clone(),
    }];
    let mut add = |name: String, unit, meaning: String, values: Vec<f64>| {
        columns.push(Column {
            name,
            unit,
            meaning,
            values,
        });
    };
    for (number, branch) in (1..).zip(&diagram.branches) {
        let column = |value: fn(&rotor::Mode) -> f64| -> Vec<f64> {
            // speeds close to critical ones are of the responses alone
            let at = |speed: &f64| {
                diagram
                    .speeds
                    .binary_search_by(|own| own.total_cmp(speed))
                    .ok()
            };
            let mode = |speed: &f64| branch.modes[at(speed)?].as_ref().map(value);
            (found.speeds.iter())
                .map(|speed| mode(speed).unwrap_or(f64::NAN))
                .collect()
        };
        add(
            format!("branch_{number}.frequency"),
            "rad/s",
            format!("damped natural frequency of branch {number}"),
            column(rotor::Mode::frequency),
        );
        add(
            format!("branch_{number}.damping_ratio"),
            "1",
            format!("damping ratio of branch {number}"),
            column(rotor::Mode::damping_ratio),
        );
        add(
            format!("branch_{number}.whirl"),
            "1",
            format!("whirl of branch {number}: 1 forward, -1 backward, 0 planar"),
            column(|mode| sense(mode.whirl)),
        );
    }
    for watched in asked.watched() {
        let (name, motion) = (&watched.name, watched.motion);
        let of = |value: &dyn Fn(&rotor::Response) -> f64| -> Vec<f64> {
            let all = found.responses.iter();
            all.map(|one| one.as_ref().map_or(f64::NAN, value))
                .collect()
        };
        if found.responses.is_empty() {
            continue;
        }
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
        let amplitude = of(&|response| motion.amplitude(response));
        add(
            format!("{name}.amplitude"),
            motion.unit(),
            meaning,
            amplitude,
        );
        if let Motion::Of(at) = motion {
            add(
                format!("{name}.lag"),
                "rad",
                format!("how far x at {label} is behind the mark that phases count from"),
                of(&|response| response.lag(at)),
            );
        }
    }
    columns
}
