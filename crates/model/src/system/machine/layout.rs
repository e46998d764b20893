//! Where everything stands in the state of a machine.
//!
//! ```text
//!   rotor        x of all coordinates (of G), y, ẋ, ẏ; φ, Ω
//!   races        of each auxiliary bearing: inner x y, ẋ ẏ, φ_i, ω_i; outer x y, ẋ ẏ; on a rig see rig::layout
//!   bearings     own states of each, then of each mount
//!   magnets      sensors, controllers, currents, where they act in time
//!   ledger       heats of the rotor, where it has any, and of each bearing; works of the sources, of the rotor first; external
//!                angular impulse; on a rig the works by the moments on the races
//!
//!   probes       of each bearing, on a rig what is measured of it, then the details of each
//! ```

use super::constants::MachineConstants;
use crate::auxiliary_bearing::{
    AuxiliaryBearingConstants, BearingAt, HEATS, OWN_HEATS, SOURCES, lay_races, probe,
};
use crate::bearing::{self, BearingConstants, DETAIL_PER_BALL};
use crate::rotor::RotorAt;
use crate::system::layout;
use crate::system::outer_race::WORKS;
use crate::system::rig::Drive;
use crate::system::rig::fixture::Fixture;
use crate::system::rig::layout::{ARM, ARM_RATE, MEASURED, TEMPERATURE, THERMOCOUPLE};
use std::ops::{Deref, Range};

/// First channel of the rotor.
pub const ROTOR: usize = 0;

/// Sources of any rotor, before those of its magnets and of the bearings. Drive, brake and what holds the spin are one.
pub const ROTOR_SOURCES: [&str; 2] = ["levitation", "rotor_torque"];

/// Of the error scale of a coordinate: it counts as reaching at least so much of what that which reaches most does at the bearings.
const LEAST_REACH: f64 = 0.1;

/// What a rotor has in the ledger where there is such a thing, by its place among heats or sources.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RotorLedger {
    /// Heat of damping that does not rotate.
    pub damping: Option<usize>,
    /// Heat of damping that rotates.
    pub damping_rotating: Option<usize>,
    /// Heat of drag.
    pub drag: Option<usize>,
    /// Work of the magnets.
    pub magnets: Option<usize>,
    /// Work of the stiffness of seals.
    pub seals: Option<usize>,
    /// Work of forces from outside.
    pub forces: Option<usize>,
    /// What unbalances that come on the way bring and take.
    pub unbalance: Option<usize>,
    /// Work of the motion of the base.
    pub base: Option<usize>,
    /// Heat of the damping of seals.
    pub seal_damping: Option<usize>,
}

/// Spin that scales those of a rotor that a drive runs up from less, rad/s.
const RUN_UP_SPIN: f64 = 300.0;

/// Gravity that scales speeds where there is less, m/s²: a rotor in a vertical machine still touches.
const LEAST_GRAVITY: f64 = 1.0;

/// The layout of a machine, and where its bearings stand in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    channels: layout::Layout,
    /// Where the rotor stands.
    pub rotor: RotorAt,
    /// Where it stands in the ledger.
    pub of_rotor: RotorLedger,
    /// Where each auxiliary bearing stands.
    pub bearings: Vec<BearingAt>,
    /// Channels of the controllers of magnets.
    pub magnets: Range<usize>,
    probes: usize,
    watched_probes: usize,
    /// States of the first bearing up to the speed of its cage.
    to_cage: usize,
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
        let own = &constants.rotor;
        let rotor = RotorAt {
            first: ROTOR,
            coordinates: own.coordinates.len(),
            axial: constants.axial.is_some(),
        };
        let fixture = parts[0].fixture.as_deref();
        let clutch = fixture.is_some_and(|own| matches!(own.drive, Drive::Clutch(_)));
        channels.block("", rotor.names(if clutch { "flywheel" } else { "rotor" }));
        let races: Vec<_> = (parts.iter())
            .map(|part| lay_races(&mut channels, part))
            .collect();
        let states: Vec<_> = (parts.iter())
            .map(|part| channels.bearing(&part.name, &part.bearing))
            .collect();
        let mounts: Vec<_> = (parts.iter())
            .map(|part| channels.block(&part.name, part.mount_parts.state_names()))
            .collect();
        let names = constants.magnets.iter().flat_map(|own| own.state_names());
        let magnets = channels.block("levitation", names);
        let mut heat = |there: bool, kind| there.then(|| channels.heats_of("", [kind]));
        let mut of_rotor = RotorLedger {
            damping: heat(!own.damping.is_empty(), "shaft_damping"),
            damping_rotating: heat(!own.damping_rotating.is_empty(), "shaft_damping_rotating"),
            drag: heat(own.drag != 0.0 || own.drag_square != 0.0, "rotor_drag"),
            magnets: None,
            seals: None,
            forces: None,
            base: None,
            unbalance: None,
            seal_damping: heat(!constants.seals.is_empty(), "seal_damping"),
        };
        let sources = rotor_sources(fixture, clutch);
        channels.sources_of("", sources);
        if constants.magnets.is_some() {
            of_rotor.magnets = Some(channels.sources_of("", ["magnets"]));
        }
        if !constants.seals.is_empty() {
            of_rotor.seals = Some(channels.sources_of("", ["seals"]));
        }
        if !(constants.forces.is_empty() && constants.loaded.is_empty()) {
            of_rotor.forces = Some(channels.sources_of("", ["forces"]));
        }
        if constants.base.is_some() {
            of_rotor.base = Some(channels.sources_of("", ["base"]));
        }
        if !constants.unbalances.is_empty() {
            of_rotor.unbalance = Some(channels.sources_of("", ["unbalance"]));
        }
        let measured = fixture.map_or(0, |_| MEASURED);
        let mut probes = parts.len() * probe::COUNT + measured;
        let mut bearings = Vec::with_capacity(parts.len());
        for (k, part) in parts.iter().enumerate() {
            let own: &[_] = match fixture {
                None => &OWN_HEATS,
                Some(_) if clutch => &["clutch", "belt", "support_bearings"],
                Some(_) => &OWN_HEATS[2..],
            };
            let heats = bearing::HEATS.into_iter().chain(own.iter().copied());
            let heat = channels.heats_of(&part.name, heats);
            // of a clutch there is no torque from the ground
            let sources = SOURCES.into_iter().skip(usize::from(clutch));
            let source = channels.sources_of(&part.name, sources);
            let balls = part.bearing.balls();
            bearings.push(BearingAt {
                inner: races[k][0],
                outer: races[k][1],
                driver: rotor.spin(),
                bearing: states[k].start,
                bearing_states: states[k].len(),
                mount: mounts[k].start,
                mount_states: mounts[k].len(),
                balls,
                heat,
                // a rig has all of them
                source: if fixture.is_some() { 0 } else { source },
                probe: k * probe::COUNT,
                detail: probes,
            });
            probes += DETAIL_PER_BALL * balls;
        }
        channels.impulses_of("", ["impulse"]);
        if let Some(fixture) = fixture {
            channels.impulses_of("", fixture.housing.iter().map(|_| "bearing_impulse"));
            channels.works_of("", WORKS);
        }
        // balls that roll, and those in space, find the largest loads in the list of all, a rig their sum
        let looks = |part: &AuxiliaryBearingConstants| {
            fixture.is_some() || !matches!(part.bearing, BearingConstants::Planar(_))
        };
        let watched_probes = match (parts.iter().any(looks), &bearings[..]) {
            (false, _) => parts.len() * probe::COUNT,
            (true, [only]) => {
                let lists = match parts[0].bearing {
                    BearingConstants::Spatial(_) => DETAIL_PER_BALL,
                    _ => 2,
                };
                only.detail + lists * only.balls
            }
            (true, _) => probes,
        };
        Layout {
            channels,
            rotor,
            of_rotor,
            bearings,
            magnets,
            probes,
            watched_probes,
            to_cage: parts[0].bearing.cage_speed_state().unwrap_or(1) + 1,
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
        (self.bearings[0].bearing + self.to_cage).min(self.ledger())
    }

    /// The magnitude that matters in each channel: a tolerance of 1e-6 allows errors of one millionth of it a step.
    ///
    /// Lengths by a hundredth of the radial air clearance, speeds by a third of the fall through it, spins by the release speed,
    /// energies by the spin energy of the inner race brought to speed; the bearing's by
    /// [`error_scale`](BearingConstants::error_scale). The rotor by the smallest clearance of its bearings; its coordinates by what
    /// they make of it at these, those that swing quickly by their speed over their frequency.
    pub fn error_scale(&self, constants: &MachineConstants) -> Vec<f64> {
        if let Some(fixture) = &constants.bearings[0].fixture {
            return self.error_scale_on_rig(constants, fixture);
        }
        let along = constants.axial.map_or(0.0, |axial| axial.gravity);
        let gravity = (constants.gravity.length_squared() + along * along).sqrt();
        let gravity = gravity.max(LEAST_GRAVITY);
        let spin = constants.speed.abs().max(match constants.rotor.driven() {
            true => RUN_UP_SPIN,
            false => 10.0,
        });
        let mut scale = vec![0.0; self.dimension()];
        let clearances = constants
            .bearings
            .iter()
            .map(|part| part.contact.radial_clearance);
        let smallest = clearances.fold(f64::INFINITY, f64::min);
        let fall = |clearance: f64| (2.0 * gravity * clearance).sqrt();
        let rotor = self.rotor;
        for (k, reach) in reaches(constants).into_iter().enumerate() {
            let speed = 0.3 * fall(smallest);
            // of a quick coordinate, what its spring holds: as much as its speed
            let frequency = constants.rotor.coordinates[k].frequency;
            let length = (0.01 * smallest).min(speed / frequency);
            for block in 0..2 {
                scale[rotor.block(block).start + k] = length / reach;
                scale[rotor.block(block + 2).start + k] = speed / reach;
            }
        }
        scale[rotor.angle()] = 1.0;
        scale[rotor.spin()] = spin;
        if rotor.axial {
            scale[rotor.place()] = 0.01 * smallest;
            scale[rotor.place() + 1] = 0.3 * fall(smallest);
        }
        if let Some(magnets) = &constants.magnets {
            magnets.error_scale(&mut scale[self.magnets.clone()], 0.01 * smallest);
        }
        let mass = constants.rotor.mass();
        let (mut energy, mut impulse) = (f64::INFINITY, f64::INFINITY);
        for (at, part) in self.bearings.iter().zip(&constants.bearings) {
            let clearance = part.contact.radial_clearance;
            let fall_speed = fall(clearance);
            for race in [at.outer, at.inner] {
                race.error_scale(&mut scale, 0.01 * clearance, 0.3 * fall_speed, spin);
            }
            (part.bearing).error_scale(&mut scale[at.own()], spin, fall_speed);
            let of_mount = &mut scale[at.of_mount()];
            (part.mount_parts).error_scale(of_mount, 0.01 * clearance, 0.3 * fall_speed);
            let inertia = part.inner_race.inertia;
            let of_row = mass / part.planes;
            let turned = 0.5 * inertia * spin * spin + 0.5 * of_row * fall_speed * fall_speed;
            let heats = self.heat(at.heat)..self.heat(at.heat + HEATS);
            scale[heats].fill(turned);
            scale[self.source(at.source)..self.source(at.source + 2)].fill(turned);
            energy = energy.min(turned * part.planes);
            impulse = impulse.min(inertia * spin * part.planes);
        }
        scale[self.source(0)..self.source(ROTOR_SOURCES.len())].fill(energy);
        let own = self.of_rotor;
        let heats = [
            own.damping,
            own.damping_rotating,
            own.drag,
            own.seal_damping,
        ];
        for heat in heats.into_iter().flatten() {
            scale[self.heat(heat)] = energy;
        }
        let sources = [own.magnets, own.seals, own.forces, own.base, own.unbalance];
        for source in sources.into_iter().flatten() {
            scale[self.source(source)] = energy;
        }
        scale[self.angular_impulse()] = impulse;
        scale
    }

    /// The same on a rig: places of centres and balls by a ten-thousandth of the ball, speeds of centres by a thousandth of the speed
    /// of the ball centres, spins by the speed that counts as reached, energies by the spin energy of the race at that speed, the arm by
    /// a moment of 0.1 N m, temperatures by 1 K.
    fn error_scale_on_rig(&self, constants: &MachineConstants, fixture: &Fixture) -> Vec<f64> {
        const MOMENT: f64 = 0.1;
        let (at, part) = (&self.bearings[0], &constants.bearings[0]);
        let spin = constants.speed.abs().max(1.0);
        let set = part.bearing.set();
        let centre_speed = 1e-3 * spin * part.bearing.pitch_radius();
        let inertia = part.inner_race.inertia + set.inner_inertia();
        let length = 1e-4 * set.inner_track_radius * set.ball_ratio;
        let mut scale = vec![0.0; self.dimension()];
        scale[self.rotor.angle()] = 1.0;
        scale[self.rotor.spin()] = spin;
        for body in [at.inner, at.outer] {
            body.error_scale(&mut scale, length, centre_speed, spin);
        }
        if let Some(housing) = &fixture.housing {
            scale[ARM] = MOMENT;
            scale[ARM_RATE] = MOMENT * housing.arm.natural_frequency;
            scale[TEMPERATURE..=THERMOCOUPLE].fill(1.0);
        }
        (part.bearing).error_scale(&mut scale[at.own()], spin, centre_speed);
        scale[self.ledger()..].fill(0.5 * inertia * spin * spin);
        scale[self.angular_impulse()..self.work(0)].fill(inertia * spin);
        scale
    }
}

/// Sources before those of the bearings, magnets and seals: those of a rotor, or on a rig with the radial load.
fn rotor_sources(fixture: Option<&Fixture>, clutch: bool) -> [&'static str; 2] {
    let load = match fixture {
        None => return ROTOR_SOURCES,
        Some(Fixture {
            housing: Some(_), ..
        }) => "weight",
        Some(_) => "radial_load",
    };
    match clutch {
        true => ["motor", load],
        false => [load, ROTOR_SOURCES[1]],
    }
}

/// What a unit of each coordinate moves the rotor by at that bearing where it moves it most.
fn reaches(constants: &MachineConstants) -> Vec<f64> {
    let at = |k: usize| {
        let parts = constants.bearings.iter();
        let rows = parts.flat_map(|part| [Some(&part.node), part.mount_parts.on.as_ref()]);
        let shapes = rows.flatten().map(|row| row[k].abs());
        shapes.fold(0.0, f64::max)
    };
    let reaches: Vec<f64> = (0..constants.rotor.coordinates.len()).map(at).collect();
    let most = reaches.iter().copied().fold(0.0, f64::max);
    reaches
        .into_iter()
        .map(|reach| reach.max(LEAST_REACH * most))
        .collect()
}
