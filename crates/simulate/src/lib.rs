//! From a scenario to a simulation: one folder a system, written alike, and what their bearings share.
//!
//! | folder | subject |
//! |---|---|
//! | [`bearing`] | the bearing of every system: its constants, results, columns, warnings |
//! | [`mod@drop`] | a rotor falls onto its auxiliary bearing |
//! | [`spin_up`] | the inner race is brought to speed |
//! | [`rig`] | a test on a rig, and what its logger would have written |
//! | [`coast_down`] | a rotor coasts down on its warming bearings, in quasi-steady steps |
//! | [`rotor`] | the model of a flexible rotor and its magnets |
//! | `levitated` | levitations that do not hold their rotor |
//! | `stepping` | which steps a run takes, and how exact they are |
//! | [`ensemble`] | runs machines, in lanes and threads |
//! | `following` | what of a machine follows the temperatures of its bearings |
//! | [`simulation`] | a machine that is driven from outside, from stop to stop |
//! | [`drop::driven`] | a drop that is driven from outside without its controllers, with all that its run shows |
//! | `watch` | what sees the steps of a machine |
//! | `ending` | settings of the integration, and how a run ended |

#![forbid(unsafe_code)]
#![deny(clippy::disallowed_methods, clippy::disallowed_types)]

pub mod assumptions;
pub mod bearing;
pub mod coast_down;
pub mod drawing;
pub mod drop;
pub mod ending;
pub mod ensemble;
mod following;
pub mod levitated;
pub mod rig;
pub mod rotor;
pub mod simulation;
pub mod spin_up;
pub mod static_safety;
pub mod stepping;
mod watch;
