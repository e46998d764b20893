//! Sensors, controller, delay and amplifiers in the time domain: one list of named states.
//!
//! ```text
//!   displacement y + offset → sensor → e = reference - signal → controller → delay, or held samples → amplifier → current i
//! ```
//! States in this order: sensors, controller, delay or held commands, currents. A linear analysis takes its matrices from
//! [`Levitation::rate`] itself ([`LinearControl`](crate::LinearControl)).
//!
//! With sampled control the controller steps by the bilinear rule and its rest between samples: at k T_s [`Levitation::sample`], at k T_s + T_c
//! [`Levitation::release`] change the states; nothing else jumps.

use crate::parts::{Actuator, Control, Sensor};
use crate::{Refused, StateSpace, checks};
use number::Real;
use physics::magnet::{Amplifier, Timing};
use smallvec::{SmallVec, smallvec};
use std::ops::Range;

/// Sensors, controller and magnets of a rotor.
#[derive(Debug, Clone, PartialEq)]
pub struct Levitation {
    sensors: Vec<Sensor>,
    actuators: Vec<Actuator>,
    blocks: Vec<Block>,
    timing: Timing,
    /// The Padé filter of one command; none without delay or with samples.
    delay: Option<StateSpace>,
    layout: Layout,
}

/// A filter of the controller, from a run of sensors to a run of magnet axes.
#[derive(Debug, Clone, PartialEq)]
struct Block {
    inputs: Range<usize>,
    outputs: Range<usize>,
    states: Range<usize>,
    filter: StateSpace,
    /// The same in steps of the sampling period, and what one unit of input takes from its states at a start.
    stepped: Option<(StateSpace, nalgebra::DMatrix<f64>)>,
}

impl Block {
    /// What it gives at an instant, or at a sample.
    #[inline(always)]
    fn output<R: Real>(&self, states: &[R], signals: &mut Signals<R>) {
        let filter = self
            .stepped
            .as_ref()
            .map_or(&self.filter, |(stepped, _)| stepped);
        filter.output(
            &states[self.states.clone()],
            &signals.errors[self.inputs.clone()],
            &mut signals.wanted[self.outputs.clone()],
        );
    }
}

/// Where states stand.
#[derive(Debug, Clone, PartialEq, Default)]
struct Layout {
    sensors: Vec<Option<usize>>,
    delays: Vec<usize>,
    /// Command computed at the last sample, command held.
    held: Vec<(usize, usize)>,
    currents: Vec<Option<usize>>,
    names: Vec<String>,
}

impl Layout {
    fn add(&mut self, name: String) -> usize {
        self.names.push(name);
        self.names.len() - 1
    }
}

/// A value for each axis, without allocation up to four magnets.
pub type OfAxes<R> = SmallVec<[R; 8]>;

/// Signals of one instant; room that [`Levitation::rate`] fills and a caller may read.
#[derive(Debug, Clone)]
pub struct Signals<R> {
    /// Reference minus signal of every sensor axis, m.
    pub errors: OfAxes<R>,
    /// Command of every magnet axis as the controller gives it: A, or V where an amplifier takes volts.
    pub wanted: OfAxes<R>,
    /// The same behind delay or hold.
    pub commands: OfAxes<R>,
    /// Control current of every magnet axis, A.
    pub currents: OfAxes<R>,
}

impl Levitation {
    /// Of a rotor with `nodes` nodes; refused where something cannot be.
    pub fn new(
        nodes: usize,
        sensors: Vec<Sensor>,
        control: Control,
        timing: Timing,
        actuators: Vec<Actuator>,
    ) -> Result<Self, Refused> {
        checks::all(nodes, &sensors, &control, timing, &actuators)?;
        let mut layout = Layout::default();
        for sensor in &sensors {
            let state = (sensor.corner).map(|_| layout.add(format!("{}.signal", sensor.axis.name)));
            layout.sensors.push(state);
        }
        let blocks = blocks(&sensors, control, timing, &mut layout)?;
        let delay = match timing {
            Timing::Continuous { delay } if delay > 0.0 => Some(StateSpace::pade("delay", delay)?),
            _ => None,
        };
        for actuator in &actuators {
            let name = &actuator.axis.name;
            if let Some(delay) = &delay {
                layout.delays.push(layout.names.len());
                for state in delay.names() {
                    layout.add(format!("{name}.{state}"));
                }
            }
            if let Timing::Sampled { .. } = timing {
                let computed = layout.add(format!("{name}.command computed"));
                let held = layout.add(format!("{name}.command held"));
                layout.held.push((computed, held));
            }
        }
        for actuator in &actuators {
            let current = match actuator.amplifier {
                Amplifier::Direct => None,
                _ => Some(layout.add(format!("{}.current", actuator.axis.name))),
            };
            layout.currents.push(current);
        }
        Ok(Self {
            sensors,
            actuators,
            blocks,
            timing,
            delay,
            layout,
        })
    }

    /// Number of states.
    #[must_use]
    pub fn states(&self) -> usize {
        self.layout.names.len()
    }
    /// Names of the states, in their order.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.layout.names
    }
    /// The sensor axes.
    #[must_use]
    pub fn sensors(&self) -> &[Sensor] {
        &self.sensors
    }
    /// The magnet axes.
    #[must_use]
    pub fn actuators(&self) -> &[Actuator] {
        &self.actuators
    }
    /// When commands take effect.
    #[must_use]
    pub fn timing(&self) -> Timing {
        self.timing
    }
    /// Room for the signals of an instant.
    #[must_use]
    pub fn signals<R: Real>(&self) -> Signals<R> {
        Signals {
            errors: smallvec![R::zero(); self.sensors.len()],
            wanted: smallvec![R::zero(); self.actuators.len()],
            commands: smallvec![R::zero(); self.actuators.len()],
            currents: smallvec![R::zero(); self.actuators.len()],
        }
    }

    /// Rates of the states; the signals on the way are left in `signals`.
    ///
    /// - `displacements` of every sensor axis along its direction, m
    /// - `velocities` of every magnet axis along its direction, m/s: they induce voltage
    #[inline(always)]
    pub fn rate<R: Real>(
        &self,
        states: &[R],
        displacements: &[R],
        velocities: &[R],
        signals: &mut Signals<R>,
        rates: &mut [R],
    ) {
        self.read(states, displacements, signals);
        for (index, sensor) in self.sensors.iter().enumerate() {
            if let (Some(at), Some(corner)) = (self.layout.sensors[index], sensor.corner) {
                let shown = displacements[index] + R::splat(sensor.offset);
                rates[at] = R::splat(corner) * (shown - states[at]);
            }
        }
        match self.timing {
            Timing::Sampled { .. } => {
                let held = self.layout.held.iter().flat_map(|(a, b)| [*a, *b]);
                for at in self
                    .blocks
                    .iter()
                    .flat_map(|b| b.states.clone())
                    .chain(held)
                {
                    rates[at] = R::zero();
                }
            }
            Timing::Continuous { .. } => {
                for block in &self.blocks {
                    let inputs = &signals.errors[block.inputs.clone()];
                    let own = &mut rates[block.states.clone()];
                    block
                        .filter
                        .rates(&states[block.states.clone()], inputs, own);
                }
                for (axis, at) in self.layout.delays.iter().enumerate() {
                    let Some(delay) = &self.delay else { continue };
                    let own = *at..at + delay.states();
                    let wanted = &signals.wanted[axis..=axis];
                    delay.rates(&states[own.clone()], wanted, &mut rates[own]);
                }
            }
        }
        for (index, actuator) in self.actuators.iter().enumerate() {
            if let Some(at) = self.layout.currents[index] {
                let command = signals.commands[index];
                rates[at] = current_rate(actuator, command, states[at], velocities[index]);
            }
        }
    }

    /// Signals of an instant from the states: errors, commands, currents.
    #[inline(always)]
    pub fn read<R: Real>(&self, states: &[R], displacements: &[R], signals: &mut Signals<R>) {
        for (index, sensor) in self.sensors.iter().enumerate() {
            let signal = match self.layout.sensors[index] {
                Some(at) => states[at],
                None => displacements[index] + R::splat(sensor.offset),
            };
            signals.errors[index] = R::splat(sensor.reference) - signal;
        }
        for block in &self.blocks {
            block.output(states, signals);
        }
        match (&self.delay, self.timing) {
            (_, Timing::Sampled { .. }) => {
                for (command, (_, held)) in signals.commands.iter_mut().zip(&self.layout.held) {
                    *command = states[*held];
                }
            }
            (None, _) => signals.commands.copy_from_slice(&signals.wanted),
            (Some(delay), _) => {
                for (axis, at) in self.layout.delays.iter().enumerate() {
                    let own = &states[*at..at + delay.states()];
                    let (wanted, out) = (&signals.wanted, &mut signals.commands);
                    delay.output(own, &wanted[axis..=axis], &mut out[axis..=axis]);
                }
            }
        }
        for (command, actuator) in signals.commands.iter_mut().zip(&self.actuators) {
            if let Some([least, most]) = actuator.command_limits() {
                *command = command.min(R::splat(most)).max(R::splat(least));
            }
        }
        for (index, current) in signals.currents.iter_mut().enumerate() {
            *current = match self.layout.currents[index] {
                Some(at) => states[at],
                None => signals.commands[index],
            };
        }
    }

    /// Whether an amplifier has a largest voltage.
    #[must_use]
    pub fn limits_voltage(&self) -> bool {
        let limited = |actuator: &Actuator| match actuator.amplifier {
            Amplifier::Voltage {
                largest_voltage, ..
            } => largest_voltage.is_finite(),
            _ => false,
        };
        self.actuators.iter().any(limited)
    }

    /// Of every magnet axis with signals that were [read](Levitation::read): the voltage it asks for over the largest its amplifier
    /// has; 0 without a limit.
    #[must_use]
    pub fn voltage_shares(&self, signals: &Signals<f64>) -> OfAxes<f64> {
        let share = |(index, actuator): (usize, &Actuator)| match actuator.amplifier {
            Amplifier::Voltage {
                gain,
                largest_voltage,
                ..
            } => {
                let asked = volts(gain, signals.commands[index], signals.currents[index]);
                asked.abs() / largest_voltage
            }
            _ => 0.0,
        };
        self.actuators.iter().enumerate().map(share).collect()
    }

    /// A sample of a sampled controller at k T_s: its command is computed, its states step.
    pub fn sample<R: Real>(&self, states: &mut [R], displacements: &[R], signals: &mut Signals<R>) {
        self.read(states, displacements, signals);
        for block in &self.blocks {
            let Some((stepped, _)) = &block.stepped else {
                continue;
            };
            let before = states[block.states.clone()].to_vec();
            let inputs = &signals.errors[block.inputs.clone()];
            stepped.rates(&before, inputs, &mut states[block.states.clone()]);
        }
        for ((computed, _), command) in self.layout.held.iter().zip(&signals.wanted) {
            states[*computed] = *command;
        }
    }

    /// At k T_s + T_c: the command of the last sample is held from now on.
    pub fn release<R: Real>(&self, states: &mut [R]) {
        for (computed, held) in &self.layout.held {
            states[*held] = states[*computed];
        }
    }

    /// Where the current of a magnet axis stands among the states; none where it is the command at once.
    #[must_use]
    pub fn current_state(&self, actuator: usize) -> Option<usize> {
        self.layout.currents[actuator]
    }

    /// The same loop for linear analysis: samples as a delay T_c + T_s/2, no limit of current or voltage, no offset, no reference.
    #[must_use]
    pub fn linear(&self) -> Self {
        let mut sensors = self.sensors.clone();
        for sensor in &mut sensors {
            (sensor.offset, sensor.reference) = (0.0, 0.0);
        }
        self.centred(sensors)
    }

    /// States of the time run from those of linear analysis: a delay becomes commands that are held.
    pub(crate) fn adopted(&self, states: &[f64], displacements: &[f64]) -> Vec<f64> {
        let Timing::Sampled { .. } = self.timing else {
            return states.to_vec();
        };
        let linear = self.unlimited();
        let mut signals = linear.signals();
        linear.read(states, displacements, &mut signals);
        let mut out = vec![0.0; self.states()];
        // sensors and controller stand first in both, currents last
        let first = self.blocks.last().map_or(0, |block| block.states.end);
        out[..first].copy_from_slice(&states[..first]);
        for block in &self.blocks {
            let Some((_, entry)) = &block.stepped else {
                continue;
            };
            let inputs = &signals.errors[block.inputs.clone()];
            let taken = entry * nalgebra::DVector::from_column_slice(inputs);
            for (state, taken) in out[block.states.clone()].iter_mut().zip(taken.iter()) {
                *state -= taken;
            }
        }
        for (index, (computed, held)) in self.layout.held.iter().enumerate() {
            (out[*computed], out[*held]) = (signals.wanted[index], signals.commands[index]);
        }
        for (index, at) in self.layout.currents.iter().enumerate() {
            if let Some(at) = at {
                out[*at] = signals.currents[index];
            }
        }
        out
    }

    /// As [`Levitation::linear`], with offsets and references kept.
    #[must_use]
    pub(crate) fn unlimited(&self) -> Self {
        self.centred(self.sensors.clone())
    }

    fn centred(&self, sensors: Vec<Sensor>) -> Self {
        let mut actuators = self.actuators.clone();
        for actuator in &mut actuators {
            actuator.lowest_current = f64::NEG_INFINITY;
            actuator.largest_current = f64::INFINITY;
            if let Amplifier::Voltage {
                largest_voltage, ..
            } = &mut actuator.amplifier
            {
                *largest_voltage = f64::INFINITY;
            }
        }
        self.rebuilt(sensors, self.blocks.clone(), actuators)
    }

    /// One of two equal planes: the even axes alone. `None` unless axes come in equal pairs at right angles, each sensor
    /// along its magnet, with a filter for each axis; then w = x + jy passes the same real filters.
    #[must_use]
    pub fn one_plane(&self) -> Option<Self> {
        let equal = checks::pairs_alike(&self.sensors, &self.actuators)
            && self.blocks.len() == self.sensors.len()
            && self
                .blocks
                .chunks(2)
                .all(|pair| pair.len() == 2 && pair[0].filter.same_matrices(&pair[1].filter));
        equal.then(|| {
            let even = |index: &usize| index.is_multiple_of(2);
            let pick = |count: usize| (0..count).filter(even);
            let sensors = pick(self.sensors.len()).map(|at| self.sensors[at].clone());
            let blocks = pick(self.blocks.len()).map(|at| self.blocks[at].clone());
            let actuators = pick(self.actuators.len()).map(|at| self.actuators[at].clone());
            self.rebuilt(sensors.collect(), blocks.collect(), actuators.collect())
        })
    }

    /// [One plane](Levitation::one_plane) with the slopes (k_i, k_s) of its axes, where those of both planes are equal too.
    #[must_use]
    pub fn one_plane_about(&self, slopes: &[(f64, f64)]) -> Option<(Self, Vec<(f64, f64)>)> {
        // a weight that both axes share leaves them equal up to round-off
        let equal = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b.abs();
        let alike =
            |pair: &[(f64, f64)]| equal(pair[0].0, pair[1].0) && equal(pair[0].1, pair[1].1);
        let plane = self.one_plane()?;
        let even = slopes.iter().step_by(2).copied().collect();
        slopes.chunks(2).all(alike).then_some((plane, even))
    }

    /// The same with other parts that are known to be right.
    fn rebuilt(&self, sensors: Vec<Sensor>, blocks: Vec<Block>, actuators: Vec<Actuator>) -> Self {
        let nodes = usize::MAX;
        let timing = Timing::Continuous {
            delay: self.timing.delay(),
        };
        let channels = blocks.iter().all(|block| block.inputs.len() == 1);
        let control = match &blocks[..] {
            [block] if !channels => Control::Matrix(block.filter.clone()),
            _ => Control::Channels(blocks.into_iter().map(|block| block.filter).collect()),
        };
        Self::new(nodes, sensors, control, timing, actuators).expect("parts of a levitation fit")
    }

    /// k_i and k_s of every magnet axis with the rotor in the centre and no control current.
    #[must_use]
    pub fn slopes_at_centre(&self) -> Vec<(f64, f64)> {
        let magnets = self.actuators.iter().map(|actuator| &actuator.magnet);
        let slopes = magnets.map(|own| (own.current_stiffness(), own.position_stiffness()));
        slopes.collect()
    }

    /// Gain at rest of the controller from signals to commands, row by magnet axis; `None` with an integrator.
    #[must_use]
    pub fn static_gain(&self) -> Option<nalgebra::DMatrix<f64>> {
        let mut out = nalgebra::DMatrix::zeros(self.actuators.len(), self.sensors.len());
        for block in &self.blocks {
            let gain = block.filter.static_gain()?;
            let size = gain.shape();
            out.view_mut((block.outputs.start, block.inputs.start), size)
                .copy_from(&gain);
        }
        Some(out)
    }

    /// Static stiffness of every magnet axis with a channel of its own, k_i C(0) - k_s in N/m; infinite with an integrator.
    ///
    /// It is that of the bearing where sensor and magnet stand at one node. Empty where one filter serves all axes.
    ///
    /// - `slopes` k_i and k_s of each axis
    #[must_use]
    pub fn static_stiffness(&self, slopes: &[(f64, f64)]) -> Vec<f64> {
        let own = self.blocks.len() == self.actuators.len();
        let blocks = self.blocks.iter().zip(&self.actuators).filter(|_| own);
        blocks
            .zip(slopes)
            .map(|((block, actuator), (ki, ks))| {
                let volts_to_amperes = match actuator.amplifier {
                    Amplifier::Voltage {
                        resistance, gain, ..
                    } => gain.map_or(1.0 / resistance, |gain| gain / (gain + resistance)),
                    _ => 1.0,
                };
                let gain = block.filter.static_gain().map(|gain| gain[(0, 0)]);
                gain.map_or(f64::INFINITY, |gain| ki * gain * volts_to_amperes - ks)
            })
            .collect()
    }
}

/// The filters of the controller with their places.
fn blocks(
    sensors: &[Sensor],
    control: Control,
    timing: Timing,
    layout: &mut Layout,
) -> Result<Vec<Block>, Refused> {
    let stepped = |filter: &StateSpace| match timing {
        Timing::Sampled { period, .. } => filter.stepped(period).ok_or(Refused::Singular).map(Some),
        Timing::Continuous { .. } => Ok(None),
    };
    let mut block = |filter: StateSpace, inputs: Range<usize>, name: &str| {
        let first = layout.names.len();
        for state in filter.names() {
            layout.add(format!("{name}.{state}"));
        }
        let outputs = inputs.start..inputs.start + filter.outputs();
        Ok(Block {
            outputs,
            inputs,
            states: first..layout.names.len(),
            stepped: stepped(&filter)?,
            filter,
        })
    };
    match control {
        Control::Matrix(filter) => Ok(vec![block(filter, 0..sensors.len(), "controller")?]),
        Control::Channels(filters) => filters
            .into_iter()
            .zip(sensors)
            .enumerate()
            .map(|(index, (filter, sensor))| block(filter, index..index + 1, &sensor.axis.name))
            .collect(),
    }
}

/// What a voltage amplifier would give without its limit, V.
#[inline(always)]
fn volts<R: Real>(gain: Option<f64>, command: R, current: R) -> R {
    match gain {
        Some(gain) => R::splat(gain) * (command - current),
        None => command,
    }
}

/// Rate of the current of an amplifier that has one.
#[inline(always)]
fn current_rate<R: Real>(actuator: &Actuator, command: R, current: R, velocity: R) -> R {
    match actuator.amplifier {
        Amplifier::Direct => R::zero(),
        Amplifier::Current { bandwidth } => R::splat(bandwidth) * (command - current),
        Amplifier::Voltage {
            inductance,
            resistance,
            gain,
            largest_voltage,
        } => {
            let wanted = volts(gain, command, current);
            let most = R::splat(largest_voltage);
            let voltage = wanted.min(most).max(-most);
            let induced = R::splat(actuator.magnet.current_stiffness()) * velocity;
            (voltage - R::splat(resistance) * current - induced) / R::splat(inductance)
        }
    }
}
