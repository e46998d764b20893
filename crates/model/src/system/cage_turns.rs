//! Means over cage turns at the end of a run: of the moments on both races, the law's moment, the slip of the cage.

use super::sampling::Periods;
use solve::{Machine, Step};
use std::f64::consts::PI;

/// Share of the speed within which the race counts as being at it.
const AT_SPEED: f64 = 0.01;

/// Means over cage turns at one speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LateMeans {
    /// Number of turns, of the time a cage needs that rolls at the target speed.
    pub turns: usize,
    /// Moment t_I, N m.
    pub inner_moment: f64,
    /// Moment t_O, N m.
    pub outer_moment: f64,
    /// Moment M of the law, N m.
    pub steady_moment: f64,
    /// Cage slip.
    pub cage_slip: f64,
}

/// Cage turns up to the end of a run, each with its means. Room is made before the run.
#[derive(Clone, Debug, PartialEq)]
pub struct CageTurns {
    periods: Periods<4>,
}

impl CageTurns {
    /// Turns of a cage of a speed (rad/s) until the end of a run (s); the probes of t_I, t_O, M and the cage slip, and the
    /// channel of the inner race's speed.
    pub fn until(end: f64, cage_speed: f64, probes: [usize; 4], speed_channel: usize) -> Self {
        CageTurns {
            periods: Periods::until(end, 2.0 * PI / cage_speed.abs(), probes, speed_channel),
        }
    }
    /// Takes a step.
    pub fn watch<M: Machine>(&mut self, step: &Step<M>) {
        self.periods.watch(step);
    }
    /// Means over the last cage turns at a speed of the inner race, rad/s: of those in which the speed stayed within 1 %,
    /// the later half. None where there was no such turn.
    pub fn late_means(&self, speed: f64) -> Option<LateMeans> {
        let near = |value: f64| (value - speed).abs() <= AT_SPEED * speed.abs();
        let at_speed: Vec<_> = (self.periods.whole().rev())
            .take_while(|turn| near(turn.range.0) && near(turn.range.1))
            .collect();
        let late = &at_speed[..at_speed.len().div_ceil(2)];
        let mean =
            |k: usize| late.iter().map(|turn| turn.means[k]).sum::<f64>() / late.len() as f64;
        (!late.is_empty()).then(|| LateMeans {
            turns: late.len(),
            inner_moment: mean(0),
            outer_moment: mean(1),
            steady_moment: mean(2),
            cage_slip: mean(3),
        })
    }
    /// Mean cage slip of the last whole turn.
    pub fn last_cage_slip(&self) -> Option<f64> {
        self.periods.whole().next_back().map(|turn| turn.means[3])
    }
}
