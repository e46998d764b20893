//! Filter and smoother for given times, noises and knots.
//!
//! ```text
//! state  x = [angle, speed, acceleration, jerk, e]   white noise of the density q in the snap
//! e      of pulses: error of the instants with a memory, a first-order Markov process; of a speed channel: what its instrument
//!        shows of the speed, ė = (speed - e)/τ
//! pulse  z = angle + speed e + noise of variance r;   channel  z = e + noise, or speed + noise where the instrument has no lag
//! knot   variance added to any state at an instant: what it is after follows less, or not at all, from what it was before
//! ```

use super::node::Node;
use super::transition::{Belief, Matrix, Memory, N, Vector, step};
use crate::state_space::{Filter, Smoother};

/// A filtered and smoothed record.
#[derive(Clone, Debug)]
pub(super) struct Track {
    smoother: Smoother<N>,
    times: Vec<f64>,
    /// Density of the snap before each node, and after the last one.
    densities: Vec<f64>,
    /// The smoother's step that leads to each node, and the one behind the last.
    steps: Vec<usize>,
    /// Whether the shaft rests before the first node: a start from rest is the one whose speed is known.
    rests: bool,
    memory: Memory,
}

/// A pass forward over some nodes; `direction` is that of the derivatives, `visit` sees the number of steps before each node.
pub(super) fn filtered(
    nodes: &[Node],
    start: &Belief,
    direction: Vector,
    memory: &Memory,
    keep: bool,
    mut visit: impl FnMut(usize),
) -> Filter<N> {
    let mut filter = Filter::new(*start, keep).along(direction);
    let mut time = nodes.first().map_or(0.0, |node| node.time);
    for node in nodes {
        visit(filter.steps());
        let (transition, noise) = step(node.time - time, node.density, memory);
        filter.predict(&transition, &noise);
        time = node.time;
        if let Some(added) = &node.added {
            filter.predict(&Matrix::identity(), &Matrix::from_diagonal(added));
        }
        if let Some(fresh) = &node.fresh {
            filter.restart(fresh);
        }
        filter.observe(node.pulse.as_ref());
    }
    filter
}

impl Track {
    pub fn new(nodes: &[Node], start: &Belief, density: f64, memory: Memory) -> Track {
        let mut steps = Vec::with_capacity(nodes.len() + 1);
        let filter = filtered(nodes, start, Vector::zeros(), &memory, true, |step| {
            steps.push(step);
        });
        steps.push(filter.steps());
        let densities = nodes.iter().map(|node| node.density);
        Track {
            smoother: filter.smoother(),
            times: nodes.iter().map(|node| node.time).collect(),
            densities: densities.chain([density]).collect(),
            steps,
            rests: start.covariance[(1, 1)] <= 0.0,
            memory,
        }
    }

    pub fn begin(&self) -> f64 {
        self.times.first().copied().unwrap_or(0.0)
    }

    pub fn end(&self) -> f64 {
        self.times.last().copied().unwrap_or(0.0)
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        self.times.iter().all(|t| t.is_finite()) && self.smoother.is_finite()
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
        if self.rests {
            let mut still = Belief {
                mean: Vector::zeros(),
                covariance: Matrix::zeros(),
            };
            still.mean[0] = first.mean[0];
            still.covariance[(0, 0)] = first.covariance[(0, 0)];
            return still;
        }
        // The error of the instants plays no part there; neighbouring derivatives err against each other, seen from the end.
        let memory = Memory::of_clock(self.memory.spread, 0.0);
        let (path, _) = step(time - begin, 0.0, &memory);
        let (_, gathered) = step(begin - time, self.densities[0], &memory);
        let signs = Matrix::from_fn(|i, j| if (i + j) % 2 == 0 { 1.0 } else { -1.0 });
        Belief {
            mean: path * first.mean,
            covariance: path * first.covariance * path.transpose() + gathered.component_mul(&signs),
        }
    }

    /// Belief at an instant not before the first node.
    fn within(&self, time: f64) -> Belief {
        let next = self.times.partition_point(|&t| t <= time);
        let part = |from: f64, to: f64| step(to - from, self.densities[next], &self.memory);
        let last = next.checked_sub(1).map_or(time, |last| self.times[last]);
        let (before, left) = (
            part(last, time),
            part(time, self.times.get(next).copied().unwrap_or(time)),
        );
        (self.smoother).within(self.steps[next], (&before.0, &before.1), (&left.0, &left.1))
    }
}

/// Mixture of beliefs.
pub(super) fn mixed(parts: impl Iterator<Item = (f64, Belief)> + Clone) -> Belief {
    let mean: Vector = parts
        .clone()
        .map(|(weight, belief)| weight * belief.mean)
        .sum();
    let covariances = parts.map(|(weight, belief)| {
        let away = belief.mean - mean;
        weight * (belief.covariance + away * away.transpose())
    });
    Belief {
        mean,
        covariance: covariances.sum(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::node::mark;
    use super::super::transition::Observation;
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
                    pulse: Some(mark(0.5 * time * time + error, 1e-4, time)),
                    added: None,
                    fresh: None,
                }
            })
            .collect()
    }

    fn start(acceleration: f64) -> Belief {
        let variances = Vector::from([0.01, 0.0, 0.3, 0.1, 1e-4]);
        Belief {
            mean: Vector::from([0.0, 0.0, acceleration, 0.0, 0.0]),
            covariance: Matrix::from_diagonal(&variances),
        }
    }

    fn pass(start: &Belief) -> Filter<N> {
        let acceleration = Vector::from([0.0, 0.0, 1.0, 0.0, 0.0]);
        filtered(&marks(), start, acceleration, &MEMORY, false, |_| ())
    }

    const MEMORY: Memory = Memory::of_clock(1e-2, 0.5);

    #[test]
    fn derivatives_along_a_direction_are_those_of_the_likelihood() {
        let pass = |a: f64| pass(&start(a));
        // The likelihood is a parabola of the mean: finite differences of any width are exact.
        let (below, here, above) = (pass(-0.5), pass(0.0), pass(0.5));
        let [low, middle, high] = [&below, &here, &above].map(Filter::log_likelihood);
        let found = here.derivatives();
        let wanted = (high - low, -4.0 * (high - 2.0 * middle + low));
        assert!(
            (found.0 / wanted.0 - 1.0).abs() < 1e-9,
            "{found:?} {wanted:?}"
        );
        assert!(
            (found.1 / wanted.1 - 1.0).abs() < 1e-9,
            "{found:?} {wanted:?}"
        );
    }

    #[test]
    fn they_give_the_start_that_the_smoother_finds() {
        let (slope, curvature) = pass(&start(0.0)).derivatives();
        let track = Track::new(&marks(), &start(0.0), 0.05, MEMORY);
        // A track starts at its first node.
        let first = track.at(track.begin());
        let variance: f64 = 0.3;
        let found = variance * slope;
        let left = variance - variance * variance * curvature;
        assert!((found - first.mean[2]).abs() < 1e-9, "{found} {first:?}");
        assert!((left - first.covariance[(2, 2)]).abs() < 1e-9, "{left}");
    }

    /// Of angles of marks `z` and a state `x(t)` that are normal together the state given the marks has the mean
    /// `E x + C S⁻¹ (z - E z)` and the covariance `P - C S⁻¹ Cᵀ`, with C and S from `P(t₁) F(t₂ - t₁)ᵀ` between two instants.
    #[test]
    fn the_smoother_finds_the_conditional_normal_law() {
        let mut nodes = marks();
        nodes[3].added = Some(Vector::from([0.0, 0.0, 0.5, 0.5, 0.0]));
        let track = Track::new(&nodes, &start(0.5), 0.05, MEMORY);
        let unseen = |time: f64| {
            let (mut belief, mut now) = (start(0.5), nodes[0].time);
            let mut to = |belief: &mut Belief, time: f64| {
                let (path, noise) = step(time - now, 0.05, &MEMORY);
                belief.mean = path * belief.mean;
                belief.covariance = path * belief.covariance * path.transpose() + noise;
                now = time;
            };
            for node in nodes.iter().filter(|node| node.time <= time) {
                to(&mut belief, node.time);
                belief.covariance += node
                    .added
                    .map_or(Matrix::zeros(), |a| Matrix::from_diagonal(&a));
            }
            to(&mut belief, time);
            belief
        };
        let between = |a: f64, b: f64| {
            let (path, _) = step((b - a).abs(), 0.0, &MEMORY);
            let forward = unseen(a.min(b)).covariance * path.transpose();
            if a > b { forward.transpose() } else { forward }
        };
        let seen: Vec<(f64, Observation)> = (nodes.iter())
            .filter_map(|node| Some((node.time, node.pulse?)))
            .collect();
        let n = seen.len();
        let spread = DMatrix::from_fn(n, n, |i, j| {
            let both = between(seen[i].0, seen[j].0);
            let noise = if i == j { seen[i].1.variance } else { 0.0 };
            seen[i].1.row.dot(&(both * seen[j].1.row)) + noise
        });
        let inverse = spread.try_inverse().expect("a covariance");
        let missed = DVector::from_fn(n, |i, _| {
            seen[i].1.value - seen[i].1.row.dot(&unseen(seen[i].0).mean)
        });
        for time in [0.4, 0.5, 1.6, 2.7, 4.0, 4.3] {
            let (found, own) = (track.at(time), unseen(time));
            let cross = DMatrix::from_fn(N, n, |state, i| {
                (between(time, seen[i].0) * seen[i].1.row)[state]
            });
            let gain = &cross * &inverse;
            let (shift, shrink) = (&gain * &missed, &gain * cross.transpose());
            for i in 0..N {
                let deviation = own.covariance[(i, i)].sqrt();
                let mean = own.mean[i] + shift[i];
                // Rounding, against what was open before the marks.
                assert!(
                    (found.mean[i] - mean).abs() <= 1e-9 * deviation,
                    "{time} {i}: {} {mean}",
                    found.mean[i]
                );
                for j in 0..N {
                    let covariance = own.covariance[(i, j)] - shrink[(i, j)];
                    let scale = deviation * own.covariance[(j, j)].sqrt();
                    assert!(
                        (found.covariance[(i, j)] - covariance).abs() <= 1e-9 * scale,
                        "{time} {i} {j}: {} {covariance}",
                        found.covariance[(i, j)]
                    );
                }
            }
        }
    }
}
