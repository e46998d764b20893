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
//! | [`machine`], [`mode`] | the rig as the solver runs it; what holds between two switchings, and how far the program has come |
//! | [`simulate`](mod@simulate) | a run |
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
pub mod constants;
pub mod layout;
pub mod ledger;
pub mod machine;
pub mod mode;
pub mod program;
pub mod ramp;
pub mod rate;
pub mod record;
pub mod refusal;
pub mod simulate;
pub mod taps;

pub use constants::{
    Arm, Disturbance, Drag, Flywheel, HeatNode, Housing, Motor, RigConstants, Shaft,
};
pub use machine::{Rig, RigMachine};
pub use mode::{Clutch, ClutchEvent, Mode};
pub use program::{Action, Engagement, Program, Start};
pub use ramp::{RampError, engagement_ramp};
pub use record::Record;
pub use refusal::RigRefusal;
pub use simulate::simulate;
pub use taps::{Tap, Taps};
