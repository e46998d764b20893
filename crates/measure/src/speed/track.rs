//! Filter and smoother for given times, noises and knots.
//!
//! ```text
//! state  x = [angle, speed, acceleration, jerk, e]   white noise of the density q in the snap
//! e      of pulses: error of the instants with a memory, a first-order Markov process; of a speed channel: what its instrument
//!        shows of the speed, ė = (speed - e)/τ
//! pulse  z = angle + speed e + noise of variance r;   channel  z = e + noise, or speed + noise where the instrument has no lag
//! knot   variance added to any state at an instant: what it is after follows less, or not at all, from what it was before
//! ```
//! Forward: a Kalman filter, P = L Lᵀ. Backward: the adjoint recursion of Bryson and Frazier for the mean, x' = x - P g, and the
//! information Y that all which follows holds of the state, for the covariance: P' = L (1 + Lᵀ Y L)⁻¹ Lᵀ, in which no large
//! numbers nearly cancel however little was known before. No singular matrix is inverted, so that a start from rest with exactly
//! known speed, and intervals of any length, do no harm.
//!
//! Source: Bierman, Factorization Methods for Discrete Sequential Estimation, 1977, chapter X; Fraser and Potter, The optimum linear
//! smoother as a combination of two optimum linear filters, 1969 (both from memory).
#![allow(clippy::needless_range_loop)] // rows and columns by number read like the formula

use super::matrix::{Matrix, Memory, N, Vector, advance, carry, drift, gathered, plus};
use super::node::{Belief, Node, Sight};
use crate::state_space::{applied, dot, identity, product, symmetric, transposed};

/// A filtered and smoothed record.
#[derive(Clone, Debug)]
pub(super) struct Track {
    nodes: Vec<Node>,
    times: Vec<f64>,
    start: Belief,
    /// After each node.
    filtered: Vec<Belief>,
    /// What each node and all behind it say of the state just before it.
    later: Vec<Later>,
    /// Density after the last node.
    density: f64,
    memory: Memory,
}

/// What a node does to a belief; nothing where no mark passes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Update {
    gain: Vector,
    /// Innovation divided by its variance, and one over its variance.
    pull: f64,
    stiffness: f64,
}

impl Update {
    /// The innovation in units of its deviation.
    pub fn innovation(&self) -> f64 {
        match self.stiffness > 0.0 {
            true => self.pull / self.stiffness.sqrt(),
            false => 0.0,
        }
    }
}

/// What follows from a pass forward.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pass {
    /// Logarithm of the likelihood, up to a constant.
    pub likelihood: f64,
    /// First and second derivative of it with the mean at the start along a direction, the second one with its sign turned.
    pub slope: f64,
    pub curvature: f64,
}

/// One pass forward; `direction` is that of the derivatives; `visit` sees every node's belief after it.
pub(super) fn forward(
    nodes: &[Node],
    start: &Belief,
    direction: &Vector,
    memory: &Memory,
    mut visit: impl FnMut(&Belief, &Update),
) -> Pass {
    let mut belief = *start;
    let mut along = *direction;
    let mut time = nodes.first().map_or(0.0, |node| node.time);
    let (mut likelihood, mut slope, mut curvature) = (0.0, 0.0, 0.0);
    for node in nodes {
        let dt = node.time - time;
        time = node.time;
        if dt > 0.0 {
            advance(
                &mut belief.mean,
                &mut belief.covariance,
                dt,
                node.density,
                memory,
            );
            carry(&mut along, dt, memory);
        }
        if let Some(added) = node.added {
            for (i, a) in added.iter().enumerate() {
                belief.covariance[i][i] += a;
            }
        }
        if let Some(fresh) = &node.fresh {
            belief = fresh.belief(memory);
            along = [0.0; N];
        }
        let mut update = Update::default();
        if let Some(pulse) = &node.pulse {
            let innovation = pulse.value - pulse.of(&belief.mean);
            let row = pulse.seen(&belief.covariance);
            let spread = pulse.of(&row) + pulse.variance;
            update = Update {
                gain: row.map(|x| x / spread),
                pull: innovation / spread,
                stiffness: spread.recip(),
            };
            let change = pulse.of(&along);
            slope += update.pull * change;
            curvature += update.stiffness * change * change;
            for i in 0..N {
                along[i] -= update.gain[i] * change;
                belief.mean[i] += update.gain[i] * innovation;
                for j in 0..N {
                    belief.covariance[i][j] -= update.gain[i] * row[j];
                }
            }
            likelihood -= 0.5 * (innovation * innovation / spread + spread.ln());
        }
        visit(&belief, &update);
    }
    if !likelihood.is_finite() {
        likelihood = f64::NEG_INFINITY;
    }
    Pass {
        likelihood,
        slope,
        curvature,
    }
}

/// What is seen after an instant says of the state there.
#[derive(Clone, Copy, Debug, Default)]
struct Later {
    /// Gradient of its misfit at the filtered mean.
    gradient: Vector,
    /// Information, the inverse of a covariance.
    known: Matrix,
}

impl Later {
    /// Takes in what is seen at the instant.
    fn see(&mut self, seen: &Sight, update: &Update) {
        let along = dot(&update.gain, &self.gradient) + update.pull;
        for i in 0..N {
            self.gradient[i] -= seen.row[i] * along;
            for j in 0..N {
                self.known[i][j] += seen.row[i] * seen.row[j] / seen.variance;
            }
        }
    }

    /// To before a disturbance `column · w` with w of variance 1.
    fn disturb(&mut self, column: &Vector) {
        let spread = applied(&self.known, column);
        let gain = spread.map(|x| x / (1.0 + dot(column, &spread)));
        let mut kept = identity::<N>();
        for i in 0..N {
            for j in 0..N {
                kept[i][j] -= gain[i] * column[j];
            }
        }
        // As a sum of squares: what is left may be much less than what was known.
        self.known = product(&kept, &product(&self.known, &transposed(&kept)));
        for i in 0..N {
            for j in 0..N {
                self.known[i][j] += gain[i] * gain[j];
            }
        }
        symmetric(&mut self.known);
    }

    /// To an earlier instant.
    fn take_back(&mut self, dt: f64, density: f64, memory: &Memory) {
        if dt <= 0.0 {
            return;
        }
        let root = transposed(&root(&gathered(dt, density, memory)));
        for column in root
            .iter()
            .filter(|column| column.iter().any(|x| *x != 0.0))
        {
            self.disturb(column);
        }
        let back = transposed(&drift(dt, memory));
        self.gradient = applied(&back, &self.gradient);
        self.known = product(&back, &product(&self.known, &transposed(&back)));
        symmetric(&mut self.known);
    }

    /// Belief from all that is seen, from what the filter makes of the earlier part.
    fn joined(&self, belief: &Belief) -> Belief {
        let root = root(&belief.covariance);
        let mut sum = product(&transposed(&root), &product(&self.known, &root));
        for (i, row) in sum.iter_mut().enumerate() {
            row[i] += 1.0;
        }
        symmetric(&mut sum);
        let inverse = inverted(&sum);
        let both = product(&root, &inverse);
        let mut covariance = product(&both, &transposed(&both));
        symmetric(&mut covariance);
        let shift = applied(&belief.covariance, &self.gradient);
        Belief {
            mean: std::array::from_fn(|i| belief.mean[i] - shift[i]),
            covariance,
        }
    }
}

/// Lower triangular root of a covariance, `p = l lᵀ`; a direction that rounding leaves no variance has none.
fn root(p: &Matrix) -> Matrix {
    let mut l = [[0.0; N]; N];
    for j in 0..N {
        let left = p[j][j] - dot(&l[j], &l[j]);
        if left <= f64::EPSILON * p[j][j] {
            continue;
        }
        l[j][j] = left.sqrt();
        for i in j + 1..N {
            l[i][j] = (p[i][j] - dot(&l[i], &l[j])) / l[j][j];
        }
    }
    l
}

/// Root of the inverse of a matrix that is at least the unit matrix: `m⁻¹ = i iᵀ`. The largest are taken out first, so that they do
/// not round what is small.
fn inverted(m: &Matrix) -> Matrix {
    let mut left = *m;
    let mut order: [usize; N] = std::array::from_fn(|i| i);
    // `left` after the steps: below its diagonal, the lower root of the matrix in its new order.
    for k in 0..N {
        let largest = (k..N).max_by(|&i, &j| left[i][i].total_cmp(&left[j][j]));
        let largest = largest.unwrap_or(k);
        left.swap(k, largest);
        order.swap(k, largest);
        for row in &mut left[k..] {
            row.swap(k, largest);
        }
        // Rows that are done keep their columns: what is swapped of them lies above the diagonal.
        let pivot = left[k][k].max(1.0).sqrt();
        left[k][k] = pivot;
        for i in k + 1..N {
            left[i][k] /= pivot;
        }
        for i in k + 1..N {
            for j in k + 1..N {
                left[i][j] -= left[i][k] * left[j][k];
            }
        }
    }
    let mut inverse = [[0.0; N]; N];
    for column in 0..N {
        let mut x = [0.0; N];
        for i in column..N {
            let sum: f64 = (column..i).map(|j| left[i][j] * x[j]).sum();
            x[i] = (f64::from(u8::from(i == column)) - sum) / left[i][i];
            inverse[order[column]][i] = x[i];
        }
    }
    inverse
}

impl Track {
    pub fn new(nodes: Vec<Node>, start: Belief, density: f64, memory: Memory) -> Track {
        let mut filtered = Vec::with_capacity(nodes.len());
        let mut updates: Vec<Update> = Vec::with_capacity(nodes.len());
        forward(&nodes, &start, &[0.0; N], &memory, |belief, update| {
            filtered.push(*belief);
            updates.push(*update);
        });
        let mut later = vec![Later::default(); nodes.len()];
        let mut now = Later::default();
        for (k, node) in nodes.iter().enumerate().rev() {
            if let Some(pulse) = &node.pulse {
                now.see(pulse, &updates[k]);
            }
            if node.fresh.is_some() {
                now = Later::default();
            }
            for (state, variance) in node.added.iter().flatten().enumerate() {
                let mut column = [0.0; N];
                column[state] = variance.sqrt();
                now.disturb(&column);
            }
            later[k] = now;
            if k > 0 {
                now.take_back(node.time - nodes[k - 1].time, node.density, &memory);
            }
        }
        let times = nodes.iter().map(|node| node.time).collect();
        Track {
            nodes,
            times,
            start,
            filtered,
            later,
            density,
            memory,
        }
    }

    pub fn begin(&self) -> f64 {
        self.nodes.first().map_or(0.0, |node| node.time)
    }

    pub fn end(&self) -> f64 {
        self.nodes.last().map_or(0.0, |node| node.time)
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        let sound = |m: &Matrix| m.iter().flatten().all(|x| x.is_finite());
        self.times.iter().all(|t| t.is_finite())
            && self
                .filtered
                .iter()
                .all(|b| b.mean.iter().all(|x| x.is_finite()) && sound(&b.covariance))
            && (self.later.iter())
                .all(|later| later.gradient.iter().all(|x| x.is_finite()) && sound(&later.known))
    }

    /// Filtered belief carried to an instant, and what all that follows says of the state there.
    fn around(&self, time: f64) -> (Belief, Later) {
        let next = self.times.partition_point(|&t| t <= time);
        let Some(last) = next.checked_sub(1) else {
            return (self.start, Later::default());
        };
        let dt = time - self.nodes[last].time;
        let node = self.nodes.get(next);
        let density = node.map_or(self.density, |node| node.density);
        let mut belief = self.filtered[last];
        let Belief { mean, covariance } = &mut belief;
        advance(mean, covariance, dt, density, &self.memory);
        let later = node.map_or_else(Later::default, |node| {
            let mut later = self.later[next];
            later.take_back(node.time - time, density, &self.memory);
            later
        });
        (belief, later)
    }

    /// Belief at an instant from all pulses.
    ///
    /// Before the first node a shaft that starts from rest is where it starts; one that turns moves as at the first node,
    /// carried back with the noise that the time between gathers.
    pub fn at(&self, time: f64) -> Belief {
        let begin = self.begin();
        if time >= begin {
            return self.within(time);
        }
        let first = self.within(begin);
        if self.rests() {
            let mut mean = [0.0; N];
            mean[0] = first.mean[0];
            let mut covariance = [[0.0; N]; N];
            covariance[0][0] = first.covariance[0][0];
            return Belief { mean, covariance };
        }
        let path = self.back(time - begin);
        let spread = product(&path, &product(&first.covariance, &transposed(&path)));
        Belief {
            mean: applied(&path, &first.mean),
            covariance: plus(&spread, &self.lost(begin - time)),
        }
    }

    /// Whether the shaft rests before the first node: a start from rest is the one whose speed is known.
    fn rests(&self) -> bool {
        self.start.covariance[1][1] <= 0.0
    }

    /// Free motion back over a time before the first node, where the error of the instants plays no part.
    fn back(&self, dt: f64) -> Matrix {
        drift(dt, &Memory::of_clock(self.memory.spread, 0.0))
    }

    /// Covariance that a time before the first node gathers, seen from its end: neighbouring derivatives err against each
    /// other.
    fn lost(&self, length: f64) -> Matrix {
        let density = self.nodes.first().map_or(self.density, |node| node.density);
        let still = Memory::of_clock(self.memory.spread, 0.0);
        let gathered = gathered(length, density, &still);
        std::array::from_fn(|i| {
            std::array::from_fn(|j| gathered[i][j] * if (i + j) % 2 == 0 { 1.0 } else { -1.0 })
        })
    }

    /// Belief at an instant not before the first node.
    fn within(&self, time: f64) -> Belief {
        let (belief, later) = self.around(time);
        later.joined(&belief)
    }
}

/// Mixture of beliefs.
pub(super) fn mixed(parts: impl Iterator<Item = (f64, Belief)> + Clone) -> Belief {
    let mut mean = [0.0; N];
    for (weight, belief) in parts.clone() {
        for i in 0..N {
            mean[i] += weight * belief.mean[i];
        }
    }
    let mut covariance = [[0.0; N]; N];
    for (weight, belief) in parts {
        let away: Vector = std::array::from_fn(|i| belief.mean[i] - mean[i]);
        let outer: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| away[i] * away[j]));
        let both = plus(&belief.covariance, &outer);
        for i in 0..N {
            for j in 0..N {
                covariance[i][j] += weight * both[i][j];
            }
        }
    }
    Belief { mean, covariance }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    /// Ten marks of an accelerated start, with noise of the angle.
    fn marks() -> Vec<Node> {
        (1..=10)
            .map(|k| {
                let time = 0.4 * f64::from(k);
                let error = 0.01 * f64::from(k * 7 % 5 - 2);
                Node {
                    time,
                    density: 0.05,
                    pulse: Some(Sight::mark(0.5 * time * time + error, 1e-4, time)),
                    added: None,
                    fresh: None,
                }
            })
            .collect()
    }

    fn start(acceleration: f64) -> Belief {
        let mut covariance = [[0.0; N]; N];
        for (i, variance) in [0.01, 0.0, 0.3, 0.1, 1e-4].into_iter().enumerate() {
            covariance[i][i] = variance;
        }
        Belief {
            mean: [0.0, 0.0, acceleration, 0.0, 0.0],
            covariance,
        }
    }

    const MEMORY: Memory = Memory::of_clock(1e-2, 0.5);

    #[test]
    fn derivatives_along_a_direction_are_those_of_the_likelihood() {
        let direction = [0.0, 0.0, 1.0, 0.0, 0.0];
        let pass = |a: f64| forward(&marks(), &start(a), &direction, &MEMORY, |_, _| ());
        // The likelihood is a parabola of the mean: finite differences of any width are exact.
        let (below, here, above) = (pass(-0.5), pass(0.0), pass(0.5));
        let slope = above.likelihood - below.likelihood;
        let curvature = -4.0 * (above.likelihood - 2.0 * here.likelihood + below.likelihood);
        assert!((here.slope / slope - 1.0).abs() < 1e-9, "{here:?} {slope}");
        assert!(
            (here.curvature / curvature - 1.0).abs() < 1e-9,
            "{here:?} {curvature}"
        );
    }

    #[test]
    fn they_give_the_start_that_the_smoother_finds() {
        let direction = [0.0, 0.0, 1.0, 0.0, 0.0];
        let pass = forward(&marks(), &start(0.0), &direction, &MEMORY, |_, _| ());
        let track = Track::new(marks(), start(0.0), 0.05, MEMORY);
        // A track starts at its first node.
        let first = track.at(track.begin());
        let variance: f64 = 0.3;
        let found = variance * pass.slope;
        let left = variance - variance * variance * pass.curvature;
        assert!((found - first.mean[2]).abs() < 1e-9, "{found} {first:?}");
        assert!((left - first.covariance[2][2]).abs() < 1e-9, "{left}");
    }

    /// Of angles of marks `z` and a state `x(t)` that are normal together the state given the marks has the mean
    /// `E x + C S⁻¹ (z - E z)` and the covariance `P - C S⁻¹ Cᵀ`, with C and S from `P(t₁) F(t₂ - t₁)ᵀ` between two instants.
    #[test]
    fn the_smoother_finds_the_conditional_normal_law() {
        let mut nodes = marks();
        nodes[3].added = Some([0.0, 0.0, 0.5, 0.5, 0.0]);
        let track = Track::new(nodes.clone(), start(0.5), 0.05, MEMORY);
        let unseen = |time: f64| {
            let (mut belief, mut now) = (start(0.5), nodes[0].time);
            let mut to = |belief: &mut Belief, time: f64| {
                let Belief { mean, covariance } = belief;
                advance(mean, covariance, time - now, 0.05, &MEMORY);
                now = time;
            };
            for node in nodes.iter().filter(|node| node.time <= time) {
                to(&mut belief, node.time);
                for (i, added) in node.added.iter().flatten().enumerate() {
                    belief.covariance[i][i] += added;
                }
            }
            to(&mut belief, time);
            belief
        };
        let between = |a: f64, b: f64| {
            let path = drift((b - a).abs(), &MEMORY);
            let forward = product(&unseen(a.min(b)).covariance, &transposed(&path));
            if a > b { transposed(&forward) } else { forward }
        };
        let seen: Vec<(f64, Sight)> = (nodes.iter())
            .filter_map(|node| Some((node.time, node.pulse?)))
            .collect();
        let n = seen.len();
        let spread = DMatrix::from_fn(n, n, |i, j| {
            let both = between(seen[i].0, seen[j].0);
            let noise = if i == j { seen[i].1.variance } else { 0.0 };
            seen[i].1.of(&seen[j].1.seen(&both)) + noise
        });
        let inverse = spread.try_inverse().expect("a covariance");
        let missed = DVector::from_fn(n, |i, _| {
            seen[i].1.value - seen[i].1.of(&unseen(seen[i].0).mean)
        });
        for time in [0.4, 0.5, 1.6, 2.7, 4.0, 4.3] {
            let (found, own) = (track.at(time), unseen(time));
            let cross = DMatrix::from_fn(N, n, |state, i| {
                seen[i].1.seen(&between(time, seen[i].0))[state]
            });
            let gain = &cross * &inverse;
            let (shift, shrink) = (&gain * &missed, &gain * cross.transpose());
            for i in 0..N {
                let deviation = own.covariance[i][i].sqrt();
                let mean = own.mean[i] + shift[i];
                // Rounding, against what was open before the marks.
                assert!(
                    (found.mean[i] - mean).abs() <= 1e-9 * deviation,
                    "{time} {i}: {} {mean}",
                    found.mean[i]
                );
                for j in 0..N {
                    let covariance = own.covariance[i][j] - shrink[(i, j)];
                    let scale = deviation * own.covariance[j][j].sqrt();
                    assert!(
                        (found.covariance[i][j] - covariance).abs() <= 1e-9 * scale,
                        "{time} {i} {j}: {} {covariance}",
                        found.covariance[i][j]
                    );
                }
            }
        }
    }
}
