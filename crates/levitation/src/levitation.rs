//! Sensors, controller, delay and amplifiers in the time domain: one list of named states.
//!
//! ```text
//!   displacement y + offset → sensor → e = reference - signal → controller → delay, or held samples → amplifier → current i
//!
//!   control current    command clipped to what the coils leave, di/dt of the amplifier          linear magnets, volts, no amplifier
//!   coils of a pair    di±/dt = clip(ω (clip(e b± ± u, 0, i_max) - i±), ±s)                     on a current amplifier
//! ```
//! Clipped are commands and rates, not forces; integrators go on integrating while they are.
//!
//! States in this order: sensors, controller, delay or held commands, currents. A linear analysis takes its matrices from
//! [`Levitation::rate`] itself ([`LinearControl`](crate::LinearControl)).
//!
//! With sampled control the controller steps by the bilinear rule and its rest between samples: at k T_s [`Levitation::sample`], at k T_s + T_c
//! [`Levitation::release`] change the states; nothing else jumps. [Without a controller](Levitation::without_controller) its commands
//! are states that whoever drives the machine changes.

use crate::parts::{Actuator, Condition, Control, Sensor};
use crate::{Refused, StateSpace, checks};
use nalgebra::DVector;
use number::Real;
use physics::magnet::{Amplifier, Timing};
use smallvec::{SmallVec, smallvec};
use std::ops::Range;

/// Sensors, controller and magnets of a rotor.
#[derive(Debug, Clone, PartialEq)]
pub struct Levitation {
    pub(crate) sensors: Vec<Sensor>,
    pub(crate) actuators: Vec<Actuator>,
    pub(crate) blocks: Vec<Block>,
    pub(crate) timing: Timing,
    /// The Padé filter of one command; none without delay or with samples.
    pub(crate) delay: Option<StateSpace>,
    pub(crate) layout: Layout,
}

/// A filter of the controller, from a run of sensors to a run of magnet axes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Block {
    pub(crate) inputs: Range<usize>,
    pub(crate) outputs: Range<usize>,
    pub(crate) states: Range<usize>,
    pub(crate) filter: StateSpace,
    /// The same in steps of the sampling period, and what one unit of input takes from its states at a start.
    pub(crate) stepped: Option<(StateSpace, nalgebra::DMatrix<f64>)>,
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
pub(crate) struct Layout {
    pub(crate) sensors: Vec<Option<usize>>,
    delays: Vec<usize>,
    /// Command computed at the last sample, command held.
    pub(crate) held: Vec<(usize, usize)>,
    /// Control current, both coils, or nothing.
    pub(crate) currents: Vec<Range<usize>>,
    names: Vec<String>,
}

impl Layout {
    /// With the states of sensors alone.
    pub(crate) fn of(sensors: &[Sensor]) -> Self {
        let mut layout = Layout::default();
        for sensor in sensors {
            let state = (sensor.corner).map(|_| layout.add(format!("{}.signal", sensor.axis.name)));
            layout.sensors.push(state);
        }
        layout
    }
    /// Adds those of currents.
    pub(crate) fn add_currents(&mut self, actuators: &[Actuator]) {
        for actuator in actuators {
            let first = self.names.len();
            let name = &actuator.axis.name;
            if actuator.has_coils() {
                self.add(format!("{name}.current +"));
                self.add(format!("{name}.current -"));
            } else if actuator.amplifier != Amplifier::Direct {
                self.add(format!("{name}.current"));
            }
            self.currents.push(first..self.names.len());
        }
    }
    /// States of filters, delays and held commands.
    fn filters(&self) -> Range<usize> {
        let first = self.sensors.iter().flatten().count();
        let currents = self.currents.iter().map(Range::len).sum::<usize>();
        first..self.names.len() - currents
    }
    pub(crate) fn add(&mut self, name: String) -> usize {
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
    /// Currents of both coils of every magnet axis whose coils [have currents of their own](Levitation::has_coils), A.
    pub coils: SmallVec<[[R; 2]; 8]>,
}

/// What acts on sensors and amplifiers at an instant.
#[derive(Debug, Clone, Copy)]
pub struct Inputs<'a, R> {
    /// Displacements of every sensor axis along its direction, m.
    pub displacements: &'a [R],
    /// Velocities of every magnet axis along its direction, m/s: they induce voltage.
    pub velocities: &'a [R],
    /// What is added to the reference of every sensor axis, m; nothing where empty.
    pub references: &'a [R],
    /// What has happened to every magnet axis; nothing where empty.
    pub conditions: &'a [Condition<R>],
}

impl<'a, R> Inputs<'a, R> {
    /// Of sensors and magnets to which nothing has happened.
    pub fn usual(displacements: &'a [R], velocities: &'a [R]) -> Self {
        Inputs {
            displacements,
            velocities,
            references: &[],
            conditions: &[],
        }
    }
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
        let mut layout = Layout::of(&sensors);
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
        layout.add_currents(&actuators);
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
            coils: smallvec![[R::zero(); 2]; self.actuators.len()],
        }
    }

    /// Rates of the states; the signals on the way are left in `signals`.
    #[inline(always)]
    pub fn rate<R: Real>(
        &self,
        states: &[R],
        inputs: Inputs<R>,
        signals: &mut Signals<R>,
        rates: &mut [R],
    ) {
        self.read(states, inputs, signals);
        for (index, sensor) in self.sensors.iter().enumerate() {
            if let (Some(at), Some(corner)) = (self.layout.sensors[index], sensor.corner) {
                let shown = inputs.displacements[index] + R::splat(sensor.offset);
                rates[at] = R::splat(corner) * (shown - states[at]);
            }
        }
        match self.timing {
            Timing::Sampled { .. } | Timing::Held => {
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
            let command = signals.commands[index];
            let at = self.layout.currents[index].clone();
            if at.is_empty() {
                continue;
            }
            let velocity = inputs.velocities[index];
            let condition = condition(actuator, inputs.conditions.get(index));
            if !actuator.has_coils() {
                rates[at.start] = current_rate(
                    actuator,
                    command,
                    states[at.start],
                    velocity,
                    condition.slew,
                );
                continue;
            }
            for ((at, bias), sign) in at.zip(actuator.magnet.biases()).zip([1.0, -1.0]) {
                let wanted = R::splat(bias) * condition.bias_share + R::splat(sign) * command;
                let wanted = wanted.max(R::zero()).min(condition.largest_current);
                rates[at] = current_rate(actuator, wanted, states[at], velocity, condition.slew);
            }
        }
    }

    /// Signals of an instant from the states: errors, commands, currents.
    #[inline(always)]
    pub fn read<R: Real>(&self, states: &[R], inputs: Inputs<R>, signals: &mut Signals<R>) {
        for (index, sensor) in self.sensors.iter().enumerate() {
            let signal = match self.layout.sensors[index] {
                Some(at) => states[at],
                None => inputs.displacements[index] + R::splat(sensor.offset),
            };
            let mut reference = R::splat(sensor.reference);
            if let Some(added) = inputs.references.get(index) {
                reference += *added;
            }
            signals.errors[index] = reference - signal;
        }
        for block in &self.blocks {
            block.output(states, signals);
        }
        match (&self.delay, self.timing) {
            (_, Timing::Sampled { .. } | Timing::Held) => {
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
        for (index, actuator) in self.actuators.iter().enumerate() {
            let given = inputs.conditions.get(index);
            let condition = condition(actuator, given);
            let mut command = signals.commands[index];
            if given.is_some() {
                command = condition.command_share * command + condition.command_held;
            }
            let [plus, minus] =
                (actuator.magnet.biases()).map(|b| R::splat(b) * condition.bias_share);
            let coils = actuator.has_coils();
            if !coils && !actuator.takes_volts() {
                let largest = condition.largest_current;
                command = command.min(largest - plus).max(minus - largest);
            }
            signals.commands[index] = command;
            let at = self.layout.currents[index].clone();
            if coils {
                let [near, far] = [states[at.start], states[at.start + 1]];
                signals.coils[index] = [near, far];
                signals.currents[index] = R::splat(0.5) * ((near - plus) - (far - minus));
            } else {
                let own = at.is_empty();
                signals.currents[index] = if own { command } else { states[at.start] };
            }
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
    pub fn sample<R: Real>(&self, states: &mut [R], inputs: Inputs<R>, signals: &mut Signals<R>) {
        self.read(states, inputs, signals);
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

    /// Where the current of a magnet axis stands among the states, or those of its coils; nowhere where it is the command at once.
    #[must_use]
    pub fn current_states(&self, actuator: usize) -> Range<usize> {
        self.layout.currents[actuator].clone()
    }
    /// Whether each coil of a magnet axis has a current of its own.
    #[must_use]
    pub fn has_coils(&self, actuator: usize) -> bool {
        self.layout.currents[actuator].len() == 2
    }

    /// Settles sensors, filters and delay on what the sensors show, and takes all currents away: controllers that start when a rotor
    /// lies still. Integrators, states whose rate depends on no state, start at zero.
    pub fn settle(&self, states: &mut [f64], inputs: Inputs<f64>) -> Result<(), Refused> {
        for (index, sensor) in self.sensors.iter().enumerate() {
            if let Some(at) = self.layout.sensors[index] {
                states[at] = inputs.displacements[index] + sensor.offset;
            }
        }
        if self.timing == Timing::Held {
            // commands stay those of whoever drives the machine
            for at in &self.layout.currents {
                states[at.clone()].fill(0.0);
            }
            return Ok(());
        }
        let mut signals = self.signals();
        states[self.layout.filters()].fill(0.0);
        self.read(states, inputs, &mut signals);
        for block in &self.blocks {
            let errors = DVector::from_column_slice(&signals.errors[block.inputs.clone()]);
            let mut settled = block.filter.settled(&errors).ok_or(Refused::Singular)?;
            if let Some((_, entry)) = &block.stepped {
                settled -= entry * errors;
            }
            states[block.states.clone()].copy_from_slice(settled.as_slice());
        }
        self.read(states, inputs, &mut signals);
        for (axis, at) in self.layout.delays.iter().enumerate() {
            let Some(delay) = &self.delay else { continue };
            let wanted = DVector::from_element(1, signals.wanted[axis]);
            let settled = delay.settled(&wanted).ok_or(Refused::Singular)?;
            states[*at..at + delay.states()].copy_from_slice(settled.as_slice());
        }
        for ((computed, held), wanted) in self.layout.held.iter().zip(&signals.wanted) {
            (states[*computed], states[*held]) = (*wanted, *wanted);
        }
        for at in &self.layout.currents {
            states[at.clone()].fill(0.0);
        }
        Ok(())
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
        Timing::Continuous { .. } | Timing::Held => Ok(None),
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
pub(crate) fn volts<R: Real>(gain: Option<f64>, command: R, current: R) -> R {
    match gain {
        Some(gain) => R::splat(gain) * (command - current),
        None => command,
    }
}

/// What has happened to an axis, where anything has.
#[inline(always)]
fn condition<R: Real>(actuator: &Actuator, given: Option<&Condition<R>>) -> Condition<R> {
    match given {
        Some(given) => *given,
        None => Condition::of(actuator),
    }
}

/// Rate of the current of an amplifier that has one.
#[inline(always)]
fn current_rate<R: Real>(actuator: &Actuator, command: R, current: R, velocity: R, slew: R) -> R {
    match actuator.amplifier {
        Amplifier::Direct => R::zero(),
        Amplifier::Current { bandwidth, .. } => {
            let rate = R::splat(bandwidth) * (command - current);
            rate.min(slew).max(-slew)
        }
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
