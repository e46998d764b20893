//! Nodes that are held at their limits from the moment they get there, and the heat that must be taken from them for it.
//!
//! ```text
//!   Q̇_need = P + Σ G (T_other − T_limit)          all other heats into the node
//! ```
//! What carries a node over its limit within a step is taken at its end; a node whose other heats no longer hold it up is free
//! again. A node that never gets there needs nothing.
//!
//! Source: derived; book/src/theory/heat.md.

/// Limits, and which nodes are held at them.
#[derive(Clone, Debug, PartialEq)]
pub struct Held {
    limits: Vec<Option<f64>>,
    marks: Vec<bool>,
}

impl Held {
    /// Nothing held yet; limits in the scale of the nodes.
    pub fn at(limits: Vec<Option<f64>>) -> Self {
        let marks = vec![false; limits.len()];
        Held { limits, marks }
    }

    /// Those of several bearings as one, their nodes behind each other.
    pub fn together<'a>(all: impl IntoIterator<Item = &'a Held>) -> Self {
        let mut whole = Held::at(Vec::new());
        for own in all {
            whole.limits.extend(&own.limits);
            whole.marks.extend(&own.marks);
        }
        whole
    }

    /// Which nodes are held: as [`Network::holding`](crate::network::Network::holding) asks.
    pub fn marks(&self) -> &[bool] {
        &self.marks
    }

    /// Holds what is above its limit, as if it had been held until now.
    pub fn begin(&mut self, temperatures: &mut [f64]) {
        let nodes = temperatures.iter_mut().zip(&self.limits);
        for ((now, limit), mark) in nodes.zip(&mut self.marks) {
            if let Some(limit) = limit.filter(|limit| *now > *limit) {
                (*now, *mark) = (limit, true);
            }
        }
    }

    /// Ends a step: what was taken from each node in it, J, where so much heat has reached those that were held.
    pub fn end(
        &mut self,
        capacities: &[f64],
        temperatures: &mut [f64],
        reached: &[f64],
    ) -> Vec<f64> {
        let mut taken = vec![0.0; self.limits.len()];
        for (node, limit) in self.limits.iter().enumerate() {
            let Some(limit) = *limit else { continue };
            let was = self.marks[node];
            let heat = match was {
                true => reached[node],
                false => capacities[node] * (temperatures[node] - limit),
            };
            self.marks[node] = heat > 0.0;
            if heat > 0.0 {
                (temperatures[node], taken[node]) = (limit, heat);
            } else if was {
                temperatures[node] = limit + heat / capacities[node];
            }
        }
        taken
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::network::{Ground, Link, Network};

    const CAPACITIES: [f64; 2] = [4.0, 9.0];
    const LINK: Link = Link {
        nodes: [0, 1],
        conductance: 0.6,
    };
    const GROUND: Ground = Ground {
        node: 1,
        conductance: 0.2,
        temperature: 20.0,
    };

    /// Heat taken from the first node by steps of one length, and how warm both are, under 12 W until a time and none after it.
    fn run(step: f64, off: f64, end: f64) -> (f64, [f64; 2], f64) {
        let mut held = Held::at(vec![Some(50.0), None]);
        let mut temperatures = [20.0; 2];
        let (mut taken, mut given, mut most) = (0.0, 0.0, 0.0f64);
        let steps = (end / step).round() as usize;
        for k in 0..steps {
            let network = Network::holding(&CAPACITIES, &[LINK], &[GROUND], held.marks()).unwrap();
            let powers = [if step * (k as f64) < off { 12.0 } else { 0.0 }, 0.0];
            let away = network.advance(&mut temperatures, &powers, step);
            given += away[0];
            let reached = network.by_node(&away);
            let now = held.end(&CAPACITIES, &mut temperatures, &reached)[0];
            taken += now;
            most = most.max(now / step);
        }
        let stored =
            CAPACITIES[0] * (temperatures[0] - 20.0) + CAPACITIES[1] * (temperatures[1] - 20.0);
        let left = 12.0 * off - stored - given - taken;
        assert!(left.abs() < 1e-9, "{left}");
        (taken, temperatures, most)
    }

    #[test]
    fn what_must_be_taken_is_all_other_heat_into_the_node_in_closed_form() {
        // held from the start: the second node warms to (G T_limit + G_a T_a)/(G + G_a) with C/(G + G_a)
        let mut held = Held::at(vec![Some(50.0), None]);
        let mut temperatures = [60.0, 20.0];
        held.begin(&mut temperatures);
        let network = Network::holding(&CAPACITIES, &[LINK], &[GROUND], held.marks()).unwrap();
        let away = network.advance(&mut temperatures, &[25.0, 0.0], 7.0);
        let (end, rate) = (42.5, 0.8 / 9.0);
        let gone = (-rate * 7.0f64).exp();
        let warm = end + (20.0 - end) * gone;
        assert!((temperatures[1] / warm - 1.0).abs() < 1e-12);
        assert_eq!(temperatures[0], 50.0);
        let mean = end + (20.0 - end) * (1.0 - gone) / (rate * 7.0);
        let need = 7.0 * (25.0 - 0.6 * (50.0 - mean));
        let taken = held.end(&CAPACITIES, &mut temperatures, &network.by_node(&away));
        assert!((taken[0] / need - 1.0).abs() < 1e-11, "{} {need}", taken[0]);
    }

    #[test]
    fn steps_of_any_length_take_nearly_alike_and_energy_closes() {
        let (fine, at_end, most) = run(0.01, 60.0, 100.0);
        let (coarse, _, _) = run(1.0, 60.0, 100.0);
        assert!((coarse / fine - 1.0).abs() < 0.01, "{coarse} {fine}");
        // never more than all that is made; it cools once nothing is made
        assert!(most < 12.0 && at_end[0] < 50.0);
    }

    #[test]
    fn a_node_below_its_limit_needs_nothing() {
        assert_eq!(run(0.1, 5.0, 20.0).0, 0.0);
    }
}
