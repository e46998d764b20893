//! Parts and systems.
//!
//! A *part* ([`bearing`], [`contact`], [`mount`], [`levitation`], [`seal`], [`rotor`]) turns a motion into a reaction and
//! reports the heat it makes. A *system* ([`system`]) unpacks motions from its state, lets its parts react, and
//! accelerates its bodies: one page that reads like the equations.
//!
//! Frame: ground, x to the right, y up; angles and spins counter-clockwise.
//! n points from a race centre to a ball or rotor centre, t is n turned by +90°.

#![forbid(unsafe_code)]
#![deny(clippy::disallowed_methods, clippy::disallowed_types)]

pub mod auxiliary_bearing;
pub mod base;
pub mod bearing;
pub mod bearing_heat;
pub mod body;
pub mod contact;
pub mod force;
pub mod heats;
pub mod levitation;
pub mod magnets;
pub mod motion;
pub mod mount;
pub mod rotor;
pub mod schedule;
pub mod seal;
pub mod sensor;
pub mod spatial;
pub mod surface_heat;
pub mod system;
pub mod table;
