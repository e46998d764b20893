//! The kind of cases of lubricant films.
//!
//! | kind | inputs | quantities |
//! |---|---|---|
//! | `film_thickness` | all of `hertz_point_contact`; `viscosity` (dynamic, of the inlet), `pressure_coefficient`, `entrainment` or `race_speed` (of the inner race against the outer, the balls rolling; needs `pitch_diameter`), `supply` (1), `combined_roughness` | `entrainment`, `speed_parameter`, `material_parameter`, `load_parameter`, `ellipticity`, `central_film`, `minimum_film`; with a roughness `lambda_ratio` of the minimum |
//!
//! The film is steady and isothermal: neither squeeze nor heating of the inlet.

use super::inputs::{BallOnRace, Computed, Inputs, ball_on_race, law, positive, ratio};
use crate::compare::told;
use physics::film::{EntrainedContact, FilmThickness, lambda_ratio};
use units::Dimension;

/// A contact with its film.
pub(super) fn film_thickness(inputs: &mut Inputs) -> Result<Vec<Computed>, String> {
    let of = |unit: &str| units::parse_quantity(unit).map(|unit| unit.dimension);
    let dynamic_viscosity = of("1 Pa s").map_err(told)?;
    let per_pressure = of("1 1/Pa").map_err(told)?;
    let given = ball_on_race(inputs)?;
    let mut taken = |key: &str, dimension| positive(key, inputs.quantity(key, dimension)?);
    let viscosity = taken("viscosity", dynamic_viscosity)?;
    let pressure_coefficient = taken("pressure_coefficient", per_pressure)?;
    let entrainment = entrainment(inputs, &given)?;
    let supply = inputs.maybe_number("supply")?.unwrap_or(1.0);
    if !(supply > 0.0 && supply <= 1.0) {
        return Err("inputs.supply: above 0 up to 1 is needed".to_string());
    }
    let contact = EntrainedContact::new(given.curvature, given.modulus).map_err(told)?;
    let groups = contact.groups(viscosity, pressure_coefficient, entrainment, given.load);
    let film = FilmThickness::new(&contact, viscosity, pressure_coefficient, supply);
    let minimum = film.minimum(entrainment, given.load);
    let thickness = |quantity, value| law(quantity, Dimension::LENGTH, value);
    let mut computed = vec![
        law("entrainment", Dimension::SPEED, entrainment),
        ratio("speed_parameter", groups.speed),
        ratio("material_parameter", groups.material),
        ratio("load_parameter", groups.load),
        ratio("ellipticity", contact.ellipticity),
        thickness("central_film", film.central(entrainment, given.load)),
        thickness("minimum_film", minimum),
    ];
    if let Some(roughness) = inputs.maybe_quantity("combined_roughness", Dimension::LENGTH)? {
        let roughness = positive("combined_roughness", roughness)?;
        computed.push(ratio("lambda_ratio", lambda_ratio(minimum, roughness, 0.0)));
    }
    Ok(computed)
}

/// The mean of both surface speeds: given, or that of balls that roll.
fn entrainment(inputs: &mut Inputs, given: &BallOnRace) -> Result<f64, String> {
    let direct = inputs.maybe_quantity("entrainment", Dimension::SPEED)?;
    let turning = inputs.maybe_quantity("race_speed", Dimension::ANGULAR_SPEED)?;
    match (direct, turning) {
        (Some(speed), None) => positive("entrainment", speed),
        (None, Some(speed)) => {
            let Some(pitch) = given.pitch_diameter else {
                return Err("inputs.race_speed: pitch_diameter is needed with it".to_string());
            };
            // the cage turns at (1 - d cos α/d_m)/2 of the race's speed: both surfaces pass the contact with this
            let across = given.ball_diameter * given.contact_angle.cos();
            let arm = (pitch * pitch - across * across) / (4.0 * pitch);
            Ok(positive("race_speed", speed)? * arm)
        }
        _ => Err("inputs: either entrainment or race_speed is needed".to_string()),
    }
}
