//! All tests of the crate, in one binary.

mod local_fit;
mod rare;
mod sensitivity;
