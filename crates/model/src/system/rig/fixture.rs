//! What turns, loads and carries a bearing on a rig, in its equations.
//!
//! ```text
//!   sliding rotor   u = R_0 (ω_r - Ω),  S = μ tanh(u/u0) W,  drive = R_0 S          I_r ω̇_r = -R_0 S, or held: a source
//!   torque          drive = τ(t)
//!   speed           Ω̇ given,  drive = (I_I + J + j) Ω̇ - free
//!   clutch          open 0;  slipping ± T_c(t);  locked: whatever keeps ω_f = Ω     I_f ω̇_f = motor - belt - T
//!                   motor = clamp(gain (ω_set(t) - ω_f), ± limit)
//!
//!   (I_I + J + j) Ω̇ = drive - support + free        see auxiliary_bearing.rs
//!   without housing   m_i c̈_i = W d + S t + bearing + m g    or held
//!   with it           m_o c̈_o = W d + bearing + m' g         or held
//!
//!   t_I = (J + j) Ω̇ - free,   t_O = moment of the bearing on the outer race
//!   d: direction of the load W, t: d turned +90°;  a sliding rotor touches the bore at c_i + R_0 d
//!   without housing   W d + S t on the inner race;  the outer race stands at the origin
//!   with it           W d + m' g on the outer race; the inner race turns about the origin, the arm takes t_O as a pure couple
//! ```
//! free: moment of the bearing on the race but for -(J + j) Ω̇, less the drag of the support. Heats are ≥ 0: S u, or T (ω_f - Ω), and
//! the drags times their speeds. Sources: the load with the friction it presses, (W d + S t)·ċ_i or (W d + m' g)·ċ_o, the drives, the
//! growth of the inner race. What balls and cage receive: t_I - t_O - t_g + weights + c_i × F_i + c_o × F_o, F of the races on them.
//!
//! Does not model: torsion of shaft and sleeve, the rotor's place in its clearance.

use super::layout::{
    ACCELERATION, ARM, ARM_RATE, BEARING_HEAT, BELT_DRAG, CAGE_SLIP, CAGE_SPEED, CLUTCH_CAPACITY,
    CLUTCH_SLIP, DETAIL, DISTURBANCE, DRIVE_MOMENT, DRIVER_ACCELERATION, INNER_FORCE,
    INNER_LOAD_SUM, INNER_MOMENT, MEASURED, MOMENTUM_RATE, MOTOR_TORQUE, OUTER_MOMENT,
    STEADY_MOMENT, SUPPORT_DRAG, TEMPERATURE, THERMOCOUPLE,
};
use super::{Clutch, Drive, Housing};
use crate::auxiliary_bearing::{AuxiliaryBearingConstants, BearingAt, External, Outlet, Turned};
use crate::bearing::{Bearing, BearingConstants};
use crate::contact::{ContactReaction, JournalContact};
use crate::motion::Wrench;
use crate::system::machine::Mode;
use crate::table::{Piece, Table};
use number::{Gather, Real, Vec2, Vectorized};

/// What turns, loads and carries a bearing on a rig.
#[derive(Clone, Debug, PartialEq)]
pub struct Fixture {
    /// What turns the inner race.
    pub drive: Drive,
    /// Radial load W over time, N over s; not negative: on the inner race, or by the housing on the outer one.
    pub load: Table,
    /// Direction of the radial load, a unit vector.
    pub load_direction: Vec2<f64>,
    /// What carries the outer race and feels its moment; without it that race stands at the origin.
    pub housing: Option<Housing>,
}

impl Fixture {
    /// Load and drive, a torque or a speed, from an instant until the next landing; zero where neither is given.
    pub(in crate::system) fn pieces(&self, time: f64) -> [Piece<f64>; 2] {
        let drive = match &self.drive {
            Drive::Torque(table) | Drive::Speed(table) => table.piece(time),
            Drive::SlidingRotor(_) | Drive::Clutch(_) => Table::constant(0.0).piece(time),
        };
        [self.load.piece(time), drive]
    }
}

/// A fixture over `R`: load, torque and speed stand in the [`Mode`]; clutch and housing are those of one machine.
#[derive(Clone, Debug)]
pub(crate) struct FixtureOver<R: Real> {
    /// That of the first lane.
    pub(crate) own: Fixture,
    load_direction: Vec2<R>,
    /// Whether both races stay in the middle: the load does not reach the balls.
    concentric: bool,
    /// The bearing of the first lane, for what its films keep.
    bearing: BearingConstants,
    rolling_cage_ratio: R,
}

/// How the inner race turns.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Turning<R> {
    /// By the moments on it.
    Free,
    /// With this acceleration, rad/s².
    Given(R),
    /// With a flywheel of this inertia, kg m², on which this moment acts, N m.
    Locked { inertia: R, moment: R },
}

/// What acts at an instant before the bearing answers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Acting<R> {
    /// Of rotor and race: the radial load with the friction that it presses, or the clutch where it slips.
    pub contact: ContactReaction<R>,
    /// Force on the outer race, N.
    pub on_outer: Vec2<R>,
    /// Part of the radial load that moves nothing, N.
    pub held_load: R,
    pub turning: Turning<R>,
    /// Torque on the race, of motor, belt and supports, N m.
    pub torque: R,
    pub motor: R,
    pub belt: R,
    pub support: R,
    /// Capacity of the clutch, N m.
    capacity: R,
    /// Spin of the rotor, rad/s.
    driver: R,
}

impl<R: Real> Acting<R> {
    /// Everything on what turns, N m, or a quantity with its sign, from the moments of contact and bearing.
    #[inline(always)]
    pub fn on_race(&self, by_contact: R, by_bearing: R) -> R {
        match self.turning {
            Turning::Free => by_contact + self.torque + by_bearing,
            Turning::Given(rate) => rate,
            Turning::Locked { moment, .. } => moment + by_bearing,
        }
    }
    /// Acceleration of a race of that inertia, balls included, under everything on it, rad/s².
    #[inline(always)]
    pub fn spin_rate(&self, all: R, inertia: R) -> R {
        match self.turning {
            Turning::Free => all / inertia,
            Turning::Given(rate) => rate,
            Turning::Locked { inertia: own, .. } => all / (own + inertia),
        }
    }
    /// Moment of the drive on the race, and torque from the ground there, N m; `needed` is what turns the race besides the bearing.
    #[inline(always)]
    pub fn moments(&self, by_contact: R, needed: R) -> [R; 2] {
        match self.turning {
            Turning::Free => [by_contact + self.torque, self.torque - self.support],
            Turning::Given(_) => [needed, needed],
            Turning::Locked { .. } => [needed, -self.support],
        }
    }
}

impl<R: Real> FixtureOver<R> {
    /// One fixture per lane; none in a machine.
    pub fn gather<'a>(constants: &dyn Fn(usize) -> &'a AuxiliaryBearingConstants) -> Option<Self> {
        let lanes = |lane: usize| constants(lane).fixture.as_ref();
        let own = lanes(0)?;
        let one = own.housing.is_some() || matches!(own.drive, Drive::Clutch(_));
        assert!(!one || R::LANES == 1, "one clutch or housing at a time");
        Some(FixtureOver {
            load_direction: Gather::<R>::gather(&|lane| {
                let fixture = lanes(lane).expect("lanes share the presence of a rig");
                &fixture.load_direction
            }),
            concentric: constants(0).is_concentric(),
            bearing: constants(0).bearing.clone(),
            rolling_cage_ratio: R::from_lanes(|lane| constants(lane).bearing.rolling_cage_ratio()),
            own: own.as_ref().clone(),
        })
    }

    /// What acts at an instant, with the spins of rotor and inner race.
    #[inline(always)]
    pub fn act(
        &self,
        mode: &Mode<R>,
        time: R,
        spins: [R; 2],
        bore: &JournalContact<R>,
    ) -> Acting<R> {
        R::vectorized(Act {
            fixture: self,
            mode,
            time,
            spins,
            bore,
        })
    }

    #[inline(always)]
    fn acting(
        &self,
        mode: &Mode<R>,
        time: R,
        [driver, speed]: [R; 2],
        bore: &JournalContact<R>,
    ) -> Acting<R> {
        let zero = R::zero();
        let load = mode.load.at(time);
        let along_load = self.load_direction * load;
        let mut pressed = along_load;
        let (mut moment, mut friction, mut slip) = (zero, zero, zero);
        let mut acting = Acting {
            contact: ContactReaction::none(),
            on_outer: Vec2::zero(),
            held_load: if self.concentric { load } else { zero },
            turning: Turning::Free,
            torque: zero,
            motor: zero,
            belt: zero,
            support: zero,
            capacity: zero,
            driver,
        };
        match &self.own.drive {
            Drive::SlidingRotor(_) => {
                slip = bore.bore_radius * (driver - speed);
                let coefficient = bore.friction * (slip * bore.inverse_reference_speed).tanh();
                friction = coefficient * load;
                moment = bore.bore_radius * friction;
                pressed += self.load_direction.turned() * friction;
                acting.contact.friction_heat = friction * slip;
            }
            Drive::Torque(_) => acting.torque = mode.drive.at(time),
            Drive::Speed(_) => acting.turning = Turning::Given(mode.drive.slope),
            Drive::Clutch(drive) => {
                let plain = R::splat;
                if let Some(set) = &mode.clutch.motor {
                    let limit = plain(drive.motor.torque_limit);
                    let missing = plain(set.at(time.lane(0))) - driver;
                    let wanted = plain(drive.motor.gain) * missing;
                    acting.motor = wanted.max(-limit).min(limit);
                }
                acting.belt = drive.flywheel.belt_drag.moment(driver);
                acting.support = drive.support_drag.moment(speed);
                acting.capacity = plain(mode.clutch.capacity.at(time.lane(0)));
                match mode.clutch.state {
                    Clutch::Open => {}
                    Clutch::Slipping { direction } => {
                        moment = plain(direction) * acting.capacity;
                        acting.contact.friction_heat = moment * (driver - speed);
                    }
                    Clutch::Locked => {
                        acting.turning = Turning::Locked {
                            inertia: plain(drive.flywheel.inertia),
                            moment: acting.motor - acting.belt,
                        };
                    }
                }
            }
        }
        let contact = &mut acting.contact;
        contact.on_bore.moment = moment;
        contact.on_journal = Wrench::planar(Vec2::zero(), -moment);
        (contact.normal_force, contact.friction_force) = (load, -friction);
        contact.slip_speed = -slip;
        match self.own.housing {
            None => contact.on_bore.force = pressed,
            Some(_) if self.concentric => {}
            Some(_) => acting.on_outer = along_load,
        }
        acting
    }

    /// Writes heats, sources and the works by the moments on the races, the rates of arm and temperatures, and probes where asked; returns
    /// the moments from outside.
    #[inline(always)]
    pub fn book(
        &self,
        at: &BearingAt,
        of: (&Acting<R>, &Turned<R>),
        bearing: &Bearing<R>,
        into: Outlet<'_, R>,
    ) -> External<R> {
        R::vectorized(Book {
            fixture: self,
            at,
            of,
            bearing,
            into,
        })
    }

    #[inline(always)]
    fn booked(
        &self,
        at: &BearingAt,
        (acting, turned): (&Acting<R>, &Turned<R>),
        bearing: &Bearing<R>,
        into: Outlet<'_, R>,
    ) -> External<R> {
        let Outlet { state, rate, .. } = into;
        let (zero, reaction) = (R::zero(), &turned.bearing);
        if let Turning::Locked { .. } = acting.turning {
            rate[at.driver] = turned.spin_rate;
        }
        let (inner, outer) = (&turned.motion.inner, &turned.motion.outer);
        let pressed = [acting.contact.on_bore.force, turned.on_outer];
        let by_contact = acting.contact.on_bore.moment;
        let [moment, from_ground] = acting.moments(by_contact, turned.needed);
        let work_of_load = pressed[0].dot(inner.velocity) + pressed[1].dot(outer.velocity);
        let (speed, spin_rate) = (inner.spin, turned.spin_rate);
        let inner_moment = reaction.inner_inertia * spin_rate - reaction.on_inner.moment;
        let outer_moment = turned.outer_moment;
        let own_heats = turned.heats;
        let bearing_heat = own_heats.iter().fold(zero, |sum, heat| sum + *heat);
        let growth = reaction.growth_impulse * spin_rate;

        let of_drive = into.heat + own_heats.len();
        rate[into.heat..of_drive].copy_from_slice(&own_heats);
        let drive_heats = [
            acting.contact.friction_heat,
            acting.belt * acting.driver,
            acting.support * speed,
        ];
        let count = into.source - of_drive;
        rate[of_drive..into.source].copy_from_slice(&drive_heats[..count]);
        let source = into.source;
        let impulse = match &self.own.drive {
            Drive::Clutch(_) => {
                rate[source] = acting.motor * acting.driver;
                rate[source + 1] = work_of_load;
                rate[source + 2] = growth;
                source + 3
            }
            // the work on the rotor stands in the second
            _ => {
                rate[source] = work_of_load;
                rate[source + 2] = from_ground * speed;
                rate[source + 3] = growth;
                source + 4
            }
        };
        // of the races on the balls
        let [inner_force, outer_force] = [-reaction.on_inner.force, -reaction.on_outer.force];
        let eccentric = reaction.external_moment
            + inner.position.cross(inner_force)
            + outer.position.cross(outer_force);
        let momentum = bearing.angular_momentum_rate(&state[at.own()], &rate[at.own()], spin_rate);
        let mut disturbance = zero;
        let mut work = impulse + 1;
        if let Some(housing) = &self.own.housing {
            rate[work] = inner_moment - outer_moment + eccentric;
            work += 1;
            disturbance = self.read(housing, at, [outer_moment, bearing_heat], (state, rate));
        }
        rate[work] = inner_moment * speed;
        rate[work + 1] = outer_moment * speed;
        rate[work + 2] = momentum * speed;
        rate[work + 3] = inner_force.dot(inner.velocity) + outer_force.dot(outer.velocity)
            - eccentric * speed
            + growth;

        let probe = into.probe;
        if !probe.is_empty() {
            let cage_speed = rate[at.bearing];
            let rolling = speed * self.rolling_cage_ratio;
            let turns = rolling.abs().greater(zero);
            let safe = R::select(turns, rolling, R::one());
            let mut load_sum = zero;
            for load in &probe[DETAIL..DETAIL + at.balls] {
                load_sum += *load;
            }
            let slip = R::select(turns, R::one() - cage_speed / safe, zero);
            let values: [(usize, R); MEASURED] = [
                (INNER_MOMENT, inner_moment),
                (OUTER_MOMENT, outer_moment),
                (STEADY_MOMENT, reaction.steady_moment),
                (DRIVE_MOMENT, moment),
                (ACCELERATION, spin_rate),
                (INNER_FORCE, inner_force.length_squared().sqrt()),
                (CAGE_SPEED, cage_speed),
                (CAGE_SLIP, slip),
                (INNER_LOAD_SUM, load_sum),
                (DRIVER_ACCELERATION, rate[at.driver]),
                (CLUTCH_CAPACITY, acting.capacity),
                (CLUTCH_SLIP, acting.driver - speed),
                (MOTOR_TORQUE, acting.motor),
                (BELT_DRAG, acting.belt),
                (SUPPORT_DRAG, acting.support),
                (DISTURBANCE, disturbance),
                (BEARING_HEAT, bearing_heat),
                (MOMENTUM_RATE, momentum),
            ];
            for (index, value) in values {
                probe[index] = value;
            }
        }
        // the load comes from outside, with the weight of what it does not count
        External {
            weights: [zero; 2],
            others: [
                from_ground,
                inner.position.cross(pressed[0] + turned.race_weight),
                reaction.external_moment,
                -outer_moment,
                outer.position.cross(pressed[1]),
            ],
        }
    }

    /// The rates of arm and temperatures; what vibration adds to the moment that the arm feels, N m.
    #[inline(always)]
    fn read(
        &self,
        housing: &Housing,
        at: &BearingAt,
        [outer_moment, bearing_heat]: [R; 2],
        (state, rate): (&[R], &mut [R]),
    ) -> R {
        let (arm, heat) = (&housing.arm, &housing.heat);
        let (angle, speed) = (
            state[at.inner.angle()].lane(0),
            state[at.inner.spin()].lane(0),
        );
        let disturbance = R::splat(arm.disturbance.moment(angle, speed));
        let frequency = R::splat(arm.natural_frequency);
        let off = outer_moment + disturbance - state[ARM];
        rate[ARM] = state[ARM_RATE];
        rate[ARM_RATE] =
            frequency * (frequency * off - R::splat(2.0 * arm.damping_ratio) * state[ARM_RATE]);
        let kept = self.bearing.kept_by_films(&rate[at.own()]);
        let given = R::splat(heat.conductance) * state[TEMPERATURE];
        rate[TEMPERATURE] = (bearing_heat - kept - given) / R::splat(heat.capacity);
        rate[THERMOCOUPLE] =
            (state[TEMPERATURE] - state[THERMOCOUPLE]) / R::splat(heat.thermocouple_lag);
        disturbance
    }
}

/// What acts, as a task: it is compiled for itself, so that a machine without a rig does not pay for it.
struct Act<'a, R: Real> {
    fixture: &'a FixtureOver<R>,
    mode: &'a Mode<R>,
    time: R,
    spins: [R; 2],
    bore: &'a JournalContact<R>,
}

impl<R: Real> Vectorized for Act<'_, R> {
    type Output = Acting<R>;
    #[inline(always)]
    fn run(self) -> Acting<R> {
        (self.fixture).acting(self.mode, self.time, self.spins, self.bore)
    }
}

/// What is booked, as a task like [`Act`].
struct Book<'a, 'o, R: Real> {
    fixture: &'a FixtureOver<R>,
    at: &'a BearingAt,
    of: (&'a Acting<R>, &'a Turned<R>),
    bearing: &'a Bearing<R>,
    into: Outlet<'o, R>,
}

impl<R: Real> Vectorized for Book<'_, '_, R> {
    type Output = External<R>;
    #[inline(always)]
    fn run(self) -> External<R> {
        (self.fixture).booked(self.at, self.of, self.bearing, self.into)
    }
}
