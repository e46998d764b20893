//! One accepted step of one lane, as an observer sees it.

use crate::attempt::Workspace;
use crate::system::Machine;
use crate::tsitouras::{STAGES, dense_weights};
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
    pub(crate) data: &'a dyn StepData,
    pub(crate) scratch: &'a mut Scratch,
}

/// Room for one state, one rate and one set of probes of a single machine.
#[derive(Debug)]
pub(crate) struct Scratch {
    pub state: Vec<f64>,
    pub rate: Vec<f64>,
    pub probe: Vec<f64>,
}

impl Scratch {
    pub fn new(dimension: usize, probes: usize) -> Self {
        Scratch {
            state: vec![0.0; dimension],
            rate: vec![0.0; dimension],
            probe: vec![0.0; probes],
        }
    }
}

/// A lane's view of the workspace, whatever its number type.
pub(crate) trait StepData {
    fn start_probe(&self, index: usize) -> f64;
    fn end_probe(&self, index: usize) -> f64;
    fn start_state(&self, channel: usize) -> f64;
    fn end_state(&self, channel: usize) -> f64;
    fn dense(&self, weights: &[f64; STAGES], length: f64, out: &mut [f64]);
}

/// One lane of a workspace.
pub(crate) struct LaneOf<'a, R> {
    pub work: &'a Workspace<R>,
    pub lane: usize,
}

impl<R: Real> StepData for LaneOf<'_, R> {
    fn start_probe(&self, index: usize) -> f64 {
        self.work.probe[index].lane(self.lane)
    }
    fn end_probe(&self, index: usize) -> f64 {
        self.work.next_probe[index].lane(self.lane)
    }
    fn start_state(&self, channel: usize) -> f64 {
        self.work.state[channel].lane(self.lane)
    }
    fn end_state(&self, channel: usize) -> f64 {
        self.work.next[channel].lane(self.lane)
    }
    fn dense(&self, weights: &[f64; STAGES], length: f64, out: &mut [f64]) {
        let n = out.len();
        for (i, value) in out.iter_mut().enumerate() {
            let rates = weights
                .iter()
                .enumerate()
                .map(|(j, w)| w * self.work.rates[j * n + i].lane(self.lane));
            *value = self.work.state[i].lane(self.lane) + length * rates.sum::<f64>();
        }
    }
}

impl<M: Machine> Step<'_, M> {
    /// A probe at the start of the step.
    pub fn start_probe(&self, index: usize) -> f64 {
        self.data.start_probe(index)
    }
    /// A probe at the end of the step.
    pub fn end_probe(&self, index: usize) -> f64 {
        self.data.end_probe(index)
    }
    /// A channel at the start of the step.
    pub fn start_state(&self, channel: usize) -> f64 {
        self.data.start_state(channel)
    }
    /// A channel at the end of the step.
    pub fn end_state(&self, channel: usize) -> f64 {
        self.data.end_state(channel)
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
        self.fill(theta);
        &self.scratch.state
    }
    /// State and probes at a fraction of the step.
    pub fn evaluate(&mut self, theta: f64) -> (&[f64], &[f64]) {
        self.fill(theta);
        let time = self.time(theta);
        let scratch = &mut *self.scratch;
        self.machine.rate(
            self.mode,
            time,
            &scratch.state,
            &mut scratch.rate,
            &mut scratch.probe,
        );
        (&scratch.state, &scratch.probe)
    }
    /// One probe at a fraction of the step.
    pub fn probe(&mut self, theta: f64, index: usize) -> f64 {
        self.evaluate(theta).1[index]
    }
    fn fill(&mut self, theta: f64) {
        let scratch = &mut *self.scratch;
        if theta == 1.0 {
            for (channel, value) in scratch.state.iter_mut().enumerate() {
                *value = self.data.end_state(channel);
            }
        } else {
            let weights = dense_weights(theta);
            self.data
                .dense(&weights, self.end - self.start, &mut scratch.state);
        }
    }
}
