//! A levitated rotor falls onto its auxiliary bearing.
//!
//! ```text
//!        rotor G, φ ──(levitation, until t = 0)
//!          │ contact: clearance c0, N, friction
//!        inner race c_i, φ_i ── drive torque
//!          │ bearing: balls, cage
//!        outer race c_o ──/\/\/── ground        does not turn: the ground takes t_O
//! ```
//! | page | subject |
//! |---|---|
//! | [`layout`] | where everything stands in the state |
//! | [`rate`] | the equations of motion |
//! | [`start`] | the levitated state at release |
//! | [`ledger`] | energies, momentum, what closes |
//! | [`linear`] | the Jacobian, for linearly implicit steps |
//! | [`record`] | what is watched and kept of a run |
//!
//! Identical planes are one: the rotor's mass, polar inertia and torques are shared equally among them.

pub mod layout;
pub mod ledger;
pub mod linear;
pub mod rate;
pub mod record;
pub mod start;

use crate::bearing::{Bearing, BearingConstants};
use crate::contact::JournalContact;
use crate::levitation::Levitation;
use crate::mount::Mount;
use crate::rotor::Rotor;
use layout::Layout;
use number::{Gather, Real, Vec2, constants};
use solve::{Batch, Machine};

/// Constants of one machine.
#[derive(Clone, Debug, PartialEq)]
pub struct DropConstants {
    /// The bodies and what acts on them, except the bearing.
    pub machine: MachineConstants<f64>,
    /// The bearing.
    pub bearing: BearingConstants,
    /// Spin of the rotor at release, rad/s.
    pub speed: f64,
    /// Angle of the unbalance at release, rad.
    pub unbalance_angle: f64,
    /// Instant the brake comes on, s; infinite for never.
    pub brake_start: f64,
}

constants! {
    /// The machine without its bearing.
    pub struct MachineConstants {
        /// The rotor, its share of one plane.
        rotor: Rotor<R>,
        /// Levitation, active before release only.
        levitation: Levitation<R>,
        /// Rotor against inner race.
        contact: JournalContact<R>,
        /// Mount of the outer race.
        mount: Mount<R>,
        /// Mass of inner race and sleeve, kg.
        inner_race_mass: R,
        /// Polar inertia of inner race and sleeve, kg m².
        inner_race_inertia: R,
        /// True where the centre of the inner race is held; it may still turn.
        inner_race_centre_held: bool,
        /// Torque of a drive on the inner race, N m.
        inner_race_torque: R,
        /// Mass of the outer race with its housing, kg.
        outer_race_mass: R,
        /// Gravity, m/s².
        gravity: Vec2<R>,
    }
}

/// Discrete facts of a machine: 1 for on, 0 for off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode<R> {
    /// Levitation.
    pub levitation: R,
    /// Brake of the rotor.
    pub brake: R,
}

/// One machine, ready to run.
#[derive(Clone, Debug)]
pub struct DropMachine {
    /// Its constants.
    pub constants: DropConstants,
    layout: Layout,
    one: Drop<f64>,
    landings: Vec<f64>,
    error_scale: Vec<f64>,
    levitated: bool,
}

/// The system over `R`.
#[derive(Clone, Debug)]
pub struct Drop<R: Real> {
    machine: MachineConstants<R>,
    bearing: Bearing<R>,
    outer_moving_mass: R,
    inverse: Inverses<R>,
    layout: Layout,
}

/// Reciprocals of masses and inertias, because a division costs as much as ten products.
#[derive(Clone, Copy, Debug)]
struct Inverses<R> {
    rotor_mass: R,
    rotor_polar_inertia: R,
    inner_race_mass: R,
    outer_moving_mass: R,
}

impl DropMachine {
    /// A machine whose levitation has just been lost.
    pub fn new(constants: DropConstants) -> Self {
        Self::with_levitation(constants, false)
    }
    /// A machine, levitated or not.
    pub fn with_levitation(constants: DropConstants, levitated: bool) -> Self {
        let layout = Layout::of(&constants.bearing);
        let brakes = constants.brake_start > 0.0 && constants.brake_start.is_finite();
        DropMachine {
            one: Drop::of(&|_| &constants, layout),
            landings: if brakes {
                vec![constants.brake_start]
            } else {
                Vec::new()
            },
            error_scale: layout.error_scale(&constants),
            layout,
            levitated,
            constants,
        }
    }
    /// Where everything stands in the state.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }
}

impl<R: Real> Drop<R> {
    fn of<'a>(constants: &dyn Fn(usize) -> &'a DropConstants, layout: Layout) -> Self {
        let inverse =
            |of: &dyn Fn(&DropConstants) -> f64| R::from_lanes(|lane| 1.0 / of(constants(lane)));
        Drop {
            machine: Gather::<R>::gather(&|lane| &constants(lane).machine),
            bearing: Bearing::gather(&|lane| &constants(lane).bearing),
            outer_moving_mass: R::from_lanes(|lane| constants(lane).outer_moving_mass()),
            inverse: Inverses {
                rotor_mass: inverse(&|c| c.machine.rotor.mass),
                rotor_polar_inertia: inverse(&|c| c.machine.rotor.polar_inertia),
                inner_race_mass: inverse(&|c| c.machine.inner_race_mass),
                outer_moving_mass: inverse(&|c| c.outer_moving_mass()),
            },
            layout,
        }
    }
}

impl DropConstants {
    /// Mass that translates with the outer race, kg.
    pub fn outer_moving_mass(&self) -> f64 {
        self.machine.outer_race_mass + self.bearing.mass_with_outer_race()
    }
    /// Chooses where the mount's spring is free so that it carries the bearing's weight with the outer race at the
    /// origin. The weight of an inner race whose centre is held rests elsewhere.
    pub fn balance_mount(&mut self) {
        let inner = if self.machine.inner_race_centre_held {
            0.0
        } else {
            self.machine.inner_race_mass
        };
        let mass = self.outer_moving_mass() + self.bearing.free_mass() + inner;
        let mount = &mut self.machine.mount;
        mount.free_position = -(self.machine.gravity * (mass / mount.stiffness));
    }
}

impl Machine for DropMachine {
    type Mode = Mode<f64>;

    fn dimension(&self) -> usize {
        self.layout.dimension()
    }
    fn quadratures(&self) -> usize {
        Layout::LEDGER
    }
    fn probes(&self) -> usize {
        self.layout.probes()
    }
    fn watched_probes(&self) -> usize {
        self.layout.watched_probes()
    }
    fn watched_channels(&self) -> usize {
        self.layout.watched_channels()
    }
    fn error_scale(&self, channel: usize) -> f64 {
        self.error_scale[channel]
    }
    fn channel_name(&self, channel: usize) -> String {
        self.layout.channel_name(&self.constants.bearing, channel)
    }
    fn start_mode(&self) -> Mode<f64> {
        Mode {
            levitation: f64::from(u8::from(self.levitated)),
            brake: f64::from(u8::from(self.constants.brake_start <= 0.0)),
        }
    }
    fn landings(&self) -> &[f64] {
        &self.landings
    }
    fn transition(&self, _landing: usize, mode: &mut Mode<f64>, _state: &mut [f64]) {
        mode.brake = 1.0;
    }
    fn rate(
        &self,
        mode: &Mode<f64>,
        _time: f64,
        state: &[f64],
        rate: &mut [f64],
        probe: &mut [f64],
    ) {
        self.one.rate_of_change(mode, state, rate, probe);
    }
}

impl<R: Real> Batch<R> for Drop<R> {
    type Machine = DropMachine;
    type Mode = Mode<R>;

    fn gather<'a>(machine: &dyn Fn(usize) -> &'a DropMachine) -> Self
    where
        DropMachine: 'a,
    {
        let layout = machine(0).layout;
        for lane in 1..R::LANES {
            assert!(machine(lane).layout == layout, "lanes share their layout");
        }
        Drop::of(&|lane| &machine(lane).constants, layout)
    }
    fn gather_mode(modes: &dyn Fn(usize) -> Mode<f64>) -> Mode<R> {
        Mode {
            levitation: R::from_lanes(|lane| modes(lane).levitation),
            brake: R::from_lanes(|lane| modes(lane).brake),
        }
    }
    #[inline(always)]
    fn rate(&self, mode: &Mode<R>, _time: R, state: &[R], rate: &mut [R], probe: &mut [R]) {
        self.rate_of_change(mode, state, rate, probe);
    }
}
