//! Heat of a machine: nodes that store, conductances between them, grounds that take; surfaces that slide on each other.
//!
//! | module | subject |
//! |---|---|
//! | [`network`] | nodes and conductances, stepped exactly |
//! | [`held`] | nodes held at their limits, and the heat that this takes |
//! | [`bearing_network`] | nodes and conductances of an auxiliary bearing |
//! | [`passage`] | what heat passes between two bodies: metal, gas, radiation |
//! | [`load_zone`] | its balls under a radial load |
//! | [`losses`] | what brakes and heats, at a speed and at temperatures |
//! | [`coast_down`] | a rotor that coasts down, in steps of its speed |
//! | [`steady_speed`] | warming at constant speed; runaway |
//! | [`warm_bearing`] | the losses of bearings whose oil and rings are warm |
//! | [`warm_machine`] | the losses of a machine whose bearings differ |
//! | [`clearance`] | the clearance of a warm bearing, its preload once closed |
//! | [`oil_range`] | when a lubricant leaves the data of its viscosity |
//! | [`layer`] | the heated layer of a body: surface above mean, stepped exactly |
//! | [`rubbing_contact`] | two layers that rub: friction power shared so that both sides of the patch are equally hot |

#![forbid(unsafe_code)]
#![deny(clippy::disallowed_methods, clippy::disallowed_types)]

pub mod bearing_network;
pub mod clearance;
pub mod coast_down;
pub mod held;
pub mod layer;
pub mod load_zone;
pub mod losses;
pub mod network;
pub mod oil_range;
pub mod passage;
pub mod rubbing_contact;
pub mod steady_speed;
pub mod warm_bearing;
pub mod warm_machine;
