//! Heat of a machine in slow time: nodes that store, conductances between them, grounds that take.
//!
//! | module | subject |
//! |---|---|
//! | [`network`] | nodes and conductances, stepped exactly |

#![forbid(unsafe_code)]

pub mod network;
