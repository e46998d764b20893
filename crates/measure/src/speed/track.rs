//! Filter and smoother for given times, noises and knots.
//!
//! ```text
//! state  x = [angle, speed, acceleration, jerk, e]   white noise of the density q in the snap
//! e      of pulses: error of the instants with a memory, a first-order Markov process; of a speed channel: what its instrument
//!        shows of the speed, ė = (speed - e)/τ
//! pulse  z = angle + speed e + noise of variance r;   channel  z = e + noise, or speed + noise where the instrument has no lag
//! knot   variance added to any state at an instant: what it was before tells less, or nothing, of what it is after
//! ```
//! Forward: a Kalman filter. Backward: the adjoint recursion of Bryson and Frazier, which inverts no matrix, so that a
//! start from rest with exactly known speed, and intervals of any length, do no harm.
//!
//! Source: Bierman, Factorization Methods for Discrete Sequential Estimation, 1977, chapter X (from memory).
#![allow(clippy::needless_range_loop)] // rows and columns by number read like the formula

use super::matrix::{
    Matrix, Memory, N, Vector, advance, carry, drift, gathered, minus, plus, root, taken_back,
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
    updates: Vec<Update>,
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

/// What a pass forward tells of the start.
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
            updates,
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
    /// Among the first pulses what was open and what they tell nearly cancel: there the motion is no better known than behind them.
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

    /// Covariance of the states at two instants, the first one not after the second, from all pulses.
    pub fn between(&self, first: f64, second: f64) -> Matrix {
        let begin = self.begin();
        if first >= begin {
            return self.between_within(first, second);
        }
        if self.rests() {
            // The angle at rest is the one at the start.
            let both = self.between_within(begin, second.max(begin));
            return std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    let moves = i == 0 && (j == 0 || second >= begin);
                    if moves { both[i][j] } else { 0.0 }
                })
            });
        }
        if second < begin {
            return product(&self.back(first - second), &self.at(second).covariance);
        }
        product(
            &self.back(first - begin),
            &self.between_within(begin, second),
        )
    }

    /// The same for instants not before the first node.
    fn between_within(&self, first: f64, second: f64) -> Matrix {
        let (from, _, _) = self.around(first);
        let (to, _, curvature) = self.around(second);
        // How an error at the first instant is carried through forecasts and updates to the second.
        let mut carried = drift(0.0, &self.memory);
        let mut time = first;
        let mut k = self.times.partition_point(|&t| t <= first);
        while k < self.nodes.len() && self.nodes[k].time <= second {
            carried = product(&drift(self.nodes[k].time - time, &self.memory), &carried);
            time = self.nodes[k].time;
            if self.nodes[k].fresh.is_some() {
                carried = [[0.0; N]; N];
            }
            if let Some(pulse) = &self.nodes[k].pulse {
                let gain = self.updates[k].gain;
                let row = applied(&transposed(&carried), &pulse.row);
                for i in 0..N {
                    for j in 0..N {
                        carried[i][j] -= gain[i] * row[j];
                    }
                }
            }
            k += 1;
        }
        carried = product(&drift(second - time, &self.memory), &carried);
        let ahead = product(&from.covariance, &transposed(&carried));
        let seen = product(&curvature, &to.covariance);
        minus(&ahead, &product(&ahead, &seen))
    }

    /// A path drawn at random from the belief, at increasing instants.
    ///
    /// A motion and its pulses are made up from the model and smoothed like the measured ones; their error is added to the
    /// smoothed measurement. Source: Durbin and Koopman, Biometrika 89, 2002 (from memory).
    pub fn draw(&self, times: &[f64], normal: &mut dyn FnMut() -> f64) -> Vec<Vector> {
        let mut shake = |p: &Matrix| -> Vector {
            let noise: Vector = std::array::from_fn(|_| normal());
            applied(&root(p), &noise)
        };
        let moved = shake(&self.start.covariance);
        let mut x: Vector = std::array::from_fn(|i| self.start.mean[i] + moved[i]);
        let mut made = self.nodes.clone();
        let mut time = self.begin();
        let (early, late) = times.split_at(times.partition_point(|t| *t < time));
        let mut path = vec![[0.0; N]; early.len()];
        let (mut later, mut before) = (x, time);
        for (state, &t) in path.iter_mut().zip(early).rev() {
            if self.rests() {
                state[0] = x[0];
                continue;
            }
            let noise = shake(&self.lost(before - t));
            let free = applied(&self.back(t - before), &later);
            *state = std::array::from_fn(|i| free[i] + noise[i]);
            (later, before) = (*state, t);
        }
        let step =
            |x: &mut Vector, dt: f64, density: f64, shake: &mut dyn FnMut(&Matrix) -> Vector| {
                if dt > 0.0 {
                    let noise = shake(&gathered(dt, density, &self.memory));
                    let free = applied(&drift(dt, &self.memory), x);
                    *x = std::array::from_fn(|i| free[i] + noise[i]);
                }
            };
        let mut wanted = late.iter().peekable();
        for node in &mut made {
            while let Some(&&t) = wanted.peek()
                && t < node.time
            {
                step(&mut x, t - time, node.density, &mut shake);
                time = time.max(t);
                path.push(x);
                wanted.next();
            }
            step(&mut x, node.time - time, node.density, &mut shake);
            time = node.time;
            if let Some(added) = node.added {
                let noise = shake(&std::array::from_fn(|i| {
                    std::array::from_fn(|j| if i == j && i < 4 { added[i] } else { 0.0 })
                }));
                x = std::array::from_fn(|i| x[i] + noise[i]);
            }
            if let Some(fresh) = &node.fresh {
                let belief = fresh.belief(&self.memory);
                let noise = shake(&belief.covariance);
                x = std::array::from_fn(|i| belief.mean[i] + noise[i]);
            }
            if let Some(pulse) = &mut node.pulse {
                let mut only = [[0.0; N]; N];
                only[0][0] = pulse.variance;
                pulse.value = pulse.of(&x) + shake(&only)[0];
            }
        }
        for &t in wanted {
            step(&mut x, t - time, self.density, &mut shake);
            time = time.max(t);
            path.push(x);
        }
        let again = Track::new(made, self.start, self.density, self.memory);
        times
            .iter()
            .zip(path)
            .map(|(&t, made)| {
                let (measured, estimated) = (self.at(t).mean, again.at(t).mean);
                std::array::from_fn(|i| measured[i] + made[i] - estimated[i])
            })
            .collect()
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
}
