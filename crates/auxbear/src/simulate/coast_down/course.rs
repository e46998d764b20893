//! A run-out step by step, and the same with nodes that are held at their limits.

use crate::problem::Problem;
use crate::scenario::CoastDown;
use crate::simulate::coast_down::build::{Built, ICE_POINT};
use std::sync::atomic::{AtomicBool, Ordering};
use thermal::bearing_network::{BALLS, CAGE, INNER_RACE, LUBRICANT, NODES, OUTER_RACE, Operation};
use thermal::coast_down::{CoastDown as Coast, Coasting, Endless};
use thermal::steady_speed::SteadySpeed;

/// Largest ln(1/r) of a step: the conductances of its start hold for it.
const LONGEST_STEP: f64 = 0.03;
/// Capacity of a node that is held over its own.
const HELD: f64 = 1e7;
/// Temperature above which nothing of the model holds, °C: hardened steel is soft, oil and grease are gone.
pub(super) const BEYOND: f64 = 350.0;

/// What is known at the end of a step. Moments and powers are those of all bearings.
#[derive(Clone, Debug)]
pub(super) struct Row {
    pub time: f64,
    pub speed: f64,
    /// °C.
    pub temperatures: Vec<f64>,
    /// M0, M1, windage, N m.
    pub moments: [f64; 3],
    /// Diametral, m.
    pub clearance: f64,
    /// Of the most and of the least loaded ball, N.
    pub ball_loads: [f64; 2],
    /// Third powers of the ball loads, their mean over a turn, N³.
    pub cubes: f64,
    /// Largest growth rate of the temperatures, 1/s.
    pub growth: f64,
    /// Power that is taken from each node to hold it, W, all bearings.
    pub taken: Vec<f64>,
}

/// How a run-out ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum End {
    Stands,
    Late,
    Interrupted,
    Beyond,
    Endless(Endless),
}

/// A run-out.
#[derive(Clone, Debug)]
pub(super) struct Course {
    pub rows: Vec<Row>,
    pub state: Coasting,
    pub end: End,
    /// Heat taken from each node to hold it, J, all bearings.
    pub taken: Vec<f64>,
    /// Heat stored since the start, J, all bearings.
    pub stored: f64,
}

/// Limits of the nodes, °C; none of what has none.
pub(super) fn limits(run: &CoastDown) -> [Option<f64>; 7] {
    let mut limits = [None; 7];
    let heat = &run.heat;
    for node in [INNER_RACE, BALLS, OUTER_RACE] {
        limits[node] = Some(heat.race_limit - ICE_POINT);
    }
    if run.cage_mass > 0.0 {
        limits[CAGE] = Some(heat.cage_limit - ICE_POINT);
    }
    limits[LUBRICANT] = Some(heat.lubricant_limit - ICE_POINT);
    limits
}

/// Follows it; with limits the nodes are held at them from the moment they get there.
pub(super) fn follow(
    run: &CoastDown,
    built: &Built,
    limits: &[Option<f64>; 7],
    interrupt: &AtomicBool,
) -> Result<Course, Box<Problem>> {
    let start = run.heat.start_temperature - ICE_POINT;
    let sides = f64::from(run.planes);
    let capacities = built.network.capacities;
    let mut held = [false; 7];
    let mut taken = vec![0.0; NODES.len()];
    let mut state = Coasting::start(run.speed.abs(), vec![start; NODES.len()], &built.losses);
    let mut rows = vec![row(built, &state, &[0.0; 7])];
    let end = loop {
        if state.speed <= run.stop_speed {
            break End::Stands;
        }
        if state.time >= run.longest {
            break End::Late;
        }
        if interrupt.load(Ordering::Relaxed) {
            break End::Interrupted;
        }
        if !state.temperatures.iter().all(|now| now.abs() < BEYOND) {
            break End::Beyond;
        }
        let machine = Coast {
            network: network(built, &state, &held)?,
            losses: built.losses.clone(),
            inertia: run.polar_inertia,
            sides,
            tolerance: run.tolerance,
        };
        let (before, stop) = (
            state.time,
            run.stop_speed.max(state.speed * (-LONGEST_STEP).exp()),
        );
        if let Err(endless) = machine.step(&mut state, stop, run.longest) {
            break End::Endless(endless);
        }
        let mut powers = [0.0; 7];
        for node in 0..NODES.len() {
            let Some(limit) = limits[node] else { continue };
            let above = state.temperatures[node] - limit;
            if !held[node] && above <= 0.0 {
                continue;
            }
            let capacity = capacities[node] * if held[node] { HELD } else { 1.0 };
            let heat = sides * capacity * above;
            taken[node] += heat;
            powers[node] = heat / (state.time - before);
            state.temperatures[node] = limit;
            held[node] = heat > 0.0;
        }
        rows.push(row(built, &state, &powers));
    };
    let stored = capacities.iter().zip(&state.temperatures);
    let stored = sides
        * stored
            .map(|(capacity, now)| capacity * (now - start))
            .sum::<f64>();
    Ok(Course {
        rows,
        state,
        end,
        taken,
        stored,
    })
}

/// The clearance at an instant, m.
fn clearance(built: &Built, temperatures: &[f64]) -> f64 {
    match built.closes {
        true => built.zone.clearance_at(temperatures),
        false => built.zone.clearance.at_reference,
    }
}

fn network(
    built: &Built,
    state: &Coasting,
    held: &[bool; 7],
) -> Result<thermal::network::Network, Box<Problem>> {
    let mut network = built.network.clone();
    for (capacity, held) in network.capacities.iter_mut().zip(held) {
        *capacity *= if *held { HELD } else { 1.0 };
    }
    let loads = built.zone.loads(clearance(built, &state.temperatures));
    let kelvin = state.temperatures[LUBRICANT] + ICE_POINT;
    let operation = Operation {
        speed: state.speed,
        loads: &loads,
        viscosity: built.losses.oil.viscosity(kelvin).max(1e-6),
    };
    network.at(operation).map_err(|why| {
        use crate::problem::Code;
        use crate::scenario::UNNAMED;
        let needed = "finite capacities and conductances are needed";
        Box::new(Problem::new(Code::Impossible, UNNAMED, why.to_string(), needed).on_key("heat"))
    })
}

fn row(built: &Built, state: &Coasting, taken: &[f64; 7]) -> Row {
    use thermal::losses::Losses;
    let temperatures = &state.temperatures;
    let mut moments = [0.0; 3];
    (built.losses).moments(state.speed, temperatures, &mut moments);
    let clearance = clearance(built, temperatures);
    let loads = built.zone.loads(clearance);
    let count = loads.len() as f64;
    let growth = match network(built, state, &[false; 7]) {
        Ok(network) => SteadySpeed {
            network,
            losses: built.losses.clone(),
            speed: state.speed,
            tolerance: 1.0,
        }
        .growth(temperatures),
        Err(_) => f64::NAN,
    };
    Row {
        time: state.time,
        speed: state.speed,
        temperatures: temperatures.clone(),
        moments,
        clearance,
        ball_loads: [
            loads.iter().copied().fold(0.0, f64::max),
            loads.iter().copied().fold(f64::INFINITY, f64::min),
        ],
        cubes: loads.iter().map(|load| load.powi(3)).sum::<f64>() / count,
        growth,
        taken: taken.to_vec(),
    }
}
