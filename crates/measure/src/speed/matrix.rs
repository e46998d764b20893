//! Vectors and matrices of angle, speed, acceleration, jerk, and the error of the clock.
#![allow(clippy::needless_range_loop)] // rows and columns by number read like the formula

use crate::state_space::{self, symmetric};

pub(super) const N: usize = 5;
pub(super) type Vector = state_space::Vector<N>;
pub(super) type Matrix = state_space::Matrix<N>;

pub(super) fn plus(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][j] + b[i][j]))
}

pub(super) fn minus(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][j] - b[i][j]))
}

/// The part of the error of the instants that has a memory: variance, and how fast it forgets.
#[derive(Clone, Copy, Debug)]
pub(super) struct Memory {
    /// Standard deviation, time.
    pub spread: f64,
    /// One over the time in which it decays to 1/e.
    pub rate: f64,
}

/// Free motion over a time: constant jerk, and an error that is forgotten.
pub(super) fn drift(dt: f64, memory: &Memory) -> Matrix {
    let (h, s) = (0.5 * dt * dt, dt * dt * dt / 6.0);
    [
        [1.0, dt, h, s, 0.0],
        [0.0, 1.0, dt, h, 0.0],
        [0.0, 0.0, 1.0, dt, 0.0],
        [0.0, 0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, (-dt * memory.rate).exp()],
    ]
}

/// Covariance that white snap of some density, and the error of the instants, gather over a time.
///
/// Formula: Q_ij = density dt^(7-i-j) / ((7-i-j) (3-i)! (3-j)!), i, j from 0 to 3.
pub(super) fn gathered(dt: f64, density: f64, memory: &Memory) -> Matrix {
    gathered_with(
        dt,
        density,
        memory.spread * memory.spread * -(-2.0 * dt * memory.rate).exp_m1(),
    )
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
    *x = [
        x[0] + dt * x[1] + h * x[2] + s * x[3],
        x[1] + dt * x[2] + h * x[3],
        x[2] + dt * x[3],
        x[3],
        (-dt * memory.rate).exp() * x[4],
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
    let mut b = gathered_with(
        dt,
        density,
        memory.spread * memory.spread * (1.0 - kept * kept),
    );
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

/// A gradient and a curvature taken back over a time: `fᵀ g`, `fᵀ c f`.
#[inline]
pub(super) fn taken_back(g: &mut Vector, c: &mut Matrix, dt: f64, memory: &Memory) {
    let (h, s) = (0.5 * dt * dt, dt * dt * dt / 6.0);
    let kept = (-dt * memory.rate).exp();
    *g = [
        g[0],
        dt * g[0] + g[1],
        h * g[0] + dt * g[1] + g[2],
        s * g[0] + h * g[1] + dt * g[2] + g[3],
        kept * g[4],
    ];
    let mut a = [[0.0; N]; N];
    for j in 0..N {
        a[0][j] = c[0][j];
        a[1][j] = dt * c[0][j] + c[1][j];
        a[2][j] = h * c[0][j] + dt * c[1][j] + c[2][j];
        a[3][j] = s * c[0][j] + h * c[1][j] + dt * c[2][j] + c[3][j];
        a[4][j] = kept * c[4][j];
    }
    for i in 0..N {
        c[i] = [
            a[i][0],
            dt * a[i][0] + a[i][1],
            h * a[i][0] + dt * a[i][1] + a[i][2],
            s * a[i][0] + h * a[i][1] + dt * a[i][2] + a[i][3],
            kept * a[i][4],
        ];
    }
    symmetric(c);
}

/// Lower triangle `l` with `l lᵀ = p` of a matrix that may be singular.
pub(super) fn root(p: &Matrix) -> Matrix {
    let mut l = [[0.0; N]; N];
    for j in 0..N {
        let pivot = p[j][j] - (0..j).map(|k| l[j][k] * l[j][k]).sum::<f64>();
        if pivot <= 1e-14 * p[j][j].abs() {
            continue;
        }
        l[j][j] = pivot.sqrt();
        for i in j + 1..N {
            l[i][j] = (p[i][j] - (0..j).map(|k| l[i][k] * l[j][k]).sum::<f64>()) / l[j][j];
        }
    }
    l
}
