//! A machine that warms at constant speed, and whether it runs away.
//!
//! ```text
//!   C Ṫ = P(T) − G T + grounds,   P from the losses at this speed
//! ```
//!
//! A step takes the powers of its start, then the mean of both ends (second order); the network answers exactly, so that
//! only the change of the powers limits its length. At an instant the eigenvalues of the whole, losses included, say what
//! comes next: a positive real part is a runaway, and its inverse the time in which it grows by e.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::losses::{Losses, moments, to_nodes};
use crate::network::Network;
use nalgebra::DMatrix;

/// Longest and shortest step, s.
const LONGEST: f64 = 1e5;
const SHORTEST: f64 = 1e-9;
/// Rate that is none, over the largest of the matrix: a bearing at rest has modes that only store.
const ROUNDING: f64 = 1e-12;
/// First step, s.
const FIRST: f64 = 1e-3;

/// Constants of a machine at constant speed.
#[derive(Clone, Debug)]
pub struct SteadySpeed<L> {
    /// Its network; of equal bearings it has one.
    pub network: Network,
    /// Its losses.
    pub losses: L,
    /// rad/s.
    pub speed: f64,
    /// Error of a step, K.
    pub tolerance: f64,
}

/// Its state.
#[derive(Clone, Debug, PartialEq)]
pub struct Warming {
    /// s.
    pub time: f64,
    /// Of the nodes, °C.
    pub temperatures: Vec<f64>,
    /// Heat made so far, J.
    pub made: f64,
    /// Heat given to the surroundings so far, J.
    pub given: f64,
    next: f64,
}

impl Warming {
    /// A start with the nodes at temperatures in °C.
    pub fn start(temperatures: Vec<f64>) -> Self {
        Warming {
            time: 0.0,
            temperatures,
            made: 0.0,
            given: 0.0,
            next: FIRST,
        }
    }
}

impl<L: Losses> SteadySpeed<L> {
    /// Powers of the nodes at temperatures, W.
    pub fn powers(&self, temperatures: &[f64]) -> Vec<f64> {
        let moments = moments(&self.losses, self.speed, temperatures);
        let powers: Vec<f64> = (moments.iter()).map(|moment| moment * self.speed).collect();
        to_nodes(&self.losses, &powers, temperatures.len())
    }

    /// Advances by one accepted step, at most to a time.
    pub fn step(&self, state: &mut Warming, until: f64) {
        loop {
            let most = until - state.time;
            let length = state.next.min(most);
            let (tried, error) = self.attempt(state, length);
            let grown = 0.9 * (self.tolerance / error).sqrt();
            if error > self.tolerance && length > SHORTEST {
                state.next = length * grown.clamp(0.1, 0.9);
                continue;
            }
            let next = match length < state.next {
                true => state.next,
                false => (length * grown.min(3.0)).min(LONGEST),
            };
            *state = tried;
            state.next = next;
            if length == most {
                state.time = until;
            }
            return;
        }
    }

    /// The state after a time that is short beside what the machine does, such as a part of a step that was accepted.
    pub fn after(&self, state: &Warming, length: f64) -> Warming {
        self.attempt(state, length).0
    }

    fn attempt(&self, state: &Warming, length: f64) -> (Warming, f64) {
        let first = self.powers(&state.temperatures);
        let mut predicted = state.temperatures.clone();
        self.network.advance(&mut predicted, &first, length);
        let last = self.powers(&predicted);
        let mean: Vec<f64> = first
            .iter()
            .zip(&last)
            .map(|(a, b)| 0.5 * (a + b))
            .collect();
        let mut next = state.clone();
        let given = self.network.advance(&mut next.temperatures, &mean, length);
        next.given += given.iter().sum::<f64>();
        next.made += mean.iter().sum::<f64>() * length;
        next.time += length;
        let apart = next.temperatures.iter().zip(&predicted);
        let error = apart.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // what is no number is no state
        let error = if error.is_finite() { error } else { f64::MAX };
        (next, error)
    }

    /// Largest real part of the eigenvalues of the Jacobian of conductances that are constants, C⁻¹(∂P/∂T − G), 1/s.
    pub fn growth(&self, temperatures: &[f64]) -> f64 {
        self.growth_of(temperatures, &|_| vec![0.0; temperatures.len()])
    }

    /// Largest real part of the eigenvalues of [`Self::jacobian`], 1/s: above 0 the machine runs away.
    pub fn growth_of(&self, temperatures: &[f64], relaxing: &dyn Fn(&[f64]) -> Vec<f64>) -> f64 {
        let matrix = self.jacobian(temperatures, relaxing);
        let n = temperatures.len();
        // a node that exchanges nothing with the others has no part in it
        let alone = |node: &usize| matrix.row(*node).iter().all(|rate| *rate == 0.0);
        let nodes: Vec<usize> = (0..n).filter(|node| !alone(node)).collect();
        if nodes.is_empty() {
            return 0.0;
        }
        let largest = largest_real_part(&matrix.select_rows(&nodes).select_columns(&nodes));
        match largest.abs() > ROUNDING * matrix.amax() {
            true => largest,
            false => 0.0,
        }
    }

    /// ∂Ṫ/∂T = C⁻¹(∂P/∂T − G − (∂G/∂T) T), 1/s: balls that are pressed harder conduct more, and so does a seat.
    ///
    /// - `relaxing`: C⁻¹(grounds − G T), K/s, with the conductances that the nodes have at other temperatures, T being those here
    pub fn jacobian(
        &self,
        temperatures: &[f64],
        relaxing: &dyn Fn(&[f64]) -> Vec<f64>,
    ) -> DMatrix<f64> {
        let n = temperatures.len();
        let mut matrix = self.network.decay();
        for column in 0..n {
            let delta = 1e-4 * (1.0 + temperatures[column].abs());
            let at = |sign: f64| {
                let mut moved = temperatures.to_vec();
                moved[column] += sign * delta;
                (self.powers(&moved), relaxing(&moved))
            };
            let (above, below) = (at(1.0), at(-1.0));
            for row in 0..n {
                let made = (above.0[row] - below.0[row]) / self.network.capacity(row);
                let passed = above.1[row] - below.1[row];
                matrix[(row, column)] += (made + passed) / (2.0 * delta);
            }
        }
        matrix
    }
}

fn largest_real_part(matrix: &DMatrix<f64>) -> f64 {
    let values = matrix.complex_eigenvalues();
    values
        .iter()
        .map(|value| value.re)
        .fold(f64::NEG_INFINITY, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::network::{Ground, relaxing};

    /// A heat that grows with temperature: P = p (1 + a (T − 25)) at 1 rad/s.
    #[derive(Clone, Copy)]
    struct Growing {
        power: f64,
        slope: f64,
    }

    impl Losses for Growing {
        fn count(&self) -> usize {
            1
        }
        fn moments(&self, _: f64, temperatures: &[f64], moments: &mut [f64]) {
            moments[0] = self.power * (1.0 + self.slope * (temperatures[0] - 25.0));
        }
        fn share(&self, _: usize, _: usize) -> f64 {
            1.0
        }
    }

    fn machine(slope: f64) -> SteadySpeed<Growing> {
        let ground = Ground {
            node: 0,
            conductance: 0.5,
            temperature: 25.0,
        };
        SteadySpeed {
            network: Network::new(&[10.0], &[], &[ground]).unwrap(),
            losses: Growing { power: 5.0, slope },
            speed: 1.0,
            tolerance: 1e-4,
        }
    }

    #[test]
    fn a_heat_that_grows_faster_than_it_is_taken_away_runs_away_at_its_rate() {
        // C Ṫ = p + (p a − G) y: λ = (p a − G)/C, y = p/(C λ) (e^(λt) − 1)
        for slope in [0.02, 0.14] {
            let machine = machine(slope);
            let lambda = (5.0 * slope - 0.5) / 10.0;
            assert!((machine.growth(&[25.0]) / lambda - 1.0).abs() < 1e-6);
            let mut state = Warming::start(vec![25.0]);
            while state.time < 60.0 {
                machine.step(&mut state, 60.0);
            }
            let exact = 5.0 / (10.0 * lambda) * ((lambda * 60.0).exp() - 1.0);
            let ours = state.temperatures[0] - 25.0;
            assert!((ours / exact - 1.0).abs() < 2e-4, "{slope}: {ours} {exact}");
            let stored = 10.0 * ours;
            assert!((state.made - stored - state.given).abs() < 1e-9 * state.made);
        }
    }

    #[test]
    fn a_way_that_closes_as_it_warms_runs_away() {
        // C Ṫ = p − G (1 − k (T − 25)) (T − 25): λ = −G (1 − 2 k y)/C, above 0 from y = 1/(2k) on
        let machine = machine(0.0);
        let at = |temperatures: &[f64]| Ground {
            node: 0,
            conductance: 0.5 * (1.0 - 0.02 * (temperatures[0] - 25.0)),
            temperature: 25.0,
        };
        for rise in [10.0, 24.0, 26.0, 40.0] {
            let temperatures = [25.0 + rise];
            let there = SteadySpeed {
                network: Network::new(&[10.0], &[], &[at(&temperatures)]).unwrap(),
                ..machine.clone()
            };
            let exact = -0.5 * (1.0 - 0.04 * rise) / 10.0;
            let relaxing = |moved: &[f64]| relaxing(&[10.0], &[], &[at(moved)], &temperatures);
            let found = there.growth_of(&temperatures, &relaxing);
            assert!((found / exact - 1.0).abs() < 1e-6, "{found} {exact}");
            // held, it would never
            assert!(there.growth(&temperatures) < 0.0);
        }
    }

    #[test]
    fn a_heat_that_does_not_change_needs_no_small_steps() {
        let machine = machine(0.0);
        let mut state = Warming::start(vec![25.0]);
        let mut steps = 0;
        while state.time < 1e4 {
            machine.step(&mut state, 1e4);
            steps += 1;
        }
        assert!(steps < 20, "{steps}");
        assert!((state.temperatures[0] - 35.0).abs() < 1e-9);
    }
}
