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

use super::build_bearing::acceleration_loss;
use super::outcome::{Column, Outcome, Picture, Stop, Work};
use super::{quantities_torque, warnings_torque};
use crate::problem::{Code, Problem};
use crate::scenario::{Moment, Scenario, Torque, UNNAMED};
use model::bearing::AccelerationLoss;
use physics::friction::{Friction, MomentParts};
use physics::rolling::RollingSet;
use std::time::Instant;

/// The moments at one speed, load and acceleration, N m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Moments {
    pub friction: MomentParts<f64>,
    /// J_I Ω̇.
    pub inner_inertia: f64,
    /// -J_O Ω̇.
    pub outer_inertia: f64,
    /// arm F.
    pub loss: f64,
}

impl Moments {
    /// t_I.
    pub fn inner(&self) -> f64 {
        self.friction.sum() + self.inner_inertia + self.loss
    }

    /// t_O.
    pub fn outer(&self) -> f64 {
        self.friction.sum() + self.outer_inertia + self.loss
    }
}

/// A bearing whose moments can be asked for.
pub(super) struct Asked<'a> {
    pub torque: &'a Torque,
    pub set: RollingSet<f64>,
    pub law: Friction<f64>,
    loss: AccelerationLoss,
}

impl Asked<'_> {
    pub fn of(torque: &Torque) -> Result<Asked<'_>, Box<Problem>> {
        let radius = 0.5 * torque.ball_diameter;
        let inner_track_radius = 0.5 * torque.pitch_diameter - radius;
        let ball = (torque.ball_mass)
            .unwrap_or_else(|| torque.ball_material.ball_mass(torque.ball_diameter));
        let law = law_of(torque, &torque.moment).map_err(|why| {
            Box::new(
                Problem::new(
                    Code::NoLawData,
                    UNNAMED,
                    why,
                    "a law that has constants for this bearing",
                )
                .on_key("bearing.moment.law"),
            )
        })?;
        Ok(Asked {
            torque,
            set: RollingSet {
                inner_track_radius,
                ball_ratio: radius / inner_track_radius,
                balls_mass: torque.ball_count as f64 * ball,
                cage_mass: torque.cage_mass,
            },
            law,
            loss: acceleration_loss(&torque.acceleration_loss),
        })
    }

    /// The first load.
    pub fn load(&self) -> f64 {
        self.torque.loads.first().copied().unwrap_or(0.0)
    }

    /// The moments under the first load.
    pub fn moments(&self, speed: f64, acceleration: f64) -> Moments {
        Moments {
            friction: self.friction(&self.law, speed, self.load()),
            inner_inertia: self.set.inner_inertia() * acceleration,
            // less from 0, so that a steady run has no -0
            outer_inertia: 0.0 - self.set.outer_inertia() * acceleration,
            loss: self.set.pocket_friction_arm() * self.loss.force(speed, acceleration),
        }
    }

    /// M0 and M1 of a law.
    pub fn friction(&self, law: &Friction<f64>, speed: f64, load: f64) -> MomentParts<f64> {
        law.parts(speed, load, self.torque.moment.axial_load())
    }

    /// The speeds of the curves, rad/s.
    pub fn speeds(&self) -> Vec<f64> {
        let (from, to) = (self.torque.speed_from, self.torque.speed_to);
        let last = self.torque.speed_count - 1;
        (0..=last)
            .map(|row| from + (to - from) * row as f64 / last as f64)
            .collect()
    }
}

/// A law with its constants for this bearing.
pub(super) fn law_of(torque: &Torque, moment: &Moment) -> Result<Friction<f64>, String> {
    moment.law(&torque.rated())
}

/// A word of a file as a part of a name.
pub(super) fn name_of(law: &str) -> String {
    format!("law_{}", law.replace(' ', "_"))
}

/// Computes the moments and names them.
pub(super) fn run(scenario: &Scenario, asked: &Asked) -> Outcome {
    let clock = Instant::now();
    let torque = asked.torque;
    let history = history(asked);
    let quantities = quantities_torque::name(asked);
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
        warnings: warnings_torque::of(scenario, asked),
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
        members: Vec::new(),
        picture: Picture {
            clearance: None,
            pressure_limit: None,
            rolling_cage_ratio: asked.set.cage_speed(1.0),
            balls: torque.ball_count,
        },
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
