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
//! | [`constants`] | the rig as constants of a [`machine`](super::machine): its rotor is what drives the race |
//! | [`layout`] | where its parts stand in the state; its probes |
//! | [`fixture`] | the equations of what turns, loads and carries the bearing; [`drive`] and [`housing`]: its constants |
//! | [`clutch`] | open, slipping, locked, and the changes between them |
//! | [`program`] | what is done to a rig with a clutch, and when |
//! | [`mode`] | what motor and clutch do between two landings |
//! | `start` | the bearing settled under its load |
//! | [`ramp`] | the engagement that gives a wanted acceleration |
//! | [`record`] | what is watched besides the bearing; [`taps`]: what a converter samples |
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
pub mod fixture;
pub mod housing;
pub mod layout;
pub mod mode;
pub mod program;
pub mod ramp;
pub mod record;
pub mod refusal;
mod start;
pub mod taps;

pub use constants::RigConstants;
pub use drive::{ClutchDrive, Drag, Drive, Flywheel, Motor, SlidingRotor};
pub use fixture::Fixture;
pub use housing::{Arm, Disturbance, HeatNode, Housing};
pub use mode::{Clutch, ClutchEvent, ClutchMode};
pub use program::{Action, Engagement, Program, Start};
pub use ramp::{RampError, engagement_ramp};
pub use record::RigRecord;
pub use refusal::Refusal;
pub use taps::{Tap, Taps};
