//! What keeps the balls apart, as typed values in SI.

use crate::values::{Value, Values};
use problem::words;

words! {
    /// What keeps the balls apart, as a word.
    pub enum SeparationKind {
        Cage = "cage",
        /// The next ball.
        FullComplement = "full complement",
    }
}

words! {
    /// What guides a cage, as a word.
    pub enum GuidanceKind {
        /// It is centred.
        Centred = "centred",
        /// Its balls.
        Balls = "balls",
        /// A land of the inner ring.
        InnerLand = "inner land",
        /// A land of the outer ring.
        OuterLand = "outer land",
    }
}

/// What keeps the balls apart.
#[derive(Clone, Debug, PartialEq)]
pub enum Separation {
    /// A cage.
    Cage(Cage),
    /// The next ball.
    FullComplement(FullComplement),
}

/// A cage.
#[derive(Clone, Debug, PartialEq)]
pub struct Cage {
    /// Mass, kg.
    pub mass: f64,
    /// Moment of inertia, kg m².
    pub inertia: f64,
    /// Whether balls and cage touch at all.
    pub pocket_contact: bool,
    /// One-sided gap along the pitch circle, m.
    pub pocket_gap: f64,
    /// Stiffness, N/m.
    pub pocket_stiffness: f64,
    /// Hunt-Crossley damping, s/m.
    pub pocket_damping: f64,
    /// Coefficient of friction.
    pub pocket_friction_coefficient: f64,
    /// Slip speed that regularises the friction, m/s.
    pub pocket_friction_reference_speed: f64,
    /// What guides it.
    pub guidance: Guidance,
}

/// What guides a cage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Guidance {
    /// Its centre is that of the outer race.
    Centred,
    /// Its pockets.
    Balls,
    /// A land of the inner ring.
    InnerLand(Land),
    /// A land of the outer ring.
    OuterLand(Land),
}

/// A land.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Land {
    /// Radial clearance, m.
    pub radial_clearance: f64,
    /// Diameter of the ring's land, m.
    pub diameter: f64,
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Hunt-Crossley damping, s/m.
    pub damping: f64,
    /// Coefficient of friction.
    pub friction_coefficient: f64,
    /// Slip speed that regularises the friction, m/s.
    pub friction_reference_speed: f64,
}

/// Balls without a cage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FullComplement {
    /// Coefficient of friction between neighbours.
    pub friction_coefficient: f64,
    /// Slip speed that regularises it, m/s.
    pub friction_reference_speed: f64,
    /// Contact pressure of neighbours that results are compared with, Pa.
    pub hertz_pressure_limit: f64,
}

impl Separation {
    pub(crate) fn from_values(values: &Values) -> Self {
        let bearing = values.section("bearing");
        if bearing.choice::<SeparationKind>("separation") == SeparationKind::FullComplement {
            let row = values.section("bearing.full_complement");
            return Separation::FullComplement(FullComplement {
                friction_coefficient: row.number("friction_coefficient"),
                friction_reference_speed: row.number("friction_reference_speed"),
                hertz_pressure_limit: row.number("hertz_pressure_limit"),
            });
        }
        let cage = values.section("bearing.cage");
        let land = || Land {
            radial_clearance: cage.number("land_radial_clearance"),
            diameter: cage.number("land_diameter"),
            stiffness: cage.number("land_stiffness"),
            damping: cage.number("land_damping"),
            friction_coefficient: cage.number("land_friction_coefficient"),
            friction_reference_speed: cage.number("land_friction_reference_speed"),
        };
        Separation::Cage(Cage {
            mass: bearing.number("cage_mass"),
            inertia: bearing.number("cage_inertia"),
            pocket_contact: cage.switch("pocket_contact"),
            pocket_gap: cage.number("pocket_gap"),
            pocket_stiffness: cage.number("pocket_stiffness"),
            pocket_damping: cage.number("pocket_damping"),
            pocket_friction_coefficient: cage.number("pocket_friction_coefficient"),
            pocket_friction_reference_speed: cage.number("pocket_friction_reference_speed"),
            guidance: match cage.choice("guidance") {
                GuidanceKind::Centred => Guidance::Centred,
                GuidanceKind::Balls => Guidance::Balls,
                GuidanceKind::InnerLand => Guidance::InnerLand(land()),
                GuidanceKind::OuterLand => Guidance::OuterLand(land()),
            },
        })
    }

    /// Mass of the cage, kg; zero where there is none.
    pub fn cage_mass(&self) -> f64 {
        match self {
            Separation::Cage(cage) => cage.mass,
            Separation::FullComplement(_) => 0.0,
        }
    }
}

/// Height of a ring's shoulder at which a cage rides, as a share of the ball diameter from the pitch circle: between the
/// shoulders of deep groove bearings, which stand at 0.6 to 0.7.
const SHOULDER: f64 = 0.65;

impl Values {
    /// The land of a ring whose shoulder is not known.
    pub fn land_diameter(&mut self) -> crate::checks::Check {
        const LAND: &str = "bearing.cage.land_diameter";
        let (Some(pitch), Some(ball)) = (
            self.number("bearing.pitch_diameter"),
            self.number("bearing.ball_diameter"),
        ) else {
            return Ok(());
        };
        if !self.lacks(LAND) {
            return Ok(());
        }
        let (side, sign) = match self.chosen("bearing.cage.guidance") {
            Some(GuidanceKind::InnerLand) => (-1.0, '-'),
            Some(GuidanceKind::Centred | GuidanceKind::Balls | GuidanceKind::OuterLand) | None => {
                (1.0, '+')
            }
        };
        let how =
            format!("pitch_diameter {sign} {SHOULDER} ball_diameter: a usual shoulder, assumed");
        let land = Value::Number(pitch + side * SHOULDER * ball);
        self.put_derived(LAND, land, &how)
    }
}
