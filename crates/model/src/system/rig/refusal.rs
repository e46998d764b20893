//! Why a rig cannot be built.

use crate::system::refusal::Refusal;
use std::fmt;

/// Why a rig cannot be built.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RigRefusal {
    /// The bearing.
    Bearing(Refusal),
    /// A constant, by its name, that is not finite, or not positive where it must be.
    NotPositive(&'static str),
    /// A constant, by its name, that is not finite, or negative.
    Negative(&'static str),
    /// A direction that is no unit vector.
    Direction,
    /// An action, by its index, that lies before the start, or before the one before it, or at no time.
    Order(usize),
    /// An action, by its index, with a number that has no meaning.
    Action(usize),
}

impl fmt::Display for RigRefusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RigRefusal::Bearing(why) => write!(f, "{why}"),
            RigRefusal::NotPositive(what) => write!(f, "the {what} must be a positive number"),
            RigRefusal::Negative(what) => write!(f, "the {what} must be a number and not negative"),
            RigRefusal::Direction => write!(f, "the direction of the load must be a unit vector"),
            RigRefusal::Order(index) => write!(
                f,
                "action {} of the program comes before the one above it, or before the start",
                index + 1
            ),
            RigRefusal::Action(index) => write!(
                f,
                "action {} of the program holds a number without meaning: rates and capacities are not negative, speeds finite",
                index + 1
            ),
        }
    }
}

impl std::error::Error for RigRefusal {}
