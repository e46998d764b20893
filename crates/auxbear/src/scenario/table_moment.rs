//! The part of the table of keys that describes the friction of the bearing as a whole.

use super::key::{Condition, Key, Kind, Section};
use super::system::SystemName;

pub(super) const SECTIONS: &[Section] = &[Section {
    path: "bearing.moment",
    doc: "Steady friction moment of the bearing, for the fidelity \"rolling\".",
    systems: SystemName::ALL,
}];

const ROLLING: Condition = Condition {
    path: "bearing.fidelity",
    values: &["rolling"],
    reason: "the fidelity \"planar\" has no steady moment yet",
};

const PALMGREN: Condition = Condition {
    path: "bearing.moment.law",
    values: &["palmgren"],
    reason: "",
};

pub(super) const KEYS: &[Key] = &[
    Key::new(
        "bearing.moment.law",
        Kind::Word(&["none", "palmgren"]),
        "palmgren",
        "Law of the steady friction moment.",
    )
    .default("none", "no moment unless one is asked for")
    .when(ROLLING),
    Key::new(
        "bearing.moment.form",
        Kind::Word(&["continuous", "printed"]),
        "continuous",
        "Form of the load-independent moment: continuous and odd in speed, or as printed, with its step of one percent.",
    )
    .default("continuous", "a moment without step")
    .when(PALMGREN),
    Key::new(
        "bearing.moment.f0",
        Kind::Coefficient,
        "2",
        "Palmgren factor f0 of bearing type and lubrication.",
    )
    .not_negative()
    .when(PALMGREN),
    Key::new(
        "bearing.moment.viscosity",
        Kind::Quantity("m^2/s"),
        "100 mm^2/s",
        "Kinematic viscosity of the lubricant at running temperature.",
    )
    .not_negative()
    .when(PALMGREN),
    Key::new(
        "bearing.moment.f1_factor",
        Kind::Coefficient,
        "0.0009",
        "Factor z of the load-dependent friction f1 = z (P0/C0)^y.",
    )
    .not_negative()
    .when(PALMGREN),
    Key::new(
        "bearing.moment.f1_exponent",
        Kind::Coefficient,
        "0.55",
        "Exponent y of the load-dependent friction f1 = z (P0/C0)^y.",
    )
    .not_negative()
    .when(PALMGREN),
];
