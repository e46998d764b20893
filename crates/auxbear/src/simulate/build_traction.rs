//! From the traction of a scenario to a law of the model.

use super::build_bearing::{BallContacts, SCENARIO};
use crate::problem::{Code, Problem};
use crate::scenario::{BallMaterial, Bearing, OilFilm, Traction as TractionChoice};
use physics::film::EntrainedContact;
use physics::hertz::{Curvature, PointContact};
use physics::lubricant_traction::{
    Asperities, LubricantTraction, LubricatedContact, SILICON_NITRIDE_SURFACE, STEEL_SURFACE,
};
use physics::traction::{
    DryTraction, FourParameterTraction, LubricatedRaces, TanhTraction, Traction,
};

/// The traction law of a bearing.
pub(super) fn traction(
    bearing: &Bearing,
    contacts: &BallContacts,
) -> Result<Traction<f64>, Box<Problem>> {
    Ok(match bearing.traction {
        TractionChoice::Tanh {
            maximum,
            reference_speed,
        } => Traction::Tanh(TanhTraction {
            maximum,
            inverse_reference_speed: 1.0 / reference_speed,
        }),
        TractionChoice::FourParameter { a, b, c, d } => {
            Traction::FourParameter(FourParameterTraction { a, b, c, d })
        }
        TractionChoice::Dry {
            kinetic_coefficient,
            static_coefficient,
            decay_speed,
            reference_speed,
        } => Traction::Dry(DryTraction {
            kinetic: kinetic_coefficient,
            static_excess: static_coefficient - kinetic_coefficient,
            inverse_decay_speed: 1.0 / decay_speed,
            inverse_reference_speed: 1.0 / reference_speed,
        }),
        TractionChoice::Lubricant(film) => {
            let [inner, outer] = contacts.curvatures;
            let of = |curvature, hertz: &PointContact, key| {
                lubricated(&film, bearing, contacts.modulus, curvature, hertz).map_err(|why| {
                    Box::new(
                        Problem::new(
                            Code::Impossible,
                            SCENARIO,
                            why,
                            "a contact that a law of oil films can describe is needed",
                        )
                        .on_key(key),
                    )
                })
            };
            Traction::Lubricated(LubricatedRaces {
                inner: of(inner, &contacts.inner, "bearing.inner_groove_curvature")?,
                outer: of(outer, &contacts.outer, "bearing.outer_groove_curvature")?,
            })
        }
    })
}

/// The law of one contact, or why there is none.
fn lubricated(
    film: &OilFilm,
    bearing: &Bearing,
    modulus: f64,
    curvature: Curvature,
    hertz: &PointContact,
) -> Result<LubricantTraction<f64>, String> {
    let ball = match bearing.ball_material {
        BallMaterial::Steel => STEEL_SURFACE,
        BallMaterial::SiliconNitride => SILICON_NITRIDE_SURFACE,
    };
    let told = |error: &dyn std::fmt::Display| error.to_string();
    let lubricant = (film.oil.at(film.temperature, film.conductivity)).map_err(|e| told(&e))?;
    LubricatedContact {
        entrained: EntrainedContact::new(curvature, modulus).map_err(|_| {
            "a contact ellipse that is long along the rolling direction".to_string()
        })?,
        hertz: *hertz,
        lubricant,
        supply: film.supply,
        surfaces: [STEEL_SURFACE, ball],
        asperities: Asperities {
            friction: film.boundary_friction_coefficient,
            ..Asperities::raceway(film.composite_roughness, film.boundary_reference_speed)
        },
    }
    .traction()
    .map_err(|error| told(&error))
}
