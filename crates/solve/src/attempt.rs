//! One attempted step of all lanes, compiled for the vector unit of the machine.

use crate::bogacki_shampine::{A, C, E, STAGES};
use crate::system::Batch;
use number::{Real, Vectorized};

/// Everything a step works on: allocated once, reused for every step.
#[derive(Debug)]
pub struct Workspace<R> {
    /// Time at the start of the step.
    pub time: R,
    /// Length of the step; zero freezes a lane.
    pub length: R,
    /// State at the start.
    pub state: Vec<R>,
    /// State at the end.
    pub next: Vec<R>,
    /// Rates of the stages, one after the other; the first belongs to `state`, the last to `next`.
    pub rates: Vec<R>,
    /// Probes at the start.
    pub probe: Vec<R>,
    /// Probes at the end.
    pub next_probe: Vec<R>,
    /// State of a stage.
    stage: Vec<R>,
    /// 1/(tolerance · error scale) of each channel.
    pub inverse_error: Vec<R>,
    /// Number of first channels that the rate depends on.
    active: usize,
}

impl<R: Real> Workspace<R> {
    /// A workspace for problems of this size, the last channels of which may be quadratures.
    pub fn new(dimension: usize, quadratures: usize, probes: usize) -> Self {
        let zeros = |n| vec![R::zero(); n];
        Workspace {
            time: R::zero(),
            length: R::zero(),
            state: zeros(dimension),
            next: zeros(dimension),
            rates: zeros(STAGES * dimension),
            probe: zeros(probes),
            next_probe: zeros(probes),
            stage: zeros(dimension),
            inverse_error: zeros(dimension),
            active: dimension - quadratures,
        }
    }
}

/// Stages of a step, or only the rates and probes at its start.
///
/// The right-hand side stands once in the compiled code, inside one loop over the stages: it is large.
pub(crate) struct Attempt<'a, R: Real, B: Batch<R>> {
    pub batch: &'a B,
    pub mode: &'a B::Mode,
    pub work: &'a mut Workspace<R>,
    /// `true`: the rates and probes at the start of a step. `false`: a step from there.
    pub begin: bool,
}

impl<R: Real, B: Batch<R>> Vectorized for Attempt<'_, R, B> {
    /// Error of each lane relative to what is allowed, and its natural logarithm (of no less than 1e-8).
    type Output = (R, R);
    #[inline(always)]
    fn run(self) -> (R, R) {
        let Attempt {
            batch,
            mode,
            work: w,
            begin,
        } = self;
        let n = w.state.len();
        let (time, h) = (w.time, w.length);
        let stages = if begin { 0..1 } else { 1..STAGES };
        for s in stages {
            let (earlier, rate) = w.rates.split_at_mut(s * n);
            // what the rate does not depend on is summed only at the end of the step
            let (stage, channels) = match s {
                LAST => (&mut w.next, n),
                _ => (&mut w.stage, w.active),
            };
            match s {
                1 => combine::<R, 1>(h, &w.state, earlier, &mut stage[..channels]),
                2 => combine::<R, 2>(h, &w.state, earlier, &mut stage[..channels]),
                3 => combine::<R, 3>(h, &w.state, earlier, &mut stage[..channels]),
                _ => stage.copy_from_slice(&w.state),
            }
            let probe: &mut [R] = match s {
                0 => &mut w.probe,
                LAST => &mut w.next_probe,
                _ => &mut [],
            };
            let time = time + h * R::splat(C[s]);
            batch.rate(mode, time, stage, &mut rate[..n], probe);
        }
        if begin {
            return (R::zero(), R::zero());
        }
        let error = error(h, &w.rates, &w.inverse_error, &mut w.stage);
        (error, error.max(R::splat(1e-8)).ln())
    }
}

/// The stage at the end of the step.
const LAST: usize = STAGES - 1;

/// The end of an accepted step becomes the start of the next.
pub(crate) struct Advance<'a, R: Real> {
    pub work: &'a mut Workspace<R>,
    pub accepted: R::Mask,
}

impl<R: Real> Vectorized for Advance<'_, R> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Advance { work: w, accepted } = self;
        let n = w.state.len();
        let (rates, last) = w.rates.split_at_mut((STAGES - 1) * n);
        assert!(w.next.len() == n && last.len() == n && rates.len() >= n);
        for i in 0..n {
            w.state[i] = R::select(accepted, w.next[i], w.state[i]);
            rates[i] = R::select(accepted, last[i], rates[i]);
        }
        for (probe, next) in w.probe.iter_mut().zip(&w.next_probe) {
            *probe = R::select(accepted, *next, *probe);
        }
    }
}

/// out = state + h Σ a_j k_j over the rates of the `S` earlier stages.
#[inline(always)]
fn combine<R: Real, const S: usize>(h: R, state: &[R], rates: &[R], out: &mut [R]) {
    let n = state.len();
    assert!(rates.len() == S * n && out.len() <= n);
    // a loop, not `from_fn`: its closure would not be compiled for the vector unit
    let mut weight = [R::zero(); S];
    for (weight, a) in weight.iter_mut().zip(A[S]) {
        *weight = h * R::splat(a);
    }
    for i in 0..out.len() {
        let mut value = state[i];
        let mut j = 0;
        while j < S {
            value += weight[j] * rates[j * n + i];
            j += 1;
        }
        out[i] = value;
    }
}

/// Largest error over the channels, each relative to what is allowed there; infinite where any is not a number.
#[inline(always)]
fn error<R: Real>(h: R, rates: &[R], inverse_error: &[R], relative: &mut [R]) -> R {
    let n = inverse_error.len();
    assert!(rates.len() == STAGES * n && relative.len() == n);
    for i in 0..n {
        let mut difference = R::splat(E[0]) * rates[i];
        let mut j = 1;
        while j < STAGES {
            difference += R::splat(E[j]) * rates[j * n + i];
            j += 1;
        }
        relative[i] = (h * difference).abs() * inverse_error[i];
    }
    // side by side, because one maximum after the other is a long wait
    let mut largest = [R::zero(); WAYS];
    let mut sum = [R::zero(); WAYS];
    let (ways, rest) = relative.as_chunks::<WAYS>();
    for values in ways {
        for k in 0..WAYS {
            largest[k] = values[k].max(largest[k]);
            sum[k] += values[k];
        }
    }
    for value in rest {
        largest[0] = value.max(largest[0]);
        sum[0] += *value;
    }
    for k in 1..WAYS {
        largest[0] = largest[0].max(largest[k]);
        sum[0] += sum[k];
    }
    // `max` forgets what is not a number, the sum does not
    let infinite = R::splat(f64::INFINITY);
    R::select(sum[0].less(infinite), largest[0], infinite)
}

/// Maxima that run side by side.
const WAYS: usize = 8;
