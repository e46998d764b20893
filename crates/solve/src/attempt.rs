//! One attempted step of all lanes, compiled for the vector unit of the machine.

use crate::system::Batch;
use crate::tsitouras::{A, C, E, STAGES};
use number::{Real, Task};

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

/// Rates and probes at the start of a step, for all lanes.
pub(crate) struct Begin<'a, R, B: Batch<R>>
where
    R: Real,
{
    pub batch: &'a B,
    pub mode: &'a B::Mode,
    pub work: &'a mut Workspace<R>,
}

impl<R: Real, B: Batch<R>> Task for Begin<'_, R, B> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let w = self.work;
        let n = w.state.len();
        self.batch
            .rate(self.mode, w.time, &w.state, &mut w.rates[..n], &mut w.probe);
    }
}

/// One step: returns the error of each lane relative to what is allowed.
pub(crate) struct Attempt<'a, R: Real, B: Batch<R>> {
    pub batch: &'a B,
    pub mode: &'a B::Mode,
    pub work: &'a mut Workspace<R>,
}

impl<R: Real, B: Batch<R>> Task for Attempt<'_, R, B> {
    type Output = R;
    #[inline(always)]
    fn run(self) -> R {
        let Attempt {
            batch,
            mode,
            work: w,
        } = self;
        let n = w.state.len();
        let (time, h) = (w.time, w.length);
        macro_rules! stage {
            ($s:literal, $out:expr, $probe:expr) => {{
                let (earlier, rest) = w.rates.split_at_mut($s * n);
                combine::<R, $s>(h, &w.state, earlier, $out);
                batch.rate(
                    mode,
                    time + h * R::splat(C[$s]),
                    $out,
                    &mut rest[..n],
                    $probe,
                );
            }};
        }
        stage!(1, &mut w.stage, &mut []);
        stage!(2, &mut w.stage, &mut []);
        stage!(3, &mut w.stage, &mut []);
        stage!(4, &mut w.stage, &mut []);
        stage!(5, &mut w.stage, &mut []);
        stage!(6, &mut w.next, &mut w.next_probe);
        error(h, &w.rates, &w.inverse_error)
    }
}

/// The end of an accepted step becomes the start of the next.
pub(crate) struct Advance<'a, R: Real> {
    pub work: &'a mut Workspace<R>,
    pub accepted: R::Mask,
}

impl<R: Real> Task for Advance<'_, R> {
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

/// out = state + h Σ a_j k_j over the first `S` rates.
#[inline(always)]
fn combine<R: Real, const S: usize>(h: R, state: &[R], rates: &[R], out: &mut [R]) {
    let n = state.len();
    assert!(rates.len() == S * n && out.len() == n);
    let mut weight = [R::zero(); S];
    let mut j = 0;
    while j < S {
        weight[j] = h * R::splat(A[S][j]);
        j += 1;
    }
    for i in 0..n {
        let mut sum = weight[0] * rates[i];
        let mut j = 1;
        while j < S {
            sum += weight[j] * rates[j * n + i];
            j += 1;
        }
        out[i] = state[i] + sum;
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
