//! Normal numbers, random streams, simplex, small systems, numbers with their uncertainty, noise of channels and fits beside it, and designs
//! of many runs: which values member k takes, and what the results of all members say.
//!
//! ```text
//!   Design ──(seed, k)──▶ coordinates in (0, 1) ──Correlation──▶ Distribution ──▶ values
//!   results ──▶ shares with their bounds · elementary effects · Sobol indices
//! ```
//! The coordinates of member k depend on (seed, design, k) alone, so any split of a study and any number of threads gives the
//! same members, and a design that grows by whole blocks keeps those it had. Nothing here knows what is run.

#![forbid(unsafe_code)]
#![deny(clippy::disallowed_methods, clippy::disallowed_types)]

pub mod correlation;
pub mod design;
pub mod distribution;
pub mod elementary;
pub mod indices;
pub mod interpolation;
pub mod least_squares;
pub mod linear;
pub mod local_fit;
pub mod noise;
pub mod normal;
pub mod quantile;
pub mod random;
pub mod share;
pub mod simplex;
pub mod uncertain;
