//! One attempted step of all lanes, compiled for the vector unit of the machine.

use crate::method::{Method, Place};
use crate::scheme::Scheme;
use crate::system::Batch;
use crate::workspace::{Judgement, Workspace};
use number::{Mask, Real, Vectorized};

/// Stages of an explicit step, or only the rates and probes at its start.
///
/// The right-hand side stands once in the compiled code, inside one loop over the stages: it is large.
pub(crate) struct Attempt<'a, R: Real, B: Batch<R>> {
    pub batch: &'a B,
    pub mode: &'a B::Mode,
    pub work: &'a mut Workspace<R>,
    pub scheme: &'a Scheme,
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
            scheme,
            begin,
        } = self;
        let (time, h) = (w.time, w.length);
        let chain = scheme.chain;
        let last = chain.len() + 1;
        let stages = if begin { 0..1 } else { 1..last + 1 };
        for s in stages {
            // what the rate does not depend on is summed only at the end of the step
            let stage = &mut w.next[..w.active];
            let (state, rate, probe): (&[R], &mut [R], &mut [R]) = match s {
                0 => (&w.state, &mut w.first, &mut w.probe),
                1 => {
                    reach(h * R::splat(chain[0]), &w.state, &w.first, stage);
                    (&w.next, &mut w.second, &mut [])
                }
                2 => {
                    reach(h * R::splat(chain[1]), &w.state, &w.second, stage);
                    (&w.next, &mut w.last, &mut [])
                }
                _ if s < last => {
                    reach(h * R::splat(chain[s - 1]), &w.state, &w.last, stage);
                    (&w.next, &mut w.last, &mut [])
                }
                _ => {
                    finish(h, scheme, w);
                    (&w.next, &mut w.last, &mut w.next_probe)
                }
            };
            let instant = match s {
                0 => 0.0,
                _ if s < last => chain[s - 1],
                _ => 1.0,
            };
            let time = time + h * R::splat(instant);
            batch.rate(mode, time, state, rate, probe);
        }
        let error = if begin {
            w.seen.take(&w.state, &w.probe);
            R::zero()
        } else {
            w.next_seen.take(&w.next, &w.next_probe);
            error(h, scheme.error[3], &w.second, &w.last, &w.inverse_error)
        };
        Judgement::of(error, w.last_logarithm)
    }
}

/// The explicit method, on the vector unit.
pub struct Explicit(pub(crate) Scheme);

impl<R: Real, B: Batch<R>> Method<R, B> for Explicit {
    fn evaluations(&self) -> u64 {
        self.0.evaluations()
    }
    fn begin(&mut self, step: Place<R, B>, _fresh: R::Mask, work: &mut Workspace<R>) {
        explicit(step, work, &self.0, true);
    }
    fn attempt(&mut self, step: Place<R, B>, work: &mut Workspace<R>) -> Judgement<R> {
        explicit(step, work, &self.0, false)
    }
}

fn explicit<R: Real, B: Batch<R>>(
    step: Place<R, B>,
    work: &mut Workspace<R>,
    scheme: &Scheme,
    begin: bool,
) -> Judgement<R> {
    R::vectorized(Attempt {
        batch: step.batch,
        mode: step.mode,
        work,
        scheme,
        begin,
    })
}

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
        w.last_logarithm = R::select(accepted, logarithm, w.last_logarithm);
        if !(!accepted).any() {
            std::mem::swap(&mut w.state, &mut w.next);
            std::mem::swap(&mut w.probe, &mut w.next_probe);
            std::mem::swap(&mut w.seen, &mut w.next_seen);
            std::mem::swap(&mut w.first, &mut w.last);
            return;
        }
        keep(accepted, &w.next, &mut w.state);
        keep(accepted, &w.last, &mut w.first);
        keep(accepted, &w.next_probe, &mut w.probe);
        w.seen.take(&w.state, &w.probe);
    }
}

/// Takes over the lanes of a mask.
#[inline(always)]
fn keep<R: Real>(accepted: R::Mask, from: &[R], to: &mut [R]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = R::select(accepted, *from, *to);
    }
}

/// The second and the third stage: out = state + h a k, k the rates of the stage before.
#[inline(always)]
fn reach<R: Real>(weight: R, state: &[R], rate: &[R], out: &mut [R]) {
    for ((out, state), rate) in out.iter_mut().zip(state).zip(rate) {
        *out = *state + weight * *rate;
    }
}

/// The end of the step, and what the first three rates say of its error.
#[inline(always)]
fn finish<R: Real>(h: R, scheme: &Scheme, w: &mut Workspace<R>) {
    let weight = scheme.step.map(|weight| h * R::splat(weight));
    let [e1, e2, e3, _] = scheme.error.map(R::splat);
    let rates = w.first.iter().zip(&mut w.second).zip(&w.last);
    for ((next, state), ((k1, k2), k3)) in w.next.iter_mut().zip(&w.state).zip(rates) {
        *next = *state + weight[0] * *k1 + weight[1] * *k2 + weight[2] * *k3;
        *k2 = e1 * *k1 + e2 * *k2 + e3 * *k3;
    }
}

/// Largest error over the channels, each relative to what is allowed there; infinite where any is not a number.
#[inline(always)]
fn error<R: Real>(h: R, of_last: f64, part: &[R], last: &[R], inverse_error: &[R]) -> R {
    let (parts, rest) = part.as_chunks::<WAYS>();
    let (lasts, rest_last) = last.as_chunks::<WAYS>();
    let (inverses, rest_inverse) = inverse_error.as_chunks::<WAYS>();
    // side by side, because one maximum after the other is a long wait
    let mut largest = [R::zero(); WAYS];
    let mut sum = [R::zero(); WAYS];
    for ((part, last), inverse) in parts.iter().zip(lasts).zip(inverses) {
        for i in 0..WAYS {
            let value = relative(h, of_last, part[i], last[i], inverse[i]);
            largest[i] = value.max(largest[i]);
            sum[i] += value;
        }
    }
    for ((part, last), inverse) in rest.iter().zip(rest_last).zip(rest_inverse) {
        let value = relative(h, of_last, *part, *last, *inverse);
        largest[0] = value.max(largest[0]);
        sum[0] += value;
    }
    for k in 1..WAYS {
        largest[0] = largest[0].max(largest[k]);
        sum[0] += sum[k];
    }
    // `max` forgets what is not a number, the sum does not
    let infinite = R::splat(f64::INFINITY);
    R::select(sum[0].less(infinite), largest[0], infinite)
}

/// Error of one channel relative to what is allowed there.
#[inline(always)]
fn relative<R: Real>(h: R, of_last: f64, part: R, last: R, inverse: R) -> R {
    (h * (part + R::splat(of_last) * last)).abs() * inverse
}

/// Maxima that run side by side.
const WAYS: usize = 8;
