//! Warnings that several systems give.

use crate::assumptions::{self, AssumptionWarning, assumptions, constants};
use crate::bearing::pressure::Pressures;
use crate::bearing::run::BearingRun;
use crate::bearing::steady::SteadyFinding;
use crate::bearing::warning_table::{BearingWarning, DENTS};
use outcome::{Quantity, Value, Warning};
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

/// Hertz pressures above the limits of what touches, with their warnings.
pub(crate) fn pressure(bearing: &Bearing, pressures: &Pressures) -> Vec<(f64, Warning)> {
    let mut list = Vec::new();
    let (pressure, limit) = (pressures.races, bearing.hertz_pressure_limit);
    if pressure > limit {
        list.push((
            pressure,
            BearingWarning::Pressure { pressure, limit }.into(),
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
        let warning = BearingWarning::Neighbours {
            pressure,
            limit,
            harm,
        };
        list.push((pressure, warning.into()));
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
    let warning = BearingWarning::CageInertia {
        gyration,
        inner,
        outer,
    };
    (!(inner..=outer).contains(&gyration)).then(|| warning.into())
}

/// An energy ledger that misses more than a share of what was turned over, however the run ended.
pub(crate) fn residual(quantities: &[Quantity], most: f64) -> Option<Warning> {
    residual_beyond(most, number(quantities, "energy_residual")?)
}

/// An energy ledger that misses more than a share of what was turned over.
pub(crate) fn residual_beyond(most: f64, residual: f64) -> Option<Warning> {
    (residual.abs() > most).then(|| BearingWarning::Residual { residual }.into())
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
    let warning = BearingWarning::Skids {
        speed: steady.speed,
        load: steady.load,
        capacity: steady.capacity,
        moment: steady.moment,
    };
    Some(warning.into())
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
    // in space each row has the loads of its balls
    let by_load = matches!(law, Moment::Palmgren { .. } | Moment::Skf { .. })
        && bearing.fidelity != Fidelity::Spatial;
    if by_load && preload > 0.0 && (counted.abs() - preload).abs() > ROUNDED * preload {
        let printed = match law {
            Moment::Palmgren { printed: true, .. } => ", whose printed form has none",
            _ => "",
        };
        let printed = printed.to_string();
        let warning = BearingWarning::AxialLoads {
            counted,
            printed,
            preload,
        };
        list.push(warning.into());
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
    let none = bearing.moment == Moment::None;
    match bearing.fidelity {
        Fidelity::Planar => none.then(|| BearingWarning::NoMoment.into()),
        Fidelity::Rolling => none.then(|| AssumptionWarning::RollsWithoutMoment.into()),
        // slip and spin in its contacts resist
        Fidelity::Spatial => None,
    }
}

/// What the rolling fidelity takes for granted.
pub(crate) fn rolling(bearing: &Bearing) -> Option<Warning> {
    (bearing.fidelity == Fidelity::Rolling).then(|| BearingWarning::Rolls.into())
}

/// Bearings that are computed as something else.
pub(crate) fn kind(bearing: &Bearing) -> Vec<Warning> {
    let mut list = Vec::new();
    if bearing.ball_material == BallMaterial::SiliconNitride {
        list.push(BearingWarning::Hybrid.into());
    }
    match bearing.kind {
        _ if bearing.spatial.is_some() => {}
        BearingType::DeepGroove => {}
        BearingType::FourPointContact => list.push(AssumptionWarning::FourPointContact.into()),
        BearingType::AngularContact => list.push(angular_contact(bearing)),
        BearingType::AngularContactDoubleRow => {
            list.extend([BearingWarning::DoubleRow.into(), angular_contact(bearing)]);
        }
    }
    list
}

/// What a contact angle in the plane takes for granted.
fn angular_contact(bearing: &Bearing) -> Warning {
    let angle = bearing.contact_angle;
    let held = if bearing.axial_preload > 0.0 {
        let most = radial_load_that_unloads_a_ball(bearing.axial_preload, bearing.contact_angle);
        format!("keeps it (locked, at rest up to a radial load of {most:.0} N)")
    } else {
        "keeps it, and none is given".to_string()
    };
    AssumptionWarning::AngularContact { angle, held }.into()
}

/// A radial load beyond what the axial preload holds: a steady one, such as the weight, or the largest of the run with its
/// instant.
///
/// - `steady`: what it is, and its size, N
pub fn preload_left(
    bearing: &Bearing,
    (what, steady): (&str, f64),
    peak: Option<(f64, f64)>,
) -> Option<Warning> {
    let preload = bearing.axial_preload;
    if preload <= 0.0 || bearing.contact_angle <= 0.0 || bearing.spatial.is_some() {
        return None;
    }
    let limit = radial_load_that_unloads_a_ball(preload, bearing.contact_angle);
    let how = match peak {
        Some((force, time)) if force > limit => format!(
            "{force:.0} N at {:.2} ms, {:.1} times that{}",
            time * 1e3,
            force / limit,
            match steady > limit {
                true => format!("; the {what} of {steady:.0} N alone exceeds it"),
                false => String::new(),
            }
        ),
        _ if steady > limit => format!(
            "exceeded by the {what} of {steady:.0} N alone, {:.1} times that",
            steady / limit
        ),
        _ => return None,
    };
    let warning = BearingWarning::PreloadLeft {
        preload,
        limit,
        how,
    };
    Some(warning.into())
}

/// Films so warm that the factors of the lubricant's state have left their range.
pub(crate) fn film_rise(run: &BearingRun) -> Option<Warning> {
    let (rise, limit) = (run.largest_film_rise(), WARMEST_FILMS);
    (rise > limit).then(|| BearingWarning::WarmFilms { rise, limit }.into())
}

/// A ring that is said to grow with its shaft beyond the speed at which it leaves it.
pub(crate) fn lift_off(bearing: &Bearing, speed: f64) -> Option<Warning> {
    let lift_off = bearing.lifts_off_below(speed.abs())?;
    let warning = match lift_off {
        0.0 => BearingWarning::LooseFromTheStart,
        speed => BearingWarning::LiftsOff { speed },
    };
    Some(warning.into())
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
        bearing.is_none_or(|bearing| bearing.fidelity != Fidelity::Rolling)
            || !planar.iter().any(|p| path.starts_with(p))
    };
    let values = scenario.resolved.values.iter();
    let paths: Vec<&str> = values
        .filter(|value| value.bearing.as_deref() == name)
        .filter(|value| value.provenance.mark() == "assumed" && counts(value.path))
        .map(|value| value.path)
        .chain(
            scenario
                .resolved
                .assumed_of_parts()
                .map(|(path, _)| path)
                .filter(|_| name.is_none()),
        )
        .collect();
    assumptions(&paths)
}
