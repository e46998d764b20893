//! Bearings in space at rest in their loads.
//!
//! | file | what |
//! |---|---|
//! | [`ball`] | a ball between tilted rings: quasi-static, with a hypothesis for its spin |
//! | [`ring`] | equilibrium of the inner ring on rows of balls, its 5 × 5 stiffness |
//! | [`iso16281`] | the same by ISO/TS 16281: linear in the displacements, without speed |
//! | [`steady`] | pure axial load without a hypothesis: the dynamics, made steady |
//!
//! The outer ring is fixed in the origin; the inner ring has the displacement (x, y, z, τ_x, τ_y), τ a rotation vector across the
//! axis. Quasi-static balls hold while loads change slower than the balls' modes (30 to 40 kHz).

pub mod ball;
pub mod iso16281;
mod linear;
pub mod ring;
pub mod steady;

pub use ball::{BallEquilibrium, RaceControl, StaticBall};
pub use ring::{Displacement, Equilibrium, NoEquilibrium, RingLoad, StaticRow, StaticRows};
