//! How long and how finely a system is simulated.

use crate::values::Values;
use problem::words;

/// The simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Simulated time, s.
    pub duration: f64,
    /// How accurate the results are.
    pub accuracy: Accuracy,
    /// Relative tolerance, where it is given.
    pub tolerance: Option<f64>,
    /// Time between rows of the history, s.
    pub output_interval: f64,
    /// Largest step, s.
    pub largest_step: f64,
    /// How steps are taken.
    pub method: Method,
}

words! {
/// How accurate the results of a run are.
pub enum Accuracy {
    /// For numbers of a design: the energy ledger closes to a millionth.
    Design = "design",
    /// For ensembles and long runs: means within some 1e-4 of those of design.
    Screening = "screening",
}
}

words! {
/// When a run ends.
pub enum Until {
    /// At its duration.
    Duration = "duration",
    /// When the rotor stands.
    Standstill = "standstill",
}
}

words! {
/// How steps are taken.
pub enum Method {
    /// By the stiffness of friction.
    Auto = "auto",
    Explicit = "explicit",
    /// Linearly implicit.
    Implicit = "implicit",
}
}

impl Run {
    pub(crate) fn from_values(values: &Values) -> Run {
        let run = values.section("run");
        Run {
            duration: run.number("duration"),
            // what has no choice is computed for design
            accuracy: run.chosen("accuracy").unwrap_or(Accuracy::Design),
            tolerance: run.maybe("tolerance"),
            output_interval: run.number("output_interval"),
            largest_step: run.number("largest_step"),
            // what has no choice takes explicit steps
            method: run.chosen("method").unwrap_or(Method::Explicit),
        }
    }
}
