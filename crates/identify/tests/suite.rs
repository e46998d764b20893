//! All tests of the crate, in one binary.

mod bad_input;
mod cage;
mod data_checks;
mod energy;
mod explain;
mod loss;
mod made_up;
mod moment;
mod rotor;
mod signals;
mod steady_curve;
