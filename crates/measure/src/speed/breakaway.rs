//! What a shaft's own friction hides of an engagement from rest.
//!
//! ```text
//! δ = |Ω̇_stop| / (j √3)       j = ½ Ω̇_1 / (t_1 - t_e) + ½ Ω̈_1
//! deviation of t_e: δ;  of Ω: Ω̇ δ (1 - x);  of Ω̇: j δ (1 - x);   x = (t - t_e)/(t_1 - t_e) before the first mark t_1
//! ```
//! A clutch whose torque rises must first overcome what brakes the creeping shaft. Marks come later, from a motion that looks
//! as if it had begun later. Where the same record shows the shaft come to rest, its last deceleration tells how much: the
//! rising acceleration j makes up for it within Ω̇_stop/j, and the engagement is anywhere within that time.
//!
//! **Does not model**: a brake at rest that is larger than that of the creeping shaft.

use super::{Motion, Speed};
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
    /// That of a record from rest to rest.
    pub fn of(pulses: &Pulses, speed: &Speed) -> Option<Breakaway> {
        let stop = speed.stop.as_ref()?;
        let change = speed.change.filter(|change| change.from_rest)?;
        let (engagement, first) = (change.engagement.0, pulses.times[0]);
        let (begin, end) = (speed.at(first), speed.at(pulses.times[1]));
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

    /// Deviations of angle, speed and acceleration at an instant, s, that the pulses do not tell of, given the acceleration.
    pub fn hidden(&self, time: f64, acceleration: impl FnOnce() -> f64) -> [f64; 3] {
        let left = (self.first - time) / (self.first - self.engagement);
        if time <= self.engagement - self.deviation || left <= 0.0 {
            return [0.0; 3];
        }
        let hidden = self.deviation * left.min(1.0);
        let gained = acceleration().abs().max(self.slope * hidden);
        [0.0, gained * hidden, self.slope * hidden]
    }

    /// The motion at an instant with what is hidden of it.
    pub fn applied(&self, mut motion: Motion) -> Motion {
        let acceleration = motion.acceleration;
        let hidden = self.hidden(motion.time, || acceleration);
        for (i, deviation) in hidden.into_iter().enumerate() {
            motion.covariance[i][i] += deviation * deviation;
        }
        motion
    }
}
