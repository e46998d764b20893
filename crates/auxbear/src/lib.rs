//! What happens when a magnetically levitated rotor falls onto its auxiliary rolling bearings.
//!
//! A [`scenario::Scenario`] is read and checked, [`run::run`] computes it, and the results are plain data
//! ([`result::outcome::Outcome`]) that [`report`] writes and draws.
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
//!
//! Modules, each using only those before it: [`scenario`], [`options`], [`result`], then
//! [`simulate`], [`analyse`] and [`evaluate`] side by side, [`mod@run`], [`mod@study`], [`report`], [`import`].

#![forbid(unsafe_code)]

pub mod analyse;
pub mod evaluate;
pub mod import;
pub mod options;
pub mod report;
pub mod result;
pub mod run;
pub mod scenario;
pub mod simulate;
pub mod study;

pub use catalogue;
pub use measure;
pub use physics;
pub use problem;
pub use recording;
pub use units;
