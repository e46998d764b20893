//! Sensors, amplifiers and magnets as they are given, axis by axis.

use crate::StateSpace;
use number::Real;
use physics::magnet::{Amplifier, Magnet};

/// Where an axis of a sensor or a magnet is.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Its name in messages and of its states.
    pub name: String,
    /// Its node of the rotor.
    pub node: usize,
    /// The housing that carries it; the ground without.
    pub on: Option<usize>,
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
    /// Whether each of its coils has a current of its own: those of an opposed pair on a current amplifier. Else both follow one control
    /// current.
    pub(crate) fn has_coils(&self) -> bool {
        let coils = matches!(self.magnet, Magnet::Pair(_));
        coils && matches!(self.amplifier, Amplifier::Current { .. })
    }
    /// Whether its commands are volts.
    pub(crate) fn takes_volts(&self) -> bool {
        matches!(self.amplifier, Amplifier::Voltage { gain: None, .. })
    }
}

/// What may change of an axis of a magnet during a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Condition<R> {
    /// Share of the controller's command that acts: 1; 0 of a frozen one.
    pub command_share: R,
    /// Command that acts besides, A or V.
    pub command_held: R,
    /// Share of the bias that is there.
    pub bias_share: R,
    /// Largest current of a coil, of a linear magnet largest control current, A; infinite without limit.
    pub largest_current: R,
    /// Largest rate of the current of a current amplifier, A/s; infinite without limit.
    pub slew: R,
}

impl<R: Real> Condition<R> {
    /// Of an axis to which nothing has happened.
    pub fn of(actuator: &Actuator) -> Self {
        let slew = match actuator.amplifier {
            Amplifier::Current { slew, .. } => slew,
            _ => f64::INFINITY,
        };
        Condition {
            command_share: R::one(),
            command_held: R::zero(),
            bias_share: R::one(),
            largest_current: R::splat(match actuator.magnet {
                Magnet::Linear { .. } => actuator.largest_current,
                Magnet::Pair(pair) => pair.largest_current,
            }),
            slew: R::splat(slew),
        }
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

/// What commands of magnet axes without a controller are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Commands {
    /// Control currents as a controller commands them, A: amplifiers, limits, bias and its decay stay.
    Current,
    /// Voltages of the coils, V: inductance, resistance and limits stay.
    Voltage,
    /// Forces on the rotor, N, in place of the magnets.
    Force,
}
