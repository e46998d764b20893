//! A shaft that comes to rest after its last mark, or after the last instant at which a channel shows it turn.
//!
//! ```text
//! seen      no mark for longer than three intervals, by a shaft whose brake would stop it before the next mark
//! between   Ω(t) = Ω_n (1 - x),  x = (t - t_n)/T,  T = Ω_n/|Ω̇_n|;   rest from x = 1 on
//! deviation of Ω:  Ω_n/√12 · min(y², e^(1-y)),  y = (t - t_(n-1))/(t_n + T - t_(n-1));   of Ω̇:  |Ω̇_n|/2 · min(y, e^(1-y))
//! ```
//! The pulses end before the shaft does, and friction changes most where it creeps. What is known is that the speed falls from
//! that at the last mark to none without one more mark: the deviation is that of a value anywhere between where the shaft
//! should stop, and dies away behind it as a creeping shaft does.
//!
//! **Does not model**: a shaft that rocks back at its stop.

use super::motion::Motion;
use crate::pulse::Pulses;

/// The last mark of a shaft that comes to rest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stop {
    /// Instant of the last but one mark, s.
    before: f64,
    /// Motion at the last mark.
    last: Motion,
    /// Time from there to rest, s.
    length: f64,
}

/// Intervals without a mark after which a mark is missed.
const SILENCE: f64 = 3.0;

/// Least speed at the last mark, as a part of the mean one since the mark before.
const SLOWEST: f64 = 0.1;

impl Stop {
    /// The stop of a record, where it has one, given its motion.
    pub fn of(pulses: &Pulses, motion: impl Fn(f64) -> Motion) -> Option<Stop> {
        let n = pulses.times.len();
        let (before, end) = (pulses.times[n.checked_sub(2)?], pulses.times[n - 1]);
        let mut last = motion(end);
        // A shaft that creeps over its last mark may seem to turn back there by what the noise leaves.
        let mean = pulses.pitch() / (end - before);
        last.speed = last.speed.max(SLOWEST * mean);
        let length = -last.speed / last.acceleration;
        let brakes = last.speed > 0.0 && length.is_finite() && length > 0.0;
        let stops_before_the_next_mark = 0.5 * last.speed * length < 1.5 * pulses.pitch();
        let silent = pulses.watched.1 - end > SILENCE * (end - before);
        (brakes && stops_before_the_next_mark && silent).then_some(Stop {
            before,
            last,
            length,
        })
    }

    /// The stop of a shaft that a channel shows at rest behind the `last` motion of a record, until the end of what was watched,
    /// s; `before` is the instant before the last one.
    pub fn seen(before: f64, mut last: Motion, watched: f64) -> Option<Stop> {
        // What noise leaves of the last speed may turn back, or not brake.
        last.speed = last.speed.max(0.0);
        let brakes = last.speed > 0.0 && last.acceleration < 0.0;
        let length = match brakes {
            true => (-last.speed / last.acceleration).min(watched - last.time),
            false => last.time - before,
        };
        (length > 0.0).then_some(Stop {
            before,
            last,
            length,
        })
    }

    /// Deceleration at the last mark, rad/s².
    pub fn deceleration(&self) -> f64 {
        -self.last.acceleration
    }

    /// Deviations of angle, speed and acceleration that the pulses do not show, at an instant behind the last but one mark, s.
    fn hidden(&self, time: f64) -> [f64; 3] {
        let y = (time - self.before) / (self.last.time + self.length - self.before);
        let behind = (1.0 - y).exp();
        [
            0.0,
            self.last.speed / 12f64.sqrt() * (y * y).min(behind),
            0.5 * self.last.acceleration.abs() * y.min(behind),
        ]
    }

    /// The motion at an instant, s, given what the pulses alone say of it.
    pub fn applied(&self, mut motion: Motion) -> Motion {
        let since_last = motion.time - self.last.time;
        if motion.time <= self.before {
            return motion;
        }
        motion.speed = motion.speed.max(0.0);
        if since_last > 0.0 {
            let turning = since_last.min(self.length);
            let left = 1.0 - turning / self.length;
            motion.angle = self.last.angle + self.last.speed * turning * 0.5 * (1.0 + left);
            motion.speed = self.last.speed * left;
            motion.acceleration = if left > 0.0 {
                self.last.acceleration
            } else {
                0.0
            };
            // What was open at the last mark fades as the shaft comes to rest, but for the angle.
            let fades = [1.0, left, left];
            for (i, fade) in fades.into_iter().enumerate() {
                for (j, other) in fades.into_iter().enumerate() {
                    motion.covariance[i][j] = self.last.covariance[i][j] * fade * other;
                }
            }
        }
        for (i, deviation) in self.hidden(motion.time).into_iter().enumerate() {
            motion.covariance[i][i] += deviation * deviation;
        }
        motion
    }
}
