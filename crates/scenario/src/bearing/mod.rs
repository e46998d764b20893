//! A bearing as typed values in SI.

pub mod checks;
pub mod checks_fits;
pub mod checks_lubricant;
pub mod checks_separation;
pub mod checks_spatial;
pub mod derive;
pub mod factors;
pub mod fits;
pub mod from_catalogue;
pub mod keys;
pub mod keys_cage;
pub mod keys_lubricant_state;
pub mod keys_moment;
pub mod keys_spatial;
pub mod kind;
pub mod lubricant;
pub mod lubricant_state;
pub mod moment;
pub mod separation;
pub mod source;
pub mod spatial;

use crate::bearing::fits::{Fits, Growth};
use crate::bearing::kind::{BallMaterial, BearingType, Fidelity};
use crate::bearing::lubricant_state::LubricantState;
use crate::bearing::moment::{AccelerationLoss, Moment, MomentShare, RatedBearing};
use crate::bearing::separation::Separation;
use crate::bearing::spatial::Spatial;
use crate::section::Section;
use crate::values::Values;
use physics::lubricant::{FVA_3, Lubricant, NAPHTHENIC_100, POLYALPHAOLEFIN_100};
use physics::rolling::{RollingSet, ring_mass};
use problem::words;
use std::f64::consts::PI;

/// The auxiliary bearing at one plane. What is `None` is not known, or is found when the
/// machine is built.
#[derive(Clone, Debug, PartialEq)]
pub struct Bearing {
    /// Name in the catalogue.
    pub name: Option<String>,
    /// Type: it chooses factors of the friction moment.
    pub kind: BearingType,
    /// How it is modelled.
    pub fidelity: Fidelity,
    /// What it has in space; none in the plane.
    pub spatial: Option<Spatial>,
    /// Number of balls.
    pub ball_count: usize,
    /// Diameter of a ball, m.
    pub ball_diameter: f64,
    /// Diameter of the circle through the ball centres, m.
    pub pitch_diameter: f64,
    /// Contact angle, rad; 0 for a radial contact.
    pub contact_angle: f64,
    /// Axial preload, N; 0 where there is none.
    pub axial_preload: f64,
    /// Diametral internal clearance as mounted, at rest, m; negative is preload.
    pub operating_diametral_clearance: f64,
    /// The same before mounting, m, where fits reduce it.
    pub unmounted_diametral_clearance: Option<f64>,
    /// How the inner race grows with its speed.
    pub inner_race_growth: Growth,
    /// Groove radius of the inner race over ball diameter.
    pub inner_groove_curvature: f64,
    /// Groove radius of the outer race over ball diameter.
    pub outer_groove_curvature: f64,
    /// Material of the balls.
    pub ball_material: BallMaterial,
    /// Static load rating, N.
    pub static_load_rating: Option<f64>,
    /// Dynamic load rating, N.
    pub dynamic_load_rating: Option<f64>,
    /// Limiting speed in continuous running, rad/s.
    pub limiting_speed: Option<f64>,
    /// Mass of the inner race with its sleeve, kg; 0 where it sits on a shaft.
    pub inner_race_mass: f64,
    /// Moment of inertia of the inner race with its sleeve, kg m².
    pub inner_race_inertia: f64,
    /// Mass of one ball, kg.
    pub ball_mass: Option<f64>,
    /// Stiffness of ball and inner race, N/m^1.5.
    pub inner_contact_stiffness: Option<f64>,
    /// Stiffness of ball and outer race, N/m^1.5.
    pub outer_contact_stiffness: Option<f64>,
    /// Retardation time of the ball contacts, s.
    pub contact_damping_time: f64,
    /// Whether the centre of the inner race is held.
    pub inner_race_centre_held: bool,
    /// Torque from ground on the inner race, N m.
    pub inner_race_torque: f64,
    /// Angle of the first ball at the release, rad from x.
    pub first_ball_angle: f64,
    /// Contact pressure of balls and races that results are compared with, Pa.
    pub hertz_pressure_limit: f64,
    /// What keeps the balls apart.
    pub separation: Separation,
    /// How the rings sit.
    pub fits: Fits,
    /// Traction between balls and races.
    pub traction: Traction,
    /// Drag to ground.
    pub drag: Drag,
    /// Steady friction moment.
    pub moment: Moment,
    /// How balls that move by themselves share it.
    pub moment_share: MomentShare,
    /// Friction of the balls in their pockets while the race accelerates.
    pub acceleration_loss: AccelerationLoss,
    /// Slow state of the lubricant; none where nothing of it changes.
    pub lubricant_state: Option<LubricantState>,
}

/// Traction coefficient as a function of the slip speed u.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Traction {
    /// maximum · tanh(u / reference speed).
    Tanh {
        /// Largest coefficient.
        maximum: f64,
        /// Reference speed, m/s.
        reference_speed: f64,
    },
    /// sgn(u)[(a + b|u|) e^(-c|u|) + d].
    FourParameter {
        /// A.
        a: f64,
        /// B, s/m.
        b: f64,
        /// C, s/m.
        c: f64,
        /// D.
        d: f64,
    },
    /// From static at small slip to kinetic at high slip.
    Dry {
        /// Coefficient at high slip.
        kinetic_coefficient: f64,
        /// Coefficient at small slip.
        static_coefficient: f64,
        /// Slip speed of the fall, m/s.
        decay_speed: f64,
        /// Slip speed that regularises the law, m/s.
        reference_speed: f64,
    },
    /// From the film of an oil.
    Lubricant(OilFilm),
}

/// The film between balls and races.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OilFilm {
    /// The oil.
    pub oil: Lubricant,
    /// Its temperature where it enters the contacts, K.
    pub temperature: f64,
    /// Its thermal conductivity, W/(m K), where it is given.
    pub conductivity: Option<f64>,
    /// Root of the sum of squares of both rms roughnesses, m.
    pub composite_roughness: f64,
    /// Friction coefficient of asperities.
    pub boundary_friction_coefficient: f64,
    /// Slip speed that regularises friction, m/s.
    pub boundary_reference_speed: f64,
    /// Share of the flooded film that starvation leaves.
    pub supply: f64,
}

words! {
    /// Law of traction, as a word.
    pub enum TractionLaw {
        /// Hyperbolic tangent.
        Tanh = "tanh",
        /// Four parameters.
        FourParameter = "four parameter",
        Dry = "dry",
        /// From the film.
        Lubricant = "lubricant",
    }
}

words! {
    /// Oils with data for films and traction, as words.
    pub enum Oil {
        /// FVA 3, mineral.
        Fva3 = "FVA 3",
        /// A naphthenic oil.
        N100 = "N100",
        /// A polyalphaolefin.
        Pao100 = "PAO100",
    }
}

impl Oil {
    fn data(self) -> Lubricant {
        match self {
            Oil::Fva3 => FVA_3,
            Oil::N100 => NAPHTHENIC_100,
            Oil::Pao100 => POLYALPHAOLEFIN_100,
        }
    }
}

/// Drag of balls and cage to ground, to reproduce reference cases.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drag {
    /// Force on a ball over its orbital speed, N s/m.
    pub orbit: f64,
    /// Torque on a ball over its spin, N m s.
    pub spin: f64,
    /// Torque on the cage over its speed, N m s.
    pub cage: f64,
}

/// The bearing of a system in which it moves.
pub fn bearing(values: &Values) -> Bearing {
    let bearing = values.section("bearing");
    let drag = values.section("bearing.drag");
    let fidelity = bearing.choice("fidelity");
    Bearing {
        name: values.text("bearing.name"),
        kind: bearing.choice("type"),
        fidelity,
        spatial: (fidelity == Fidelity::Spatial).then(|| Spatial::of(values, &bearing)),
        ball_count: bearing.count("ball_count") as usize,
        ball_diameter: bearing.number("ball_diameter"),
        pitch_diameter: bearing.number("pitch_diameter"),
        contact_angle: bearing.maybe("contact_angle").unwrap_or(0.0),
        axial_preload: bearing.maybe("axial_preload").unwrap_or(0.0),
        operating_diametral_clearance: bearing.number("operating_diametral_clearance"),
        unmounted_diametral_clearance: bearing.maybe("unmounted_diametral_clearance"),
        inner_race_growth: bearing.chosen("inner_race_growth").unwrap_or(Growth::None),
        inner_groove_curvature: bearing.number("inner_groove_curvature"),
        outer_groove_curvature: bearing.number("outer_groove_curvature"),
        ball_material: ball_material(&bearing),
        static_load_rating: bearing.maybe("static_load_rating"),
        dynamic_load_rating: bearing.maybe("dynamic_load_rating"),
        limiting_speed: bearing.maybe("limiting_speed"),
        inner_race_mass: bearing.maybe("inner_race_mass").unwrap_or(0.0),
        inner_race_inertia: bearing.number("inner_race_inertia"),
        ball_mass: bearing.maybe("ball_mass"),
        inner_contact_stiffness: bearing.maybe("inner_contact_stiffness"),
        outer_contact_stiffness: bearing.maybe("outer_contact_stiffness"),
        contact_damping_time: bearing.number("contact_damping_time"),
        inner_race_centre_held: bearing.switch("inner_race_centre_held"),
        inner_race_torque: bearing.maybe("inner_race_torque").unwrap_or(0.0),
        first_ball_angle: bearing.number("first_ball_angle"),
        hertz_pressure_limit: bearing.number("hertz_pressure_limit"),
        separation: Separation::from_values(values),
        fits: Fits::from_values(values),
        traction: traction(&values.section("bearing.traction")),
        drag: Drag {
            orbit: drag.maybe("orbit").unwrap_or(0.0),
            spin: drag.maybe("spin").unwrap_or(0.0),
            cage: drag.maybe("cage").unwrap_or(0.0),
        },
        moment: Moment::from_values(values),
        moment_share: MomentShare::from_values(values),
        acceleration_loss: AccelerationLoss::from_values(values),
        lubricant_state: LubricantState::from_values(values),
    }
}

/// Mass of the ring at the pitch circle that turns as the cage does, kg; 0 where no cage is known.
pub fn cage_ring_mass(bearing: &Section<'_>) -> f64 {
    let radius = 0.5 * bearing.number("pitch_diameter");
    (bearing.maybe("cage_inertia")).map_or(0.0, |inertia| ring_mass(inertia, radius))
}

pub(crate) fn ball_material(bearing: &Section<'_>) -> BallMaterial {
    bearing.choice("ball_material")
}

fn traction(traction: &Section<'_>) -> Traction {
    match traction.choice("law") {
        TractionLaw::Tanh => Traction::Tanh {
            maximum: traction.number("maximum"),
            reference_speed: traction.number("reference_speed"),
        },
        TractionLaw::FourParameter => Traction::FourParameter {
            a: traction.number("a"),
            b: traction.number("b"),
            c: traction.number("c"),
            d: traction.number("d"),
        },
        TractionLaw::Dry => Traction::Dry {
            kinetic_coefficient: traction.number("kinetic"),
            static_coefficient: traction.number("static"),
            decay_speed: traction.number("decay_speed"),
            reference_speed: traction.number("reference_speed"),
        },
        TractionLaw::Lubricant => Traction::Lubricant(OilFilm {
            oil: traction.choice::<Oil>("oil").data(),
            temperature: traction.number("oil_temperature"),
            conductivity: traction.maybe("oil_conductivity"),
            composite_roughness: traction.number("composite_roughness"),
            boundary_friction_coefficient: traction.number("boundary_friction_coefficient"),
            boundary_reference_speed: traction.number("boundary_reference_speed"),
            supply: traction.number("supply"),
        }),
    }
}

impl Bearing {
    /// Distance of the contacts from a ball's centre in the plane, m.
    pub fn contact_radius(&self) -> f64 {
        0.5 * self.ball_diameter * self.contact_angle.cos()
    }
    /// Radius of the inner track at rest where the plane meets it, m.
    pub fn inner_track_radius(&self) -> f64 {
        0.5 * self.pitch_diameter - self.contact_radius()
    }
    /// Mass of one ball, kg.
    pub fn mass_of_ball(&self) -> f64 {
        self.ball_mass
            .unwrap_or_else(|| self.ball_material.ball_mass(self.ball_diameter))
    }
    /// Mass and moment of inertia of the inner race, kg and kg m², of all rows on it.
    pub fn inner_race(&self) -> [f64; 2] {
        let rows = self.spatial.map_or(1, |own| own.arrangement.rows()) as f64;
        [self.inner_race_mass * rows, self.inner_race_inertia * rows]
    }
    /// Masses and radii of balls and cage, as they turn.
    pub fn rolling_set(&self) -> RollingSet<f64> {
        let track = self.inner_track_radius();
        RollingSet {
            inner_track_radius: track,
            ball_ratio: self.contact_radius() / track,
            balls_mass: self.ball_count as f64 * self.mass_of_ball(),
            cage_mass: match &self.separation {
                Separation::Cage(cage) => ring_mass(cage.inertia, 0.5 * self.pitch_diameter),
                Separation::FullComplement(_) => 0.0,
            },
        }
    }
    /// Contact pressure of neighbouring balls that results are compared with, Pa; none where a cage keeps them apart.
    pub fn neighbour_pressure_limit(&self) -> Option<f64> {
        match &self.separation {
            Separation::Cage(_) => None,
            Separation::FullComplement(row) => Some(row.hertz_pressure_limit),
        }
    }
    /// What neighbouring balls leave between each other on the pitch circle, along the chord, m; below zero they do not fit.
    pub fn gap_between_balls(&self) -> f64 {
        let chord = self.pitch_diameter * (PI / self.ball_count as f64).sin();
        chord - self.ball_diameter
    }
    /// What a friction law needs to know of it.
    pub fn rated(&self) -> RatedBearing {
        RatedBearing {
            kind: self.kind,
            pitch_diameter: self.pitch_diameter,
            static_load_rating: self.static_load_rating,
            ball_material: self.ball_material,
            in_space: self.spatial.is_some(),
        }
    }

    /// Growth of the inner track's radius with the square of its speed, m s².
    pub fn inner_track_growth(&self) -> f64 {
        self.fits.bore_diameter.map_or(0.0, |bore| {
            let track = self.pitch_diameter - self.ball_diameter;
            (self.inner_race_growth).of_track(track, bore, self.fits.shaft_bore_diameter)
        })
    }

    /// Speed at which an inner ring that is said to grow with its shaft leaves it, rad/s, where that is below a speed.
    pub fn lifts_off_below(&self, speed: f64) -> Option<f64> {
        if self.inner_race_growth != Growth::WithShaft {
            return None;
        }
        let fit = self
            .fits
            .on_shaft(self.pitch_diameter - self.ball_diameter)?;
        Some(fit.lift_off_speed()).filter(|lift_off| *lift_off < speed)
    }
}
