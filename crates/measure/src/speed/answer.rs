//! What is asked of a smoothed record: the motion at an instant, covariance between instants, paths at random.

use super::node::Belief;
use super::track::{Track, mixed};
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
            .map(|(w, track)| (*w, track.at(time)))
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
        let motion = self.told(seconds);
        let motion = self.stop.map_or(motion, |stop| stop.applied(motion));
        let hidden = self.breakaway.as_ref();
        hidden.map_or(motion, |breakaway| breakaway.applied(motion))
    }

    /// The motion that the pulses alone tell of.
    fn told(&self, seconds: f64) -> Motion {
        let time = (seconds - self.origin) / self.unit;
        let (belief, factors) = (self.belief(time), self.factors(time));
        let scale = self.scale();
        let [angle, speed, acceleration, jerk] = std::array::from_fn(|i| belief.mean[i] * scale[i]);
        let late = [speed, acceleration, jerk].map(|x| x * self.latency);
        let wrong = self.wrong_wheel(0.0, speed, acceleration);
        let known: [[f64; 3]; 3] = std::array::from_fn(|i| {
            let factor = |i: usize| factors[i] * scale[i];
            std::array::from_fn(|j| belief.covariance[i][j] * factor(i) * factor(j))
        });
        let floor = self.floor(seconds, [known[1][1], known[2][2]]);
        Motion {
            time: seconds,
            angle,
            speed,
            acceleration,
            covariance: std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    let wheel: f64 = wrong.iter().map(|w| w[i] * w[j]).sum();
                    let lacking = if i == j { floor[i] * floor[i] } else { 0.0 };
                    known[i][j] + lacking + late[i] * late[j] + wheel
                })
            }),
        }
    }

    /// What the deviations of angle, speed and acceleration lack, given the variances of the last two, that they cannot be
    /// less than.
    fn floor(&self, seconds: f64, known: [f64; 2]) -> [f64; 3] {
        let lacks = |stiffest: &super::Stiffest, order: usize| {
            let least = stiffest.variance(order as i32, seconds);
            (least - known[order - 1]).max(0.0).sqrt()
        };
        let stiffest = self.stiffest.as_ref();
        stiffest.map_or([0.0; 3], |s| [0.0, lacks(s, 1), lacks(s, 2)])
    }

    /// The instant from which an instant's motion follows, s, and how much of what was open there is left: behind the last
    /// mark of a shaft that stops it is that mark.
    fn source(&self, seconds: f64) -> (f64, [f64; 3]) {
        let stop = self.stop.as_ref();
        stop.map_or((seconds, [1.0; 3]), |stop| stop.source(seconds))
    }

    /// Deviations of angle, speed and acceleration at an instant, s, that pulses do not tell of: what the stop and what the
    /// breakaway hide. Each is one error for all instants.
    fn hidden(&self, seconds: f64) -> [[f64; 3]; 2] {
        let stop = self.stop.map_or([0.0; 3], |stop| stop.hidden(seconds));
        let breakaway = self.breakaway.as_ref();
        let start = breakaway.map_or([0.0; 3], |breakaway| {
            breakaway.hidden(seconds, || self.told(seconds).acceleration)
        });
        [stop, start]
    }

    /// Covariance of angle, speed and acceleration at one instant (rows) with those at another (columns), s.
    ///
    /// Within a quick change, and outside it, all that is unknown takes part; between an instant inside and one outside, the
    /// knots count as known. What a stop and a breakaway hide is the same error at all instants.
    pub fn covariance(&self, first: f64, second: f64) -> [[f64; 3]; 3] {
        if second < first {
            let other = self.covariance(second, first);
            return std::array::from_fn(|i| std::array::from_fn(|j| other[j][i]));
        }
        let sources = [first, second].map(|t| self.source(t));
        let told = self.covariance_told(sources[0].0, sources[1].0);
        let hidden = [first, second].map(|t| self.hidden(t));
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let left = sources[0].1[i] * sources[1].1[j];
                let own: f64 = match i == j {
                    true => (0..2).map(|k| hidden[0][k][i] * hidden[1][k][i]).sum(),
                    false => 0.0,
                };
                told[i][j] * left + own
            })
        })
    }

    /// What the pulses alone tell of the same, for instants in order.
    fn covariance_told(&self, first: f64, second: f64) -> [[f64; 3]; 3] {
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
            .map(|(w, track)| {
                let both = track.between(times[0], times[1]);
                (*w, times.map(|t| track.at(t)), both)
            })
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
        let floor = [0, 1].map(|k| {
            let seconds = [first, second][k];
            let belief = self.belief(times[k]);
            let known = |i: usize| belief.covariance[i][i] * (factors[k][i] * scale[i]).powi(2);
            self.floor(seconds, [known(1), known(2)])
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
                let lacking = if i == j {
                    floor[0][i] * floor[1][i]
                } else {
                    0.0
                };
                own * factors[0][i] * scale[i] * factors[1][j] * scale[j]
                    + lacking
                    + late[0][i] * late[1][j]
                    + wheel
            })
        })
    }

    /// A motion drawn at random from all that the pulses leave open: angle, speed and acceleration at increasing instants, s.
    ///
    /// `uniform` from 0 to 1 picks the knots; `normal` gives independent standard normal numbers. All instants within the
    /// quick change or all anywhere: then the knots count as known. Before the first pulse and behind a stop the motion is
    /// carried on as by [`Speed::at`].
    pub fn draw(
        &self,
        times: &[f64],
        uniform: f64,
        normal: &mut dyn FnMut() -> f64,
    ) -> Vec<[f64; 3]> {
        let sources: Vec<(f64, [f64; 3])> = times.iter().map(|t| self.source(*t)).collect();
        let units: Vec<f64> = sources
            .iter()
            .map(|(t, _)| (t - self.origin) / self.unit)
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
        let path = track.draw(&units, normal);
        let (delay, sine, cosine) = (normal() * self.latency, normal(), normal());
        // One error each of speed and of acceleration: the least one, that of a stop, that of a breakaway.
        let own: [[f64; 3]; 3] = std::array::from_fn(|_| [0.0, normal(), normal()]);
        let scale = self.scale();
        let origin = path.first().map_or(0.0, |x| x[0]);
        std::iter::zip(times, sources)
            .zip(units.iter().zip(&path))
            .map(|((&time, (source, left)), (&unit, x))| {
                let x = [x[0], x[1], x[2], x[3]];
                let x = if inside { self.scaled(unit, x) } else { x };
                let [angle, speed, acceleration, jerk] = std::array::from_fn(|i| x[i] * scale[i]);
                let late = [speed, acceleration, jerk].map(|v| v * delay);
                let wrong = self.wrong_wheel(angle - origin, speed, acceleration);
                let now = [angle, speed, acceleration];
                let (told, wanted) = (self.told(source), self.at(time));
                let told = [told.angle, told.speed, told.acceleration];
                let wanted = [wanted.angle, wanted.speed, wanted.acceleration];
                let (belief, factors) = (self.belief(unit), self.factors(unit));
                let known = |i: usize| belief.covariance[i][i] * (factors[i] * scale[i]).powi(2);
                let floor = self.floor(source, [known(1), known(2)]);
                let hidden = self.hidden(time);
                std::array::from_fn(|i| {
                    let away = now[i] - told[i]
                        + late[i]
                        + sine * wrong[0][i]
                        + cosine * wrong[1][i]
                        + own[0][i] * floor[i];
                    wanted[i] + left[i] * away + own[1][i] * hidden[0][i] + own[2][i] * hidden[1][i]
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
