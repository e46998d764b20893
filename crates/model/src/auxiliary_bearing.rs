//! An auxiliary bearing: contact, inner race, bearing, outer race, mount as one part.
//!
//! ```text
//!   node of the rotor C ──(contact: clearance c0, N, friction)── inner race c_i, φ_i ── drive torque
//!                                                                  │ bearing: balls, cage
//!                                     ground ──/\/\/── mount ──  outer race c_o
//!
//!   m_i c̈_i = contact + bearing + m_i g           or held
//!   (I_i + J) φ̈_i = contact + bearing + drive     J: what balls and cage add, where they have no states; or φ̈_i given
//!   m_o c̈_o = bearing + mount + m_o g             or held; does not turn: the ground takes t_O
//! ```
//! On a rig the load with the friction that it presses, or a clutch, stands for the contact, and what carries the outer race for the mount: see
//! [`fixture`](crate::system::rig::fixture).
//!
//! A bearing without balls is a plain bushing: both races are one ring, which stands in the state as an inner race that does
//! not turn, of no mass of its own. The rotor rubs on it, and the ground takes the moment of that friction: what the contact does stands
//! for the bearing, m_o c̈_o = contact + mount + m_o g, ω_i = 0.
//! The motion of a node of the rotor in, the wrench on that node out. States: those of both races and of the bearing, where
//! [`BearingAt`] says.
//!
//! Assumes: the outer race does not turn. Does not model: tilt and axial motion of the races, a sleeve that slips on its race.

use crate::bearing::{self, Bearing, BearingConstants, BearingReaction, POCKET_FRICTION};
use crate::bearing_heat::WarmBearing;
use crate::body::BodyAt;
use crate::contact::{ContactReaction, JournalContact};
pub use crate::heats::{HEATS, OWN_HEATS};
use crate::motion::Motion;
use crate::mount::{Mount, MountParts, MountReaction, WholeMount};
use crate::rotor::GeometricCentre;
use crate::spatial::Spatial;
use crate::surface_heat::Surfaces;
use crate::system::layout::Layout;
use crate::system::rig::fixture::{Acting, Fixture, FixtureOver};
use crate::system::rig::layout::{ARM, HOUSING, READINGS};
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
    /// Equal rows at this node that it stands for. They share every force equally, so that one is computed: rotor and ledger count it
    /// so many times, and states, probes and heats are those of one.
    pub planes: f64,
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
    /// What turns, loads and carries it on a rig, in place of node, contact and mount; none in a machine.
    pub fixture: Option<Box<Fixture>>,
}

impl AuxiliaryBearingConstants {
    /// Its name in results.
    pub fn label(&self) -> String {
        match self.name.as_str() {
            "" => "auxiliary_bearing".to_string(),
            name => name.to_string(),
        }
    }
    /// Whether it is a bushing: one ring that does not turn.
    pub fn is_bushing(&self) -> bool {
        self.bearing.balls() == 0
    }
    /// Whether both races stay in the middle: no load reaches the balls.
    pub fn is_concentric(&self) -> bool {
        let housing = (self.fixture.as_ref()).and_then(|fixture| fixture.housing.as_ref());
        housing.map_or(self.inner_race.centre_held, |housing| housing.centre_held)
    }
    /// Whether the outer race stands.
    fn outer_held(&self) -> bool {
        let held = |fixture: &Fixture| (fixture.housing.as_ref()).is_none_or(|own| own.centre_held);
        self.fixture.as_ref().is_some_and(|fixture| held(fixture))
    }
    /// Mass on which gravity acts besides balls and inner race, kg: a load counts the housing of a rig.
    pub fn outer_weighing_mass(&self) -> f64 {
        match self.fixture {
            Some(_) => self.bearing.mass_with_outer_race(),
            None => self.outer_moving_mass(),
        }
    }
    /// Mass that translates with the outer race, kg.
    pub fn outer_moving_mass(&self) -> f64 {
        self.outer_race_mass + self.bearing.mass_with_outer_race()
    }
    /// Mass that its mount carries, kg: races, balls and what moves with them, without an inner race that is held.
    pub fn mass_on_mount(&self) -> f64 {
        let inner = if self.inner_race.centre_held {
            0.0
        } else {
            self.inner_race.mass
        };
        self.outer_moving_mass() + self.bearing.free_mass() + inner
    }
    /// Chooses where the mount's spring is free so that it carries the bearing's weight with the outer race at the
    /// origin; without a spring a force carries it. The weight of an inner race whose centre is held rests elsewhere.
    pub fn balance_mount(&mut self, gravity: Vec2<f64>) {
        let mass = self.mass_on_mount();
        if self.mount.stiffness > 0.0 {
            self.mount.free_position = -(gravity * (mass / self.mount.stiffness));
        } else {
            self.mount_parts.preload = -(gravity * mass);
        }
        if let BearingConstants::Spatial(own) = &mut self.bearing {
            let along = own.rows[0].ball.gravity.z;
            own.mount.free_position.z = -along * mass / own.mount.axial_stiffness;
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
    /// Penetration of a shoulder of the rotor into a face of the inner race, m; not above 0 where there is none.
    pub const AXIAL_PENETRATION: usize = 14;
    /// Normal force on these faces, N.
    pub const AXIAL_FORCE: usize = 15;
    /// Power of friction on these faces, W.
    pub const AXIAL_FRICTION: usize = 16;
    /// Number of them.
    pub const COUNT: usize = 17;
}

/// Where an auxiliary bearing stands in the state, in the ledger and among the probes of its machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BearingAt {
    /// The inner race.
    pub inner: BodyAt,
    /// The outer race, which does not turn; of a bushing the ring that is the inner one too.
    pub outer: BodyAt,
    /// Channel of the rotor's spin.
    pub driver: usize,
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
pub fn lay_races(layout: &mut Layout, part: &AuxiliaryBearingConstants) -> [BodyAt; 2] {
    let housing = (part.fixture.as_ref()).map(|fixture| fixture.housing.is_some());
    if housing == Some(true) {
        let shaft = layout.body(&part.name, "shaft", BodyAt::turning);
        let readings = layout.block(&part.name, READINGS.map(String::from));
        let outer = layout.body(&part.name, "housing", BodyAt::moving);
        assert!(readings.start == ARM && outer == HOUSING);
        return [shaft, outer];
    }
    if part.spatial().is_some() {
        return ["inner_race", "outer_race"]
            .map(|ring| layout.body(&part.name, &format!("bearing.{ring}"), BodyAt::in_space));
    }
    let inner = layout.body(&part.name, "bearing.inner_race", BodyAt::free);
    let outer = match (housing, part.is_bushing()) {
        (Some(_), _) => BodyAt::STILL,
        (None, true) => inner.without_turn(),
        (None, false) => layout.body(&part.name, "bearing.outer_race", BodyAt::moving),
    };
    [inner, outer]
}

/// An auxiliary bearing over `R`.
#[derive(Clone, Debug)]
pub struct AuxiliaryBearing<R: Real> {
    pub(crate) contact: JournalContact<R>,
    pub(crate) inner_race: RaceConstants<R>,
    pub(crate) bearing: Bearing<R>,
    /// Rings, rows and landing surfaces of a bearing in space.
    pub(crate) spatial: Option<Box<Spatial<R>>>,
    pub(crate) mount: WholeMount<R>,
    pub(crate) outer_moving_mass: R,
    outer_weighing_mass: R,
    pub(crate) planes: R,
    pub(crate) outer_held: bool,
    pub(crate) fixture: Option<FixtureOver<R>>,
    bushing: bool,
    /// Reciprocals, because a division costs as much as ten products.
    inverse_inner_mass: R,
    inverse_outer_mass: R,
}

/// What the rotor does at the node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AtNode<R> {
    /// Its motion.
    pub centre: GeometricCentre<R>,
    /// What the contact does at this motion.
    pub contact: ContactReaction<R>,
}

/// How the races of a bearing on a rig move and turn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turned<R> {
    /// Motion of the races.
    pub motion: Motion<R>,
    /// The bearing with its acceleration loss.
    pub bearing: BearingReaction<R>,
    /// Acceleration of the inner race, rad/s².
    pub spin_rate: R,
    /// Moment on it besides those of bearing and support, N m.
    pub needed: R,
    /// Moment on the outer race t_O, N m.
    pub outer_moment: R,
    /// Heats of the bearing, W.
    pub heats: [R; bearing::HEATS.len()],
    /// Weight of the inner race, N.
    pub race_weight: Vec2<R>,
    /// Force on the outer race from outside, N.
    pub on_outer: Vec2<R>,
}

/// Where the rates and probes of an auxiliary bearing are written.
#[derive(Debug)]
pub struct Outlet<'a, R> {
    /// Channel of its first heat.
    pub heat: usize,
    /// Channel of its first source.
    pub source: usize,
    /// State of the machine.
    pub state: &'a [R],
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
            spatial: Spatial::gather(constants).map(Box::new),
            mount: WholeMount::gather(&|lane| {
                (&constants(lane).mount, &constants(lane).mount_parts)
            }),
            outer_moving_mass: lanes(&|c| c.outer_moving_mass()),
            outer_weighing_mass: lanes(&|c| c.outer_weighing_mass()),
            planes: lanes(&|c| c.planes),
            outer_held: constants(0).outer_held(),
            fixture: FixtureOver::gather(constants),
            bushing: constants(0).is_bushing(),
            inverse_inner_mass: lanes(&|c| 1.0 / c.inner_race.mass),
            inverse_outer_mass: lanes(&|c| 1.0 / c.outer_moving_mass()),
        }
    }

    /// What the bearing does between its races; writes the rates of its own states and the detail of its balls.
    #[inline(always)]
    pub fn bearing(
        &self,
        at: &BearingAt,
        (motion, held_load): (&Motion<R>, R),
        state: &[R],
        rate: &mut [R],
        probe: &mut [R],
    ) -> BearingReaction<R> {
        let looks = !probe.is_empty();
        let detail = if !looks {
            &mut [][..]
        } else {
            // a short list has room for the watched probes alone
            let end = probe
                .len()
                .min(at.detail + bearing::DETAIL_PER_BALL * at.balls);
            &mut probe[at.detail.min(end)..end]
        };
        let (state, rate) = (&state[at.own()], &mut rate[at.own()]);
        (self.bearing).react_under(motion, (held_load, looks), state, rate, detail)
    }

    /// Adds an acceleration of all bodies alike, m/s², to the rates of balls, cage and housing, after these are written; those
    /// of the races see it as gravity. Returns the power of all of them, W, and the moment about the origin on balls and cage, N m.
    #[inline(always)]
    pub fn shake(
        &self,
        at: &BearingAt,
        motion: &Motion<R>,
        by: Vec2<R>,
        state: &[R],
        rate: &mut [R],
    ) -> (R, R) {
        let own = (self.bearing).shake(by, &state[at.own()], &mut rate[at.own()]);
        let housing = (self.mount).shake(by, &state[at.of_mount()], &mut rate[at.of_mount()]);
        let races = motion.inner.velocity * self.inner_race.mass
            + motion.outer.velocity * self.outer_weighing_mass;
        (by.dot(own.momentum + housing + races), own.moment.cross(by))
    }

    /// What the mount does at a motion of the outer race, beside position and velocity of what it stands on; writes the rates of
    /// its own states.
    #[inline(always)]
    pub fn mount(
        &self,
        at: &BearingAt,
        motion: &Motion<R>,
        [position, velocity]: [Vec2<R>; 2],
        state: &[R],
        rate: &mut [R],
    ) -> MountReaction<R> {
        let outer = &motion.outer;
        let (state, rate) = (&state[at.of_mount()], &mut rate[at.of_mount()]);
        let against = (outer.position - position, outer.velocity - velocity);
        (self.mount).react(against, state, rate)
    }

    /// Writes the rates of both races and of the ledger's heats and sources, and the probes where asked, which alone see the
    /// acceleration of the node; returns the moments from outside.
    #[inline(always)]
    pub(crate) fn accelerate(
        &self,
        at: &BearingAt,
        (node, node_acceleration, acting): (&AtNode<R>, Vec2<R>, Option<&Acting<R>>),
        gravity: Vec2<R>,
        motion: &Motion<R>,
        (bearing, on_outer): (&BearingReaction<R>, &MountReaction<R>),
        into: Outlet<'_, R>,
    ) -> External<R> {
        let Outlet {
            heat,
            source,
            state,
            rate,
            probe,
        } = into;
        let zero = R::zero();
        let contact = &node.contact;
        let race = &self.inner_race;
        let (inner, outer) = (&motion.inner, &motion.outer);
        let mount = on_outer.force;

        // turn of the inner race
        let by_contact = contact.on_bore.moment;
        let (inner_moment, on_race) = match acting {
            None => (by_contact + bearing.on_inner.moment + race.torque, zero),
            Some(acting) => {
                let on_race = bearing.on_inner.moment - acting.support;
                (acting.on_race(by_contact, on_race), on_race)
            }
        };
        let mut bearing = (*bearing).with_loss(inner.spin, inner_moment);
        let inertia = race.inertia + bearing.inner_inertia;
        let inner_spin_rate = match acting {
            None if self.bushing => zero,
            None => inner_moment / inertia,
            Some(acting) => acting.spin_rate(inner_moment, inertia),
        };
        (at.inner).turn_at(rate, inner.spin, inner_spin_rate);

        // outer race: the ground holds its spin; a ring passes on what the rotor does
        if self.bushing {
            bearing.on_outer = contact.on_bore;
        }
        let outer_force = bearing.on_outer.force + mount + gravity * self.outer_weighing_mass;
        let outer_acceleration = if self.outer_held {
            Vec2::zero()
        } else {
            outer_force * self.inverse_outer_mass
        };
        (at.outer).move_at(rate, outer.velocity, outer_acceleration);
        let outer_moment = bearing.on_outer.moment - bearing.outer_inertia * inner_spin_rate;

        // inner race
        let inner_force = contact.on_bore.force + bearing.on_inner.force + gravity * race.mass;
        let inner_acceleration = if self.bushing {
            outer_acceleration
        } else if race.centre_held {
            Vec2::zero()
        } else {
            inner_force * self.inverse_inner_mass
        };
        (at.inner).move_at(rate, inner.velocity, inner_acceleration);

        // ledger
        let mut of_bearing = bearing.heat.kinds();
        of_bearing[POCKET_FRICTION] += bearing.loss_heat(inner.spin, inner_spin_rate);
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
                zero,
                zero,
                zero,
            ];
            probe[at.probe..at.probe + probe::COUNT].copy_from_slice(&values);
        }
        if let (Some(acting), Some(fixture)) = (acting, &self.fixture) {
            // copies: what a call outside of the kernel sees stays in memory
            let turned = Turned {
                motion: *motion,
                bearing,
                spin_rate: inner_spin_rate,
                needed: inertia * inner_spin_rate - on_race,
                outer_moment,
                heats: of_bearing,
                race_weight: gravity * race.mass,
                on_outer: mount + gravity * self.outer_weighing_mass,
            };
            let into = Outlet {
                heat,
                source,
                state,
                rate,
                probe,
            };
            return fixture.book(at, (acting, &turned), &self.bearing, into);
        }
        let mut heats = [zero; HEATS];
        let (kinds, rest) = heats.split_at_mut(of_bearing.len());
        kinds.copy_from_slice(&of_bearing);
        rest.copy_from_slice(&[on_outer.heat(), contact.damping_heat, contact.friction_heat]);
        rate[heat..heat + HEATS].copy_from_slice(&heats);
        rate[source] = race.torque * inner.spin;
        rate[source + 1] = bearing.growth_impulse * inner_spin_rate;

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
