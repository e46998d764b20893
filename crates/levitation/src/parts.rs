//! Sensors, amplifiers and magnets as they are given, axis by axis.

use crate::StateSpace;
use physics::magnet::{Amplifier, Magnet};

/// Where an axis of a sensor or a magnet is.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Its name in messages and of its states.
    pub name: String,
    /// Its node of the rotor.
    pub node: usize,
    /// Its direction, rad from +x about +z.
    pub angle: f64,
}

/// One axis of a position sensor: its signal follows the displacement and an error of its own.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    /// Where it is.
    pub axis: Axis,
    /// Its corner, rad/s: signal = displacement/(1 + s/ω); none follows at once.
    pub corner: Option<f64>,
    /// What it shows when the rotor is in the centre, m.
    pub offset: f64,
    /// Displacement that the controller wants there, m.
    pub reference: f64,
}

/// One axis of a magnet with its amplifier.
#[derive(Debug, Clone, PartialEq)]
pub struct Actuator {
    /// Where it is.
    pub axis: Axis,
    /// Its force law.
    pub magnet: Magnet<f64>,
    /// Its amplifier.
    pub amplifier: Amplifier,
    /// Lowest control current, A: at it the coil that pulls towards - has its largest current; infinite where nothing limits it.
    pub lowest_current: f64,
    /// Largest control current, A: at it the coil that pulls towards + has its largest current. Commands end at both.
    pub largest_current: f64,
}

impl Actuator {
    /// Where its commands end, A; none where they are volts, or have no limit.
    pub(crate) fn command_limits(&self) -> Option<[f64; 2]> {
        let volts = matches!(self.amplifier, Amplifier::Voltage { gain: None, .. });
        let limits = [self.lowest_current, self.largest_current];
        (!volts && self.largest_current.is_finite()).then_some(limits)
    }
}

/// From position errors (reference - signal) to commands.
#[derive(Debug, Clone, PartialEq)]
pub enum Control {
    /// A filter for each axis: sensor k commands magnet axis k.
    Channels(Vec<StateSpace>),
    /// One filter from all sensors to all magnet axes.
    Matrix(StateSpace),
}
