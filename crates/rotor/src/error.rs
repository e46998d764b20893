//! Why an analysis has no answer.

/// Why an analysis has no answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RotorError {
    /// The mass matrix is not positive: something has no mass.
    NoMass,
    /// The supports leave a motion free that the analysis needs held.
    NotHeld,
    /// More modes were asked for than oscillate.
    TooManyModes {
        /// How many were asked for.
        asked: usize,
        /// How many there are.
        there: usize,
    },
    /// A mode crosses the line of once a turn at about this speed, rad/s, and its critical speed was not found.
    CriticalMissing(f64),
    /// The eigen-solver did not converge.
    NotConverged,
}

impl std::fmt::Display for RotorError {
    fn fmt(&self, to: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            RotorError::NoMass => write!(to, "the mass matrix is not positive"),
            RotorError::NotHeld => write!(to, "the supports leave a motion free"),
            RotorError::TooManyModes { asked, there } => {
                write!(to, "{asked} modes were asked for, {there} oscillate")
            }
            RotorError::CriticalMissing(speed) => write!(
                to,
                "a mode comes to whirl once a turn at about {speed:.6} rad/s, and its critical speed was not found"
            ),
            RotorError::NotConverged => write!(to, "the eigen-solver did not converge"),
        }
    }
}

impl std::error::Error for RotorError {}
