//! What one step of a lane works with, and how it is judged.

use crate::scheme::ORDER;
use crate::system::Machine;
use number::{Mask, Real};

/// Everything a step works on: allocated once, reused for every step.
#[derive(Debug)]
pub struct Workspace<R> {
    /// Time at the start of the step.
    pub time: R,
    /// Length of the step; zero freezes a lane.
    pub length: R,
    /// State at the start.
    pub state: Vec<R>,
    /// State of a stage, then at the end.
    pub next: Vec<R>,
    /// Rates at the start.
    pub first: Vec<R>,
    /// Rates of the second stage; then the part of the error that the last rates are not needed for, over the length.
    pub(crate) second: Vec<R>,
    /// Rates of the third stage, then those at the end.
    pub last: Vec<R>,
    /// Watched probes at the start.
    pub probe: Vec<R>,
    /// Watched probes at the end.
    pub next_probe: Vec<R>,
    /// Watched channels and probes of each lane at the start of the step, as observers read them.
    pub seen: StepEnd,
    /// The same at its end.
    pub next_seen: StepEnd,
    /// 1/(tolerance · error scale) of each channel.
    pub inverse_error: Vec<R>,
    /// Natural logarithm of the error of the last accepted step.
    pub last_logarithm: R,
    /// Number of first channels that the rate depends on.
    pub(crate) active: usize,
}

impl<R: Real> Workspace<R> {
    /// A workspace for problems like this one.
    pub fn of(machine: &impl Machine) -> Self {
        let (dimension, probes) = (machine.dimension(), machine.watched_probes());
        let channels = machine.watched_channels();
        let zeros = |n| vec![R::zero(); n];
        Workspace {
            time: R::zero(),
            length: R::zero(),
            state: zeros(dimension),
            next: zeros(dimension),
            first: zeros(dimension),
            second: zeros(dimension),
            last: zeros(dimension),
            probe: zeros(probes),
            next_probe: zeros(probes),
            seen: StepEnd::new(R::LANES, channels, probes),
            next_seen: StepEnd::new(R::LANES, channels, probes),
            inverse_error: zeros(dimension),
            last_logarithm: R::zero(),
            active: dimension - machine.quadratures(),
        }
    }
}

/// Leading channels and probes at one end of a step, lane by lane.
#[derive(Debug)]
pub struct StepEnd {
    channels: usize,
    probes: usize,
    values: Vec<f64>,
}

impl StepEnd {
    fn new(lanes: usize, channels: usize, probes: usize) -> Self {
        StepEnd {
            channels,
            probes,
            values: vec![0.0; lanes * (channels + probes)],
        }
    }
    /// Channels and probes of a lane.
    #[inline]
    pub(crate) fn lane(&self, lane: usize) -> (&[f64], &[f64]) {
        let width = self.channels + self.probes;
        self.values[lane * width..(lane + 1) * width].split_at(self.channels)
    }
    #[inline(always)]
    pub(crate) fn take<R: Real>(&mut self, state: &[R], probe: &[R]) {
        let width = self.channels + self.probes;
        assert!(probe.len() == self.probes && self.values.len() == R::LANES * width);
        // the lanes inside: their number is known when this is compiled; two loops, for one over a chain asks at each value
        for (k, lanes) in state[..self.channels].iter().enumerate() {
            for lane in 0..R::LANES {
                self.values[lane * width + k] = lanes.lane(lane);
            }
        }
        for (k, lanes) in probe.iter().enumerate() {
            for lane in 0..R::LANES {
                self.values[lane * width + self.channels + k] = lanes.lane(lane);
            }
        }
    }
}

/// What the error of an attempt says, lane by lane.
///
/// PI control (Gustafsson; exponents of Hairer, Norsett, Wanner, Solving ODEs I, II.4): steadier than I control
/// where stability, not accuracy, bounds the step. Logarithm and exponential are those of `number`: the standard
/// library's may differ from machine to machine.
#[derive(Clone, Copy, Debug)]
pub struct Judgement<R> {
    /// Error relative to what is allowed; infinite where any channel is not a number.
    pub error: R,
    /// Its natural logarithm.
    pub logarithm: R,
    /// Next length over this one when the step is accepted, before limits.
    pub next: R,
    /// Length of the repetition over this one where the step is rejected, before limits.
    pub again: R,
}

impl<R: Real> Judgement<R> {
    #[inline(always)]
    pub(crate) fn of(error: R, last_logarithm: R) -> Self {
        const SAFETY: f64 = 0.9;
        const PROPORTIONAL: f64 = 0.7 / ORDER as f64;
        const INTEGRAL: f64 = 0.4 / ORDER as f64;
        let logarithm = error.max(R::splat(LEAST_ERROR)).min(R::splat(1e300)).ln();
        let exponent = R::splat(INTEGRAL) * last_logarithm - R::splat(PROPORTIONAL) * logarithm;
        let safety = R::splat(SAFETY);
        let mut again = safety;
        if error.greater(R::one()).any() {
            again = safety * (logarithm * R::splat(-1.0 / ORDER as f64)).exp();
        }
        Judgement {
            error,
            logarithm,
            next: safety * exponent.exp(),
            again,
        }
    }
}

/// A step of next to no error does not say much about the following one.
const LEAST_ERROR: f64 = 1e-4;

/// Puts values on one lane of a list.
pub(crate) fn put<R: Real>(list: &mut [R], lane: usize, value: impl Fn(usize) -> f64) {
    for (channel, lanes) in list.iter_mut().enumerate() {
        *lanes = with_lane(*lanes, lane, value(channel));
    }
}

/// The same with another value on a lane.
pub(crate) fn with_lane<R: Real>(lanes: R, lane: usize, value: f64) -> R {
    R::from_lanes(|i| if i == lane { value } else { lanes.lane(i) })
}

/// The values on one lane of a list.
pub(crate) fn lane_of<R: Real>(list: &[R], lane: usize) -> Vec<f64> {
    list.iter().map(|value| value.lane(lane)).collect()
}
