//! The part of the table of keys that describes what brings an inner race to speed.

use crate::key::{Condition, Key, Kind, LANDING_FRICTION, Presence, Section};
use crate::spin_up::DriveKind;
use crate::spin_up::RotorSpin;
use crate::system::SPIN_UP;
use problem::words::Words;

/// What a spin-up does without keys that it shares with a drop.
pub const PRESENCES: &[(&str, Presence)] = &[
    (
        "run.duration",
        Presence::convention(
            "0.1 s",
            "several times the spin-up of a small inner race by a sliding rotor",
        ),
    ),
    (
        "run.output_interval",
        Presence::convention("0.02 ms", "5000 rows for the default duration"),
    ),
];

#[rustfmt::skip]
pub(crate) const SECTIONS: &[Section] = &[Section::new("drive", "What turns and loads the inner race; the outer race stands. Angles and speeds count counter-clockwise, x points right and y up. At time 0 race, balls and cage are at rest.", SPIN_UP)];

const fn drive(kinds: &'static [&'static str]) -> Condition {
    Condition::new("drive.kind", kinds)
}

const SLIDING: &[Condition] = &[drive(&["sliding rotor"])];
const TORQUE: &[Condition] = &[drive(&["torque"])];
const SPEED: &[Condition] = &[drive(&["speed"])];

const FREE: Condition = Condition::new("drive.rotor_spin", &["free"]);

#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    Key::new("drive.kind", Kind::Word(DriveKind::WORDS), "sliding rotor", "What turns the inner race: a rotor that slides in its bore, a torque, or a drive that gives it a speed."),
    Key::new("drive.radial_load", Kind::Quantity("N"), "80 N", "Radial force of the rotor on the inner race, constant. Give this or load_history.")
        .not_negative(),
    Key::new("drive.load_history", Kind::Table("s", "N"), "[[\"0 s\", \"200 N\"], [\"10 ms\", \"80 N\"]]", "Radial force over time: straight between the rows, constant before the first and after the last.")
        .not_negative().optional("drive.radial_load counts").excludes("drive.radial_load"),
    Key::new("drive.load_direction", Kind::Quantity("rad"), "-90 deg", "Direction of the radial force, from x.")
        .default("-90 deg", "downwards, as a weight"),
    Key::new("drive.rotor_speed", Kind::Quantity("rad/s"), "12000 rpm", "Spin of the rotor at time 0; the sign is the direction.").when(SLIDING),
    Key::new("drive.rotor_spin", Kind::Word(RotorSpin::WORDS), "held", "Whether the spin of the rotor is held by its drive, or free to fall as the rotor spends its energy.")
        .default("held", "a rotor of large inertia hardly slows down while it turns a bearing up").when(SLIDING),
    Key::new("drive.rotor_polar_inertia", Kind::Quantity("kg m^2"), "0.01 kg m^2", "Moment of inertia of the rotor about its axis; with several bearings, the share of this one.")
        .positive().when(&[FREE]),
    Key::new("drive.bore_diameter", Kind::Quantity("m"), "25 mm", "Diameter at which the rotor slides: the bore of the inner race or of the sleeve in it.")
        .positive().catalogued().when(SLIDING),
    Key::new("drive.friction_coefficient", Kind::Coefficient, "0.15", "Coefficient of sliding friction between rotor and inner race.")
        .within(LANDING_FRICTION).assumed("0.15", "arbitrary; it decides the spin-up time, so give the value of the pair").when(SLIDING),
    Key::new("drive.friction_reference_speed", Kind::Quantity("m/s"), "0.05 m/s", "Slip speed that regularises the friction: its coefficient is multiplied by tanh(slip speed / reference speed).")
        .positive().default("0.05 m/s", "numerical regularisation: small against the sliding speeds of a spin-up").when(SLIDING),
    Key::new("drive.torque", Kind::Quantity("N m"), "0.1 N m", "Torque on the inner race, constant. Give this or torque_history.").when(TORQUE),
    Key::new("drive.torque_history", Kind::Table("s", "N m"), "[[\"0 s\", \"0 N m\"], [\"5 ms\", \"0.1 N m\"]]", "Torque over time: straight between the rows, constant before the first and after the last.")
        .optional("drive.torque counts").excludes("drive.torque").when(TORQUE),
    Key::new("drive.reference_speed", Kind::Quantity("rad/s"), "12000 rpm", "Size of the speed that counts as full, in the direction of the torque: times to 95 % refer to it, and the tolerance of the run.")
        .when(TORQUE),
    Key::new("drive.final_speed", Kind::Quantity("rad/s"), "12000 rpm", "Speed that the inner race is brought to. Give this or speed_history.")
        .when(SPEED),
    Key::new("drive.acceleration", Kind::Quantity("rad/s^2"), "7200 rad/s^2", "Size of the constant acceleration up to the final speed.")
        .positive().optional("the inner race has its final speed from time 0, a step, while the balls are at rest").excludes("drive.speed_history").when(SPEED),
    Key::new("drive.speed_history", Kind::Table("s", "rad/s"), "[[\"0 s\", \"0 rad/s\"], [\"25 ms\", \"150 rad/s\"]]", "Speed over time: straight between the rows, constant before the first and after the last.")
        .optional("drive.final_speed counts").excludes("drive.final_speed").when(SPEED),
];
