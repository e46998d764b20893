//! What happens when a magnetically levitated rotor falls onto its auxiliary rolling bearings.
//!
//! A [`scenario::Scenario`] is read and checked, [`run::run`] computes it, and the results are plain data
//! ([`outcome::Outcome`]) that [`report`] writes and draws.
//!
//! ```
//! use auxbear::scenario::{BuiltIn, Scenario, template};
//! use auxbear::run::{Options, run};
//! use std::sync::atomic::AtomicBool;
//!
//! let text = template("drop").unwrap();
//! let short = [String::from("run.duration=12 ms")];
//! let scenario = Scenario::parse(&text, "template", &short, &BuiltIn).unwrap();
//! let outcome = run(&scenario, &Options::unwatched(&AtomicBool::new(false))).unwrap();
//! assert!(outcome.stop.complete());
//! ```

#![forbid(unsafe_code)]

pub use catalogue;
pub use import;
pub use measure;
pub use outcome;
pub use physics;
pub use problem;
pub use recording;
pub use report;
pub use run::{self, study};
pub use scenario;
pub use simulate;
pub use units;
