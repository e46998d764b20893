//! Sensors, amplifiers and magnets as they are given, axis by axis.

use crate::StateSpace;
use physics::magnet::Magnet;

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

/// How a command becomes a current.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Amplifier {
    /// The current is the command.
    Direct,
    /// i̇ = ω(command - i).
    Current {
        /// Bandwidth ω, rad/s.
        bandwidth: f64,
    },
    /// L di/dt = u - R i - k_i ẋ, |u| ≤ U.
    Voltage {
        /// Inductance L, H.
        inductance: f64,
        /// Resistance R, Ω.
        resistance: f64,
        /// u = gain (command - i), V/A; without it the command is u itself.
        gain: Option<f64>,
        /// Largest voltage U, V.
        largest_voltage: f64,
    },
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

/// When a command takes effect.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Timing {
    /// The controller runs at every instant; its commands come `delay` later (Padé 2/2).
    Continuous {
        /// Delay T, s; 0 for none.
        delay: f64,
    },
    /// The controller runs at k T_s; its commands are held from k T_s + T_c on.
    Sampled {
        /// Period T_s, s.
        period: f64,
        /// Time to compute T_c, s.
        computation: f64,
    },
}

impl Timing {
    /// The delay that linear analysis sees, s: T, or T_c + T_s/2.
    #[must_use]
    pub fn delay(self) -> f64 {
        match self {
            Self::Continuous { delay } => delay,
            Self::Sampled {
                period,
                computation,
            } => computation + 0.5 * period,
        }
    }
}
