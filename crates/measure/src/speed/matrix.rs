//! Vectors and matrices of angle, speed, acceleration, jerk, and the error of the clock.
#![allow(clippy::needless_range_loop)] // rows and columns by number read like the formula

use crate::state_space::{self, GAUSS, symmetric};

pub(super) const N: usize = 5;
pub(super) type Vector = state_space::Vector<N>;
pub(super) type Matrix = state_space::Matrix<N>;

pub(super) fn plus(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][j] + b[i][j]))
}

/// The fifth state: of pulses the part of the error of the instants that has a memory, of a speed channel what its instrument
/// shows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Memory {
    /// Standard deviation of the error of the instants, time; none of an instrument.
    pub spread: f64,
    /// One over the time in which it decays to 1/e.
    rate: f64,
    /// The step of most samples and what the instrument does in it; none of an error of the instants.
    usual: Option<(f64, Lag)>,
}

impl Memory {
    /// An error of the instants: its deviation, and how fast it forgets.
    pub const fn of_clock(spread: f64, rate: f64) -> Memory {
        Memory {
            spread,
            rate,
            usual: None,
        }
    }

    /// An instrument that follows the speed at a rate, one over its time constant; `step` between most samples.
    pub fn of_instrument(rate: f64, step: f64) -> Memory {
        Memory {
            spread: 0.0,
            rate,
            usual: Some((step, Lag::of(step, rate))),
        }
    }

    /// What a sample of a channel sees of the states: its instrument, or the speed itself where that has no lag.
    pub fn row(&self) -> Vector {
        match self.usual {
            Some(_) => [0.0, 0.0, 0.0, 0.0, 1.0],
            None => [0.0, 1.0, 0.0, 0.0, 0.0],
        }
    }

    /// Time by which an instrument shows a steady change late.
    pub fn late(&self) -> f64 {
        self.usual.map_or(0.0, |_| self.rate.recip())
    }

    /// What the fifth state takes over a time from those above it; nothing where it is an error of the instants.
    fn lag(&self, dt: f64) -> Option<Lag> {
        let (step, lag) = self.usual.as_ref()?;
        Some(match (dt - step).abs() < 1e-9 * step {
            true => *lag,
            false => Lag::of(dt, self.rate),
        })
    }
}

/// What an instrument of first order, `ė = (Ω - e)/τ`, shows after a time of free motion.
#[derive(Clone, Copy, Debug)]
struct Lag {
    /// Of speed, acceleration and jerk.
    of: [f64; 3],
    /// Covariance of `e` with all states from white snap of the density 1.
    noise: Vector,
}

impl Lag {
    fn of(dt: f64, rate: f64) -> Lag {
        let mut noise = [0.0; N];
        // Two pieces of three points: what is shown of a jerk is nearly a parabola of time.
        for piece in [0.0, 0.5] {
            for (node, weight) in GAUSS {
                let t = dt * (piece + 0.5 * node);
                let shown = Self::shown(t, rate)[2];
                let column = [t * t * t / 6.0, 0.5 * t * t, t, 1.0, shown];
                for (sum, value) in noise.iter_mut().zip(column) {
                    *sum += 0.5 * weight * dt * shown * value;
                }
            }
        }
        Lag {
            of: Self::shown(dt, rate),
            noise,
        }
    }

    /// Formula: with x = t/τ, `1 - e^-x`, `t (1 - (1 - e^-x)/x)`, `t² (1/2 - 1/x + (1 - e^-x)/x²)`.
    fn shown(t: f64, rate: f64) -> [f64; 3] {
        let x = t * rate;
        let risen = -(-x).exp_m1();
        // Where x is small the differences are lost in rounding.
        let (second, third) = match x < 0.05 {
            true => (
                x * (0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x / 120.0))),
                x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0 - x / 720.0))),
            ),
            false => {
                let mean = risen / x;
                (1.0 - mean, 0.5 - (1.0 - mean) / x)
            }
        };
        [risen, t * second, t * t * third]
    }
}

/// Free motion over a time: constant jerk, and an error that is forgotten or an instrument that follows.
pub(super) fn drift(dt: f64, memory: &Memory) -> Matrix {
    let (h, s) = (0.5 * dt * dt, dt * dt * dt / 6.0);
    let [a, b, c] = memory.lag(dt).map_or([0.0; 3], |lag| lag.of);
    [
        [1.0, dt, h, s, 0.0],
        [0.0, 1.0, dt, h, 0.0],
        [0.0, 0.0, 1.0, dt, 0.0],
        [0.0, 0.0, 0.0, 1.0, 0.0],
        [0.0, a, b, c, (-dt * memory.rate).exp()],
    ]
}

/// Covariance that white snap of some density, and the error of the instants, gather over a time.
///
/// Formula: Q_ij = density dt^(7-i-j) / ((7-i-j) (3-i)! (3-j)!), i, j from 0 to 3.
pub(super) fn gathered(dt: f64, density: f64, memory: &Memory) -> Matrix {
    let clock = memory.spread * memory.spread * -(-2.0 * dt * memory.rate).exp_m1();
    let mut q = gathered_with(dt, density, clock);
    if let Some(lag) = memory.lag(dt) {
        shown_too(&mut q, density, &lag);
    }
    q
}

/// Adds the covariance that an instrument's state gathers with all states.
fn shown_too(q: &mut Matrix, density: f64, lag: &Lag) {
    for i in 0..4 {
        q[i][4] += density * lag.noise[i];
        q[4][i] += density * lag.noise[i];
    }
    q[4][4] += density * lag.noise[4];
}

fn gathered_with(dt: f64, density: f64, clock: f64) -> Matrix {
    let d2 = dt * dt;
    let d3 = d2 * dt;
    let (d4, d5) = (d2 * d2, d2 * d3);
    let (d6, d7) = (d3 * d3, d3 * d4);
    let x = |a: f64| density * a;
    let (a, b, c, d) = (x(d7 / 252.0), x(d6 / 72.0), x(d5 / 30.0), x(d4 / 24.0));
    let (e, f, g) = (x(d5 / 20.0), x(d4 / 8.0), x(d3 / 6.0));
    let (h, i, j) = (x(d3 / 3.0), x(d2 / 2.0), x(dt));
    [
        [a, b, c, d, 0.0],
        [b, e, f, g, 0.0],
        [c, f, h, i, 0.0],
        [d, g, i, j, 0.0],
        [0.0, 0.0, 0.0, 0.0, clock],
    ]
}

/// A state after a time of free motion: `f x`.
#[inline]
pub(super) fn carry(x: &mut Vector, dt: f64, memory: &Memory) {
    let (h, s) = (0.5 * dt * dt, dt * dt * dt / 6.0);
    let mut last = (-dt * memory.rate).exp() * x[4];
    if let Some(Lag { of: [a, b, c], .. }) = memory.lag(dt) {
        last += a * x[1] + b * x[2] + c * x[3];
    }
    *x = [
        x[0] + dt * x[1] + h * x[2] + s * x[3],
        x[1] + dt * x[2] + h * x[3],
        x[2] + dt * x[3],
        x[3],
        last,
    ];
}

/// Mean and covariance after a time: `f x`, `f p fᵀ + q`, with what is zero left out.
#[inline]
pub(super) fn advance(x: &mut Vector, p: &mut Matrix, dt: f64, density: f64, memory: &Memory) {
    carry(x, dt, memory);
    let (h, s) = (0.5 * dt * dt, dt * dt * dt / 6.0);
    let kept = (-dt * memory.rate).exp();
    let mut a = [[0.0; N]; N];
    for j in 0..N {
        a[0][j] = p[0][j] + dt * p[1][j] + h * p[2][j] + s * p[3][j];
        a[1][j] = p[1][j] + dt * p[2][j] + h * p[3][j];
        a[2][j] = p[2][j] + dt * p[3][j];
        a[3][j] = p[3][j];
        a[4][j] = kept * p[4][j];
    }
    let lag = memory.lag(dt);
    let mut b = gathered_with(
        dt,
        density,
        memory.spread * memory.spread * (1.0 - kept * kept),
    );
    if let Some(lag) = &lag {
        let [l, m, n] = lag.of;
        for j in 0..N {
            a[4][j] += l * p[1][j] + m * p[2][j] + n * p[3][j];
        }
        shown_too(&mut b, density, lag);
        for i in 0..N {
            b[i][4] += l * a[i][1] + m * a[i][2] + n * a[i][3];
        }
    }
    for i in 0..N {
        b[i][0] += a[i][0] + dt * a[i][1] + h * a[i][2] + s * a[i][3];
        b[i][1] += a[i][1] + dt * a[i][2] + h * a[i][3];
        b[i][2] += a[i][2] + dt * a[i][3];
        b[i][3] += a[i][3];
        b[i][4] += kept * a[i][4];
    }
    symmetric(&mut b);
    *p = b;
}
