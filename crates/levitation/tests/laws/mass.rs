//! One mass on two magnet axes.

use levitation::{
    Actuator, Amplifier, Axis, ClosedLoop, Control, Levitation, Plant, Sensor, StateSpace, Timing,
};
use nalgebra::DMatrix;
use physics::magnet::Magnet;

pub const DELAYED: Timing = Timing::Continuous { delay: 5e-5 };

/// A mass that moves along x and y over two magnet axes, sensors at the same node.
pub struct Mass {
    pub mass: f64,
    pub magnet: Magnet<f64>,
    pub amplifier: Amplifier,
    pub timing: Timing,
    pub channel: StateSpace,
}

impl Mass {
    pub fn usual() -> Self {
        Self {
            mass: 3.0,
            magnet: Magnet::Linear {
                current_stiffness: 40.0,
                position_stiffness: 1.6e5,
            },
            amplifier: Amplifier::Current {
                bandwidth: 12e3,
                slew: f64::INFINITY,
            },
            timing: DELAYED,
            channel: StateSpace::pid(8000.0, 8e4, 22.0, 4.5e-5).unwrap(),
        }
    }
    pub fn plant(&self) -> Plant<f64> {
        Plant {
            mass: DMatrix::identity(2, 2) * self.mass,
            damping: DMatrix::zeros(2, 2),
            stiffness: DMatrix::zeros(2, 2),
            nodes: DMatrix::identity(1, 1),
            housings: DMatrix::zeros(0, 1),
        }
    }
    pub fn axes(&self) -> (Vec<Sensor>, Vec<Actuator>) {
        let axis = |angle| Axis {
            name: format!("axis {angle:.1}"),
            node: 0,
            on: None,
            angle,
        };
        let angles = [0.3, 0.3 + std::f64::consts::FRAC_PI_2];
        let sensor = |angle| Sensor {
            axis: axis(angle),
            corner: Some(5e4),
            offset: 0.0,
            reference: 0.0,
        };
        let actuator = |angle| Actuator {
            axis: axis(angle),
            magnet: self.magnet,
            lowest_current: f64::NEG_INFINITY,
            largest_current: f64::INFINITY,
            amplifier: self.amplifier,
        };
        (angles.map(sensor).to_vec(), angles.map(actuator).to_vec())
    }
    pub fn levitation(&self) -> Levitation {
        let (sensors, actuators) = self.axes();
        let control = Control::Channels(vec![self.channel.clone(); 2]);
        Levitation::new(1, sensors, control, self.timing, actuators).unwrap()
    }
    pub fn closed(&self) -> ClosedLoop<f64> {
        ClosedLoop::new(self.plant(), &self.levitation()).unwrap()
    }
}
