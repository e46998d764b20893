//! The rig of the source paper (its Figs 5 and 6): a flywheel spins up a test bearing through a clutch, and an arm feels
//! what the outer race receives.
//!
//! ```text
//!     motor, belt        clutch                    outer race: housing under dead weight W, its spin held by the arm
//!          │               ││                        ║        arm: second order, reads t_O and some vibration
//!     flywheel ω_f ────────┤├──────── shaft Ω ───────╫──      inner race on the shaft, in the middle
//!          │ belt drag     ││ T        │ support     ║
//!                                      │ drag
//!   I_f ω̇_f = motor - belt - T                  motor = clamp(gain (ω_set(t) - ω_f), ± limit)
//!   I_s Ω̇   = T - support - t_I                 T: open 0; slipping ± T_c(t); locked: whatever keeps ω_f = Ω
//!   ÿ + 2ζω_n ẏ + ω_n² (y - t_O - d) = 0         d = a (|Ω|/Ω_ref)^p cos(φ + ψ)
//!   C Ṫ = heats of the bearing - C_f Θ̇ - G T     τ Ṫ_m = T - T_m           rises above the surroundings; films keep C_f Θ̇
//! ```
//! | page | subject |
//! |---|---|
//! | [`layout`] | where everything stands in the state, and its names |
//! | [`rate`] | the equations of motion |
//! | [`clutch`] | open, slipping, locked: what follows what |
//! | [`program`] | what is done to the rig, and when |
//! | [`simulate`](mod@simulate) | a run, cut where something is switched or the clutch changes |
//! | [`ramp`] | the engagement that gives a wanted acceleration |
//! | [`ledger`] | energies, momentum, what closes; the energy by the outer race, (21) |
//! | [`record`] | what is watched and kept of a run; [`taps`]: what a converter samples |
//!
//! The housing moves in the plane under its weight, or is held in the middle: the concentric rig of the paper's
//! equations. Then the load reaches the law of the steady moment, not the balls.
//!
//! Assumes: shaft and clutch rigid, the shaft's centre at rest; the outer race does not turn. That is a good assumption:
//! an arm of ω_n = 150 1/s on a housing of 2e-3 kg m² has a stiffness of 45 N m/rad, so that 25 N mm turn it by 0.6 mrad,
//! and a moment that comes within 0.1 s turns it with some 0.006 rad/s, beside 150 rad/s of the shaft; the inertia of the
//! housing is part of the arm's ω_n.
//! Does not model: torsion of the shaft, whirl of the overhung end, slip of the belt, warming of clutch and motor.

pub mod clutch;
pub mod layout;
pub mod ledger;
pub mod program;
pub mod ramp;
pub mod rate;
pub mod record;
pub mod simulate;
pub mod taps;

pub use clutch::{Clutch, ClutchEvent};
pub use program::{Action, Engagement, Program, Start};
pub use ramp::{RampError, engagement_ramp};
pub use record::Record;
pub use simulate::{RigRun, simulate, simulate_told};
pub use taps::{Tap, Taps};

use super::refusal::{self, Refusal};
use crate::bearing::ball_states::CAGE_PLACE;
use crate::bearing::{Bearing, BearingConstants, Separation};
use crate::table::Piece;
use layout::Layout;
use number::{Real, Vec2};
use solve::{Batch, Machine};
use std::fmt;

/// Constants of one rig.
#[derive(Clone, Debug, PartialEq)]
pub struct RigConstants {
    /// Flywheel, with the driven pulley and the driving half of the clutch.
    pub flywheel: Flywheel,
    /// What turns the flywheel.
    pub motor: Motor,
    /// Shaft with inner race, sleeve and the driven half of the clutch.
    pub shaft: Shaft,
    /// Housing with the outer race and its dead weight.
    pub housing: Housing,
    /// The test bearing.
    pub bearing: BearingConstants,
    /// What feels the moment on the outer race.
    pub arm: Arm,
    /// Temperature of the bearing.
    pub heat: HeatNode,
    /// What is done.
    pub program: Program,
    /// Speed that counts as reached, rad/s: scales of errors and of the record. Either sign, not 0.
    pub target_speed: f64,
}

/// A drag that opposes rotation: (constant part)·tanh(Ω/reference) + viscous·Ω.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drag {
    /// Constant part, N m; it fades at rest.
    pub constant: f64,
    /// Viscous part, N m s/rad.
    pub viscous: f64,
    /// Speed at which the constant part reaches 76 %, rad/s.
    pub reference_speed: f64,
}

impl Drag {
    /// No drag.
    pub const NONE: Drag = Drag {
        constant: 0.0,
        viscous: 0.0,
        reference_speed: 1.0,
    };
    /// The moment against the rotation at a speed (rad/s), N m, with the sign of the speed.
    #[inline]
    pub fn moment(&self, speed: f64) -> f64 {
        let fading = Real::tanh(speed / self.reference_speed);
        self.constant * fading + self.viscous * speed
    }
}

/// The flywheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flywheel {
    /// Inertia with what turns with it up to the clutch, kg m².
    pub inertia: f64,
    /// Drag of the belt and of its bearings.
    pub belt_drag: Drag,
}

/// The motor, seen at the flywheel through its belt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motor {
    /// Torque per speed that is missing, N m s/rad.
    pub gain: f64,
    /// Largest torque in either direction, N m.
    pub torque_limit: f64,
}

/// The shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shaft {
    /// Inertia with inner race, sleeve and driven half of the clutch, kg m²; without balls and cage.
    pub inertia: f64,
    /// Drag of its support bearings.
    pub support_drag: Drag,
}

/// The housing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Housing {
    /// Mass of the housing with outer race and suspended weights, kg.
    pub mass: f64,
    /// Force W that its weight and the suspended weights exert, N; not negative.
    pub load: f64,
    /// Direction of that force, a unit vector.
    pub load_direction: Vec2<f64>,
    /// Gravity on what moves with the outer race besides (cage, rolling balls), m/s². Balls that move have their own.
    pub gravity: Vec2<f64>,
    /// True where its centre is held in the middle: the concentric rig.
    pub centre_held: bool,
}

/// Torque arm or load cell: a second-order sensor of the moment on the outer race.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arm {
    /// Natural frequency ω_n, rad/s.
    pub natural_frequency: f64,
    /// Damping ratio ζ.
    pub damping_ratio: f64,
    /// Synchronous disturbance.
    pub disturbance: Disturbance,
}

/// A disturbance d = a (|Ω|/Ω_ref)^p cos(φ + ψ) that lateral vibration adds to the moment, φ the angle of the shaft. With p = 0,
/// a run-out, it is there at rest too: a cos(φ + ψ) at the angle where the shaft rests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disturbance {
    /// Amplitude a at the reference speed, N m.
    pub amplitude: f64,
    /// Reference speed Ω_ref, rad/s.
    pub reference_speed: f64,
    /// Exponent p of the speed; 2 for an unbalance well below its resonance, 0 for a run-out.
    pub exponent: f64,
    /// Phase ψ, rad.
    pub phase: f64,
}

impl Disturbance {
    /// No disturbance.
    pub const NONE: Disturbance = Disturbance {
        amplitude: 0.0,
        reference_speed: 1.0,
        exponent: 0.0,
        phase: 0.0,
    };
    /// Its value at an angle (rad) and speed (rad/s) of the shaft, N m.
    #[inline]
    pub fn moment(&self, angle: f64, speed: f64) -> f64 {
        // a run-out is there at rest too; what grows with speed is not
        let growth = if self.exponent == 0.0 {
            1.0
        } else if speed == 0.0 {
            0.0
        } else {
            Real::exp(self.exponent * Real::ln((speed / self.reference_speed).abs()))
        };
        if self.amplitude == 0.0 || growth == 0.0 {
            return 0.0;
        }
        self.amplitude * growth * Real::sin_cos(angle + self.phase).1
    }
}

/// The bearing as one lump of heat, and the thermocouple on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeatNode {
    /// Capacity C, J/K.
    pub capacity: f64,
    /// Conductance G to the surroundings, W/K.
    pub conductance: f64,
    /// Time constant τ of the thermocouple, s.
    pub thermocouple_lag: f64,
}

/// Why a rig cannot be built.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RigRefusal {
    /// The bearing.
    Bearing(Refusal),
    /// A constant, by its name, that is not finite, or not positive where it must be.
    NotPositive(&'static str),
    /// A constant, by its name, that is not finite, or negative.
    Negative(&'static str),
    /// A direction that is no unit vector.
    Direction,
    /// An action, by its index, that lies before the start, or before the one before it, or at no time.
    Order(usize),
    /// An action, by its index, with a number that has no meaning.
    Action(usize),
}

impl fmt::Display for RigRefusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RigRefusal::Bearing(why) => write!(f, "{why}"),
            RigRefusal::NotPositive(what) => write!(f, "the {what} must be a positive number"),
            RigRefusal::Negative(what) => write!(f, "the {what} must be a number and not negative"),
            RigRefusal::Direction => write!(f, "the direction of the load must be a unit vector"),
            RigRefusal::Order(index) => write!(
                f,
                "action {} of the program comes before the one above it, or before the start",
                index + 1
            ),
            RigRefusal::Action(index) => write!(
                f,
                "action {} of the program holds a number without meaning: rates and capacities are not negative, speeds finite",
                index + 1
            ),
        }
    }
}

impl std::error::Error for RigRefusal {}

impl RigConstants {
    /// Refuses what has no meaning.
    pub fn check(&self) -> Result<(), RigRefusal> {
        let positive = [
            ("inertia of the flywheel", self.flywheel.inertia),
            ("inertia of the shaft", self.shaft.inertia),
            ("natural frequency of the arm", self.arm.natural_frequency),
            (
                "reference speed of the disturbance",
                self.arm.disturbance.reference_speed,
            ),
            ("heat capacity of the bearing", self.heat.capacity),
            ("lag of the thermocouple", self.heat.thermocouple_lag),
            (
                "reference speed of the belt's drag",
                self.flywheel.belt_drag.reference_speed,
            ),
            (
                "reference speed of the support's drag",
                self.shaft.support_drag.reference_speed,
            ),
            ("size of the target speed", self.target_speed.abs()),
        ];
        let positive = positive.into_iter().chain(
            (!self.housing.centre_held).then_some(("mass of the housing", self.housing.mass)),
        );
        for (name, value) in positive {
            if !(value.is_finite() && value > 0.0) {
                return Err(RigRefusal::NotPositive(name));
            }
        }
        for (name, value) in [
            ("gain of the motor", self.motor.gain),
            ("torque limit of the motor", self.motor.torque_limit),
            (
                "constant drag of the belt",
                self.flywheel.belt_drag.constant,
            ),
            ("viscous drag of the belt", self.flywheel.belt_drag.viscous),
            (
                "constant drag of the supports",
                self.shaft.support_drag.constant,
            ),
            (
                "viscous drag of the supports",
                self.shaft.support_drag.viscous,
            ),
            ("load", self.housing.load),
            ("damping ratio of the arm", self.arm.damping_ratio),
            (
                "amplitude of the disturbance",
                self.arm.disturbance.amplitude,
            ),
            ("heat conductance of the bearing", self.heat.conductance),
        ] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(RigRefusal::Negative(name));
            }
        }
        // a hundredth of a percent: a direction written with five digits
        let length = self.housing.load_direction.length_squared();
        if !(0.9999..1.0001).contains(&length) {
            return Err(RigRefusal::Direction);
        }
        self.program.check()?;
        refusal::of_bearing(&self.bearing, Some(self.shaft.inertia)).map_err(RigRefusal::Bearing)
    }
}

/// Discrete facts, and what holds between two instants at which something is switched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// Speed the motor is set to, rad/s over s; none while it is off.
    pub motor: Option<Piece<f64>>,
    /// Capacity T_c of the clutch, N m over s.
    pub capacity: Piece<f64>,
    /// What the clutch does.
    pub clutch: Clutch,
}

/// One rig, ready to run.
#[derive(Clone, Debug)]
pub struct RigMachine {
    /// Its constants.
    pub constants: RigConstants,
    layout: Layout,
    bearing: Bearing<f64>,
    /// Cage speed per shaft speed when the balls roll.
    rolling_cage_ratio: f64,
    /// Mass that moves with the outer race, kg.
    moving_mass: f64,
    /// Force on it: dead weight, and weight of cage or rolling balls, N.
    weight: Vec2<f64>,
    error_scale: Vec<f64>,
}

impl RigMachine {
    /// A rig at its start.
    pub fn new(constants: RigConstants) -> Result<Self, RigRefusal> {
        constants.check()?;
        let layout = Layout::of(&constants.bearing);
        Ok(RigMachine {
            bearing: Bearing::gather(&|_| &constants.bearing),
            rolling_cage_ratio: constants.bearing.rolling_cage_ratio(),
            moving_mass: constants.housing.mass + constants.bearing.mass_with_outer_race(),
            weight: constants.housing.load_direction * constants.housing.load
                + constants.housing.gravity * constants.bearing.mass_with_outer_race(),
            error_scale: layout.error_scale(&constants),
            layout,
            constants,
        })
    }
    /// Where everything stands in the state.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }
    /// Name of a channel of the state.
    pub fn channel_name(&self, channel: usize) -> String {
        self.layout.channel_name(&self.constants.bearing, channel)
    }
    /// The state at the start: the bearing settled under its load, its balls rolling with the shaft, the arm settled under what
    /// disturbs it where the shaft rests.
    pub fn start(&self) -> Vec<f64> {
        let c = &self.constants;
        let mut state = vec![0.0; self.layout.dimension()];
        let own = self.layout.bearing();
        let housing = &c.housing;
        if housing.centre_held {
            c.bearing.settle(Vec2::zero(), &mut state[own.clone()]);
        } else {
            let place = settle_housing(&c.bearing, self.weight, &mut state[own.clone()]);
            state[layout::HOUSING] = place.x;
            state[layout::HOUSING + 1] = place.y;
        }
        state[layout::SHAFT + 1] = c.program.start.shaft_speed;
        state[layout::FLYWHEEL + 1] = c.program.start.flywheel_speed;
        if c.program.start.shaft_speed == 0.0 {
            state[layout::ARM] = c.arm.disturbance.moment(state[layout::SHAFT], 0.0);
        }
        if let BearingConstants::Planar(bearing) = &c.bearing {
            bearing.roll(&mut state[own], c.program.start.shaft_speed);
        }
        state
    }
    /// Inertia of balls and cage that turn with the shaft, kg m²; none where they move by their own equations.
    fn rolling_inertia(&self) -> f64 {
        match &self.constants.bearing {
            BearingConstants::Rolling(bearing) => bearing.set.inner_inertia(),
            BearingConstants::Planar(_) => 0.0,
        }
    }
    /// The rig from an instant on in a mode that stays.
    pub fn segment(&self, mode: Mode) -> Segment<'_> {
        Segment { rig: self, mode }
    }
}

/// Settles a bearing whose inner race is fixed at the origin under a force on its outer race; returns where the outer
/// race stands, m.
fn settle_housing(bearing: &BearingConstants, force: Vec2<f64>, state: &mut [f64]) -> Vec2<f64> {
    // the outer race at the origin, the inner one pushed the other way; then all of it moved back
    let place = -bearing.settle(-force, state);
    if let BearingConstants::Planar(planar) = bearing {
        for j in 0..planar.balls {
            let mut ball = planar.motion(state, j);
            let (sine, cosine) = ball.azimuth.sin_cos();
            let radial = Vec2::new(cosine, sine);
            let centre = radial * ball.radius + place;
            // the small angle between the old and the new direction
            ball.azimuth += radial.cross(centre).atan2(radial.dot(centre));
            ball.radius = centre.length_squared().sqrt();
            planar.set_motion(state, j, &ball);
        }
        if let Separation::FreeCage(_) = planar.separation {
            state[CAGE_PLACE] += place.x;
            state[CAGE_PLACE + 1] += place.y;
        }
    }
    place
}

/// A rig in a mode that stays: what the solver integrates between two instants.
#[derive(Clone, Copy, Debug)]
pub struct Segment<'a> {
    /// The rig.
    pub rig: &'a RigMachine,
    /// Its mode.
    pub mode: Mode,
}

impl Machine for Segment<'_> {
    type Mode = Mode;

    fn dimension(&self) -> usize {
        self.rig.layout.dimension()
    }
    fn quadratures(&self) -> usize {
        Layout::LEDGER
    }
    fn probes(&self) -> usize {
        self.rig.layout.probes()
    }
    fn watched_probes(&self) -> usize {
        self.rig.layout.probes_with_loads()
    }
    fn watched_channels(&self) -> usize {
        layout::FLYWHEEL + 2
    }
    fn error_scale(&self, channel: usize) -> f64 {
        self.rig.error_scale[channel]
    }
    fn channel_name(&self, channel: usize) -> String {
        self.rig.channel_name(channel)
    }
    fn start_mode(&self) -> Mode {
        self.mode
    }
    fn landings(&self) -> &[f64] {
        &[]
    }
    fn transition(&self, _landing: usize, _mode: &mut Mode, _state: &mut [f64]) {}
    fn rate(&self, mode: &Mode, time: f64, state: &[f64], rate: &mut [f64], probe: &mut [f64]) {
        let rig = self.rig;
        rig.rate_of_change(&rig.bearing, mode, time, state, rate, probe);
    }
}

/// A segment as the solver runs it; `R` is one machine whose balls are computed several at a time.
#[derive(Clone, Debug)]
pub struct SegmentRun<'a, R: Real> {
    rig: &'a RigMachine,
    bearing: Bearing<R>,
}

impl<'a, R: Real> Batch<R> for SegmentRun<'a, R> {
    type Machine = Segment<'a>;
    type Mode = Mode;

    fn gather<'b>(machine: &dyn Fn(usize) -> &'b Segment<'a>) -> Self
    where
        Segment<'a>: 'b,
    {
        assert!(R::LANES == 1, "one rig at a time");
        let rig = machine(0).rig;
        SegmentRun {
            rig,
            bearing: Bearing::gather(&|_| &rig.constants.bearing),
        }
    }
    fn gather_mode(modes: &dyn Fn(usize) -> Mode) -> Mode {
        modes(0)
    }
    #[inline(always)]
    fn rate(&self, mode: &Mode, time: R, state: &[R], rate: &mut [R], probe: &mut [R]) {
        let time = time.lane(0);
        (self.rig).rate_of_change(&self.bearing, mode, time, state, rate, probe);
    }
}
