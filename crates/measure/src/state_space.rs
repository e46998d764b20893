//! Linear Gaussian state space: a filter forward, a smoother backward, and the likelihood of the observations.
//!
//! ```text
//! x(k+1) = F(k) x(k) + w(k),  w ~ N(0, Q(k))        z(k) = h(k) x(k) + v(k),  v ~ N(0, r(k))
//! ```
//!
//! Observations are scalars and may be missing. Forward: a Kalman filter with the symmetric update, P = L Lᵀ. Backward: the adjoint
//! recursion of Bryson and Frazier for the mean, x' = x - P g, and the information Y that all which follows holds of the state, for
//! the covariance: P' = L (1 + Lᵀ Y L)⁻¹ Lᵀ, in which no large numbers nearly cancel however little was known before. No singular
//! matrix is inverted, so that states without noise, states with a very wide prior and intervals of any length do no harm.
//!
//! Source: Bierman, Factorization Methods for Discrete Sequential Estimation, 1977, chapter X; Fraser and Potter, The optimum linear
//! smoother as a combination of two optimum linear filters, 1969 (both from memory).

use nalgebra::{SMatrix, SVector};

/// A small square matrix.
pub(crate) type Matrix<const N: usize> = SMatrix<f64, N, N>;

/// A small vector.
pub(crate) type Vector<const N: usize> = SVector<f64, N>;

/// Mean of a matrix and its transposed one.
fn symmetric<const N: usize>(p: Matrix<N>) -> Matrix<N> {
    0.5 * (p + p.transpose())
}

/// Lower triangular root of a covariance, `p = l lᵀ`; a direction that rounding leaves no variance has none.
fn root<const N: usize>(p: &Matrix<N>) -> Matrix<N> {
    let mut l = Matrix::<N>::zeros();
    for j in 0..N {
        let left = p[(j, j)] - l.row(j).norm_squared();
        if left <= f64::EPSILON * p[(j, j)] {
            continue;
        }
        l[(j, j)] = left.sqrt();
        for i in j + 1..N {
            l[(i, j)] = (p[(i, j)] - l.row(i).dot(&l.row(j))) / l[(j, j)];
        }
    }
    l
}

/// Root of the inverse of a matrix that is at least the unit matrix: `m⁻¹ = i iᵀ`. The largest are taken out first, so that they do
/// not round what is small.
fn inverted<const N: usize>(m: &Matrix<N>) -> Matrix<N> {
    let mut left = *m;
    let mut order: [usize; N] = std::array::from_fn(|i| i);
    // `left` after the steps: below its diagonal, the lower root of the matrix in its new order.
    for k in 0..N {
        let largest = (k..N).max_by(|&i, &j| left[(i, i)].total_cmp(&left[(j, j)]));
        let largest = largest.unwrap_or(k);
        order.swap(k, largest);
        left.swap_rows(k, largest);
        left.swap_columns(k, largest);
        let pivot = left[(k, k)].max(1.0).sqrt();
        left[(k, k)] = pivot;
        for i in k + 1..N {
            left[(i, k)] /= pivot;
        }
        for j in k + 1..N {
            for i in k + 1..N {
                left[(i, j)] -= left[(i, k)] * left[(j, k)];
            }
        }
    }
    let rows = Matrix::from_fn(|row, column| f64::from(u8::from(column == order[row])));
    let solved = left.solve_lower_triangular(&rows);
    solved.unwrap_or_else(Matrix::zeros).transpose()
}

/// Covariance that unit-density white noise gathers over a step, `∫ r(τ) r(τ)ᵀ dτ`; `reached` is what a unit push does so long after.
///
/// Gauss quadrature with three points on each of `pieces` parts of the step.
pub(crate) fn gathered_noise<const N: usize>(
    reached: impl Fn(f64) -> Vector<N>,
    step: f64,
    pieces: usize,
) -> Matrix<N> {
    let mut gathered = Matrix::zeros();
    let width = step / pieces as f64;
    for piece in 0..pieces {
        for (node, weight) in GAUSS {
            let column = reached((piece as f64 + node) * width);
            gathered += weight * width * column * column.transpose();
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

/// Mean and covariance of a state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Belief<const N: usize> {
    pub(crate) mean: Vector<N>,
    pub(crate) covariance: Matrix<N>,
}

impl<const N: usize> Belief<N> {
    /// A step later.
    fn predicted(&self, transition: &Matrix<N>, noise: &Matrix<N>) -> Belief<N> {
        Belief {
            mean: transition * self.mean,
            covariance: symmetric(transition * self.covariance * transition.transpose() + noise),
        }
    }
}

/// What an observation did to a belief.
#[derive(Clone, Copy, Debug)]
struct Update<const N: usize> {
    seen: Observation<N>,
    gain: Vector<N>,
    /// Innovation over its variance.
    pull: f64,
}

/// A step of the chain and the observation at its end, where there is one.
#[derive(Clone, Copy, Debug)]
struct Step<const N: usize> {
    transition: Matrix<N>,
    noise: Matrix<N>,
    update: Option<Update<N>>,
    is_node: bool,
    /// As the filter leaves it.
    belief: Belief<N>,
}

/// What is seen after an instant says of the state there.
#[derive(Clone, Copy, Debug)]
struct Later<const N: usize> {
    /// Gradient of its misfit at the filtered mean.
    gradient: Vector<N>,
    /// Information, the inverse of a covariance.
    known: Matrix<N>,
}

impl<const N: usize> Later<N> {
    /// Nothing.
    fn nothing() -> Later<N> {
        Later {
            gradient: Vector::zeros(),
            known: Matrix::zeros(),
        }
    }

    /// To before the observation at the end of a step.
    fn see(&mut self, step: &Step<N>) {
        let Some(update) = &step.update else { return };
        let Observation { row, variance, .. } = &update.seen;
        self.gradient -= row * (update.gain.dot(&self.gradient) + update.pull);
        self.known += row * row.transpose() / *variance;
    }

    /// To before a step.
    fn take_back(&mut self, transition: &Matrix<N>, noise: &Matrix<N>) {
        // The noise column by column: a disturbance `column · w` with w of variance 1.
        for column in root(noise)
            .column_iter()
            .filter(|c| c.iter().any(|x| *x != 0.0))
        {
            let spread = self.known * column;
            let gain = spread / (1.0 + column.dot(&spread));
            // (1 - g cᵀ) Y (1 - c gᵀ) as a sum of squares, one factor after the other: what is left may be much less than what was known.
            let half = self.known - gain * spread.transpose();
            let left = half - half * column * gain.transpose();
            self.known = symmetric(left + gain * gain.transpose());
        }
        self.gradient = transition.tr_mul(&self.gradient);
        self.known = symmetric(transition.tr_mul(&self.known) * transition);
    }

    /// Belief from all that is seen, from what the filter makes of the earlier part.
    fn joined(&self, belief: &Belief<N>) -> Belief<N> {
        let root = root(&belief.covariance);
        let sum = symmetric(Matrix::identity() + root.tr_mul(&self.known) * root);
        let both = root * inverted(&sum);
        Belief {
            mean: belief.mean - belief.covariance * self.gradient,
            covariance: symmetric(both * both.transpose()),
        }
    }
}

/// A forward filter that remembers what the smoother needs.
#[derive(Clone, Debug)]
pub(crate) struct Filter<const N: usize> {
    start: Belief<N>,
    belief: Belief<N>,
    log_likelihood: f64,
    innovations: Vec<f64>,
    steps: Vec<Step<N>>,
    keep: bool,
    along: Vector<N>,
    slope: f64,
    curvature: f64,
}

impl<const N: usize> Filter<N> {
    /// Starts from a prior; `keep` remembers the steps for [`Filter::smoother`].
    pub(crate) fn new(start: Belief<N>, keep: bool) -> Self {
        Self {
            start,
            belief: start,
            log_likelihood: 0.0,
            innovations: Vec::new(),
            steps: Vec::new(),
            keep,
            along: Vector::zeros(),
            slope: 0.0,
            curvature: 0.0,
        }
    }

    /// The direction of the mean at the start along which the likelihood has its derivatives.
    pub(crate) fn along(mut self, direction: Vector<N>) -> Self {
        self.along = direction;
        self
    }

    /// Moves to the next instant.
    pub(crate) fn predict(&mut self, transition: &Matrix<N>, noise: &Matrix<N>) {
        self.belief = self.belief.predicted(transition, noise);
        self.along = transition * self.along;
        self.remember(transition, noise);
    }

    /// Begins anew: what is behind does not follow from what was before.
    pub(crate) fn restart(&mut self, belief: &Belief<N>) {
        self.belief = *belief;
        self.along = Vector::zeros();
        self.remember(&Matrix::zeros(), &belief.covariance);
    }

    fn remember(&mut self, transition: &Matrix<N>, noise: &Matrix<N>) {
        if self.keep {
            self.steps.push(Step {
                transition: *transition,
                noise: *noise,
                update: None,
                is_node: false,
                belief: self.belief,
            });
        }
    }

    /// Takes an observation, or marks the instant where there is none. Every call is one node of the smoother.
    ///
    /// An innovation without a variance makes the whole record impossible.
    pub(crate) fn observe(&mut self, observation: Option<&Observation<N>>) {
        let update = observation.and_then(|seen| self.updated(seen));
        if self.steps.last().is_none_or(|step| step.is_node) {
            self.remember(&Matrix::identity(), &Matrix::zeros());
        }
        if let Some(step) = self.steps.last_mut() {
            (step.update, step.is_node, step.belief) = (update, true, self.belief);
        }
    }

    fn updated(&mut self, seen: &Observation<N>) -> Option<Update<N>> {
        let spread = self.belief.covariance * seen.row;
        let variance = seen.row.dot(&spread) + seen.variance;
        let innovation = seen.value - seen.row.dot(&self.belief.mean);
        if !(variance > 0.0 && variance.is_finite() && innovation.is_finite()) {
            self.log_likelihood = f64::NEG_INFINITY;
            return None;
        }
        let gain = spread / variance;
        let pull = innovation / variance;
        self.belief.mean += gain * innovation;
        // (1 - k h) P (1 - k h)ᵀ + r k kᵀ, multiplied out: stays symmetric
        let both = gain * spread.transpose();
        self.belief.covariance += gain * gain.transpose() * variance - both - both.transpose();
        self.log_likelihood -=
            0.5 * (innovation * pull + variance.ln() + std::f64::consts::TAU.ln());
        let change = seen.row.dot(&self.along);
        self.slope += pull * change;
        self.curvature += change * change / variance;
        self.along -= gain * change;
        if self.keep {
            self.innovations.push(innovation / variance.sqrt());
        }
        Some(Update {
            seen: *seen,
            gain,
            pull,
        })
    }

    /// Logarithm of the likelihood of all observations so far.
    pub(crate) fn log_likelihood(&self) -> f64 {
        self.log_likelihood
    }

    /// First and second derivative of it with the mean at the start along the direction, the second one with its sign turned.
    pub(crate) fn derivatives(&self) -> (f64, f64) {
        (self.slope, self.curvature)
    }

    /// Innovations in units of their standard deviation, in order; white if the model holds.
    pub(crate) fn innovations(&self) -> &[f64] {
        &self.innovations
    }

    /// Number of steps so far.
    pub(crate) fn steps(&self) -> usize {
        self.steps.len()
    }

    /// What all observations say of every instant.
    pub(crate) fn smoother(self) -> Smoother<N> {
        let mut now = Later::nothing();
        let mut later = vec![now; self.steps.len()];
        for (step, later) in self.steps.iter().zip(&mut later).rev() {
            *later = now;
            now.see(step);
            now.take_back(&step.transition, &step.noise);
        }
        Smoother {
            start: self.start,
            steps: self.steps,
            later,
        }
    }
}

/// A record that is filtered, with what follows after every step.
#[derive(Clone, Debug)]
pub(crate) struct Smoother<const N: usize> {
    start: Belief<N>,
    steps: Vec<Step<N>>,
    later: Vec<Later<N>>,
}

impl<const N: usize> Smoother<N> {
    /// State at every node.
    pub(crate) fn nodes(&self) -> Vec<Belief<N>> {
        let all = self.steps.iter().zip(&self.later);
        let nodes = all.filter(|(step, _)| step.is_node);
        nodes
            .map(|(step, later)| later.joined(&step.belief))
            .collect()
    }

    /// State within a step, or behind the last one: transition and noise of the part of the step before it, and of what is left.
    pub(crate) fn within(
        &self,
        step: usize,
        before: (&Matrix<N>, &Matrix<N>),
        left: (&Matrix<N>, &Matrix<N>),
    ) -> Belief<N> {
        let earlier = step
            .checked_sub(1)
            .map_or(&self.start, |k| &self.steps[k].belief);
        let mut later = Later::nothing();
        if let (Some(step), Some(after)) = (self.steps.get(step), self.later.get(step)) {
            later = *after;
            later.see(step);
            later.take_back(left.0, left.1);
        }
        later.joined(&earlier.predicted(before.0, before.1))
    }

    /// Whether every number is finite.
    pub(crate) fn is_finite(&self) -> bool {
        let beliefs = self.steps.iter().map(|step| &step.belief);
        let numbers = beliefs.flat_map(|b| b.mean.iter().chain(&b.covariance));
        let later = self
            .later
            .iter()
            .flat_map(|l| l.gradient.iter().chain(&l.known));
        numbers.chain(later).all(|x| x.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_gathers_as_for_an_integrated_random_walk() {
        let h = 0.3_f64;
        let q = gathered_noise(|t| Vector::from([t, 1.0]), h, 1);
        assert!((q[(0, 0)] - h.powi(3) / 3.0).abs() < 1e-15);
        assert!((q[(0, 1)] - h * h / 2.0).abs() < 1e-15);
        assert!((q[(1, 1)] - h).abs() < 1e-15);
    }
}
