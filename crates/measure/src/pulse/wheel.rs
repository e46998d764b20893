//! The wheel that a pickup looks at.

/// The wheel that the pickup looks at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wheel {
    /// Marks per revolution, the left-out ones included.
    pub marks: usize,
    /// Neighbouring marks left out as a reference; zero for a full wheel.
    pub missing: usize,
}
