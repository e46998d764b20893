//! How warm the bearing of a spin-up becomes, and what of it follows.

use crate::problem::Problem;
use crate::scenario::SpinUp;
use crate::simulate::bearing::feedback::{FollowedBearing, Renewals, State};
use crate::simulate::bearing::networks;
use crate::simulate::bearing::warm::Followed;
use model::bearing;
use model::bearing_heat::{Seen, WarmBearing, Warmth};
use model::heats::{HEATS, OWN_HEATS};
use model::system::spin_up::SpinUpMachine;
use model::system::spin_up::layout::INNER;
use number::Vec2;
use solve::Step;

/// The network of a spin-up while it runs.
pub(crate) struct Warming<'a> {
    spin_up: &'a SpinUp,
    part: &'a WarmBearing,
    warmth: Warmth,
    followed: Option<FollowedBearing>,
    state: Option<State>,
    /// The machines that it has been.
    pub renewals: Renewals<SpinUpMachine>,
    broken: Option<(f64, String)>,
}

/// The network of the bearing; none where its temperatures are not followed.
pub(crate) fn network(spin_up: &SpinUp) -> Result<Option<Box<WarmBearing>>, Box<Problem>> {
    networks::built(spin_up.warm.as_deref(), &spin_up.bearing)
}

impl<'a> Warming<'a> {
    pub fn of(spin_up: &'a SpinUp, part: Option<&'a WarmBearing>) -> Option<Self> {
        let part = part?;
        Some(Warming {
            spin_up,
            part,
            warmth: Warmth::new(part, true),
            followed: FollowedBearing::of(spin_up.warm.as_deref(), &spin_up.bearing, Vec2::zero()),
            state: None,
            renewals: Renewals::default(),
            broken: None,
        })
    }

    /// Takes a step; whether the machine is to go on with other constants.
    pub fn step(&mut self, step: &Step<SpinUpMachine>) -> bool {
        if !self.warmth.is_due(step.end) {
            return false;
        }
        self.take(step.machine, step.end, &|channel| step.end_state(channel));
        let moved =
            |followed: &FollowedBearing| followed.moved(self.state, &self.warmth.temperatures);
        self.broken.is_none() && self.followed.as_ref().is_some_and(moved)
    }

    /// Lets the network take the heat until a time.
    pub fn take(&mut self, machine: &SpinUpMachine, time: f64, state: &dyn Fn(usize) -> f64) {
        let first = machine.layout().flows().start;
        let mut heats = [0.0; HEATS];
        for (k, heat) in heats.iter_mut().enumerate() {
            *heat = match k {
                k if k < bearing::HEATS.len() => state(first + k),
                // the last of both is the friction of rotor and race
                k if k == bearing::HEATS.len() + OWN_HEATS.len() - 1 => {
                    state(first + bearing::HEATS.len())
                }
                _ => 0.0,
            };
        }
        let seen = Seen {
            time,
            heats,
            spin: state(INNER + 5),
            taken: None,
        };
        self.warmth.take(self.part, &seen);
    }

    /// The machine at these temperatures; none where no law holds there.
    pub fn renewed(
        &mut self,
        machine: &SpinUpMachine,
        time: f64,
        state: &[f64],
    ) -> Option<Box<SpinUpMachine>> {
        let followed = self.followed.as_ref()?;
        let mut constants = machine.constants.clone();
        let new = followed
            .renewed(&mut self.state, &self.warmth.temperatures, time)
            .and_then(|bearing| {
                constants.bearing = bearing;
                SpinUpMachine::new(constants).map_err(|why| why.to_string())
            });
        match new {
            Ok(new) => {
                let new = Box::new(new);
                let done = new.content(state).energy() - machine.content(state).energy();
                self.renewals.renew(new.clone(), time, done);
                Some(new)
            }
            Err(why) => {
                self.broken = Some((time, why));
                None
            }
        }
    }

    /// What has become of it.
    pub fn followed(&'a self) -> Option<Followed<'a>> {
        Some(Followed {
            given: self.spin_up.warm.as_deref()?,
            bearing: &self.spin_up.bearing,
            part: self.part,
            warmth: &self.warmth,
            state: self.state,
            broken: self.broken.as_ref(),
        })
    }
}
