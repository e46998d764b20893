//! A rotor that runs out on its auxiliary bearings, which warm: from full speed to a stop in slow time.
//!
//! The rotor rolls; what whirls, bounces or slides needs a run in motion before it. Speed, temperatures of a network of seven
//! nodes and what follows them (viscosity, clearance, ball loads, conductances) are integrated in steps of the speed, and the heat
//! made is stored or given away to rounding. A second run-out holds every node at its limit from the moment it gets there: the
//! heat that must be taken from it for that.
//!
//! Source: heat-and-life, sections 2, 3, 5, 6 and 8.

pub(crate) mod build;
mod course;
mod quantities;
mod ran;
mod warnings;

use crate::options::Options;
use crate::problem::Problem;
use crate::result::list::List;
use crate::result::outcome::{Column, Members, Outcome, Picture, Stop, Work};
use crate::scenario::{CoastDown, Scenario};
use crate::simulate::coast_down::build::{Built, ICE_POINT};
use crate::simulate::coast_down::course::{BEYOND, Course, End, Row};
use crate::simulate::coast_down::ran::Ran;
use std::time::Instant;
use thermal::bearing_network::NODES;
use thermal::coast_down::Endless;

/// Computes it and names what it finds.
pub(crate) fn run(
    scenario: &Scenario,
    run: &CoastDown,
    built: &Built,
    options: &Options,
) -> Outcome {
    let clock = Instant::now();
    let limits = course::limits(run);
    let found = course::follow(run, built, &[None; 7], options.interrupt).and_then(|free| {
        let passes = |row: &Row| {
            let nodes = row.temperatures.iter().zip(&limits);
            nodes
                .into_iter()
                .any(|(now, limit)| limit.is_some_and(|limit| *now > limit))
        };
        let held = match free.rows.iter().any(passes) {
            true => Some(course::follow(run, built, &limits, options.interrupt)?),
            false => None,
        };
        Ok(Ran {
            run,
            built,
            free,
            held,
            limits,
        })
    });
    let named = run.name.as_deref().unwrap_or("bearing");
    let mut outcome = Outcome {
        system: "coast_down",
        title: (scenario.title.clone()).unwrap_or_else(|| format!("Run-out on a {named}")),
        quantities: Vec::new(),
        history: Vec::new(),
        contacts: Vec::new(),
        warnings: Vec::new(),
        stop: Stop {
            reason: "finished",
            time: 0.0,
            text: String::new(),
        },
        work: Work {
            members: 1,
            ..Work::default()
        },
        members: Members::default(),
        drawn: Vec::new(),
        limits: Vec::new(),
        pictures: vec![Picture {
            bearing: String::new(),
            clearance: None,
            pressure_limit: None,
            rolling_cage_ratio: f64::NAN,
            balls: run.ball_count,
        }],
        files: Vec::new(),
    };
    match found {
        Ok(ran) => {
            outcome.stop = stop(&ran.free);
            let mut list = List(Vec::new());
            quantities::name(&ran, &mut list);
            outcome.quantities = list.ended_at(outcome.stop.time);
            outcome.history = history(&ran);
            outcome.warnings = warnings::of(&ran);
            outcome.work.steps = ran.free.state.steps as u64;
        }
        Err(problem) => outcome.stop = failed(&problem),
    }
    outcome.work.seconds = clock.elapsed().as_secs_f64();
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

fn stop(course: &Course) -> Stop {
    let time = course.state.time;
    let speed = course.state.speed;
    let (reason, text) = match course.end {
        End::Stands => ("finished", "The rotor stands.".to_string()),
        End::Late => (
            "finished",
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

/// Columns over time.
fn history(ran: &Ran) -> Vec<Column> {
    let rows = &ran.free.rows;
    let mut columns = Vec::new();
    let mut add = |name: String, unit, meaning: String, value: &dyn Fn(&Row) -> f64| {
        columns.push(Column {
            name,
            unit,
            meaning,
            values: rows.iter().map(value).collect(),
        });
    };
    add("time".into(), "s", "time since the start".into(), &|row| {
        row.time
    });
    add(
        "rotor.speed".into(),
        "rad/s",
        "speed of rotor and inner races".into(),
        &|row| row.speed,
    );
    for (node, name) in NODES.iter().enumerate() {
        if ran.is_there(node) {
            add(
                format!("{name}.temperature"),
                "K",
                format!("temperature of the {}", name.replace('_', " ")),
                &|row| row.temperatures[node] + ICE_POINT,
            );
        }
    }
    for (at, (name, words)) in [
        (
            "speed_dependent",
            "speed-dependent moment M0 of all bearings",
        ),
        ("load_dependent", "load-dependent moment M1 of all bearings"),
        ("windage", "moment of the gas"),
    ]
    .into_iter()
    .enumerate()
    {
        add(format!("{name}.moment"), "N m", words.into(), &|row| {
            row.moments[at]
        });
    }
    add(
        "heat.power".into(),
        "W",
        "heat made in all bearings".into(),
        &|row| row.speed * (row.moments[0] + row.moments[1]),
    );
    add(
        "bearing.clearance".into(),
        "m",
        "diametral clearance; negative is preload".into(),
        &|row| row.clearance,
    );
    add(
        "bearing.largest_ball_load".into(),
        "N",
        "load of the most loaded ball".into(),
        &|row| row.ball_loads[0],
    );
    add(
        "heat.growth_rate".into(),
        "1/s",
        "rate at which a disturbance of the temperatures grows; above 0 they run away".into(),
        &|row| row.growth,
    );
    columns
}
