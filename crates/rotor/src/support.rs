//! Linear supports and seals, and what they hold.

use crate::Coefficients;

/// What a support holds, or is held to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// A node of the shaft.
    Node(usize),
    /// A housing.
    Housing(usize),
}

/// A linear support or seal.
#[derive(Debug, Clone, PartialEq)]
pub struct Support {
    /// What it holds.
    pub at: Place,
    /// The housing it stands on; the ground without.
    pub on: Option<usize>,
    /// Its coefficients.
    pub coefficients: Coefficients,
    /// A seal: it takes no static load.
    pub seal: bool,
}
