//! Bearings in space: rows of balls between rings with six freedoms, contact angle, slip and spin as results.
//!
//! | file | what |
//! |---|---|
//! | [`rigid_body`] | a body of revolution: 13 states |
//! | [`ball`] | a ball: nine states in cylinder coordinates about the bearing's axis |
//! | [`race`] | its contact in the groove of a ring, traction as a force and a couple |
//! | [`pocket`] | its pocket in the cage |
//! | [`row`] | a row of balls with its cage |
//! | `steady_moment` | the steady friction moment that the balls of a row share |
//! | [`bore`], [`face`] | rotor and inner ring, cage and land; shoulder and face |
//! | [`mount`] | the outer ring in its mount |
//! | [`landing`] | where a rotor lands on an inner ring |
//! | [`rotor`] | the rigid rotor with its levitation |
//! | [`assembly`] | rows on shared rings, mount and rotor: states, rates, energy accounts |
//! | [`arrangement`] | how rows stand, and their preload |
//! | [`spring`] | a preload by a spring |
//! | [`part`] | such a bearing as a part of a machine |
//! | [`record`] | what is watched of it in a run |
//! | [`energy`] | energies and momenta of an assembly |
//! | [`frame`] | the bearing's frame in that of the machine |
//! | [`statics`] | quasi-static equilibrium, stiffness, ISO/TS 16281 |
//!
//! Everything here is in the bearing's frame: the origin in its centre, e_z its axis. [`frame`] turns what is given in another.
//! Every interaction acts at one point c: a force on one body at c, the opposite on the other at c, a couple with both signs. So
//! momentum and angular momentum are exact for any law.
//!
//! Source: derived; book/src/theory/spatial.md. Does not model: films but by their law of traction, hysteresis, flexible rings,
//! elastic pockets, balls that touch balls, a ring that whirls in its fit.

pub mod arrangement;
pub mod assembly;
pub mod ball;
pub mod bore;
pub mod energy;
pub mod face;
pub mod face_heat;
pub mod frame;
pub mod landing;
pub mod mount;
pub mod part;
pub(crate) mod part_states;
pub mod pocket;
pub mod race;
pub mod record;
pub mod rigid_body;
pub mod rotor;
pub mod row;
pub mod spring;
pub mod statics;
pub(crate) mod steady_moment;

pub use arrangement::{RowGeometry, preload_at_rest};
pub use assembly::{Assembly, AssemblyConstants, AssemblyProbe, InnerRing, LEDGER, OuterRing};
pub use ball::SpatialBall;
pub use frame::Frame;
pub use landing::{Landing, LandingConstants};
pub use part::{Spatial, SpatialBearing};
pub use rotor::{SpatialLevitation, SpatialRotor};
pub use row::{CageConstants, CageGuide, RowConstants, SpatialLand};
pub use spring::PreloadSpring;
