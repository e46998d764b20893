//! Where a sampled signal changes sides.

/// A change of sides.
pub(super) struct Flip {
    /// First sample beyond the hysteresis on the new side.
    pub sample: usize,
    pub rises: bool,
}
