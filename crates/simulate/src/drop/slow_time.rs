//! Slow time between two windows ball by ball: the rotor slows down by their losses, and its bearings warm by them.
//!
//! ```text
//!   M = f_0 M0(ν(T), Ω) + f_1 M1(P(T)) + M_beside       f_0, f_1 ≤ 1 and M_beside of both windows, along straight lines in the speed
//! ```
//! That is a run-out by laws with other moments, in steps as short as its temperatures ask for. What a window finds beyond M1 under the weight
//! stays as it is: of the larger loads of impacts and whirl a preload takes little.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::coast_down::build::{Built, Motion};
use crate::coast_down::ran::ran;
use crate::coast_down::rows::{End, Row};
use crate::drop::window::Window;
use std::sync::atomic::AtomicBool;
use thermal::bearing_network::NODES;
use thermal::warm_machine::{Between, OF_BEARING};

/// Change of a temperature after which a window looks again, K: bodies that warm by so much close a clearance by a micrometre or two.
const FAR: f64 = 10.0;

/// How far a step goes.
pub(super) enum Until<'a> {
    /// To this speed over the one at its start, or until a body has warmed or cooled by [`FAR`]: nothing is known but the window at its start.
    Ratio(f64),
    /// To a window, which is known.
    Window(&'a Window),
}

/// What a step loses.
pub(super) struct Lost {
    /// All of it, J.
    pub energy: f64,
    /// Of that the friction of rotor and race of each bearing, J, and the way over which they rub, m.
    pub rubbed: Vec<[f64; 2]>,
}

/// One step in slow time from the speed of a window: what it loses, and why the run-out ends within it.
pub(super) fn step(
    built: &mut Built,
    from: &Window,
    until: &Until,
    interrupt: &AtomicBool,
) -> Result<(Lost, Option<End>), &'static str> {
    let speed = built.start.speed;
    let (to, after) = match until {
        Until::Ratio(ratio) => (from, ratio * speed),
        Until::Window(to) => (*to, to.followed.speed),
    };
    let nodes = from.beside.iter().zip(&to.beside);
    let mut shares: Vec<f64> = nodes.map(|(a, b)| a + b).collect();
    for own in shares.chunks_mut(NODES.len()) {
        let sum: f64 = own.iter().sum();
        if sum > 0.0 {
            own.iter_mut().for_each(|share| *share /= sum);
        }
    }
    built.motion = Some(Motion {
        between: Between {
            ends: [from.followed.clone(), to.followed.clone()],
            shares,
        },
        balls: [from.balls.clone(), to.balls.clone()],
    });
    let no_network = |_| "the network of a bearing has no finite values";
    let mut stretch = built.clone();
    stretch.end.stop_speed = after.max(built.end.stop_speed);
    let mut found = ran(&stretch, interrupt).map_err(no_network)?;
    let is_far = |row: &&Row| {
        let nodes = row.temperatures.iter().zip(&built.start.temperatures);
        nodes.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) > FAR
    };
    let own = &found.free.rows[built.start.rows.len()..];
    let far = own.iter().skip(1).find(is_far).map(|row| row.speed);
    let mut nearer = stretch.clone();
    if let (Until::Ratio(_), Some(far)) = (until, far) {
        nearer.end.stop_speed = far.max(built.end.stop_speed);
        found = ran(&nearer, interrupt).map_err(no_network)?;
    }
    let end = match found.free.end {
        End::Stands => None,
        end => Some(end),
    };
    let beside = |heats: &[f64]| -> f64 { heats.iter().skip(2).step_by(OF_BEARING).sum() };
    let heats = beside(&found.free.state.heats) - beside(&built.start.heats);
    let both = from.beside.iter().chain(&to.beside).sum::<f64>();
    let rubbed = (0..from.friction.len()).map(|k| {
        let power = from.friction[k] + to.friction[k];
        let friction = if both > 0.0 {
            heats * power / both
        } else {
            0.0
        };
        let force = 0.5 * f64::from(built.sides) * (from.rubbing[k] + to.rubbing[k]);
        let way = if force > 0.0 { friction / force } else { 0.0 };
        [friction, way]
    });
    let rubbed = rubbed.collect();
    let start = found.start();
    let energy = 0.5 * built.inertia * (speed - start.speed) * (speed + start.speed);
    built.start = start;
    Ok((Lost { energy, rubbed }, end))
}
