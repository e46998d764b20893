//! What carries the outer race of a rig: a housing under dead weight, the arm that feels its moment, the heat of the bearing.
//!
//! ```text
//!   m c̈_o = W + bearing + m' g       or held        m with, m' only what moves with the outer race besides the housing
//!   ÿ = ω_n² (t_O + d - y) - 2ζω_n ẏ                 d = a (|Ω|/Ω_ref)^p cos(φ + ψ)
//!   C Ṫ = P - C_f Θ̇ - G T,  Ṫ_m = (T - T_m)/τ        P: heats of the bearing; films that warm keep C_f Θ̇ of them
//! ```
//! The arm takes t_O as a pure couple.
//!
//! Assumes: the outer race does not turn. That is a good assumption: an arm of ω_n = 150 1/s on a housing of 2e-3 kg m² has a
//! stiffness of 45 N m/rad, so that 25 N mm turn it by 0.6 mrad, and a moment that comes within 0.1 s turns it with some
//! 0.006 rad/s, beside 150 rad/s of the shaft; the inertia of the housing is part of the arm's ω_n.

use super::constants::{not_negative, positive};
use super::refusal::Refusal;
use number::Real;

/// The housing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Housing {
    /// Mass of the housing with outer race and suspended weights, kg.
    pub mass: f64,
    /// True where its centre is held in the middle: the concentric rig. Then the load reaches the law of the steady moment, not
    /// the balls.
    pub centre_held: bool,
    /// What feels the moment on the outer race.
    pub arm: Arm,
    /// Temperature of the bearing.
    pub heat: HeatNode,
}

impl Housing {
    pub(super) fn check(&self) -> Result<(), Refusal> {
        positive("natural frequency of the arm", self.arm.natural_frequency)?;
        positive(
            "reference speed of the disturbance",
            self.arm.disturbance.reference_speed,
        )?;
        positive("heat capacity of the bearing", self.heat.capacity)?;
        positive("lag of the thermocouple", self.heat.thermocouple_lag)?;
        if !self.centre_held {
            positive("mass of the housing", self.mass)?;
        }
        not_negative("damping ratio of the arm", self.arm.damping_ratio)?;
        let amplitude = self.arm.disturbance.amplitude;
        not_negative("amplitude of the disturbance", amplitude)?;
        not_negative("heat conductance of the bearing", self.heat.conductance)
    }
}

/// Torque arm or load cell: a second-order sensor of the moment on the outer race.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arm {
    /// Natural frequency ω_n, rad/s.
    pub natural_frequency: f64,
    /// Damping ratio ζ.
    pub damping_ratio: f64,
    /// Synchronous disturbance.
    pub disturbance: Disturbance,
}

/// A disturbance d = a (|Ω|/Ω_ref)^p cos(φ + ψ) that lateral vibration adds to the moment, φ the angle of the shaft. With p = 0,
/// a run-out, it is there at rest too: a cos(φ + ψ) at the angle where the shaft rests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disturbance {
    /// Amplitude a at the reference speed, N m.
    pub amplitude: f64,
    /// Reference speed Ω_ref, rad/s.
    pub reference_speed: f64,
    /// Exponent p of the speed; 2 for an unbalance well below its resonance, 0 for a run-out.
    pub exponent: f64,
    /// Phase ψ, rad.
    pub phase: f64,
}

impl Disturbance {
    /// No disturbance.
    pub const NONE: Disturbance = Disturbance {
        amplitude: 0.0,
        reference_speed: 1.0,
        exponent: 0.0,
        phase: 0.0,
    };
    /// Its value at an angle (rad) and speed (rad/s) of the shaft, N m.
    #[inline]
    pub fn moment(&self, angle: f64, speed: f64) -> f64 {
        // a run-out is there at rest too; what grows with speed is not
        let growth = if self.exponent == 0.0 {
            1.0
        } else if speed == 0.0 {
            0.0
        } else {
            Real::exp(self.exponent * Real::ln((speed / self.reference_speed).abs()))
        };
        if self.amplitude == 0.0 || growth == 0.0 {
            return 0.0;
        }
        self.amplitude * growth * Real::sin_cos(angle + self.phase).1
    }
}

/// The bearing as one lump of heat, and the thermocouple on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeatNode {
    /// Capacity C, J/K.
    pub capacity: f64,
    /// Conductance G to the surroundings, W/K.
    pub conductance: f64,
    /// Time constant τ of the thermocouple, s.
    pub thermocouple_lag: f64,
}
