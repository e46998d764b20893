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

#[cfg(test)]
mod tests {
    use crate::case;
    use crate::report::Verdict;
    use crate::shipped::CASES;
    use crate::simulator::LawsOnly;

    fn shipped() -> &'static str {
        CASES
            .iter()
            .find(|(name, _)| *name == "film_209_inner")
            .map(|(_, text)| *text)
            .unwrap()
    }

    #[test]
    fn a_film_in_other_units_of_length_force_and_time_is_the_same() {
        // lengths twice, forces 8 times, times three times as large: the dimensionless groups do not change
        let scaled = shipped()
            .replace("12.7 mm", "25.4 mm")
            .replace("6.604 mm", "13.208 mm")
            .replace("64.9985 mm", "129.997 mm")
            .replace("0.06490377 um", "0.12980754 um")
            .replace("4944.444444444444 N", "39555.555555555555 N")
            .replace("200 GPa", "400 GPa")
            .replace("400 rad/s", "133.33333333333333 rad/s")
            .replace("0.04 Pa s", "0.24 Pa s")
            .replace("2.3e-8 1/Pa", "1.15e-8 1/Pa")
            .replace("6.251705812 m/s", "4.167803875 m/s")
            .replace("0.552660091 um", "1.105320182 um")
            .replace("0.690356389 um", "1.380712778 um");
        for text in [shipped(), &scaled] {
            let rows = case::rows(text, &LawsOnly);
            assert_eq!(rows.len(), 8);
            assert!(
                rows.iter().all(|row| row.verdict == Verdict::Pass),
                "{rows:?}"
            );
        }
    }
    #[test]
    fn a_speed_is_given_once() {
        let both = shipped().replace("race_speed", "entrainment = \"6 m/s\"\nrace_speed");
        let rows = case::rows(&both, &LawsOnly);
        assert!(
            rows.iter().all(|row| row.verdict == Verdict::Fail),
            "{rows:?}"
        );
    }
}
