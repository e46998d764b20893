//! Constants of magnets, sensors and controllers.

use super::conditions::{Change, Conditions, What};
use ::levitation::{Commands, Levitation, LinearControl};
use number::Vec2;
use physics::magnet::{Magnet, Timing};
use std::sync::Arc;

/// The magnets of a rotor.
#[derive(Clone, Debug, PartialEq)]
pub struct MagnetsConstants {
    /// Each at a node.
    pub magnets: Vec<MagnetConstants>,
    /// What holds the rotor by them.
    pub supply: SupplyConstants,
}

/// Where the currents of magnets come from.
#[derive(Clone, Debug, PartialEq)]
pub enum SupplyConstants {
    /// From nothing: they decay.
    Lost {
        /// 1/τ, 1/s.
        decay_rate: f64,
        /// Instant from which on they do, not after the start, s.
        at: f64,
    },
    /// From controllers.
    Control(ControlConstants),
}

/// A magnet at a node.
#[derive(Clone, Debug, PartialEq)]
pub struct MagnetConstants {
    /// Row φ of the node.
    pub node: Vec<f64>,
    /// Its axes, in the order of the levitation.
    pub axes: Vec<AxisConstants>,
}

/// An axis of a magnet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisConstants {
    /// Direction, a unit vector.
    pub direction: Vec2<f64>,
    /// Force law.
    pub law: Magnet<f64>,
    /// Control current at the start, where nothing controls it, A.
    pub current: f64,
}

/// Sensors, controllers and amplifiers.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlConstants {
    /// Their rates.
    pub levitation: Arc<Levitation>,
    /// Row φ of each sensor's node with the directions of its axes, in the order of the levitation.
    pub sensors: Vec<(Vec<f64>, Vec<Vec2<f64>>)>,
    /// States of the levitation at the start.
    pub start: Vec<f64>,
    /// What happens during the run; when, the schedule of the machine says.
    pub changes: Arc<[Change]>,
    /// Without a controller, the loop whose it was: errors of states count as there.
    pub(super) reference: Option<Arc<Levitation>>,
    pub(super) conditions: Arc<Conditions>,
}

/// What happens to magnets and controllers at an instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ControlEvent {
    /// One of the changes of the run.
    Change(usize),
    /// A sample is taken and its command computed.
    Sample,
    /// The last command computed is held from now on.
    Release,
}

impl ControlConstants {
    /// A levitation at its nodes with its states at the start, and what happens to it.
    pub fn new(
        levitation: Levitation,
        sensors: Vec<(Vec<f64>, Vec<Vec2<f64>>)>,
        start: Vec<f64>,
        changes: Vec<Change>,
    ) -> Self {
        ControlConstants {
            conditions: Arc::new(Conditions::of(&levitation, &changes)),
            levitation: Arc::new(levitation),
            sensors,
            start,
            changes: changes.into(),
            reference: None,
        }
    }
    /// The same without its controller, at these commands: A, V or N. Forces leave nothing for a loss, a re-levitation, a frozen
    /// controller or limits to change.
    ///
    /// # Errors
    /// The first axis whose amplifier takes no such command.
    fn without_controller(&self, kind: Commands, commands: &[f64]) -> Result<Self, usize> {
        let levitation = self.levitation.without_controller(kind)?;
        let own = self.levitation.names();
        let from = |name: &String| own.iter().position(|other| other == name);
        let start = levitation.names().iter();
        let start = start.map(|name| from(name).map_or(0.0, |at| self.start[at]));
        let mut start: Vec<f64> = start.collect();
        for (axis, command) in commands.iter().enumerate() {
            if let Some(at) = levitation.command(axis) {
                start[at] = *command;
            }
        }
        let mut changes = self.changes.to_vec();
        if kind == Commands::Force {
            let magnets = |what: &What| !what.is_of_sensor();
            // their places stay, at which events name them
            let emptied = changes.iter_mut().filter(|own| magnets(&own.what));
            emptied.for_each(|own| own.axes.clear());
        }
        Ok(ControlConstants {
            reference: Some(self.levitation.clone()),
            ..ControlConstants::new(levitation, self.sensors.clone(), start, changes)
        })
    }
    /// Samples of the controller between two instants of a run, with what they do; the sample of the start is taken already.
    pub fn samples(&self, from: f64, to: f64) -> Vec<(f64, ControlEvent)> {
        let mut events = Vec::new();
        if let Timing::Sampled {
            period,
            computation,
        } = self.levitation.timing()
        {
            let mut k = 0.0;
            while k * period < to {
                if k > 0.0 {
                    events.push((k * period, ControlEvent::Sample));
                }
                // one without computing time is released in the start already; none comes after the next sample
                if k > 0.0 || computation > 0.0 {
                    let release = (k * period + computation).min((k + 1.0) * period);
                    events.push((release, ControlEvent::Release));
                }
                k += 1.0;
            }
            events.retain(|(time, _)| (from..to).contains(time));
        }
        events
    }
    /// The states at the start of a run.
    pub fn start(&self) -> Vec<f64> {
        let mut states = self.start.clone();
        states.resize(self.names().len(), 0.0);
        self.conditions.start(&self.levitation, &mut states);
        states
    }
    /// Names of the states: those of the levitation, then those of the conditions.
    fn names(&self) -> Vec<String> {
        let own = self.levitation.names().iter();
        own.chain(&self.conditions.names).cloned().collect()
    }
}

impl MagnetsConstants {
    /// Linear magnets whose currents decay from an instant on, not after the start: the row of each, its force F_0 = k_i i (N) of that instant, k_s (N/m).
    pub fn fading(
        all: impl IntoIterator<Item = (Vec<f64>, Vec2<f64>, f64)>,
        decay_rate: f64,
        at: f64,
    ) -> Self {
        let magnet = |(node, force, stiffness): (Vec<f64>, Vec2<f64>, f64)| {
            let axis = |direction: Vec2<f64>| AxisConstants {
                direction,
                law: Magnet::Linear {
                    current_stiffness: 1.0,
                    position_stiffness: stiffness,
                },
                current: force.dot(direction),
            };
            let axes = vec![axis(Vec2::new(1.0, 0.0)), axis(Vec2::new(0.0, 1.0))];
            MagnetConstants { node, axes }
        };
        MagnetsConstants {
            magnets: all.into_iter().map(magnet).collect(),
            supply: SupplyConstants::Lost { decay_rate, at },
        }
    }

    /// The same without their controllers, at these commands, A, V or N; none where there are none.
    ///
    /// # Errors
    /// The first axis whose amplifier takes no such command.
    pub fn without_controller(
        &self,
        kind: Commands,
        commands: &[f64],
    ) -> Result<Option<Self>, usize> {
        let Some(control) = self.control() else {
            return Ok(None);
        };
        let control = control.without_controller(kind, commands)?;
        let mut magnets = self.magnets.clone();
        let axes = magnets.iter_mut().flat_map(|magnet| &mut magnet.axes);
        for (axis, own) in axes.zip(control.levitation.actuators()) {
            axis.law = own.magnet;
        }
        Ok(Some(MagnetsConstants {
            magnets,
            supply: SupplyConstants::Control(control),
        }))
    }

    /// What controls the currents, where anything does.
    pub fn control(&self) -> Option<&ControlConstants> {
        match &self.supply {
            SupplyConstants::Lost { .. } => None,
            SupplyConstants::Control(control) => Some(control),
        }
    }

    /// Rows of all nodes.
    pub fn nodes(&self) -> impl Iterator<Item = &Vec<f64>> {
        let sensors = self.control().into_iter().flat_map(|own| &own.sensors);
        let magnets = self.magnets.iter().map(|magnet| &magnet.node);
        magnets.chain(sensors.map(|(node, _)| node))
    }

    /// Names of the states.
    pub fn state_names(&self) -> Vec<String> {
        self.control().map_or(Vec::new(), ControlConstants::names)
    }

    /// What matters in each state when the rotor is displaced by a length, m.
    pub fn error_scale(&self, scale: &mut [f64], displacement: f64) {
        if let Some(control) = self.control() {
            scale.fill(1.0);
            let of = control.reference.as_ref().unwrap_or(&control.levitation);
            let own = LinearControl::scales(of, displacement);
            for (scale, name) in scale.iter_mut().zip(control.levitation.names()) {
                let at = of.names().iter().position(|other| other == name);
                *scale = at.map_or(1.0, |at| own[at]);
            }
        }
    }

    /// Whether other magnets can stand beside these in lanes.
    pub fn share_lanes(&self, other: &Self) -> bool {
        let kinds = |all: &Self| -> Vec<Vec<bool>> {
            let pair = |axis: &AxisConstants| matches!(axis.law, Magnet::Pair(_));
            let axes = |magnet: &MagnetConstants| magnet.axes.iter().map(pair).collect();
            all.magnets.iter().map(axes).collect()
        };
        let loop_of = |all: &Self| {
            let control = all.control();
            control.map(|own| (own.levitation.clone(), own.conditions.clone()))
        };
        kinds(self) == kinds(other) && loop_of(self) == loop_of(other)
    }
}
