//! What is watched and kept of a spin-up.
//!
//! Rises through a level are found on dense output; largest values are those at the ends of the steps. Means are taken
//! over cage turns at the target speed. Rows are sampled at equal intervals and at the end.
//! Everything is allocated before the run.

use super::SpinUpMachine;
use super::layout::{
    BEARING, CAGE_SLIP, DRIVE_MOMENT, INNER, INNER_MOMENT, LAND_FORCE, LARGEST_INNER_LOAD,
    LARGEST_OUTER_LOAD, LARGEST_POCKET_FORCE, OUTER_MOMENT, STEADY_MOMENT,
};
use crate::bearing::BearingConstants;
use crate::system::sampling::{Peak, Periods, Rise, Row, Rows};
use solve::{Flow, Observer, Step};

/// Everything kept of one machine.
#[derive(Clone, Debug)]
pub struct Record {
    /// Largest size of the moment t_I that resists the inner race, N m.
    pub inner_moment: Peak,
    /// Largest size of the moment t_O on the outer race, N m.
    pub outer_moment: Peak,
    /// Largest size of the moment of the drive, N m.
    pub drive_moment: Peak,
    /// Largest ball load at the inner race, N.
    pub largest_inner_load: Peak,
    /// Largest ball load at the outer race, N.
    pub largest_outer_load: Peak,
    /// Largest force between a ball and its pocket, or between two balls without a cage, N.
    pub largest_pocket_force: Peak,
    /// Largest force between cage and land, N.
    pub largest_land_force: Peak,
    /// Of the inner race through 50 % and 95 % of the target speed, of the cage through 95 % of its rolling speed then.
    rises: [Rise; 3],
    /// Of t_I, t_O, M and the cage slip, over cage turns.
    turns: Periods<4>,
    rows: Rows,
}

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

impl Record {
    /// A record for a run until `end`, with a row every `interval`, or without rows.
    pub fn new(machine: &SpinUpMachine, end: f64, interval: f64, keep_rows: bool) -> Self {
        let c = &machine.constants;
        let speed = c.target_speed;
        let cage = match &c.bearing {
            // where balls roll the cage follows the race
            BearingConstants::Rolling(_) => Rise::through(INNER + 5, 0.95 * speed),
            BearingConstants::Planar(_) => {
                let rolling = c.bearing.rolling_cage_ratio() * speed;
                Rise::through(BEARING + 1, 0.95 * rolling)
            }
        };
        let turn = 2.0 * std::f64::consts::PI / (c.bearing.rolling_cage_ratio() * speed).abs();
        Record {
            inner_moment: Peak::NONE,
            outer_moment: Peak::NONE,
            drive_moment: Peak::NONE,
            largest_inner_load: Peak::NONE,
            largest_outer_load: Peak::NONE,
            largest_pocket_force: Peak::NONE,
            largest_land_force: Peak::NONE,
            rises: [
                Rise::through(INNER + 5, 0.5 * speed),
                Rise::through(INNER + 5, 0.95 * speed),
                cage,
            ],
            turns: Periods::until(
                end,
                turn,
                [INNER_MOMENT, OUTER_MOMENT, STEADY_MOMENT, CAGE_SLIP],
                INNER + 5,
            ),
            rows: Rows::new(machine, end, interval, keep_rows),
        }
    }
    /// Means over the last cage turns at a speed of the inner race, rad/s: of those in which the speed stayed within 1 %,
    /// the later half. None where there was no such turn.
    pub fn late_means(&self, speed: f64) -> Option<LateMeans> {
        let near = |value: f64| (value - speed).abs() <= AT_SPEED * speed.abs();
        let at_speed: Vec<_> = (self.turns.whole().rev())
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
    /// Mean cage slip of the last whole cage turn.
    pub fn last_cage_slip(&self) -> Option<f64> {
        self.turns.whole().next_back().map(|turn| turn.means[3])
    }
    /// First instant the inner race reaches half the target speed, s.
    pub fn inner_race_time_to_50_percent(&self) -> Option<f64> {
        self.rises[0].time
    }
    /// First instant the inner race reaches 95 % of the target speed, s.
    pub fn inner_race_time_to_95_percent(&self) -> Option<f64> {
        self.rises[1].time
    }
    /// First instant the cage reaches 95 % of its rolling speed at the target speed, s.
    pub fn cage_time_to_95_percent(&self) -> Option<f64> {
        self.rises[2].time
    }
    /// Number of rows.
    pub fn row_count(&self) -> usize {
        self.rows.count()
    }
    /// The sampled rows.
    pub fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.rows.iter()
    }
    /// Adds the last state of a run as a row, where it is not one already.
    pub fn finish(&mut self, machine: &SpinUpMachine, time: f64, state: &[f64]) {
        let (_, probe) = machine.inspect(time, state);
        self.rows.finish(&Row {
            time,
            state,
            probe: &probe,
            content: machine.content(state),
        });
    }
}

impl Observer<SpinUpMachine> for Record {
    fn step(&mut self, step: &mut Step<SpinUpMachine>) -> Flow {
        for (peak, probe) in [
            (&mut self.inner_moment, INNER_MOMENT),
            (&mut self.outer_moment, OUTER_MOMENT),
            (&mut self.drive_moment, DRIVE_MOMENT),
            (&mut self.largest_inner_load, LARGEST_INNER_LOAD),
            (&mut self.largest_outer_load, LARGEST_OUTER_LOAD),
            (&mut self.largest_pocket_force, LARGEST_POCKET_FORCE),
            (&mut self.largest_land_force, LAND_FORCE),
        ] {
            peak.raise(step.start_probe(probe).abs(), step.start);
            peak.raise(step.end_probe(probe).abs(), step.end);
        }
        for rise in &mut self.rises {
            rise.watch(step);
        }
        self.turns.watch(step);
        self.rows.sample(step, SpinUpMachine::content);
        Flow::Continue
    }
}
