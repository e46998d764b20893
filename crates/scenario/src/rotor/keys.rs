//! The part of the table of keys that says what is asked of a flexible rotor.

use crate::key::{Key, Kind, Range, Section};
use crate::system::SystemName;

/// The systems of this page.
const ROTOR: &[SystemName] = &[SystemName::Rotor];

#[rustfmt::skip]
pub(crate) const SECTIONS: &[Section] = &[Section::new("analysis", "What is computed of the rotor: speeds, modes, margins.", ROTOR)];

/// What is asked of a flexible rotor; its own keys stand with those of the rotor that falls.
#[rustfmt::skip]
pub const KEYS: &[Key] = &[
    Key::new("analysis.speed_from", Kind::Quantity("rad/s"), "0 rpm", "Lowest speed of the diagrams.").not_negative().default("0 rpm", "from standstill"),
    Key::new("analysis.speed_to", Kind::Quantity("rad/s"), "18000 rpm", "Highest speed of the diagrams.")
        .positive().derived("1.5 times rotor.speed, at least as far as analysis.separation_margin reaches above analysis.operating_to; of a machine that starts at standstill the highest speed of its drive"),
    Key::new("analysis.speed_count", Kind::Count, "201", "Number of speeds of the diagrams. Critical speeds are searched between them.")
        .within(Range::FromTo(11.0, 5000.0)).default("201", "enough for a smooth picture"),
    Key::new("analysis.frequency_to", Kind::Quantity("rad/s"), "1800 rad/s", "Highest frequency of the Campbell diagram.")
        .positive().derived("1.5 times the highest speed"),
    Key::new("analysis.modes", Kind::Count, "6", "Number of modes shown with their shapes at rotor.speed, and of the free rotor at rest.")
        .within(Range::FromTo(1.0, 100.0)).default("6", "both rigid motions and the first bending, each of both senses"),
    Key::new("analysis.cutoff", Kind::Quantity("rad/s"), "60000 rad/s", "Modes of the free rotor up to this frequency are coordinates of the Campbell diagram, with residual flexibilities; small rotors keep all.")
        .positive().derived("6 times the highest frequency looked at"),
    Key::new("analysis.gravity", Kind::Quantity("m/s^2"), "9.80665 m/s^2", "Acceleration of gravity across the shaft, for sag and support loads; 0 for a vertical shaft.")
        .not_negative().default("9.80665 m/s^2", "standard gravity, a horizontal shaft"),
    Key::new("analysis.gravity_angle", Kind::Quantity("rad"), "-90 deg", "Direction of gravity, from x.").default("-90 deg", "down: against y"),
    Key::new("analysis.operating_from", Kind::Quantity("rad/s"), "9000 rpm", "Lowest operating speed, for the separation of critical speeds.")
        .positive().derived("rotor.speed"),
    Key::new("analysis.operating_to", Kind::Quantity("rad/s"), "12000 rpm", "Highest operating speed.").positive().derived("rotor.speed"),
    Key::new("analysis.separation_margin", Kind::Coefficient, "0.15", "Least distance of a forward critical speed from the operating speeds, as a share of the nearer one: each critical speed gets a verdict.")
        .within(Range::FromTo(0.0, 10.0)).optional("critical speeds get no verdict"),
    Key::new("analysis.exempt_amplification", Kind::Coefficient, "2.5", "Amplification below which a critical speed is damped enough to need no separation.")
        .positive().optional("no damping exempts a critical speed"),
    Key::new("analysis.map_from", Kind::Quantity("N/m"), "1e4 N/m", "Lowest stiffness of the map of critical speeds over support stiffness.")
        .positive().derived("a hundredth of the mean stiffness of supports and magnets (position_stiffness)"),
    Key::new("analysis.map_to", Kind::Quantity("N/m"), "1e8 N/m", "Highest stiffness of the map.")
        .positive().derived("100 times the mean stiffness of supports and magnets (position_stiffness)"),
    Key::new("analysis.map_count", Kind::Count, "41", "Number of stiffnesses of the map, evenly spaced on a logarithmic axis.")
        .within(Range::FromTo(2.0, 1000.0)).default("41", "ten a decade"),
];
