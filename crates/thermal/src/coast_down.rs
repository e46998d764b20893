//! A rotor that coasts down on warm bearings, from full speed to a stop, in steps of its speed.
//!
//! ```text
//!   I ω̇ = −Σ M_l(ω, T)          each loss l brakes, and its heat warms the nodes of a network by its shares
//!
//!   step to ω' = r ω:   dt = I ln(1/r) · ½ (ω/M + ω'/M')           the stop is then no event
//!   heat of the step  = ½ I (ω² − ω'²), over the losses by the trapezoid of their powers
//! ```
//!
//! All kinetic energy lost becomes heat of a loss at any step length, and the network takes it exactly: the ledger closes
//! to rounding. The error of a step is its distance to a step with the moments and powers of its start alone, in time (over
//! the time so far and the coast-down I ω/M still to come) and in temperature (over 50 K).
//!
//! Of bearings that are equal one has a network: the moments are those of the whole machine, and each of them takes its part of
//! the heat.
//!
//! Not here: what the rotor does meanwhile. Whirl, lost contact and passing resonances need a run in motion.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::losses::{Losses, moments, to_nodes};
use crate::network::Network;

/// First ln(1/r).
const FIRST: f64 = 1e-4;
/// Largest growth of ln(1/r) from a step to the next.
const GROWTH: f64 = 3.0;
/// Temperature that counts as an error of 1, K.
pub const TEMPERATURE_SCALE: f64 = 50.0;
/// Most steps of a coast-down.
const MOST_STEPS: usize = 50_000;

/// Constants of a coast-down.
#[derive(Clone, Debug)]
pub struct CoastDown<L> {
    /// The network; of equal bearings it has one.
    pub network: Network,
    /// Losses of the whole machine.
    pub losses: L,
    /// Moment of inertia about the axis, kg m².
    pub inertia: f64,
    /// Error that a step may have; 0.002 is 0.2 % of the stop time and a third of a kelvin.
    pub tolerance: f64,
}

/// The state of a coast-down.
#[derive(Clone, Debug, PartialEq)]
pub struct Coasting {
    /// s.
    pub time: f64,
    /// rad/s.
    pub speed: f64,
    /// Of the nodes, °C.
    pub temperatures: Vec<f64>,
    /// Heat of each loss so far, J.
    pub heats: Vec<f64>,
    /// Heat given to the surroundings of all bearings so far, J.
    pub given: f64,
    /// The same by nodes.
    pub at_nodes: AtNodes,
    /// Steps so far.
    pub steps: usize,
    /// ln(1/r) of the next step.
    next: f64,
}

/// Heats of the nodes of all equal bearings, J.
#[derive(Clone, Debug, PartialEq)]
pub struct AtNodes {
    /// Made in each.
    pub made: Vec<f64>,
    /// Given by each to the surroundings.
    pub given: Vec<f64>,
}

impl AtNodes {
    /// Nothing yet, of so many nodes.
    pub fn none(nodes: usize) -> Self {
        AtNodes {
            made: vec![0.0; nodes],
            given: vec![0.0; nodes],
        }
    }

    /// Adds what the nodes of so many bearings each make, J, and give to the grounds, J.
    fn add(&mut self, made: &[f64], given: &[f64], planes: &dyn Fn(usize) -> f64) {
        for (node, (made, given)) in made.iter().zip(given).enumerate() {
            self.made[node] += planes(node) * made;
            self.given[node] += planes(node) * given;
        }
    }
}

/// Why a coast-down does not end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Endless {
    /// Nothing brakes at this speed, rad/s.
    NothingBrakes(f64),
    /// More steps than a coast-down may have.
    Steps,
}

/// One step tried.
struct Attempt {
    state: Coasting,
    error: f64,
}

impl Coasting {
    /// A start at a speed in rad/s, with the nodes at temperatures in °C.
    pub fn start(speed: f64, temperatures: Vec<f64>, losses: &impl Losses) -> Self {
        Coasting::at(0.0, speed, temperatures, losses)
    }

    /// The same at a time in s, after another part of a run.
    pub fn at(time: f64, speed: f64, temperatures: Vec<f64>, losses: &impl Losses) -> Self {
        Coasting {
            time,
            speed,
            at_nodes: AtNodes::none(temperatures.len()),
            temperatures,
            heats: vec![0.0; losses.count()],
            given: 0.0,
            steps: 0,
            next: FIRST,
        }
    }
}

impl<L: Losses> CoastDown<L> {
    /// Advances by one accepted step, at most to a speed (rad/s, above 0) and to a time.
    pub fn step(&self, state: &mut Coasting, stop: f64, until: f64) -> Result<(), Endless> {
        if state.steps >= MOST_STEPS {
            return Err(Endless::Steps);
        }
        let most = (state.speed / stop).ln();
        loop {
            let wanted = state.next.min(most);
            let tried = self.attempt(state, wanted)?;
            let grown = 0.9 * (self.tolerance / tried.error).sqrt();
            if tried.error > self.tolerance {
                state.next = wanted * grown.min(0.9);
                continue;
            }
            let next = match wanted < state.next {
                true => state.next,
                false => wanted * grown.min(GROWTH),
            };
            let late = tried.state.time > until;
            *state = match late {
                true => self.landed(state, wanted, until)?,
                false => tried.state,
            };
            // a speed that was asked for is met, not missed by a rounding
            if wanted == most && !late {
                state.speed = stop;
            }
            state.next = next;
            state.steps += 1;
            return Ok(());
        }
    }

    /// The state at a time inside a step that was accepted.
    fn landed(&self, state: &Coasting, step: f64, until: f64) -> Result<Coasting, Endless> {
        let (mut low, mut high) = (0.0, step);
        let mut found = self.attempt(state, step)?.state;
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            found = self.attempt(state, middle)?.state;
            match found.time > until {
                true => high = middle,
                false => low = middle,
            }
        }
        found.time = until;
        Ok(found)
    }

    fn attempt(&self, state: &Coasting, step: f64) -> Result<Attempt, Endless> {
        let nodes = state.temperatures.len();
        let (before, after) = (state.speed, state.speed * (-step).exp());
        let first = moments(&self.losses, before, &state.temperatures);
        let whole = braking(&first, before)?;
        let run_out = self.inertia * before / whole;
        let powers: Vec<f64> = first.iter().map(|m| before * m).collect();

        let quick = run_out * step;
        let mut predicted = state.temperatures.clone();
        (self.network).advance(
            &mut predicted,
            &to_nodes(&self.losses, &powers, nodes),
            quick,
        );
        let last = moments(&self.losses, after, &predicted);
        let time = self.inertia * step * 0.5 * (before / whole + after / braking(&last, after)?);

        let lost = 0.5 * self.inertia * (before - after) * (before + after);
        let weights = first.iter().zip(&last).map(|(a, b)| before * a + after * b);
        let weights: Vec<f64> = weights.collect();
        let sum: f64 = weights.iter().sum();
        let heats = weights.iter().map(|weight| lost * weight / sum);
        let mut next = state.clone();
        for (so_far, heat) in next.heats.iter_mut().zip(heats.clone()) {
            *so_far += heat;
        }
        let powers: Vec<f64> = heats.map(|heat| heat / time).collect();
        let powers = to_nodes(&self.losses, &powers, nodes);
        let given = self.network.advance(&mut next.temperatures, &powers, time);
        let planes = |node| self.losses.planes(node);
        let all = self.network.giving().zip(&given);
        next.given += all.map(|(node, given)| planes(node) * given).sum::<f64>();
        let made: Vec<f64> = powers.iter().map(|power| power * time).collect();
        (next.at_nodes).add(&made, &self.network.by_node(&given), &planes);
        next.time += time;
        next.speed = after;
        let apart = next.temperatures.iter().zip(&predicted);
        let apart = apart.map(|(ours, euler)| (ours - euler).abs() / TEMPERATURE_SCALE);
        let error = apart.fold((time - quick).abs() / (state.time + run_out), f64::max);
        Ok(Attempt { state: next, error })
    }
}

/// The whole moment, which must brake.
fn braking(moments: &[f64], speed: f64) -> Result<f64, Endless> {
    let sum: f64 = moments.iter().sum();
    match sum > 0.0 && sum.is_finite() {
        true => Ok(sum),
        false => Err(Endless::NothingBrakes(speed)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::network::Ground;

    /// k ω^p + c, all of it into the one node there is.
    #[derive(Clone, Copy)]
    struct Law {
        factor: f64,
        exponent: f64,
        constant: f64,
    }

    impl Losses for Law {
        fn count(&self) -> usize {
            1
        }
        fn moments(&self, speed: f64, _: &[f64], moments: &mut [f64]) {
            moments[0] = self.factor * speed.powf(self.exponent) + self.constant;
        }
        fn share(&self, _: usize, _: usize) -> f64 {
            1.0
        }
        fn planes(&self, _: usize) -> f64 {
            2.0
        }
    }

    fn run_out(losses: Law, stop: f64, tolerance: f64) -> (Coasting, f64) {
        let ground = Ground {
            node: 0,
            conductance: 0.5,
            temperature: 25.0,
        };
        let machine = CoastDown {
            network: Network::new(&[40.0], &[], &[ground]).unwrap(),
            losses,
            inertia: 0.02,
            tolerance,
        };
        let mut state = Coasting::start(2000.0, vec![25.0], &losses);
        while state.speed > stop {
            machine.step(&mut state, stop, f64::INFINITY).unwrap();
        }
        let stored = 2.0 * 40.0 * (state.temperatures[0] - 25.0);
        let left = state.heats[0] - stored - state.given;
        (state, left)
    }

    #[test]
    fn stop_times_are_those_in_closed_form() {
        // −kΩ^⅔ − c from Ω₀ to 0: (3I/k)[x − s atan(x/s)], x = Ω₀^⅓, s = √(c/k)
        let (k, c) = (1e-4f64, 2e-3f64);
        let closed = |speed: f64| {
            let (x, s) = (speed.cbrt(), (c / k).sqrt());
            3.0 * 0.02 / k * (x - s * (x / s).atan())
        };
        let law = Law {
            factor: k,
            exponent: 2.0 / 3.0,
            constant: c,
        };
        let exact = closed(2000.0) - closed(1e-3);
        for (tolerance, allowed, most) in [(4e-3, 4e-3, 80), (4e-5, 6e-5, 800)] {
            let (state, _) = run_out(law, 1e-3, tolerance);
            assert!((state.time / exact - 1.0).abs() < allowed, "{}", state.time);
            assert!(state.steps < most, "{}", state.steps);
        }
        // aΩ: the time from one speed to another is I ln(Ω₀/Ω)/a at any step
        let linear = Law {
            factor: 1e-5,
            exponent: 1.0,
            constant: 0.0,
        };
        let (state, _) = run_out(linear, 1.0, 1e-2);
        let exact = 0.02 * 2000f64.ln() / 1e-5;
        assert!((state.time / exact - 1.0).abs() < 1e-12);
    }

    #[test]
    fn heat_is_the_energy_lost_and_is_stored_or_given_away_at_any_step() {
        for tolerance in [1e-1, 1e-3] {
            let law = Law {
                factor: 1e-4,
                exponent: 0.7,
                constant: 1e-3,
            };
            let (state, left) = run_out(law, 0.1, tolerance);
            let lost = 0.5 * 0.02 * (2000f64.powi(2) - 0.1f64.powi(2));
            assert!((state.heats[0] / lost - 1.0).abs() < 1e-12);
            assert!(left.abs() < 1e-9 * lost, "{left}");
        }
    }

    #[test]
    fn a_machine_that_nothing_brakes_is_told() {
        let free = Law {
            factor: 0.0,
            exponent: 1.0,
            constant: 0.0,
        };
        let machine = CoastDown {
            network: Network::new(&[40.0], &[], &[]).unwrap(),
            losses: free,
            inertia: 0.02,
            tolerance: 1e-3,
        };
        let mut state = Coasting::start(100.0, vec![25.0], &free);
        let error = machine.step(&mut state, 1.0, f64::INFINITY).unwrap_err();
        assert_eq!(error, Endless::NothingBrakes(100.0));
    }

    #[test]
    fn a_time_asked_for_is_met_and_the_run_goes_on_as_before() {
        let law = Law {
            factor: 1e-4,
            exponent: 0.7,
            constant: 1e-3,
        };
        let machine = CoastDown {
            network: Network::new(&[40.0], &[], &[]).unwrap(),
            losses: law,
            inertia: 0.02,
            tolerance: 1e-5,
        };
        let mut state = Coasting::start(2000.0, vec![25.0], &law);
        while state.time < 100.0 {
            machine.step(&mut state, 1.0, 100.0).unwrap();
        }
        assert_eq!(state.time, 100.0);
        let mut other = Coasting::start(2000.0, vec![25.0], &law);
        while other.speed > state.speed {
            machine
                .step(&mut other, state.speed, f64::INFINITY)
                .unwrap();
        }
        assert!((other.time - 100.0).abs() < 1e-3, "{}", other.time);
    }
}
