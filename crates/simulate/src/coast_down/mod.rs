//! A rotor that coasts down on its auxiliary bearings, which warm: from full speed to a stop in quasi-steady steps.
//!
//! The rotor rolls; what whirls, bounces or slides needs a run in motion before it. Speed, temperatures of a network of seven
//! nodes and what follows them (viscosity, clearance, ball loads, conductances) are integrated in steps of the speed, and the heat
//! made is stored or given away to rounding. A second coast-down holds every node at its limit from the moment it gets there: the
//! heat that must be taken from it for that.
//!
//! Source: derived; book/src/theory/heat.md.

pub mod build;
pub(crate) mod course;
pub(crate) mod measured;
pub(crate) mod passages;
pub(crate) mod quantities;
pub(crate) mod rows;
pub(crate) mod run;
pub mod warnings;

use crate::coast_down::build::{CoastDownModel, ICE_POINT, Part};
use crate::coast_down::course::{BEYOND, Course};
use crate::coast_down::rows::{End, Row};
use model::system::layout::of_part;
use outcome::columns::{Columns, columns};
use outcome::list::List;
use outcome::options::Options;
use outcome::{Column, Outcome, Picture, Quantity, Stop};
use problem::Problem;
use scenario::{CoastDown, Scenario};
use thermal::coast_down::Endless;

/// The results of a coast-down, without values.
pub fn results(built: &CoastDownModel) -> Vec<Quantity> {
    let mut list = List::default();
    quantities::name(&mut list, &built.parts, None);
    list.quantities
}

/// The columns of its history, without values.
pub fn columns(built: &CoastDownModel) -> Vec<Column> {
    history(&built.parts, &[])
}

/// Computes it and names what it finds.
pub fn run(
    scenario: &Scenario,
    run: &CoastDown,
    built: &CoastDownModel,
    options: &Options,
) -> Outcome {
    let found = run::run(built, options.interrupt);
    let names = run.bearings.iter();
    let mut names: Vec<_> =
        (names.map(|own| own.warm.name.as_deref().unwrap_or("bearing"))).collect();
    names.dedup();
    let named = names.join(" and ");
    let mut outcome = Outcome {
        system: "coast_down",
        title: (scenario.title.clone()).unwrap_or_else(|| format!("Coast-down on {named}")),
        stop: Stop {
            reason: "finished",
            time: 0.0,
            text: String::new(),
        },
        pictures: (run.bearings.iter())
            .map(|own| Picture {
                bearing: own.name.clone(),
                clearance: None,
                pressure_limit: None,
                rolling_cage_ratio: f64::NAN,
                balls: own.warm.ball_count,
            })
            .collect(),
        ..Outcome::default()
    };
    match found {
        Ok(ran) => {
            outcome.stop = stop(&ran.free);
            let mut list = List::default();
            quantities::name(&mut list, &built.parts, Some(&ran));
            outcome.quantities = list.ended_at(Some(outcome.stop.time));
            outcome.history = history(&built.parts, &ran.free.rows);
            outcome.warnings = warnings::of(&ran);
            outcome.work.steps = ran.free.state.steps as u64;
        }
        Err(problem) => outcome.stop = failed(&problem),
    }
    outcome
}

fn failed(problem: &Problem) -> Stop {
    Stop {
        reason: "diverged",
        time: 0.0,
        text: format!(
            "Nothing was computed: {}; {}.",
            problem.found, problem.allowed
        ),
    }
}

/// How it ended, in words.
pub(crate) fn stop(course: &Course) -> Stop {
    let time = course.state.time;
    let speed = course.state.speed;
    let (reason, text) = match course.end {
        End::Stands => ("finished", "The rotor stands.".to_string()),
        End::Reached => (
            "still turning",
            format!(
                "coast_down.stop_speed is reached; the rotor still turns with {speed:.4} rad/s."
            ),
        ),
        End::Late => (
            "still turning",
            format!("coast_down.longest is reached; the rotor still turns with {speed:.4} rad/s."),
        ),
        End::Interrupted => (
            "interrupted",
            format!("Interrupted at {time:.4} s; everything until then is kept."),
        ),
        End::Beyond => (
            "left the model",
            format!(
                "Stopped at {time:.4} s: a node is above {BEYOND:.0} °C, where steel is soft and the lubricant is gone."
            ),
        ),
        End::Endless(Endless::NothingBrakes(speed)) => (
            "left the model",
            format!(
                "Stopped at {time:.4} s: nothing brakes the rotor at {speed:.4} rad/s, so that it never stands."
            ),
        ),
        End::Lost(why) => (
            "left the model",
            format!("Stopped at {time:.4} s, with {speed:.4} rad/s: {why}."),
        ),
        End::Endless(Endless::Steps) => (
            "step limit",
            format!(
                "Given up at {time:.4} s, after {} steps.",
                course.state.steps
            ),
        ),
    };
    Stop { reason, time, text }
}

/// Columns over time of these bearings.
pub(crate) fn history(parts: &[Part], rows: &[Row]) -> Vec<Column> {
    let mut table = Columns::over(rows);
    columns! { table, |row|
        "time": "s", "time since the start" => row.time;
        "rotor.speed": "rad/s", "speed of rotor and inner races" => row.speed;
    }
    for (k, part) in parts.iter().enumerate() {
        for node in part.nodes(k) {
            let words = node.name().replace('_', " ");
            let name = of_part(&part.name, &format!("{}.temperature", node.name()));
            columns! { table, |row| "{name}": "K", "temperature of the {words}" => row.temperatures[node.place()] + ICE_POINT; }
        }
    }
    columns! { table, |row|
        "speed_dependent.moment": "N m", "speed-dependent moment M0 of all bearings" => row.moments[0];
        "load_dependent.moment": "N m", "load-dependent moment M1 of all bearings; of bearings in space their whole moment" => row.moments[1];
        "windage.moment": "N m", "moment of the gas" => row.moments[2];
        "heat.power": "W", "heat made in all bearings" => row.speed * (row.moments[0] + row.moments[1]);
    }
    for (k, part) in parts.iter().enumerate() {
        let [clearance, load] = ["bearing.clearance", "bearing.largest_ball_load"]
            .map(|name| of_part(&part.name, name));
        if part.warm.contact_angle == 0.0 {
            columns! { table, |row| "{clearance}": "m", "diametral clearance; negative is preload" => row.bearings[k].clearance; }
        }
        columns! { table, |row|
            "{load}": "N", "load of the most loaded ball" => row.bearings[k].largest_ball_load();
        }
    }
    columns! { table, |row|
        "heat.growth_rate": "1/s", "rate at which a disturbance of the temperatures grows; above 0 they run away" => row.growth;
    }
    table.list
}
