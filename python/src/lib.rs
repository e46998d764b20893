//! The native part of the Python package `auxbear`: what its pages in `python/auxbear/` call. No physics, no default values, and
//! no more words than those pages need; they hold the documentation.
//!
//! | page | subject |
//! |---|---|
//! | `problem` | a problem of the library becomes the exception `auxbear.Problem` |
//! | `watched` | work on a thread of its own, while the calling one looks for Ctrl-C and tells the progress |
//! | `table` | columns of numbers as an Arrow stream |
//! | `scenario` | what is simulated |
//! | `outcome` | what comes out |
//! | `simulation` | a machine that is driven from outside |
//! | `study` | many runs, here or in parts elsewhere |
//! | `recording` | channels from memory, as a file that the readers take |
//! | `laws` | laws over arrays |

#![forbid(unsafe_code)]

mod laws;
mod outcome;
mod problem;
mod recording;
mod scenario;
mod simulation;
mod study;
mod table;
mod watched;

use pyo3::prelude::*;

#[pymodule]
mod _auxbear {
    #[pymodule_export]
    use super::laws::{film, hertz, palmgren, race_acceleration, skf};
    #[pymodule_export]
    use super::outcome::Outcome;
    #[pymodule_export]
    use super::recording::write_recording;
    #[pymodule_export]
    use super::scenario::{
        Scenario, bearing_json, bearings_json, explain, number_in, schema, template, version,
    };
    #[pymodule_export]
    use super::simulation::Simulation;
    #[pymodule_export]
    use super::study::{Parts, Study, read_study};
    #[pymodule_export]
    use super::table::Table;
}
