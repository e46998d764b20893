//! What a run hands over: plain data in SI.

pub(crate) mod assumptions;
pub mod list;
pub mod outcome;
