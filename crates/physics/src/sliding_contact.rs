//! What a traction law sees of a contact.

/// A loaded contact of a ball and a race, as its traction sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlidingContact<R> {
    /// u: slip, race surface less ball surface, m/s.
    pub slip: R,
    /// Q: load, N.
    pub load: R,
    /// v: entrainment, mean of both surface speeds seen from the contact, m/s; its sign has no effect.
    pub entrainment: R,
}
