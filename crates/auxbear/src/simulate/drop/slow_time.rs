//! Slow time between two windows ball by ball: the rotor slows down by their losses, and its bearings warm by them.
//!
//! ```text
//!   dt = I ln(1/r) ½ (Ω_j/M_j + Ω_j+1/M_j+1),  M = P/Ω
//! ```
//! The kinetic energy lost is heat by the means' proportions.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::simulate::coast_down::build::{Built, hold};
use crate::simulate::coast_down::course;
use crate::simulate::coast_down::course::{MOST_CHANGE, largest_change};
use crate::simulate::coast_down::rows::BallsSeen;

/// What a window found at its speed.
#[derive(Clone)]
pub(super) struct Window {
    /// Mean power of the losses: of each bearing its steady moment and its other losses, then of the rotor, W.
    pub powers: Vec<f64>,
    /// Over the nodes of all bearings, W.
    pub nodes: Vec<f64>,
    /// Of the friction of rotor and races among them, W.
    pub friction: f64,
    /// Largest contact force of each bearing, N.
    pub peaks: Vec<f64>,
    /// Of the balls of each bearing.
    pub balls: Vec<Option<BallsSeen>>,
    /// Standard error of the whole power over it.
    pub scatter: f64,
}

/// One step in slow time from the speed of a window, with the powers of its start and of its end: what it loses, and what of that
/// friction of rotor and races takes, J.
pub(super) fn step(
    built: &mut Built,
    from: &Window,
    to: &Window,
    ratio: f64,
) -> Result<[f64; 2], &'static str> {
    let speed = built.start.speed;
    let after = (ratio * speed).max(built.end.stop_speed);
    let sides = f64::from(built.sides);
    let whole = |window: &Window| sides * window.powers.iter().sum::<f64>();
    // I ln(1/r) ½ (Ω/M + Ω'/M'), M = P/Ω
    let inverse = |speed: f64, power: f64| speed * speed / power;
    let end_power = match std::ptr::eq(from, to) {
        // what is not known yet: the moment of the start
        true => whole(to) * after / speed,
        false => whole(to),
    };
    let time = built.inertia
        * (speed / after).ln()
        * 0.5
        * (inverse(speed, whole(from)) + inverse(after, end_power));
    if !(time.is_finite() && time > 0.0) {
        return Err("nothing brakes the rotor");
    }
    let lost = 0.5 * built.inertia * (speed - after) * (speed + after);
    let weight = |k: usize| from.powers[k] + to.powers[k];
    let sum: f64 = (0..from.powers.len()).map(weight).sum();
    for (k, heat) in built.start.heats.iter_mut().enumerate() {
        *heat += lost * weight(k) / sum;
    }
    // what reaches the nodes keeps its part of the whole
    let scale = lost / (sides * time * 0.5 * sum);
    let powers: Vec<f64> = (from.nodes.iter().zip(&to.nodes))
        .map(|(a, b)| 0.5 * (a + b) * scale)
        .collect();
    on_limits(built, &powers, time)?;
    let mut left = time;
    while left > 0.0 {
        let network = network(built, &built.start.temperatures, &[])?;
        let mut span = left;
        let (warmed, given) = loop {
            let mut warmed = built.start.temperatures.clone();
            let given = network.advance(&mut warmed, &powers, span);
            let moved = largest_change(&built.start.temperatures, &warmed);
            if !built.seats_follow() || moved <= MOST_CHANGE || span < LEAST_SHARE * time {
                break (warmed, given);
            }
            span *= (0.8 * MOST_CHANGE / moved).max(0.1);
        };
        built.start.temperatures = warmed;
        built.start.given += sides * given.iter().sum::<f64>();
        (built.start.at_nodes).add(&network, sides, &powers, span, &given);
        left -= span;
    }
    built.start.time += time;
    built.start.speed = after;
    Ok([lost, lost * (from.friction + to.friction) / sum])
}

/// Least share of a step that is taken at once.
const LEAST_SHARE: f64 = 1e-3;

/// The same step with the nodes held at their limits.
fn on_limits(built: &mut Built, powers: &[f64], time: f64) -> Result<(), &'static str> {
    let Some(mut way) = built.start.on_limits.take() else {
        return Ok(());
    };
    let sides = f64::from(built.sides);
    let network = network(built, &way.temperatures, way.held.marks())?;
    let given = network.advance(&mut way.temperatures, powers, time);
    way.powers = hold(
        (&mut way.held, &mut way.temperatures),
        &built.capacities(),
        &network.by_node(&given),
        (sides, time),
        &mut way.taken,
    );
    built.start.on_limits = Some(way);
    Ok(())
}

fn network(
    built: &Built,
    temperatures: &[f64],
    held: &[bool],
) -> Result<thermal::network::Network, &'static str> {
    course::network(built, (built.start.speed, temperatures), held)
        .map_err(|_| "the network of a bearing has no finite values")
}
