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
    /// A rotor that runs out on its warming auxiliary bearings.
    CoastDown,
}

impl SystemName {
    /// All systems.
    pub const ALL: &'static [SystemName] = &[
        SystemName::Drop,
        SystemName::SpinUp,
        SystemName::Torque,
        SystemName::Signals,
        SystemName::Rig,
        SystemName::Identify,
        SystemName::Rotor,
        SystemName::Machine,
        SystemName::CoastDown,
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

    /// Whether a levitated rotor falls.
    pub fn falls(self) -> bool {
        FALLING.contains(&self)
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

/// Systems in which something moves.
pub const MOVING: &[SystemName] = &[
    SystemName::Drop,
    SystemName::SpinUp,
    SystemName::Rig,
    SystemName::Machine,
];

/// Systems in which a levitated rotor falls.
pub const FALLING: &[SystemName] = &[SystemName::Drop, SystemName::Machine];
/// Systems that run out, by themselves or after a drop.
pub const RUNNING_OUT: &[SystemName] =
    &[SystemName::Drop, SystemName::Machine, SystemName::CoastDown];

/// Systems whose bearings may warm in time, where that is wanted.
pub const WARMING: &[SystemName] = MOVING;
/// All systems with a network of heat.
pub const WITH_NETWORK: &[SystemName] = &[
    SystemName::Drop,
    SystemName::SpinUp,
    SystemName::Rig,
    SystemName::Machine,
    SystemName::CoastDown,
];

/// Systems whose runs have a choice of steps.
pub const STEPPED: &[SystemName] = &[SystemName::Drop, SystemName::SpinUp, SystemName::Machine];

/// Systems whose rotor is a shaft of parts.
pub const SHAFT: &[SystemName] = &[SystemName::Rotor, SystemName::Machine];

/// Systems in which a cage turns as a body, or its inertia counts.
pub const WITH_CAGE: &[SystemName] = &[
    SystemName::Drop,
    SystemName::SpinUp,
    SystemName::Torque,
    SystemName::Rig,
    SystemName::Identify,
    SystemName::Machine,
];

/// Systems whose balls carry loads by their contacts.
pub const WITH_BALLS: &[SystemName] = &[
    SystemName::Drop,
    SystemName::SpinUp,
    SystemName::Rig,
    SystemName::Machine,
    SystemName::CoastDown,
];

/// Systems in which the inner race has a mass of its own.
pub const RACE_MASS: &[SystemName] = &[
    SystemName::Drop,
    SystemName::SpinUp,
    SystemName::Machine,
    SystemName::CoastDown,
];

/// Systems in which the inner race is a body of its own, not a part of a shaft.
pub const FREE_RACE: &[SystemName] = &[SystemName::Drop, SystemName::SpinUp, SystemName::Machine];

/// Systems with a bearing.
pub const WITH_BEARING: &[SystemName] = &[
    SystemName::CoastDown,
    SystemName::Drop,
    SystemName::SpinUp,
    SystemName::Torque,
    SystemName::Rig,
    SystemName::Identify,
    SystemName::Machine,
];

/// Systems with a friction moment of a bearing.
pub const WITH_MOMENT: &[SystemName] = &[
    SystemName::CoastDown,
    SystemName::Drop,
    SystemName::SpinUp,
    SystemName::Torque,
    SystemName::Rig,
    SystemName::Machine,
];
