//! placeholder

pub mod problem;
pub mod scenario;
