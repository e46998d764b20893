//! What is kept of the mount of an auxiliary bearing.

use super::{BearingRecord, NEAR_RECORD};
use crate::system::machine::RotorMachine;
use crate::system::sampling::Peak;
use number::Vec2;
use solve::Step;

/// Largest values of the parts of a mount.
#[derive(Clone, Copy, Debug)]
pub struct MountPeaks {
    /// Force of the friction ring, N.
    pub ring: Peak,
    /// Force of the squeeze film, N.
    pub film: Peak,
    /// Force of the hard stop, N.
    pub stop: Peak,
    /// Displacement of the housing, m.
    pub housing_displacement: Peak,
    /// Speed of the housing, m/s.
    pub housing_speed: Peak,
    /// When the stop is hit first, s: at the end of the step in which that is so.
    pub first_stop: Option<f64>,
}

impl MountPeaks {
    /// Nothing yet.
    pub const NONE: MountPeaks = MountPeaks {
        ring: Peak::NONE,
        film: Peak::NONE,
        stop: Peak::NONE,
        housing_displacement: Peak::NONE,
        housing_speed: Peak::NONE,
        first_stop: None,
    };

    /// Takes what is larger at an instant, and says whether something comes near to its record.
    fn raise(&mut self, machine: &RotorMachine, k: usize, state: &[f64], time: f64) -> bool {
        let (at, mount) = (
            &machine.layout().bearings[k],
            &machine.one.bearings[k].mount,
        );
        let [position, velocity] = machine.ground(k, state);
        let outer = at.outer.motion(state);
        let motion = (outer.position - position, outer.velocity - velocity);
        let parts = mount.parts(motion, &state[at.of_mount()]);
        let [displacement, speed] = parts.housing;
        let records = [
            (&mut self.ring, parts.ring),
            (&mut self.film, parts.film),
            (&mut self.stop, parts.stop),
            (&mut self.housing_displacement, displacement),
            (&mut self.housing_speed, speed),
        ];
        let mut near = false;
        for (record, vector) in records {
            let size = vector.length_squared().sqrt();
            near |= size > NEAR_RECORD * record.value && size > 0.0;
            record.raise(size, time);
        }
        if self.stop.value > 0.0 {
            self.first_stop.get_or_insert(time);
        }
        near
    }
}

impl BearingRecord {
    pub(in super::super) fn mount_of(&mut self, step: &mut Step<RotorMachine>) {
        self.mount_parts_of(step);
        if step.machine.one.stands[self.bearing].is_some() {
            return self.mount_on_housing(step);
        }
        let outer = self.at.outer;
        let pair = |at: [usize; 2], value: &dyn Fn(usize) -> f64| {
            let [x, y] = at.map(value);
            Vec2::new(x, y)
        };
        let end = |channel: usize| step.end_state(channel);
        let start = |channel: usize| step.start_state(channel);
        let place = pair(outer.centre(), &end);
        let record = self.mount_displacement.value;
        if place.length_squared() < (NEAR_RECORD * record).powi(2) {
            return;
        }
        let outward = (
            pair(outer.centre(), &start).dot(pair(outer.velocity(), &start)),
            place.dot(pair(outer.velocity(), &end)),
        );
        self.mount_displacement
            .raise(place.length_squared().sqrt(), step.end);
        if outward.0 > 0.0 && outward.1 < 0.0 {
            for i in 1..8 {
                let theta = f64::from(i) / 8.0;
                let time = step.time(theta);
                let state = step.leading_state(theta, outer.channels().end);
                let [x, y] = outer.centre();
                self.mount_displacement
                    .raise(state[x].hypot(state[y]), time);
            }
        }
    }

    /// The outer race against the housing that its mount stands on, at the end of a step.
    fn mount_on_housing(&mut self, step: &mut Step<RotorMachine>) {
        let (machine, end) = (step.machine, step.end);
        let state = step.leading_state(1.0, self.at.outer.channels().end);
        let [ground, _] = machine.ground(self.bearing, state);
        let away = self.at.outer.motion(state).position - ground;
        self.mount_displacement
            .raise(away.length_squared().sqrt(), end);
    }

    /// The parts of the mount at the end of a step, and between where one of them comes near to its record.
    fn mount_parts_of(&mut self, step: &mut Step<RotorMachine>) {
        let Some(peaks) = &mut self.mount_parts else {
            return;
        };
        let machine = step.machine;
        let end = step.end;
        if peaks.raise(machine, self.bearing, step.state(1.0), end) {
            for theta in [0.25, 0.5, 0.75] {
                let time = step.time(theta);
                peaks.raise(machine, self.bearing, step.state(theta), time);
            }
        }
    }
}
