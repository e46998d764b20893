//! What is refused, in words.

use std::fmt;

/// Why a levitation cannot be built or analysed.
#[derive(Debug, Clone, PartialEq)]
pub enum Refused {
    /// Sizes of matrices, or of a controller beside sensors and magnets, that do not fit, in words.
    Sizes(String),
    /// A filter that cannot be, in words.
    Filter(String),
    /// A node that the rotor does not have, in words.
    Node(String),
    /// A time of the controller that cannot be, in words.
    Time(String),
    /// A value of a sensor, an amplifier or a magnet that cannot be, in words.
    Value(String),
    /// The steps of an eigenvalue solution did not end.
    NoEigenvalues,
    /// The equations of an answer have none: the loop has an eigenvalue there.
    Singular,
    /// The magnets cannot hold the rotor where its sensors want it.
    NoEquilibrium,
}

impl Refused {
    /// A coefficient that is infinite or no number.
    pub(crate) fn not_finite() -> Self {
        Self::Filter("a coefficient that is no finite number".to_string())
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Sizes(text)
            | Self::Filter(text)
            | Self::Node(text)
            | Self::Time(text)
            | Self::Value(text) => text,
            Self::NoEigenvalues => "the eigenvalues were not found",
            Self::Singular => {
                "no answer: the closed loop has an eigenvalue at the frequency asked for"
            }
            Self::NoEquilibrium => {
                "the magnets cannot hold the rotor: no equilibrium within gaps and currents"
            }
        })
    }
}

impl std::error::Error for Refused {}
