//! Constants of a rig.

use super::program::Program;
use super::refusal::RigRefusal;
use crate::bearing::BearingConstants;
use crate::system::refusal;
use number::{Real, Vec2};

/// Constants of one rig.
#[derive(Clone, Debug, PartialEq)]
pub struct RigConstants {
    /// Flywheel, with the driven pulley and the driving half of the clutch.
    pub flywheel: Flywheel,
    /// What turns the flywheel.
    pub motor: Motor,
    /// Shaft with inner race, sleeve and the driven half of the clutch.
    pub shaft: Shaft,
    /// Housing with the outer race and its dead weight.
    pub housing: Housing,
    /// The test bearing.
    pub bearing: BearingConstants,
    /// What feels the moment on the outer race.
    pub arm: Arm,
    /// Temperature of the bearing.
    pub heat: HeatNode,
    /// What is done.
    pub program: Program,
    /// Speed that counts as reached, rad/s: scales of errors and of the record. Either sign, not 0.
    pub target_speed: f64,
}

/// A drag that opposes rotation: (constant part)·tanh(Ω/reference) + viscous·Ω.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drag {
    /// Constant part, N m; it fades at rest.
    pub constant: f64,
    /// Viscous part, N m s/rad.
    pub viscous: f64,
    /// Speed at which the constant part reaches 76 %, rad/s.
    pub reference_speed: f64,
}

impl Drag {
    /// No drag.
    pub const NONE: Drag = Drag {
        constant: 0.0,
        viscous: 0.0,
        reference_speed: 1.0,
    };
    /// The moment against the rotation at a speed (rad/s), N m, with the sign of the speed.
    #[inline]
    pub fn moment(&self, speed: f64) -> f64 {
        let fading = Real::tanh(speed / self.reference_speed);
        self.constant * fading + self.viscous * speed
    }
}

/// The flywheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flywheel {
    /// Inertia with what turns with it up to the clutch, kg m².
    pub inertia: f64,
    /// Drag of the belt and of its bearings.
    pub belt_drag: Drag,
}

/// The motor, seen at the flywheel through its belt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motor {
    /// Torque per speed that is missing, N m s/rad.
    pub gain: f64,
    /// Largest torque in either direction, N m.
    pub torque_limit: f64,
}

/// The shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shaft {
    /// Inertia with inner race, sleeve and driven half of the clutch, kg m²; without balls and cage.
    pub inertia: f64,
    /// Drag of its support bearings.
    pub support_drag: Drag,
}

/// The housing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Housing {
    /// Mass of the housing with outer race and suspended weights, kg.
    pub mass: f64,
    /// Force W that its weight and the suspended weights exert, N; not negative.
    pub load: f64,
    /// Direction of that force, a unit vector.
    pub load_direction: Vec2<f64>,
    /// Gravity on what moves with the outer race besides (cage, rolling balls), m/s². Balls that move have their own.
    pub gravity: Vec2<f64>,
    /// True where its centre is held in the middle: the concentric rig.
    pub centre_held: bool,
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

impl RigConstants {
    /// Refuses what has no meaning.
    pub fn check(&self) -> Result<(), RigRefusal> {
        let positive = [
            ("inertia of the flywheel", self.flywheel.inertia),
            ("inertia of the shaft", self.shaft.inertia),
            ("natural frequency of the arm", self.arm.natural_frequency),
            (
                "reference speed of the disturbance",
                self.arm.disturbance.reference_speed,
            ),
            ("heat capacity of the bearing", self.heat.capacity),
            ("lag of the thermocouple", self.heat.thermocouple_lag),
            (
                "reference speed of the belt's drag",
                self.flywheel.belt_drag.reference_speed,
            ),
            (
                "reference speed of the support's drag",
                self.shaft.support_drag.reference_speed,
            ),
            ("size of the target speed", self.target_speed.abs()),
        ];
        let positive = positive.into_iter().chain(
            (!self.housing.centre_held).then_some(("mass of the housing", self.housing.mass)),
        );
        for (name, value) in positive {
            if !(value.is_finite() && value > 0.0) {
                return Err(RigRefusal::NotPositive(name));
            }
        }
        for (name, value) in [
            ("gain of the motor", self.motor.gain),
            ("torque limit of the motor", self.motor.torque_limit),
            (
                "constant drag of the belt",
                self.flywheel.belt_drag.constant,
            ),
            ("viscous drag of the belt", self.flywheel.belt_drag.viscous),
            (
                "constant drag of the supports",
                self.shaft.support_drag.constant,
            ),
            (
                "viscous drag of the supports",
                self.shaft.support_drag.viscous,
            ),
            ("load", self.housing.load),
            ("damping ratio of the arm", self.arm.damping_ratio),
            (
                "amplitude of the disturbance",
                self.arm.disturbance.amplitude,
            ),
            ("heat conductance of the bearing", self.heat.conductance),
        ] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(RigRefusal::Negative(name));
            }
        }
        // a hundredth of a percent: a direction written with five digits
        let length = self.housing.load_direction.length_squared();
        if !(0.9999..1.0001).contains(&length) {
            return Err(RigRefusal::Direction);
        }
        self.program.check()?;
        refusal::of_bearing(&self.bearing, Some(self.shaft.inertia)).map_err(RigRefusal::Bearing)
    }
}
