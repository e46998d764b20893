//! The part of the table of keys that describes where the torque of a bearing is computed.

use crate::key::{Key, Kind, Presence, Range, Section};
use crate::system::TORQUE;

#[rustfmt::skip]
pub(crate) const SECTIONS: &[Section] = &[Section::new("torque", "Where the moments are computed. Nothing moves: at each speed, load and acceleration the balls roll. The first load and the running temperature are those of every table that varies something else.", TORQUE)];

#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    Key::new("torque.speed_from", Kind::Quantity("rad/s"), "1 rad/s", "Least speed of the inner race.")
        .positive().default("1 rad/s", "below, the friction laws fade to 0 at rest, which is a regularisation"),
    Key::new("torque.speed_to", Kind::Quantity("rad/s"), "150 rad/s", "Largest speed of the inner race.")
        .positive().derived("the limiting speed of the bearing; 1000 rad/s where none is known"),
    Key::new("torque.speed_count", Kind::Count, "200", "Number of speeds from the least to the largest, at equal distances.")
        .within(Range::FromTo(2.0, 10_000.0)).default("200", "a smooth curve"),
    Key::new("torque.speed", Kind::Quantity("rad/s"), "150 rad/s", "Speed of the tables over acceleration, load, law and lubricant.")
        .positive().derived("torque.speed_to"),
    Key::new("torque.accelerations", Kind::Quantities("rad/s^2"), "[\"0 rad/s^2\", \"7200 rad/s^2\"]", "Accelerations of the inner race; negative while it slows down.")
        .default("[\"0 rad/s^2\", \"1300 rad/s^2\", \"7200 rad/s^2\", \"11500 rad/s^2\"]", "a steady run, and the accelerations of the source paper"),
    Key::new("torque.loads", Kind::Quantities("N"), "[\"80 N\", \"400 N\"]", "Radial loads.")
        .not_negative().derived("1 % of the static load rating, assumed; 0 N where none is known"),
    Key::new("torque.temperatures", Kind::Quantities("K"), "[\"40 degC\", \"60 degC\", \"80 degC\"]", "Temperatures at which lubricants are compared.")
        .positive().optional("only bearing.moment.temperature counts"),
    Key::new("torque.laws", Kind::Words(&["palmgren", "palmgren printed", "skf", "measured"]), "[\"palmgren\", \"skf\"]", "Laws of the friction moment to compare; a law that has no constants for the bearing says why.")
        .optional("only bearing.moment.law counts"),
    Key::new("torque.lubricants", Kind::Texts, "[\"ISO VG 68, 8.7 mm^2/s at 100 degC\", \"grease: 100 mm^2/s at 40 degC, 11 mm^2/s at 100 degC\"]", "Lubricants to compare, each with its viscosity at two temperatures, at one, or at the running temperature (\"100 mm^2/s\"); \"ISO VG 68\" is the middle of that grade at 40 degC. What stands before a colon is a name. The first one is the lubricant of the bearing where bearing.moment gives none.")
        .optional("only the lubricant of bearing.moment counts").excludes("bearing.moment.viscosity"),
];

/// What this system does without a key that others have too: it exists to look at friction, so there is some.
pub const PRESENCES: &[(&str, Presence)] = &[
    (
        "bearing.moment.law",
        Presence::convention("palmgren", "the law of the source paper"),
    ),
    (
        "bearing.moment.lubrication",
        Presence::assumption("grease", "the usual lubrication of an auxiliary bearing"),
    ),
    (
        "bearing.moment.viscosity",
        Presence::assumption("100 mm^2/s", "base oil ISO VG 100 at 40 degC"),
    ),
];
