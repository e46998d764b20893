//! What of a machine follows the temperatures of its bearings while it is computed ball by ball.
//!
//! ```text
//!   temperatures of the network ──► oil and clearance of every bearing
//!   temperature of the contact of rotor and race ──► μ = μ_start f(T)/f(T_start)
//! ```
//! Tracks that close on loaded balls do work on them, which the ledger counts as a source.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::scenario::{AuxiliaryBearing, Drop};
use crate::simulate::bearing::feedback::{FollowedBearing, Renewals, State};
use crate::simulate::coast_down::build::ICE_POINT;
use crate::simulate::drop::build::gravity;
use model::system::machine::RotorMachine;
use model::table::Table;
use thermal::bearing_network::{INNER_RACE, ROTOR};

/// Change of friction that matters, over it.
const RUBS: f64 = 1e-2;

/// The bearings of a machine that follow their temperatures.
#[derive(Debug)]
pub(crate) struct Following {
    parts: Vec<Option<Part>>,
}

#[derive(Debug)]
struct Part {
    followed: Option<FollowedBearing>,
    friction: Option<Friction>,
}

/// Friction over the temperature of its contact, of which the shape counts.
#[derive(Debug)]
struct Friction {
    over_temperature: Table,
    /// Temperature of the contact at the start, K.
    start: f64,
    /// Coefficient there.
    at_start: f64,
}

impl Friction {
    fn of(part: &AuxiliaryBearing) -> Option<Self> {
        let rows = part.contact.friction_over_temperature.iter();
        let table = Table::through(rows.map(|row| (row[0], row[1])).collect()).ok()?;
        Some(Friction {
            over_temperature: table,
            start: part.warm.as_ref()?.heat.start_temperature,
            at_start: part.contact.friction_coefficient,
        })
    }
    /// At a rise of the contact above the start, K.
    fn at(&self, rise: f64) -> f64 {
        let over = |kelvin: f64| self.over_temperature.value(kelvin);
        self.at_start * over(self.start + rise) / over(self.start)
    }
}

/// Coefficient of friction of rotor and race at temperatures of the nodes of their bearing, °C: that of the hotter body, without what the
/// patch that rubs is hotter still.
pub(super) fn friction(part: &AuxiliaryBearing, temperatures: &[f64]) -> f64 {
    Friction::of(part).map_or(part.contact.friction_coefficient, |friction| {
        let hotter = temperatures[ROTOR].max(temperatures[INNER_RACE]);
        friction.at(hotter + ICE_POINT - friction.start)
    })
}

/// What a run knows of the temperatures of a bearing.
#[derive(Clone, Copy)]
pub(crate) struct Now<'a> {
    /// Of the nodes of its network, °C.
    pub nodes: &'a [f64],
    /// Rise of the contact of rotor and race, K.
    pub contact: f64,
    /// Coefficient of friction that acts there.
    pub friction: f64,
}

/// What has followed in a run.
#[derive(Clone, Debug, Default)]
pub(crate) struct Warmed {
    /// Of each bearing: the last clearance and viscosity of its constants, and its least clearance.
    parts: Vec<Option<State>>,
    /// Its machines.
    pub renewals: Renewals<RotorMachine>,
    /// Why it went on without following, and from when on.
    broken: Option<(f64, String)>,
}

impl Following {
    /// What follows in a drop; none where nothing does.
    pub fn of(drop: &Drop) -> Option<Self> {
        let part = |part: &AuxiliaryBearing| {
            let bearing = part.bearing.as_ref()?;
            let followed = FollowedBearing::of(part.warm.as_deref(), bearing, gravity(drop));
            let friction = Friction::of(part);
            let any = followed.is_some() || friction.is_some();
            any.then_some(Part { followed, friction })
        };
        let parts: Vec<_> = drop.auxiliary_bearings.iter().map(part).collect();
        parts
            .iter()
            .any(Option::is_some)
            .then_some(Following { parts })
    }

    /// Whether the friction of a contact has moved enough to go on with another one.
    pub fn rubs<'a>(&self, now: &dyn Fn(usize) -> Option<Now<'a>>) -> bool {
        let moved = |(k, part): (usize, &Option<Part>)| {
            let friction = part.as_ref().and_then(|part| part.friction.as_ref());
            let (Some(friction), Some(now)) = (friction, now(k)) else {
                return false;
            };
            (friction.at(now.contact) / now.friction - 1.0).abs() > RUBS
        };
        self.parts.iter().enumerate().any(moved)
    }

    /// Whether temperatures of the networks have moved enough to go on with other constants.
    pub fn is_due<'a>(&self, warmed: &Warmed, now: &dyn Fn(usize) -> Option<Now<'a>>) -> bool {
        let moved = |(k, part): (usize, &Option<Part>)| {
            let (Some(part), Some(now)) = (part, now(k)) else {
                return false;
            };
            let followed = part.followed.as_ref();
            followed.is_some_and(|followed| followed.moved(warmed.state(k), now.nodes))
        };
        warmed.broken.is_none() && self.parts.iter().enumerate().any(moved)
    }

    /// The machine at these temperatures; none where no law holds there.
    pub fn renewed<'a>(
        &self,
        warmed: &mut Warmed,
        machine: &RotorMachine,
        (time, state): (f64, &[f64]),
        now: &dyn Fn(usize) -> Option<Now<'a>>,
    ) -> Option<Box<RotorMachine>> {
        let mut constants = machine.constants.clone();
        warmed.parts.resize(self.parts.len(), None);
        for (k, part) in self.parts.iter().enumerate() {
            let (Some(part), Some(now)) = (part, now(k)) else {
                continue;
            };
            if let Some(friction) = &part.friction {
                constants.bearings[k].contact.friction = friction.at(now.contact);
            }
            let due = |part: &&FollowedBearing| {
                warmed.broken.is_none() && part.moved(warmed.parts[k], now.nodes)
            };
            let Some(followed) = part.followed.as_ref().filter(due) else {
                continue;
            };
            match followed.renewed(&mut warmed.parts[k], now.nodes, time) {
                Ok(of_bearing) => constants.bearings[k].bearing = of_bearing,
                Err(why) => {
                    warmed.broken = Some((time, why));
                    return None;
                }
            }
        }
        let new = Box::new(RotorMachine::new(constants));
        let done = new.content(state).energy() - machine.content(state).energy();
        warmed.renewals.renew(new.clone(), time, done);
        Some(new)
    }
}

impl Warmed {
    /// As which a bearing was made last; none where nothing has moved.
    pub fn state(&self, bearing: usize) -> Option<State> {
        self.parts.get(bearing).copied().flatten()
    }
    /// Why it went on without following, and from when on, s.
    pub fn broken(&self) -> Option<&(f64, String)> {
        self.broken.as_ref()
    }
}
