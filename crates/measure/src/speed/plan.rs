//! From pulses, or from samples of a speed, to the nodes of a track: noises, densities, knots.

use super::node::{Node, mark, moving};
use super::track::filtered;
use super::transition::{Belief, Matrix, Memory, N, Observation, Vector};
use crate::pulse::{Pitch, Pulses};
use statistics::normal::below;
use std::f64::consts::TAU;

/// A mark that passes, or a mean of samples of a speed, in the units of the fit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passage {
    /// Instant.
    pub time: f64,
    /// What is seen: the angle of the mark from the first one, rad; of a channel the speed.
    pub value: f64,
    /// Rough speed.
    pub speed: f64,
    /// Stated uncertainty of the instant.
    pub spread: f64,
    /// Part of the noise that the mean of some samples keeps; 1 for a mark.
    pub kept: f64,
    /// Variance that the noise does not hold: what the calibration of the mark leaves, and what pulses in step with the sampling
    /// share, rad²; of a channel what its steps hide.
    pub left: f64,
}

/// Pulses, or samples of a speed, in units in which the usual interval is one.
pub(super) struct Data {
    pub passages: Vec<Passage>,
    /// Time of the unit zero, s.
    pub origin: f64,
    /// Unit of time, s.
    pub unit: f64,
    /// First and last instant watched, in units.
    pub watched: (f64, f64),
    /// Angle from the last mark that can have passed unseen before the first pulse to it, rad.
    pub before: f64,
    /// Usual angle between marks, rad; of a channel the largest speed.
    pub pitch: f64,
    pub calibrated: bool,
    /// Whether speeds are seen, not marks.
    pub channel: bool,
    /// Instants of the first passages behind a silence of the pickup; nothing is carried over to them.
    pub fresh: Vec<f64>,
    /// Stretches that are less steady than the part of the record they lie in, side by side and in order.
    pub unsteady: Vec<Unsteady>,
}

/// Largest part of the first pulse that is taken for hidden: the angle before it is 20 pitches then.
const MOST_UNSEEN: f64 = 0.966;

/// A stretch with a density of its own.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unsteady {
    pub from: f64,
    pub to: f64,
    pub density: f64,
}

impl Data {
    pub fn new(pulses: &Pulses, pitch: Option<&Pitch>) -> Data {
        let nominal = pulses.pitch();
        // Beyond a gap that is not surely counted any mark may have any of the errors.
        let joined = pulses.joined();
        let error = |pulse: usize| {
            pitch
                .filter(|_| joined.contains(&pulse))
                .and_then(|p| p.errors.get(pulses.position(pulse)).copied())
                .unwrap_or(0.0)
        };
        let usual = pitch.map_or(0.0, |p| {
            p.errors.iter().map(|e| e * e).sum::<f64>() / p.errors.len().max(1) as f64
        });
        let left = |pulse: usize| match pitch {
            Some(_) if !joined.contains(&pulse) => usual,
            Some(p) => Some(pulses.position(pulse))
                .map(|position| p.covariance(position, position))
                .filter(|v| v.is_finite())
                .unwrap_or(0.0)
                .max(0.0),
            None => 0.0,
        };
        let origin = pulses.times[0];
        let gaps = pulses.times.windows(2).map(|pair| pair[1] - pair[0]);
        let unit = crate::quantile::median(gaps).max(1e-12);
        let first = error(0);
        let mut passages: Vec<Passage> = (0..pulses.times.len())
            .map(|k| Passage {
                time: (pulses.times[k] - origin) / unit,
                value: (pulses.marks[k] - pulses.marks[0]) as f64 * nominal + error(k) - first,
                speed: 0.0,
                spread: pulses.uncertainties[k] / unit,
                kept: 1.0,
                left: left(k),
            })
            .collect();
        let parted = |k: usize| pulses.gaps.iter().any(|gap| gap.pulse == k);
        for k in 0..passages.len() {
            let last = k + 1 == passages.len() || parted(k + 1);
            let (a, b) = (
                &passages[if parted(k) && !last {
                    k
                } else {
                    k.saturating_sub(1)
                }],
                &passages[if last { k } else { k + 1 }],
            );
            let speed = (b.value - a.value) / (b.time - a.time).max(1e-9);
            passages[k].speed = speed;
        }
        let previous = (pulses.position(0) + pulses.positions - 1) % pulses.positions;
        let ahead = pitch.filter(|_| joined.contains(&0));
        let ahead = ahead.and_then(|p| p.errors.get(previous)).unwrap_or(&0.0);
        // Pulses that grow with the speed show no mark before a part u of that at the first one. Where the torque rises evenly
        // the angle goes with the speed's power of 3/2: θ_unseen = u^1.5 (θ_unseen + pitch).
        let hidden = pulses.unseen.clamp(0.0, MOST_UNSEEN).powf(1.5);
        let before = (nominal + first - ahead).max(0.1 * nominal) / (1.0 - hidden);
        Data {
            passages,
            origin,
            unit,
            watched: (
                (pulses.watched.0 - origin) / unit,
                (pulses.watched.1 - origin) / unit,
            ),
            before,
            pitch: nominal,
            calibrated: pitch.is_some(),
            channel: false,
            fresh: (pulses.gaps.iter())
                .map(|gap| (pulses.times[gap.pulse] - origin) / unit)
                .collect(),
            unsteady: Vec::new(),
        }
    }

    /// Adds what pulses in step with the sampling have in common, s. How they scatter says nothing of it.
    pub fn share(&mut self, shared: &[f64]) {
        for (passage, shared) in self.passages.iter_mut().zip(shared) {
            passage.left += (shared / self.unit * passage.speed).powi(2);
        }
    }

    /// Density of the unsteady stretch that an instant lies in; 0 where there is none.
    fn unsteady_at(&self, time: f64) -> f64 {
        let next = self.unsteady.partition_point(|stretch| stretch.to < time);
        let stretch = self
            .unsteady
            .get(next)
            .filter(|stretch| stretch.from <= time);
        stretch.map_or(0.0, |stretch| stretch.density)
    }

    /// Whether a passage, by its instant, is the first one behind a silence.
    pub fn is_fresh(&self, time: f64) -> bool {
        self.fresh
            .binary_search_by(|fresh| fresh.total_cmp(&time))
            .is_ok()
    }

    /// Seconds of an instant in units.
    pub fn seconds(&self, time: f64) -> f64 {
        self.origin + time * self.unit
    }

    /// Units of an instant in seconds.
    pub fn units(&self, seconds: f64) -> f64 {
        (seconds - self.origin) / self.unit
    }
}

/// Noise of what is seen at a passage.
#[derive(Clone, Copy, Debug)]
pub(super) struct Noise {
    /// Factor on the stated uncertainty of the instants.
    pub timing: f64,
    /// Standard deviation that does not depend on speed, rad; of a channel that of one sample.
    pub angle: f64,
    /// Error of the instants that lasts over several pulses; of a channel its instrument.
    pub memory: Memory,
}

impl Noise {
    pub fn variance(&self, passage: &Passage) -> f64 {
        (self.timing * passage.spread * passage.speed).powi(2)
            + (self.angle * passage.kept).powi(2)
            + passage.left
    }
}

/// What may jump at an instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Knot {
    /// Nothing: only the density of the snap changes.
    Soft,
    /// The jerk.
    Kink,
    /// Acceleration and jerk.
    Jump,
}

/// Two knots with a quick change between them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Knots {
    /// Engagement.
    pub engage: f64,
    /// End, where there is one.
    pub lock: f64,
    /// Change of speed between, in units.
    pub change: f64,
    /// Density of the snap between.
    pub density: f64,
    /// A start that is less steady than the rest, where it is.
    pub head: Option<Head>,
    /// What may jump at the engagement.
    pub start: Knot,
    /// What may jump at the end.
    pub stop: Knot,
}

impl Knots {
    /// Variance that a knot adds to acceleration and jerk. Its size is that of a change of speed `change` within the length:
    /// an even acceleration jumps by its mean, one that rises or falls evenly has the jerk of twice the mean over the length.
    /// It does not follow the density: a clutch whose torque rises evenly is as quiet between its knots as it is loud at
    /// them.
    fn added(&self, knot: Knot) -> Vector {
        let length = self.lock - self.engage;
        let acceleration = self.change / length;
        let jerk = (STEEPEST * acceleration / length).powi(2);
        Vector::from(match knot {
            Knot::Soft => [0.0; N],
            Knot::Kink => [0.0, 0.0, 0.0, jerk, 0.0],
            Knot::Jump => [0.0, 0.0, acceleration * acceleration, jerk, 0.0],
        })
    }

    /// The same for the engagement: a start that is less steady than the whole change may reach the mean acceleration before the
    /// first mark.
    fn started(&self) -> Vector {
        let mut added = self.added(self.start);
        if let Some(head) = &self.head
            && self.start != Knot::Soft
        {
            added[3] += (self.change / (self.lock - self.engage) / head.first.max(1.0)).powi(2);
        }
        added
    }

    /// Density between the knots.
    fn density_at(&self, time: f64) -> f64 {
        let Some(head) = &self.head else {
            return self.density;
        };
        let acceleration = self.change / (self.lock - self.engage);
        let since = (time - self.engage).max(head.first);
        self.density
            .max(head.share * acceleration * acceleration / since.powi(3))
    }
}

/// A start that is less steady than the whole change, the more the shorter ago it was: after a time τ the acceleration a of
/// the change wanders by the root of `share` while that time passes once more, which is a snap of the density
/// `share a²/τ³`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Head {
    pub share: f64,
    /// From the engagement to the first mark.
    pub first: f64,
}

/// Jerk at a knot over that of an even rise to the mean acceleration: 2 for a rise to the lock, 6 for a parabola.
const STEEPEST: f64 = 4.0;

/// Everything that turns passages into nodes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    pub noise: Noise,
    /// Densities before the quick change, while it settles, and after that; the same where there is none.
    pub quiet: [f64; 3],
    pub transient: Option<Knots>,
    /// When it has settled.
    pub settled: f64,
    /// Whether the shaft rests before the engagement.
    pub rests: bool,
}

impl Plan {
    /// A record, or a part of one, without a quick change.
    pub fn steady(noise: Noise, density: f64) -> Plan {
        Plan {
            noise,
            quiet: [density; 3],
            transient: None,
            settled: 0.0,
            rests: false,
        }
    }

    /// Density of the part of the record that an instant lies in.
    pub fn density(&self, time: f64) -> f64 {
        match &self.transient {
            Some(knots) if time > knots.engage && time <= knots.lock => knots.density_at(time),
            Some(knots) if time <= knots.engage => self.quiet[0],
            Some(_) if time <= self.settled => self.quiet[1],
            _ => self.quiet[2],
        }
    }

    /// Nodes, start and density after the last node, of some passages.
    pub fn nodes(&self, data: &Data, range: std::ops::Range<usize>) -> (Vec<Node>, Belief) {
        self.nodes_of(data, &data.passages[range])
    }

    fn nodes_of(&self, data: &Data, passages: &[Passage]) -> (Vec<Node>, Belief) {
        let mut nodes = Vec::with_capacity(passages.len() + 2);
        let mut joints: Vec<(f64, Option<Vector>)> = Vec::new();
        let first = passages[0];
        let mut before = first;
        let mut start = match data.channel {
            true => shown(data, passages, &self.noise),
            false => moving(first.value, first.speed, data.pitch, &self.noise.memory),
        };
        if let Some(knots) = &self.transient {
            // A channel that shows the rest before the engagement begins there: nothing moves before.
            if self.rests && (data.channel || knots.engage <= first.time) {
                start = resting(data, knots, &self.noise.memory);
                joints.push((knots.engage, None));
            } else if knots.engage > first.time {
                joints.push((knots.engage, Some(knots.started())));
            }
            if knots.lock > first.time {
                joints.push((knots.lock, Some(knots.added(knots.stop))));
            }
        }
        let density = |time: f64| self.density(time).max(data.unsteady_at(time));
        let mut joints = joints.into_iter().peekable();
        let mut gaps = data.fresh.partition_point(|&time| time <= first.time);
        let from = self.at_rest(data, passages);
        for (k, passage) in passages.iter().enumerate().skip(from) {
            let passed = data.fresh[gaps..].partition_point(|&time| time <= passage.time);
            gaps += passed;
            while let Some((time, added)) = joints.next_if(|joint| joint.0 <= passage.time) {
                nodes.push(Node {
                    time,
                    density: density(time),
                    pulse: None,
                    added,
                    fresh: None,
                });
            }
            nodes.push(Node {
                time: passage.time,
                density: density(passage.time),
                pulse: Some(match data.channel {
                    true => Observation {
                        value: passage.value,
                        variance: self.noise.variance(passage),
                        row: self.noise.memory.row(),
                    },
                    false => mark(passage.value, self.noise.variance(passage), passage.speed),
                }),
                added: (passed > 0 && data.channel).then(|| {
                    let guess = Guess::of(data, &passages[k..], &self.noise);
                    unseen(&before, passage, &guess, data.pitch)
                }),
                fresh: (passed > 0 && !data.channel)
                    .then(|| moving(passage.value, passage.speed, data.pitch, &self.noise.memory)),
            });
            before = *passage;
        }
        (nodes, start)
    }

    /// How many of some passages show a shaft that rests before its engagement; marks do not pass then.
    fn at_rest(&self, data: &Data, passages: &[Passage]) -> usize {
        match self.transient {
            Some(knots) if self.rests && data.channel => {
                passages.partition_point(|p| p.time <= knots.engage)
            }
            _ => 0,
        }
    }

    /// Log likelihood of some passages.
    pub fn likelihood(&self, data: &Data, range: std::ops::Range<usize>) -> f64 {
        self.likelihood_of(data, &data.passages[range])
    }

    /// The same of several parts, none of which follows from another.
    pub fn likelihood_in(&self, data: &Data, parts: &[std::ops::Range<usize>]) -> f64 {
        let all = parts.iter();
        all.map(|part| self.likelihood(data, part.clone())).sum()
    }

    /// Log likelihood of a choice of passages.
    pub fn likelihood_of(&self, data: &Data, passages: &[Passage]) -> f64 {
        let (nodes, start) = self.nodes_of(data, passages);
        let leading = self.leading();
        let mut direction = Vector::zeros();
        if let Some(state) = leading {
            direction[state] = 1.0;
        }
        let memory = &self.noise.memory;
        let filter = filtered(&nodes, &start, direction, memory, false, |_| ());
        let resting: f64 = (passages[..self.at_rest(data, passages)].iter())
            .map(|passage| {
                let variance = self.noise.variance(passage);
                -0.5 * (passage.value * passage.value / variance + (TAU * variance).ln())
            })
            .sum();
        let forward = leading.map_or(0.0, |state| {
            forward_only(filter.derivatives(), start.covariance[(state, state)])
        });
        match filter.log_likelihood() + resting + forward {
            sum if sum.is_finite() => sum,
            _ => f64::NEG_INFINITY,
        }
    }

    /// The state that leads a motion from rest, where one does: what jumps first cannot turn the shaft back.
    fn leading(&self) -> Option<usize> {
        match self.transient.filter(|_| self.rests)?.start {
            Knot::Soft => None,
            Knot::Kink => Some(3),
            Knot::Jump => Some(2),
        }
    }
}

/// What the logarithm of the likelihood gains where a state at the start, of mean zero and some variance, is known to be
/// positive: twice the probability that it is, from all pulses.
fn forward_only((slope, curvature): (f64, f64), variance: f64) -> f64 {
    let left = variance * (1.0 - variance * curvature).max(1e-12);
    let z = variance * slope / left.sqrt();
    // Far below, that is no number that has a logarithm.
    (2.0 * below(z)).max(f64::MIN_POSITIVE).ln()
}

/// What may differ between a motion of which hardly anything is known and the speed that is shown, as parts of the largest speed.
const OPEN: [f64; N] = [0.0, 0.3, 0.1, 0.03, 0.3];
/// Passages from which a start is guessed.
const LINE: usize = 8;
/// How far a motion may be from that guess, over what the passages differ by.
const BEYOND: f64 = 30.0;

/// The straight line through the first passages, and how far speed and acceleration may be from it.
struct Guess {
    slope: f64,
    wide: f64,
    late: f64,
}

impl Guess {
    fn of(data: &Data, passages: &[Passage], noise: &Noise) -> Guess {
        let all = &passages[..passages.len().min(LINE)];
        let joined = all.iter().skip(1).take_while(|p| !data.is_fresh(p.time));
        let all = &all[..1 + joined.count()];
        let (first, last) = (all[0], all[all.len() - 1]);
        let late = noise.memory.late();
        let slope = match last.time > first.time {
            true => (last.value - first.value) / (last.time - first.time),
            false => 0.0,
        };
        let off = |pair: &[Passage]| {
            (pair[1].value - pair[0].value - slope * (pair[1].time - pair[0].time)).abs()
        };
        let scatter = all.windows(2).map(off).fold(0.0, f64::max);
        let seen = scatter + slope.abs() * (1.0 + late) + 3.0 * noise.variance(&first).sqrt();
        Guess {
            slope,
            wide: match all.len() {
                LINE => BEYOND * seen,
                _ => f64::INFINITY,
            },
            late,
        }
    }

    /// Variance of a motion about the guess.
    fn open(&self, largest: f64, beside: f64) -> Vector {
        Vector::from(OPEN).map(|part| (part * largest).min(self.wide + BEYOND * beside).powi(2))
    }
}

/// Variance added where a channel shows nothing between two passages: the motion behind does not follow from that before, and the
/// angle between by the mean of both speeds, off by the half of their difference.
fn unseen(before: &Passage, behind: &Passage, guess: &Guess, largest: f64) -> Vector {
    let change = (behind.speed - before.speed).abs();
    let mut added = guess.open(largest, change);
    added[0] = (0.5 * (behind.time - before.time) * change).powi(2);
    added
}

/// Belief before the first sample of a speed: no angle is counted yet, and of the motion hardly more is known than what it
/// shows. It is no wider than needed: what is far from its middle would be known by differences of large numbers.
fn shown(data: &Data, passages: &[Passage], noise: &Noise) -> Belief {
    let guess = Guess::of(data, passages, noise);
    let value = passages[0].value;
    let speed = value + guess.late * guess.slope;
    Belief {
        mean: Vector::from([0.0, speed, guess.slope, 0.0, value]),
        covariance: Matrix::from_diagonal(&guess.open(data.pitch, 0.0)),
    }
}

/// Belief at the engagement from rest: no speed, an angle anywhere before the first mark.
fn resting(data: &Data, knots: &Knots, memory: &Memory) -> Belief {
    let mut variances = knots.started();
    // A channel counts its angle from here.
    let (passed, first) = match data.channel {
        true => (0.0, 0.0),
        false => (data.before, data.passages[0].value),
    };
    variances[0] = passed * passed / 12.0;
    if !data.channel {
        variances[4] = memory.spread * memory.spread;
    }
    Belief {
        mean: Vector::from([first - 0.5 * passed, 0.0, 0.0, 0.0, 0.0]),
        covariance: Matrix::from_diagonal(&variances),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_start_that_must_be_forward_gains_at_most_a_factor_of_two() {
        let gain = |slope: f64| forward_only((slope, 0.5), 1.0);
        assert!(gain(0.0).abs() < 1e-15);
        assert!((gain(10.0) - 2f64.ln()).abs() < 1e-12);
        // Two deviations below zero: twice 0.02275.
        let two = -2.0 * 0.5f64.sqrt();
        assert!((gain(two) - (2.0 * 0.022_750_132f64).ln()).abs() < 1e-6);
        assert!(gain(-1e3) < -700.0 && gain(-1e3).is_finite());
    }
}
