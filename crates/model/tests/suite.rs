//! All tests of the crate, in one binary.

mod bent;
mod bitwise;
mod library;
mod machines;
mod physics;
mod rig;
mod spatial;
mod spin_up;
mod turns;
