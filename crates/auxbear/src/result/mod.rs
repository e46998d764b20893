//! What a run hands over: plain data in SI.

pub mod list;
pub mod outcome;
