//! Where everything stands in the state of a machine.
//!
//! ```text
//!   rotor        x y (of G), ẋ ẏ, φ, ω
//!   races        of each auxiliary bearing: inner x y, ẋ ẏ, φ_i, ω_i; outer x y, ẋ ẏ
//!   bearings     own states of each
//!   ledger       heats of each bearing; works of the sources, of the rotor first; external angular impulse
//!
//!   probes       of each bearing, then the details of each
//! ```

use super::constants::MachineConstants;
use crate::auxiliary_bearing::{self, BearingAt, lay_races, probe};
use crate::bearing::{self, BearingConstants, DETAIL_PER_BALL};
use crate::system::layout;
use std::ops::Deref;

/// First channel of the rotor.
pub const ROTOR: usize = 0;
/// Channels of the rotor.
pub const ROTOR_CHANNELS: usize = 6;
const ROTOR_NAMES: [&str; ROTOR_CHANNELS] = ["x", "y", "x_speed", "y_speed", "angle", "speed"];

/// Sources of the rotor, before those of the bearings.
pub const ROTOR_SOURCES: [&str; 2] = ["levitation", "rotor_torque"];

/// Gravity that scales speeds where there is less, m/s²: a rotor in a vertical machine still touches.
const LEAST_GRAVITY: f64 = 1.0;

/// The layout of a machine, and where its bearings stand in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    channels: layout::Layout,
    /// Where each auxiliary bearing stands.
    pub bearings: Vec<BearingAt>,
    probes: usize,
    watched_probes: usize,
}

impl Deref for Layout {
    type Target = layout::Layout;
    fn deref(&self) -> &layout::Layout {
        &self.channels
    }
}

impl Layout {
    /// The layout of a machine.
    pub fn of(constants: &MachineConstants) -> Self {
        let parts = &constants.bearings;
        let mut channels = layout::Layout::default();
        channels.block("", ROTOR_NAMES.map(|name| format!("rotor.{name}")));
        let races: Vec<_> = (parts.iter())
            .map(|part| lay_races(&mut channels, &part.name))
            .collect();
        let own: Vec<_> = (parts.iter())
            .map(|part| channels.bearing(&part.name, &part.bearing))
            .collect();
        channels.sources_of("", ROTOR_SOURCES);
        let mut probes = parts.len() * probe::COUNT;
        let mut bearings = Vec::with_capacity(parts.len());
        for (k, part) in parts.iter().enumerate() {
            let kinds = bearing::HEATS
                .into_iter()
                .chain(auxiliary_bearing::OWN_HEATS);
            let balls = part.bearing.balls();
            bearings.push(BearingAt {
                inner: races[k].0,
                outer: races[k].1,
                bearing: own[k].start,
                bearing_states: own[k].len(),
                balls,
                heat: channels.heats_of(&part.name, kinds),
                source: channels.sources_of(&part.name, auxiliary_bearing::SOURCES),
                probe: k * probe::COUNT,
                detail: probes,
            });
            probes += DETAIL_PER_BALL * balls;
        }
        channels.impulses_of("", ["impulse"]);
        // balls that roll find the largest loads in the list of all
        let roll = |part: &auxiliary_bearing::AuxiliaryBearingConstants| {
            matches!(part.bearing, BearingConstants::Rolling(_))
        };
        let watched_probes = match (parts.iter().any(roll), &bearings[..]) {
            (false, _) => parts.len() * probe::COUNT,
            (true, [only]) => only.detail + 2 * only.balls,
            (true, _) => probes,
        };
        Layout {
            channels,
            bearings,
            probes,
            watched_probes,
        }
    }
    /// Number of probes.
    pub fn probes(&self) -> usize {
        self.probes
    }
    /// Number of first probes watched in every step.
    pub fn watched_probes(&self) -> usize {
        self.watched_probes
    }
    /// Number of first channels watched in every step: rotor, races, and the cage of the first bearing.
    pub fn watched_channels(&self) -> usize {
        (self.bearings[0].bearing + 2).min(self.ledger())
    }

    /// The magnitude that matters in each channel: a tolerance of 1e-6 allows errors of one millionth of it a step.
    ///
    /// Lengths by a hundredth of the radial air clearance, speeds by a third of the fall through it, spins by the release speed,
    /// energies by the spin energy of the inner race brought to speed; the bearing's by
    /// [`error_scale`](BearingConstants::error_scale). The rotor by the smallest clearance of its bearings.
    pub fn error_scale(&self, constants: &MachineConstants) -> Vec<f64> {
        let gravity = constants.gravity.length_squared().sqrt().max(LEAST_GRAVITY);
        let spin = constants.speed.abs().max(10.0);
        let mut scale = vec![0.0; self.dimension()];
        let clearances = constants
            .bearings
            .iter()
            .map(|part| part.contact.radial_clearance);
        let smallest = clearances.fold(f64::INFINITY, f64::min);
        let fall = |clearance: f64| (2.0 * gravity * clearance).sqrt();
        let body = |scale: &mut [f64], body: usize, clearance: f64, turns: bool| {
            scale[body..body + 2].fill(0.01 * clearance);
            scale[body + 2..body + 4].fill(0.3 * fall(clearance));
            if turns {
                scale[body + 4] = 1.0;
                scale[body + 5] = spin;
            }
        };
        body(&mut scale, ROTOR, smallest, true);
        let (mut energy, mut impulse) = (f64::INFINITY, f64::INFINITY);
        for (at, part) in self.bearings.iter().zip(&constants.bearings) {
            let clearance = part.contact.radial_clearance;
            let fall_speed = fall(clearance);
            body(&mut scale, at.inner, clearance, true);
            body(&mut scale, at.outer, clearance, false);
            (part.bearing).error_scale(&mut scale[at.own()], spin, fall_speed);
            let inertia = part.inner_race.inertia;
            let turned =
                0.5 * inertia * spin * spin + 0.5 * constants.rotor.mass * fall_speed * fall_speed;
            let heats = self.heat(at.heat)..self.heat(at.heat + auxiliary_bearing::HEATS);
            scale[heats].fill(turned);
            scale[self.source(at.source)..self.source(at.source + 2)].fill(turned);
            energy = energy.min(turned);
            impulse = impulse.min(inertia * spin);
        }
        scale[self.source(0)..self.source(ROTOR_SOURCES.len())].fill(energy);
        scale[self.angular_impulse()] = impulse;
        scale
    }
}
