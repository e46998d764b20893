//! Linear Gaussian state space: a filter forward, a smoother backward, and the likelihood of the observations.
//!
//! ```text
//! x(k+1) = F(k) x(k) + w(k),  w ~ N(0, Q(k))        z(k) = h(k) x(k) + v(k),  v ~ N(0, r(k))
//! ```
//!
//! Observations are scalars and may be missing. The smoother is of the Bryson–Frazier kind: it needs no inverse, so states
//! without noise and states with a very wide prior do no harm.
//! Source: Bierman, Factorization Methods for Discrete Sequential Estimation, 1977 (from memory).

/// A small square matrix, by rows.
pub(crate) type Matrix<const N: usize> = [[f64; N]; N];

/// A small vector.
pub(crate) type Vector<const N: usize> = [f64; N];

/// The unit matrix.
pub(crate) fn identity<const N: usize>() -> Matrix<N> {
    let mut unit = [[0.0; N]; N];
    for (i, row) in unit.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    unit
}

/// Product of two matrices; quick where the first has many zeros.
pub(crate) fn product<const N: usize>(a: &Matrix<N>, b: &Matrix<N>) -> Matrix<N> {
    let mut c = [[0.0; N]; N];
    for (ci, ai) in c.iter_mut().zip(a) {
        for (&aik, bk) in ai.iter().zip(b).filter(|(a, _)| **a != 0.0) {
            for (cij, &bkj) in ci.iter_mut().zip(bk) {
                *cij += aik * bkj;
            }
        }
    }
    c
}

/// The transposed matrix.
pub(crate) fn transposed<const N: usize>(a: &Matrix<N>) -> Matrix<N> {
    let mut t = [[0.0; N]; N];
    for (i, row) in a.iter().enumerate() {
        for (j, &value) in row.iter().enumerate() {
            t[j][i] = value;
        }
    }
    t
}

/// Matrix times vector.
pub(crate) fn applied<const N: usize>(a: &Matrix<N>, x: &Vector<N>) -> Vector<N> {
    let mut y = [0.0; N];
    for (yi, row) in y.iter_mut().zip(a) {
        *yi = dot(row, x);
    }
    y
}

/// Scalar product.
pub(crate) fn dot<const N: usize>(a: &Vector<N>, b: &Vector<N>) -> f64 {
    a.iter().zip(b).map(|(p, q)| p * q).sum()
}

/// `f p fᵀ + q`, made symmetric.
fn propagated<const N: usize>(f: &Matrix<N>, p: &Matrix<N>, q: &Matrix<N>) -> Matrix<N> {
    let mut next = product(f, &transposed(&product(f, p)));
    for (row, noise) in next.iter_mut().zip(q) {
        for (value, add) in row.iter_mut().zip(noise) {
            *value += add;
        }
    }
    symmetric(&mut next);
    next
}

/// Takes the mean of a matrix and its transposed one.
#[inline]
#[allow(clippy::needless_range_loop)] // two entries at a time
pub(crate) fn symmetric<const N: usize>(p: &mut Matrix<N>) {
    for i in 0..N {
        for j in 0..i {
            let mean = 0.5 * (p[i][j] + p[j][i]);
            p[i][j] = mean;
            p[j][i] = mean;
        }
    }
}

/// Exponential of a small matrix, by scaling and a Taylor series of order 12.
pub(crate) fn exponential<const N: usize>(a: &Matrix<N>) -> Matrix<N> {
    let norm = a
        .iter()
        .map(|row| row.iter().map(|v| v.abs()).sum::<f64>())
        .fold(0.0, f64::max);
    let halvings = if norm > 0.25 {
        ((norm / 0.25).log2().ceil() as i32).clamp(0, 60)
    } else {
        0
    };
    let scale = 0.5_f64.powi(halvings);
    let mut small = *a;
    for value in small.iter_mut().flatten() {
        *value *= scale;
    }
    let mut sum = identity();
    let mut term = identity();
    for order in 1..=12 {
        term = product(&term, &small);
        for (s, t) in sum.iter_mut().flatten().zip(term.iter_mut().flatten()) {
            *t /= f64::from(order);
            *s += *t;
        }
    }
    for _ in 0..halvings {
        sum = product(&sum, &sum);
    }
    sum
}

/// Covariance that unit-density white noise on one state gathers over a step, `∫ e^{Aτ} b bᵀ e^{Aᵀτ} dτ`.
///
/// Gauss quadrature with three points on each of `pieces` parts of the step.
pub(crate) fn gathered_noise<const N: usize>(
    a: &Matrix<N>,
    b: &Vector<N>,
    step: f64,
    pieces: usize,
) -> Matrix<N> {
    let mut gathered = [[0.0; N]; N];
    let width = step / pieces as f64;
    for piece in 0..pieces {
        for (node, weight) in GAUSS {
            let reach = (piece as f64 + node) * width;
            let mut scaled = *a;
            for value in scaled.iter_mut().flatten() {
                *value *= reach;
            }
            let column = applied(&exponential(&scaled), b);
            for (row, &left) in gathered.iter_mut().zip(&column) {
                for (value, &right) in row.iter_mut().zip(&column) {
                    *value += weight * width * left * right;
                }
            }
        }
    }
    gathered
}

/// Nodes and weights of three-point Gauss quadrature on 0 to 1.
pub(crate) const GAUSS: [(f64, f64); 3] = [
    (0.112_701_665_379_258_3, 5.0 / 18.0),
    (0.5, 8.0 / 18.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];

/// Correlation of innovations that are `lag` apart.
pub(crate) fn correlation(innovations: &[f64], lag: usize) -> f64 {
    let pairs = innovations.iter().zip(innovations.iter().skip(lag));
    let power: f64 = innovations.iter().map(|e| e * e).sum();
    pairs.map(|(a, b)| a * b).sum::<f64>() / power.max(f64::MIN_POSITIVE)
}

/// How much more slow noise there is than the model's white one: the innovations' spectrum at nothing, at least 1.
pub(crate) fn colour(innovations: &[f64]) -> f64 {
    let lags = 12;
    let taper = |lag: usize| 1.0 - lag as f64 / (lags + 1) as f64;
    let sum: f64 = (1..=lags)
        .map(|lag| 2.0 * taper(lag) * correlation(innovations, lag))
        .sum();
    (1.0 + sum).max(1.0)
}

/// What was seen at an instant: `value = row · state + noise`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Observation<const N: usize> {
    pub(crate) row: Vector<N>,
    pub(crate) value: f64,
    pub(crate) variance: f64,
}

/// One instant of the chain, as the filter left it.
struct Node<const N: usize> {
    mean: Vector<N>,
    covariance: Matrix<N>,
    /// Row, innovation over its variance, innovation variance, gain; none where nothing was observed.
    update: Option<(Vector<N>, f64, f64, Vector<N>)>,
    /// From the instant before to this one.
    transition: Matrix<N>,
}

/// A forward filter that remembers what the smoother needs.
pub(crate) struct Filter<const N: usize> {
    mean: Vector<N>,
    covariance: Matrix<N>,
    log_likelihood: f64,
    innovations: Vec<f64>,
    nodes: Vec<Node<N>>,
    keep: bool,
    pending: Matrix<N>,
}

/// State after all observations are known: mean and variances.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Smoothed<const N: usize> {
    pub(crate) mean: Vector<N>,
    pub(crate) variance: Vector<N>,
}

impl<const N: usize> Filter<N> {
    /// Starts from a prior; `keep` remembers the nodes for [`Filter::smoothed`].
    pub(crate) fn new(mean: Vector<N>, covariance: Matrix<N>, keep: bool) -> Self {
        Self {
            mean,
            covariance,
            log_likelihood: 0.0,
            innovations: Vec::new(),
            nodes: Vec::new(),
            keep,
            pending: identity(),
        }
    }

    /// Moves to the next instant.
    pub(crate) fn predict(&mut self, transition: &Matrix<N>, noise: &Matrix<N>) {
        self.mean = applied(transition, &self.mean);
        self.covariance = propagated(transition, &self.covariance, noise);
        if self.keep {
            self.pending = product(transition, &self.pending);
        }
    }

    /// Takes an observation, or marks the instant where there is none. Every call is one node of the smoother.
    pub(crate) fn observe(&mut self, observation: Option<&Observation<N>>) {
        let (mean, covariance) = (self.mean, self.covariance);
        let mut update = None;
        if let Some(seen) = observation {
            let spread = applied(&self.covariance, &seen.row);
            let variance = dot(&seen.row, &spread) + seen.variance;
            if variance > 0.0 && variance.is_finite() && seen.value.is_finite() {
                let innovation = seen.value - dot(&seen.row, &self.mean);
                let mut gain = spread;
                for value in &mut gain {
                    *value /= variance;
                }
                for (m, k) in self.mean.iter_mut().zip(&gain) {
                    *m += k * innovation;
                }
                self.covariance = joseph(&self.covariance, &seen.row, &gain, seen.variance);
                self.log_likelihood -= 0.5
                    * (innovation * innovation / variance
                        + variance.ln()
                        + std::f64::consts::TAU.ln());
                if self.keep {
                    self.innovations.push(innovation / variance.sqrt());
                }
                update = Some((seen.row, innovation / variance, variance, gain));
            }
        }
        if self.keep {
            self.nodes.push(Node {
                mean,
                covariance,
                update,
                transition: self.pending,
            });
            self.pending = identity();
        }
    }

    /// Logarithm of the likelihood of all observations so far.
    pub(crate) fn log_likelihood(&self) -> f64 {
        self.log_likelihood
    }

    /// Innovations in units of their standard deviation, in order; white if the model holds.
    pub(crate) fn innovations(&self) -> &[f64] {
        &self.innovations
    }

    /// State at every node after all observations.
    pub(crate) fn smoothed(&self) -> Vec<Smoothed<N>> {
        let mut states = Vec::with_capacity(self.nodes.len());
        let mut vector = [0.0; N];
        let mut matrix = [[0.0; N]; N];
        for node in self.nodes.iter().rev() {
            if let Some((row, innovation, variance, gain)) = &node.update {
                seen_back(
                    &mut vector,
                    &mut matrix,
                    row,
                    gain,
                    (*innovation, 1.0 / variance),
                );
            }
            let shift = applied(&node.covariance, &vector);
            let mut mean = node.mean;
            for (m, s) in mean.iter_mut().zip(&shift) {
                *m -= s;
            }
            let shrink = product(&node.covariance, &matrix);
            let mut variance = [0.0; N];
            for (i, v) in variance.iter_mut().enumerate() {
                *v = node.covariance[i][i] - dot(&shrink[i], &node.covariance[i]);
            }
            states.push(Smoothed { mean, variance });
            let back = transposed(&node.transition);
            vector = applied(&back, &vector);
            matrix = product(&back, &transposed(&product(&back, &matrix)));
        }
        states.reverse();
        states
    }
}

/// Takes gradient and curvature of the misfit of all that follows back over an observation: `(I - k h)ᵀ g - hᵀ e/s` and
/// `(I - k h)ᵀ c (I - k h) + hᵀ h/s`.
///
/// - `row`, `gain`: h and k
/// - `pull`: innovation over its variance, e/s, and one over its variance, 1/s
pub(crate) fn seen_back<const N: usize>(
    gradient: &mut Vector<N>,
    curvature: &mut Matrix<N>,
    row: &Vector<N>,
    gain: &Vector<N>,
    (pull, stiffness): (f64, f64),
) {
    let along = dot(gain, gradient);
    for (g, h) in gradient.iter_mut().zip(row) {
        *g -= h * (along + pull);
    }
    let pulled = applied(curvature, gain);
    let twice = dot(gain, &pulled);
    for i in 0..N {
        for j in 0..N {
            curvature[i][j] +=
                row[i] * row[j] * (twice + stiffness) - row[i] * pulled[j] - pulled[i] * row[j];
        }
    }
    symmetric(curvature);
}

/// `(I - k h) p (I - k h)ᵀ + r k kᵀ`, which stays symmetric and positive.
fn joseph<const N: usize>(
    p: &Matrix<N>,
    row: &Vector<N>,
    gain: &Vector<N>,
    variance: f64,
) -> Matrix<N> {
    let spread = applied(p, row);
    let along = dot(row, &spread);
    let mut next = *p;
    for i in 0..N {
        for j in 0..N {
            next[i][j] +=
                gain[i] * gain[j] * (along + variance) - gain[i] * spread[j] - spread[i] * gain[j];
        }
    }
    symmetric(&mut next);
    next
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponential_of_a_rotation_rotates() {
        let turned = exponential(&[[0.0, -2.0], [2.0, 0.0]]);
        assert!((turned[0][0] - 2.0_f64.cos()).abs() < 1e-13);
        assert!((turned[1][0] - 2.0_f64.sin()).abs() < 1e-13);
    }

    #[test]
    fn noise_gathers_as_for_an_integrated_random_walk() {
        let h = 0.3_f64;
        let q = gathered_noise(&[[0.0, 1.0], [0.0, 0.0]], &[0.0, 1.0], h, 1);
        assert!((q[0][0] - h.powi(3) / 3.0).abs() < 1e-15);
        assert!((q[0][1] - h * h / 2.0).abs() < 1e-15);
        assert!((q[1][1] - h).abs() < 1e-15);
    }

    /// A random walk seen three times is a Gaussian vector: the smoother must give its conditional mean and variance,
    /// found here by the normal equations.
    #[test]
    fn smoothing_equals_conditioning() {
        let (prior, walk, noise) = (4.0, 0.5, 0.25);
        let seen = [1.0, f64::NAN, 2.0, 1.5];
        let mut filter = Filter::<1>::new([0.3], [[prior]], true);
        for (k, &value) in seen.iter().enumerate() {
            if k > 0 {
                filter.predict(&[[1.0]], &[[walk]]);
            }
            let observation = Observation {
                row: [1.0],
                value,
                variance: noise,
            };
            filter.observe(value.is_finite().then_some(&observation));
        }
        // Precision matrix of the four states and its right-hand side.
        let mut a = [[0.0; 4]; 4];
        let mut b = [0.0; 4];
        a[0][0] += 1.0 / prior;
        b[0] += 0.3 / prior;
        for k in 0..3 {
            a[k][k] += 1.0 / walk;
            a[k + 1][k + 1] += 1.0 / walk;
            a[k][k + 1] -= 1.0 / walk;
            a[k + 1][k] -= 1.0 / walk;
        }
        for (k, &value) in seen.iter().enumerate().filter(|(_, v)| v.is_finite()) {
            a[k][k] += 1.0 / noise;
            b[k] += value / noise;
        }
        // Gauss–Seidel is enough for a diagonally dominant system.
        let solve = |b: [f64; 4]| {
            let mut x = [0.0; 4];
            for _ in 0..2000 {
                for i in 0..4 {
                    let rest: f64 = (0..4).filter(|&j| j != i).map(|j| a[i][j] * x[j]).sum();
                    x[i] = (b[i] - rest) / a[i][i];
                }
            }
            x
        };
        let mean = solve(b);
        for (k, state) in filter.smoothed().iter().enumerate() {
            let mut unit = [0.0; 4];
            unit[k] = 1.0;
            assert!((state.mean[0] - mean[k]).abs() < 1e-12);
            assert!((state.variance[0] - solve(unit)[k]).abs() < 1e-12);
        }
    }
}
