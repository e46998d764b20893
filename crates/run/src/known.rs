//! What values and a drop say by themselves, and how that joins what a run finds.

use outcome::{Warning, warning};
use scenario::{AuxiliaryBearing, Bearing, Drop, Scenario};
use simulate::assumptions::speed_rating;
use simulate::bearing::warnings::preload_left;

/// Product of eccentricity and speed of drive shafts of cars, G 16, m/s.
const LARGEST_GRADE: f64 = 16e-3;

pub(super) fn of_values(scenario: &Scenario) -> impl Iterator<Item = Warning> {
    let notes = scenario.notes.iter();
    notes.map(|note| warning(note.code, note.text.clone()))
}

pub(super) fn of_drop(drop: &Drop) -> Vec<Warning> {
    let parts = drop.auxiliary_bearings.iter().enumerate();
    let of_part = |(k, part): (usize, &AuxiliaryBearing)| {
        let Some(bearing) = &part.bearing else {
            return Vec::new();
        };
        let load = drop.weight(k);
        let mut list = of_bearing(&part.name, bearing, load, drop.rotor.speed);
        list.extend(preload_left(&part.name, bearing, ("weight", load), None));
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

/// Backward whirl, a rotor that reaches what stands around it, a race or a contact that gets hot.
const DESTRUCTION: [&str; 6] = ["AB1014", "AB2030", "AB2300", "AB2301", "AB2310", "AB2311"];

/// What is known before a run, where the run does not say more of it, and what it found; destruction above doubt.
pub(super) fn joined(before: impl Iterator<Item = Warning>, found: Vec<Warning>) -> Vec<Warning> {
    let new = |warning: &Warning| found.iter().all(|other| other.code != warning.code);
    let mut list: Vec<Warning> = before.filter(new).collect();
    list.extend(found);
    list.sort_by_key(|warning| !DESTRUCTION.contains(&warning.code));
    list
}

/// An unbalance that no rotor on magnets is left with.
fn unbalance_grade(drop: &Drop) -> Option<Warning> {
    let eccentricity = match &drop.shaft {
        Some(shaft) => {
            let planes = shaft.model.rotor.unbalance.iter();
            planes.map(|plane| plane.amount.abs()).sum::<f64>() / drop.rotor.mass
        }
        None => drop.rotor.unbalance_eccentricity.abs(),
    };
    let grade = eccentricity * drop.rotor.speed.abs();
    (grade > LARGEST_GRADE).then(|| {
        warning(
            "AB1094",
            format!(
                "The unbalance is implausible: {:.3e} m of eccentricity (all planes in one direction) at {:.0} rad/s are a balance quality \
                 grade G {:.0} (ISO 21940-11, mm/s); turbomachines have G 1 to G 6.3. A lost blade would be one.",
                eccentricity,
                drop.rotor.speed.abs(),
                grade * 1e3
            ),
        )
    })
}

/// Load and speed beyond what a bearing stands.
pub(super) fn of_bearing(name: &str, bearing: &Bearing, load: f64, speed: f64) -> Vec<Warning> {
    let load = above_the_rating(bearing.static_load_rating, load);
    let mut list: Vec<Warning> = load
        .into_iter()
        .chain(speed_rating(bearing, speed))
        .collect();
    if !name.is_empty() {
        for warning in &mut list {
            warning.text = format!("{name}: {}", warning.text);
        }
    }
    list
}

pub(super) fn above_the_rating(rating: Option<f64>, load: f64) -> Option<Warning> {
    let rating = rating.filter(|rating| load > *rating)?;
    Some(warning(
        "AB1029",
        format!(
            "The static radial load of {load:.0} N is {:.1} times the static load rating of {rating:.0} N: permanent \
             dents must be expected, and the laws of contact and friction are outside their range.",
            load / rating
        ),
    ))
}
