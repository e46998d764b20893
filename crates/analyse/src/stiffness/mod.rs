//! Quasi-static equilibrium and stiffness of a ball bearing, or of a pair, under given loads and speed.
//!
//! ```text
//!   balls between toroidal grooves, centrifugal and gyroscopic loads (model::spatial::statics);  K = -∂(force, moment)/∂u
//!   arrangements   single;  DB (O, back to back), DF (X, face to face), DT (tandem): rows at ± half the spacing
//!   preload of a pair by an offset: the inner grooves are moved by it, so that the pair is closed by so much
//! ```
//! A deep-groove bearing alone stands with its grooves opposite each other and takes thrust from both sides.

pub mod answer;
mod asked;
pub mod warnings;

pub use answer::Answer;
pub use asked::{Asked, Typed};

use asked::Arrangement;
use model::spatial::race::RaceGroove;
use model::spatial::statics::ball::Running;
use model::spatial::statics::{RingLoad, StaticBall, StaticRow, StaticRows};
use physics::groove::{
    axis_over_root_approach, centre_distance, contact_surface_radius, pure_axial_load,
};
use physics::hertz::{BallRace, NotAPoint, PointContact, Race};
use physics::load_zone::joint_stiffness;
use physics::materials::{BEARING_STEEL, ball_mass, contact_modulus};
use problem::{Code, Problem, Result};

/// Contacts of a ball with both races.
struct Contacts {
    inner: PointContact,
    outer: PointContact,
}

impl Asked {
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

    /// The row at a place, its contact angle of a sign; 0 for grooves that stand opposite each other.
    fn row(&self, contacts: &Contacts, place: f64, sign: f64, offset: f64) -> StaticRow {
        let (cosine, sine) = (self.free_angle.cos(), self.free_angle.sin());
        let groove = |contact: &PointContact, curvature: f64, out: f64, place: f64| RaceGroove {
            centre_radius: 0.5 * self.pitch_diameter + out * cosine,
            place,
            slack: (curvature - 0.5) * self.ball_diameter,
            stiffness: contact.stiffness,
            half_axis: axis_over_root_approach(contact),
            half_curvature: 0.5
                / contact_surface_radius(0.5 * self.ball_diameter, curvature * self.ball_diameter),
        };
        let [inner, outer] = self.curvatures.map(|f| (f - 0.5) * self.ball_diameter);
        let (to_inner, to_outer) = (sign * (inner * sine + 0.5 * offset), -sign * outer * sine);
        StaticRow {
            balls: self.balls,
            first_azimuth: 0.0,
            ball: StaticBall {
                radius: 0.5 * self.ball_diameter,
                mass: ball_mass(self.ball_diameter, self.ball_material.density),
                inner: groove(&contacts.inner, self.curvatures[0], inner, place + to_inner),
                outer: groove(
                    &contacts.outer,
                    self.curvatures[1],
                    -outer,
                    place + to_outer,
                ),
            },
        }
    }

    /// Distance by which a pair is closed under a preload, m: twice the axial displacement of one row.
    fn offset_of(&self, contacts: &Contacts, preload: f64) -> Option<f64> {
        let stiffness = joint_stiffness(contacts.inner.stiffness, contacts.outer.stiffness);
        let distance = centre_distance(self.curvatures, self.ball_diameter);
        let at =
            |angle: f64| pure_axial_load(self.balls, stiffness, distance, self.free_angle, angle);
        let (mut low, mut high) = (self.free_angle, 1.5);
        if at(high)[0] < preload {
            return None;
        }
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if at(middle)[0] < preload {
                low = middle
            } else {
                high = middle
            }
        }
        Some(2.0 * at(high)[1])
    }

    /// Rows, with the offset of a pair.
    fn rows(&self, contacts: &Contacts) -> Option<(StaticRows, f64)> {
        let offset = match (self.offset, self.preload) {
            (Some(offset), _) => offset,
            (None, Some(preload)) => self.offset_of(contacts, preload)?,
            (None, None) => 0.0,
        };
        let half = 0.5 * self.spacing;
        let rows = match self.arrangement {
            Arrangement::Single => {
                let sign = if self.opposite { 0.0 } else { 1.0 };
                vec![self.row(contacts, 0.0, sign, 0.0)]
            }
            // rows by rising place; the sign is that of the thrust the row takes on the inner ring
            Arrangement::BackToBack => vec![(-half, 1.0), (half, -1.0)]
                .into_iter()
                .map(|(place, sign)| self.row(contacts, place, sign, offset))
                .collect(),
            Arrangement::FaceToFace => vec![(-half, -1.0), (half, 1.0)]
                .into_iter()
                .map(|(place, sign)| self.row(contacts, place, sign, offset))
                .collect(),
            Arrangement::Tandem => [-half, half]
                .map(|place| self.row(contacts, place, 1.0, 0.0))
                .to_vec(),
        };
        Some((StaticRows(rows), offset))
    }
}

/// Equilibrium and stiffness; `place` stands for the file in messages.
///
/// # Errors
/// A preload that no contact angle carries, and loads under which no equilibrium is found.
pub fn run(asked: &Asked, place: &str) -> Result<Answer> {
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
        .then(|| rows.at(Default::default(), &running).ok())
        .flatten();
    Ok(Answer::new(asked, &contacts, offset, (loaded, preloaded)))
}
