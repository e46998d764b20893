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

pub(crate) mod quantities;
pub(crate) mod request;
pub mod warnings;

pub use crate::torque::request::Request;
use crate::torque::request::{law_of, name_of};
use outcome::columns::{Columns, columns};
use outcome::{Column, Outcome, Picture, Quantity, Stop};

use scenario::Scenario;

/// The columns of its history, without values.
pub fn columns(asked: &Request) -> Vec<Column> {
    history(asked, &[])
}

/// The results of such a computation, without values.
pub fn results(asked: &Request) -> Vec<Quantity> {
    quantities::name(asked, None)
}

/// Computes the moments and names them.
pub fn run(scenario: &Scenario, asked: &Request) -> Outcome {
    let torque = asked.torque;
    let history = history(asked, &asked.speeds());
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
        warnings: warnings::of(scenario, asked),
        stop: Stop::new("finished", 0.0, "Everything asked for was computed."),
        pictures: vec![Picture::without_rotor(
            asked.set.cage_speed(1.0),
            torque.ball_count,
        )],
        ..Outcome::default()
    }
}

/// The curves over these speeds, which are the first column.
fn history(asked: &Request, speeds: &[f64]) -> Vec<Column> {
    let torque = asked.torque;
    let load = asked.load();
    let steady = |speed: &f64| asked.moments(*speed, 0.0).friction;
    let mut table = Columns::over(speeds);
    columns! { table, |speed|
        "speed": "rad/s", "speed of the inner race" => *speed;
        "friction.speed_dependent": "N m", "speed-dependent part M0 of the friction under {load} N" => steady(speed).speed_dependent;
        "friction.load_dependent": "N m", "load-dependent part M1 of the friction under {load} N" => steady(speed).load_dependent;
        "friction.moment": "N m", "steady moment M = M0 + M1 of the friction under {load} N" => steady(speed).sum();
        "friction.power": "W", "power M Ω that the steady moment takes under {load} N" => speed * steady(speed).sum();
    }
    for (k, &at) in (1..).zip(&torque.accelerations) {
        let moments = |speed: &f64| asked.moments(*speed, at);
        columns! { table, |speed|
            "acceleration_{k}.inner_race.inertia": "N m", "inertia of balls and cage at the inner race, J_I Ω̇, at {at} rad/s^2 under {load} N"
                => moments(speed).inner_inertia;
            "acceleration_{k}.outer_race.inertia": "N m", "inertia of balls and cage at the outer race, -J_O Ω̇, at {at} rad/s^2 under {load} N"
                => moments(speed).outer_inertia;
            "acceleration_{k}.loss": "N m", "pocket friction F at both races, arm F, at {at} rad/s^2 under {load} N" => moments(speed).loss;
            "acceleration_{k}.inner_race.moment": "N m", "moment t_I that resists the inner race at {at} rad/s^2 under {load} N"
                => moments(speed).inner();
            "acceleration_{k}.outer_race.moment": "N m", "moment t_O on the outer race at {at} rad/s^2 under {load} N" => moments(speed).outer();
        }
    }
    for (k, &load) in (1..).zip(&torque.loads) {
        columns! { table, |speed|
            "load_{k}.friction.moment": "N m", "steady moment M under {load} N" => asked.friction(&asked.law, *speed, load).sum();
        }
    }
    for compared in &torque.laws {
        let moment = compared.moment.as_ref().ok();
        let (word, name) = (compared.law, name_of(compared.law));
        if let Some(law) = moment.and_then(|moment| law_of(torque, moment).ok()) {
            columns! { table, |speed|
                "{name}.friction.moment": "N m", "steady moment M by the law {word} under {load} N" => asked.friction(&law, *speed, load).sum();
            }
        }
    }
    for (k, lubricant) in (1..).zip(&torque.lubricants) {
        let moment = lubricant
            .at(torque.temperature)
            .map(|viscosity| torque.moment.with_viscosity(viscosity));
        let name = &lubricant.name;
        if let Some(law) = moment.ok().and_then(|moment| law_of(torque, &moment).ok()) {
            columns! { table, |speed|
                "lubricant_{k}.friction.moment": "N m", "steady moment M with {name} under {load} N" => asked.friction(&law, *speed, load).sum();
            }
        }
    }
    table.list
}
