//! A quasi-steady step between two ball-by-ball intervals: the rotor slows down by their losses, and its bearings warm by them.
//!
//! ```text
//!   M = f_0 M0(ν(T), Ω) + f_1 M1(P(T)) + M_beside       f_0, f_1 ≤ 1 and M_beside of both intervals, along straight lines in the speed
//! ```
//! That is a coast-down by laws with other moments, in steps as short as its temperatures need. What an interval finds beyond M1 under the weight
//! stays as it is: of the larger loads of impacts and whirl a preload takes little.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::coast_down::build::{CoastDownModel, Motion};
use crate::coast_down::rows::{End, Row};
use crate::coast_down::run::run;
use crate::drop::multirate::batch::Observation;
use crate::drop::multirate::interval::Failure;
use std::sync::atomic::AtomicBool;
use thermal::bearing_network::NODES;
use thermal::warm_machine::Between;

/// Change of a temperature after which a leap ends, K: rings that differ by it close a clearance by a micrometre or two, which no interval has seen yet.
const LARGEST_CHANGE: f64 = 10.0;

/// What is known of the speed to which a step goes.
#[derive(Clone, Copy)]
pub(super) enum Ahead<'a> {
    /// Nothing: the step is a prediction, and ends where a body has warmed or cooled by [`LARGEST_CHANGE`].
    Unknown,
    /// It was followed: the step goes there.
    Followed(&'a Observation),
}

/// What a step has taken.
#[derive(Clone, Debug, Default)]
pub(super) struct Step {
    /// Energy of the rotor, J.
    pub energy: f64,
    /// Of each bearing.
    pub rubbed: Vec<Rubbed>,
    /// Why the coast-down ends within it.
    pub end: Option<End>,
}

/// What rotor and race of a bearing have rubbed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rubbed {
    /// Heat of all equal bearings, J.
    pub heat: f64,
    /// Distance slid, m, and that times the force, N m, of one.
    pub distance: f64,
    pub work: f64,
}

impl Rubbed {
    /// Adds another.
    pub fn add(&mut self, other: &Rubbed) {
        self.heat += other.heat;
        self.distance += other.distance;
        self.work += other.work;
    }
}

/// One step from the state of a coast-down to a speed; it starts there afterwards.
pub(super) fn step(
    built: &mut CoastDownModel,
    from: &Observation,
    ahead: Ahead,
    speed: f64,
    interrupt: &AtomicBool,
) -> Result<Step, Failure> {
    let begin = (built.start.time, built.start.speed);
    let to = match ahead {
        Ahead::Unknown => from,
        Ahead::Followed(to) => to,
    };
    built.motion = Some(between(from, to, matches!(ahead, Ahead::Unknown)));
    let no_network = |_| "the network of a bearing has no finite values";
    let mut stretch = built.clone();
    stretch.end.stop_speed = speed.max(built.end.stop_speed);
    let mut found = run(&stretch, interrupt).map_err(no_network)?;
    let is_far = |row: &&Row| {
        let nodes = row.temperatures.iter().zip(&built.start.temperatures);
        nodes.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) > LARGEST_CHANGE
    };
    let own = &found.free.rows[built.start.rows.len()..];
    let far = own.iter().skip(1).find(is_far).map(|row| row.speed);
    let mut nearer = stretch.clone();
    if let (Ahead::Unknown, Some(far)) = (ahead, far) {
        nearer.end.stop_speed = far.max(built.end.stop_speed);
        found = run(&nearer, interrupt).map_err(no_network)?;
    }
    let end = match found.free.end {
        End::Stands | End::Reached => None,
        end => Some(end),
    };
    built.start = found.start();
    let time = built.start.time - begin.0;
    let bearings = from.mean.bearings.iter().zip(&to.mean.bearings);
    let rubbed = bearings.map(|(from, to)| Rubbed {
        heat: 0.5 * time * from.planes * (from.friction + to.friction),
        distance: 0.5 * time * (from.sliding + to.sliding),
        work: 0.5 * time * (from.rubbing + to.rubbing),
    });
    let speed = built.start.speed;
    Ok(Step {
        energy: 0.5 * built.inertia * (begin.1 - speed) * (begin.1 + speed),
        rubbed: rubbed.collect(),
        end,
    })
}

/// A machine between two speeds at which it was followed.
fn between(from: &Observation, to: &Observation, predicts: bool) -> Motion {
    let nodes = from.beside.iter().zip(&to.beside);
    let mut shares: Vec<f64> = nodes.map(|(a, b)| a + b).collect();
    for own in shares.chunks_mut(NODES.len()) {
        let sum: f64 = own.iter().sum();
        if sum > 0.0 {
            own.iter_mut().for_each(|share| *share /= sum);
        }
    }
    Motion {
        between: Between {
            ends: [from.followed.clone(), to.followed.clone()],
            shares,
        },
        balls: [from.balls.clone(), to.balls.clone()],
        predicts,
    }
}

/// A rotor that goes on rolling to its standstill: what an interval found beside the laws fades with the speed. The moment of a bearing that no law
/// knows stays as it is.
pub(super) fn fading(built: &CoastDownModel, from: &Observation) -> Motion {
    let mut at_rest = from.clone();
    at_rest.followed.speed = built.end.stop_speed.min(0.5 * from.followed.speed);
    at_rest.followed.rotor = 0.0;
    let bearings = at_rest.followed.bearings.iter_mut().zip(&built.parts);
    for (k, (own, part)) in bearings.enumerate().filter(|(_, (_, part))| part.by_laws) {
        at_rest.balls[k] = None;
        own.factors = [1.0; 2];
        (own.beside, own.spin) = (0.0, 1.0);
        own.landing = thermal::bearing_network::Landing::rolls(part.zone.load);
    }
    between(from, &at_rest, false)
}
