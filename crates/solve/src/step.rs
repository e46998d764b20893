//! One accepted step of one lane, as an observer sees it.

use crate::scheme::dense_weights;
use crate::system::Machine;
use crate::workspace::Workspace;
use number::Real;

/// An accepted step of one machine, with its dense output.
pub struct Step<'a, M: Machine> {
    /// The machine.
    pub machine: &'a M,
    /// Its mode during the step.
    pub mode: &'a M::Mode,
    /// Time at the start.
    pub start: f64,
    /// Time at the end.
    pub end: f64,
    /// Watched channels and probes at the start and at the end.
    pub(crate) at_start: (&'a [f64], &'a [f64]),
    pub(crate) at_end: (&'a [f64], &'a [f64]),
    pub(crate) data: &'a dyn StepData,
    pub(crate) scratch: &'a mut Scratch,
}

/// Room for a single machine: one state, one rate, one set of probes, and the step itself.
#[derive(Debug)]
pub(crate) struct Scratch {
    pub state: Vec<f64>,
    pub rate: Vec<f64>,
    pub probe: Vec<f64>,
    /// State and rates at the start of the step and at its end, copied when dense output is first asked for.
    pub ends: [Vec<f64>; 4],
    /// How many leading channels of them are copied.
    pub copied: usize,
}

impl Scratch {
    pub fn new(dimension: usize, probes: usize) -> Self {
        Scratch {
            state: vec![0.0; dimension],
            rate: vec![0.0; dimension],
            probe: vec![0.0; probes],
            ends: std::array::from_fn(|_| vec![0.0; dimension]),
            copied: 0,
        }
    }
    /// Takes the state of a lane.
    pub fn take<R: Real>(&mut self, work: &Workspace<R>, lane: usize) {
        for (value, lanes) in self.state.iter_mut().zip(&work.state) {
            *value = lanes.lane(lane);
        }
    }
}

/// A lane's view of the workspace, whatever its number type.
pub(crate) trait StepData {
    fn start_state(&self, channel: usize) -> f64;
    fn end_state(&self, channel: usize) -> f64;
    /// Copies the leading channels at the end.
    fn copy_end(&self, into: &mut [f64]);
    /// Copies the leading channels of state and rates at the start and at the end.
    fn copy(&self, channels: usize, ends: &mut [Vec<f64>; 4]);
}

/// One lane of a workspace.
pub(crate) struct LaneOf<'a, R> {
    pub work: &'a Workspace<R>,
    pub lane: usize,
}

impl<R: Real> StepData for LaneOf<'_, R> {
    fn start_state(&self, channel: usize) -> f64 {
        self.work.state[channel].lane(self.lane)
    }
    fn end_state(&self, channel: usize) -> f64 {
        self.work.next[channel].lane(self.lane)
    }
    fn copy_end(&self, into: &mut [f64]) {
        for (value, lanes) in into.iter_mut().zip(&self.work.next) {
            *value = lanes.lane(self.lane);
        }
    }
    fn copy(&self, channels: usize, ends: &mut [Vec<f64>; 4]) {
        let w = self.work;
        for (values, from) in ends.iter_mut().zip([&w.state, &w.first, &w.next, &w.last]) {
            for (value, lanes) in values.iter_mut().zip(&from[..channels]) {
                *value = lanes.lane(self.lane);
            }
        }
    }
}

impl<M: Machine> Step<'_, M> {
    /// A watched probe at the start of the step.
    pub fn start_probe(&self, index: usize) -> f64 {
        self.at_start.1[index]
    }
    /// A watched probe at the end of the step.
    pub fn end_probe(&self, index: usize) -> f64 {
        self.at_end.1[index]
    }
    /// A channel at the start of the step.
    pub fn start_state(&self, channel: usize) -> f64 {
        match self.at_start.0.get(channel) {
            Some(value) => *value,
            None => self.data.start_state(channel),
        }
    }
    /// A channel at the end of the step.
    pub fn end_state(&self, channel: usize) -> f64 {
        match self.at_end.0.get(channel) {
            Some(value) => *value,
            None => self.data.end_state(channel),
        }
    }
    /// The time at a fraction of the step.
    pub fn time(&self, theta: f64) -> f64 {
        if theta == 1.0 {
            self.end
        } else {
            self.start + theta * (self.end - self.start)
        }
    }
    /// The state at a fraction of the step, from dense output; at 1 the end state itself.
    pub fn state(&mut self, theta: f64) -> &[f64] {
        self.leading_state(theta, self.scratch.state.len())
    }
    /// The first so many channels of the state at a fraction of the step: cheaper where the first ones suffice.
    pub fn leading_state(&mut self, theta: f64, channels: usize) -> &[f64] {
        self.fill(theta, channels);
        &self.scratch.state[..channels]
    }
    /// State and probes at a fraction of the step.
    pub fn evaluate(&mut self, theta: f64) -> (&mut [f64], &[f64]) {
        self.fill(theta, self.scratch.state.len());
        let time = self.time(theta);
        let scratch = &mut *self.scratch;
        self.machine.rate(
            self.mode,
            time,
            &scratch.state,
            &mut scratch.rate,
            &mut scratch.probe,
        );
        (&mut scratch.state, &scratch.probe)
    }
    /// One probe at a fraction of the step.
    pub fn probe(&mut self, theta: f64, index: usize) -> f64 {
        self.evaluate(theta).1[index]
    }
    fn fill(&mut self, theta: f64, channels: usize) {
        let scratch = &mut *self.scratch;
        let state = &mut scratch.state[..channels];
        if theta == 1.0 {
            self.data.copy_end(state);
        } else {
            if scratch.copied < channels {
                self.data.copy(channels, &mut scratch.ends);
                scratch.copied = channels;
            }
            let weight = dense_weights(theta);
            let length = self.end - self.start;
            let (first, last) = (length * weight.first, length * weight.last);
            let [start, start_rate, end, end_rate] = &scratch.ends;
            let states = start.iter().zip(end);
            let rates = start_rate.iter().zip(end_rate);
            for (value, ((start, end), (k1, k4))) in state.iter_mut().zip(states.zip(rates)) {
                *value = start + weight.change * (end - start) + (first * k1 + last * k4);
            }
            let sums = self.machine.dimension() - self.machine.quadratures();
            for (channel, value) in state.iter_mut().enumerate().skip(sums) {
                let [start, k1, end, k4] = [0, 1, 2, 3].map(|k: usize| scratch.ends[k][channel]);
                if k1 * k4 >= 0.0 {
                    let rates = [k1, k4].map(|rate| limited(rate, (end - start) / length));
                    *value = start
                        + weight.change * (end - start)
                        + (first * rates[0] + last * rates[1]);
                }
            }
        }
    }
}

/// A rate at an end of a step, so limited that the cubic through both ends neither overshoots nor turns.
///
/// A sum whose rates at both ends have one sign goes one way between them; a rate that begins inside the step, as that of a
/// heat at the onset of a contact, would make the free cubic fall first. Source: F. N. Fritsch, R. E. Carlson, Monotone
/// piecewise cubic interpolation, SIAM J. Numer. Anal. 17 (1980) 238: slopes of zero to three times the mean one.
fn limited(rate: f64, mean: f64) -> f64 {
    if rate * mean > 0.0 {
        rate.clamp(-3.0 * mean.abs(), 3.0 * mean.abs())
    } else {
        0.0
    }
}
