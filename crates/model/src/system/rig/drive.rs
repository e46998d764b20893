//! What turns the inner race: a rotor that slides in its bore, a torque, a given speed, or a flywheel behind a clutch.
//! Their equations stand in [`fixture`](super::fixture).

use super::constants::{not_negative, positive};
use super::program::Program;
use super::refusal::Refusal;
use crate::rotor::RotorConstants;
use crate::table::Table;
use number::Real;

/// What turns the inner race.
#[derive(Clone, Debug, PartialEq)]
pub enum Drive {
    /// A rotor that the radial load presses on the bore.
    SlidingRotor(SlidingRotor),
    /// A torque on the inner race over time, N m over s.
    Torque(Table),
    /// A speed of the inner race over time, rad/s over s; the first row is the speed at the start.
    /// See [`Drive::ramp`] and [`Drive::step`].
    Speed(Table),
    /// A flywheel behind a clutch.
    Clutch(Box<ClutchDrive>),
}

/// A rotor that slides in the bore of the inner race.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlidingRotor {
    /// Radius of the bore R_0, m.
    pub bore_radius: f64,
    /// Friction coefficient μ.
    pub friction: f64,
    /// 1/u0, s/m: inverse of the slip at which friction reaches 76 %.
    pub inverse_reference_speed: f64,
    /// Spin at the start, rad/s.
    pub speed: f64,
    /// Polar moment of inertia, kg m²; without effect where the spin is held.
    pub polar_inertia: f64,
    /// True where a drive holds the spin whatever it takes.
    pub spin_held: bool,
}

/// A flywheel that drives the inner race through a clutch.
#[derive(Clone, Debug, PartialEq)]
pub struct ClutchDrive {
    /// Flywheel, with the driven pulley and the driving half of the clutch.
    pub flywheel: Flywheel,
    /// What turns the flywheel.
    pub motor: Motor,
    /// Drag of the bearings that support the shaft.
    pub support_drag: Drag,
    /// What is done.
    pub program: Program,
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

impl Drag {
    /// No drag.
    pub const NONE: Drag = Drag {
        constant: 0.0,
        viscous: 0.0,
        reference_speed: 1.0,
    };
    /// The moment against the rotation at a speed (rad/s), N m, with the sign of the speed.
    #[inline(always)]
    pub fn moment<R: Real>(&self, speed: R) -> R {
        let fading = (speed / R::splat(self.reference_speed)).tanh();
        R::splat(self.constant) * fading + R::splat(self.viscous) * speed
    }
}

impl ClutchDrive {
    pub(super) fn check(&self) -> Result<(), Refusal> {
        let (belt, support) = (&self.flywheel.belt_drag, &self.support_drag);
        positive("inertia of the flywheel", self.flywheel.inertia)?;
        positive("reference speed of the belt's drag", belt.reference_speed)?;
        positive(
            "reference speed of the support's drag",
            support.reference_speed,
        )?;
        not_negative("gain of the motor", self.motor.gain)?;
        not_negative("torque limit of the motor", self.motor.torque_limit)?;
        not_negative("constant drag of the belt", belt.constant)?;
        not_negative("viscous drag of the belt", belt.viscous)?;
        not_negative("constant drag of the supports", support.constant)?;
        not_negative("viscous drag of the supports", support.viscous)?;
        self.program.check()
    }
}

impl Drive {
    /// A constant acceleration (its size, rad/s²) from rest to a speed of either sign (rad/s), which then stays.
    pub fn ramp(acceleration: f64, speed: f64) -> Self {
        let end = (speed / acceleration).abs();
        match Table::through(vec![(0.0, 0.0), (end, speed)]) {
            Ok(table) => Drive::Speed(table),
            // no acceleration to speak of, or one beyond measure
            Err(_) => Drive::step(speed),
        }
    }
    /// A speed from the first instant, rad/s, while the balls are at rest.
    pub fn step(speed: f64) -> Self {
        Drive::Speed(Table::constant(speed))
    }
    /// Speed of the inner race at the start, rad/s.
    pub fn race_speed(&self) -> f64 {
        match self {
            Drive::Speed(speed) => speed.value(0.0),
            Drive::Clutch(clutch) => clutch.program.start.shaft_speed,
            Drive::SlidingRotor(_) | Drive::Torque(_) => 0.0,
        }
    }
    /// Speed of the sliding rotor or of the flywheel at the start, rad/s.
    pub(super) fn rotor_speed(&self) -> f64 {
        match self {
            Drive::SlidingRotor(rotor) => rotor.speed,
            Drive::Clutch(clutch) => clutch.program.start.flywheel_speed,
            Drive::Torque(_) | Drive::Speed(_) => 0.0,
        }
    }
    /// The sliding rotor or the flywheel; one at rest where a torque or a speed is given.
    pub(super) fn rotor(&self) -> RotorConstants {
        match self {
            Drive::SlidingRotor(rotor) => {
                RotorConstants::turning(rotor.polar_inertia, rotor.spin_held)
            }
            Drive::Clutch(clutch) => RotorConstants::turning(clutch.flywheel.inertia, false),
            Drive::Torque(_) | Drive::Speed(_) => RotorConstants::turning(0.0, true),
        }
    }
}
