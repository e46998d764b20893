//! What a shaft's own friction hides of an engagement from rest.
//!
//! ```text
//! δ = |Ω̇_stop| / (j √3)       j = ½ Ω̇_1 / (t_1 - t_e) + ½ Ω̈_1
//! deviation of t_e: δ;  of Ω: Ω̇ δ (1 - x);  of Ω̇: j δ (1 - x);   x = (t - t_e)/(t_1 - t_e) before the first mark t_1
//! ```
//! A clutch whose torque rises must first overcome what brakes the creeping shaft. Marks come later, from a motion that looks
//! as if it had begun later. Where the same record shows the shaft come to rest, its last deceleration shows how much: the
//! rising acceleration j makes up for it within Ω̇_stop/j, and the engagement is anywhere within that time.
//!
//! **Does not model**: a brake at rest that is larger than that of the creeping shaft.

use super::motion::{Change, Motion};
use super::stop::Stop;
use crate::pulse::Pulses;

/// The start of a motion before its first mark.
#[derive(Clone, Copy, Debug)]
pub(super) struct Breakaway {
    /// Instants of the engagement and of the first mark, s.
    engagement: f64,
    first: f64,
    /// Standard deviation of the engagement, s.
    pub deviation: f64,
    /// Slope of the acceleration, rad/s³.
    slope: f64,
}

impl Breakaway {
    /// That of a record from a change out of rest to a stop, given its motion.
    pub fn of(
        pulses: &Pulses,
        change: &Change,
        stop: &Stop,
        motion: impl Fn(f64) -> Motion,
    ) -> Option<Breakaway> {
        let (engagement, first) = (change.engagement.0, pulses.times[0]);
        let (begin, end) = (motion(first), motion(pulses.times[1]));
        let mean = begin.acceleration / (first - engagement);
        let later = (end.acceleration - begin.acceleration) / (end.time - begin.time);
        let slope = 0.5 * (mean + later);
        // A torque that is even from its start hides nothing.
        let deviation = stop.deceleration() / (slope * 3f64.sqrt());
        let rises = slope > 0.0 && deviation.is_finite() && first > engagement;
        rises.then_some(Breakaway {
            engagement,
            first,
            deviation: deviation.min(first - engagement),
            slope,
        })
    }

    /// The motion at an instant with what is hidden of its speed and acceleration.
    pub fn applied(&self, mut motion: Motion) -> Motion {
        let left = (self.first - motion.time) / (self.first - self.engagement);
        if motion.time > self.engagement - self.deviation && left > 0.0 {
            let hidden = self.deviation * left.min(1.0);
            let missed = self.slope * hidden;
            let gained = motion.acceleration.abs().max(missed);
            motion.covariance[1][1] += (gained * hidden).powi(2);
            motion.covariance[2][2] += missed * missed;
        }
        motion
    }
}
