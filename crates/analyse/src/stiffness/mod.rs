//! Quasi-static equilibrium and stiffness of a ball bearing, a pair or a set, under given loads and speed.
//!
//! ```text
//!   balls between toroidal grooves, centrifugal and gyroscopic loads (model::spatial::statics);  K = -∂(force, moment)/∂u
//!   arrangements   single;  DB (O, back to back), DF (X, face to face), DT (tandem), sets of three and four: rows a spacing apart
//!   preload by an offset: the inner grooves are moved by half of it each, so that the rows are closed by so much
//!   preload by a spring: the outer rings of the rows that carry thrust towards -z slide along the axis against it
//! ```
//! A deep-groove bearing alone stands with its grooves opposite each other and takes thrust from both sides.

pub mod answer;
mod request;
pub mod warnings;

pub use answer::Answer;
pub use request::{Request, Typed};

use model::spatial::statics::ball::Running;
use model::spatial::statics::{RingLoad, StaticBall, StaticRow, StaticRows};
use model::spatial::{PreloadSpring, RowGeometry};
use physics::hertz::{BallRace, NotAPoint, PointContact, Race};
use physics::materials::{BEARING_STEEL, ball_mass, contact_modulus};
use problem::{Code, Problem, Result};

/// Stiffness of a spring that is solid, N/m: assumed, that of a shoulder on a face.
const SOLID: f64 = 2e8;

/// Contacts of a ball with both races.
struct Contacts {
    inner: PointContact,
    outer: PointContact,
}

impl Request {
    fn contacts(&self) -> std::result::Result<Contacts, NotAPoint> {
        let of = |race: Race, groove_curvature: f64| {
            let geometry = BallRace {
                ball_diameter: self.ball_diameter,
                pitch_diameter: self.pitch_diameter,
                groove_curvature,
                contact_angle: self.free_angle,
                race,
            };
            let modulus = contact_modulus(BEARING_STEEL, self.ball_material);
            PointContact::new(geometry.curvature(), modulus)
        };
        Ok(Contacts {
            inner: of(Race::Inner, self.curvatures[0])?,
            outer: of(Race::Outer, self.curvatures[1])?,
        })
    }

    /// Rows, with the offset of a pair.
    fn rows(&self, contacts: &Contacts) -> Option<(StaticRows, f64)> {
        let geometry = RowGeometry {
            signs: match self.opposite {
                true => vec![0.0],
                false => self.arrangement.signs().to_vec(),
            },
            spacing: self.spacing,
            balls: self.balls,
            ball_diameter: self.ball_diameter,
            pitch_diameter: self.pitch_diameter,
            curvatures: self.curvatures,
            free_angle: self.free_angle,
            contacts: [contacts.inner, contacts.outer],
        };
        let closed = match (self.offset, self.preload) {
            (Some(offset), _) => [0.5 * offset; 2],
            (None, Some(preload)) => geometry.closed_by(preload)?,
            (None, None) => [0.0; 2],
        };
        let offset = closed[0] + closed[1];
        let rows = geometry.grooves(closed).into_iter();
        let rows = rows.map(|(_, [inner, outer])| StaticRow {
            balls: self.balls,
            first_azimuth: 0.0,
            ball: StaticBall {
                radius: 0.5 * self.ball_diameter,
                mass: ball_mass(self.ball_diameter, self.ball_material.density),
                inner,
                outer,
            },
        });
        let spring = self.preload.zip(self.spring);
        let spring = spring.map(|(preload, [stiffness, travel])| PreloadSpring {
            side: -1.0,
            preload,
            stiffness,
            travel,
            stop_stiffness: SOLID,
            stop_damping: 0.0,
            mass: 0.0,
        });
        let rows = rows.collect();
        Some((StaticRows { rows, spring }, offset))
    }
}

/// Equilibrium and stiffness; `place` stands for the file in messages.
///
/// # Errors
/// A preload that no contact angle carries, and loads under which no equilibrium is found.
pub fn run(asked: &Request, place: &str) -> Result<Answer> {
    let impossible =
        |found: String, allowed: &str| Problem::new(Code::Impossible, place, found, allowed);
    let contacts = asked.contacts();
    let contacts = contacts
        .map_err(|why| impossible(why.to_string(), "another groove curvature is needed"))?;
    let Some((rows, offset)) = asked.rows(&contacts) else {
        let found = "a preload that no contact angle below 86 deg carries".to_string();
        return Err(impossible(found, "a smaller preload is needed").on_key("--preload"));
    };
    let load = RingLoad {
        force: [asked.radial, 0.0, asked.axial],
        moment: [0.0, asked.moment],
    };
    let running = Running {
        speed: asked.speed,
        control: asked.control,
    };
    let loaded = rows.settle(&load, &running);
    let loaded = loaded.map_err(|why| {
        let found = format!("loads and speed under which {why}");
        impossible(found, "loads that close the contacts are needed, and enough axial load for the speed: a ball that the inner race hardly holds cannot take its gyroscopic moment (--race-control outer leaves it to the outer race)")
    })?;
    let preloaded = (offset > 0.0)
        .then(|| match rows.spring {
            Some(_) => rows.settle(&RingLoad::default(), &running).ok(),
            None => rows.at(Default::default(), &running).ok(),
        })
        .flatten();
    let mut answer = Answer::new(asked, &contacts, offset, (loaded, preloaded));
    answer.add_spring(rows.spring.as_ref());
    Ok(answer)
}
