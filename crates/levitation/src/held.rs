//! A levitation without its controller: whoever drives the machine gives the commands, which are held between.

use crate::levitation::{Layout, volts};
use crate::parts::{Actuator, Commands, Sensor};
use crate::{Levitation, OfAxes, Signals};
use physics::magnet::{Amplifier, Magnet, Timing};

impl Levitation {
    /// The same without its controller: the commands of all axes, of this kind, are held until somebody [changes](Levitation::command)
    /// them. Of currents or voltages amplifiers and magnets stay what they are; forces take their place.
    ///
    /// # Errors
    /// The first axis whose amplifier takes no such command.
    pub fn without_controller(&self, commands: Commands) -> Result<Self, usize> {
        let mut actuators = self.actuators.clone();
        for (axis, own) in actuators.iter_mut().enumerate() {
            let volts = own.takes_volts();
            match (commands, &mut own.amplifier) {
                (Commands::Current, _) if volts => return Err(axis),
                (Commands::Current, _) => {}
                (Commands::Voltage, Amplifier::Voltage { gain, .. }) => *gain = None,
                (Commands::Voltage, _) => return Err(axis),
                (Commands::Force, amplifier) => {
                    *amplifier = Amplifier::Direct;
                    own.magnet = Magnet::Linear {
                        current_stiffness: 1.0,
                        position_stiffness: 0.0,
                    };
                    (own.lowest_current, own.largest_current) = (f64::NEG_INFINITY, f64::INFINITY);
                }
            }
        }
        let mut layout = Layout::of(&self.sensors);
        for actuator in &actuators {
            let held = layout.add(format!("{}.command held", actuator.axis.name));
            layout.held.push((held, held));
        }
        layout.add_currents(&actuators);
        Ok(Levitation {
            sensors: self.sensors.clone(),
            actuators,
            blocks: Vec::new(),
            timing: Timing::Held,
            delay: None,
            layout,
        })
    }
    /// Whether any of its amplifiers takes volts for commands.
    #[must_use]
    pub fn takes_volts(&self) -> bool {
        self.actuators.iter().any(Actuator::takes_volts)
    }
    /// Where the command of a magnet axis is held; nowhere where a controller gives it at every instant.
    #[must_use]
    pub fn command(&self, actuator: usize) -> Option<usize> {
        self.layout.held.get(actuator).map(|(_, held)| *held)
    }
    /// Voltage that the amplifier of a magnet axis is asked for with signals that were [read](Levitation::read), V; none where it has none.
    #[must_use]
    pub fn voltage(&self, actuator: usize, signals: &Signals<f64>) -> Option<f64> {
        match self.actuators[actuator].amplifier {
            Amplifier::Voltage { gain, .. } => {
                let (command, current) = (signals.commands[actuator], signals.currents[actuator]);
                Some(volts(gain, command, current))
            }
            _ => None,
        }
    }
    /// Signal of every sensor axis in these states with these displacements, m.
    #[must_use]
    pub fn sensed(&self, states: &[f64], displacements: &[f64]) -> OfAxes<f64> {
        let of = |(index, sensor): (usize, &Sensor)| match self.layout.sensors[index] {
            Some(at) => states[at],
            None => displacements[index] + sensor.offset,
        };
        self.sensors.iter().enumerate().map(of).collect()
    }
}
