//! A bearing on a rig: its inner race is brought to speed, and its outer race stands or hangs in a housing.
//!
//! ```text
//!   drive: one of four                                     outer race: one of two
//!   - a rotor that slides in the bore under the load       - it stands, the ground takes t_O; the radial load W(t)
//!   - a torque over time                    inner race ──    presses on the inner race
//!   - a speed over time                       Ω  bearing   - it hangs in a housing under dead weight W, its spin held
//!   - a flywheel behind a clutch                             by an arm that reads t_O and some vibration
//! ```
//! The first three with an outer race that stands are the spin-up of the source paper, its (18) and (19); the flywheel with the housing is
//! its rig, Figs 5 and 6.
//!
//! | page | subject |
//! |---|---|
//! | [`layout`] | where everything stands in the state, and its names |
//! | [`rate`] | the equations of motion; those of [`drive`] and [`housing`] on their own pages |
//! | [`clutch`] | open, slipping, locked, and the changes between them |
//! | [`program`] | what is done to a rig with a clutch, and when |
//! | [`machine`], [`mode`] | the rig as the solver runs it; what holds between two landings |
//! | [`simulate`](mod@simulate) | a run |
//! | [`ramp`] | the engagement that gives a wanted acceleration |
//! | [`ledger`] | energies, momentum, what closes; the energy by the outer race, (21) |
//! | [`record`] | what is watched and kept of a run; [`taps`]: what a converter samples |
//! | [`tangents`] | what is stiff, for linearly implicit steps |
//! | [`capacity`] | whether traction can turn the balls against the steady moment |
//!
//! The race that the load presses moves in the plane, or is held in the middle: the concentric rig of the paper's equations.
//! Then the load reaches the law of the steady moment and the sliding rotor, not the balls.
//!
//! Assumes: the outer race does not turn; a sliding rotor follows the race where it translates, and what carries the load takes the
//! reaction of its friction; shaft and clutch are rigid.
//! Does not model: the rotor's own vibration (see [`machine`](super::machine)), torsion of the shaft, whirl of the overhung end,
//! slip of the belt, warming of clutch and motor.

pub mod capacity;
pub mod clutch;
pub mod constants;
pub mod drive;
pub mod housing;
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
pub mod tangents;
pub mod taps;

pub use constants::{InnerRace, RigConstants};
pub use drive::{ClutchDrive, Drag, Drive, Flywheel, Motor, SlidingRotor};
pub use housing::{Arm, Disturbance, HeatNode, Housing};
pub use machine::{Rig, RigMachine};
pub use mode::{Clutch, ClutchEvent, Mode};
pub use program::{Action, Engagement, Program, Start};
pub use ramp::{RampError, engagement_ramp};
pub use record::{Keep, Record};
pub use refusal::Refusal;
pub use simulate::simulate;
pub use taps::{Tap, Taps};
