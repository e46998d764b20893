//! Names of the systems, and groups of them that share keys.

/// Kinds of files: the words of all systems, in their order, and of a study.
pub const KINDS: &[&str] = &[
    "drop",
    "spin_up",
    "torque",
    "signals",
    "rig",
    "identify",
    "rotor",
    "machine",
    "coast_down",
    "study",
];

use crate::rotor::keys::OF_MACHINES;
use SystemName::{CoastDown, Drop, Identify, Machine, Rig, Rotor, Signals, SpinUp, Torque};

/// Name of a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SystemName {
    /// A levitated rotor that is released onto its auxiliary bearing.
    Drop,
    /// A bearing whose inner race is brought to speed while its outer race stands.
    SpinUp,
    /// The torque of a bearing over speed, load and acceleration.
    Torque,
    /// A measurement: speed, torque and cage speed from the channels of a file.
    Signals,
    /// A test on a rig, and the raw file that its logger writes.
    Rig,
    /// What measured tests tell of a bearing.
    Identify,
    /// A flexible rotor: modes, critical speeds, response to unbalance.
    Rotor,
    /// A flexible rotor that is released onto its auxiliary bearings.
    Machine,
    /// A rotor that coasts down on its warming auxiliary bearings.
    CoastDown,
}

/// Of each system, in the order of [`SystemName::ALL`]: the first sentence of its starting file; a limit of its own results for that file,
/// result and bound; what takes so long before it runs.
#[rustfmt::skip]
const ABOUT: [[&str; 4]; SystemName::ALL.len()] = [
    ["A levitated rotor drops onto its auxiliary bearing.", "peak_contact_force", "most = \"5 kN\"", BUILDING],
    ["The inner race of a bearing is brought to speed.", "peak_outer_race_moment", "most = \"0.5 N m\"", BUILDING],
    ["The torque of a bearing over speed, load and acceleration.", "friction_moment", "most = \"50 N mm\"", BUILDING],
    ["Speed, torque and cage speed from a measurement.", "peak_speed", "most = \"3000 rpm\"", READING],
    ["A test on a rig, and the raw file of its logger.", "peak_outer_race_moment", "most = \"0.5 N m\"", SEARCHING],
    ["What measured tests show of a bearing.", "explanation_fit_probability", "least = 0.05", READING],
    ["Modes, critical speeds and response to unbalance of a flexible rotor.", "first_critical_speed", "least = \"9000 rpm\"", "reducing the rotor"],
    ["A flexible rotor drops onto its auxiliary bearings.", "peak_contact_force", "most = \"5 kN\"", BUILDING],
    ["A rotor coasts down on its auxiliary bearings, which warm.", "peak_inner_race_temperature", "most = \"120 degC\"", BUILDING],
];
const BUILDING: &str = "building the machine";
const READING: &str = "reading the measurement files";
const SEARCHING: &str = "searching the engagement that gives the wanted acceleration";

impl SystemName {
    /// All systems.
    pub const ALL: &'static [SystemName] = &[
        Drop, SpinUp, Torque, Signals, Rig, Identify, Rotor, Machine, CoastDown,
    ];
    /// Their words, in the same order.
    pub const WORDS: &'static [&'static str] = KINDS.split_last().expect("systems").1;
    /// Words of systems that are planned, so that asking for one is no spelling mistake.
    pub const PLANNED: &'static [&'static str] = &["mount"];

    /// The word in a file: `spin_up`.
    pub fn word(self) -> &'static str {
        SystemName::WORDS[self as usize]
    }

    /// The system of a word.
    pub fn of(word: &str) -> Option<SystemName> {
        let all = SystemName::ALL.iter().copied();
        all.into_iter().find(|system| system.word() == word)
    }

    /// The first sentence of its starting file.
    pub fn about(self) -> &'static str {
        ABOUT[self as usize][0]
    }

    /// A limit of its own results, for its starting file: result, bound.
    pub fn limit_example(self) -> (&'static str, &'static str) {
        let [_, result, bound, _] = ABOUT[self as usize];
        (result, bound)
    }

    /// What takes so long before it runs.
    pub fn preparation(self) -> &'static str {
        ABOUT[self as usize][3]
    }

    /// Whether a rotor that bends falls.
    pub fn bends(self) -> bool {
        MACHINE.contains(&self)
    }

    /// Whether it reads measurements.
    pub fn reads_measurements(self) -> bool {
        MEASURED.contains(&self)
    }

    /// Whether a levitated rotor falls.
    pub fn falls(self) -> bool {
        FALLING.contains(&self)
    }

    /// Whether its rotor lies in auxiliary bearings, one or several.
    pub fn has_auxiliary_bearings(self) -> bool {
        COASTING_DOWN.contains(&self)
    }

    /// Whether it has parts of a kind, by the word of that.
    pub fn has_part(self, word: &str) -> bool {
        self.has_shaft() && (!OF_MACHINES.contains(&word) || MACHINE.contains(&self))
    }

    /// Whether its rotor is a shaft of parts.
    pub fn has_shaft(self) -> bool {
        SHAFT.contains(&self)
    }

    /// Systems in words, for messages: `"drop" or "spin_up"`.
    pub fn list(systems: &[SystemName]) -> String {
        let words: Vec<String> = systems
            .iter()
            .map(|system| format!("\"{}\"", system.word()))
            .collect();
        words.join(" or ")
    }
}

/// A rigid rotor that falls.
pub const DROP: &[SystemName] = &[Drop];
/// A flexible rotor that falls.
pub const MACHINE: &[SystemName] = &[Machine];
/// A spin-up.
pub const SPIN_UP: &[SystemName] = &[SpinUp];
/// The torque of a bearing.
pub const TORQUE: &[SystemName] = &[Torque];
/// A measurement.
pub const SIGNALS: &[SystemName] = &[Signals];
/// A test on a rig.
pub const RIG: &[SystemName] = &[Rig];
/// What tests tell of a bearing.
pub const IDENTIFY: &[SystemName] = &[Identify];
/// The analysis of a flexible rotor.
pub const ROTOR: &[SystemName] = &[Rotor];
/// A rotor that coasts down.
pub const COAST_DOWN: &[SystemName] = &[CoastDown];

/// Systems that read measurements.
pub const MEASURED: &[SystemName] = &[Signals, Identify];
/// Systems with a rotor.
pub const WITH_ROTOR: &[SystemName] = &[Drop, Rotor, Machine, CoastDown];
/// Systems whose rotor is a mass with an inertia.
pub const RIGID: &[SystemName] = &[Drop, CoastDown];
/// Systems in which gas brakes the rotor.
pub const IN_GAS: &[SystemName] = &[Machine, CoastDown];
/// Systems with magnetic bearings.
pub const LEVITATED: &[SystemName] = &[Drop, Rotor, Machine];
/// Systems whose bearing is tested alone.
pub const TESTED: &[SystemName] = &[SpinUp, Torque, Rig];
/// Systems whose inner race sits on a shaft of the rig.
pub const ON_RIG: &[SystemName] = &[SpinUp, Rig];

/// Systems in which something moves.
pub const MOVING: &[SystemName] = &[Drop, SpinUp, Rig, Machine];

/// Systems in which a levitated rotor falls.
pub const FALLING: &[SystemName] = &[Drop, Machine];
/// Systems that coast down, by themselves or after a drop.
pub const COASTING_DOWN: &[SystemName] = &[Drop, Machine, CoastDown];

/// Systems whose bearings may warm in time, where that is wanted.
pub const WARMING: &[SystemName] = MOVING;
/// All systems with a network of heat.
pub const WITH_NETWORK: &[SystemName] = &[Drop, SpinUp, Rig, Machine, CoastDown];
/// Systems that compute columns over time.
pub const OVER_TIME: &[SystemName] = WITH_NETWORK;

/// Systems whose runs have a choice of steps.
pub const STEPPED: &[SystemName] = &[Drop, SpinUp, Machine];

/// Systems whose rotor is a shaft of parts.
pub const SHAFT: &[SystemName] = &[Rotor, Machine];

/// Systems in which a cage turns as a body, or its inertia counts.
pub const WITH_CAGE: &[SystemName] = &[Drop, SpinUp, Torque, Rig, Identify, Machine];

/// Systems whose balls carry loads by their contacts.
pub const WITH_BALLS: &[SystemName] = &[Drop, SpinUp, Rig, Machine, CoastDown];

/// Systems in which the inner race has a mass of its own.
pub const RACE_MASS: &[SystemName] = &[Drop, SpinUp, Machine, CoastDown];

/// Systems in which the inner race is a body of its own, not a part of a shaft.
pub const FREE_RACE: &[SystemName] = &[Drop, SpinUp, Machine];

/// Systems with a bearing.
pub const WITH_BEARING: &[SystemName] = &[CoastDown, Drop, SpinUp, Torque, Rig, Identify, Machine];

/// Systems with a friction moment of a bearing.
pub const WITH_MOMENT: &[SystemName] = &[CoastDown, Drop, SpinUp, Torque, Rig, Machine];
