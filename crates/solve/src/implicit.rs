//! One linearly implicit step of one machine: see [`rosenbrock`](crate::rosenbrock) and
//! [`arrowhead`](crate::arrowhead).

use crate::arrowhead::{Arrowhead, Factors, Shape};
use crate::method::{Method, Place};
use crate::rosenbrock::{Coefficients, EMBEDDED, GAMMA, STAGES, STEP};
use crate::system::{Batch, Machine};
use crate::workspace::{Judgement, Workspace};
use number::{Real, Vectorized};

/// The Jacobian of a machine's rate, with blocks of `M` channels that depend on `COLUMNS` channels of the border and
/// act on `ROWS` of them.
pub trait Linear<T: Machine, const M: usize, const COLUMNS: usize, const ROWS: usize> {
    /// Where its parts stand.
    fn shape(&self) -> Shape<M, COLUMNS, ROWS>;
    /// The Jacobian at a state; all of its entries are written.
    fn jacobian(
        &mut self,
        mode: &T::Mode,
        time: f64,
        state: &[f64],
        into: &mut Arrowhead<M, COLUMNS, ROWS>,
    );
}

/// The linearly implicit method.
pub(crate) struct Implicit<R, L, const M: usize, const COLUMNS: usize, const ROWS: usize> {
    linear: L,
    jacobian: Arrowhead<M, COLUMNS, ROWS>,
    factors: Factors<M, COLUMNS>,
    /// Time of the state that the Jacobian was taken at; none when there is none.
    taken_at: Option<f64>,
    /// The diagonal it was factored with.
    factored: f64,
    coefficients: Coefficients,
    /// u of each stage; of the tail, its rate.
    stages: [Vec<f64>; STAGES],
    /// State at the start.
    start: Vec<f64>,
    /// Sums of the stages: by the weights of the step, and by those of its error.
    sums: [Vec<f64>; 2],
    argument: Vec<R>,
    rate: Vec<R>,
}

impl<R: Real, L, const M: usize, const COLUMNS: usize, const ROWS: usize>
    Implicit<R, L, M, COLUMNS, ROWS>
{
    /// For a machine and its Jacobian.
    pub fn new<T: Machine>(machine: &T, linear: L) -> Self
    where
        L: Linear<T, M, COLUMNS, ROWS>,
    {
        let dimension = machine.dimension();
        let jacobian = Arrowhead::new(linear.shape());
        Implicit {
            factors: Factors::of(&jacobian),
            linear,
            jacobian,
            taken_at: None,
            factored: f64::NAN,
            coefficients: Coefficients::new(),
            stages: std::array::from_fn(|_| vec![0.0; dimension]),
            start: vec![0.0; dimension],
            sums: std::array::from_fn(|_| vec![0.0; dimension]),
            argument: vec![R::zero(); dimension],
            rate: vec![R::zero(); dimension],
        }
    }
}

/// The right-hand side as a task of its own: it stands once in the compiled code.
struct Rate<'a, R: Real, B: Batch<R>> {
    batch: &'a B,
    mode: &'a B::Mode,
    time: R,
    state: &'a [R],
    rate: &'a mut [R],
    probe: &'a mut [R],
}

impl<R: Real, B: Batch<R>> Vectorized for Rate<'_, R, B> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        (self.batch).rate(self.mode, self.time, self.state, self.rate, self.probe);
    }
}

impl<R, B, L, const M: usize, const COLUMNS: usize, const ROWS: usize> Method<R, B>
    for Implicit<R, L, M, COLUMNS, ROWS>
where
    R: Real,
    B: Batch<R>,
    L: Linear<B::Machine, M, COLUMNS, ROWS>,
{
    const EVALUATIONS: u64 = STAGES as u64;

    fn begin(&mut self, step: Place<R, B>, work: &mut Workspace<R>) {
        self.taken_at = None;
        R::vectorized(Rate {
            batch: step.batch,
            mode: step.mode,
            time: work.time,
            state: &work.state,
            rate: &mut work.first,
            probe: &mut work.probe,
        });
        work.seen.take(&work.state, &work.probe);
    }

    fn attempt(&mut self, step: Place<R, B>, work: &mut Workspace<R>) -> Judgement<R> {
        let h = work.length.lane(0);
        let time = work.time.lane(0);
        for (value, lanes) in self.start.iter_mut().zip(&work.state) {
            *value = lanes.lane(0);
        }
        if self.taken_at != Some(time) {
            let mode = (step.modes)(0);
            self.linear
                .jacobian(&mode, time, &self.start, &mut self.jacobian);
            self.taken_at = Some(time);
            self.factored = f64::NAN;
        }
        let diagonal = 1.0 / (h * GAMMA);
        if self.factored != diagonal {
            let factored = R::vectorized(Factor {
                factors: &mut self.factors,
                jacobian: &self.jacobian,
                diagonal,
            });
            if !factored {
                return Judgement::of(R::splat(f64::INFINITY), work.last_logarithm);
            }
            self.factored = diagonal;
        }
        let c = self.coefficients;
        let active = self.jacobian.shape().tail.start;
        for i in 0..STAGES {
            let (before, from_here) = self.stages.split_at_mut(i);
            if i > 0 {
                let state = &mut self.argument[..active];
                combine(&self.start, &c.argument[i][..i], before, state);
                R::vectorized(Rate {
                    batch: step.batch,
                    mode: step.mode,
                    time: R::splat(time + h * c.instant[i]),
                    state: &self.argument,
                    rate: &mut self.rate,
                    probe: &mut [],
                });
            }
            let rate = if i > 0 { &self.rate } else { &work.first };
            let side = &mut from_here[0];
            for (value, rate) in side.iter_mut().zip(rate) {
                *value = rate.lane(0);
            }
            for (weight, stage) in c.side[i].iter().zip(before.iter()) {
                let weight = weight / h;
                for (value, u) in side[..active].iter_mut().zip(stage) {
                    *value += weight * u;
                }
            }
            R::vectorized(Solve {
                factors: &mut self.factors,
                jacobian: &self.jacobian,
                side,
            });
        }
        R::vectorized(SumUp {
            method: self,
            h,
            active,
        });
        for ((next, start), change) in (work.next.iter_mut().zip(&self.start)).zip(&self.sums[0]) {
            *next = R::splat(start + change);
        }
        R::vectorized(Rate {
            batch: step.batch,
            mode: step.mode,
            time: R::splat(time + h),
            state: &work.next,
            rate: &mut work.last,
            probe: &mut work.next_probe,
        });
        work.next_seen.take(&work.next, &work.next_probe);
        let mut error = self.error(work);
        if error <= 1.0 {
            error = error.max(self.unseen(h, active, work));
        }
        Judgement::of(R::splat(error), work.last_logarithm)
    }
}

impl<R: Real, L, const M: usize, const COLUMNS: usize, const ROWS: usize>
    Implicit<R, L, M, COLUMNS, ROWS>
{
    /// Change of the state over the step, and its error.
    #[inline(always)]
    fn sum_up(&mut self, h: f64, active: usize) {
        let c = &self.coefficients;
        let error: [f64; STAGES] = std::array::from_fn(|i| STEP[i] - EMBEDDED[i]);
        let weights = [(&c.step, &STEP), (&c.error, &error)];
        for (sum, (of_others, of_tail)) in self.sums.iter_mut().zip(weights) {
            let (others, tail) = sum.split_at_mut(active);
            weigh(of_tail, &self.stages, 0, others);
            weigh(of_tail, &self.stages, active, tail);
            self.jacobian.add_tail(others, tail);
            tail.iter_mut().for_each(|value| *value *= h);
            weigh(of_others, &self.stages, 0, others);
        }
        // two of the weights are negative: a sum of what no stage saw negative does not fall all the same
        let [a, b, c, d] = self.stages.each_ref().map(|stage| &stage[active..]);
        for (i, change) in self.sums[0][active..].iter_mut().enumerate() {
            let (low, high) = (
                a[i].min(b[i]).min(c[i].min(d[i])),
                a[i].max(b[i]).max(c[i].max(d[i])),
            );
            if (low >= 0.0 && *change < 0.0) || (high <= 0.0 && *change > 0.0) {
                *change = 0.0;
            }
        }
    }

    /// What the stages did not see and the rate at the end shows: relative to what is allowed where it forbids the step,
    /// else zero. See [`rosenbrock`](crate::rosenbrock).
    fn unseen(&mut self, h: f64, active: usize, work: &Workspace<R>) -> f64 {
        let [a, b, c, last] = &self.stages;
        let [wa, wb, wc, _] = self.coefficients.side[STAGES - 1].map(|weight| weight / h);
        let diagonal = 1.0 / (h * GAMMA);
        let side = &mut self.sums[1];
        for (i, side) in side[..active].iter_mut().enumerate() {
            let stage = diagonal * last[i] - (wa * a[i] + wb * b[i] + wc * c[i]);
            *side = work.last[i].lane(0) - stage;
        }
        let largest = |correction: &[f64], factor: f64| {
            (correction[..active].iter().zip(&work.inverse_error))
                .map(|(value, inverse)| (factor * value * inverse.lane(0)).abs())
                .fold(0.0, f64::max)
        };
        if largest(side, h * GAMMA) <= 1.0 {
            return 0.0;
        }
        R::vectorized(Solve {
            factors: &mut self.factors,
            jacobian: &self.jacobian,
            side,
        });
        let correction = largest(side, 1.0);
        if correction > 1.0 { correction } else { 0.0 }
    }
    /// Largest error over the channels, each relative to what is allowed there; infinite where any is not a number.
    fn error(&self, work: &Workspace<R>) -> f64 {
        let mut largest = 0.0_f64;
        let mut sum = 0.0;
        for ((error, inverse), rate) in (self.sums[1].iter())
            .zip(&work.inverse_error)
            .zip(&work.last)
        {
            let relative = (error * inverse.lane(0)).abs();
            largest = largest.max(relative);
            // `max` forgets what is not a number, the sum does not
            sum += relative + rate.lane(0).abs();
        }
        if sum < f64::INFINITY {
            largest
        } else {
            f64::INFINITY
        }
    }
}

/// Parts of a step as tasks for the vector unit.
struct Factor<'a, const M: usize, const COLUMNS: usize, const ROWS: usize> {
    factors: &'a mut Factors<M, COLUMNS>,
    jacobian: &'a Arrowhead<M, COLUMNS, ROWS>,
    diagonal: f64,
}

impl<const M: usize, const COLUMNS: usize, const ROWS: usize> Vectorized
    for Factor<'_, M, COLUMNS, ROWS>
{
    type Output = bool;
    #[inline(always)]
    fn run(self) -> bool {
        self.factors.factor(self.jacobian, self.diagonal)
    }
}

struct Solve<'a, const M: usize, const COLUMNS: usize, const ROWS: usize> {
    factors: &'a mut Factors<M, COLUMNS>,
    jacobian: &'a Arrowhead<M, COLUMNS, ROWS>,
    side: &'a mut [f64],
}

impl<const M: usize, const COLUMNS: usize, const ROWS: usize> Vectorized
    for Solve<'_, M, COLUMNS, ROWS>
{
    type Output = ();
    #[inline(always)]
    fn run(self) {
        self.factors.solve(self.jacobian, self.side);
    }
}

struct SumUp<'a, R, L, const M: usize, const COLUMNS: usize, const ROWS: usize> {
    method: &'a mut Implicit<R, L, M, COLUMNS, ROWS>,
    h: f64,
    active: usize,
}

impl<R: Real, L, const M: usize, const COLUMNS: usize, const ROWS: usize> Vectorized
    for SumUp<'_, R, L, M, COLUMNS, ROWS>
{
    type Output = ();
    #[inline(always)]
    fn run(self) {
        self.method.sum_up(self.h, self.active);
    }
}

/// out = Σ weight · stage, from a channel on.
#[inline(always)]
fn weigh(weights: &[f64; STAGES], stages: &[Vec<f64>; STAGES], from: usize, out: &mut [f64]) {
    let [a, b, c, d] = stages;
    let [wa, wb, wc, wd] = weights;
    let lists = a[from..]
        .iter()
        .zip(&b[from..])
        .zip(c[from..].iter().zip(&d[from..]));
    for (out, ((a, b), (c, d))) in out.iter_mut().zip(lists) {
        *out = wa * a + wb * b + (wc * c + wd * d);
    }
}

/// out = start + Σ weight · stage.
fn combine<R: Real>(start: &[f64], weights: &[f64], stages: &[Vec<f64>], out: &mut [R]) {
    for (channel, out) in out.iter_mut().enumerate() {
        let mut value = start[channel];
        for (weight, stage) in weights.iter().zip(stages) {
            value += weight * stage[channel];
        }
        *out = R::splat(value);
    }
}
