//! Warnings that several systems give.

use crate::assumptions::{self, assumptions, constants};
use crate::bearing::pressure::Pressures;
use crate::bearing::run::BearingRun;
use crate::bearing::steady::SteadyFinding;
use outcome::{Quantity, Value, Warning, warning};
use physics::angular_contact::radial_load_that_unloads_a_ball;
use physics::friction_range::OperatingPoint;
use physics::hertz::rim_tension;
use scenario::{BallMaterial, Bearing, BearingType, Fidelity, Moment, Scenario, Separation};

/// Relative energy residual above which the run's tolerance is too loose.
pub(crate) const LARGEST_RESIDUAL: f64 = 1e-6;

/// Temperature rise of the films over which d ln ν/dT of an oil changes by a quarter, K.
const WARMEST_FILMS: f64 = 20.0;
/// Difference of two axial loads that rounding explains, as a share.
const ROUNDED: f64 = 0.01;

/// Hertz pressures above the limits of what touches.
pub(crate) fn pressure(bearing: &Bearing, pressures: &Pressures) -> Vec<Warning> {
    const DENTS: &str =
        "permanent dents must be expected, and the elastic contact law is outside its range";
    let mut list = Vec::new();
    let (races, limit) = (pressures.races, bearing.hertz_pressure_limit);
    if races > limit {
        list.push(warning(
            "AB1002",
            format!(
                "The peak Hertz pressure of {:.0} MPa exceeds the limit of {:.0} MPa: {DENTS}.",
                races * 1e-6,
                limit * 1e-6
            ),
        ));
    }
    if let Some((pressure, limit)) = pressures.of_neighbours(bearing)
        && pressure > limit
    {
        let material = bearing.ball_material;
        let harm = match material {
            BallMaterial::Steel => DENTS.to_string(),
            BallMaterial::SiliconNitride => format!(
                "ceramic balls do not dent, they crack in rings where the tension at the rim of the contact, {:.0} MPa, exceeds \
                 their strength",
                rim_tension(pressure, material.data().poisson_ratio) * 1e-6
            ),
        };
        list.push(warning(
            "AB1070",
            format!(
                "Neighbouring balls press each other with {:.0} MPa, beyond their limit of {:.0} MPa: {harm}.",
                pressure * 1e-6,
                limit * 1e-6
            ),
        ));
    }
    list
}

/// A cage whose mass and inertia do not belong to one body between the races.
pub(crate) fn cage_inertia(bearing: &Bearing) -> Option<Warning> {
    let Separation::Cage(cage) = &bearing.separation else {
        return None;
    };
    let gyration = (cage.inertia / cage.mass).sqrt();
    let (pitch, ball) = (bearing.pitch_diameter, bearing.ball_diameter);
    let (inner, outer) = (0.5 * (pitch - ball), 0.5 * (pitch + ball));
    (!(inner..=outer).contains(&gyration)).then(|| {
        warning(
            "AB1071",
            format!(
                "bearing.cage_inertia and bearing.cage_mass contradict each other: together they are a ring of {:.1} mm radius, \
                 and a cage lies between the races, from {:.1} to {:.1} mm. The cage turns with the inertia and moves with the mass.",
                gyration * 1e3,
                inner * 1e3,
                outer * 1e3
            ),
        )
    })
}

/// An energy ledger that misses more than a share of what was turned over, however the run ended.
pub(crate) fn residual(quantities: &[Quantity], most: f64) -> Option<Warning> {
    residual_beyond(most, number(quantities, "energy_residual")?)
}

/// An energy ledger that misses more than a share of what was turned over.
pub(crate) fn residual_beyond(most: f64, residual: f64) -> Option<Warning> {
    (residual.abs() > most).then(|| {
        warning(
            "AB1006",
            format!(
                "The energy ledger misses {residual:.1e} of what was turned over: a smaller run.tolerance closes it."
            ),
        )
    })
}

/// The value of a result, where it has one.
pub(crate) fn number(quantities: &[Quantity], name: &str) -> Option<f64> {
    let quantity = quantities.iter().find(|quantity| quantity.name == name)?;
    match quantity.value {
        Value::Number(value) => Some(value),
        Value::None { .. } | Value::List(_) | Value::Text(_) => None,
    }
}

/// Balls that traction cannot turn against the friction moment.
pub(crate) fn skids(steady: Option<&SteadyFinding>) -> Option<Warning> {
    let steady = steady.filter(|steady| steady.skids())?;
    Some(warning(
        "AB1017",
        format!(
            "The balls must skid: at {:.0} rad/s under {:.0} N traction can carry {:.2} times the friction moment of \
             {:.1} N mm, and 1.2 times is needed. In a steady run the mean moment on the outer race is then less than \
             that of the law.",
            steady.speed,
            steady.load,
            steady.capacity,
            steady.moment.abs() * 1e3
        ),
    ))
}

/// A friction law outside its range at a speed and a radial load.
pub(crate) fn law_range(bearing: &Bearing, speed: f64, load: f64) -> Vec<Warning> {
    let at = OperatingPoint {
        speed,
        radial_load: load,
        axial_load: bearing.moment.axial_load(),
    };
    let law = bearing.moment.law(&bearing.rated());
    assumptions::law_range("", &law.map_or(Vec::new(), |law| law.departures(&at)))
}

/// What the constants of a friction law take for granted of this bearing.
pub(crate) fn moment(scenario: &Scenario, name: &str, bearing: &Bearing) -> Vec<Warning> {
    let mut list = Vec::new();
    let law = &bearing.moment;
    let (preload, counted) = (bearing.axial_preload, law.axial_load());
    let by_load = matches!(law, Moment::Palmgren { .. } | Moment::Skf { .. });
    if by_load && preload > 0.0 && (counted.abs() - preload).abs() > ROUNDED * preload {
        let printed = match law {
            Moment::Palmgren { printed: true, .. } => ", whose printed form has none",
            _ => "",
        };
        list.push(warning(
            "AB1081",
            format!(
                "The friction law counts an axial load of {counted:.0} N{printed}, the contacts an axial preload of {preload:.0} N: \
                 each holds where it is used."
            ),
        ));
    }
    list.extend(constants(scenario, name, law, &bearing.rated()));
    list
}

/// Films that are thin or outside their law.
pub(crate) fn films(run: &BearingRun, bearing: &Bearing) -> Vec<Warning> {
    run.films()
        .map_or_else(Vec::new, |films| films.warnings(bearing))
}

/// A moment law that stays away although the bearing turns for long.
pub(crate) fn no_moment(bearing: &Bearing) -> Option<Warning> {
    let (code, text) = match bearing.fidelity {
        Fidelity::Planar => (
            "AB1008",
            "The bearing has no steady friction moment (bearing.moment.law is none): spin-up by the rotor is described; \
             long coasting is too free, and a swing of the rotor in the bore after spin-up decays too slowly.",
        ),
        Fidelity::Rolling => (
            "AB1016",
            "The rolling bearing runs without a friction moment (bearing.moment.law is none).",
        ),
    };
    (bearing.moment == Moment::None).then(|| warning(code, text.to_string()))
}

/// What the rolling fidelity takes for granted.
pub(crate) fn rolling(bearing: &Bearing) -> Option<Warning> {
    (bearing.fidelity == Fidelity::Rolling).then(|| {
        warning(
            "AB1009",
            "The rolling bearing assumes that no ball skids: where the planar fidelity shows slip, its spin-up times \
             and losses are not true."
                .to_string(),
        )
    })
}

/// Bearings that are computed as something else.
pub(crate) fn kind(bearing: &Bearing) -> Vec<Warning> {
    let mut list = Vec::new();
    if bearing.ball_material == BallMaterial::SiliconNitride {
        list.push(warning(
            "AB1012",
            "Silicon nitride balls on steel races: contact stiffness and ball mass follow the material; traction and \
             damping are those given."
                .to_string(),
        ));
    }
    match bearing.kind {
        BearingType::DeepGroove => {}
        BearingType::FourPointContact => list.push(warning(
            "AB1019",
            "The bearing is computed in the plane, as a deep groove bearing: its contact angle and axial load reach \
             nothing but the friction law."
                .to_string(),
        )),
        BearingType::AngularContact => list.push(warning("AB1019", angular_contact(bearing))),
        BearingType::AngularContactDoubleRow => {
            list.push(warning(
                "AB1125",
                "A double row is computed as a single row of ball_count balls: loads, pressures and friction of balls that share two rows \
                 are not those of this run."
                    .to_string(),
            ));
            list.push(warning("AB1019", angular_contact(bearing)));
        }
    }
    list
}

/// What a contact angle in the plane takes for granted.
fn angular_contact(bearing: &Bearing) -> String {
    let angle = bearing.contact_angle.to_degrees();
    let held = if bearing.axial_preload > 0.0 {
        let most = radial_load_that_unloads_a_ball(bearing.axial_preload, bearing.contact_angle);
        format!("keeps it (locked, at rest up to a radial load of {most:.0} N)")
    } else {
        "keeps it, and none is given".to_string()
    };
    format!(
        "The contact angle of {angle:.1} deg is computed in the plane and stays as it is: that holds while an axial preload {held}. \
         Axial motion, tilt and the balls' spin about their contacts are left out."
    )
}

/// A radial load beyond what the axial preload holds: a steady one, such as the weight, or the largest of the run with its
/// instant.
///
/// - `steady`: what it is, and its size, N
pub fn preload_left(
    name: &str,
    bearing: &Bearing,
    (what, steady): (&str, f64),
    peak: Option<(f64, f64)>,
) -> Option<Warning> {
    let preload = bearing.axial_preload;
    if preload <= 0.0 || bearing.contact_angle <= 0.0 {
        return None;
    }
    let most = radial_load_that_unloads_a_ball(preload, bearing.contact_angle);
    let told = match peak {
        Some((force, time)) if force > most => format!(
            "{force:.0} N at {:.2} ms, {:.1} times that{}",
            time * 1e3,
            force / most,
            match steady > most {
                true => format!("; the {what} of {steady:.0} N alone exceeds it"),
                false => String::new(),
            }
        ),
        _ if steady > most => format!(
            "exceeded by the {what} of {steady:.0} N alone, {:.1} times that",
            steady / most
        ),
        _ => return None,
    };
    let name = match name {
        "" => String::new(),
        name => format!("{name}: "),
    };
    Some(warning(
        "AB1096",
        format!(
            "{name}The axial preload of {preload:.0} N keeps all balls loaded up to a radial load of {most:.0} N: {told}. Beyond it \
             balls are unloaded and the contact angle changes, so ball loads, pressures and spin-up times are indicative only."
        ),
    ))
}

/// Films so warm that the factors of the lubricant's state have left their range.
pub(crate) fn film_rise(run: &BearingRun) -> Option<Warning> {
    let largest = run.largest_film_rise();
    (largest > WARMEST_FILMS).then(|| warning("AB1035", warm_films(largest)))
}

fn warm_films(rise: f64) -> String {
    format!(
        "The contact films warm by {rise:.0} K: drag and traction that fall exponentially with temperature hold \
         over some {WARMEST_FILMS:.0} K, and the bulk of the bearing would warm as well."
    )
}

/// A ring that is said to grow with its shaft beyond the speed at which it leaves it.
pub(crate) fn lift_off(bearing: &Bearing, speed: f64) -> Option<Warning> {
    let lift_off = bearing.lifts_off_below(speed.abs())?;
    if lift_off == 0.0 {
        return Some(warning(
            "AB1032",
            "The inner ring is said to grow with its shaft (bearing.inner_race_growth), and no interference holds it there: \
             bearing.fits.shaft_interference is needed."
                .to_string(),
        ));
    }
    Some(warning(
        "AB1032",
        format!(
            "The inner ring lifts off its shaft at {:.0} rpm, below the speed of this run: \
             bearing.inner_race_growth = \"with shaft\" does not hold there, and the ring may creep.",
            lift_off * 30.0 / std::f64::consts::PI
        ),
    ))
}

/// Everything that is assumed of the whole file, or of one of several auxiliary bearings, in one line.
pub(crate) fn assumed(
    scenario: &Scenario,
    name: Option<&str>,
    bearing: Option<&Bearing>,
) -> Option<Warning> {
    // what only skidding balls have
    let planar = ["bearing.cage.", "bearing.traction.", "bearing.drag."];
    let counts = |path: &str| {
        bearing.is_none_or(|bearing| bearing.fidelity == Fidelity::Planar)
            || !planar.iter().any(|p| path.starts_with(p))
    };
    let values = scenario.resolved.values.iter();
    let paths: Vec<&str> = values
        .filter(|value| value.bearing.as_deref() == name)
        .filter(|value| value.provenance.mark() == "assumed" && counts(value.path))
        .map(|value| value.path)
        .collect();
    assumptions(&paths)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_has_single_spaces() {
        let text = warm_films(34.0);
        assert!(
            text.contains("hold over some 20 K") && !text.contains("  "),
            "{text}"
        );
    }
}
