//! The motion at an instant of a smoothed record.

use super::node::Belief;
use super::track::mixed;
use super::{Motion, Speed};
use crate::pulse::Gap;

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

    /// The belief at an instant, in units: a mixture of the tracks of the quick change within their window, of the whole record else.
    fn belief(&self, time: f64) -> Belief {
        let inside = time >= self.window.0 && time <= self.window.1 && !self.parts.is_empty();
        if !inside {
            return self.base.at(time);
        }
        let beliefs: Vec<(f64, Belief)> = (self.parts.iter())
            .map(|(weight, track)| (*weight, track.at(time)))
            .collect();
        mixed(beliefs.iter().copied())
    }

    /// Factors on the deviations of angle, speed and acceleration at an instant, in units.
    fn factors(&self, time: f64) -> [f64; 3] {
        let smoothness = self.smoothness.as_ref();
        smoothness.map_or([1.0; 3], |smoothness| smoothness.at(time))
    }

    /// The motion at an instant, s; outside the range of the pulses it is carried on, with growing covariance; before an
    /// engagement from rest it is rest, and after the last mark of a shaft that stops it comes to rest. While the pickup was
    /// silent ([`Speed::gaps`]) it is bounded by what both sides say.
    pub fn at(&self, seconds: f64) -> Motion {
        if let Some(bridge) = self.bridges.iter().find(|bridge| bridge.holds(seconds)) {
            return bridge.at(seconds);
        }
        let motion = self.between_pulses(seconds);
        let motion = self.stop.map_or(motion, |stop| stop.applied(motion));
        let hidden = self.breakaway.as_ref();
        hidden.map_or(motion, |breakaway| breakaway.applied(motion))
    }

    /// The motion that follows from the pulses alone.
    fn between_pulses(&self, seconds: f64) -> Motion {
        let time = (seconds - self.origin) / self.unit;
        let (belief, factors) = (self.belief(time), self.factors(time));
        let rate = self.unit.recip();
        let scale = [1.0, rate, rate.powi(2), rate.powi(3)];
        let [angle, speed, acceleration, jerk] = std::array::from_fn(|i| belief.mean[i] * scale[i]);
        let late = [speed, acceleration, jerk].map(|x| x * self.latency);
        let wrong = self.wrong_wheel(speed, acceleration);
        let known: [[f64; 3]; 3] = std::array::from_fn(|i| {
            let factor = |i: usize| factors[i] * scale[i];
            std::array::from_fn(|j| belief.covariance[i][j] * factor(i) * factor(j))
        });
        let least = |order: usize| {
            let stiffest = self.stiffest.as_ref().filter(|_| order > 0);
            stiffest.map_or(0.0, |stiffest| stiffest.variance(order as i32, seconds))
        };
        Motion {
            time: seconds,
            angle,
            speed,
            acceleration,
            covariance: std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    let wheel: f64 = wrong.iter().map(|w| w[i] * w[j]).sum();
                    let known = if i == j {
                        known[i][j].max(least(i))
                    } else {
                        known[i][j]
                    };
                    known + late[i] * late[j] + wheel
                })
            }),
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
    /// acceleration, counted from the angle there: e sin θ and e cos θ with their derivatives at θ = 0.
    fn wrong_wheel(&self, speed: f64, acceleration: f64) -> [[f64; 3]; 2] {
        let e = self.eccentricity;
        [
            [0.0, e * speed, e * acceleration],
            [e, 0.0, -e * speed * speed],
        ]
    }
}
