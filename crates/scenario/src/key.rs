//! Keys of scenarios.

pub use problem::key::*;

use crate::bearing::kind::{BearingType, TYPE};
use crate::system::SystemName;
use problem::words::Words;

/// One key of a scenario.
pub type Key = problem::key::Key<SystemName>;

/// Friction coefficients of rotor and race: of clean metals that seize in vacuum some units, of nothing that slides more.
pub const LANDING_FRICTION: Range = Range::FromTo(0.0, 5.0);

/// That there are balls.
const WITH_BALLS: &[Condition] = &[Condition::new(TYPE, BearingType::WORDS)
    .because("a bushing has neither balls nor races; mount.moving_mass is its ring")];

/// One section of a scenario.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// Dotted path, such as `bearing.cage`.
    pub path: &'static str,
    /// What it is, in one or two sentences.
    pub doc: &'static str,
    /// The systems that have the section.
    pub systems: &'static [SystemName],
}

impl Section {
    pub(crate) const fn new(
        path: &'static str,
        doc: &'static str,
        systems: &'static [SystemName],
    ) -> Section {
        Section { path, doc, systems }
    }
}

/// All that must hold for a key to have a meaning: its own conditions, and of a rolling bearing that there are balls.
pub fn conditions(key: &Key) -> impl Iterator<Item = &'static Condition> {
    let of_balls = key.path.starts_with("bearing.") && key.path != TYPE;
    let balls = if of_balls { WITH_BALLS } else { &[] };
    balls.iter().chain(key.when)
}
