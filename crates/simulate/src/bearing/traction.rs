//! From the traction of a scenario to a law of the model.

use crate::bearing::contacts::BallContacts;
use physics::film::EntrainedContact;
use physics::hertz::{Curvature, PointContact};
use physics::inlet_rolling::ResistanceAtRaces;
use physics::lubricant_traction::{
    Asperities, LubricantTraction, LubricatedContact, SILICON_NITRIDE_SURFACE, STEEL_SURFACE,
};
use physics::traction::{
    DryTraction, FourParameterTraction, LubricatedRaces, TanhTraction, Traction,
};
use problem::{Code, Problem};
use scenario::{BallMaterial, Bearing, OilFilm, Traction as TractionChoice, problem_at};

/// The traction law of a bearing.
pub(crate) fn traction(
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
            let [inner, outer] = film_contacts(&film, bearing, contacts)?;
            Traction::Lubricated(LubricatedRaces {
                inner: inner.law,
                outer: outer.law,
            })
        }
    })
}

/// The rolling resistance of the oil in the inlets, where the bearing has an oil.
pub(crate) fn inlet_rolling(
    bearing: &Bearing,
    contacts: &BallContacts,
) -> Result<Option<ResistanceAtRaces<f64>>, Box<Problem>> {
    let TractionChoice::Lubricant(film) = &bearing.traction else {
        return Ok(None);
    };
    let [inner, outer] = film_contacts(film, bearing, contacts)?
        .map(|film| film.contact.resistance(ROLLING_REFERENCE_SPEED));
    Ok(Some(ResistanceAtRaces { inner, outer }))
}

/// Rolling speed at which the couple of an inlet has 71 % of its size, m/s: a regularisation of its sign. The force behind it
/// is by then a hundredth of what it is at 10 m/s.
const ROLLING_REFERENCE_SPEED: f64 = 0.01;

/// A contact with a film, and its traction law.
struct FilmContact {
    contact: LubricatedContact,
    law: LubricantTraction<f64>,
}

/// The contacts at the inner and the outer race.
fn film_contacts(
    film: &OilFilm,
    bearing: &Bearing,
    contacts: &BallContacts,
) -> Result<[FilmContact; 2], Box<Problem>> {
    let [inner, outer] = contacts.curvatures;
    let of = |curvature, hertz: &PointContact, key| {
        lubricated(film, bearing, contacts.modulus, curvature, hertz).map_err(|why| {
            let allowed = "a contact that a law of oil films can describe is needed";
            problem_at(Code::Impossible, key, why, allowed)
        })
    };
    Ok([
        of(inner, &contacts.inner, "bearing.inner_groove_curvature")?,
        of(outer, &contacts.outer, "bearing.outer_groove_curvature")?,
    ])
}

/// The law of one contact, or why there is none.
fn lubricated(
    film: &OilFilm,
    bearing: &Bearing,
    modulus: f64,
    curvature: Curvature,
    hertz: &PointContact,
) -> Result<FilmContact, String> {
    let ball = match bearing.ball_material {
        BallMaterial::Steel => STEEL_SURFACE,
        BallMaterial::SiliconNitride => SILICON_NITRIDE_SURFACE,
    };
    let text = |error: &dyn std::fmt::Display| error.to_string();
    let lubricant = (film.oil.at(film.temperature, film.conductivity)).map_err(|e| text(&e))?;
    let contact = LubricatedContact {
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
    };
    let law = contact.traction().map_err(|error| text(&error))?;
    Ok(FilmContact { contact, law })
}
