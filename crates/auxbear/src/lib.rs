//! What happens when a magnetically levitated rotor falls onto its auxiliary rolling bearings.
//!
//! A [`Scenario`] is read and checked, [`run()`] computes it, and the [`Outcome`] is plain data in SI units: results, columns over time,
//! warnings, limits with their verdicts. Wrong input is a [`Problem`] with file, line and key, never a panic.
//!
//! # Load and run
//!
//! ```
//! use auxbear::{BuiltIn, Options, Scenario, run, template};
//! use std::sync::atomic::AtomicBool;
//!
//! # fn main() -> Result<(), Box<auxbear::Problem>> {
//! // a starting file; Scenario::read takes one from the disk
//! let text = template("drop").unwrap();
//! let short = [String::from("run.duration=12 ms")];
//! let scenario = Scenario::parse(&text, "drop.toml", &short, &BuiltIn)?;
//! let outcome = run(&scenario, &Options::unwatched(&AtomicBool::new(false)))?;
//! assert!(outcome.stop.complete());
//! let force = outcome.number("first_impact_force").unwrap();
//! assert!(force > 100.0, "{force} N");
//! for warning in &outcome.warnings {
//!     println!("{}: {}", warning.code, warning.text);
//! }
//! # Ok(())
//! # }
//! ```
//!
//! # Set values, and repeat
//!
//! ```
//! use auxbear::{BuiltIn, Options, Scenario, run, template};
//! use std::sync::atomic::AtomicBool;
//!
//! # fn main() -> Result<(), Box<auxbear::Problem>> {
//! let text = template("drop").unwrap();
//! let sets = ["run.duration=12 ms", "rotor.speed=9000 rpm", "repeat.count=4"].map(String::from);
//! let scenario = Scenario::parse(&text, "drop.toml", &sets, &BuiltIn)?;
//! let outcome = run(&scenario, &Options::unwatched(&AtomicBool::new(false)))?;
//! // the unbalance points elsewhere in each member
//! let spread = outcome.quantity("first_impact_force").unwrap().spread.as_ref().unwrap();
//! assert!(spread.smallest < spread.largest);
//! // the same file with another value
//! let faster = scenario.with(&[("rotor.speed".to_string(), "12000 rpm".to_string())])?;
//! assert!(faster.drop().unwrap().rotor.speed > scenario.drop().unwrap().rotor.speed);
//! # Ok(())
//! # }
//! ```
//!
//! # Step with inputs
//!
//! ```
//! use auxbear::{BuiltIn, Input, Scenario, build, template};
//!
//! # fn main() -> Result<(), Box<auxbear::Problem>> {
//! let text = template("drop").unwrap();
//! let sets = ["rotor.spin=braked", "rotor.brake_torque=5 N m", "rotor.brake_start=1 s"];
//! let scenario = Scenario::parse(&text, "drop.toml", &sets.map(String::from), &BuiltIn)?;
//! let machine = build(&scenario)?;
//! let mut simulation = machine.simulation()?;
//! // a controller of one's own: it brakes as soon as the rotor lies deep in its clearance
//! for step in 1..=20 {
//!     assert!(simulation.advance(1e-3 * f64::from(step)).is_none());
//!     let low = simulation.value("rotor.y").unwrap() < -0.2e-3;
//!     simulation.change(Input::Brake(low))?;
//! }
//! assert!(simulation.value("rotor.speed").unwrap() > 0.0);
//! # Ok(())
//! # }
//! ```
//!
//! # Study
//!
//! ```
//! use auxbear::{BuiltIn, Options, Scenario, evaluate, template};
//! use std::sync::atomic::AtomicBool;
//!
//! # fn main() -> Result<(), Box<auxbear::Problem>> {
//! let text = template("drop").unwrap();
//! let short = [String::from("run.duration=12 ms")];
//! let scenario = Scenario::parse(&text, "drop.toml", &short, &BuiltIn)?;
//! // a row for each list of changes; StudyFile and Study draw them from distributions
//! let stiffness = |value: &str| vec![("mount.stiffness".to_string(), value.to_string())];
//! let changes = [stiffness("5e6 N/m"), stiffness("5e7 N/m")];
//! let never = AtomicBool::new(false);
//! let table = evaluate(&scenario, &changes, &Options::unwatched(&never))?.unwrap();
//! let forces = table.values("peak_contact_force");
//! assert!(forces[0] < forces[1], "{forces:?}");
//! # Ok(())
//! # }
//! ```
//!
//! # Report
//!
//! ```
//! use auxbear::{BuiltIn, Options, Scenario, run, template, write_directory};
//! use std::sync::atomic::AtomicBool;
//!
//! # fn main() -> Result<(), Box<auxbear::Problem>> {
//! # let folder = tempfile::tempdir().unwrap();
//! # let folder = folder.path();
//! let text = template("spin_up").unwrap();
//! let scenario = Scenario::parse(&text, "spin_up.toml", &[], &BuiltIn)?;
//! let outcome = run(&scenario, &Options::unwatched(&AtomicBool::new(false)))?;
//! // summary.json, history.parquet, the resolved scenario, and a page to look at
//! write_directory(&folder.join("spin_up"), &scenario, &outcome)?;
//! assert!(folder.join("spin_up/report.html").exists());
//! # Ok(())
//! # }
//! ```

//! # Features
//!
//! | feature | without it |
//! |---|---|
//! | `files` | scenarios are texts; measurements and rotors of other programs are not read |
//! | `parallel` | one thread does everything, with the same numbers, and nobody measures the time |
//! | `report` | no run directories, pages and exports |
//! | `uff`, `wav` | no measurements of these formats |
//! | `xlsx` | no workbooks |
//!
//! Without any of them nothing asks for a file, a thread, a clock or the environment.

#![forbid(unsafe_code)]

pub use ::catalogue::{Bearing, Catalogue, bearings};
#[cfg(feature = "files")]
pub use ::import::{Imported, import};
pub use ::outcome::limits::check as check_limits;
pub use ::outcome::{
    Amount, Attached, Attachment, Column, Contact, Judged, Options, Outcome, Picture, Quantity,
    Severity, Spread, Stop, Value, Verdict, Warning, Work,
};
pub use ::problem::explain::explain;
pub use ::problem::{Code, Place, Problem};
#[cfg(feature = "report")]
pub use ::report::directory::{read as read_directory, write as write_directory};
#[cfg(feature = "report")]
pub use ::report::export::export;
pub use ::run::study::answer::Answer;
pub use ::run::study::table::Table;
pub use ::run::study::{Study, evaluate};
pub use ::run::{Input, Machine, Reached, Simulation, build, run};
pub use ::scenario::{
    BearingSource, BuiltIn, Limit, Resolved, Scenario, StudyFile, System, SystemName, schema,
    template,
};

// The crates behind it, for the command, the Python package and their tests: what they hold may change.
#[cfg(feature = "files")]
#[doc(hidden)]
pub use ::import;
#[cfg(feature = "report")]
#[doc(hidden)]
pub use ::report;
#[doc(hidden)]
pub use {
    ::catalogue, ::measure, ::outcome, ::physics, ::problem, ::recording, ::run, ::run::study,
    ::scenario, ::simulate, ::units,
};
