//! The torque of a bearing over speed, load and acceleration, as typed values in SI.

use super::bearing::{BallMaterial, BearingType, ball_material};
use super::moment::{AccelerationLoss, Moment, RatedBearing};
use super::resolve::Values;
use super::section::Section;

/// A bearing whose torque is computed without motion. All values are SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Torque {
    /// Name in the catalogue.
    pub name: Option<String>,
    /// Type.
    pub kind: BearingType,
    /// Number of balls.
    pub ball_count: usize,
    /// Diameter of a ball, m.
    pub ball_diameter: f64,
    /// Diameter of the circle through the ball centres, m.
    pub pitch_diameter: f64,
    /// Material of the balls.
    pub ball_material: BallMaterial,
    /// Static load rating, N.
    pub static_load_rating: Option<f64>,
    /// Mass of the cage, kg.
    pub cage_mass: f64,
    /// Mass of one ball, kg; derived from diameter and material where it is `None`.
    pub ball_mass: Option<f64>,
    /// Steady friction moment.
    pub moment: Moment,
    /// Friction of the balls in their pockets while the race accelerates.
    pub acceleration_loss: AccelerationLoss,
}

impl Torque {
    pub(super) fn from_values(values: &Values) -> Torque {
        let bearing = Section {
            values,
            path: "bearing",
        };
        Torque {
            name: values.text("bearing.name"),
            kind: BearingType::of(bearing.word("type")),
            ball_count: bearing.count("ball_count") as usize,
            ball_diameter: bearing.number("ball_diameter"),
            pitch_diameter: bearing.number("pitch_diameter"),
            ball_material: ball_material(&bearing),
            static_load_rating: bearing.maybe("static_load_rating"),
            cage_mass: bearing.number("cage_mass"),
            ball_mass: bearing.maybe("ball_mass"),
            moment: Moment::from_values(values),
            acceleration_loss: AccelerationLoss::from_values(values),
        }
    }

    /// What a friction law needs to know of the bearing.
    pub fn rated(&self) -> RatedBearing {
        RatedBearing {
            kind: self.kind,
            pitch_diameter: self.pitch_diameter,
            static_load_rating: self.static_load_rating,
            ball_material: self.ball_material,
        }
    }
}
