//! A land that guides a cage: of the outer race around it, or of the inner race in it.

use crate::contact::{ContactReaction, JournalContact};
use crate::motion::{Body, Motion};
use crate::rotor::GeometricCentre;
use number::{Real, Vec2};

/// Which race has the land.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LandRace {
    /// The cage rides on the inner race.
    Inner,
    /// The cage rides in the outer race.
    Outer,
}

/// A land that guides a cage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Land<R> {
    /// The race that has it.
    pub race: LandRace,
    /// The contact: the cage in the outer race, or the inner race in the cage.
    pub contact: JournalContact<R>,
}

impl<R: Real> Land<R> {
    /// What cage and race do to each other: the cage is the journal, or the bore.
    #[inline(always)]
    pub(super) fn react(&self, cage: &Body<R>, motion: &Motion<R>) -> ContactReaction<R> {
        let centre = |body: &Body<R>| GeometricCentre {
            arm: Vec2::zero(),
            position: body.position,
            velocity: body.velocity,
        };
        match self.race {
            LandRace::Inner => {
                let inner = &motion.inner;
                self.contact.react(&centre(inner), inner.spin, cage)
            }
            LandRace::Outer => {
                let outer = &motion.outer;
                self.contact.react(&centre(cage), cage.spin, outer)
            }
        }
    }
}
