//! The part of the table of keys that asks more of a measurement: its converter, a vibration, curves of slow runs.

use crate::key::{Condition, Key, Kind, Range, Section};
use crate::signals::analysis::InertiaFrom;
use crate::system::SIGNALS;
use problem::words::Words;

#[rustfmt::skip]
pub(crate) const SECTIONS: &[Section] = &[
    Section::new("signals.converter", "The converter that took the channels: values at its limits are flagged and not used, its steps are compared with the noise.", SIGNALS),
    Section::new("signals.vibration", "A vibration: amplitudes of orders of the shaft over time, spectrogram over time and over order. It needs the shaft's speed.", SIGNALS),
    Section::new("signals.steady", "Torque over speed from a slow run with falling speed: by the torque sensor, and by inertia times the slope of the speed.", SIGNALS),
];

const fn inertia_is(values: &'static [&'static str]) -> Condition {
    Condition::new("signals.steady.inertia_from", values)
}

const GIVEN_INERTIA: &[Condition] = &[inertia_is(&["given"])];
const PENDULUM: &[Condition] = &[inertia_is(&["pendulum"])];
const BIFILAR: &[Condition] = &[inertia_is(&["bifilar"])];
const SWINGING: &[Condition] = &[inertia_is(&["pendulum", "bifilar"])];
const KNOWN_TORQUE: &[Condition] = &[inertia_is(&["known torque"])];

/// A measured value of an inertia test.
const fn measured(
    path: &'static str,
    unit: &'static str,
    example: &'static str,
    doc: &'static str,
    when: &'static [Condition],
) -> Key {
    Key::new(path, Kind::Quantity(unit), example, doc)
        .positive()
        .when(when)
}

/// Its standard deviation.
const fn spread(
    path: &'static str,
    unit: &'static str,
    example: &'static str,
    zero: &'static str,
    doc: &'static str,
    when: &'static [Condition],
) -> Key {
    Key::new(path, Kind::Quantity(unit), example, doc)
        .not_negative()
        .when(when)
        .default(zero, "taken as exact")
}

#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    Key::new("signals.converter.channels", Kind::Texts, "[\"torque\", \"tacho\"]", "Names of the channels that went through it, as in the file.")
        .optional("clipping is seen only where the highest or lowest value is held again and again"),
    Key::new("signals.converter.highest", Kind::Coefficient, "10", "Highest value that it can give, in the unit of its channels in the file.")
        .optional("it is needed with signals.converter.channels"),
    Key::new("signals.converter.lowest", Kind::Coefficient, "-10", "Lowest value that it can give.")
        .optional("it is signals.converter.highest with the other sign"),
    Key::new("signals.converter.bits", Kind::Count, "14", "Bits of a value.")
        .within(Range::FromTo(1.0, 64.0)).optional("it is needed with signals.converter.channels"),
    Key::new("signals.vibration.channel", Kind::Text, "acceleration", "Name of the channel as in the file.").optional("no vibration is looked at"),
    Key::new("signals.vibration.orders", Kind::Texts, "[\"1\", \"2\", \"4.08\"]", "Orders of the shaft, cycles a turn, whose amplitudes are followed over time; up to 8.")
        .optional("no order is followed"),
    Key::new("signals.vibration.bandwidth", Kind::Quantity("Hz"), "2 Hz", "An amplitude that swings at this frequency is followed to 71 %.")
        .positive().default("2 Hz", "amplitudes that change within half a second"),
    Key::new("signals.vibration.highest_frequency", Kind::Quantity("Hz"), "500 Hz", "Highest frequency of the spectrogram over time, at most half of the sampling rate; the lower it is, the finer the lines.")
        .positive().optional("half of the channel's sampling rate"),
    Key::new("signals.vibration.highest_order", Kind::Coefficient, "20", "Highest order of the spectrogram over order.")
        .within(Range::FromTo(1.0, 1000.0)).default("20", "ball pass of most bearings with its first harmonics"),
    Key::new("signals.vibration.turns", Kind::Count, "16", "Turns of the shaft in one spectrum over order: two orders are separated down to about two over this.")
        .within(Range::FromTo(2.0, 10_000.0)).default("16", "order 4 and ball pass at 4.1 are separated"),
    Key::new("signals.steady.from", Kind::Quantity("s"), "12 s", "Where the part with slowly falling speed begins, on the clock of the file.")
        .optional("no steady curve is drawn"),
    Key::new("signals.steady.to", Kind::Quantity("s"), "60 s", "Where it ends.").optional("it is needed with signals.steady.from"),
    Key::new("signals.steady.up_from", Kind::Quantity("s"), "1 s", "Where a part with slowly rising speed begins, to set its torque against that of the falling speed.")
        .optional("up is not set against down"),
    Key::new("signals.steady.up_to", Kind::Quantity("s"), "11 s", "Where it ends.").optional("it is needed with signals.steady.up_from"),
    Key::new("signals.steady.points", Kind::Count, "40", "Speeds at which the curves are drawn.")
        .within(Range::FromTo(2.0, 200.0)).default("40", "more than a smooth curve needs"),
    Key::new("signals.steady.inertia_from", Kind::Word(InertiaFrom::WORDS), "given", "How the inertia of all that coasts is known: given; from swinging about a knife edge; from turning on two strings; from the acceleration by a known torque.")
        .default("given", "most rotors are drawn before they are built"),
    Key::new("signals.steady.inertia", Kind::Quantity("kg m^2"), "0.00021 kg m^2", "Inertia of all that coasts.")
        .positive().when(GIVEN_INERTIA).optional("no torque is found from the slope of the speed"),
    Key::new("signals.steady.inertia_deviation", Kind::Coefficient, "0.02", "Its relative standard deviation.")
        .within(Range::FromTo(0.0, 1.0)).when(GIVEN_INERTIA).default("0", "taken as exact"),
    Key::new("signals.steady.windage_constant", Kind::Quantity("N m"), "0.2 N mm", "Constant part of the torque that brakes the shaft without the bearing (windage, other bearings): it is taken out of the torque by the slope of the speed and reported apart.")
        .not_negative().optional("no constant part"),
    Key::new("signals.steady.windage_linear", Kind::Quantity("N m s"), "1 uN m s", "The part of it that grows with the speed, over the speed in rad/s.")
        .not_negative().optional("no part with the speed"),
    Key::new("signals.steady.windage_quadratic", Kind::Quantity("N m s^2"), "0.02 uN m s^2", "The part of it that grows with the square of the speed, over that square.")
        .not_negative().optional("no part with the square of the speed"),
    Key::new("signals.steady.windage_deviation", Kind::Coefficient, "0.1", "Relative standard deviation of that law, the same at all speeds.")
        .within(Range::FromTo(0.0, 1.0)).default("0.2", "a law carried over from another shaft, or computed"),
    Key::new("signals.steady.windage_file", Kind::Text, "without_bearing.toml", "Signals file of a coast-down of the same shaft without the bearing, with its own signals.steady; in place of the law.")
        .optional("nothing is taken out but the law, where there is one"),
    measured("signals.steady.test_mass", "kg", "0.4 kg", "Mass of the rotor that swings.", SWINGING),
    spread("signals.steady.test_mass_deviation", "kg", "0.001 kg", "0 kg", "Its standard deviation.", SWINGING),
    measured("signals.steady.test_period", "s", "0.62 s", "Period of the swing.", SWINGING),
    spread("signals.steady.test_period_deviation", "s", "0.001 s", "0 s", "Its standard deviation.", SWINGING),
    measured("signals.steady.test_arm", "m", "60 mm", "Distance from the knife edge to the mass centre.", PENDULUM),
    spread("signals.steady.test_arm_deviation", "m", "0.1 mm", "0 mm", "Its standard deviation.", PENDULUM),
    Key::new("signals.steady.test_amplitude", Kind::Quantity("rad"), "0.1 rad", "Amplitude of the swing.")
        .within(Range::FromTo(0.0, 0.5)).when(PENDULUM).default("0 rad", "small swings"),
    measured("signals.steady.string_distance", "m", "50 mm", "Distance of the two strings.", BIFILAR),
    spread("signals.steady.string_distance_deviation", "m", "0.1 mm", "0 mm", "Its standard deviation.", BIFILAR),
    measured("signals.steady.string_length", "m", "1.2 m", "Length of the strings.", BIFILAR),
    spread("signals.steady.string_length_deviation", "m", "1 mm", "0 mm", "Its standard deviation.", BIFILAR),
    Key::new("signals.steady.test_gravity", Kind::Quantity("m/s^2"), "9.81 m/s^2", "Gravity where the rotor swings.")
        .positive().when(SWINGING).default("9.80665 m/s^2", "standard gravity; it differs by up to 0.3 % over the Earth"),
    measured("signals.steady.test_torque", "N m", "20 N mm", "Torque that is added.", KNOWN_TORQUE),
    spread("signals.steady.test_torque_deviation", "N m", "0.2 N mm", "0 N mm", "Its standard deviation.", KNOWN_TORQUE),
    Key::new("signals.steady.acceleration_with", Kind::Quantity("rad/s^2"), "80 rad/s^2", "Acceleration with that torque.").when(KNOWN_TORQUE),
    spread("signals.steady.acceleration_with_deviation", "rad/s^2", "1 rad/s^2", "0 rad/s^2", "Its standard deviation.", KNOWN_TORQUE),
    Key::new("signals.steady.acceleration_without", Kind::Quantity("rad/s^2"), "-15 rad/s^2", "Acceleration without it, at the same speed.")
        .when(KNOWN_TORQUE),
    spread("signals.steady.acceleration_without_deviation", "rad/s^2", "1 rad/s^2", "0 rad/s^2", "Its standard deviation.", KNOWN_TORQUE),
];
