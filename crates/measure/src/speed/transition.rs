//! Transition and noise of a step: angle, speed, acceleration, jerk, and the error of the clock.

use crate::state_space::{self, GAUSS};

pub(super) const N: usize = 5;
pub(super) type Vector = state_space::Vector<N>;
pub(super) type Matrix = state_space::Matrix<N>;

pub(super) type Belief = state_space::Belief<N>;
pub(super) type Observation = state_space::Observation<N>;

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
        let mut row = Vector::zeros();
        row[if self.usual.is_some() { 4 } else { 1 }] = 1.0;
        row
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
        let mut noise = Vector::zeros();
        // Two pieces of three points: what is shown of a jerk is nearly a parabola of time.
        for piece in [0.0, 0.5] {
            for (node, weight) in GAUSS {
                let t = dt * (piece + 0.5 * node);
                let shown = Self::shown(t, rate)[2];
                let column = Vector::from([t * t * t / 6.0, 0.5 * t * t, t, 1.0, shown]);
                noise += 0.5 * weight * dt * shown * column;
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

/// Free motion over a time: constant jerk, and an error that is forgotten or an instrument that follows; and the covariance that white
/// snap of some density, and the error of the instants, gather meanwhile.
///
/// Formula: Q_ij = density dt^(7-i-j) / ((7-i-j) (3-i)! (3-j)!), i, j from 0 to 3.
pub(super) fn step(dt: f64, density: f64, memory: &Memory) -> (Matrix, Matrix) {
    let lag = memory.lag(dt);
    let kept = (-dt * memory.rate).exp();
    let (h, s) = (0.5 * dt * dt, dt * dt * dt / 6.0);
    let [a, b, c] = lag.map_or([0.0; 3], |lag| lag.of);
    #[rustfmt::skip]
    let transition = Matrix::new(
        1.0, dt, h, s, 0.0,
        0.0, 1.0, dt, h, 0.0,
        0.0, 0.0, 1.0, dt, 0.0,
        0.0, 0.0, 0.0, 1.0, 0.0,
        0.0, a, b, c, kept,
    );
    let (d2, d3) = (dt * dt, dt * dt * dt);
    let (d4, d5, d6, d7) = (d2 * d2, d2 * d3, d3 * d3, d3 * d2 * d2);
    let clock = memory.spread * memory.spread * (1.0 - kept * kept);
    let [i, j, k, l, m] = lag.map_or([0.0; N], |lag| lag.noise.into());
    #[rustfmt::skip]
    let mut noise = density * Matrix::new(
        d7 / 252.0, d6 / 72.0, d5 / 30.0, d4 / 24.0, i,
        d6 / 72.0, d5 / 20.0, d4 / 8.0, d3 / 6.0, j,
        d5 / 30.0, d4 / 8.0, d3 / 3.0, d2 / 2.0, k,
        d4 / 24.0, d3 / 6.0, d2 / 2.0, dt, l,
        i, j, k, l, m,
    );
    noise[(4, 4)] += clock;
    (transition, noise)
}
