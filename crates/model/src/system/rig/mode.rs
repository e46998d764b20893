//! What holds between two instants at which something is switched.

use crate::table::Piece;

/// Discrete facts, and what holds between two instants at which something is switched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// Speed the motor is set to, rad/s over s; none while it is off.
    pub motor: Option<Piece<f64>>,
    /// Capacity T_c of the clutch, N m over s.
    pub capacity: Piece<f64>,
    /// What the clutch does.
    pub clutch: Clutch,
}

/// What the clutch does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Clutch {
    /// Nothing.
    Open,
    /// It slips: the torque on the shaft is the capacity in this direction, 1 or -1.
    Slipping {
        /// Direction in which the flywheel is ahead of the shaft.
        direction: f64,
    },
    /// Flywheel and shaft are one body.
    Locked,
}

/// A change of the clutch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClutchEvent {
    /// When, s.
    pub time: f64,
    /// What it does from then on.
    pub clutch: Clutch,
    /// Speed of the shaft then, rad/s.
    pub speed: f64,
}
