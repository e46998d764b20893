//! What of a machine follows the temperatures of its bearings while it is computed ball by ball.
//!
//! ```text
//!   temperatures of the network ──► oil and clearance of every bearing
//!   temperature of the contact of rotor and race ──► μ = μ_start f(T)/f(T_start)
//!   temperatures of rotor and race ──► c0 = c0_start + α R₀ ΔT_race − α (R₀ − c0) ΔT_rotor
//! ```
//! Tracks that close on loaded balls do work on them, which the ledger counts as a source.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::bearing::feedback::{FollowedBearing, Renewals, State};
use crate::coast_down::build::ICE_POINT;
use crate::drop::Drop;
use crate::drop::build::gravity;
use model::system::machine::RotorMachine;
use model::table::Table;
use number::Vec2;
use scenario::heat::{RotorBodies, STEEL_EXPANSION};
use scenario::{AuxiliaryBearing, Bearing, Feedback, Warm};
use thermal::bearing_network::{INNER_RACE, ROTOR, ROTOR_CORE};

/// Change of an air clearance that matters, m: less than the roughness of ground surfaces.
const OPENS: f64 = 1e-7;
/// Change of friction that matters, over it.
const RUBS: f64 = 1e-2;

/// What the air clearance of a rotor in its race gains as both warm.
#[derive(Debug)]
pub(crate) struct AirClearance {
    /// Radius of the bore, and of the rotor in it, m.
    radii: [f64; 2],
    /// At the start, °C.
    start: f64,
    /// Node of the rotor whose mean it grows with.
    rotor: usize,
}

impl AirClearance {
    /// None where no clearance follows the temperatures.
    pub fn of(part: &AuxiliaryBearing) -> Option<Self> {
        let heat = &part.warm.as_ref()?.heat;
        let bore = 0.5 * part.contact.bore_diameter;
        (heat.feedback == Feedback::Full).then_some(AirClearance {
            radii: [bore, bore - part.contact.radial_air_clearance],
            start: heat.start_temperature - ICE_POINT,
            rotor: match heat.rotor_bodies {
                RotorBodies::One => ROTOR,
                RotorBodies::LayerAndCore => ROTOR_CORE,
            },
        })
    }
    /// At temperatures of the nodes of the bearing, °C: m.
    pub fn gained(&self, temperatures: &[f64]) -> f64 {
        let [bore, rotor] = self.radii;
        let [race, inside] = [INNER_RACE, self.rotor].map(|node| temperatures[node] - self.start);
        STEEL_EXPANSION * (bore * race - rotor * inside)
    }
}

/// The bearings of a machine that follow their temperatures.
#[derive(Debug)]
pub(crate) struct Following {
    parts: Vec<Option<Part>>,
}

#[derive(Debug)]
struct Part {
    followed: Option<FollowedBearing>,
    friction: Option<Friction>,
    air: Option<AirClearance>,
}

impl Part {
    /// What its air clearance has gained at temperatures of its nodes, °C, where that has moved from what it was last, m.
    fn opened(&self, last: Option<&f64>, nodes: &[f64]) -> Option<f64> {
        let gained = self.air.as_ref()?.gained(nodes);
        let moved = gained - last.copied().unwrap_or(0.0);
        (moved.abs() > OPENS).then_some(gained)
    }
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

/// Coefficient of friction of rotor and race at temperatures of the nodes of their bearing, °C, and at the rise of their patch above the start, K,
/// where that is known: at the hotter body's else.
pub(crate) fn friction(part: &AuxiliaryBearing, temperatures: &[f64], patch: Option<f64>) -> f64 {
    Friction::of(part).map_or(part.contact.friction_coefficient, |friction| {
        let hotter = temperatures[ROTOR].max(temperatures[INNER_RACE]);
        friction.at(patch.unwrap_or(hotter + ICE_POINT - friction.start))
    })
}

/// What a run knows of the temperatures of a bearing.
#[derive(Clone, Copy)]
pub(crate) struct Now<'a> {
    /// Of the nodes of its network, °C.
    pub nodes: &'a [f64],
    /// Speed of its inner race, rad/s.
    pub spin: f64,
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
    /// What the air clearance of each has gained, m.
    air: Vec<f64>,
    /// Its machines.
    pub renewals: Renewals,
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
            let air = AirClearance::of(part);
            let any = followed.is_some() || friction.is_some() || air.is_some();
            any.then_some(Part {
                followed,
                friction,
                air,
            })
        };
        let parts: Vec<_> = drop.auxiliary_bearings.iter().map(part).collect();
        parts
            .iter()
            .any(Option::is_some)
            .then_some(Following { parts })
    }

    /// What follows of a bearing on a rig; none where nothing does.
    pub fn on_rig(warm: Option<&Warm>, bearing: &Bearing) -> Option<Self> {
        let part = Part {
            followed: Some(FollowedBearing::of(warm, bearing, Vec2::zero())?),
            friction: None,
            air: None,
        };
        Some(Following {
            parts: vec![Some(part)],
        })
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
            part.opened(warmed.air.get(k), now.nodes).is_some()
                || followed.is_some_and(|own| own.moved(warmed.state(k), now.nodes, now.spin))
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
        warmed.air.resize(self.parts.len(), 0.0);
        for (k, part) in self.parts.iter().enumerate() {
            let (Some(part), Some(now)) = (part, now(k)) else {
                continue;
            };
            if let Some(gained) = part.opened(warmed.air.get(k), now.nodes) {
                let clearance = &mut constants.bearings[k].contact.radial_clearance;
                *clearance += gained - warmed.air[k];
                warmed.air[k] = gained;
                if *clearance <= 0.0 {
                    warmed.broken = Some((time, "the rotor fills its air clearance".to_string()));
                    return None;
                }
            }
            if let Some(friction) = &part.friction {
                constants.bearings[k].contact.friction = friction.at(now.contact);
            }
            let due = |part: &&FollowedBearing| {
                warmed.broken.is_none() && part.moved(warmed.parts[k], now.nodes, now.spin)
            };
            let Some(followed) = part.followed.as_ref().filter(due) else {
                continue;
            };
            let as_now = &machine.constants.bearings[k].bearing;
            match followed.renewed(&mut warmed.parts[k], (now.nodes, now.spin), time, as_now) {
                Ok(of_bearing) => constants.bearings[k].bearing = of_bearing,
                Err(why) => {
                    warmed.broken = Some((time, why));
                    return None;
                }
            }
        }
        if let Err(why) = constants.check_on_rig() {
            warmed.broken = Some((time, why.to_string()));
            return None;
        }
        let new = Box::new(machine.renewed(constants));
        let done = new.content(state).energy() - machine.content(state).energy();
        warmed.renewals.book(time, done);
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
