//! The Hertz contacts of the balls of a bearing.

use crate::bearing::pressure::PressureFactors;
use model::bearing::RaceContact;
use physics::flash::SkiddingContact;
use physics::heat_conduction::STEEL_HEAT;
use physics::hertz::{BallRace, Curvature, PointContact, Race};
use physics::materials::{BEARING_STEEL, contact_modulus};
use problem::{Code, Problem};
use scenario::{Bearing, Separation, problem_at};

/// The Hertz contacts of a ball, and its mass.
#[derive(Debug)]
pub(crate) struct BallContacts {
    pub inner: PointContact,
    pub outer: PointContact,
    /// Sums of curvatures at the inner and the outer race.
    pub curvatures: [Curvature; 2],
    /// Contact modulus E*, Pa.
    pub modulus: f64,
    pub inner_stiffness: f64,
    pub outer_stiffness: f64,
    /// Stiffness of two neighbouring balls, N/m^1.5.
    pub neighbour_stiffness: f64,
    /// Pressure between them per cube root of the force, Pa/N^(1/3); none where a cage keeps them apart.
    pub neighbour_pressure_factor: Option<f64>,
    pub ball_mass: f64,
}

impl BallContacts {
    pub fn pressure_factors(&self) -> PressureFactors {
        PressureFactors {
            races: [self.inner.pressure_factor, self.outer.pressure_factor],
            neighbours: self.neighbour_pressure_factor,
        }
    }
    /// What a ball does to the inner and to the outer race: heat where it slides, dents where it is loaded beyond the limit.
    pub fn races(&self, bearing: &Bearing) -> [RaceContact; 2] {
        let bodies = [bearing.ball_material.heat(), STEEL_HEAT];
        let of = |contact: &PointContact, curvature: &Curvature| {
            let mut axes = [contact.semi_major_factor, contact.semi_minor_factor];
            if curvature.difference() < 0.0 {
                axes.reverse();
            }
            RaceContact {
                skidding: SkiddingContact::new(axes, bodies),
                denting_load: contact.load_at_pressure(bearing.hertz_pressure_limit),
            }
        };
        let [inner, outer] = &self.curvatures;
        [of(&self.inner, inner), of(&self.outer, outer)]
    }
}

pub(crate) fn ball_contacts(bearing: &Bearing) -> Result<BallContacts, Box<Problem>> {
    let ball = bearing.ball_material.data();
    let modulus = contact_modulus(ball, BEARING_STEEL);
    let contact = |race: Race, groove_curvature: f64| {
        let curvature = BallRace {
            ball_diameter: bearing.ball_diameter,
            pitch_diameter: bearing.pitch_diameter,
            groove_curvature,
            contact_angle: bearing.contact_angle,
            race,
        }
        .curvature();
        let contact = PointContact::new(curvature, modulus).map_err(|_| {
            problem_at(
                Code::BearingGeometry,
                "bearing",
                format!("a groove curvature of {groove_curvature}, which gives no point contact"),
                "a groove curvature above 0.5 and balls smaller than the pitch diameter",
            )
        })?;
        Ok::<_, Box<Problem>>((contact, curvature))
    };
    let (inner, inner_curvature) = contact(Race::Inner, bearing.inner_groove_curvature)?;
    let (outer, outer_curvature) = contact(Race::Outer, bearing.outer_groove_curvature)?;
    let sphere = 4.0 / bearing.ball_diameter;
    let neighbours = PointContact::new(
        Curvature {
            axial: sphere,
            rolling: sphere,
        },
        contact_modulus(ball, ball),
    );
    Ok(BallContacts {
        // two spheres always make a point
        neighbour_stiffness: neighbours.as_ref().map_or(0.0, |contact| contact.stiffness),
        neighbour_pressure_factor: match &bearing.separation {
            Separation::Cage(_) => None,
            Separation::FullComplement(_) => neighbours.ok().map(|contact| contact.pressure_factor),
        },
        curvatures: [inner_curvature, outer_curvature],
        modulus,
        inner_stiffness: bearing.inner_contact_stiffness.unwrap_or(inner.stiffness),
        outer_stiffness: bearing.outer_contact_stiffness.unwrap_or(outer.stiffness),
        ball_mass: bearing.mass_of_ball(),
        inner,
        outer,
    })
}
