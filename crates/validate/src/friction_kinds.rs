//! The kinds of cases of the steady friction moment: SKF model, Palmgren's factors, viscosity of an oil.
//!
//! | kind | inputs | quantities |
//! |---|---|---|
//! | `skf_friction` | `type` ("deep_groove", "angular_contact_single_row", "angular_contact_double_row", "four_point_contact", "spherical_roller"), `series`, `bore`, `outer_diameter`, `width`, `static_load_rating` (deep groove), `viscosity`, `supply` ("oil_bath", "low_oil_bath_or_jet", "grease_or_oil_air"), `oil` ("mineral", "synthetic", "transmission"), `drag_variable` (0), `seal_moment` (0), `speed`, `radial_load`, `axial_load` (0) | `rolling_variable`, `rolling_moment`, `inlet_shear_factor`, `starvation_factor`, `sliding_variable`, `boundary_share`, `sliding_friction`, `sliding_moment`, `drag_moment`, `moment`, `starting_moment` |
//! | `palmgren_factors` | `type` ("deep_groove", "angular_contact", "angular_contact_double_row", "four_point_contact"), `series`, `lubrication` ("grease_or_oil_mist", "oil_bath") | `viscous_factor`, `load_factor`, `load_exponent` |
//! | `oil_viscosity` | `first_temperature`, `first_viscosity`, `second_temperature`, `second_viscosity`, `temperature` | `viscosity` |

use super::inputs::{Computed, Inputs, law, length, positive, ratio};
use crate::compare::told;
use physics::palmgren_factors::{FactorType, Lubrication, palmgren_factors};
use physics::skf_constants::{SkfBearing, SkfLubricant, SkfOil, SkfSupply, SkfType};
use physics::viscosity::Viscosity;
use units::Dimension;

/// The value of the word found, out of words with their values.
fn choice<T: Copy>(inputs: &mut Inputs, key: &str, values: &[(&str, T)]) -> Result<T, String> {
    let words: Vec<_> = values.iter().map(|value| value.0).collect();
    let word = inputs.word(key, &words)?;
    values
        .iter()
        .find(|value| value.0 == word)
        .map(|value| value.1)
        .ok_or_else(|| format!("inputs.{key}: one of {} is needed", words.join(", ")))
}

/// An SKF bearing with its lubricant at one speed and load.
pub(super) fn skf_friction(inputs: &mut Inputs) -> Result<Vec<Computed>, String> {
    let kind = choice(
        inputs,
        "type",
        &[
            ("deep_groove", SkfType::DeepGroove),
            (
                "angular_contact_single_row",
                SkfType::AngularContactSingleRow,
            ),
            (
                "angular_contact_double_row",
                SkfType::AngularContactDoubleRow,
            ),
            ("four_point_contact", SkfType::FourPointContact),
            ("spherical_roller", SkfType::SphericalRoller),
        ],
    )?;
    let series = inputs.text("series")?;
    let bearing = SkfBearing {
        kind,
        series: &series,
        bore: length(inputs, "bore")?,
        outer_diameter: length(inputs, "outer_diameter")?,
        width: length(inputs, "width")?,
        static_load_rating: inputs.maybe_quantity("static_load_rating", Dimension::FORCE)?,
        ceramic_balls: false,
    };
    let lubricant = SkfLubricant {
        viscosity: inputs.quantity("viscosity", Dimension::KINEMATIC_VISCOSITY)?,
        supply: choice(
            inputs,
            "supply",
            &[
                ("oil_bath", SkfSupply::OilBath),
                ("low_oil_bath_or_jet", SkfSupply::LowOilBathOrJet),
                ("grease_or_oil_air", SkfSupply::GreaseOrOilAir),
            ],
        )?,
        oil: choice(
            inputs,
            "oil",
            &[
                ("mineral", SkfOil::Mineral),
                ("synthetic", SkfOil::Synthetic),
                ("transmission", SkfOil::Transmission),
            ],
        )?,
        drag_variable: inputs.maybe_number("drag_variable")?.unwrap_or(0.0),
        seal_moment: inputs
            .maybe_quantity("seal_moment", Dimension::TORQUE)?
            .unwrap_or(0.0),
    };
    let speed = inputs.quantity("speed", Dimension::ANGULAR_SPEED)?;
    let radial = inputs.quantity("radial_load", Dimension::FORCE)?;
    let axial = inputs
        .maybe_quantity("axial_load", Dimension::FORCE)?
        .unwrap_or(0.0);
    let moment = bearing.moment(&lubricant).map_err(told)?;
    let model = moment.intermediates(speed, radial, axial);
    // the model's own moments are in N mm
    let torque = |quantity, value| law(quantity, Dimension::TORQUE, 1e-3 * value);
    Ok(vec![
        ratio("rolling_variable", model.rolling_variable),
        torque("rolling_moment", model.rolling_moment),
        ratio("inlet_shear_factor", model.inlet_shear_factor),
        ratio("starvation_factor", model.starvation_factor),
        ratio("sliding_variable", model.sliding_variable),
        ratio("boundary_share", model.boundary_share),
        ratio("sliding_friction", model.sliding_friction),
        torque("sliding_moment", model.sliding_moment),
        torque("drag_moment", model.drag_moment),
        law(
            "moment",
            Dimension::TORQUE,
            moment.parts(speed, radial, axial).sum(),
        ),
        law(
            "starting_moment",
            Dimension::TORQUE,
            moment.starting_moment(radial, axial),
        ),
    ])
}

/// Palmgren's factors of a series.
pub(super) fn factors(inputs: &mut Inputs) -> Result<Vec<Computed>, String> {
    let kind = choice(
        inputs,
        "type",
        &[
            ("deep_groove", FactorType::DeepGroove),
            ("angular_contact", FactorType::AngularContact),
            (
                "angular_contact_double_row",
                FactorType::AngularContactDoubleRow,
            ),
            ("four_point_contact", FactorType::FourPointContact),
        ],
    )?;
    let series = inputs.text("series")?;
    let lubrication = choice(
        inputs,
        "lubrication",
        &[
            ("grease_or_oil_mist", Lubrication::GreaseOrOilMist),
            ("oil_bath", Lubrication::OilBath),
        ],
    )?;
    let factors = palmgren_factors(kind, &series, lubrication).map_err(told)?;
    Ok(vec![
        ratio("viscous_factor", factors.viscous_factor),
        ratio("load_factor", factors.load_factor),
        ratio("load_exponent", factors.load_exponent),
    ])
}

/// Viscosity of an oil known at two temperatures.
pub(super) fn oil_viscosity(inputs: &mut Inputs) -> Result<Vec<Computed>, String> {
    let temperature = |inputs: &mut Inputs, key: &str| {
        positive(key, inputs.quantity(key, Dimension::TEMPERATURE)?)
    };
    let viscosity = |inputs: &mut Inputs, key: &str| {
        positive(key, inputs.quantity(key, Dimension::KINEMATIC_VISCOSITY)?)
    };
    let first = (
        temperature(inputs, "first_temperature")?,
        viscosity(inputs, "first_viscosity")?,
    );
    let second = (
        temperature(inputs, "second_temperature")?,
        viscosity(inputs, "second_viscosity")?,
    );
    let oil = Viscosity::through(first, second).map_err(told)?;
    let at = temperature(inputs, "temperature")?;
    Ok(vec![law(
        "viscosity",
        Dimension::KINEMATIC_VISCOSITY,
        oil.at(at).map_err(told)?,
    )])
}
