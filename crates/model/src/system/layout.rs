//! Where everything stands in the state of a system, and among its probes.
//!
//! ```text
//!   bodies    each system's own
//!   bearing   its own states
//!   ledger    heats, works of the sources, external angular impulses, works by the moments on the races
//!
//!   probes    each system's own, then the bearing's detail
//! ```

use crate::bearing::{self, BearingConstants, DETAIL_PER_BALL};
use std::marker::PhantomData;
use std::ops::Range;

/// What a system has besides the states of its bearing: names in the order of their channels.
pub trait Channels: Copy {
    /// Channels of the bodies.
    const BODIES: &'static [&'static str];
    /// Kinds of heat: those of the bearing, then the system's own. Names as in results.
    const HEATS: &'static [&'static str];
    /// Kinds of source.
    const SOURCES: &'static [&'static str];
    /// External angular impulses: that of the system first.
    const IMPULSES: &'static [&'static str] = &["impulse"];
    /// Works by the moments on the races; none where they are not kept.
    const WORKS: &'static [&'static str] = &[];
    /// Number of probes before the detail.
    const PROBES: usize;
}

/// The kinds of heat of a bearing, then a system's own: `ALL` of them.
pub const fn heats_and<const OWN: usize, const ALL: usize>(
    own: [&'static str; OWN],
) -> [&'static str; ALL] {
    let of_bearing = bearing::HEATS.len();
    assert!(ALL == of_bearing + OWN);
    let mut all = [""; ALL];
    let mut i = 0;
    while i < ALL {
        all[i] = if i < of_bearing {
            bearing::HEATS[i]
        } else {
            own[i - of_bearing]
        };
        i += 1;
    }
    all
}

/// Sizes of the state of a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout<S> {
    /// Number of balls.
    pub balls: usize,
    /// Number of the bearing's own states.
    pub bearing_states: usize,
    /// True where the balls have states of their own.
    pub ball_states: bool,
    system: PhantomData<S>,
}

impl<S: Channels> Layout<S> {
    /// Channels of the ledger.
    pub const LEDGER: usize =
        S::HEATS.len() + S::SOURCES.len() + S::IMPULSES.len() + S::WORKS.len();

    /// The layout of a system with a bearing.
    pub fn of(bearing: &BearingConstants) -> Self {
        Layout {
            balls: bearing.balls(),
            bearing_states: bearing.states(),
            ball_states: matches!(bearing, BearingConstants::Planar(_)),
            system: PhantomData,
        }
    }
    /// Channels of the bearing.
    #[inline(always)]
    pub fn bearing(&self) -> Range<usize> {
        S::BODIES.len()..self.ledger()
    }
    /// First channel of the ledger.
    #[inline(always)]
    pub fn ledger(&self) -> usize {
        S::BODIES.len() + self.bearing_states
    }
    /// Number of channels.
    #[inline(always)]
    pub fn dimension(&self) -> usize {
        self.ledger() + Self::LEDGER
    }
    /// Number of probes.
    pub fn probes(&self) -> usize {
        S::PROBES + DETAIL_PER_BALL * self.balls
    }
    /// Number of probes down to the loads of the balls.
    pub fn probes_with_loads(&self) -> usize {
        S::PROBES + 2 * self.balls
    }
    /// Channel of a heat by its place among the system's.
    #[inline(always)]
    pub fn heat(&self, index: usize) -> usize {
        self.ledger() + index
    }
    /// What a kind of heat has summed up in a state, J, or its rate, W; none where the system knows no such kind.
    pub fn heat_of(&self, state: &[f64], kind: &str) -> Option<f64> {
        let index = S::HEATS.iter().position(|heat| *heat == kind)?;
        Some(state[self.heat(index)])
    }
    /// Channel of the work of a source by its place among the system's.
    #[inline(always)]
    pub fn source(&self, index: usize) -> usize {
        self.heat(S::HEATS.len()) + index
    }
    /// Channel of the external angular impulse of the system.
    #[inline(always)]
    pub fn angular_impulse(&self) -> usize {
        self.source(S::SOURCES.len())
    }
    /// Channels of the heats, of the works of the sources, and of the external angular impulse of the system.
    pub fn flows(&self) -> Range<usize> {
        self.heat(0)..self.angular_impulse() + 1
    }
    /// Channel of a work by the moments on the races, by its place among the system's.
    #[inline(always)]
    pub fn work(&self, index: usize) -> usize {
        self.angular_impulse() + S::IMPULSES.len() + index
    }

    /// Name of a channel.
    pub fn channel_name(&self, bearing: &BearingConstants, channel: usize) -> String {
        match channel {
            c if c < S::BODIES.len() => S::BODIES[c].to_string(),
            c if c < self.ledger() => {
                format!("bearing.{}", bearing.state_name(c - S::BODIES.len()))
            }
            c if c < self.source(0) => format!("energy.heat.{}", S::HEATS[c - self.heat(0)]),
            c if c < self.angular_impulse() => {
                format!("energy.source.{}", S::SOURCES[c - self.source(0)])
            }
            c if c < self.work(0) => {
                let impulse = S::IMPULSES[c - self.angular_impulse()];
                format!("angular_momentum.{impulse}")
            }
            c => format!("energy.work.{}", S::WORKS[c - self.work(0)]),
        }
    }
}
