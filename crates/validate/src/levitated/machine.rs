//! The rotors, magnets and unbalances of the reference files as parts of the kernel.

use crate::compare::{Refusal, part, told};
use crate::rotors;
use levitation::{
    Actuator, Amplifier, Axis, C64, ClosedLoop, Control, Levitation, Plant, Refused, Sensor,
    StateSpace, Timing,
};
use physics::magnet::Magnet;
use rotor::{Analysis, Basis, Matrices, Rotor, Unbalance};
use serde::Deserialize;
use serde_json::Value;
use std::f64::consts::FRAC_PI_2;
use std::path::Path;

/// A magnet with its controller, alike on both axes.
#[derive(Deserialize, Clone)]
pub(crate) struct MagnetCase {
    pub(crate) actuator_node: usize,
    pub(crate) sensor_node: usize,
    ki: f64,
    ks: f64,
    pub(crate) controller: Law,
}

#[derive(Deserialize, Clone)]
#[serde(deny_unknown_fields)]
#[allow(non_snake_case)] // names of the files
pub(crate) struct Law {
    pub(crate) Kp: f64,
    #[serde(default)]
    Kd: f64,
    #[serde(default)]
    pub(crate) Ki: f64,
    #[serde(default)]
    Td: f64,
    sensor_rad_s: Option<f64>,
    amplifier_rad_s: Option<f64>,
    #[serde(default)]
    delay_s: f64,
    #[serde(default)]
    biquads: Vec<Quotient>,
}

#[derive(Deserialize, Clone)]
struct Quotient {
    num: Vec<f64>,
    den: Vec<f64>,
}

#[derive(Deserialize)]
struct Plane {
    node: usize,
    kg_m: f64,
    phase_rad: f64,
}

/// A rotor with magnets, and what unbalances it.
pub(crate) struct Machine {
    pub(crate) rotor: Rotor,
    pub(crate) magnets: Vec<MagnetCase>,
    pub(crate) unbalance: Vec<Unbalance>,
}

impl Machine {
    /// Of a file, with damping added to every element: to ground, and rotating.
    pub(crate) fn of(value: &Value, path: &Path, beta: [f64; 2]) -> Result<Self, Refusal> {
        let mut rotor = named_rotor(value, path)?;
        for element in &mut rotor.elements {
            element.damping_of_stiffness += beta[0];
            element.damping_rotating += beta[1];
        }
        let planes: Vec<Plane> = part(&value["unbalance"])?;
        let unbalance = planes.iter().map(|plane| Unbalance {
            node: plane.node,
            amount: plane.kg_m,
            phase: plane.phase_rad,
        });
        let machine = Self {
            magnets: part(&value["magnets"])?,
            unbalance: unbalance.collect(),
            rotor,
        };
        let nodes = machine.rotor.nodes.len();
        let lost = machine.loaded().find(|node| *node >= nodes);
        match lost {
            Some(node) => Err(format!("node {node}, of {nodes} nodes").into()),
            None => Ok(machine),
        }
    }

    /// Nodes of magnets, sensors and unbalances.
    pub(crate) fn loaded(&self) -> impl Iterator<Item = usize> {
        let magnets = self.magnets.iter();
        let magnets = magnets.flat_map(|m| [m.actuator_node, m.sensor_node]);
        magnets.chain(self.unbalance.iter().map(|plane| plane.node))
    }

    pub(crate) fn levitation(&self) -> Result<Levitation, String> {
        let (mut sensors, mut actuators, mut channels) = (Vec::new(), Vec::new(), Vec::new());
        for (number, given) in self.magnets.iter().enumerate() {
            let law = &given.controller;
            let channel = law
                .channel()
                .map_err(|error| format!("magnets[{number}]: {error}"))?;
            for (letter, angle) in [("x", 0.0), ("y", FRAC_PI_2)] {
                let axis = |node| Axis {
                    name: format!("magnet {number} {letter}"),
                    node,
                    on: None,
                    angle,
                };
                sensors.push(Sensor {
                    axis: axis(given.sensor_node),
                    corner: law.sensor_rad_s,
                    offset: 0.0,
                    reference: 0.0,
                });
                actuators.push(Actuator {
                    axis: axis(given.actuator_node),
                    magnet: Magnet::Linear {
                        current_stiffness: given.ki,
                        position_stiffness: given.ks,
                    },
                    lowest_current: f64::NEG_INFINITY,
                    largest_current: f64::INFINITY,
                    amplifier: match law.amplifier_rad_s {
                        Some(bandwidth) => Amplifier::Current {
                            bandwidth,
                            slew: f64::INFINITY,
                        },
                        None => Amplifier::Direct,
                    },
                });
                channels.push(channel.clone());
            }
        }
        let timing = Timing::Continuous { delay: 0.0 };
        let (nodes, control) = (self.rotor.nodes.len(), Control::Channels(channels));
        Levitation::new(nodes, sensors, control, timing, actuators).map_err(told)
    }

    /// The rotor in free modes up to `cut` (rad/s) and residual flexibility of its loaded nodes; in all its modes without end.
    pub(crate) fn analysis(&self, cut: f64) -> Result<Analysis, String> {
        let matrices = Matrices::new(&self.rotor);
        let mut basis = Basis::full(&self.rotor, &matrices).map_err(told)?;
        if cut.is_finite() {
            let mut kept: Vec<usize> = (self.loaded())
                .map(|n| self.rotor.displacement(n))
                .collect();
            kept.sort_unstable();
            kept.dedup();
            let forces = rotor::unit_forces(self.rotor.size(), &kept);
            let reduced = basis.reduced(cut, &forces);
            basis = reduced.map_err(told)?;
        }
        Ok(Analysis::new(&self.rotor, &matrices, basis))
    }

    /// Both axes of every magnet in one plane.
    pub(crate) fn turning(
        &self,
        analysis: &Analysis,
        speed: f64,
    ) -> Result<ClosedLoop<C64>, String> {
        let nodes = self.rotor.nodes.len();
        let plant = Plant::turning(analysis, nodes, speed).ok_or("supports that do not turn")?;
        let plane = self.levitation()?.one_plane().ok_or("axes that differ")?;
        ClosedLoop::new(plant, &plane).map_err(told)
    }

    pub(crate) fn planes(&self, analysis: &Analysis, speed: f64) -> Plant<f64> {
        Plant::planes(analysis, self.rotor.nodes.len(), speed)
    }
}

impl Law {
    fn channel(&self) -> Result<StateSpace, Refused> {
        let mut channel = StateSpace::pid(self.Kp, self.Ki, self.Kd, self.Td)?;
        for filter in &self.biquads {
            channel = channel.then(&StateSpace::rational("filter", &filter.num, &filter.den)?);
        }
        match self.delay_s {
            0.0 => Ok(channel),
            delay => Ok(channel.then(&StateSpace::pade("delay", delay)?)),
        }
    }
}

/// The free rotor of the file that a definition names: beside its own file, or in a folder `rotor` next to that one's.
fn named_rotor(value: &Value, path: &Path) -> Result<Rotor, Refusal> {
    let words = value["definition"]
        .as_str()
        .unwrap_or_default()
        .split_whitespace();
    let mut words = words.map(|word| word.trim_end_matches([',', '.', ';', ':']));
    let named = words
        .find(|word| word.ends_with(".json"))
        .and_then(|word| word.rsplit('/').next());
    let named = named.ok_or("a definition without the file of its rotor")?;
    rotor_beside(named, path)
}

/// The free rotor of a file: beside another one, or in a folder `rotor` next to that one's.
pub(crate) fn rotor_beside(named: &str, path: &Path) -> Result<Rotor, Refusal> {
    let folder = path.parent().unwrap_or(Path::new("."));
    let places = [folder.join(named), folder.join("../rotor").join(named)];
    let found = places.iter().find(|place| place.is_file());
    let found =
        found.ok_or_else(|| format!("its rotor {named} is neither beside it nor in ../rotor"))?;
    let text = std::fs::read_to_string(found).map_err(|error| format!("{named}: {error}"))?;
    let file: Value = serde_json::from_str(&text).map_err(|error| format!("{named}: {error}"))?;
    Ok(rotors::modelled(&file)?.rotor().free())
}
