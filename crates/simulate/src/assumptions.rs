//! Warnings that follow from the scenario alone.

use outcome::Warning;
use physics::friction::Friction;
use physics::friction_range::Departure;
use scenario::{Bearing, BearingType, Moment, Provenance, RatedBearing, Scenario};
use std::f64::consts::PI;

/// Unit of the drag variable in a message: the order of the diagram's values for low levels.
const V_M: f64 = 1e-4;

problem::warnings! {
    /// What follows from the scenario alone.
    pub enum AssumptionWarning {
        Assumed { count: "", paths: text } "AB1013" [ASSUMED] Note ("Assumed, not measured ({count}): {paths}.");
        Overspeed { factor: "1", bearing: text, limit: "rad/s" } "AB1015" Invalid, each
            ("The speed is {factor:.1} times the limiting speed of a {bearing} ({:.0} rpm), which holds for continuous running.", limit * 30.0 / PI);
        LargestOverspeed { factor: "1", limit: "rad/s" } "AB1015" Invalid
            ("The largest speed is {factor:.1} times the limiting speed of the bearing ({:.0} rpm), which holds for continuous running.", limit * 30.0 / PI);
        RollsWithoutMoment "AB1016" Uncertain ("The rolling bearing runs without a friction moment (bearing.moment.law is none).");
        NoMomentShown "AB1016" Uncertain ("The bearing has no friction moment (bearing.moment.law is none): only its inertia is shown.");
        OutOfLaw { which: words, departure: words } "AB1018" Invalid, unperturbed ("The law of the friction moment{which} has left its range: {departure}.");
        DeepGrooveMotion "AB1019" Uncertain
            ("Balls and cage are computed as those of a deep groove bearing: the contact angle reaches nothing but the friction law.");
        FourPointContact "AB1019" Uncertain
            ("The bearing is computed in the plane, as a deep groove bearing: its contact angle and axial load reach nothing but the friction law.");
        AngularContact { angle: "rad", held: words } "AB1019" Uncertain
            ("The contact angle of {:.1} deg is computed in the plane and stays as it is: that holds while an axial preload {held}. Axial motion, tilt and the balls' spin about their contacts are left out.", angle.to_degrees());
        ContactAngle { why: words, taken: text } "AB1080" Uncertain
            ("The contact angle of the bearing is not known, and the friction law depends on it: {why}; {taken} is taken.");
        NoDrag { moment: "N m" } "AB1082" Uncertain
            ("The SKF model runs in an oil bath or jet without the drag of the oil: bearing.moment.drag_variable is 0. Each {V_M:e} of it is {:.3} N mm at 10 000 rpm, with the square of the speed.", 1e3 * moment);
    }
}

/// A speed beyond what the bearing stands in continuous running.
pub fn speed_rating(bearing: &Bearing, speed: f64) -> Option<Warning> {
    let limit = bearing.limiting_speed?;
    let name = bearing.name.as_deref().unwrap_or("bearing like this");
    (speed.abs() > limit).then(|| {
        let (factor, bearing) = (speed.abs() / limit, name.to_string());
        AssumptionWarning::Overspeed {
            factor,
            bearing,
            limit,
        }
        .into()
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
        let (why, taken) = (why.to_string(), angle.text.clone().unwrap_or_default());
        AssumptionWarning::ContactAngle { why, taken }.into()
    });
    unknown.into_iter().chain(bath(law, rated)).collect()
}

/// The SKF model in oil without the drag of the oil.
pub fn bath(law: &Moment, rated: &RatedBearing) -> Option<Warning> {
    let Friction::Skf(dragged) = law.with_drag_variable(V_M)?.law(rated).ok()? else {
        return None;
    };
    let drag = dragged.intermediates(10_000.0 * PI / 30.0, 0.0, 0.0);
    let moment = 1e-3 * drag.drag_moment;
    Some(AssumptionWarning::NoDrag { moment }.into())
}

/// A friction law outside its range.
///
/// - `which`: of which law, and when, before the verb
pub fn law_range(which: &str, departures: &[Departure]) -> Vec<Warning> {
    let told = departures.iter().map(|departure| {
        let (which, departure) = (which.to_string(), departure.to_string());
        AssumptionWarning::OutOfLaw { which, departure }.into()
    });
    told.collect()
}

/// Names what is assumed.
pub fn assumptions(paths: &[&str]) -> Option<Warning> {
    (!paths.is_empty()).then(|| {
        let (count, paths) = (paths.len() as f64, paths.join(", "));
        AssumptionWarning::Assumed { count, paths }.into()
    })
}
