//! The inner race of a bearing is brought to speed; the outer race stands.
//!
//! ```text
//!        rotor φ_r, ω_r ── slides in the bore, μ tanh(u/u0) W at R_0          drive: one of three
//!          │                                                                  - the sliding rotor
//!        inner race c_i, φ_i, Ω  ←── radial load W(t) in a fixed direction    - a torque over time
//!          │ bearing: balls, cage                                             - a speed over time
//!        outer race: the ground takes t_O
//!
//!   I_I Ω̇ = drive - t_I        sliding rotor: drive = R_0 μ W            (18), (19) of the source paper
//! ```
//! | page | subject |
//! |---|---|
//! | [`layout`] | where everything stands in the state, and its names |
//! | [`rate`] | the equations of motion |
//! | [`ledger`] | energies, momentum, what closes; the energy by the outer race, (21) |
//! | [`record`] | what is watched and kept of a run |
//! | [`simulate`] | a run |
//! | [`tangents`] | what is stiff, for linearly implicit steps |
//! | [`capacity`] | whether traction can turn the balls against the steady moment |
//!
//! The inner race may move in the plane under its load and weight, or be held in the middle: the concentric rig of the
//! paper's equations. Then the load reaches the law of the steady moment and the sliding rotor, not the balls.
//!
//! Assumes: the rotor follows the race where it translates; what carries the load takes the reaction of its friction.
//! Does not model: the rotor's own vibration (see [`machine`](super::machine)), clutch, shaft and torque arm.

pub mod capacity;
pub mod constants;
pub mod layout;
pub mod ledger;
pub mod rate;
pub mod record;
pub mod simulate;
pub mod tangents;

pub use super::refusal::Refusal;
use crate::bearing::Bearing;
use crate::body::put;
use crate::table::Piece;
pub use constants::{Drive, InnerRace, Mode, SlidingRotor, SpinUpConstants};
use layout::Layout;
use number::{Gather, Real, Vec2};
use solve::{Batch, Machine};

/// One machine, ready to run.
#[derive(Clone, Debug)]
pub struct SpinUpMachine {
    /// Its constants.
    pub constants: SpinUpConstants,
    layout: Layout,
    one: SpinUp<f64>,
    /// Instants at which the load or the drive changes its line.
    landings: Vec<f64>,
    error_scale: Vec<f64>,
}

/// The drive over `R`: a torque or a speed stands in the [`Mode`].
#[derive(Clone, Copy, Debug)]
enum DriveKind<R> {
    SlidingRotor(SlidingRotor<R>),
    Torque,
    Speed,
}

/// The system over `R`.
#[derive(Clone, Debug)]
pub struct SpinUp<R: Real> {
    race: InnerRace<R>,
    bearing: Bearing<R>,
    drive: DriveKind<R>,
    /// Cage speed per inner race speed when the balls roll.
    rolling_cage_ratio: R,
    layout: Layout,
}

impl SpinUpMachine {
    /// A machine at rest.
    pub fn new(constants: SpinUpConstants) -> Result<Self, Refusal> {
        constants.check()?;
        let layout = layout::of(&constants.bearing);
        Ok(SpinUpMachine {
            one: SpinUp::of(&|_| &constants, layout.clone()),
            landings: constants.landings(),
            error_scale: layout::error_scale(&layout, &constants),
            layout,
            constants,
        })
    }
    /// Where everything stands in the state.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }
    /// The state at the start: the bearing at rest under its load, a given speed at its first value.
    pub fn start(&self) -> Vec<f64> {
        let c = &self.constants;
        let mut state = vec![0.0; self.layout.dimension()];
        let own = self.layout.bearing();
        let load = if c.race.centre_held {
            Vec2::zero()
        } else {
            c.race.load_direction * c.load.value(0.0) + c.race.gravity * c.race.mass
        };
        let shift = c.bearing.settle(load, &mut state[own]);
        put(&mut state, layout::INNER.centre(), shift);
        state[layout::INNER.spin()] = c.start_speed();
        if let Drive::SlidingRotor(rotor) = &c.drive {
            state[layout::ROTOR.spin()] = rotor.speed;
        }
        state
    }
}

impl<R: Real> SpinUp<R> {
    fn of<'a>(constants: &dyn Fn(usize) -> &'a SpinUpConstants, layout: Layout) -> Self {
        let drive = match &constants(0).drive {
            Drive::SlidingRotor(_) => {
                DriveKind::SlidingRotor(Gather::<R>::gather(&|lane| match &constants(lane).drive {
                    Drive::SlidingRotor(rotor) => rotor,
                    _ => panic!("lanes share the kind of drive"),
                }))
            }
            Drive::Torque(_) => DriveKind::Torque,
            Drive::Speed(_) => DriveKind::Speed,
        };
        SpinUp {
            race: Gather::<R>::gather(&|lane| &constants(lane).race),
            bearing: Bearing::gather(&|lane| &constants(lane).bearing),
            drive,
            rolling_cage_ratio: R::from_lanes(|lane| constants(lane).bearing.rolling_cage_ratio()),
            layout,
        }
    }
}

impl Machine for SpinUpMachine {
    type Mode = Mode<f64>;

    fn dimension(&self) -> usize {
        self.layout.dimension()
    }
    fn quadratures(&self) -> usize {
        self.layout.ledger_length()
    }
    fn probes(&self) -> usize {
        self.layout.probes()
    }
    fn error_scale(&self, channel: usize) -> f64 {
        self.error_scale[channel]
    }
    fn channel_name(&self, channel: usize) -> String {
        self.layout.channel_name(channel)
    }
    fn start_mode(&self) -> Mode<f64> {
        self.constants.mode(0.0)
    }
    fn landings(&self) -> &[f64] {
        &self.landings
    }
    fn transition(&self, landing: usize, mode: &mut Mode<f64>, _state: &mut [f64]) {
        *mode = self.constants.mode(self.landings[landing]);
    }
    fn rate(
        &self,
        mode: &Mode<f64>,
        time: f64,
        state: &[f64],
        rate: &mut [f64],
        probe: &mut [f64],
    ) {
        self.one.rate_of_change(mode, time, state, rate, probe);
    }
}

impl<R: Real> Batch<R> for SpinUp<R> {
    type Machine = SpinUpMachine;
    type Mode = Mode<R>;

    fn gather<'a>(machine: &dyn Fn(usize) -> &'a SpinUpMachine) -> Self
    where
        SpinUpMachine: 'a,
    {
        let first = machine(0);
        let kind = |machine: &SpinUpMachine| std::mem::discriminant(&machine.constants.drive);
        for lane in 1..R::LANES {
            let other = machine(lane);
            assert!(other.layout == first.layout, "lanes share their layout");
            assert!(kind(other) == kind(first), "lanes share the kind of drive");
        }
        SpinUp::of(&|lane| &machine(lane).constants, first.layout.clone())
    }
    fn gather_mode(modes: &dyn Fn(usize) -> Mode<f64>) -> Mode<R> {
        let piece = |of: &dyn Fn(Mode<f64>) -> Piece<f64>| Piece {
            start: R::from_lanes(|lane| of(modes(lane)).start),
            value: R::from_lanes(|lane| of(modes(lane)).value),
            slope: R::from_lanes(|lane| of(modes(lane)).slope),
        };
        Mode {
            load: piece(&|mode| mode.load),
            drive: piece(&|mode| mode.drive),
        }
    }
    #[inline(always)]
    fn rate(&self, mode: &Mode<R>, time: R, state: &[R], rate: &mut [R], probe: &mut [R]) {
        self.rate_of_change(mode, time, state, rate, probe);
    }
}
