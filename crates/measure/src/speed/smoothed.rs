//! A smoothed record, and the motion at an instant of it.

use super::breakaway::Breakaway;
use super::bridge::Bridge;
use super::motion::{Change, Motion};
use super::smoothness::Smoothness;
use super::stop::Stop;
use super::track::{Track, mixed};
use super::transition::Belief;
use crate::pulse::Gap;
use problem::note::Note;

/// The motion of a shaft over a record, with covariance.
#[derive(Clone, Debug)]
pub struct Speed {
    pub(super) base: Track,
    /// Tracks of the quick change with their weights, and the interval in which they hold, in units.
    pub(super) parts: Vec<(f64, Track)>,
    pub(super) window: (f64, f64),
    /// Factors on the deviations within the quick change.
    pub(super) smoothness: Option<Smoothness>,
    pub(super) origin: f64,
    pub(super) unit: f64,
    pub(super) latency: f64,
    /// How the shaft comes to rest after the last mark, where it does.
    pub(super) stop: Option<Stop>,
    /// What the friction seen there hides of a start from rest.
    pub(super) breakaway: Option<Breakaway>,
    /// Silences of the pickup.
    pub(super) bridges: Vec<Bridge>,
    /// Standard deviation of an order-one error that the calibration may hold, rad.
    pub(super) eccentricity: f64,
    /// The quick change, where there is one.
    pub change: Option<Change>,
    /// Factor on the stated uncertainty of the instants that the pulses themselves ask for.
    pub timing_factor: f64,
    /// What was found, and what should not be trusted.
    pub notes: Vec<Note>,
}

impl Speed {
    /// First and last instant for which there is an answer, s.
    pub fn range(&self) -> (f64, f64) {
        (
            self.origin + self.unit * self.base.begin(),
            self.origin + self.unit * self.base.end(),
        )
    }

    /// Silences of the pickup, in which marks passed unseen.
    pub fn gaps(&self) -> impl Iterator<Item = &Gap> {
        self.bridges.iter().map(|bridge| &bridge.gap)
    }

    /// What is known of the state at an instant, in units.
    fn belief(&self, time: f64) -> Belief {
        if self.parts.is_empty() || time < self.window.0 || time > self.window.1 {
            return self.base.at(time);
        }
        let beliefs: Vec<(f64, Belief)> = (self.parts.iter())
            .map(|(weight, track)| (*weight, track.at(time)))
            .collect();
        mixed(beliefs.iter().copied())
    }

    /// The motion at an instant, s; outside the range of the pulses it is carried on, with growing covariance; before an
    /// engagement from rest it is rest, and after the last mark of a shaft that stops it comes to rest. While the pickup was
    /// silent ([`Speed::gaps`]) it is bounded by what both sides say.
    pub fn at(&self, seconds: f64) -> Motion {
        if let Some(bridge) = self.bridges.iter().find(|bridge| bridge.holds(seconds)) {
            return bridge.at(seconds);
        }
        let motion = self.seen(seconds);
        let motion = self.stop.map_or(motion, |stop| stop.applied(motion));
        let hidden = self.breakaway.as_ref();
        hidden.map_or(motion, |breakaway| breakaway.applied(motion))
    }

    /// The motion that follows from what was seen alone.
    fn seen(&self, seconds: f64) -> Motion {
        let time = (seconds - self.origin) / self.unit;
        let belief = self.belief(time);
        let smoothness = self.smoothness.as_ref();
        let factors = smoothness.map_or([1.0; 3], |smoothness| smoothness.at(time));
        let scale: [f64; 4] = std::array::from_fn(|i| self.unit.powi(-(i as i32)));
        let [angle, speed, acceleration, jerk] = std::array::from_fn(|i| belief.mean[i] * scale[i]);
        let late = [speed, acceleration, jerk].map(|x| x * self.latency);
        let wrong = self.wrong_wheel(speed, acceleration);
        let mut covariance: [[f64; 3]; 3] = std::array::from_fn(|i| {
            let factor = |i: usize| factors[i] * scale[i];
            std::array::from_fn(|j| belief.covariance[(i, j)] * factor(i) * factor(j))
        });
        for (i, row) in covariance.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate() {
                *value += late[i] * late[j] + wrong.iter().map(|w| w[i] * w[j]).sum::<f64>();
            }
        }
        Motion {
            time: seconds,
            angle,
            speed,
            acceleration,
            covariance,
        }
    }

    /// Root mean square uncertainty of the acceleration over an interval, s, as a part of its largest value there.
    pub fn relative_uncertainty(&self, from: f64, to: f64) -> f64 {
        const POINTS: usize = 60;
        let (mut square, mut peak) = (0.0, 0.0f64);
        for k in 0..POINTS {
            let motion = self.at(from + (to - from) * (k as f64 + 0.5) / POINTS as f64);
            square += motion.covariance[2][2] / POINTS as f64;
            peak = peak.max(motion.acceleration.abs());
        }
        square.sqrt() / peak
    }

    /// What the sine and the cosine of an eccentricity taken for wheel errors, each of unit weight, do to angle, speed and
    /// acceleration where their angle is zero: e sin θ and e cos θ with their derivatives.
    fn wrong_wheel(&self, speed: f64, acceleration: f64) -> [[f64; 3]; 2] {
        let e = self.eccentricity;
        [
            [0.0, e * speed, e * acceleration],
            [e, 0.0, -e * speed * speed],
        ]
    }
}
