//! A torque sensor that swings: what it is, found from a tap, and what torque it felt, found from its reading.
//!
//! ```text
//!   torque + order-1 disturbance ──▶ arm or load cell: one degree of freedom ──▶ reading + zero + noise
//!
//!   ÿ + 2ζω ẏ + ω² y = ω² (T + d)         d = (Ω/Ω_max)^p (c cos θ + s sin θ)
//! ```
//!
//! The reading of a 20 to 30 Hz arm is worst where the shaft turns once in an arm's period. [`identify_free_response`] finds
//! frequency and damping from a tap or a step, [`invert`] finds torque and disturbance jointly, [`design_error`] gives what an
//! arm of another frequency would give.
//!
//! Not modelled: a second mode, play, a sensor whose damping depends on amplitude. Torque may be in any unit; it comes back in
//! the unit of the reading.

mod blocks;
mod chain;
mod design;
mod input;
mod inversion;
mod line;
mod response;
mod shown;
mod swing;

pub use design::{Design, DesignError, design_error};
pub use input::{Clipped, Inversion};
pub use inversion::{Torque, invert};
pub use response::{FreeResponse, identify_free_response};

use statistics::uncertain::Uncertain;

/// A sensor of one degree of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensor {
    /// Undamped natural frequency, Hz.
    pub frequency: Uncertain,
    /// Damping ratio, 1; below 1 the sensor swings.
    pub damping_ratio: Uncertain,
}

/// Natural frequency in rad/s and damping ratio as the models need them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Swing {
    pub(crate) omega: f64,
    pub(crate) zeta: f64,
}

impl Sensor {
    pub(crate) fn swing(&self) -> Swing {
        Swing {
            omega: std::f64::consts::TAU * self.frequency.value,
            zeta: self.damping_ratio.value,
        }
    }
}
