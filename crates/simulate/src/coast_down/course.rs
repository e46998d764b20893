//! A coast-down step by step, and the same with nodes that are held at their limits.

use crate::coast_down::build::{CoastDownModel, ICE_POINT, Part, hold};
use crate::coast_down::rows::{End, Row, RowOfBearing};
use problem::Problem;
use std::sync::atomic::{AtomicBool, Ordering};
use thermal::bearing_network::{
    BearingNetwork, LUBRICANT, Landing, NODES, Operation, relaxing, together,
};
use thermal::coast_down::{CoastDown as Coast, Coasting, Endless};
use thermal::held::Held;
use thermal::losses::{Losses, moments};
use thermal::network::Network;
use thermal::steady_speed::SteadySpeed;
use thermal::warm_machine::{OF_BEARING, by_kind};

/// Largest ln(1/r) of a step: the conductances of its start hold for it.
const LONGEST_STEP: f64 = 0.03;
/// Speed below which a rotor stands within seconds, rad/s: laws of friction fade there.
const AT_REST: f64 = 1.0;
/// Temperature above which nothing of the model holds, °C: hardened steel is soft, oil and grease are gone.
pub(crate) const BEYOND: f64 = 350.0;

/// A coast-down.
#[derive(Clone, Debug)]
pub(crate) struct Course {
    pub rows: Vec<Row>,
    pub state: Coasting,
    pub end: End,
    /// Heat taken from each node to hold it, J, all bearings.
    pub taken: Vec<f64>,
    /// Which nodes are held at its end, and the heat taken from each over the last step, W.
    pub held: Held,
    pub powers: Vec<f64>,
    /// Heat stored since the start, J, all bearings.
    pub stored: f64,
}

/// Follows it; with limits the nodes are held at them from the moment they get there.
pub(super) fn follow(
    built: &CoastDownModel,
    limits: Option<&[Option<f64>]>,
    interrupt: &AtomicBool,
) -> Result<Course, Box<Problem>> {
    let start = &built.start;
    let planes = built.planes();
    let capacities = built.capacities();
    let nodes = capacities.len();
    let mut held = Held::at(limits.map_or(vec![None; nodes], <[_]>::to_vec));
    let (mut taken, mut powers) = (vec![0.0; nodes], vec![0.0; nodes]);
    let mut state = Coasting::at(
        start.time,
        start.speed,
        start.temperatures.clone(),
        &built.losses(start.time, start.speed),
    );
    state.heats.clone_from(&start.heats);
    state.given = start.given;
    state.at_nodes = start.at_nodes.clone();
    let mut rows = start.rows.clone();
    match (&start.on_limits, limits) {
        // what was held on the way to here is held on
        (Some(way), Some(_)) => {
            held.clone_from(&way.held);
            state.temperatures.clone_from(&way.temperatures);
            taken.clone_from(&way.taken);
            powers.clone_from(&way.powers);
            rows.clone_from(&way.rows);
            state.time += way.delay;
        }
        _ => held.begin(&mut state.temperatures),
    }
    // also where it ends at once
    if rows.last().is_none_or(|row| row.speed > state.speed) {
        rows.push(row(built, &state, &powers));
    }
    let end = loop {
        if let Some(end) = start.ended {
            break end;
        }
        if state.speed <= built.end.stop_speed {
            break match built.end.stop_speed > AT_REST {
                true => End::Reached,
                false => End::Stands,
            };
        }
        if state.time >= built.end.longest {
            break End::Late;
        }
        if interrupt.load(Ordering::Relaxed) {
            break End::Interrupted;
        }
        if let Some(end) = left(built, &state.temperatures) {
            break end;
        }
        let mut machine = Coast {
            network: network(built, (state.speed, &state.temperatures), held.marks())
                .map_err(no_network)?,
            losses: built.losses(state.time, state.speed),
            inertia: built.inertia,
            tolerance: built.end.tolerance,
        };
        let before = state.clone();
        let stop = (state.speed * (-LONGEST_STEP).exp())
            .max(built.end.stop_speed)
            .max(built.knot_below(state.speed));
        let braking = moments(&machine.losses, state.speed, &state.temperatures);
        let until = built.until(state.time, state.speed, braking.iter().sum());
        let mut stepped = step(&machine, &mut state, stop, until, built.seats_follow());
        if stepped.is_ok() && built.load.is_some() {
            // a load that changes with time acts as in the middle of the step
            machine.losses = built.losses(0.5 * (before.time + state.time), before.speed);
            state = before.clone();
            stepped = step(&machine, &mut state, stop, until, built.seats_follow());
        }
        if let Err(endless) = stepped {
            break End::Endless(endless);
        }
        let reached = state.at_nodes.given.iter().zip(&before.at_nodes.given);
        let reached: Vec<f64> = (reached.zip(&planes))
            .map(|((now, before), planes)| (now - before) / planes)
            .collect();
        powers = hold(
            (&mut held, &mut state.temperatures),
            &capacities,
            &reached,
            (&planes, state.time - before.time),
            &mut taken,
        );
        rows.push(row(built, &state, &powers));
    };
    let rises = state.temperatures.iter().zip(&built.warm_from);
    let stored = capacities.iter().zip(&planes).zip(rises);
    let stored = stored
        .map(|((capacity, planes), (now, before))| planes * capacity * (now - before))
        .sum();
    Ok(Course {
        rows,
        state,
        end,
        taken,
        held,
        powers,
        stored,
    })
}

/// Why a coast-down ends at temperatures of the nodes of all bearings, °C, that no law of it knows.
fn left(built: &CoastDownModel, temperatures: &[f64]) -> Option<End> {
    if !temperatures.iter().all(|now| now.abs() < BEYOND) {
        return Some(End::Beyond);
    }
    let mut each = built.parts.iter().zip(temperatures.chunks(NODES.len()));
    let thin = each.any(|(part, temperatures)| {
        let kelvin = temperatures[LUBRICANT] + ICE_POINT;
        part.losses.oil.at(kelvin).is_err()
    });
    thin.then_some(End::Lost(
        "the lubricant is hotter than the law of its viscosity reaches, to 0.21 mm²/s",
    ))
}

/// Largest change of a temperature in a step where a seat follows it, K: between tight and loose lie tenths of a kelvin, and what it conducts
/// is held in a step.
const MOST_CHANGE: f64 = 0.5;

/// Largest difference of two lists of temperatures, K.
fn largest_change(before: &[f64], after: &[f64]) -> f64 {
    let changes = before.iter().zip(after).map(|(a, b)| (a - b).abs());
    changes.fold(0.0, f64::max)
}

/// One step, short enough for seats that follow the temperatures.
fn step<L: Losses>(
    machine: &Coast<L>,
    state: &mut Coasting,
    stop: f64,
    until: f64,
    seats_follow: bool,
) -> Result<(), Endless> {
    let mut stop = stop;
    loop {
        let mut tried = state.clone();
        machine.step(&mut tried, stop, until)?;
        let moved = largest_change(&state.temperatures, &tried.temperatures);
        let slowed = (state.speed / tried.speed).ln();
        if !seats_follow || moved <= MOST_CHANGE || slowed < LEAST_SLOWING {
            *state = tried;
            return Ok(());
        }
        stop = state.speed * (-slowed * (0.8 * MOST_CHANGE / moved).max(0.1)).exp();
    }
}

/// Logarithm of two speeds of which one step goes from one to the other whatever it warms.
const LEAST_SLOWING: f64 = 1e-6;

/// The clearance of a bearing at a speed of its inner race, rad/s, and at the temperatures of its nodes: m.
fn clearance(part: &Part, speed: f64, temperatures: &[f64]) -> f64 {
    match part.closes {
        true => part.zone.clearance_at(temperatures, speed),
        false => part.zone.clearance.at_reference - part.zone.growth * speed * speed,
    }
}

/// Speed of an inner race at a speed of the rotor, rad/s: a race that slides turns slower, and its bearing is stirred and cooled less.
fn race(built: &CoastDownModel, speed: f64, bearing: usize) -> f64 {
    let motion = built.motion.as_ref();
    let spin = motion.map_or(1.0, |motion| motion.between.spin(speed, bearing));
    built.parts[bearing].losses.ratio * speed * spin
}

/// How the rotor lies in a bearing at a speed of the rotor: it rolls under its load where its motion was not followed.
fn landing(built: &CoastDownModel, speed: f64, bearing: usize) -> Landing {
    let rolls = || Landing::rolls(built.parts[bearing].zone.load);
    let motion = built.motion.as_ref();
    motion.map_or_else(rolls, |motion| motion.between.landing(speed, bearing))
}

/// The networks of all bearings at a speed of the rotor, rad/s, and at temperatures of their nodes, °C; marked nodes are held.
fn network(built: &CoastDownModel, at: (f64, &[f64]), held: &[bool]) -> Result<Network, String> {
    operating(built, at, |all| together(all, held))
}

/// What all bearings do at a speed of the rotor, rad/s, and at temperatures of their nodes, °C.
fn operating<T>(
    built: &CoastDownModel,
    at: (f64, &[f64]),
    act: impl FnOnce(&[(&BearingNetwork, Operation<'_>)]) -> T,
) -> T {
    lying(built, at, &|bearing| landing(built, at.0, bearing), act)
}

/// The same with a rotor that lies in them in a given way.
fn lying<T>(
    built: &CoastDownModel,
    (speed, temperatures): (f64, &[f64]),
    landing: &dyn Fn(usize) -> Landing,
    act: impl FnOnce(&[(&BearingNetwork, Operation<'_>)]) -> T,
) -> T {
    let each = || {
        (built.parts.iter())
            .zip(temperatures.chunks(NODES.len()))
            .enumerate()
    };
    let loads: Vec<Vec<f64>> = each()
        .map(|(k, (part, temperatures))| {
            let at = race(built, speed, k);
            let force = landing(k).force;
            part.zone
                .loads_under(force, clearance(part, at, temperatures))
        })
        .collect();
    let operations = each()
        .zip(&loads)
        .map(|((k, (part, temperatures)), loads)| {
            let kelvin = temperatures[LUBRICANT] + ICE_POINT;
            Operation {
                speed: race(built, speed, k),
                landing: landing(k),
                loads,
                viscosity: part.viscosity.held(kelvin),
                temperatures,
            }
        });
    let networks = built.parts.iter().map(|part| &part.network);
    let all: Vec<_> = networks.zip(operations).collect();
    act(&all)
}

fn no_network(why: String) -> Box<Problem> {
    use problem::Code;
    use scenario::problem_at;
    let needed = "finite capacities and conductances are needed";
    problem_at(Code::Impossible, "heat", why, needed)
}

fn row(built: &CoastDownModel, state: &Coasting, taken: &[f64]) -> Row {
    let losses = built.losses(state.time, state.speed);
    let mut all = vec![0.0; losses.count()];
    losses.moments(state.speed, &state.temperatures, &mut all);
    let moments = by_kind(&all);
    let of_part = |(k, (part, temperatures)): (usize, (&Part, &[f64]))| {
        let speed = race(built, state.speed, k);
        let clearance = clearance(part, speed, temperatures);
        let loads = part.zone.loads(clearance);
        let by_law = loads.iter().copied().fold(0.0, f64::max);
        let balls = (built.motion.as_ref()).and_then(|motion| motion.balls(state.speed, k));
        let seen = balls.map_or([0.0; 2], |balls| balls.largest);
        let loads = [
            by_law.max(seen[0]),
            (by_law + part.network.centrifugal(speed)).max(seen[1]),
        ];
        RowOfBearing {
            moment: all[OF_BEARING * k..][..OF_BEARING].iter().sum(),
            load: part.zone.load,
            clearance,
            largest_pressure: part.largest_pressure(loads),
            largest_ball_loads: loads,
            landing: landing(built, state.speed, k),
            speed,
            balls: balls.cloned(),
        }
    };
    let each = built
        .parts
        .iter()
        .zip(state.temperatures.chunks(NODES.len()));
    let bearings = each.enumerate().map(of_part).collect();
    // as ball by ball: at the speed of this instant, and under the weight
    let rests = |bearing: usize| Landing::rolls(built.parts[bearing].zone.load);
    let passes = |moved: &[f64]| {
        lying(built, (state.speed, moved), &rests, |all| {
            relaxing(all, &state.temperatures)
        })
    };
    let predicts = built.motion.as_ref().is_some_and(|motion| motion.predicts);
    let now = (state.speed, &state.temperatures[..]);
    let growth = match lying(built, now, &rests, |all| together(all, &[])) {
        Ok(_) if predicts => 0.0,
        Ok(network) => SteadySpeed {
            network,
            losses,
            speed: state.speed,
            tolerance: 1.0,
        }
        .growth_of(&state.temperatures, &passes),
        Err(_) => f64::NAN,
    };
    Row {
        time: state.time,
        speed: state.speed,
        temperatures: state.temperatures.clone(),
        moments,
        bearings,
        growth,
        taken: taken.to_vec(),
    }
}
