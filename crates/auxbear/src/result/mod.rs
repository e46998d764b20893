//! What a run hands over: plain data in SI.

pub(crate) mod assumptions;
pub(crate) mod columns;
pub(crate) mod drawing;
mod forbidden;
pub mod limits;
pub mod list;
pub mod outcome;
pub(crate) mod static_safety;
