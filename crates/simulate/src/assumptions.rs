//! Warnings that follow from the scenario alone.

use outcome::{Warning, warning};
use physics::friction::Friction;
use physics::friction_range::Departure;
use scenario::{Bearing, BearingType, Moment, Provenance, RatedBearing, Scenario};
use std::f64::consts::PI;

/// Unit of the drag variable in a message: the order of the diagram's values for low levels.
const V_M: f64 = 1e-4;

/// A speed beyond what the bearing stands in continuous running.
pub fn speed_rating(bearing: &Bearing, speed: f64) -> Option<Warning> {
    let limit = bearing.limiting_speed?;
    let name = bearing.name.as_deref().unwrap_or("bearing like this");
    (speed.abs() > limit).then(|| {
        warning(
            "AB1015",
            format!(
                "The speed is {:.1} times the limiting speed of a {name} ({:.0} rpm), which holds for continuous running.",
                speed.abs() / limit,
                limit * 30.0 / std::f64::consts::PI
            ),
        )
    })
}

/// The same of a bearing without contacts.
pub fn constants(
    scenario: &Scenario,
    name: &str,
    law: &Moment,
    rated: &RatedBearing,
) -> Vec<Warning> {
    let angle = (scenario.resolved).of_bearing(name, "bearing.moment.contact_angle");
    let unknown = angle.and_then(|angle| match &angle.provenance {
        Provenance::DefaultAssumed(why) if rated.kind != BearingType::DeepGroove => {
            Some((angle, why))
        }
        _ => None,
    });
    let unknown = unknown.map(|(angle, why)| {
        warning(
            "AB1080",
            format!(
                "The contact angle of the bearing is not known, and the friction law depends on it: {why}; {} is taken.",
                angle.text.as_deref().unwrap_or_default()
            ),
        )
    });
    unknown.into_iter().chain(bath(law, rated)).collect()
}

/// The SKF model in oil without the drag of the oil.
pub fn bath(law: &Moment, rated: &RatedBearing) -> Option<Warning> {
    let Friction::Skf(dragged) = law.with_drag_variable(V_M)?.law(rated).ok()? else {
        return None;
    };
    Some(warning(
        "AB1082",
        format!(
            "The SKF model runs in an oil bath or jet without the drag of the oil: bearing.moment.drag_variable is 0. Each {V_M:e} of \
             it is {:.3} N mm at 10 000 rpm, with the square of the speed.",
            dragged
                .intermediates(10_000.0 * PI / 30.0, 0.0, 0.0)
                .drag_moment
        ),
    ))
}

/// A friction law outside its range.
///
/// - `which`: of which law, and when, before the verb
pub fn law_range(which: &str, departures: &[Departure]) -> Vec<Warning> {
    let told = departures.iter().map(|departure| {
        warning(
            "AB1018",
            format!("The law of the friction moment{which} has left its range: {departure}."),
        )
    });
    told.collect()
}

/// Names what is assumed.
pub fn assumptions(paths: &[&str]) -> Option<Warning> {
    (!paths.is_empty()).then(|| {
        warning(
            "AB1013",
            format!(
                "Assumed, not measured ({}): {}.",
                paths.len(),
                paths.join(", ")
            ),
        )
    })
}
