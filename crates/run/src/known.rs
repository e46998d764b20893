//! What values and a drop say by themselves, and how that joins what a run finds.

use outcome::Warning;
use scenario::notes::ValueWarning;
use scenario::{AuxiliaryBearing, Bearing, Scenario};
use simulate::assumptions::speed_rating;
use simulate::bearing::warnings::preload_left;
use simulate::drop::Drop;
use simulate::drop::warning_table::DropWarning;
use units::number_text;

/// Sag of a mount under the weight of the rotor, m.
const LARGEST_SAG: f64 = 1e-3;
/// Product of eccentricity and speed of drive shafts of cars, G 16, m/s.
const LARGEST_GRADE: f64 = 16e-3;

pub(super) fn of_values(scenario: &Scenario) -> impl Iterator<Item = Warning> {
    scenario.notes.iter().cloned()
}

pub(super) fn of_drop(drop: &Drop) -> Vec<Warning> {
    let parts = drop.auxiliary_bearings.iter().enumerate();
    let of_part = |(k, part): (usize, &AuxiliaryBearing)| {
        let Some(bearing) = &part.bearing else {
            return Vec::new();
        };
        let load = drop.weight(k);
        let mut list = of_bearing(&part.name, bearing, load, drop.rotor.speed);
        list.extend(sags(drop, part, load).map(|warning| warning.of_part(&part.name)));
        let left = preload_left(bearing, ("weight", load), None);
        list.extend(left.map(|warning| warning.of_part(&part.name)));
        list
    };
    unbalance_grade(drop)
        .into_iter()
        .chain(parts.flat_map(of_part))
        .collect()
}

/// The warnings of a drop, with what was known before it.
pub(super) fn with_those_before(
    scenario: &Scenario,
    drop: &Drop,
    warnings: Vec<Warning>,
) -> Vec<Warning> {
    joined(of_values(scenario).chain(of_drop(drop)), warnings)
}

/// What is known before a run, where the run does not say more of it, and what it found, the gravest first.
pub(super) fn joined(before: impl Iterator<Item = Warning>, found: Vec<Warning>) -> Vec<Warning> {
    let new = |warning: &Warning| found.iter().all(|other| other.code != warning.code);
    let mut list: Vec<Warning> = before.filter(new).collect();
    list.extend(found);
    list.sort_by_key(|warning| warning.severity);
    list
}

/// A mount that the weight alone presses down, across or along the shaft.
fn sags(drop: &Drop, part: &AuxiliaryBearing, load: f64) -> impl Iterator<Item = Warning> {
    let mount = &part.mount;
    let along = match part.contact.faces.any() {
        true => (drop.body.mass * drop.gravity.axial).abs() / part.planes,
        false => 0.0,
    };
    let ways = [
        ("mount.stiffness", load, mount.stiffness),
        ("mount.axial_stiffness", along, mount.axial_stiffness),
    ];
    ways.into_iter().filter_map(|(key, weight, stiffness)| {
        let sag = weight / stiffness;
        let warning = ValueWarning::Implausible {
            key: key.to_string(),
            value: format!("{} N/m", number_text(stiffness)),
            usual: format!("the weight alone presses it down by {:.1} mm", sag * 1e3),
        };
        (sag > LARGEST_SAG).then(|| warning.into())
    })
}

/// An unbalance that no rotor on magnets is left with.
fn unbalance_grade(drop: &Drop) -> Option<Warning> {
    let eccentricity = match &drop.shaft {
        Some(shaft) => {
            let planes = shaft.model.rotor.unbalance.iter();
            planes.map(|plane| plane.amount.abs()).sum::<f64>() / drop.body.mass
        }
        None => drop.body.unbalance_eccentricity.abs(),
    };
    let speed = drop.rotor.speed.abs();
    let grade = eccentricity * speed;
    let warning = ValueWarning::ImplausibleUnbalance {
        eccentricity,
        speed,
        grade,
    };
    (grade > LARGEST_GRADE).then(|| warning.into())
}

/// Load and speed beyond what a bearing stands.
pub(super) fn of_bearing(name: &str, bearing: &Bearing, load: f64, speed: f64) -> Vec<Warning> {
    let load = above_the_rating(bearing.static_load_rating, load);
    load.into_iter()
        .chain(speed_rating(bearing, speed))
        .map(|warning| warning.of_part(name))
        .collect()
}

pub(super) fn above_the_rating(rating: Option<f64>, load: f64) -> Option<Warning> {
    let rating = rating.filter(|rating| load > *rating)?;
    let factor = load / rating;
    let warning = DropWarning::StaticLoad {
        load,
        factor,
        rating,
    };
    Some(warning.into())
}
