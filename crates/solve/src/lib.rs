//! Time integration. Knows no physics.
//!
//! A [`Machine`] is one initial value problem over `f64`; a [`Batch`] is the same problem over lanes, one machine each.
//! A [`Stepper`] advances a batch, every lane with its own step, and shows each accepted [`Step`] of each lane to an
//! [`Observer`], which samples it, looks for events on its dense output, and may end it; [`run`] does so from start to end.
//!
//! | subject | file |
//! |---|---|
//! | what a problem is | [`system`] |
//! | explicit methods, dense output | [`scheme`]; Bogacki-Shampine 3(2): [`bogacki_shampine`]; Heun 3(2) with an extended region of stability: [`heun`] |
//! | one attempted step of all lanes | [`attempt`]; what it works with: [`workspace`] |
//! | the method for stiff problems: ROS34PW2, linearly implicit | [`rosenbrock`] |
//! | one attempted linearly implicit step of all lanes, by the tangents of the problem's parts | [`implicit`] |
//! | lanes driven step by step: step control, landed instants, pauses | [`stepper`], `lane` |
//! | instants at which something in the state switches | `state_event` |
//! | many machines from start to end; observers | [`drive`] |
//! | one accepted step of one lane | [`step`] |
//! | roots and maxima on dense output | [`watch`] |
//!
//! Nothing in the loop allocates.

#![forbid(unsafe_code)]
#![deny(clippy::disallowed_methods, clippy::disallowed_types)]

pub mod attempt;
pub mod bogacki_shampine;
pub mod drive;
pub mod heun;
pub mod implicit;
mod lane;
pub(crate) mod method;
pub mod rosenbrock;
pub mod scheme;
mod state_event;
pub mod step;
pub mod stepper;
pub mod system;
pub mod watch;
pub mod workspace;

pub use attempt::Explicit;
pub use bogacki_shampine::BOGACKI_SHAMPINE;
pub use drive::{Ending, Flow, Observer, Settings, Steps, Stop, Work, run, run_implicit};
pub use heun::HEUN;
pub use implicit::{Implicit, Tangents};
pub use lane::Held;
pub use scheme::Scheme;
pub use step::Step;
pub use stepper::{Pause, Saved, Start, Stepper};
pub use system::{Batch, Machine};
