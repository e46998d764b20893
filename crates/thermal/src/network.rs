//! A network of bodies with uniform temperature, stepped exactly under constant powers.
//!
//! ```text
//!    C Ṫ = P + Σ G (T_other − T),    grounds at given temperatures
//! ```
//!
//! With y = Vᵀ C^½ T and the modes V of C^−½ G C^−½ every mode is alone: ẏ = p − λ y. A network without a ground has a
//! mode with λ = 0, which only stores. What flows to the grounds comes from the integral of the same y. A node that is held at
//! its temperature is a ground of its neighbours, and what reaches it is taken away.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// A conductance between two nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// The two nodes.
    pub nodes: [usize; 2],
    /// G, W/K.
    pub conductance: f64,
}

/// A conductance from a node to a given temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// The node.
    pub node: usize,
    /// G, W/K.
    pub conductance: f64,
    /// The temperature outside, in the scale of the nodes.
    pub temperature: f64,
}

/// C⁻¹ (grounds − G T): rate of change of the temperatures without powers, K/s.
pub fn relaxing(
    capacities: &[f64],
    links: &[Link],
    grounds: &[Ground],
    temperatures: &[f64],
) -> Vec<f64> {
    let mut rates = vec![0.0; capacities.len()];
    for link in links {
        let [a, b] = link.nodes;
        let flow = link.conductance * (temperatures[a] - temperatures[b]);
        rates[a] -= flow / capacities[a];
        rates[b] += flow / capacities[b];
    }
    for ground in grounds {
        let flow = ground.conductance * (temperatures[ground.node] - ground.temperature);
        rates[ground.node] -= flow / capacities[ground.node];
    }
    rates
}

/// Constants of a network: built once, shared by any number of states.
#[derive(Clone, Debug)]
pub struct Network {
    capacities: Vec<f64>,
    grounds: Vec<Ground>,
    /// Nodes that are held, each with its row of G.
    held: Vec<(usize, Vec<f64>)>,
    /// Decay rates λ of the modes, 1/s.
    rates: Vec<f64>,
    modes: DMatrix<f64>,
}

impl Network {
    /// A network of nodes with capacities in J/K; an error says which value makes none.
    pub fn new(capacities: &[f64], links: &[Link], grounds: &[Ground]) -> Result<Self, String> {
        Network::holding(capacities, links, grounds, &[])
    }

    /// The same with some nodes held at the temperature that they have, a mark for each node.
    pub fn holding(
        capacities: &[f64],
        links: &[Link],
        grounds: &[Ground],
        marks: &[bool],
    ) -> Result<Self, String> {
        let n = capacities.len();
        let positive = |value: f64| value > 0.0 && value.is_finite();
        if let Some(node) = capacities.iter().position(|&value| !positive(value)) {
            return Err(format!("the capacity of node {node} must be above 0 J/K"));
        }
        let conductances = links
            .iter()
            .map(|link| link.conductance)
            .chain(grounds.iter().map(|ground| ground.conductance));
        if let Some(at) = conductances
            .into_iter()
            .position(|value| !(value >= 0.0 && value.is_finite()))
        {
            return Err(format!(
                "conductance {at} (links, then grounds) must be 0 W/K or more"
            ));
        }
        let no_node = |at: usize| {
            format!("link or ground {at} needs nodes of the network, a link two different ones")
        };
        let mut matrix = DMatrix::<f64>::zeros(n, n);
        for (at, link) in links.iter().enumerate() {
            let [a, b] = link.nodes;
            if a >= n || b >= n || a == b {
                return Err(no_node(at));
            }
            matrix[(a, a)] += link.conductance;
            matrix[(b, b)] += link.conductance;
            matrix[(a, b)] -= link.conductance;
            matrix[(b, a)] -= link.conductance;
        }
        for (at, ground) in grounds.iter().enumerate() {
            if ground.node >= n {
                return Err(no_node(links.len() + at));
            }
            matrix[(ground.node, ground.node)] += ground.conductance;
        }
        let nodes = (0..n).filter(|node| marks.get(*node).is_some_and(|held| *held));
        let held: Vec<(usize, Vec<f64>)> = nodes
            .map(|node| (node, matrix.row(node).iter().copied().collect()))
            .collect();
        for (node, _) in &held {
            matrix.row_mut(*node).fill(0.0);
            matrix.column_mut(*node).fill(0.0);
        }
        let scaled = DMatrix::from_fn(n, n, |row, column| {
            matrix[(row, column)] / (capacities[row] * capacities[column]).sqrt()
        });
        let eigen = SymmetricEigen::new(scaled);
        let largest = eigen.eigenvalues.iter().fold(0.0, |a: f64, &b| a.max(b));
        // no conductance makes heat run uphill: what is below rounding is a mode that only stores
        let rates = eigen
            .eigenvalues
            .iter()
            .map(|&rate| if rate > 1e-14 * largest { rate } else { 0.0 })
            .collect();
        Ok(Self {
            capacities: capacities.to_vec(),
            grounds: grounds.to_vec(),
            held,
            rates,
            modes: eigen.eigenvectors,
        })
    }

    /// Capacity of a node, J/K.
    pub fn capacity(&self, node: usize) -> f64 {
        self.capacities[node]
    }

    /// −C⁻¹ G with the grounds: what the temperatures decay by, 1/s.
    pub fn decay(&self) -> DMatrix<f64> {
        let scale = |node: usize| self.capacities[node].sqrt();
        let n = self.capacities.len();
        DMatrix::from_fn(n, n, |row, column| {
            let modes = (0..n).map(|mode| {
                self.modes[(row, mode)] * self.rates[mode] * self.modes[(column, mode)]
            });
            -modes.sum::<f64>() * scale(column) / scale(row)
        })
    }

    /// Time constants 1/λ, s, shortest first; infinite for what only stores.
    pub fn time_constants(&self) -> Vec<f64> {
        let mut constants: Vec<f64> = self.rates.iter().map(|rate| 1.0 / rate).collect();
        constants.sort_by(f64::total_cmp);
        constants
    }

    /// Heat stored above zero of the scale: Σ C T, J.
    pub fn stored(&self, temperatures: &[f64]) -> f64 {
        self.capacities
            .iter()
            .zip(temperatures)
            .map(|(capacity, temperature)| capacity * temperature)
            .sum()
    }

    /// Temperatures that constant powers end at; `None` where a part of the network has no ground.
    pub fn steady(&self, powers: &[f64]) -> Option<Vec<f64>> {
        if self.rates.contains(&0.0) {
            return None;
        }
        let mut modal = self.modal(self.sources(powers));
        for (value, rate) in modal.iter_mut().zip(&self.rates) {
            *value /= rate;
        }
        Some(self.physical(&modal))
    }

    /// Advances the temperatures by a time under constant powers, W; returns the heat given to each ground, then that taken from
    /// each node that is held, J.
    ///
    /// Exact for any length of step: y₀e^(−λt) + p(1 − e^(−λt))/λ, for λ = 0 y₀ + pt.
    /// The lists have one number per node.
    pub fn advance(&self, temperatures: &mut [f64], powers: &[f64], time: f64) -> Vec<f64> {
        let n = self.capacities.len();
        assert!(
            temperatures.len() == n && powers.len() == n,
            "one temperature and one power per node"
        );
        let sources = self.sources(powers);
        let mut free = sources.clone();
        for (node, row) in &self.held {
            for (source, conductance) in free.iter_mut().zip(row) {
                *source -= conductance * temperatures[*node];
            }
        }
        for (node, _) in &self.held {
            free[*node] = 0.0;
        }
        let drive = self.modal(free);
        let kept: Vec<f64> = (self.held.iter())
            .map(|(node, _)| temperatures[*node])
            .collect();
        let scaled = DVector::from_fn(n, |i, _| temperatures[i] * self.capacities[i].sqrt());
        let mut modal = self.modes.tr_mul(&scaled);
        let mut integral = DVector::zeros(n);
        for i in 0..n {
            let (start, power, rate) = (modal[i], drive[i], self.rates[i]);
            let [first, second] = decay_integrals(rate, time);
            integral[i] = start * first + power * second;
            modal[i] = start + (power - rate * start) * first;
        }
        temperatures.copy_from_slice(&self.physical(&modal));
        let passed = self.physical(&integral);
        let to_grounds = self
            .grounds
            .iter()
            .map(|ground| ground.conductance * (passed[ground.node] - ground.temperature * time));
        let mut given: Vec<f64> = to_grounds.collect();
        for ((node, row), kept) in self.held.iter().zip(kept) {
            temperatures[*node] = kept;
            let away = row.iter().zip(&passed).map(|(g, passed)| g * passed);
            given.push(sources[*node] * time - away.sum::<f64>());
        }
        given
    }

    /// Heat given to the grounds or taken, as [`Self::advance`] returns it, by the nodes that give it.
    pub fn by_node(&self, given: &[f64]) -> Vec<f64> {
        let mut nodes = vec![0.0; self.capacities.len()];
        for (node, heat) in self.giving().zip(given) {
            nodes[node] += heat;
        }
        nodes
    }

    /// The node of each heat that [`Self::advance`] returns.
    pub fn giving(&self) -> impl Iterator<Item = usize> {
        let grounds = self.grounds.iter().map(|ground| ground.node);
        grounds.chain(self.held.iter().map(|(node, _)| *node))
    }

    /// Powers with what the grounds would give at zero of the scale, W.
    fn sources(&self, powers: &[f64]) -> DVector<f64> {
        let mut drive = DVector::from_column_slice(powers);
        for ground in &self.grounds {
            drive[ground.node] += ground.conductance * ground.temperature;
        }
        drive
    }

    fn modal(&self, mut drive: DVector<f64>) -> DVector<f64> {
        for (value, capacity) in drive.iter_mut().zip(&self.capacities) {
            *value /= capacity.sqrt();
        }
        self.modes.tr_mul(&drive)
    }

    fn physical(&self, modal: &DVector<f64>) -> Vec<f64> {
        let scaled = &self.modes * modal;
        scaled
            .iter()
            .zip(&self.capacities)
            .map(|(value, capacity)| value / capacity.sqrt())
            .collect()
    }
}

/// ∫₀^t e^(−λs) ds and ∫₀^t (t − s) e^(−λs) ds, without the differences of their closed forms where λt is small.
fn decay_integrals(rate: f64, time: f64) -> [f64; 2] {
    let x = rate * time;
    if x == 0.0 {
        return [time, 0.5 * time * time];
    }
    let first = -(-x).exp_m1() / rate;
    let second = if x < 0.1 {
        // Σ (−x)^k/(k+2)!
        let (mut term, mut sum) = (0.5, 0.0);
        for k in 0..14 {
            sum += term;
            term *= -x / f64::from(k + 3);
        }
        time * time * sum
    } else {
        (time - first) / rate
    };
    [first, second]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn links() -> Vec<Link> {
        [(0, 1, 0.15), (1, 2, 1.6), (2, 3, 1.8), (0, 3, 0.02)]
            .map(|(a, b, conductance)| Link {
                nodes: [a, b],
                conductance,
            })
            .to_vec()
    }
    const GROUND: Ground = Ground {
        node: 3,
        conductance: 0.9,
        temperature: 25.0,
    };
    const CAPACITIES: [f64; 4] = [600.0, 12.0, 4.8, 17.0];
    const POWERS: [f64; 4] = [3.0, 12.0, 0.0, 7.0];
    const START: [f64; 4] = [20.0, 90.0, 40.0, 30.0];

    fn close(ours: &[f64], other: &[f64], share: f64) {
        for (a, b) in ours.iter().zip(other) {
            assert!((a - b).abs() <= share * b.abs().max(1.0), "{a} {b}");
        }
    }

    #[test]
    fn heat_in_is_stored_or_given_away_with_and_without_a_ground() {
        for grounds in [vec![GROUND], vec![]] {
            let network = Network::new(&CAPACITIES, &links(), &grounds).unwrap();
            for time in [1e-6, 0.1, 10.0, 1e4] {
                let mut temperatures = START;
                let given = network.advance(&mut temperatures, &POWERS, time);
                let stored = network.stored(&temperatures) - network.stored(&START);
                let put_in = POWERS.iter().sum::<f64>() * time;
                let scale = network.stored(&temperatures) + put_in;
                let left = put_in - stored - given.iter().sum::<f64>();
                assert!(left.abs() < 1e-12 * scale, "{time}: {left}");
            }
        }
    }

    #[test]
    fn a_run_split_at_any_instant_equals_the_whole() {
        let network = Network::new(&CAPACITIES, &links(), &[GROUND]).unwrap();
        let mut whole = START;
        let heat = network.advance(&mut whole, &POWERS, 50.0);
        for split in [1e-3, 7.0, 49.9] {
            let mut parts = START;
            let first = network.advance(&mut parts, &POWERS, split);
            let second = network.advance(&mut parts, &POWERS, 50.0 - split);
            close(&parts, &whole, 1e-12);
            close(&[first[0] + second[0]], &heat, 1e-11);
        }
    }

    #[test]
    fn equal_temperatures_exchange_nothing() {
        let network = Network::new(&CAPACITIES, &links(), &[GROUND]).unwrap();
        let mut temperatures = [25.0; 4];
        let heat = network.advance(&mut temperatures, &[0.0; 4], 30.0);
        close(&temperatures, &[25.0; 4], 1e-13);
        assert!(heat[0].abs() < 1e-9);
    }

    #[test]
    fn heat_flows_downhill() {
        let network = Network::new(&CAPACITIES, &links(), &[]).unwrap();
        let mut temperatures = START;
        let (mut low, mut high) = (20.0, 90.0);
        for _ in 0..50 {
            network.advance(&mut temperatures, &[0.0; 4], 1.0);
            let coldest = temperatures.iter().copied().fold(f64::INFINITY, f64::min);
            let hottest = temperatures.iter().copied().fold(0.0, f64::max);
            assert!(coldest >= low - 1e-12 && hottest <= high + 1e-12);
            (low, high) = (coldest, hottest);
        }
        assert!(high < 60.0);
    }

    #[test]
    fn twice_the_capacities_take_twice_the_time() {
        let single = Network::new(&CAPACITIES, &links(), &[GROUND]).unwrap();
        let double = Network::new(&CAPACITIES.map(|c| 2.0 * c), &links(), &[GROUND]).unwrap();
        let (mut a, mut b) = (START, START);
        single.advance(&mut a, &POWERS, 20.0);
        double.advance(&mut b, &POWERS, 40.0);
        close(&a, &b, 1e-12);
        assert!(single.steady(&POWERS).is_some());
        close(
            &single.steady(&POWERS).unwrap(),
            &double.steady(&POWERS).unwrap(),
            1e-11,
        );
    }

    #[test]
    fn what_cannot_be_a_network_is_named() {
        let link = |nodes, conductance| Link { nodes, conductance };
        let error = |c: &[f64], l: &[Link]| Network::new(c, l, &[]).unwrap_err();
        assert!(error(&[1.0, 0.0], &[]).starts_with("the capacity of node 1 "));
        assert!(error(&[1.0, 1.0], &[link([0, 1], -1.0)]).starts_with("conductance 0 "));
        assert!(error(&[1.0], &[link([0, 1], 1.0)]).starts_with("link or ground 0 "));
    }
}
