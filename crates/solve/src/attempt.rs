//! One attempted step of all lanes, compiled for the vector unit of the machine.

use crate::system::Batch;
use crate::tsitouras::{A, C, E, STAGES};
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
}

impl<R: Real> Workspace<R> {
    /// A workspace for problems of this size.
    pub fn new(dimension: usize, probes: usize) -> Self {
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
    /// Error of each lane relative to what is allowed; zero where nothing was attempted.
    type Output = R;
    #[inline(always)]
    fn run(self) -> R {
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
            combine(s, h, &w.state, &w.rates, &mut w.stage);
            let probe: &mut [R] = match s {
                0 => &mut w.probe,
                LAST => &mut w.next_probe,
                _ => &mut [],
            };
            let rate = &mut w.rates[s * n..(s + 1) * n];
            batch.rate(mode, time + h * R::splat(C[s]), &w.stage, rate, probe);
        }
        if begin {
            return R::zero();
        }
        w.next.copy_from_slice(&w.stage);
        error(h, &w.rates, &w.inverse_error)
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

/// out = state + h Σ a_j k_j over the earlier rates of a stage.
#[inline(always)]
fn combine<R: Real>(stage: usize, h: R, state: &[R], rates: &[R], out: &mut [R]) {
    let n = state.len();
    assert!(rates.len() == STAGES * n && out.len() == n);
    out.copy_from_slice(state);
    for j in 0..stage {
        let weight = h * R::splat(A[stage][j]);
        let rate = &rates[j * n..(j + 1) * n];
        for (value, rate) in out.iter_mut().zip(rate) {
            *value += weight * *rate;
        }
    }
}

/// Largest error over the channels, each relative to what is allowed there.
#[inline(always)]
fn error<R: Real>(h: R, rates: &[R], inverse_error: &[R]) -> R {
    let n = inverse_error.len();
    assert!(rates.len() == STAGES * n);
    let mut largest = R::zero();
    for i in 0..n {
        let mut sum = R::splat(E[0]) * rates[i];
        let mut j = 1;
        while j < STAGES {
            sum += R::splat(E[j]) * rates[j * n + i];
            j += 1;
        }
        let relative = (h * sum).abs() * inverse_error[i];
        // `max` keeps its second operand when they do not compare: a NaN, once in, must stay.
        largest = R::select(largest.greater(relative), largest, relative);
        largest = R::select(
            relative.greater(R::splat(-1.0)),
            largest,
            R::splat(f64::INFINITY),
        );
    }
    largest
}
