//! What has happened to magnets, sensors and controllers, as states that change at events alone.
//!
//! ```text
//!   supply      on, base b, change c, rate ρ, instant t_e     d = e^(-ρ(t - t_e)),  share of the bias e = b + c d
//!               with power      b 1, c 0
//!               lost            b 0, c e(t_f), ρ 1/τ          currents i(t_f) d
//!               levitated again b 1, c -1, ρ 1/τ_b
//!   sensor      share s, added a, noise n                      s y + a + n
//!   reference   r_0, rate                                      r_0 max(0, 1 - (t - t_e) rate)
//!   command     share s, held h                                s u + h
//!   limits      of a coil, A, and of the rate of its current, A/s
//! ```
//! A supply serves the axes that all events switch together. Only what events of the run touch has states: others cost nothing.

use ::levitation::{Condition, Levitation};
use number::Real;
use std::ops::Range;

/// Something that happens to axes of magnets.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// What happens.
    pub what: What,
    /// To which axes, in the order of the levitation; sensors and controllers by the axis that they serve.
    pub axes: Vec<usize>,
}

/// What happens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum What {
    /// The power is lost: both currents and what they pull by decay with this rate, 1/s; infinite where they are gone at once.
    Lost {
        /// 1/τ, 1/s.
        decay_rate: f64,
    },
    /// Controllers and bias start again.
    Levitated {
        /// 1/τ_b of the bias, 1/s; infinite where it is there at once.
        bias_rate: f64,
        /// 1/T of references that lead from the place of the rotor to the middle, 1/s; infinite where they are there at once.
        reference_rate: f64,
    },
    /// The sensor keeps showing what it shows.
    Stuck,
    /// The sensor shows nothing.
    Dead,
    /// The sensor shows so much more, m.
    Offset(f64),
    /// The sensor shows so much more until the next such value, m.
    Noise(f64),
    /// The command keeps its value.
    Frozen,
    /// Limits of the amplifier, where they change.
    Limited {
        /// Largest current of a coil, A.
        largest_current: Option<f64>,
        /// Largest rate of a current, A/s.
        slew: Option<f64>,
    },
}

impl What {
    /// Whether it happens to a sensor.
    pub(super) fn is_of_sensor(&self) -> bool {
        matches!(
            self,
            What::Stuck | What::Dead | What::Offset(_) | What::Noise(_)
        )
    }
}

/// Channels of a supply.
const SUPPLY: [&str; 5] = ["on", "bias base", "bias change", "rate", "since"];
/// Channels of a sensor.
const SENSOR: [&str; 3] = ["sensor share", "sensor added", "sensor noise"];
/// Channels of a reference.
const REFERENCE: [&str; 2] = ["reference start", "reference rate"];
/// Channels of a command.
const COMMAND: [&str; 2] = ["command share", "command added"];
/// Channels of limits.
const LIMITS: [&str; 2] = ["largest current", "slew"];

/// Where the conditions stand among the states of the magnets, behind those of the levitation.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Conditions {
    /// States of the current of each axis, or of its coils, once the power is lost: where a command is the current, one as it was then.
    pub kept: Vec<Range<usize>>,
    /// First channel of each supply.
    supplies: Vec<usize>,
    /// The supply of each axis.
    supply_of: Vec<usize>,
    sensors: Vec<Option<usize>>,
    references: Vec<Option<usize>>,
    commands: Vec<Option<usize>>,
    limits: Vec<Option<usize>>,
    /// Whether conditions of an axis ever differ from the usual ones.
    pub differ: bool,
    /// Names of all channels.
    pub names: Vec<String>,
}

/// A supply at an instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Supply<R: Real> {
    /// Lanes that have power.
    pub on: R::Mask,
    /// What is left of the currents at the loss.
    pub left: R,
    /// What is there of the bias.
    pub share: R,
    /// Time since its last event, s.
    pub since: R,
}

impl<R: Real> Supply<R> {
    /// From its channels at a time, s.
    #[inline(always)]
    pub fn new([on, base, change, rate, from]: [R; 5], time: R) -> Self {
        let since = time - from;
        let left = (-(rate * since)).exp();
        Supply {
            on: on.greater(R::zero()),
            left,
            share: base + change * left,
            since,
        }
    }
}

impl Conditions {
    /// Of the axes of a levitation and all that may happen to them.
    pub fn of(levitation: &Levitation, changes: &[Change]) -> Self {
        let first = levitation.states();
        let axes = 0..levitation.actuators().len();
        let name = |axis: usize| levitation.actuators()[axis].axis.name.as_str();
        let touched = |axis: usize, of: &dyn Fn(&What) -> bool| {
            (changes.iter()).any(|own| of(&own.what) && own.axes.contains(&axis))
        };
        let switches = |what: &What| matches!(what, What::Lost { .. } | What::Levitated { .. });
        let switched: Vec<&Change> = changes.iter().filter(|own| switches(&own.what)).collect();
        let together = |a: usize, b: usize| {
            (switched.iter()).all(|own| own.axes.contains(&a) == own.axes.contains(&b))
        };
        let mut names = Vec::new();
        let mut add = |of: &str, channels: &[&str]| {
            let at = first + names.len();
            names.extend(channels.iter().map(|own| format!("{of}.{own}")));
            at
        };
        let mut kept = Vec::new();
        for axis in axes.clone() {
            let own = levitation.current_states(axis);
            kept.push(match own.is_empty() {
                true => {
                    let at = add(name(axis), &["current kept"]);
                    at..at + 1
                }
                false => own,
            });
        }
        let mut leaders: Vec<usize> = Vec::new();
        let mut supply_of = Vec::new();
        for axis in axes.clone() {
            let found = leaders.iter().position(|leader| together(*leader, axis));
            supply_of.push(found.unwrap_or_else(|| {
                leaders.push(axis);
                leaders.len() - 1
            }));
        }
        let supplies = leaders.iter().map(|leader| add(name(*leader), &SUPPLY));
        let supplies = supplies.collect();
        let mut each = |channels: &[&str], of: &dyn Fn(&What) -> bool| -> Vec<Option<usize>> {
            let own = |axis| touched(axis, of).then(|| add(name(axis), channels));
            axes.clone().map(own).collect()
        };
        let changed = |own: &Change| {
            let what = own.what;
            matches!(
                what,
                What::Levitated { .. } | What::Frozen | What::Limited { .. }
            )
        };
        Conditions {
            kept,
            differ: changes.iter().any(changed),
            supplies,
            supply_of,
            sensors: each(&SENSOR, &What::is_of_sensor),
            references: each(
                &REFERENCE,
                &|what| matches!(what, What::Levitated { reference_rate, .. } if reference_rate.is_finite()),
            ),
            commands: each(&COMMAND, &|what| matches!(what, What::Frozen)),
            limits: each(&LIMITS, &|what| matches!(what, What::Limited { .. })),
            names,
        }
    }

    /// The states of axes to which nothing has happened.
    pub fn start(&self, levitation: &Levitation, states: &mut [f64]) {
        for at in &self.supplies {
            states[*at..at + SUPPLY.len()].copy_from_slice(&[1.0, 1.0, 0.0, 0.0, 0.0]);
        }
        for (axis, actuator) in levitation.actuators().iter().enumerate() {
            let usual = Condition::<f64>::of(actuator);
            let mut put = |at: Option<usize>, values: &[f64]| {
                if let Some(at) = at {
                    states[at..at + values.len()].copy_from_slice(values);
                }
            };
            put(self.sensors[axis], &[1.0, 0.0, 0.0]);
            put(self.references[axis], &[0.0; 2]);
            put(self.commands[axis], &[1.0, 0.0]);
            put(self.limits[axis], &[usual.largest_current, usual.slew]);
        }
    }

    /// Number of supplies.
    pub fn supplies(&self) -> usize {
        self.supplies.len()
    }
    /// The supply of an axis.
    pub fn supply_of(&self, axis: usize) -> usize {
        self.supply_of[axis]
    }
    /// A supply at an instant.
    #[inline(always)]
    pub fn supply<R: Real>(&self, supply: usize, states: &[R], time: R) -> Supply<R> {
        let at = self.supplies[supply];
        Supply::new(std::array::from_fn(|k| states[at + k]), time)
    }
    /// What the sensor of an axis shows of a displacement, m.
    #[inline(always)]
    pub fn shown<R: Real>(&self, axis: usize, displacement: R, states: &[R]) -> R {
        match self.sensors[axis] {
            Some(at) => states[at] * displacement + states[at + 1] + states[at + 2],
            None => displacement,
        }
    }
    /// Whether references lead anywhere.
    pub fn have_references(&self) -> bool {
        self.references.iter().any(Option::is_some)
    }
    /// What the reference of an axis is besides the constant one, m.
    #[inline(always)]
    pub fn reference<R: Real>(&self, axis: usize, states: &[R], supply: &Supply<R>) -> R {
        match self.references[axis] {
            Some(at) => {
                let left = R::one() - supply.since * states[at + 1];
                states[at] * left.max(R::zero())
            }
            None => R::zero(),
        }
    }
    /// The condition of an axis whose usual one is given.
    #[inline(always)]
    pub fn condition<R: Real>(
        &self,
        axis: usize,
        usual: Condition<R>,
        states: &[R],
        supply: &Supply<R>,
    ) -> Condition<R> {
        let mut out = usual;
        out.bias_share = supply.share;
        if let Some(at) = self.commands[axis] {
            (out.command_share, out.command_held) = (states[at], states[at + 1]);
        }
        if let Some(at) = self.limits[axis] {
            (out.largest_current, out.slew) = (states[at], states[at + 1]);
        }
        out
    }

    /// Switches the supply of an axis off or on: its five channels.
    pub fn switch(&self, axis: usize, channels: [f64; 5], states: &mut [f64]) {
        let at = self.supplies[self.supply_of[axis]];
        states[at..at + SUPPLY.len()].copy_from_slice(&channels);
    }
    /// Changes what the sensor of an axis shows, which is now `shown` (m), with an offset of its own (m).
    pub fn sense(&self, axis: usize, what: What, [shown, offset]: [f64; 2], states: &mut [f64]) {
        let Some(at) = self.sensors[axis] else {
            return;
        };
        let lives = states[at] > 0.0;
        let own = &mut states[at..at + SENSOR.len()];
        match what {
            What::Stuck => own.copy_from_slice(&[0.0, shown, 0.0]),
            What::Dead => own.copy_from_slice(&[0.0, -offset, 0.0]),
            What::Offset(more) if lives => own[1] += more,
            What::Noise(value) if lives => own[2] = value,
            _ => {}
        }
    }
    /// Starts the reference of an axis at a place, m.
    pub fn refer(&self, axis: usize, place: f64, rate: f64, states: &mut [f64]) {
        if let Some(at) = self.references[axis] {
            let rate = if rate.is_finite() { rate } else { 0.0 };
            let place = if rate > 0.0 { place } else { 0.0 };
            (states[at], states[at + 1]) = (place, rate);
        }
    }
    /// Freezes the command of an axis, which is now so much.
    pub fn freeze(&self, axis: usize, command: f64, states: &mut [f64]) {
        if let Some(at) = self.commands[axis] {
            (states[at], states[at + 1]) = (0.0, command);
        }
    }
    /// Limits the currents of an axis, and their rates, where they are given.
    pub fn limit(&self, axis: usize, limits: [Option<f64>; 2], states: &mut [f64]) {
        if let Some(at) = self.limits[axis] {
            for (channel, limit) in states[at..].iter_mut().zip(limits) {
                *channel = limit.unwrap_or(*channel);
            }
        }
    }
    /// Channel of the largest current of an axis, where it may change.
    pub fn largest_current(&self, axis: usize) -> Option<usize> {
        self.limits[axis]
    }
}
