//! One attempted step of all lanes, compiled for the vector unit of the machine.

use crate::bogacki_shampine::{A, C, E, ORDER, STAGES};
use crate::system::Batch;
use number::{Mask, Real, Vectorized};

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
    /// Natural logarithm of the error of the last accepted step.
    pub last_logarithm: R,
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
            last_logarithm: R::zero(),
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
    type Output = Judgement<R>;
    #[inline(always)]
    fn run(self) -> Judgement<R> {
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
        let error = if begin {
            R::zero()
        } else {
            error(h, &w.rates, &w.inverse_error, &mut w.stage)
        };
        Judgement::of(error, w.last_logarithm)
    }
}

/// What the error of an attempt says, lane by lane.
///
/// PI control (Gustafsson; exponents of Hairer, Norsett, Wanner, Solving ODEs I, II.4): steadier than I control
/// where stability, not accuracy, bounds the step. Logarithm and exponential are those of `number`: the standard
/// library's may differ from machine to machine.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Judgement<R> {
    /// Error relative to what is allowed; infinite where any channel is not a number.
    pub error: R,
    /// Its natural logarithm.
    pub logarithm: R,
    /// Next length over this one when the step is accepted, before limits.
    pub next: R,
    /// Length of the repetition over this one when the step is rejected, before limits.
    pub again: R,
}

impl<R: Real> Judgement<R> {
    #[inline(always)]
    fn of(error: R, last_logarithm: R) -> Self {
        const SAFETY: f64 = 0.9;
        const PROPORTIONAL: f64 = 0.7 / ORDER as f64;
        const INTEGRAL: f64 = 0.4 / ORDER as f64;
        let logarithm = error.max(R::splat(LEAST_ERROR)).min(R::splat(1e300)).ln();
        let exponent = R::splat(INTEGRAL) * last_logarithm - R::splat(PROPORTIONAL) * logarithm;
        let safety = R::splat(SAFETY);
        Judgement {
            error,
            logarithm,
            next: safety * exponent.exp(),
            again: safety * (logarithm * R::splat(-1.0 / ORDER as f64)).exp(),
        }
    }
}

/// A step of next to no error does not say much about the following one.
const LEAST_ERROR: f64 = 1e-4;

/// The stage at the end of the step.
const LAST: usize = STAGES - 1;

/// The end of an accepted step becomes the start of the next.
pub(crate) struct Advance<'a, R: Real> {
    pub work: &'a mut Workspace<R>,
    pub accepted: R::Mask,
    /// Logarithms of the errors of this step.
    pub logarithm: R,
}

impl<R: Real> Vectorized for Advance<'_, R> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Advance {
            work: w,
            accepted,
            logarithm,
        } = self;
        let n = w.state.len();
        let (rates, last) = w.rates.split_at_mut((STAGES - 1) * n);
        let rates = &mut rates[..n];
        w.last_logarithm = R::select(accepted, logarithm, w.last_logarithm);
        if !(!accepted).any() {
            std::mem::swap(&mut w.state, &mut w.next);
            std::mem::swap(&mut w.probe, &mut w.next_probe);
            rates.copy_from_slice(last);
            return;
        }
        keep(accepted, &w.next, &mut w.state);
        keep(accepted, last, rates);
        keep(accepted, &w.next_probe, &mut w.probe);
    }
}

/// Takes over the lanes of a mask.
#[inline(always)]
fn keep<R: Real>(accepted: R::Mask, from: &[R], to: &mut [R]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = R::select(accepted, *from, *to);
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
            if A[S][j] != 0.0 {
                value += weight[j] * rates[j * n + i];
            }
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
