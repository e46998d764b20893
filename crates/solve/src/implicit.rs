//! One linearly implicit step of all lanes, each with its own length: see [`rosenbrock`](crate::rosenbrock).
//!
//! The matrix is not the Jacobian but what the problem's stiff parts say of themselves: [`Tangents`]. It need not be exact, the
//! method keeps its order; what it leaves out must not be stiff.
//!
//! **Quadratures.** A heat that is the square of a stiff speed is wrong in the stages, whose speeds are: c v² counts their
//! errors of either sign. Such ones are summed from the rates at accepted points, by the parabola through the ends of the step and
//! the start of the step before:
//!
//! ```text
//!   ∫ f dt = H (f_b + f_c)/2 - H³/6 f[a, b, c]        the correction at most 0.3 of the first term
//! ```
//! The others, whose rates begin within a step as those of a friction at the onset of its contact, go through the stages.

use crate::method::{Method, Place};
use crate::rosenbrock::{Coefficients, EMBEDDED, GAMMA, STAGES, STEP};
use crate::system::Batch;
use crate::workspace::{Judgement, Workspace, put, with_lane};
use number::{Mask, Real, Vectorized};

/// A batch whose stiff parts know their tangents.
pub trait Tangents<R: Real>: Batch<R> {
    /// What is kept from the start of a step for its stages.
    type Room;

    /// Room for it.
    fn room(&self) -> Self::Room;
    /// Quadratures, by their place among them, that are summed from accepted points.
    fn at_points(&self) -> Vec<bool>;
    /// Takes the tangents A at an instant and a state.
    fn take(&self, mode: &Self::Mode, time: R, state: &[R], room: &mut Self::Room);
    /// Factors G - A.
    fn factor(&self, room: &mut Self::Room, g: R);
    /// Solves (G - A) u = R: `side` holds R of all channels but the quadratures, then u.
    fn solve(&self, room: &mut Self::Room, side: &mut [R]);
    /// Adds to the rates of quadratures what they change by along a vector over the other channels.
    fn along(&self, room: &Self::Room, vector: &[R], rates: &mut [R]);
}

/// Largest growth of a step.
const GROWTH: f64 = 3.0;
/// Largest correction of a quadrature at points, of its trapezoid.
const CORRECTION: f64 = 0.3;

/// The linearly implicit method.
pub struct Implicit<R, Room> {
    room: Room,
    at_points: Vec<bool>,
    coefficients: Coefficients,
    /// u of each stage; of the quadratures, their rate.
    stages: [Vec<R>; STAGES],
    /// Room for what the stages did not see.
    rest: Vec<R>,
    /// Rates of the quadratures at the start of the step before, and its length.
    before: Vec<R>,
    before_length: R,
}

impl<R: Real, Room> Implicit<R, Room> {
    pub(crate) fn new<B: Tangents<R, Room = Room>>(batch: &B, dimension: usize) -> Self {
        let at_points = batch.at_points();
        let zeros = |n| vec![R::zero(); n];
        Implicit {
            room: batch.room(),
            coefficients: Coefficients::new(),
            stages: std::array::from_fn(|_| zeros(dimension)),
            rest: zeros(dimension),
            before: zeros(at_points.len()),
            before_length: R::splat(f64::INFINITY),
            at_points,
        }
    }
}

/// A step, or only the rates and probes at its start.
struct Attempt<'a, R: Real, B: Tangents<R>> {
    batch: &'a B,
    mode: &'a B::Mode,
    work: &'a mut Workspace<R>,
    method: &'a mut Implicit<R, B::Room>,
    begin: bool,
}

impl<R: Real, B: Tangents<R>> Vectorized for Attempt<'_, R, B> {
    type Output = Judgement<R>;
    #[inline(always)]
    fn run(self) -> Judgement<R> {
        let Attempt {
            batch,
            mode,
            work: w,
            method: m,
            begin,
        } = self;
        let zero = R::zero();
        // a lane that stands still takes a step of any length that nobody looks at
        let moves = w.length.greater(zero);
        let h = R::select(moves, w.length, R::splat(1e-9));
        let inverse_h = h.recip();
        let g = inverse_h * R::splat(1.0 / GAMMA);
        let active = w.active;
        if !begin {
            R::vectorized(Prepare {
                batch,
                mode,
                time: w.time,
                state: &w.state,
                room: &mut m.room,
                g,
            });
        }
        let mut error = zero;
        let calls = if begin { 0..1 } else { 0..STAGES + 1 };
        for s in calls {
            // the right-hand side stands once in the compiled code: the stages, and the state at the end
            let instant = if s == STAGES {
                1.0
            } else {
                m.coefficients.instant[s]
            };
            if s == STAGES {
                error = m.sum_up(w);
            } else if s > 0 {
                reach(
                    &m.coefficients.argument[s],
                    &w.state[..active],
                    &m.stages[..s],
                    &mut w.next,
                );
            }
            let (from_start, at_end) = (begin || s == 0, s == STAGES);
            if begin || s > 0 {
                let (state, rate, probe): (&[R], &mut [R], &mut [R]) = if from_start {
                    (&w.state, &mut w.first, &mut w.probe)
                } else if at_end {
                    (&w.next, &mut w.last, &mut w.next_probe)
                } else {
                    (&w.next, &mut w.last, &mut [])
                };
                batch.rate(mode, w.time + h * R::splat(instant), state, rate, probe);
            }
            if begin || at_end {
                break;
            }
            let rate = if s == 0 { &w.first } else { &w.last };
            m.side(s, rate, inverse_h, active);
            R::vectorized(Solve {
                batch,
                room: &mut m.room,
                stage: &mut m.stages[s],
                active,
            });
        }
        if begin {
            w.seen.take(&w.state, &w.probe);
            return Judgement::of(zero, w.last_logarithm);
        }
        error = error.max(m.quadratures(w, h));
        w.next_seen.take(&w.next, &w.next_probe);
        let accepted = R::one().greater(error) & moves;
        if accepted.any() {
            error = error.max(R::select(accepted, m.unseen(batch, w, h, g), zero));
        }
        Judgement::of(error, w.last_logarithm)
    }
}

/// The tangents at the start of a step, factored, as a task of its own.
struct Prepare<'a, R: Real, B: Tangents<R>> {
    batch: &'a B,
    mode: &'a B::Mode,
    time: R,
    state: &'a [R],
    room: &'a mut B::Room,
    g: R,
}

impl<R: Real, B: Tangents<R>> Vectorized for Prepare<'_, R, B> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        self.batch.take(self.mode, self.time, self.state, self.room);
        self.batch.factor(self.room, self.g);
    }
}

/// The linear system of a stage as a task of its own: it stands once in the compiled code. The stage holds its right-hand side and
/// the rates of the quadratures, then its u and what those rates change by along it.
struct Solve<'a, R: Real, B: Tangents<R>> {
    batch: &'a B,
    room: &'a mut B::Room,
    stage: &'a mut [R],
    active: usize,
}

impl<R: Real, B: Tangents<R>> Vectorized for Solve<'_, R, B> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let (side, rates) = self.stage.split_at_mut(self.active);
        self.batch.solve(self.room, side);
        self.batch.along(self.room, side, rates);
    }
}

/// What the next step needs of this one, as a task.
struct Accept<'a, R: Real> {
    before: &'a mut [R],
    before_length: &'a mut R,
    accepted: R::Mask,
    work: &'a Workspace<R>,
}

impl<R: Real> Vectorized for Accept<'_, R> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let w = self.work;
        *self.before_length = R::select(self.accepted, w.length, *self.before_length);
        for (before, rate) in self.before.iter_mut().zip(&w.first[w.active..]) {
            *before = R::select(self.accepted, *rate, *before);
        }
    }
}

impl<R: Real, Room> Implicit<R, Room> {
    /// The right-hand side of a stage: the rate there, and what the stages before leave of theirs.
    #[inline(always)]
    fn side(&mut self, stage: usize, rate: &[R], inverse_h: R, active: usize) {
        let (before, from_here) = self.stages.split_at_mut(stage);
        let side = &mut from_here[0];
        side[active..].copy_from_slice(&rate[active..]);
        let weights = &self.coefficients.side[stage];
        let a = inverse_h * R::splat(weights[0]);
        let b = inverse_h * R::splat(weights[1]);
        let c = inverse_h * R::splat(weights[2]);
        let (side, rate) = (&mut side[..active], &rate[..active]);
        match before {
            [] => side.copy_from_slice(rate),
            [first] => {
                for ((side, rate), u) in side.iter_mut().zip(rate).zip(first.iter()) {
                    *side = *rate + a * *u;
                }
            }
            [first, second] => {
                let u = first.iter().zip(second.iter());
                for ((side, rate), (u, v)) in side.iter_mut().zip(rate).zip(u) {
                    *side = *rate + (a * *u + b * *v);
                }
            }
            [first, second, third, ..] => {
                let u = first.iter().zip(second.iter()).zip(third.iter());
                for ((side, rate), ((u, v), w)) in side.iter_mut().zip(rate).zip(u) {
                    *side = *rate + (a * *u + b * *v + c * *w);
                }
            }
        }
    }

    /// The state at the end of the step, but for the quadratures; returns its largest error over the channels, each relative to what is allowed there, infinite where any is not a number.
    #[inline(always)]
    fn sum_up(&self, w: &mut Workspace<R>) -> R {
        let zero = R::zero();
        let active = w.active;
        let c = &self.coefficients;
        let (sa, sb) = (R::splat(c.step[0]), R::splat(c.step[1]));
        let (sc, sd) = (R::splat(c.step[2]), R::splat(c.step[3]));
        let (ea, eb) = (R::splat(c.error[0]), R::splat(c.error[1]));
        let (ec, ed) = (R::splat(c.error[2]), R::splat(c.error[3]));
        let (mut largest, mut sum) = (zero, zero);
        let [a, b, c, d] = &self.stages;
        let stages = a.iter().zip(b).zip(c.iter().zip(d));
        let states = w.next[..active].iter_mut().zip(&w.state);
        for (((next, start), inverse), ((a, b), (c, d))) in states.zip(&w.inverse_error).zip(stages)
        {
            *next = *start + (sa * *a + sb * *b + (sc * *c + sd * *d));
            let error = (ea * *a + eb * *b + (ec * *c + ed * *d)).abs() * *inverse;
            largest = error.max(largest);
            // `max` forgets what is not a number, the sum does not
            sum += error;
        }
        let infinite = R::splat(f64::INFINITY);
        R::select(sum.less(infinite), largest, infinite)
    }

    /// The quadratures at the end of the step; returns the largest error of those that go through the stages.
    #[inline(always)]
    fn quadratures(&mut self, w: &mut Workspace<R>, h: R) -> R {
        let zero = R::zero();
        let active = w.active;
        let (half, sixth, most) = (R::splat(0.5), R::splat(-1.0 / 6.0), R::splat(CORRECTION));
        let (inverse, inverse_before) = (h.recip(), self.before_length.recip());
        let spread = (h + self.before_length).recip();
        let (mut largest, mut sum) = (zero, zero);
        for (i, at_points) in self.at_points.iter().enumerate() {
            let k = active + i;
            let (first, last) = (w.first[k], w.last[k]);
            if *at_points {
                let trapezoid = half * h * (first + last);
                let bend =
                    ((last - first) * inverse - (first - self.before[i]) * inverse_before) * spread;
                let correction = sixth * h * h * h * bend;
                let bound = most * trapezoid.abs();
                let correction = correction.max(-bound).min(bound);
                w.next[k] = w.state[k] + (trapezoid + correction);
                continue;
            }
            let (a, b) = (self.stages[0][k], self.stages[1][k]);
            let (c, d) = (self.stages[2][k], self.stages[3][k]);
            let mean = weighed(&STEP, a, b, c, d);
            let error = (h * (mean - weighed(&EMBEDDED, a, b, c, d))).abs() * w.inverse_error[k];
            // two of the weights are negative: a heat does not fall all the same
            let falls = !zero.greater(first) & !zero.greater(last) & zero.greater(mean);
            w.next[k] = w.state[k] + h * R::select(falls, zero, mean);
            largest = error.max(largest);
            sum += error;
        }
        let infinite = R::splat(f64::INFINITY);
        R::select(sum.less(infinite), largest, infinite)
    }

    /// What the stages did not see and the rate at the end shows: relative to what is allowed where it forbids the step,
    /// else zero. See [`rosenbrock`](crate::rosenbrock).
    #[inline(always)]
    fn unseen<B: Tangents<R, Room = Room>>(
        &mut self,
        batch: &B,
        w: &Workspace<R>,
        h: R,
        g: R,
    ) -> R {
        let active = w.active;
        let inverse_h = h.recip();
        let weights = &self.coefficients.side[STAGES - 1];
        let wa = inverse_h * R::splat(weights[0]);
        let wb = inverse_h * R::splat(weights[1]);
        let wc = inverse_h * R::splat(weights[2]);
        let [a, b, c, last] = &self.stages;
        let (mut far, mut sum) = (R::zero(), R::zero());
        let (one, infinite) = (R::one(), R::splat(f64::INFINITY));
        for (i, side) in self.rest[..active].iter_mut().enumerate() {
            let stage = g * last[i] - (wa * a[i] + wb * b[i] + wc * c[i]);
            *side = w.last[i] - stage;
            let size = side.abs() * w.inverse_error[i];
            far = size.max(far);
            sum += size;
        }
        let broken = !sum.less(infinite);
        let asks = (far * g.recip()).greater(one);
        let mut correction = R::zero();
        if asks.any() {
            R::vectorized(Solve {
                batch,
                room: &mut self.room,
                stage: &mut self.rest,
                active,
            });
            for (side, inverse) in self.rest[..active].iter().zip(&w.inverse_error) {
                correction = correction.max(side.abs() * *inverse);
            }
            correction = R::select(asks & correction.greater(one), correction, R::zero());
        }
        R::select(broken, infinite, correction)
    }
}

impl<R: Real, B: Tangents<R>> Method<R, B> for Implicit<R, B::Room> {
    fn evaluations(&self) -> u64 {
        STAGES as u64
    }
    const GROWTH: f64 = GROWTH;

    fn begin(&mut self, step: Place<R, B>, fresh: R::Mask, work: &mut Workspace<R>) {
        let infinite = R::splat(f64::INFINITY);
        self.before_length = R::select(fresh, infinite, self.before_length);
        R::vectorized(Attempt {
            batch: step.batch,
            mode: step.mode,
            work,
            method: self,
            begin: true,
        });
    }
    fn attempt(&mut self, step: Place<R, B>, work: &mut Workspace<R>) -> Judgement<R> {
        R::vectorized(Attempt {
            batch: step.batch,
            mode: step.mode,
            work,
            method: self,
            begin: false,
        })
    }
    fn accept(&mut self, accepted: R::Mask, work: &Workspace<R>) {
        R::vectorized(Accept {
            before: &mut self.before,
            before_length: &mut self.before_length,
            accepted,
            work,
        });
    }
    fn save(&self, lane: usize) -> Vec<f64> {
        let rates = self.before.iter().map(|rate| rate.lane(lane));
        rates.chain([self.before_length.lane(lane)]).collect()
    }
    fn restore(&mut self, lane: usize, saved: &[f64]) {
        let (rates, length) = saved.split_at(self.before.len());
        put(&mut self.before, lane, |i| rates[i]);
        self.before_length = with_lane(self.before_length, lane, length[0]);
    }
}

/// out = state + Σ weight · stage, over the stages there are.
#[inline(always)]
fn reach<R: Real>(weights: &[f64; STAGES], state: &[R], stages: &[Vec<R>], out: &mut [R]) {
    let (wa, wb, wc) = (
        R::splat(weights[0]),
        R::splat(weights[1]),
        R::splat(weights[2]),
    );
    match stages {
        [a] => {
            for ((out, state), a) in out.iter_mut().zip(state).zip(a) {
                *out = *state + wa * *a;
            }
        }
        [a, b] => {
            for ((out, state), (a, b)) in out.iter_mut().zip(state).zip(a.iter().zip(b)) {
                *out = *state + (wa * *a + wb * *b);
            }
        }
        [a, b, c, ..] => {
            let u = a.iter().zip(b).zip(c);
            for ((out, state), ((a, b), c)) in out.iter_mut().zip(state).zip(u) {
                *out = *state + (wa * *a + wb * *b + wc * *c);
            }
        }
        [] => {}
    }
}

/// Sum of four stages.
#[inline(always)]
fn weighed<R: Real>(weights: &[f64; STAGES], a: R, b: R, c: R, d: R) -> R {
    let (wa, wb) = (R::splat(weights[0]), R::splat(weights[1]));
    let (wc, wd) = (R::splat(weights[2]), R::splat(weights[3]));
    wa * a + wb * b + (wc * c + wd * d)
}
