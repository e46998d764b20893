//! What is watched and kept of a rig's run.
//!
//! Rises through a level are found on dense output; largest values are those at the ends of the steps, and the ends of what
//! a clutch does are such ends. Means are taken over cage turns at the target speed. Rows are sampled at equal intervals
//! and at the end. Everything is allocated before the run but the changes of the clutch.

use super::layout::{
    ACCELERATION, CAGE_SLIP, DRIVE_MOMENT, INNER_MOMENT, LAND_FORCE, LARGEST_INNER_LOAD,
    LARGEST_OUTER_LOAD, LARGEST_POCKET_FORCE, LARGEST_SKIDS, OUTER_MOMENT, STEADY_MOMENT,
    TEMPERATURE,
};
use super::machine::RigMachine;
use super::mode::{Clutch, ClutchEvent, Mode};
use super::taps::{Tap, Taps};
use crate::bearing::BearingConstants;
use crate::system::cage_turns::CageTurns;
pub use crate::system::cage_turns::LateMeans;
use crate::system::race_record::RaceRecord;
use crate::system::sampling::{Peak, Rise, Row, Rows};
use solve::{Flow, Machine, Observer, Step};

/// What is kept of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Keep<'a> {
    /// End of the run, s.
    pub end: f64,
    /// Interval of the rows, s; none where no rows are kept.
    pub interval: Option<f64>,
    /// What a converter samples.
    pub taps: &'a [Tap],
}

impl Keep<'_> {
    /// Rows of a run until an end, s, at an interval, s.
    pub fn rows(end: f64, interval: f64) -> Self {
        Keep {
            end,
            interval: Some(interval),
            taps: &[],
        }
    }
    /// The largest values of a run until an end, s.
    pub fn peaks(end: f64) -> Self {
        Keep {
            interval: None,
            ..Keep::rows(end, end)
        }
    }
}

/// Everything kept of one rig.
#[derive(Clone, Debug)]
pub struct Record {
    /// Largest acceleration of the inner race in the direction of the target speed, rad/s².
    pub acceleration: Peak,
    /// Largest acceleration of the inner race against that direction, rad/s²; its size.
    pub deceleration: Peak,
    /// Largest size of the moment t_I that resists the inner race, N m.
    pub inner_moment: Peak,
    /// Largest size of the moment t_O on the outer race, N m.
    pub outer_moment: Peak,
    /// Largest size of the moment of the drive, of a clutch its torque, N m.
    pub drive_moment: Peak,
    /// Largest ball load at the inner race, N.
    pub largest_inner_load: Peak,
    /// Largest ball load at the outer race, N.
    pub largest_outer_load: Peak,
    /// Largest force between a ball and its pocket, or between two balls without a cage, N.
    pub largest_pocket_force: Peak,
    /// Largest force between cage and land, N.
    pub largest_land_force: Peak,
    /// Largest rise of the bearing's temperature, K.
    pub temperature: Peak,
    /// What the clutch did, in order; the first entry is how it started.
    pub clutch: Vec<ClutchEvent>,
    /// The mode that the run has come to.
    pub mode: Mode<f64>,
    /// What the converter sampled.
    pub taps: Taps,
    /// Of the inner race through 50 % and 95 % of the target speed, of the cage through 95 % of its rolling speed then.
    rises: [Rise; 3],
    turns: CageTurns,
    /// What the races have seen of their balls.
    pub races: RaceRecord,
    rows: Rows,
    /// Direction of the target speed.
    forward: f64,
}

/// Changes of the clutch for which room is made before a run.
const CHANGES: usize = 64;

impl Record {
    /// An empty record.
    pub fn new(machine: &RigMachine, keep: &Keep) -> Self {
        let c = &machine.constants;
        let speed = c.target_speed;
        let rolling = c.bearing.rolling_cage_ratio() * speed;
        let layout = machine.layout();
        let race = layout.race.spin();
        let cage = match &c.bearing {
            // where balls roll the cage follows the race
            BearingConstants::Rolling(_) => Rise::through(race, 0.95 * speed),
            BearingConstants::Planar(_) => {
                Rise::through(layout.bearing().start + 1, 0.95 * rolling)
            }
        };
        let mode = machine.start_mode();
        let mut clutch = Vec::with_capacity(CHANGES);
        clutch.push(ClutchEvent {
            time: 0.0,
            clutch: mode.clutch.state,
            speed: c.start_speed(),
        });
        Record {
            acceleration: Peak::NONE,
            deceleration: Peak::NONE,
            inner_moment: Peak::NONE,
            outer_moment: Peak::NONE,
            drive_moment: Peak::NONE,
            largest_inner_load: Peak::NONE,
            largest_outer_load: Peak::NONE,
            largest_pocket_force: Peak::NONE,
            largest_land_force: Peak::NONE,
            temperature: Peak::NONE,
            clutch,
            mode,
            taps: Taps::new(keep.taps, keep.end),
            rises: [
                Rise::through(race, 0.5 * speed),
                Rise::through(race, 0.95 * speed),
                cage,
            ],
            turns: CageTurns::until(
                keep.end,
                rolling,
                [INNER_MOMENT, OUTER_MOMENT, STEADY_MOMENT, CAGE_SLIP],
                race,
            ),
            races: RaceRecord::new(machine.constants.bearing.balls(), speed),
            rows: Rows::new(
                machine,
                keep.end,
                keep.interval.unwrap_or(f64::INFINITY),
                keep.interval.is_some(),
            ),
            forward: 1.0_f64.copysign(speed),
        }
    }
    /// First instant at which the clutch locked, s.
    pub fn locked_at(&self) -> Option<f64> {
        self.locks().next()
    }
    /// Instants at which the clutch locked, s.
    pub fn locks(&self) -> impl Iterator<Item = f64> {
        (self.clutch.iter())
            .filter(|event| event.clutch == Clutch::Locked)
            .map(|event| event.time)
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
    pub fn time_to_50_percent(&self) -> Option<f64> {
        self.rises[0].time
    }
    /// First instant the inner race reaches 95 % of the target speed, s.
    pub fn time_to_95_percent(&self) -> Option<f64> {
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
    pub fn rows(&self) -> impl DoubleEndedIterator<Item = Row<'_>> {
        self.rows.iter()
    }
    /// Adds the last state of a run as a row, where it is not one already.
    pub fn finish(&mut self, machine: &RigMachine, time: f64, state: &[f64]) {
        let probe = machine.last_probes(&self.mode, time, state);
        self.rows.finish(&Row {
            time,
            state,
            probe: &probe,
            content: machine.content(state),
        });
    }
}

impl Observer<RigMachine> for Record {
    fn step(&mut self, step: &mut Step<RigMachine>) -> Flow {
        for (peak, sign) in [
            (&mut self.acceleration, self.forward),
            (&mut self.deceleration, -self.forward),
        ] {
            peak.raise(sign * step.start_probe(ACCELERATION), step.start);
            peak.raise(sign * step.end_probe(ACCELERATION), step.end);
        }
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
        if step.machine.layout().housing {
            self.temperature
                .raise(step.end_state(TEMPERATURE), step.end);
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
        (self.races).watch(step, bearing, |state| machine.layout().motion(state));
        self.taps.sample(step);
        self.rows.sample(step, |rig, state| rig.content(state));
        Flow::Continue
    }
    fn switched(&mut self, rig: &RigMachine, mode: &Mode<f64>, time: f64, state: &[f64]) -> Flow {
        if mode.clutch.state != self.mode.clutch.state {
            self.clutch.push(ClutchEvent {
                time,
                clutch: mode.clutch.state,
                speed: state[rig.layout().race.spin()],
            });
        }
        self.mode = *mode;
        Flow::Continue
    }
}
