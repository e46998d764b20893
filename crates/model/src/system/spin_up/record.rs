//! What is watched and kept of a spin-up.
//!
//! Rises through a level are found on dense output; largest values are those at the ends of the steps. Means are taken
//! over cage turns at the target speed. Rows are sampled at equal intervals and at the end.
//! Everything is allocated before the run.

use super::SpinUpMachine;
use super::layout::{
    BEARING, CAGE_SLIP, DRIVE_MOMENT, INNER, INNER_MOMENT, LAND_FORCE, LARGEST_INNER_LOAD,
    LARGEST_OUTER_LOAD, LARGEST_POCKET_FORCE, LARGEST_SKIDS, OUTER_MOMENT, STEADY_MOMENT,
};
use super::rate::race_motion;
use crate::bearing::BearingConstants;
use crate::system::cage_turns::CageTurns;
pub use crate::system::cage_turns::LateMeans;
use crate::system::race_record::RaceRecord;
use crate::system::sampling::{Peak, Rise, Row, Rows};
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
    turns: CageTurns,
    /// What the races have seen of their balls.
    pub races: RaceRecord,
    rows: Rows,
}

impl Record {
    /// A record for a run until `end`, with a row every `interval`, or without rows.
    pub fn new(machine: &SpinUpMachine, end: f64, interval: f64, keep_rows: bool) -> Self {
        let c = &machine.constants;
        let speed = c.target_speed;
        let cage = match &c.bearing {
            // where balls roll the cage follows the race
            BearingConstants::Rolling(_) => Rise::through(INNER.spin(), 0.95 * speed),
            BearingConstants::Planar(_) => {
                let rolling = c.bearing.rolling_cage_ratio() * speed;
                Rise::through(BEARING + 1, 0.95 * rolling)
            }
        };
        Record {
            inner_moment: Peak::NONE,
            outer_moment: Peak::NONE,
            drive_moment: Peak::NONE,
            largest_inner_load: Peak::NONE,
            largest_outer_load: Peak::NONE,
            largest_pocket_force: Peak::NONE,
            largest_land_force: Peak::NONE,
            rises: [
                Rise::through(INNER.spin(), 0.5 * speed),
                Rise::through(INNER.spin(), 0.95 * speed),
                cage,
            ],
            turns: CageTurns::until(
                end,
                c.bearing.rolling_cage_ratio() * speed,
                [INNER_MOMENT, OUTER_MOMENT, STEADY_MOMENT, CAGE_SLIP],
                INNER.spin(),
            ),
            races: RaceRecord::new(machine.constants.bearing.balls(), speed),
            rows: Rows::new(machine, end, interval, keep_rows),
        }
    }
    /// Means over the last cage turns at a speed of the inner race, rad/s; see [`CageTurns::late_means`].
    pub fn late_means(&self, speed: f64) -> Option<LateMeans> {
        self.turns.late_means(speed)
    }
    /// Mean cage slip of the last whole cage turn.
    pub fn last_cage_slip(&self) -> Option<f64> {
        self.turns.last_cage_slip()
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
        let machine = step.machine;
        let bearing = (
            &machine.constants.bearing,
            machine.layout().bearing(),
            [LARGEST_INNER_LOAD, LARGEST_SKIDS],
        );
        self.races.watch(step, bearing, race_motion);
        self.rows.sample(step, SpinUpMachine::content);
        Flow::Continue
    }
}
