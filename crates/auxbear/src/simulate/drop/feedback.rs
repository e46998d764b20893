//! What of a bearing follows its temperatures while it is computed ball by ball: oil and clearance.
//!
//! ```text
//!   temperatures of the network ──► ν(T_lubricant), P_d(T_inner, T_balls, T_outer) ──► the constants of the bearing
//!   temperature of the contact of rotor and race ──► μ = μ_start f(T)/f(T_start)
//! ```
//! The network takes heat in spans; after each of them the machine goes on with the constants of its temperatures, where these
//! have moved enough to matter. Tracks that close on loaded balls do work on them, which the ledger counts as a source.
//!
//! M1 of balls that their rings preload is that of the radial load which presses them as hard, as in a run-out.
//!
//! Source: heat-and-life, section 5. Assumes: rings at one temperature each; rings and balls free to grow.

use crate::scenario::{AuxiliaryBearing, Bearing, Drop, Feedback, Moment, Traction};
use crate::simulate::bearing::build::bearing as constants_of;
use crate::simulate::bearing::contacts::{BallContacts, ball_contacts};
use crate::simulate::coast_down::build::{ICE_POINT, network, unpreloaded};
use crate::simulate::drop::build::gravity;
use model::system::machine::RotorMachine;
use model::table::Table;
use number::Vec2;
use physics::viscosity::{Viscosity, WaltherLine};
use thermal::bearing_network::{BALLS, INNER_RACE, LUBRICANT, OUTER_RACE};
use thermal::load_zone::LoadZone;

/// Least viscosity, m²/s.
const LEAST_VISCOSITY: f64 = 2e-6;
/// Temperatures that the traction of oil films is known at, °C.
const FILMS: (f64, f64) = (30.0, 100.0);
/// Changes that matter: of the clearance, m; of viscosity and friction over them.
const CLOSES: f64 = 20e-9;
const THINS: f64 = 2e-3;
const RUBS: f64 = 1e-2;

/// What of a bearing follows.
#[derive(Clone, Debug)]
pub(crate) struct Follows {
    feedback: Feedback,
    oil: Option<WaltherLine<f64>>,
    zone: LoadZone,
    /// ΣQ under the weight without preload, N.
    unpreloaded: f64,
    /// At the start, °C.
    start: f64,
}

impl Follows {
    /// What follows by these temperatures; none where nothing does.
    pub fn of(part: &AuxiliaryBearing) -> Option<Self> {
        let (warm, bearing) = (part.warm.as_deref()?, part.bearing.as_ref()?);
        let oil = match warm.viscosity_points.as_slice() {
            [one, other] => Viscosity::through((one[0], one[1]), (other[0], other[1])).ok(),
            _ => None,
        };
        let zone = network(warm).ok()?.1;
        let follows = Follows {
            feedback: warm.heat.feedback,
            oil: oil.map(|oil| oil.line()),
            unpreloaded: unpreloaded(&zone),
            zone,
            start: warm.heat.start_temperature - ICE_POINT,
        };
        (follows.thins(bearing) || follows.closes(bearing)).then_some(follows)
    }

    /// Whether anything of it depends on the temperature of its lubricant.
    pub fn thins(&self, bearing: &Bearing) -> bool {
        let by_moment = matches!(bearing.moment, Moment::Palmgren { .. } | Moment::Skf { .. });
        self.feedback != Feedback::None
            && (by_moment && self.oil.is_some()
                || matches!(bearing.traction, Traction::Lubricant(_)))
    }

    /// Whether its clearance follows: at an angle a preload is held by springs or by distances that are not given.
    pub fn closes(&self, bearing: &Bearing) -> bool {
        self.feedback == Feedback::Full && bearing.contact_angle == 0.0
    }

    /// Diametral clearance at these temperatures (°C), m.
    pub fn clearance(&self, temperatures: &[f64]) -> f64 {
        self.zone.clearance_at(temperatures)
    }

    /// Viscosity of the lubricant at these temperatures (°C), m²/s; 1 where none is known.
    pub fn viscosity(&self, temperatures: &[f64]) -> f64 {
        let kelvin = temperatures[LUBRICANT] + ICE_POINT;
        let of = |oil: &WaltherLine<f64>| oil.viscosity(kelvin).max(LEAST_VISCOSITY);
        self.oil.as_ref().map_or(1.0, of)
    }

    /// Makes a bearing one of these temperatures, °C.
    pub fn condition(&self, bearing: &mut Bearing, temperatures: &[f64]) {
        if self.thins(bearing) {
            let warmer = self.viscosity(temperatures);
            if let (Moment::Palmgren { viscosity, .. } | Moment::Skf { viscosity, .. }, Some(_)) =
                (&mut bearing.moment, &self.oil)
            {
                *viscosity = warmer;
            }
            if let Traction::Lubricant(film) = &mut bearing.traction {
                let races = 0.5 * (temperatures[INNER_RACE] + temperatures[OUTER_RACE]);
                let rise = 0.5 * (temperatures[BALLS] + races) - self.start;
                let [least, most] = [FILMS.0, FILMS.1].map(|limit| limit + ICE_POINT);
                let warm = film.temperature + rise;
                film.temperature =
                    warm.clamp(least.min(film.temperature), most.max(film.temperature));
            }
        }
        if self.closes(bearing) {
            let clearance = self.clearance(temperatures);
            bearing.operating_diametral_clearance = clearance;
            if let Moment::Palmgren {
                f1_factor,
                f1_exponent,
                ..
            } = &mut bearing.moment
            {
                // P = W ΣQ/ΣQ_0 in M1 = z (P/C0)^y P d_m
                let pressed: f64 = self.zone.loads(clearance).iter().sum();
                *f1_factor *= (pressed / self.unpreloaded).powf(1.0 + *f1_exponent);
            }
        }
    }
}

/// The bearings of a machine that follow their temperatures.
#[derive(Debug)]
pub(crate) struct Following {
    parts: Vec<Option<Part>>,
    gravity: Vec2<f64>,
}

#[derive(Debug)]
struct Part {
    /// What of the bearing follows.
    follows: Option<Follows>,
    bearing: Bearing,
    contacts: BallContacts,
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
    /// Work of tracks that close on loaded balls: instants, and what was done until then, J.
    work: Vec<(f64, f64)>,
    /// The machine at the end, where it is another than at the start.
    machine: Option<Box<RotorMachine>>,
    /// Why it went on without following, and from when on.
    broken: Option<(f64, String)>,
}

#[derive(Clone, Copy, Debug)]
struct State {
    clearance: f64,
    viscosity: f64,
    least: f64,
    closed: Option<f64>,
}

impl Following {
    /// What follows in a drop; none where nothing does.
    pub fn of(drop: &Drop) -> Option<Self> {
        let part = |part: &AuxiliaryBearing| {
            let bearing = part.bearing.as_ref()?;
            let (follows, friction) = (Follows::of(part), Friction::of(part));
            let any = follows.is_some() || friction.is_some();
            any.then_some(Part {
                follows,
                friction,
                bearing: bearing.clone(),
                contacts: ball_contacts(bearing).ok()?,
            })
        };
        let parts: Vec<_> = drop.auxiliary_bearings.iter().map(part).collect();
        parts.iter().any(Option::is_some).then(|| Following {
            parts,
            gravity: gravity(drop),
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
            part.moved(warmed.state(k), now.nodes)
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
            let Some(follows) = (part.follows.as_ref())
                .filter(|_| warmed.broken.is_none() && part.moved(warmed.state(k), now.nodes))
            else {
                continue;
            };
            let mut bearing = part.bearing.clone();
            follows.condition(&mut bearing, now.nodes);
            match constants_of(&bearing, &part.contacts, self.gravity) {
                Ok(of_bearing) => constants.bearings[k].bearing = of_bearing,
                Err(problem) => {
                    warmed.broken = Some((time, problem.found));
                    return None;
                }
            }
            let clearance = follows.clearance(now.nodes);
            let before = warmed.state(k);
            let closed = before.and_then(|before| before.closed);
            let closes = clearance < 0.0 && part.bearing.operating_diametral_clearance >= 0.0;
            let least = before.map_or(f64::INFINITY, |before| before.least);
            warmed.parts[k] = Some(State {
                clearance,
                viscosity: follows.viscosity(now.nodes),
                least: least.min(clearance),
                closed: closed.or_else(|| closes.then_some(time)),
            });
        }
        let new = Box::new(RotorMachine::new(constants));
        let done = new.content(state).energy() - machine.content(state).energy();
        let before = warmed.work.last().map_or(0.0, |(_, work)| *work);
        if done != 0.0 {
            warmed.work.push((time, before + done));
        }
        warmed.machine = Some(new.clone());
        Some(new)
    }
}

impl Part {
    /// Whether the bearing is another one at these temperatures of its nodes than it was in this state.
    fn moved(&self, last: Option<State>, nodes: &[f64]) -> bool {
        let Some(follows) = &self.follows else {
            return false;
        };
        let Some(last) = last else {
            return true;
        };
        let closes = (follows.clearance(nodes) - last.clearance).abs() > CLOSES;
        let thins = (follows.viscosity(nodes) / last.viscosity - 1.0).abs() > THINS;
        closes && follows.closes(&self.bearing) || thins && follows.thins(&self.bearing)
    }
}

impl Warmed {
    fn state(&self, bearing: usize) -> Option<State> {
        self.parts.get(bearing).copied().flatten()
    }
    /// Work of tracks that close on loaded balls until an instant, J.
    pub fn work_until(&self, time: f64) -> f64 {
        let past = self.work.partition_point(|(at, _)| *at < time);
        past.checked_sub(1).map_or(0.0, |last| self.work[last].1)
    }
    /// The machine at the end, where it is another than this one at the start.
    pub fn machine<'a>(&'a self, at_start: &'a RotorMachine) -> &'a RotorMachine {
        self.machine.as_deref().unwrap_or(at_start)
    }
    /// Least diametral clearance of a bearing, m, and when it closed, s; none where nothing has moved.
    pub fn closing(&self, bearing: usize) -> Option<(f64, Option<f64>)> {
        let state = self.state(bearing)?;
        Some((state.least, state.closed))
    }
    /// Why it went on without following, and from when on, s.
    pub fn broken(&self) -> Option<&(f64, String)> {
        self.broken.as_ref()
    }
}
