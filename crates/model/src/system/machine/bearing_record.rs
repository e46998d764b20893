//! What is watched and kept of one auxiliary bearing of a machine.
//!
//! Contacts begin, end and peak on dense output, not on the steps; largest forces between steps where they may peak there. Only
//! the list of contacts may grow during a run.

mod contact;
mod mount;

use super::RotorMachine;
use super::travel::Travel;
use crate::auxiliary_bearing::BearingAt;
use crate::auxiliary_bearing::probe::{
    AXIAL_FORCE, AXIAL_FRICTION, AXIAL_PENETRATION, BEARING_LOAD, LAND_FORCE, LARGEST_INNER_LOAD,
    LARGEST_OUTER_LOAD, LARGEST_POCKET_FORCE, LARGEST_SKIDS, MOUNT_FORCE, NORMAL_FORCE,
    PENETRATION, SLIP_SPEED,
};
use crate::bearing_heat::{HeatInstant, Warmth};
use crate::contact::ContactReaction;
use crate::heats::HEATS;
use crate::spatial::record::SpatialRecord;
use crate::surface_heat::{ContactStep, Motions, SurfaceHeat};
use crate::system::race_record::{BearingInstant, RaceRecord};
use crate::system::rig::Drive;
use crate::system::rig::layout::DRIVE_HEAT;
use crate::system::sampling::{Growth, Peak, Rise, Turns};
use number::Vec2;
use solve::Step;
use std::f64::consts::PI;
use thermal::bearing_network::INNER_RACE;

pub use contact::Contact;
pub use mount::MountPeaks;

/// Everything kept of one auxiliary bearing.
#[derive(Clone, Debug)]
pub struct BearingRecord {
    at: BearingAt,
    bearing: usize,
    /// Contacts in order.
    pub contacts: Vec<Contact>,
    /// Largest ball load at the inner race, N.
    pub largest_inner_load: Peak,
    /// Largest ball load at the outer race, N.
    pub largest_outer_load: Peak,
    /// Largest force between a ball and its pocket, or between two balls without a cage, N.
    pub largest_pocket_force: Peak,
    /// Largest force between cage and land, N.
    pub largest_land_force: Peak,
    /// Largest load on the bearing as a whole, N.
    pub largest_bearing_load: Peak,
    /// Largest force on the mount, N.
    pub largest_mount_force: Peak,
    /// When the normal force of rotor and race last grew.
    pub growth: Growth,
    /// When the distance of their centres last grew.
    pub reach: Growth,
    /// Largest distance of the rotor's geometric centre from the inner race's centre, m.
    pub rotor_race_displacement: Peak,
    /// Largest distance of the rotor's geometric centre from the line of levitation while it touches the race, m.
    pub rotor_displacement: Peak,
    /// Largest displacement of the outer race across its axis, m.
    pub mount_displacement: Peak,
    /// What the parts of its mount besides spring and damper have done; none without such parts.
    pub mount_parts: Option<MountPeaks>,
    /// Turns of the rotor about the inner race while it is out of the middle half of its clearance.
    pub whirl_turns: Turns,
    /// Way of the rotor's geometric centre against that of the inner race.
    pub travel: Travel,
    /// ∫N dt of the normal force of rotor and race, N s.
    pub impulse: f64,
    /// Turns of the inner race, of either sense.
    pub turns: f64,
    /// Sum of the cube of the load on the bearing over them, N³.
    pub cubed_load_turns: f64,
    /// What its races have seen of their balls; none of a bushing.
    pub races: Option<RaceRecord>,
    /// What is of one in space alone.
    pub spatial: Option<Box<SpatialRecord>>,
    pub(super) rises: Vec<Rise>,
    /// The watched forces at the start of the last step, N, and its length, s.
    last_forces: ([f64; WATCHED.len()], f64),
    clearance: f64,
    /// Of the rotor's mass centre at the node, m.
    eccentricity: f64,
    whirl_angle: Option<f64>,
    limits: Limits,
    /// How hot its surfaces became, where they are given.
    pub heat: Option<Box<SurfaceHeat>>,
    /// Channel of the friction heat of rotor and race.
    friction_heat: usize,
    /// How warm it became, where that is followed.
    pub warmth: Option<Box<Warmth>>,
    /// First channel of its heats.
    first_heat: usize,
    /// Turns of the cage since the rotor rolls, and of its whirl when that began.
    rolled: f64,
    whirled: f64,
}

/// Where the equations stop being true.
#[derive(Clone, Copy, Debug)]
struct Limits {
    mount_displacement: f64,
    penetration: f64,
}

/// Forces whose largest values are kept.
const WATCHED: [usize; 6] = [
    LARGEST_INNER_LOAD,
    LARGEST_OUTER_LOAD,
    BEARING_LOAD,
    MOUNT_FORCE,
    LARGEST_POCKET_FORCE,
    LAND_FORCE,
];

/// The load on the bearing among them.
const LOAD: usize = 2;

/// So many of the first of them are searched for between the steps as well. The load on the bearing peaks with that of a ball, a
/// mount swings slowly against the steps, and the forces on a cage are chaotic.
const SEARCHED: usize = 2;

/// A peak is searched for inside a step when a value comes this near to the record.
const NEAR_RECORD: f64 = 0.9;
/// A peak that rises above both ends of its step by less than this share of the record is not worth searching.
const STEADY: f64 = 1e-4;
/// Slip below which a contact counts as rolling, over its speed.
const ROLLING_SLIP: f64 = 0.01;
/// Turns of every cage that a rotor must have rolled before it counts as rolling.
pub(super) const ROLLING_TURNS: f64 = 20.0;
/// Turns about the race from which on a rotor whirls: it may roll as it does so, but not under its weight.
const WHIRLING_TURNS: f64 = 0.5;
/// Contacts for which room is made before the run.
const CONTACTS: usize = 4096;

/// What is waited for after a release at a speed, rad/s: shares of it at the race, and of rolling at the cage.
fn rises(machine: &RotorMachine, bearing: usize, speed: f64) -> Vec<Rise> {
    let part = &machine.constants.bearings[bearing].bearing;
    let at = machine.layout().bearings[bearing];
    let race = |share: f64| Rise::through(at.inner.spin(), share * speed);
    let mut rises = vec![race(0.5), race(0.95)];
    if let Some(cage) = part.cage_speed_state() {
        let ratio = part.rolling_cage_ratio();
        rises.push(Rise::through(at.bearing + cage, 0.95 * speed * ratio));
    }
    rises
}

impl BearingRecord {
    pub(super) fn new(machine: &RotorMachine, bearing: usize, keep_rows: bool) -> Self {
        let speed = machine.constants.speed;
        let part = &machine.constants.bearings[bearing];
        let at = machine.layout().bearings[bearing];
        BearingRecord {
            at,
            bearing,
            contacts: match part.fixture {
                None => Vec::with_capacity(CONTACTS),
                Some(_) => Vec::new(),
            },
            largest_inner_load: Peak::NONE,
            largest_outer_load: Peak::NONE,
            largest_pocket_force: Peak::NONE,
            largest_land_force: Peak::NONE,
            largest_bearing_load: Peak::NONE,
            largest_mount_force: Peak::NONE,
            growth: Growth::default(),
            reach: Growth::default(),
            rotor_race_displacement: Peak::NONE,
            rotor_displacement: Peak::NONE,
            mount_displacement: Peak::NONE,
            mount_parts: (part.mount_parts.any()).then_some(MountPeaks::NONE),
            whirl_turns: Turns::default(),
            travel: Travel::default(),
            impulse: 0.0,
            turns: 0.0,
            cubed_load_turns: 0.0,
            races: (!part.is_bushing()).then(|| RaceRecord::new(&part.bearing.rows(), speed)),
            spatial: part.spatial().map(|own| Box::new(SpatialRecord::new(own))),
            rises: match machine.controlled() {
                true => Vec::new(),
                false => rises(machine, bearing, speed),
            },
            last_forces: ([0.0; WATCHED.len()], f64::INFINITY),
            clearance: part.contact.radial_clearance,
            eccentricity: machine.constants.rotor.eccentricity(&part.node),
            whirl_angle: None,
            limits: Limits {
                mount_displacement: 0.1 * part.bearing.pitch_radius(),
                penetration: 0.1 * part.contact.bore_radius,
            },
            heat: part.surfaces.as_ref().map(|_| Box::default()),
            friction_heat: machine.layout().flows().start + at.rotor_race_friction(),
            warmth: (part.warm.as_ref()).map(|warm| Box::new(Warmth::new(warm, keep_rows))),
            first_heat: machine.layout().heat(at.heat),
            rolled: 0.0,
            whirled: 0.0,
        }
    }

    /// The magnets that held the rotor have lost their power at a spin, rad/s.
    pub(super) fn released(&mut self, machine: &RotorMachine, spin: f64) {
        self.rises = rises(machine, self.bearing, spin);
    }
    /// First instant the inner race reaches half the rotor's release speed, s.
    pub fn inner_race_time_to_50_percent(&self) -> Option<f64> {
        self.rises.first()?.time
    }
    /// First instant the inner race reaches 95 % of the rotor's release speed, s.
    pub fn inner_race_time_to_95_percent(&self) -> Option<f64> {
        self.rises.get(1)?.time
    }
    /// First instant the cage reaches 95 % of the rolling cage speed of the rotor's release speed, s.
    pub fn cage_time_to_95_percent(&self) -> Option<f64> {
        // where balls roll the cage follows the race
        self.rises.last()?.time
    }
    /// The largest normal force of all contacts.
    pub fn peak_contact_force(&self) -> Option<Peak> {
        let peaks = self.contacts.iter().map(|c| Peak {
            value: c.peak_force,
            time: c.peak_time,
        });
        peaks.reduce(|a, b| if b.value > a.value { b } else { a })
    }
    /// Records of the watched forces, in their order.
    fn forces(&mut self) -> [&mut Peak; WATCHED.len()] {
        [
            &mut self.largest_inner_load,
            &mut self.largest_outer_load,
            &mut self.largest_bearing_load,
            &mut self.largest_mount_force,
            &mut self.largest_pocket_force,
            &mut self.largest_land_force,
        ]
    }

    pub(super) fn forces_of(&mut self, step: &mut Step<RotorMachine>) {
        // by reference, and no `map` over the list: copies of both would be waited for in every step
        let machine = step.machine;
        let at = &machine.layout().bearings[self.bearing];
        let start: [f64; WATCHED.len()] =
            std::array::from_fn(|k| step.start_probe(at.probe(WATCHED[k])));
        let end: [f64; WATCHED.len()] =
            std::array::from_fn(|k| step.end_probe(at.probe(WATCHED[k])));
        let time = step.end;
        let length = step.end - step.start;
        let (last, last_length) = self.last_forces;
        let mut search = false;
        for (k, record) in self.forces().into_iter().enumerate() {
            record.raise(end[k], time);
            if k < SEARCHED && start[k].max(end[k]) > NEAR_RECORD * record.value {
                let last_slope = (start[k] - last[k]) / last_length;
                let slope = (end[k] - start[k]) / length;
                search |= may_peak(last_slope, slope, length, STEADY * record.value);
            }
        }
        self.last_forces = (start, length);
        if let Some(own) = &mut self.spatial {
            let depth = at.probe(AXIAL_PENETRATION);
            own.faces(
                [step.start, step.end],
                [step.start_probe(depth), step.end_probe(depth)],
                step.end_probe(at.probe(AXIAL_FORCE)),
            );
            own.outer_place
                .raise(step.end_state(at.outer.axial()).abs(), time);
            let bearing = step.machine.constants.bearings[self.bearing].spatial();
            if let Some((bearing, spring)) = bearing.and_then(|own| Some((own, own.spring?))) {
                let slid = step.end_state(at.own().start + bearing.sliding_state());
                own.spring(&spring, step.end, slid);
            }
            if let Some(surfaces) = bearing.and_then(|own| own.face_surfaces.as_ref()) {
                let friction = at.probe(AXIAL_FRICTION);
                let powers = [step.start_probe(friction), step.end_probe(friction)];
                (own.face_heat).watch(surfaces, [step.start, step.end], powers);
            }
        }
        let normal = at.probe(NORMAL_FORCE);
        self.growth.watch(step.end_probe(normal), time);
        self.impulse += 0.5 * length * (step.start_probe(normal) + step.end_probe(normal));
        let spins = [
            step.start_state(at.inner.spin()),
            step.end_state(at.inner.spin()),
        ];
        let share = length / (4.0 * PI);
        for (spin, forces) in spins.into_iter().zip([start, end]) {
            let (turned, load) = (share * spin.abs(), forces[LOAD]);
            self.turns += turned;
            self.cubed_load_turns += turned * load * load * load;
        }
        if search {
            for theta in [0.25, 0.5, 0.75] {
                let time = step.time(theta);
                let (_, probe) = step.evaluate(theta);
                let values = WATCHED.map(|kind| probe[at.probe(kind)]);
                for (record, value) in self.forces().into_iter().zip(values) {
                    record.raise(value, time);
                }
            }
        }
    }

    /// Whether the rotor is on a face at the end of a step.
    pub(super) fn is_on_face(&self, step: &Step<RotorMachine>) -> bool {
        self.spatial.is_some() && step.end_probe(self.at.probe(AXIAL_PENETRATION)) > 0.0
    }

    /// A step on a rig: largest values are those at its ends.
    pub(super) fn on_rig(&mut self, step: &mut Step<RotorMachine>) {
        for (peak, probe) in [
            (&mut self.largest_inner_load, LARGEST_INNER_LOAD),
            (&mut self.largest_outer_load, LARGEST_OUTER_LOAD),
            (&mut self.largest_pocket_force, LARGEST_POCKET_FORCE),
            (&mut self.largest_land_force, LAND_FORCE),
        ] {
            peak.raise_at_ends(step, self.at.probe(probe));
        }
        for rise in &mut self.rises {
            rise.watch(step);
        }
        self.balls_of(step);
        self.warmth_of(step);
    }

    /// Follows the heat of the surfaces that rub.
    pub(super) fn heat_of(&mut self, step: &mut Step<RotorMachine>) {
        let machine = step.machine;
        let part = &machine.constants.bearings[self.bearing];
        let (Some(heat), Some(surfaces)) = (&mut self.heat, &part.surfaces) else {
            return;
        };
        let at = self.at;
        let behind = part.warm.as_ref().zip(self.warmth.as_ref());
        let cores = behind.map(|(warm, warmth)| {
            let nodes = [warm.network.open_rotor(), INNER_RACE];
            nodes.map(|node| warmth.temperatures[node] - warm.start)
        });
        let both = |kind| {
            [
                step.start_probe(at.probe(kind)),
                step.end_probe(at.probe(kind)),
            ]
        };
        let seen = ContactStep {
            times: [step.start, step.end],
            forces: both(NORMAL_FORCE),
            slips: both(SLIP_SPEED),
            heats: [
                step.start_state(self.friction_heat),
                step.end_state(self.friction_heat),
            ],
            friction: part.contact.friction,
            cores,
            conducts: (part.warm.as_ref()).is_some_and(|warm| !warm.network.landing.is_given()),
        };
        let contact = &part.contact;
        if !heat.watch(surfaces, contact.bore_radius, &seen) {
            return;
        }
        let channels = machine.layout().rotor.channels();
        let state = step.leading_state(1.0, channels.max(at.inner.channels().end));
        let rotor = machine.layout().rotor.motion(state);
        let centre = machine.one.nodes[self.bearing].centre(&rotor);
        let race = at.inner.motion(state);
        let motions = Motions {
            offset: centre.position - race.position,
            velocity: centre.velocity - race.velocity,
            spins: [rotor.spin, race.spin],
        };
        let sizes = [contact.bore_radius, contact.radial_clearance];
        heat.take(surfaces, sizes, &seen, &motions);
        if let Some(contact) = self.contacts.last_mut() {
            contact.peak_rise = heat.of_touch;
        }
    }

    /// Looks at the balls of the bearing where it is time.
    pub(super) fn balls_of(&mut self, step: &mut Step<RotorMachine>) {
        let (machine, time) = (step.machine, step.end);
        let load = step.end_probe(self.at.probe(LARGEST_INNER_LOAD));
        let skids = [0, 1].map(|race: usize| step.end_probe(self.at.probe(LARGEST_SKIDS + race)));
        if (self.races.as_mut()).is_some_and(|races| races.is_due(time, load, skids)) {
            self.look(machine, time, step.state(1.0));
        }
    }

    /// Looks at the balls of the bearing in a state.
    pub(super) fn look(&mut self, machine: &RotorMachine, time: f64, state: &[f64]) {
        let part = &machine.constants.bearings[self.bearing];
        if let (Some(record), Some(own)) = (&mut self.spatial, part.spatial()) {
            record.look(own, time, &self.at.motion(state), &state[self.at.own()]);
        }
        if let Some(races) = &mut self.races {
            races.look(&BearingInstant {
                bearing: &machine.constants.bearings[self.bearing].bearing,
                time,
                motion: self.at.motion(state),
                state: &state[self.at.own()],
            });
        }
    }

    /// Follows the temperatures of the bearing.
    pub(super) fn warmth_of(&mut self, step: &Step<RotorMachine>) {
        if (self.warmth.as_ref()).is_some_and(|warmth| warmth.is_due(step.end)) {
            self.warm(step.machine, step.end, &|channel| step.end_state(channel));
        }
    }

    pub(super) fn warm(&mut self, machine: &RotorMachine, time: f64, state: &dyn Fn(usize) -> f64) {
        let part = &machine.constants.bearings[self.bearing];
        let (Some(warmth), Some(warm)) = (&mut self.warmth, &part.warm) else {
            return;
        };
        let first = self.at.own().start;
        let seen = HeatInstant {
            time,
            heats: heats_of(machine, self.first_heat, state),
            spin: state(self.at.inner.spin()),
            drag_factor: part.bearing.drag_factor(&|own| state(first + own)),
            films: part.bearing.in_films(&|own| state(first + own)),
            taken: (self.heat.as_ref()).map(|heat| (heat.taken(), heat.slid.impulse)),
            impulse: part.fixture.is_none().then_some(self.impulse),
        };
        warmth.take(warm, &seen);
    }

    /// Whether the rotor has rolled in this bearing for [`ROLLING_TURNS`]: it presses on the race, neither slips there nor does
    /// the cage, within a hundredth, and it does not whirl.
    pub(super) fn rolling_of(&mut self, step: &Step<RotorMachine>) -> bool {
        let (machine, at) = (step.machine, self.at);
        let part = &machine.constants.bearings[self.bearing];
        let spin = step.end_state(at.inner.spin());
        let cage = spin * part.bearing.rolling_cage_ratio();
        let slip = step.end_probe(at.probe(SLIP_SPEED));
        let slow = |error: f64, speed: f64| error.abs() < ROLLING_SLIP * speed.abs();
        let slips = |state: usize| step.end_state(at.bearing + state) - cage;
        let cage_rolls = (part.bearing.cage_speed_state()).is_none_or(|own| slow(slips(own), cage));
        let rolls = step.end_probe(at.probe(NORMAL_FORCE)) > 0.0
            && slow(slip, spin * part.contact.bore_radius)
            && cage_rolls
            && (self.whirl_turns.net - self.whirled).abs() < WHIRLING_TURNS;
        match rolls {
            true => self.rolled += cage.abs() * (step.end - step.start) / (2.0 * PI),
            false => (self.rolled, self.whirled) = (0.0, self.whirl_turns.net),
        }
        // a bushing does not turn
        part.is_bushing() || self.rolled >= ROLLING_TURNS
    }

    /// Follows the whirl of the rotor about the inner race.
    pub(super) fn whirl_of(&mut self, step: &mut Step<RotorMachine>) {
        let [x, y] = (self.at.inner.centre()).map(|channel| step.end_state(channel));
        let race = Vec2::new(x, y);
        let offset = centre_at_end(step, self.bearing) - race;
        let spin = step.end_state(step.machine.layout().rotor.spin());
        self.travel.to(step.end, offset, spin);
        let gap = -step.end_probe(self.at.probe(PENETRATION));
        if gap > 0.5 * self.clearance {
            self.whirl_angle = None;
            return;
        }
        let angle = offset.y.atan2(offset.x);
        if let Some(last) = self.whirl_angle {
            let turn = (angle - last) / (2.0 * PI);
            self.whirl_turns.add(turn - turn.round());
        }
        self.whirl_angle = Some(angle);
    }

    /// True where the equations are not true any more.
    pub(super) fn too_far(&self, step: &Step<RotorMachine>) -> bool {
        self.mount_displacement.value > self.limits.mount_displacement
            || step.end_probe(self.at.probe(PENETRATION)) > self.limits.penetration
    }
}

/// Heats of a bearing, J: on a rig those of its balls, and the friction of a sliding rotor.
fn heats_of(machine: &RotorMachine, first: usize, state: &dyn Fn(usize) -> f64) -> [f64; HEATS] {
    let Some(fixture) = machine.fixture() else {
        return std::array::from_fn(|kind| state(first + kind));
    };
    let slides = matches!(fixture.drive, Drive::SlidingRotor(_));
    std::array::from_fn(|kind| match kind {
        kind if kind < DRIVE_HEAT => state(first + kind),
        kind if slides && kind == HEATS - 1 => state(first + DRIVE_HEAT),
        _ => 0.0,
    })
}

/// Whether a value with these mean slopes over the last and this step may have a peak inside this step that rises
/// above both ends by more than `least`: judged by the parabola through the three values, taken half as curved again.
fn may_peak(last_slope: f64, slope: f64, length: f64, least: f64) -> bool {
    let curving = 1.5 * (slope - last_slope);
    let (at_start, at_end) = (slope - 0.5 * curving, slope + 0.5 * curving);
    at_start > 0.0 && at_end < 0.0 && -0.125 * curving * length > least
}

/// Position of the rotor's mass centre at the node in a bearing at the end of a step, from the line of levitation.
fn mass_centre_at_end(step: &Step<RotorMachine>, bearing: usize) -> Vec2<f64> {
    let rotor = step.machine.layout().rotor;
    let node = &step.machine.one.nodes[bearing];
    let channels = rotor.block(0).zip(rotor.block(1));
    (node.row.iter().zip(channels)).fold(Vec2::zero(), |sum, (shape, (x, y))| {
        sum + Vec2::new(step.end_state(x), step.end_state(y)) * *shape
    })
}

/// Position of its geometric centre there, from the datum of the bearing.
fn centre_at_end(step: &mut Step<RotorMachine>, bearing: usize) -> Vec2<f64> {
    let machine = step.machine;
    let state = step.leading_state(1.0, machine.layout().rotor.channels());
    machine.node(bearing, state).position
}

/// The contact of rotor and race at a fraction of a step; inlined, so that nothing is computed but what is asked for.
#[inline(always)]
fn contact_at(step: &mut Step<RotorMachine>, bearing: usize, theta: f64) -> ContactReaction<f64> {
    let machine = step.machine;
    let at = &machine.layout().bearings[bearing];
    // both races; the one ring of a bushing ends behind its spin
    let ends = [at.inner, at.outer].map(|race| race.channels().end);
    let state = step.leading_state(theta, ends[0].max(ends[1]));
    if let Some(found) = machine.one.contact_in_space(bearing, state) {
        return found;
    }
    let rotor = machine.layout().rotor.motion(state);
    let centre = machine.one.nodes[bearing].centre(&rotor);
    (machine.constants.bearings[bearing].contact).react(
        &centre,
        rotor.spin,
        &at.motion(state).inner,
    )
}
