//! The part of the table of keys that describes what measured tests are to tell of a bearing.

use crate::identify::Rolling;
use crate::key::{Key, Kind, Range, Section};
use crate::system::IDENTIFY;
use problem::words::Words;

#[rustfmt::skip]
pub(crate) const SECTIONS: &[Section] = &[
    Section::new("identify", "What measured tests show of a bearing. Each test is a file of the system signals, which says what its channels are; auxbear run of a rig writes one beside its raw file.", IDENTIFY),
    Section::new("identify.explanations", "Why the torque after a spin-up differs from that of the coast-down: explanations are compared by how well they predict the data.", IDENTIFY),
    Section::new("identify.rotor_friction", "Sliding friction between a dropped rotor and the inner race, from the speed of the race alone while the rotor brings it up.", IDENTIFY),
];

#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    Key::new("identify.coast_down", Kind::Texts, "[\"coast_down.toml\"]", "Signals files of slow tests, relative to this one: their torque over speed is the steady friction moment M."),
    Key::new("identify.tests", Kind::Texts, "[\"test_1.toml\", \"test_2.toml\", \"test_3.toml\"]", "Signals files of tests with acceleration, relative to this one.")
        .optional("the steady friction moment alone is identified"),
    Key::new("identify.radial_load", Kind::Quantity("N"), "60 N", "Weight on the bearing in tests whose signals file gives none.")
        .positive().optional("each signals file gives its own, signals.radial_load"),
    Key::new("identify.analysed_speed", Kind::Quantity("rad/s"), "140 rad/s", "Speed at which tests are compared, which each must reach.")
        .positive().optional("95 % of the largest speed of the slowest test"),
    Key::new("identify.rolling", Kind::Word(Rolling::WORDS), "shown by the cage", "Where the friction F of accelerated balls is computed: where the cage signal shows that the balls roll, or everywhere because rolling is stated.")
        .default("shown by the cage", "without a cage signal nobody knows whether the balls roll"),
    Key::new("identify.viscosity", Kind::Quantity("m^2/s"), "100 mm^2/s", "Kinematic viscosity of the lubricant at the temperature of the tests: it gives where Palmgren's moment leaves its floor.")
        .positive().optional("the floor of Palmgren's moment is left out of the fit"),
    Key::new("identify.moment_per_kelvin", Kind::Coefficient, "-0.02", "Part by which the friction moment changes per kelvin of the outer race.")
        .within(Range::FromTo(-0.2, 0.0)).assumed("-0.02", "two thirds of the 3 % by which the viscosity of a mineral oil falls near 40 °C"),
    Key::new("identify.moment_per_kelvin_deviation", Kind::Coefficient, "0.5", "Relative standard deviation of moment_per_kelvin.")
        .within(Range::FromTo(0.0, 1.0)).assumed("0.5", "oils thin by 2 to 6 % per kelvin, and a part of the moment does not follow the viscosity"),
    Key::new("identify.ball_mass_deviation", Kind::Coefficient, "0.02", "Relative standard deviation of the mass of the balls.")
        .within(Range::FromTo(0.0, 1.0)).assumed("0.02", "a diameter known to 0.5 % makes 1.5 % of the mass, the density of the steel another 1 %"),
    Key::new("identify.cage_mass_deviation", Kind::Coefficient, "0.02", "Relative standard deviation of the mass of the cage.")
        .within(Range::FromTo(0.0, 1.0)).assumed("0.02", "a cage that was weighed, with the grease that clings to it; one that was estimated may be off by 20 %"),
    Key::new("identify.track_radius_deviation", Kind::Coefficient, "0.002", "Relative standard deviation of the radius of the inner race track, (pitch_diameter - ball_diameter)/2.")
        .within(Range::FromTo(0.0, 0.5)).assumed("0.002", "some hundredths of a millimetre in 15 mm"),
    Key::new("identify.settling_time", Kind::Quantity("s"), "0.5 s", "Time within which the torque arm settles after a sudden change: a slow test is cut by it before its stop, and a zero is read from so long after the last pulse on.")
        .positive().assumed("0.5 s", "five times the 0.1 s in which an arm of ζω_n = 39 1/s settles to 2 %, as that of the source paper"),
    Key::new("identify.explanations.compare", Kind::Switch, "true", "Whether explanations are compared.").default("true", "it takes seconds"),
    Key::new("identify.explanations.decide_at", Kind::Coefficient, "0.95", "Probability from which on an explanation is taken as the right one; below it the answer is undecided.")
        .within(Range::FromTo(0.5, 0.999_999)).default("0.95", "one wrong answer in twenty"),
    Key::new("identify.explanations.locking_window", Kind::Quantity("s"), "10 ms", "Time around the largest acceleration, where a clutch locks, within which the jump of the inertia's part of the torque is smeared: the torque is not known there to that jump.")
        .positive().assumed("10 ms", "about 1/ω_n of usual torque arms: 16 ms at 10 Hz, 5 ms at 30 Hz"),
    Key::new("identify.explanations.rolling_ratio_deviation", Kind::Coefficient, "0.002", "Relative standard deviation of the ratio of the cage's rolling speed to the shaft's, by contact angle and radii.")
        .within(Range::FromTo(0.0, 0.1)).assumed("0.002", "diameters that are off by 1 %, or a contact angle of 8 deg taken as none; a slip that explains a torque is ten times that"),
    Key::new("identify.explanations.seed", Kind::Count, "1", "Seed of the sampled parameters.")
        .default("1", "any number; the same seed gives the same answer"),
    Key::new("identify.rotor_friction.file", Kind::Text, "drop.toml", "Signals file with the speed of the inner race, relative to this one.")
        .optional("no sliding friction is identified"),
    Key::new("identify.rotor_friction.rotor_speed", Kind::Quantity("rad/s"), "12000 rpm", "Spin of the rotor, held meanwhile.")
        .positive().optional("it is needed with identify.rotor_friction.file"),
    Key::new("identify.rotor_friction.radial_load", Kind::Quantity("N"), "80 N", "Force of the rotor on the race, constant: its weight at this bearing, once it bounces no more.")
        .positive().optional("it is needed with identify.rotor_friction.file"),
    Key::new("identify.rotor_friction.load_deviation", Kind::Coefficient, "0.05", "Relative standard deviation of that force.")
        .within(Range::FromTo(0.0, 1.0)).assumed("0.05", "a weight whose share at this bearing is known to 5 %"),
    Key::new("identify.rotor_friction.from", Kind::Quantity("s"), "20 ms", "Time of the file from which on the rotor lies on the race with that force: it bounces no more.")
        .optional("from the first pulse on"),
    Key::new("identify.rotor_friction.to", Kind::Quantity("s"), "0.1 s", "Time of the file until which it does and spins at rotor_speed.")
        .optional("to the last pulse"),
    Key::new("identify.rotor_friction.least_slip", Kind::Quantity("m/s"), "0.05 m/s", "Least slip of the rotor's surface over the race's that counts as sliding.")
        .positive().assumed("0.05 m/s", "a rotor that swings by 80 µm at 100 Hz moves its surface as fast"),
    Key::new("identify.rotor_friction.bore_diameter", Kind::Quantity("m"), "25 mm", "Diameter at which the rotor slides.")
        .positive().optional("it is needed with identify.rotor_friction.file"),
    Key::new("identify.rotor_friction.radial_air_clearance", Kind::Quantity("m"), "0.25 mm", "Radial air clearance of the rotor in that bore: its surface is slower than one of the bore's radius would be.")
        .positive().optional("the rotor counts as wide as the bore, and its slip as too large"),
    Key::new("identify.rotor_friction.inertia", Kind::Quantity("kg m^2"), "3.9e-6 kg m^2", "Moment of inertia of the inner race with its sleeve.")
        .positive().optional("it is needed with identify.rotor_friction.file"),
    Key::new("identify.rotor_friction.inertia_deviation", Kind::Coefficient, "0.02", "Relative standard deviation of that inertia.")
        .within(Range::FromTo(0.0, 1.0)).assumed("0.02", "radii known to 0.5 % make 2 % of an inertia"),
];

/// What the starting file gives.
pub const GIVEN: &[&str] = &["identify.tests", "identify.radial_load"];

/// Keys that name a file beside this one, or a list of such files.
pub const FILES: &[&str] = &[
    "identify.coast_down",
    "identify.tests",
    "identify.rotor_friction.file",
];
