//! The levitated rotor of the reference files as this crate's parts.
#![allow(dead_code)] // each test uses its part

use crate::published;
use levitation::{
    Actuator, Amplifier, Axis, C64, ClosedLoop, Control, Levitation, Plant, Sensor, StateSpace,
    Timing,
};
use physics::magnet::Magnet;
use rotor::{Analysis, Matrices, Unbalance};
use serde_json::Value;

/// Coordinates of the rotor.
#[derive(Clone, Copy, PartialEq)]
pub enum Basis {
    /// All.
    Whole,
    /// Free modes to 6e4 rad/s and residual flexibility.
    Reduced,
}

/// A file with its rotor.
pub struct File {
    pub file: Value,
    pub rotor: rotor::Rotor,
}

/// A pair as a complex number.
pub fn complex(value: &Value) -> C64 {
    C64::new(value[0].as_f64().unwrap(), value[1].as_f64().unwrap())
}

impl File {
    fn read(name: &str, beta: &str) -> Self {
        let path = format!(
            "{}/../../validation/cases/reference/{name}.json",
            env!("CARGO_MANIFEST_DIR")
        );
        let file: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        let mut rotor = published::case("ross_amb_rotor_freefree").rotor.free();
        for element in &mut rotor.elements {
            element.damping_of_stiffness += file[beta].as_f64().unwrap();
        }
        Self { file, rotor }
    }
    pub fn levitated() -> Self {
        Self::read("machine_levitated", "beta_external")
    }
    pub fn drop() -> Self {
        Self::read("machine_drop_flexible", "beta_added")
    }
    pub fn results(&self) -> &[Value] {
        self.file["results"].as_array().unwrap()
    }

    /// Magnets with both axes at an angle of the frame.
    pub fn levitation(&self, angle: f64) -> Levitation {
        self.changed(angle, Timing::Continuous { delay: 5e-5 }, |_| ())
    }

    /// The same with another timing and with magnets changed as the file writes them.
    pub fn changed(&self, angle: f64, timing: Timing, change: impl Fn(&mut Value)) -> Levitation {
        let number = |v: &Value, key: &str| v[key].as_f64().unwrap();
        let index = |v: &Value, key: &str| v[key].as_u64().unwrap() as usize;
        let (mut sensors, mut actuators, mut channels) = (Vec::new(), Vec::new(), Vec::new());
        for (magnet, m) in self.file["magnets"].as_array().unwrap().iter().enumerate() {
            let mut m = m.clone();
            assert_eq!(m["controller"]["delay_s"], 5e-5);
            change(&mut m);
            let (m, c) = (&m, &m["controller"]);
            for turned in [0.0, std::f64::consts::FRAC_PI_2] {
                let axis = |node| Axis {
                    name: format!("magnet {magnet} at {turned:.2}"),
                    node,
                    on: None,
                    angle: angle + turned,
                };
                sensors.push(Sensor {
                    axis: axis(index(m, "sensor_node")),
                    corner: Some(number(c, "sensor_rad_s")),
                    offset: 0.0,
                    reference: 0.0,
                });
                actuators.push(Actuator {
                    axis: axis(index(m, "actuator_node")),
                    magnet: Magnet::Linear {
                        current_stiffness: number(m, "ki"),
                        position_stiffness: number(m, "ks"),
                    },
                    lowest_current: f64::NEG_INFINITY,
                    largest_current: f64::INFINITY,
                    amplifier: Amplifier::Current {
                        bandwidth: number(c, "amplifier_rad_s"),
                        slew: f64::INFINITY,
                    },
                });
                let pid = StateSpace::pid(
                    number(c, "Kp"),
                    number(c, "Ki"),
                    number(c, "Kd"),
                    number(c, "Td"),
                );
                channels.push(pid.unwrap());
            }
        }
        let nodes = self.rotor.nodes.len();
        let control = Control::Channels(channels);
        Levitation::new(nodes, sensors, control, timing, actuators).unwrap()
    }

    /// The rotor in a basis: all coordinates, or free modes to 6e4 rad/s with residual flexibility of its loaded nodes.
    pub fn analysis(&self, basis: Basis) -> Analysis {
        let matrices = Matrices::new(&self.rotor);
        let mut coordinates = rotor::Basis::full(&self.rotor, &matrices).unwrap();
        if basis == Basis::Reduced {
            let node = |v: &Value| 2 * v.as_u64().unwrap() as usize;
            let list = |key: &str| self.file[key].as_array().unwrap().iter();
            let mut kept: Vec<usize> = list("magnets")
                .flat_map(|m| [node(&m["actuator_node"]), node(&m["sensor_node"])])
                .chain(list("unbalance").map(|u| node(&u["node"])))
                .collect();
            kept.sort_unstable();
            kept.dedup();
            let forces = rotor::unit_forces(self.rotor.size(), &kept);
            coordinates = coordinates.reduced(6e4, &forces).unwrap();
        }
        Analysis::new(&self.rotor, &matrices, coordinates)
    }

    /// Over complex coordinates.
    pub fn turning(&self, basis: Basis, speed: f64) -> ClosedLoop<C64> {
        let plane = self.levitation(0.0).one_plane().unwrap();
        let nodes = self.rotor.nodes.len();
        ClosedLoop::new(
            Plant::turning(&self.analysis(basis), nodes, speed).unwrap(),
            &plane,
        )
        .unwrap()
    }

    /// Both planes.
    pub fn plant(&self, basis: Basis, speed: f64) -> Plant<f64> {
        Plant::planes(&self.analysis(basis), self.rotor.nodes.len(), speed)
    }

    pub fn unbalance(&self) -> Vec<Unbalance> {
        let list = self.file["unbalance"].as_array().unwrap().iter();
        list.map(|u| Unbalance {
            node: u["node"].as_u64().unwrap() as usize,
            amount: u["kg_m"].as_f64().unwrap(),
            phase: u["phase_rad"].as_f64().unwrap(),
        })
        .collect()
    }
}
