//! What is watched of a rig besides its bearing.
//!
//! Largest values are those at the ends of the steps, and the ends of what a clutch does are such ends. Means are taken over cage
//! turns at the speed that counts as reached. Everything is allocated before the run but the changes of the clutch.

use super::layout::{
    ACCELERATION, CAGE_SLIP, DRIVE_MOMENT, INNER_MOMENT, OUTER_MOMENT, STEADY_MOMENT, TEMPERATURE,
};
use super::mode::{Clutch, ClutchEvent};
use super::taps::{Tap, Taps};
use crate::system::cage_turns::CageTurns;
use crate::system::machine::{Mode, RotorMachine};
use crate::system::sampling::Peak;
use solve::{Machine, Step};

/// Everything kept of a rig besides its bearing.
#[derive(Clone, Debug)]
pub struct RigRecord {
    /// Largest acceleration of the inner race in the direction of the speed that counts as reached, rad/s².
    pub acceleration: Peak,
    /// Largest acceleration of the inner race against that direction, rad/s²; its size.
    pub deceleration: Peak,
    /// Largest size of the moment t_I that resists the inner race, N m.
    pub inner_moment: Peak,
    /// Largest size of the moment t_O on the outer race, N m.
    pub outer_moment: Peak,
    /// Largest size of the moment of the drive, of a clutch its torque, N m.
    pub drive_moment: Peak,
    /// Largest rise of the bearing's temperature, K.
    pub temperature: Peak,
    /// What the clutch did, in order; the first entry is how it started.
    pub clutch: Vec<ClutchEvent>,
    /// The mode that the run has come to.
    pub mode: Mode<f64>,
    /// What the converter sampled.
    pub taps: Taps,
    /// What happens in each turn of the cage.
    pub turns: CageTurns,
    /// Direction of the speed that counts as reached.
    forward: f64,
    housed: bool,
}

/// Changes of the clutch for which room is made before a run.
const CHANGES: usize = 64;

impl RigRecord {
    /// An empty record of a run until an end, s; none of another machine.
    pub(in crate::system) fn new(machine: &RotorMachine, end: f64, taps: &[Tap]) -> Option<Self> {
        let fixture = machine.fixture()?;
        let (part, at) = (&machine.constants.bearings[0], machine.layout().bearings[0]);
        let speed = machine.constants.speed;
        let mode = machine.start_mode();
        let mut clutch = Vec::with_capacity(CHANGES);
        clutch.push(ClutchEvent {
            time: 0.0,
            clutch: mode.clutch.state,
            speed: fixture.drive.race_speed(),
        });
        Some(RigRecord {
            acceleration: Peak::NONE,
            deceleration: Peak::NONE,
            inner_moment: Peak::NONE,
            outer_moment: Peak::NONE,
            drive_moment: Peak::NONE,
            temperature: Peak::NONE,
            clutch,
            mode,
            taps: Taps::new(taps, end),
            turns: CageTurns::until(
                end,
                part.bearing.rolling_cage_ratio() * speed,
                [INNER_MOMENT, OUTER_MOMENT, STEADY_MOMENT, CAGE_SLIP],
                at.inner.spin(),
            ),
            forward: 1.0_f64.copysign(speed),
            housed: fixture.housing.is_some(),
        })
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
    pub(in crate::system) fn step(&mut self, step: &mut Step<RotorMachine>) {
        for (peak, sign) in [
            (&mut self.acceleration, self.forward),
            (&mut self.deceleration, -self.forward),
        ] {
            peak.raise(sign * step.start_probe(ACCELERATION), step.start);
            peak.raise(sign * step.end_probe(ACCELERATION), step.end);
        }
        self.inner_moment.raise_at_ends(step, INNER_MOMENT);
        self.outer_moment.raise_at_ends(step, OUTER_MOMENT);
        self.drive_moment.raise_at_ends(step, DRIVE_MOMENT);
        if self.housed {
            let rise = step.end_state(TEMPERATURE);
            self.temperature.raise(rise, step.end);
        }
        self.turns.watch(step);
        self.taps.sample(step);
    }
    pub(in crate::system) fn switched(&mut self, mode: &Mode<f64>, time: f64, speed: f64) {
        if mode.clutch.state != self.mode.clutch.state {
            self.clutch.push(ClutchEvent {
                time,
                clutch: mode.clutch.state,
                speed,
            });
        }
        self.mode = *mode;
    }
}
