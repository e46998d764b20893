//! Filter and smoother for given times, noises and knots.
//!
//! ```text
//! state  x = [angle, speed, acceleration, jerk, e]   white noise of the density q in the snap
//! e      of pulses: error of the instants with a memory, a first-order Markov process; of a speed channel: what its instrument
//!        shows of the speed, ė = (speed - e)/τ
//! pulse  z = angle + speed e + noise of variance r;   channel  z = e + noise, or speed + noise where the instrument has no lag
//! knot   variance added to any state at an instant: what it is after follows less, or not at all, from what it was before
//! ```
//! Forward: a Kalman filter. Backward: the adjoint recursion of Bryson and Frazier, which inverts no matrix, so that a
//! start from rest with exactly known speed, and intervals of any length, do no harm.
//!
//! Source: Bierman, Factorization Methods for Discrete Sequential Estimation, 1977, chapter X (from memory).
#![allow(clippy::needless_range_loop)] // rows and columns by number read like the formula

use super::matrix::{
    Matrix, Memory, N, Vector, advance, carry, drift, gathered, minus, plus, taken_back,
};
use super::node::{Belief, Node};
use crate::state_space::{applied, product, seen_back, transposed};

/// A filtered and smoothed record.
#[derive(Clone, Debug)]
pub(super) struct Track {
    nodes: Vec<Node>,
    times: Vec<f64>,
    start: Belief,
    /// After each node.
    filtered: Vec<Belief>,
    /// Adjoint just before each node: gradient and curvature of the misfit of all that follows.
    gradient: Vec<Vector>,
    curvature: Vec<Matrix>,
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

/// Nodes behind one at which nearly nothing is known, after which numbers are sound.
const OPENING: usize = 4;

impl Track {
    pub fn new(nodes: Vec<Node>, start: Belief, density: f64, memory: Memory) -> Track {
        let mut filtered = Vec::with_capacity(nodes.len());
        let mut updates: Vec<Update> = Vec::with_capacity(nodes.len());
        forward(&nodes, &start, &[0.0; N], &memory, |belief, update| {
            filtered.push(*belief);
            updates.push(*update);
        });
        let mut gradient = vec![[0.0; N]; nodes.len()];
        let mut curvature = vec![[[0.0; N]; N]; nodes.len()];
        let (mut g, mut c) = ([0.0; N], [[0.0; N]; N]);
        for k in (0..nodes.len()).rev() {
            if let Some(pulse) = &nodes[k].pulse {
                let Update {
                    gain,
                    pull,
                    stiffness,
                } = updates[k];
                seen_back(&mut g, &mut c, &pulse.row, &gain, (pull, stiffness));
            }
            if nodes[k].fresh.is_some() {
                (g, c) = ([0.0; N], [[0.0; N]; N]);
            }
            gradient[k] = g;
            curvature[k] = c;
            if k > 0 {
                taken_back(&mut g, &mut c, nodes[k].time - nodes[k - 1].time, &memory);
            }
        }
        let times = nodes.iter().map(|node| node.time).collect();
        Track {
            nodes,
            times,
            start,
            filtered,
            gradient,
            curvature,
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
            && self.gradient.iter().flatten().all(|x| x.is_finite())
            && self.curvature.iter().all(sound)
    }

    /// Filtered belief carried to an instant, and the adjoint there.
    fn around(&self, time: f64) -> (Belief, Vector, Matrix) {
        let next = self.times.partition_point(|&t| t <= time);
        let Some(last) = next.checked_sub(1) else {
            return (self.start, [0.0; N], [[0.0; N]; N]);
        };
        let dt = time - self.nodes[last].time;
        let density = self
            .nodes
            .get(next)
            .map_or(self.density, |node| node.density);
        let mut belief = self.filtered[last];
        advance(
            &mut belief.mean,
            &mut belief.covariance,
            dt,
            density,
            &self.memory,
        );
        match self.nodes.get(next) {
            None => (belief, [0.0; N], [[0.0; N]; N]),
            Some(node) => {
                let (mut g, mut c) = (self.gradient[next], self.curvature[next]);
                taken_back(&mut g, &mut c, node.time - time, &self.memory);
                (belief, g, c)
            }
        }
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

    /// The instant by which some pulses have passed since nearly nothing was known, where an instant lies before it.
    fn settled(&self, time: f64) -> Option<f64> {
        let now = self.times.partition_point(|&t| t <= time).checked_sub(1)?;
        let open = |k: usize| self.nodes[k].fresh.is_some() || (k == 0 && !self.rests());
        let begin = (now.saturating_sub(OPENING)..=now)
            .rev()
            .find(|&k| open(k))?;
        let settled = self.nodes[(begin + OPENING).min(self.nodes.len() - 1)].time;
        (time < settled).then_some(settled)
    }

    /// Belief at an instant not before the first node.
    ///
    /// Among the first pulses what was open and what they show nearly cancel: there the motion is no better known than behind them.
    fn within(&self, time: f64) -> Belief {
        let mut belief = self.smoothed(time);
        if let Some(settled) = self.settled(time) {
            let behind = self.smoothed(settled).covariance;
            for (i, row) in belief.covariance.iter_mut().enumerate() {
                row[i] = row[i].max(behind[i][i]);
            }
        }
        belief
    }

    fn smoothed(&self, time: f64) -> Belief {
        let (belief, gradient, curvature) = self.around(time);
        let p = &belief.covariance;
        let shift = applied(p, &gradient);
        let shrink = product(p, &product(&curvature, p));
        Belief {
            mean: std::array::from_fn(|i| belief.mean[i] - shift[i]),
            covariance: minus(p, &shrink),
        }
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
    use super::super::node::Sight;
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
        nodes[3].added = Some([0.0, 0.0, 0.5, 0.5]);
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
