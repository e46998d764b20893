//! An auxiliary bearing: contact, inner race, bearing, outer race, mount as one part.
//!
//! ```text
//!   node of the rotor C ──(contact: clearance c0, N, friction)── inner race c_i, φ_i ── drive torque
//!                                                                  │ bearing: balls, cage
//!                                     ground ──/\/\/── mount ──  outer race c_o
//!
//!   m_i c̈_i = contact + bearing + m_i g           or held
//!   (I_i + J) φ̈_i = contact + bearing + drive     J: what balls and cage add, where they have no states
//!   m_o c̈_o = bearing + mount + m_o g             does not turn: the ground takes t_O
//! ```
//! A bearing without balls is a plain bushing: both races are one ring, which stands in the state as an inner race that does
//! not turn. The rotor rubs on it, and the ground takes the moment of that friction:
//! ```text
//!   m_o c̈_o = contact + mount + m_o g             ω_i = 0
//! ```
//! The motion of a node of the rotor in, the wrench on that node out. States: those of both races and of the bearing, where
//! [`BearingAt`] says.
//!
//! Assumes: the outer race does not turn. Does not model: tilt and axial motion of the races, a sleeve that slips on its race.

use crate::bearing::{self, Bearing, BearingConstants, BearingReaction, POCKET_FRICTION};
use crate::bearing_heat::WarmBearing;
use crate::body::BodyAt;
use crate::contact::{ContactReaction, JournalContact};
pub use crate::heats::{HEATS, OWN_HEATS};
use crate::motion::{Body, Motion};
use crate::mount::{Mount, MountParts, MountReaction, WholeMount};
use crate::rotor::GeometricCentre;
use crate::surface_heat::Surfaces;
use crate::system::layout::Layout;
use number::{Gather, Real, Vec2, constants};
use std::ops::Range;

constants! {
    /// The inner race with its sleeve.
    pub struct RaceConstants {
        /// Mass, kg.
        mass: R,
        /// Polar inertia, kg m².
        inertia: R,
        /// True where its centre is held; it may still turn.
        centre_held: bool,
        /// Torque of a drive on it, N m.
        torque: R,
    }
}

/// Constants of one auxiliary bearing.
#[derive(Clone, Debug, PartialEq)]
pub struct AuxiliaryBearingConstants {
    /// Its name; empty where it is the only one.
    pub name: String,
    /// Row φ of the rotor's node in it: (1) of a point.
    pub node: Vec<f64>,
    /// Its middle, from the line about which the rotor is levitated, m: all its coordinates are counted from there.
    pub datum: Vec2<f64>,
    /// Rotor against inner race.
    pub contact: JournalContact<f64>,
    /// Inner race and sleeve. Of a bushing it has no mass, and its inertia is only the measure of the errors of the ledger.
    pub inner_race: RaceConstants<f64>,
    /// The bearing. Without balls it is a bushing ([`RollingConstants::bushing`](bearing::RollingConstants::bushing)).
    pub bearing: BearingConstants,
    /// Mass of the outer race with its housing, kg.
    pub outer_race_mass: f64,
    /// Spring and damper of the mount of the outer race.
    pub mount: Mount<f64>,
    /// What the mount has besides.
    pub mount_parts: MountParts,
    /// Surfaces of rotor and race, where their heat is followed.
    pub surfaces: Option<Surfaces>,
    /// What warms of it, where that is followed.
    pub warm: Option<Box<WarmBearing>>,
}

impl AuxiliaryBearingConstants {
    /// Whether it is a bushing: one ring that does not turn.
    pub fn is_bushing(&self) -> bool {
        self.bearing.balls() == 0
    }
    /// Mass that translates with the outer race, kg.
    pub fn outer_moving_mass(&self) -> f64 {
        self.outer_race_mass + self.bearing.mass_with_outer_race()
    }
    /// Chooses where the mount's spring is free so that it carries the bearing's weight with the outer race at the
    /// origin; without a spring a force carries it. The weight of an inner race whose centre is held rests elsewhere.
    pub fn balance_mount(&mut self, gravity: Vec2<f64>) {
        let inner = if self.inner_race.centre_held {
            0.0
        } else {
            self.inner_race.mass
        };
        let mass = self.outer_moving_mass() + self.bearing.free_mass() + inner;
        if self.mount.stiffness > 0.0 {
            self.mount.free_position = -(gravity * (mass / self.mount.stiffness));
        } else {
            self.mount_parts.preload = -(gravity * mass);
        }
    }
}

/// Kinds of source of an auxiliary bearing.
pub const SOURCES: [&str; 2] = ["inner_race_torque", "inner_race_growth"];

/// Probes of an auxiliary bearing besides the detail of its balls, by their place among them.
pub mod probe {
    /// Penetration of the rotor/race contact, m.
    pub const PENETRATION: usize = 0;
    /// Its rate, m/s.
    pub const PENETRATION_SPEED: usize = 1;
    /// Normal force, N.
    pub const NORMAL_FORCE: usize = 2;
    /// Its rate, N/s.
    pub const NORMAL_FORCE_RATE: usize = 3;
    /// Friction force on the rotor along t, N.
    pub const FRICTION_FORCE: usize = 4;
    /// Sliding speed, race less rotor, m/s.
    pub const SLIP_SPEED: usize = 5;
    /// Largest ball load at the inner race, N.
    pub const LARGEST_INNER_LOAD: usize = 6;
    /// Largest ball load at the outer race, N.
    pub const LARGEST_OUTER_LOAD: usize = 7;
    /// Largest force between a ball and its pocket, or between two balls without a cage, N.
    pub const LARGEST_POCKET_FORCE: usize = 8;
    /// Force between cage and land, N.
    pub const LAND_FORCE: usize = 9;
    /// Size of the force that the balls exert on the outer race, N: the load on the bearing.
    pub const BEARING_LOAD: usize = 10;
    /// Size of the force of the outer race on its mount, spring and damper together, N.
    pub const MOUNT_FORCE: usize = 11;
    /// First of the largest u²Q of a ball at both races, (m/s)² N.
    pub const LARGEST_SKIDS: usize = 12;
    /// Number of them.
    pub const COUNT: usize = 14;
}

/// Where an auxiliary bearing stands in the state, in the ledger and among the probes of its machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BearingAt {
    /// The inner race.
    pub inner: BodyAt,
    /// The outer race, which does not turn; of a bushing the ring that is the inner one too.
    pub outer: BodyAt,
    /// First channel of the bearing's own states, the angle of its cage.
    pub bearing: usize,
    /// Number of these.
    pub bearing_states: usize,
    /// First channel of the states of its mount.
    pub mount: usize,
    /// Number of these.
    pub mount_states: usize,
    /// Number of balls.
    pub balls: usize,
    /// First of its heats among all.
    pub heat: usize,
    /// First of its sources among all.
    pub source: usize,
    /// First of its probes.
    pub probe: usize,
    /// First probe of the detail of its balls.
    pub detail: usize,
}

impl BearingAt {
    /// Channels of the bearing's own states.
    #[inline(always)]
    pub fn own(&self) -> Range<usize> {
        self.bearing..self.bearing + self.bearing_states
    }
    /// Channels of the states of the mount.
    #[inline(always)]
    pub fn of_mount(&self) -> Range<usize> {
        self.mount..self.mount + self.mount_states
    }
    /// Heat of the friction of rotor and race, among all.
    #[inline(always)]
    pub fn rotor_race_friction(&self) -> usize {
        // the last of its own
        self.heat + HEATS - 1
    }
    /// Probe of a kind of [`probe`].
    #[inline(always)]
    pub fn probe(&self, kind: usize) -> usize {
        self.probe + kind
    }
    /// Motion of both races in a state; the outer race does not turn.
    #[inline(always)]
    pub fn motion<R: Real>(&self, state: &[R]) -> Motion<R> {
        Motion {
            inner: self.inner.motion(state),
            outer: self.outer.motion(state),
        }
    }
}

/// Adds the races of an auxiliary bearing to a layout, or the ring of a bushing: the inner and the outer one.
pub fn lay_races(layout: &mut Layout, name: &str, bushing: bool) -> [BodyAt; 2] {
    let inner = layout.body(name, "bearing.inner_race", BodyAt::free);
    let outer = match bushing {
        true => inner.without_turn(),
        false => layout.body(name, "bearing.outer_race", BodyAt::moving),
    };
    [inner, outer]
}

/// An auxiliary bearing over `R`.
#[derive(Clone, Debug)]
pub struct AuxiliaryBearing<R: Real> {
    pub(crate) contact: JournalContact<R>,
    pub(crate) inner_race: RaceConstants<R>,
    pub(crate) bearing: Bearing<R>,
    pub(crate) mount: WholeMount<R>,
    pub(crate) outer_moving_mass: R,
    bushing: bool,
    /// Reciprocals, because a division costs as much as ten products.
    inverse_inner_mass: R,
    inverse_outer_mass: R,
}

/// What the rotor does at the node.
#[derive(Clone, Copy, Debug)]
pub struct AtNode<R> {
    /// Its motion.
    pub centre: GeometricCentre<R>,
    /// What the contact does at this motion.
    pub contact: ContactReaction<R>,
}

/// Where the rates and probes of an auxiliary bearing are written.
#[derive(Debug)]
pub struct Outlet<'a, R> {
    /// Channel of its first heat.
    pub heat: usize,
    /// Channel of its first source.
    pub source: usize,
    /// Rates of the machine.
    pub rate: &'a mut [R],
    /// Probes of the machine; empty where nobody looks.
    pub probe: &'a mut [R],
}

/// Moments about the origin from outside an auxiliary bearing, N m, in the order in which they are added.
#[derive(Clone, Copy, Debug)]
pub struct External<R> {
    /// Weights of both races.
    pub weights: [R; 2],
    /// Drive torque, what holds the centre of the inner race, mount, balls and cage, and less t_O.
    pub others: [R; 5],
}

impl<R: Real> AuxiliaryBearing<R> {
    /// One auxiliary bearing per lane.
    pub fn gather<'a>(constants: &dyn Fn(usize) -> &'a AuxiliaryBearingConstants) -> Self {
        let lanes = |of: &dyn Fn(&AuxiliaryBearingConstants) -> f64| {
            R::from_lanes(|lane| of(constants(lane)))
        };
        AuxiliaryBearing {
            contact: Gather::<R>::gather(&|lane| &constants(lane).contact),
            inner_race: Gather::<R>::gather(&|lane| &constants(lane).inner_race),
            bearing: Bearing::gather(&|lane| &constants(lane).bearing),
            mount: WholeMount::gather(&|lane| {
                (&constants(lane).mount, &constants(lane).mount_parts)
            }),
            outer_moving_mass: lanes(&|c| c.outer_moving_mass()),
            bushing: constants(0).is_bushing(),
            inverse_inner_mass: lanes(&|c| 1.0 / c.inner_race.mass),
            inverse_outer_mass: lanes(&|c| 1.0 / c.outer_moving_mass()),
        }
    }

    /// What the contact does to rotor and inner race.
    #[inline(always)]
    pub fn contact(
        &self,
        centre: &GeometricCentre<R>,
        spin: R,
        inner: &Body<R>,
    ) -> ContactReaction<R> {
        self.contact.react(centre, spin, inner)
    }

    /// What the bearing does between its races; writes the rates of its own states and the detail of its balls.
    #[inline(always)]
    pub fn bearing(
        &self,
        at: &BearingAt,
        motion: &Motion<R>,
        state: &[R],
        rate: &mut [R],
        probe: &mut [R],
    ) -> BearingReaction<R> {
        let detail = if probe.is_empty() {
            &mut [][..]
        } else {
            // a short list has room for the watched probes alone
            let end = probe
                .len()
                .min(at.detail + bearing::DETAIL_PER_BALL * at.balls);
            &mut probe[at.detail.min(end)..end]
        };
        (self.bearing).react(motion, &state[at.own()], &mut rate[at.own()], detail)
    }

    /// What the mount does at a motion of the outer race; writes the rates of its own states.
    #[inline(always)]
    pub fn mount(
        &self,
        at: &BearingAt,
        motion: &Motion<R>,
        state: &[R],
        rate: &mut [R],
    ) -> MountReaction<R> {
        let outer = &motion.outer;
        let (state, rate) = (&state[at.of_mount()], &mut rate[at.of_mount()]);
        (self.mount).react((outer.position, outer.velocity), state, rate)
    }

    /// Writes the rates of both races and of the ledger's heats and sources, and the probes where asked, which alone see the
    /// acceleration of the node; returns the moments from outside.
    #[inline(always)]
    pub fn accelerate(
        &self,
        at: &BearingAt,
        (node, node_acceleration): (&AtNode<R>, Vec2<R>),
        gravity: Vec2<R>,
        motion: &Motion<R>,
        (bearing, on_outer): (&BearingReaction<R>, &MountReaction<R>),
        into: Outlet<'_, R>,
    ) -> External<R> {
        if self.bushing {
            let node = (node, node_acceleration);
            return self.accelerate_ring(at, node, gravity, &motion.inner, on_outer, into);
        }
        let Outlet {
            heat,
            source,
            rate,
            probe,
        } = into;
        let zero = R::zero();
        let contact = &node.contact;
        let race = &self.inner_race;
        let (inner, outer) = (&motion.inner, &motion.outer);
        let mount = on_outer.force;

        // inner race
        let inner_force = contact.on_bore.force + bearing.on_inner.force + gravity * race.mass;
        let inner_acceleration = if race.centre_held {
            Vec2::zero()
        } else {
            inner_force * self.inverse_inner_mass
        };
        let inner_moment = contact.on_bore.moment + bearing.on_inner.moment + race.torque;
        let bearing = (*bearing).with_loss(inner.spin, inner_moment);
        let inner_spin_rate = inner_moment / (race.inertia + bearing.inner_inertia);
        (at.inner).move_at(rate, inner.velocity, inner_acceleration);
        (at.inner).turn_at(rate, inner.spin, inner_spin_rate);

        // outer race: the ground holds its spin
        let outer_force = bearing.on_outer.force + mount + gravity * self.outer_moving_mass;
        let outer_acceleration = outer_force * self.inverse_outer_mass;
        (at.outer).move_at(rate, outer.velocity, outer_acceleration);
        let outer_moment = bearing.on_outer.moment - bearing.outer_inertia * inner_spin_rate;

        // ledger
        let of_bearing = bearing.heat.kinds();
        let mut heats = [zero; HEATS];
        let (kinds, rest) = heats.split_at_mut(of_bearing.len());
        kinds.copy_from_slice(&of_bearing);
        kinds[POCKET_FRICTION] += bearing.loss_heat(inner.spin, inner_spin_rate);
        rest.copy_from_slice(&[on_outer.heat(), contact.damping_heat, contact.friction_heat]);
        rate[heat..heat + HEATS].copy_from_slice(&heats);
        rate[source] = race.torque * inner.spin;
        rate[source + 1] = bearing.growth_impulse * inner_spin_rate;

        if !probe.is_empty() {
            let values: [R; probe::COUNT] = [
                contact.penetration,
                contact.penetration_speed,
                contact.normal_force,
                self.contact.force_rate(
                    contact,
                    &node.centre,
                    inner,
                    node_acceleration - inner_acceleration,
                ),
                contact.friction_force,
                contact.slip_speed,
                bearing.largest_inner_load,
                bearing.largest_outer_load,
                bearing.largest_pocket_force,
                bearing.land_force,
                bearing.on_outer.force.length_squared().sqrt(),
                mount.length_squared().sqrt(),
                bearing.largest_skids[0],
                bearing.largest_skids[1],
            ];
            probe[at.probe..at.probe + probe::COUNT].copy_from_slice(&values);
        }
        let weight_moment = |position: Vec2<R>, mass: R| position.cross(gravity) * mass;
        let hold = if race.centre_held {
            // the force that holds the centre is the opposite of everything else on the race
            -inner.position.cross(inner_force)
        } else {
            zero
        };
        External {
            weights: [
                weight_moment(inner.position, race.mass),
                weight_moment(outer.position, self.outer_moving_mass),
            ],
            others: [
                race.torque,
                hold,
                outer.position.cross(mount),
                bearing.external_moment,
                -outer_moment,
            ],
        }
    }
}

impl<R: Real> AuxiliaryBearing<R> {
    /// The same of a bushing.
    #[inline(always)]
    fn accelerate_ring(
        &self,
        at: &BearingAt,
        (node, node_acceleration): (&AtNode<R>, Vec2<R>),
        gravity: Vec2<R>,
        ring: &Body<R>,
        mount: &MountReaction<R>,
        into: Outlet<'_, R>,
    ) -> External<R> {
        let (rate, zero) = (into.rate, R::zero());
        let contact = &node.contact;
        let force = contact.on_bore.force + mount.force + gravity * self.outer_moving_mass;
        let acceleration = force * self.inverse_outer_mass;
        (at.inner).move_at(rate, ring.velocity, acceleration);
        (at.inner).turn_at(rate, zero, zero);

        // ledger: neither balls nor a drive
        let heats = &mut rate[into.heat..into.heat + HEATS];
        let (of_balls, own) = heats.split_at_mut(bearing::HEATS.len());
        of_balls.fill(zero);
        own.copy_from_slice(&[mount.heat(), contact.damping_heat, contact.friction_heat]);
        rate[into.source..into.source + SOURCES.len()].fill(zero);

        if !into.probe.is_empty() {
            let mut values = [zero; probe::COUNT];
            values[probe::PENETRATION] = contact.penetration;
            values[probe::PENETRATION_SPEED] = contact.penetration_speed;
            values[probe::NORMAL_FORCE] = contact.normal_force;
            let approach = node_acceleration - acceleration;
            values[probe::NORMAL_FORCE_RATE] =
                (self.contact).force_rate(contact, &node.centre, ring, approach);
            values[probe::FRICTION_FORCE] = contact.friction_force;
            values[probe::SLIP_SPEED] = contact.slip_speed;
            values[probe::BEARING_LOAD] = contact.on_bore.force.length_squared().sqrt();
            values[probe::MOUNT_FORCE] = mount.force.length_squared().sqrt();
            into.probe[at.probe..at.probe + probe::COUNT].copy_from_slice(&values);
        }
        External {
            weights: [zero, ring.position.cross(gravity) * self.outer_moving_mass],
            others: [
                zero,
                zero,
                ring.position.cross(mount.force),
                zero,
                -contact.on_bore.moment,
            ],
        }
    }
}
