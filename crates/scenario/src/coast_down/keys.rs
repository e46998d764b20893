//! The part of the table of keys that describes a coast-down: how long it lasts.

use crate::key::{Condition, Fallback, Key, Kind, Presence, Range, Section};
use crate::system::{COAST_DOWN, COASTING_DOWN};

const UNTIL_STANDSTILL: &[Condition] = &[Condition {
    path: "run.until",
    values: &["standstill"],
    reason: "",
}];

#[rustfmt::skip]
pub(crate) const SECTIONS: &[Section] = &[Section::new("coast_down", "The coast-down: the rotor rolls on its auxiliary bearings, which brake it until it stands. Nothing whirls or bounces.", COASTING_DOWN)];

#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    Key::new("coast_down.radial_load", Kind::Quantity("N"), "39 N", "Radial force of the rotor on each bearing; rows that planes counts in [[auxiliary_bearing]] share it equally.")
        .positive().derived("weight of rotor.mass over the number of all rows, times its rows, 9.80665 m/s²").only(COAST_DOWN),
    Key::new("coast_down.stop_speed", Kind::Quantity("rad/s"), "1 rad/s", "Speed at which the coast-down ends. Below about 1 rad/s the friction laws fade; above it the rotor does not stand yet.")
        .positive().when(UNTIL_STANDSTILL).default("1 rad/s", "what is left there stops within seconds"),
    Key::new("coast_down.longest", Kind::Quantity("s"), "10 h", "Time after which the run is ended, standing or not.")
        .positive().when(UNTIL_STANDSTILL).default("1000 h", "a rotor that coasts for six weeks has other worries"),
    Key::new("coast_down.tolerance", Kind::Coefficient, "1e-3", "Allowed error of a step, in time over the coast-down and in temperature over 50 K. After a drop it decides how long the motion is followed ball by ball, and how far the steps between such intervals go.")
        .within(Range::FromTo(1e-8, 0.1)).when(UNTIL_STANDSTILL).default("2e-3", "of each step 0.2 % in time and 0.1 K: less than what a motion that bounces leaves to chance"),
];

/// What this system does without a key that others have too.
pub const PRESENCES: &[(&str, Presence)] = &[
    (
        "bearing.moment.law",
        Presence::Default(Fallback::convention(
            "palmgren",
            "the one law whose parts warmth and clearance act on",
        )),
    ),
    (
        "bearing.moment.lubrication",
        Presence::Default(Fallback::assumption(
            "grease",
            "the usual lubrication of an auxiliary bearing",
        )),
    ),
    (
        "bearing.moment.temperature",
        Presence::Default(Fallback::assumption("25 degC", "room temperature")),
    ),
    ("bearing.moment.viscosity_points", Presence::Required),
    (
        "coast_down.tolerance",
        Presence::Default(Fallback::convention(
            "5e-4",
            "stop time within 0.05 %, temperatures within 0.1 K",
        )),
    ),
    (
        "bearing.moment.viscosity",
        Presence::Derived("viscosity_points at temperature"),
    ),
];
