//! A machine without its controller as a unit for co-simulation, FMI 2.0 and 3.0.
//!
//! ```text
//!   auxbear fmu ──▶ machine.fmu: description, this library, scenario with its data files
//!   importer ──C──▶ interface_2, interface_3 ──▶ handle ──▶ instance ──▶ auxbear::run::Driven
//! ```
//! | page | subject |
//! |---|---|
//! | [`variables`] | what goes in, what comes out, parameters: the table of both ends |
//! | `description` | that table as `modelDescription.xml` |
//! | [`controller`] | a unit of somebody else as the controller of a run |
//! | [`package`] | the file of a unit |
//! | `instance` | an instance from its resources to its end, without pointers |
//! | `past` | a state as bytes |
//! | `handle` | what stands behind an importer's pointer; panics end there |
//! | [`interface_2`], [`interface_3`] | the functions of the standard |
//!
//! Beside `number` this is the one crate with unsafe code, for the pointers of importers: `handle`, the two interfaces and the calls of [`controller`] alone. All of
//! them are used within the call in which they came, but for what `handle` has leaked and frees again.

pub mod controller;
mod description;
mod handle;
mod instance;
pub mod interface_2;
pub mod interface_3;
pub mod package;
mod past;
pub mod variables;

pub use description::Version;
