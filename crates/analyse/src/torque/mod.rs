//! The moments of a bearing over speed, load and acceleration. Nothing is integrated: the balls roll.
//!
//! ```text
//!   t_I = M0 + M1 + J_I Ω̇ + arm F        what the inner race feels against its rotation
//!   t_O = M0 + M1 - J_O Ω̇ + arm F        what a torque arm on the outer race measures
//! ```
//! J_I = (7/20 N m_b + ¼ m_c) R², J_O = (1+2s)(3/20 N m_b + ¼ m_c) R², arm = (1+2s)R/(2(1+s)).
//! Source: the source paper (10), (11), (14), (15); M0 and M1 by the friction law.
//!
//! Not modelled: balls that skid (then neither race feels these moments), a radial load shared unevenly by balls.

pub(crate) mod asked;
pub(crate) mod quantities;
pub mod warnings;

pub use crate::torque::asked::Asked;
use crate::torque::asked::{Moments, law_of, name_of};
use outcome::{Column, Members, Outcome, Picture, Quantity, Stop, Work};

use physics::friction::MomentParts;
use scenario::Scenario;
use std::time::Instant;

/// The results of such a computation, without values.
pub fn results(asked: &Asked) -> Vec<Quantity> {
    quantities::name(asked, None)
}

/// Computes the moments and names them.
pub fn run(scenario: &Scenario, asked: &Asked) -> Outcome {
    let clock = Instant::now();
    let torque = asked.torque;
    let history = history(asked);
    let quantities = quantities::name(asked, Some(asked));
    let named = torque.name.as_deref().unwrap_or("bearing");
    Outcome {
        system: "torque",
        title: scenario
            .title
            .clone()
            .unwrap_or_else(|| format!("Torque of a {named}")),
        quantities,
        history,
        contacts: Vec::new(),
        warnings: warnings::of(scenario, asked),
        stop: Stop {
            reason: "finished",
            time: 0.0,
            text: "Everything asked for was computed.".to_string(),
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
            rolling_cage_ratio: asked.set.cage_speed(1.0),
            balls: torque.ball_count,
        }],
        files: Vec::new(),
    }
}

/// The curves over speed, which is the first column.
fn history(asked: &Asked) -> Vec<Column> {
    let torque = asked.torque;
    let speeds = asked.speeds();
    let mut columns = Vec::new();
    let mut add = |name: String, unit, meaning: String, value: &dyn Fn(f64) -> f64| {
        columns.push(Column {
            name,
            unit,
            meaning,
            values: speeds.iter().map(|&speed| value(speed)).collect(),
        });
    };
    add(
        "speed".to_string(),
        "rad/s",
        "speed of the inner race".to_string(),
        &|speed| speed,
    );
    let steady = |speed| asked.moments(speed, 0.0).friction;
    let under = format!("under {} N", asked.load());
    for (name, words, part) in [
        (
            "speed_dependent",
            "speed-dependent part M0",
            (|parts| parts.speed_dependent) as fn(MomentParts<f64>) -> f64,
        ),
        ("load_dependent", "load-dependent part M1", |parts| {
            parts.load_dependent
        }),
        ("moment", "steady moment M = M0 + M1", |parts| parts.sum()),
    ] {
        add(
            format!("friction.{name}"),
            "N m",
            format!("{words} of the friction {under}"),
            &|speed| part(steady(speed)),
        );
    }
    add(
        "friction.power".to_string(),
        "W",
        format!("power M Ω that the steady moment takes {under}"),
        &|speed| speed * steady(speed).sum(),
    );
    for (number, &acceleration) in (1..).zip(&torque.accelerations) {
        let at = format!("at {acceleration} rad/s^2 {under}");
        for (name, words, part) in [
            (
                "inner_race.inertia",
                "inertia of balls and cage at the inner race, J_I Ω̇,",
                (|moments: Moments| moments.inner_inertia) as fn(Moments) -> f64,
            ),
            (
                "outer_race.inertia",
                "inertia of balls and cage at the outer race, -J_O Ω̇,",
                |moments| moments.outer_inertia,
            ),
            (
                "loss",
                "pocket friction F at both races, arm F,",
                |moments| moments.loss,
            ),
            (
                "inner_race.moment",
                "moment t_I that resists the inner race",
                |moments| moments.inner(),
            ),
            (
                "outer_race.moment",
                "moment t_O on the outer race",
                |moments| moments.outer(),
            ),
        ] {
            add(
                format!("acceleration_{number}.{name}"),
                "N m",
                format!("{words} {at}"),
                &|speed| part(asked.moments(speed, acceleration)),
            );
        }
    }
    for (number, &load) in (1..).zip(&torque.loads) {
        add(
            format!("load_{number}.friction.moment"),
            "N m",
            format!("steady moment M under {load} N"),
            &|speed| asked.friction(&asked.law, speed, load).sum(),
        );
    }
    for compared in &torque.laws {
        let moment = compared.moment.as_ref().ok();
        if let Some(law) = moment.and_then(|moment| law_of(torque, moment).ok()) {
            add(
                format!("{}.friction.moment", name_of(compared.law)),
                "N m",
                format!("steady moment M by the law {} {under}", compared.law),
                &|speed| asked.friction(&law, speed, asked.load()).sum(),
            );
        }
    }
    for (number, lubricant) in (1..).zip(&torque.lubricants) {
        let moment = lubricant
            .at(torque.temperature)
            .map(|viscosity| torque.moment.with_viscosity(viscosity));
        if let Some(law) = moment.ok().and_then(|moment| law_of(torque, &moment).ok()) {
            add(
                format!("lubricant_{number}.friction.moment"),
                "N m",
                format!("steady moment M with {} {under}", lubricant.name),
                &|speed| asked.friction(&law, speed, asked.load()).sum(),
            );
        }
    }
    columns
}
