//! A friction moment in its two parts.

use number::Real;

/// A steady friction moment in its two parts, N m, each with the sign of the speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentParts<R> {
    /// Made by the flow of the lubricant: churning, inlet of the contacts.
    pub speed_dependent: R,
    /// Made by what slides: contacts, seals.
    pub load_dependent: R,
}

impl<R: Real> MomentParts<R> {
    /// The whole moment M, N m.
    ///
    /// Source: sum of the parts.
    /// Valid: always.
    #[inline(always)]
    pub fn sum(self) -> R {
        self.speed_dependent + self.load_dependent
    }

    /// The parts where the lubricant is not in the state of the law.
    ///
    /// Formula: D M0 + M1
    ///
    /// - `drag_factor`: D, not negative
    ///
    /// Source: [`lubricant_state`](crate::lubricant_state).
    /// Valid: as the law and the factor; a law that does not separate its parts is multiplied as a whole.
    #[inline(always)]
    #[must_use]
    pub fn with_drag(self, drag_factor: R) -> Self {
        MomentParts {
            speed_dependent: self.speed_dependent * drag_factor,
            ..self
        }
    }
}
