//! What is asked of a smoothed record: the motion at an instant, covariance between instants, paths at random.

use super::matrix::{Matrix, N};
use super::track::{Belief, Track, mixed};
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

    /// The tracks that hold at an instant, in units, with their weights.
    fn tracks(&self, time: f64) -> Vec<(f64, &Track)> {
        if time >= self.window.0 && time <= self.window.1 && !self.parts.is_empty() {
            self.parts
                .iter()
                .map(|(weight, track)| (*weight, track))
                .collect()
        } else {
            vec![(1.0, &self.base)]
        }
    }

    fn belief(&self, time: f64) -> Belief {
        let beliefs: Vec<(f64, Belief)> = self
            .tracks(time)
            .iter()
            .map(|(w, track)| (*w, at(track, time)))
            .collect();
        mixed(beliefs.iter().copied())
    }

    /// Factors on the deviations of angle, speed and acceleration at an instant, in units.
    fn factors(&self, time: f64) -> [f64; 3] {
        let smoothness = self.smoothness.as_ref();
        smoothness.map_or([1.0; 3], |smoothness| smoothness.at(time))
    }

    /// Angle, speed, acceleration and jerk of a path at an instant, in units, so far from the mean as the factors say.
    fn scaled(&self, time: f64, path: [f64; 4]) -> [f64; 4] {
        let factors = self.factors(time);
        if factors == [1.0; 3] {
            return path;
        }
        let mean = self.belief(time).mean;
        std::array::from_fn(|i| match factors.get(i) {
            Some(factor) => mean[i] + factor * (path[i] - mean[i]),
            None => path[i],
        })
    }

    /// Units of angle, speed, acceleration and jerk.
    fn scale(&self) -> [f64; 4] {
        [
            1.0,
            self.unit.recip(),
            self.unit.powi(-2),
            self.unit.powi(-3),
        ]
    }

    /// The motion at an instant, s; outside the range of the pulses it is carried on, with growing covariance; before an
    /// engagement from rest it is rest, and after the last mark of a shaft that stops it comes to rest. While the pickup was
    /// silent ([`Speed::gaps`]) it is bounded by what both sides say.
    pub fn at(&self, seconds: f64) -> Motion {
        if let Some(bridge) = self.bridges.iter().find(|bridge| bridge.holds(seconds)) {
            return bridge.at(seconds);
        }
        let time = (seconds - self.origin) / self.unit;
        let (belief, factors) = (self.belief(time), self.factors(time));
        let scale = self.scale();
        let [angle, speed, acceleration, jerk] = std::array::from_fn(|i| belief.mean[i] * scale[i]);
        let late = [speed, acceleration, jerk].map(|x| x * self.latency);
        let wrong = self.wrong_wheel(0.0, speed, acceleration);
        let mut known: [[f64; 3]; 3] = std::array::from_fn(|i| {
            let factor = |i: usize| factors[i] * scale[i];
            std::array::from_fn(|j| belief.covariance[i][j] * factor(i) * factor(j))
        });
        if let Some(stiffest) = &self.stiffest {
            for order in [1, 2] {
                let variance = &mut known[order][order];
                *variance = variance.max(stiffest.variance(order as i32, seconds));
            }
        }
        let motion = Motion {
            time: seconds,
            angle,
            speed,
            acceleration,
            covariance: std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    let wheel: f64 = wrong.iter().map(|w| w[i] * w[j]).sum();
                    known[i][j] + late[i] * late[j] + wheel
                })
            }),
        };
        let motion = self.stop.map_or(motion, |stop| stop.applied(motion));
        let hidden = self.breakaway.as_ref();
        hidden.map_or(motion, |breakaway| breakaway.applied(motion))
    }

    /// Covariance of angle, speed and acceleration at one instant (rows) with those at another (columns), s.
    ///
    /// Within a quick change, and outside it, all that is unknown takes part; between an instant inside and one outside, the
    /// knots count as known.
    pub fn covariance(&self, first: f64, second: f64) -> [[f64; 3]; 3] {
        if second < first {
            let other = self.covariance(second, first);
            return std::array::from_fn(|i| std::array::from_fn(|j| other[j][i]));
        }
        let times = [first, second].map(|t| (t - self.origin) / self.unit);
        let inside = times
            .iter()
            .all(|&t| t >= self.window.0 && t <= self.window.1);
        let tracks = if inside {
            self.tracks(times[0])
        } else {
            vec![(1.0, &self.base)]
        };
        let parts: Vec<_> = tracks
            .iter()
            .map(|(w, track)| (*w, times.map(|t| at(track, t)), between(track, times)))
            .collect();
        let mean: [[f64; 3]; 2] = std::array::from_fn(|k| {
            std::array::from_fn(|i| parts.iter().map(|p| p.0 * p.1[k].mean[i]).sum())
        });
        let jerk: [f64; 2] =
            std::array::from_fn(|k| parts.iter().map(|p| p.0 * p.1[k].mean[3]).sum());
        let scale = self.scale();
        let late = [0, 1].map(|k| {
            [
                mean[k][1] * scale[1],
                mean[k][2] * scale[2],
                jerk[k] * scale[3],
            ]
            .map(|x| x * self.latency)
        });
        let factors = times.map(|time| self.factors(time));
        let wrong = [0, 1].map(|k| {
            self.wrong_wheel(
                mean[k][0] - mean[0][0],
                mean[k][1] * scale[1],
                mean[k][2] * scale[2],
            )
        });
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let own: f64 = parts
                    .iter()
                    .map(|p| {
                        p.0 * (p.2[i][j]
                            + (p.1[0].mean[i] - mean[0][i]) * (p.1[1].mean[j] - mean[1][j]))
                    })
                    .sum();
                let wheel: f64 = (0..2).map(|w| wrong[0][w][i] * wrong[1][w][j]).sum();
                own * factors[0][i] * scale[i] * factors[1][j] * scale[j]
                    + late[0][i] * late[1][j]
                    + wheel
            })
        })
    }

    /// A motion drawn at random from all that the pulses leave open: angle, speed and acceleration at increasing instants, s.
    ///
    /// `uniform` from 0 to 1 picks the knots; `normal` gives independent standard normal numbers. All instants within the
    /// quick change or all anywhere: then the knots count as known. Instants before the first pulse, or before an
    /// engagement from rest, are at its state.
    pub fn draw(
        &self,
        times: &[f64],
        uniform: f64,
        normal: &mut dyn FnMut() -> f64,
    ) -> Vec<[f64; 3]> {
        let units: Vec<f64> = times
            .iter()
            .map(|t| (t - self.origin) / self.unit)
            .collect();
        let inside = units
            .iter()
            .all(|&t| t >= self.window.0 && t <= self.window.1);
        let mut left = uniform;
        let part = self.parts.iter().find(|(weight, _)| {
            left -= weight;
            left <= 0.0
        });
        let track = match part.or(self.parts.last()) {
            Some((_, track)) if inside => track,
            _ => &self.base,
        };
        let begin = track.begin();
        let clamped: Vec<f64> = units.iter().map(|t| t.max(begin)).collect();
        let path = track.draw(&clamped, normal);
        let (delay, sine, cosine) = (normal() * self.latency, normal(), normal());
        let scale = self.scale();
        let origin = path.first().map_or(0.0, |x| x[0]);
        units
            .iter()
            .zip(&path)
            .map(|(&t, x)| {
                let rest = if t < begin {
                    [x[0], 0.0, 0.0, 0.0]
                } else {
                    [x[0], x[1], x[2], x[3]]
                };
                let rest = if inside { self.scaled(t, rest) } else { rest };
                let [angle, speed, acceleration, jerk] =
                    std::array::from_fn(|i| rest[i] * scale[i]);
                let late = [speed, acceleration, jerk].map(|v| v * delay);
                let wrong = self.wrong_wheel(angle - origin, speed, acceleration);
                let now = [angle, speed, acceleration];
                std::array::from_fn(|i| {
                    now[i] + late[i] + sine * wrong[0][i] + cosine * wrong[1][i]
                })
            })
            .collect()
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
    /// acceleration at an angle from where they are counted: e sin θ and e cos θ with their derivatives.
    fn wrong_wheel(&self, angle: f64, speed: f64, acceleration: f64) -> [[f64; 3]; 2] {
        let (e, (sine, cosine)) = (self.eccentricity, angle.sin_cos());
        let of = |value: f64, slope: f64| {
            [
                e * value,
                e * slope * speed,
                e * (slope * acceleration - value * speed * speed),
            ]
        };
        [of(sine, cosine), of(cosine, -sine)]
    }
}

/// Covariance of the states of a track at two instants in order, at rest before its start.
fn between(track: &Track, times: [f64; 2]) -> Matrix {
    let begin = track.begin();
    let both = track.between(times[0].max(begin), times[1].max(begin));
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let rests = (i > 0 && times[0] < begin) || (j > 0 && times[1] < begin);
            if rests { 0.0 } else { both[i][j] }
        })
    })
}

/// Belief of a track: at rest before its start where it starts from rest, carried back where it moves.
pub(super) fn at(track: &Track, time: f64) -> Belief {
    if time >= track.begin() {
        return track.at(time);
    }
    let mut belief = *track.start();
    // A start from rest is the one whose speed is known.
    if belief.covariance[1][1] > 0.0 {
        return track.before(time);
    }
    let angle = belief.covariance[0][0];
    belief.mean[2] = 0.0;
    belief.mean[3] = 0.0;
    belief.covariance = [[0.0; N]; N];
    belief.covariance[0][0] = angle;
    belief
}
