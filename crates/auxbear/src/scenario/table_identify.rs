//! The part of the table of keys that describes what measured tests are to tell of a bearing.

use super::key::{Key, Kind, Range, Section};
use super::system::SystemName;

/// The systems of this page.
const IDENTIFY: &[SystemName] = &[SystemName::Identify];

pub(super) const SECTIONS: &[Section] = &[
    Section {
        path: "identify",
        doc: "What measured tests tell of a bearing. Each test is a file of the system signals, which says what its channels are; auxbear run of a rig writes one beside its raw file.",
        systems: IDENTIFY,
    },
    Section {
        path: "identify.explanations",
        doc: "Why the torque after a spin-up differs from that of the coast-down: explanations are compared by how well they foretell the data.",
        systems: IDENTIFY,
    },
    Section {
        path: "identify.rotor_friction",
        doc: "Sliding friction between a dropped rotor and the inner race, from the speed of the race alone while the rotor brings it up.",
        systems: IDENTIFY,
    },
];

pub(super) const KEYS: &[Key] = &[
    Key::new(
        "identify.coast_down",
        Kind::Texts,
        "[\"coast_down.toml\"]",
        "Signals files of slow tests, relative to this one: their torque over speed is the steady friction moment M.",
    ),
    Key::new(
        "identify.tests",
        Kind::Texts,
        "[\"test_1.toml\", \"test_2.toml\", \"test_3.toml\"]",
        "Signals files of tests with acceleration, relative to this one.",
    )
    .optional("the steady friction moment alone is identified"),
    Key::new(
        "identify.radial_load",
        Kind::Quantity("N"),
        "60 N",
        "Weight on the bearing in tests whose signals file gives none.",
    )
    .positive()
    .optional("each signals file gives its own, signals.radial_load"),
    Key::new(
        "identify.analysed_speed",
        Kind::Quantity("rad/s"),
        "140 rad/s",
        "Speed at which tests are compared, which each must reach.",
    )
    .positive()
    .optional("95 % of the largest speed of the slowest test"),
    Key::new(
        "identify.rolling",
        Kind::Word(&["shown by the cage", "stated"]),
        "shown by the cage",
        "Where the friction F of accelerated balls is computed: where the cage signal shows that the balls roll, or everywhere because rolling is stated.",
    )
    .default("shown by the cage", "without a cage signal nobody knows whether the balls roll"),
    Key::new(
        "identify.viscosity",
        Kind::Quantity("m^2/s"),
        "100 mm^2/s",
        "Kinematic viscosity of the lubricant at the temperature of the tests: it tells where Palmgren's moment leaves its floor.",
    )
    .positive()
    .optional("the floor of Palmgren's moment is left out of the fit"),
    Key::new(
        "identify.moment_per_kelvin",
        Kind::Coefficient,
        "-0.02",
        "Part by which the friction moment changes per kelvin of the outer race.",
    )
    .within(Range::FromTo(-0.2, 0.0))
    .assumed("-0.02", "two thirds of the 3 % by which the viscosity of a mineral oil falls near 40 °C"),
    Key::new(
        "identify.explanations.compare",
        Kind::Switch,
        "true",
        "Whether explanations are compared.",
    )
    .default("true", "it takes seconds"),
    Key::new(
        "identify.explanations.decide_at",
        Kind::Coefficient,
        "0.95",
        "Probability from which on an explanation is taken as the right one; below it the answer is undecided.",
    )
    .within(Range::FromTo(0.5, 0.999_999))
    .default("0.95", "one wrong answer in twenty"),
    Key::new(
        "identify.explanations.seed",
        Kind::Count,
        "1",
        "Seed of the sampled parameters.",
    )
    .default("1", "any number; the same seed gives the same answer"),
    Key::new(
        "identify.rotor_friction.file",
        Kind::Text,
        "drop.toml",
        "Signals file with the speed of the inner race, relative to this one.",
    )
    .optional("no sliding friction is identified"),
    Key::new(
        "identify.rotor_friction.rotor_speed",
        Kind::Quantity("rad/s"),
        "12000 rpm",
        "Spin of the rotor, held meanwhile.",
    )
    .positive()
    .optional("it is needed with identify.rotor_friction.file"),
    Key::new(
        "identify.rotor_friction.radial_load",
        Kind::Quantity("N"),
        "80 N",
        "Force of the rotor on the race: its weight at this bearing, once it bounces no more.",
    )
    .positive()
    .optional("it is needed with identify.rotor_friction.file"),
    Key::new(
        "identify.rotor_friction.load_deviation",
        Kind::Coefficient,
        "0.05",
        "Relative standard deviation of that force.",
    )
    .within(Range::FromTo(0.0, 1.0))
    .assumed("0.05", "a weight whose share at this bearing is known to 5 %"),
    Key::new(
        "identify.rotor_friction.bore_diameter",
        Kind::Quantity("m"),
        "25 mm",
        "Diameter at which the rotor slides.",
    )
    .positive()
    .optional("it is needed with identify.rotor_friction.file"),
    Key::new(
        "identify.rotor_friction.inertia",
        Kind::Quantity("kg m^2"),
        "3.9e-6 kg m^2",
        "Moment of inertia of the inner race with its sleeve.",
    )
    .positive()
    .optional("it is needed with identify.rotor_friction.file"),
];

/// What the starting file gives.
pub(super) const GIVEN: &[&str] = &["identify.tests", "identify.radial_load"];

/// Keys that name a file beside this one, or a list of such files.
pub(super) const FILES: &[&str] = &[
    "identify.coast_down",
    "identify.tests",
    "identify.rotor_friction.file",
];
