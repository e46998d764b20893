//! Time integration. Knows no physics.
//!
//! A [`Machine`] is one initial value problem over `f64`; a [`Batch`] is the same problem over lanes, one machine each.
//! [`run`] advances a batch, every lane with its own step, and shows each accepted [`Step`] of each lane to an
//! [`Observer`], which samples it, looks for events on its dense output, and may end it.
//!
//! | subject | file |
//! |---|---|
//! | what a problem is | [`system`] |
//! | explicit methods, dense output | [`scheme`]; Bogacki-Shampine 3(2): [`bogacki_shampine`]; Heun 3(2) with an extended region of stability: [`heun`] |
//! | one attempted step of all lanes | [`attempt`]; what it works with: [`workspace`] |
//! | the method for stiff problems: ROS34PW2, linearly implicit | [`rosenbrock`] |
//! | one attempted linearly implicit step of all lanes, by the tangents of the problem's parts | [`implicit`] |
//! | the loop: step control, landed instants, endings | [`drive`] |
//! | one accepted step of one lane | [`step`] |
//! | roots and maxima on dense output | [`watch`] |
//!
//! Nothing in the loop allocates.

#![forbid(unsafe_code)]

pub mod attempt;
pub mod bogacki_shampine;
pub mod drive;
pub mod heun;
pub mod implicit;
pub(crate) mod method;
pub mod rosenbrock;
pub mod scheme;
pub mod step;
pub mod system;
pub mod watch;
pub mod workspace;

pub use bogacki_shampine::BOGACKI_SHAMPINE;
pub use drive::{Ending, Flow, Observer, Settings, Steps, Stop, Work, run, run_implicit};
pub use heun::HEUN;
pub use implicit::Tangents;
pub use scheme::Scheme;
pub use step::Step;
pub use system::{Batch, Machine};
