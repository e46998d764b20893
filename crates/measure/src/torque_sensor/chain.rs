//! The chain of states that is filtered and smoothed, for one sensor, one engagement and one growth of the disturbance.

use super::Swing;
use crate::quantile::{median, noise};
use crate::state_space::{Belief, Filter, GAUSS, Matrix, Observation, Vector, gathered_noise};
use statistics::simplex;
use statistics::uncertain::Uncertain;

pub(super) const STATES: usize = 7;
pub(super) const TORQUE: usize = 2;
pub(super) const RATE: usize = 3;
pub(super) const COSINE: usize = 4;
pub(super) const SINE: usize = 5;
pub(super) const ZERO: usize = 6;

/// Logarithms of noise, slow intensity, fast intensity, calming time.
pub(super) type Hyper = [f64; 4];

/// What the chain needs of a measurement, at equal times; angle and speed are empty where they do not count.
#[derive(Clone, Copy)]
pub(super) struct Samples<'a> {
    pub(super) first: f64,
    pub(super) interval: f64,
    pub(super) reading: &'a [f64],
    pub(super) angle: &'a [f64],
    pub(super) speed: &'a [f64],
    /// Highest speed of the whole record.
    pub(super) fastest: f64,
    pub(super) zero: Uncertain,
}

impl<'a> Samples<'a> {
    /// A part of the record.
    pub(super) fn part(&self, from: usize, to: usize) -> Self {
        let cut = |list: &'a [f64]| list.get(from..to).unwrap_or(&[]);
        Self {
            first: self.first + from as f64 * self.interval,
            reading: cut(self.reading),
            angle: cut(self.angle),
            speed: cut(self.speed),
            ..*self
        }
    }
}

/// Everything that does not depend on the hyper-parameters.
pub(super) struct Chain<'a> {
    input: Samples<'a>,
    /// Power of the speed with which the disturbance grows.
    power: f64,
    scale: f64,
    /// Time since the torque's last transient, s, at the middle of the step that ends at sample k.
    calm: Vec<f64>,
    /// One step of the interval without disturbance, and the noise that unit intensity gathers.
    whole: (Matrix<STATES>, Matrix<STATES>),
    /// Response of reading and rate to cos θ and sin θ over the step that ends at sample k.
    forcing: Vec<[f64; 4]>,
    /// The steps with the engagement and with the lock inside.
    engaging: Option<Split>,
    locking: Option<Split>,
}

/// Instants, s, at which torque and rate may jump: the engagement, before which the shaft rests, and the lock after it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Knots {
    pub(super) engagement: Option<f64>,
    pub(super) lock: Option<f64>,
}

/// A step with a knot inside: until it and from it on, each with the noise that unit intensity gathers.
struct Split {
    at: usize,
    until: (Matrix<STATES>, Matrix<STATES>),
    after: (Matrix<STATES>, Matrix<STATES>),
}

impl Split {
    /// The step of some samples in which an instant lies; none outside of them.
    fn of(input: &Samples, swing: Swing, instant: f64) -> Option<Split> {
        let h = input.interval;
        let place = (instant - input.first) / h;
        let before = place.floor();
        let inside = place > 0.0 && place < (input.reading.len() - 1) as f64;
        inside.then(|| Split {
            at: before as usize + 1,
            until: stepped(swing, (place - before) * h),
            after: stepped(swing, (before + 1.0 - place) * h),
        })
    }
}

/// Means and variances of the smoothed states, in the unit of the reading.
pub(super) struct Pass {
    pub(super) states: Vec<(Vector<STATES>, Vector<STATES>)>,
    pub(super) innovations: Vec<f64>,
}

impl<'a> Chain<'a> {
    pub(super) fn new(
        input: Samples<'a>,
        swing: Swing,
        knots: Knots,
        power: f64,
        scale: f64,
    ) -> Self {
        let h = input.interval;
        let mut chain = Self {
            input,
            power,
            scale,
            calm: calm(&input, knots),
            whole: stepped(swing, h),
            forcing: Vec::with_capacity(input.reading.len()),
            engaging: (knots.engagement).and_then(|knot| Split::of(&input, swing, knot)),
            locking: knots.lock.and_then(|knot| Split::of(&input, swing, knot)),
        };
        let nodes = force_response(swing, h);
        for k in 0..input.reading.len() {
            chain.forcing.push(if k == 0 || input.angle.is_empty() {
                [0.0; 4]
            } else {
                chain.forced(k, &nodes)
            });
        }
        chain
    }

    /// Amplitude of the disturbance at a sample over that at the highest speed.
    fn growth(&self, k: usize) -> f64 {
        match self.input.speed.get(k) {
            Some(speed) => self.grown(speed.abs()),
            None => 0.0,
        }
    }

    fn grown(&self, speed: f64) -> f64 {
        if self.power == 0.0 || self.input.fastest <= 0.0 {
            1.0
        } else {
            (speed / self.input.fastest).powf(self.power)
        }
    }

    /// Integral of the response to cos θ and sin θ over the step that ends at sample k; angle by a cubic through angle and speed.
    fn forced(&self, k: usize, nodes: &[(f64, f64, [f64; 2])]) -> [f64; 4] {
        let (angle, speed, h) = (self.input.angle, self.input.speed, self.input.interval);
        let (a0, a1, s0, s1) = (angle[k - 1], angle[k], speed[k - 1] * h, speed[k] * h);
        let mut sum = [0.0; 4];
        for &(u, weight, [to_reading, to_rate]) in nodes {
            let v = 1.0 - u;
            let theta =
                a0 * v * v * (1.0 + 2.0 * u) + a1 * u * u * (3.0 - 2.0 * u) + s0 * u * v * v
                    - s1 * u * u * v;
            let growth = self.grown((s0 * v + s1 * u).abs() / h);
            let (sine, cosine) = theta.sin_cos();
            sum[0] += weight * growth * cosine * to_reading;
            sum[1] += weight * growth * cosine * to_rate;
            sum[2] += weight * growth * sine * to_reading;
            sum[3] += weight * growth * sine * to_rate;
        }
        sum
    }

    /// A start for the search, and the centre of the wide priors.
    pub(super) fn guess(&self) -> Hyper {
        let reading = self.input.reading;
        // The median ignores the fast part.
        let noise = (noise(reading, [1.0, -2.0, 1.0]) / self.scale).max(1e-6);
        // A change of one spread in 0.5 s in the slow part, in 20 ms in the fast part: T = √(q t³/3).
        let slow = 3.0 / 0.5_f64.powi(3);
        let fast = 3.0 / 0.02_f64.powi(3);
        [noise.ln(), slow.ln(), fast.ln(), 0.03_f64.ln()]
    }

    /// Minus the logarithm of likelihood times prior.
    pub(super) fn cost(&self, hyper: &Hyper) -> f64 {
        let guess = self.guess();
        // Deviations of the priors in natural logarithms: a factor of 3 in noise, of 50 in intensities, of 2 in the time.
        let widths = [1.1, 4.0, 4.0, 0.7];
        let mut prior = 0.0;
        for ((value, centre), width) in hyper.iter().zip(&guess).zip(&widths) {
            prior += 0.5 * ((value - centre) / width).powi(2);
        }
        prior - self.filtered(hyper, false).log_likelihood()
    }

    pub(super) fn most_likely(&self, start: Hyper, calls: usize) -> Hyper {
        simplex::lowest(start, [0.3, 1.5, 1.5, 0.4], 0.02, calls, |hyper| {
            self.cost(hyper)
        })
        .0
    }

    fn filtered(&self, hyper: &Hyper, keep: bool) -> Filter<STATES> {
        let input = &self.input;
        let [noise, slow, fast, calming] = hyper.map(|v| v.clamp(-40.0, 40.0).exp());
        let rests = self.engaging.is_some();
        let zero = input.zero.deviation / self.scale;
        // Amplitudes of the disturbance may drift by 3 % of the reading's spread in a second, the zero as stated.
        let drift = if input.angle.is_empty() {
            0.0
        } else {
            0.03 * 0.03 * input.interval
        };
        let with_drift = |gathered: &Matrix<STATES>, intensity: f64| {
            let mut noise = gathered * intensity;
            noise[(COSINE, COSINE)] += drift;
            noise[(SINE, SINE)] += drift;
            noise
        };
        let mut mean = Vector::zeros();
        mean[ZERO] = input.zero.value / self.scale;
        let mut prior = Matrix::zeros();
        // Wide: four times the spread of the reading, in amplitude.
        let wide = 16.0;
        prior[(ZERO, ZERO)] = zero * zero;
        if !input.angle.is_empty() {
            prior[(COSINE, COSINE)] = wide;
            prior[(SINE, SINE)] = wide;
        }
        if !rests {
            // Reading and torque agree up to what a swing of the size of the record does, about what the record begins with: a
            // torque that hardly changes may be large beside its spread. What of it is zero is open by the zero's own deviation.
            let level = self.first_level() / self.scale - mean[ZERO];
            (mean[0], mean[TORQUE]) = (level, level);
            let torque = wide + 100.0 * zero * zero;
            prior[(TORQUE, TORQUE)] = torque;
            prior[(RATE, RATE)] = wide / 0.05_f64.powi(2);
            prior[(0, 0)] = torque + wide;
            prior[(0, TORQUE)] = torque;
            prior[(TORQUE, 0)] = torque;
            prior[(1, 1)] = wide;
        } else if self.power == 0.0
            && let Some(angle) = input.angle.first()
        {
            // Settled under a run-out, which does not ask for motion.
            let (sine, cosine) = angle.sin_cos();
            prior[(0, 0)] = wide;
            for (index, part) in [(COSINE, cosine), (SINE, sine)] {
                (prior[(0, index)], prior[(index, 0)]) = (wide * part, wide * part);
            }
        }
        let mut jump = Matrix::zeros();
        jump[(TORQUE, TORQUE)] = wide;
        jump[(RATE, RATE)] = wide / 0.05_f64.powi(2);
        let mut filter = Filter::new(
            Belief {
                mean,
                covariance: prior,
            },
            keep,
        );
        let mut turning = !rests;
        for (k, &value) in input.reading.iter().enumerate() {
            if k > 0 {
                let intensity = slow + fast * (-self.calm[k] / calming).exp();
                let here = |split: &&Split| split.at == k;
                let engages = self.engaging.as_ref().filter(here);
                let locks = self.locking.as_ref().filter(here);
                if let Some(split) = engages {
                    filter.predict(&split.until.0, &Matrix::zeros());
                    filter.predict(&Matrix::identity(), &jump);
                    let mut transition = split.after.0;
                    self.put_forcing(k, &mut transition);
                    filter.predict(&transition, &with_drift(&split.after.1, slow + fast));
                    turning = true;
                } else if let Some(split) = locks.filter(|_| turning) {
                    filter.predict(&split.until.0, &(split.until.1 * (slow + fast)));
                    filter.predict(&Matrix::identity(), &jump);
                    let mut transition = split.after.0;
                    self.put_forcing(k, &mut transition);
                    filter.predict(&transition, &with_drift(&split.after.1, slow + fast));
                } else {
                    let mut transition = self.whole.0;
                    self.put_forcing(k, &mut transition);
                    let intensity = if turning { intensity } else { 0.0 };
                    filter.predict(&transition, &with_drift(&self.whole.1, intensity));
                }
            }
            let mut row = Vector::zeros();
            row[0] = 1.0;
            row[ZERO] = 1.0;
            let seen = Observation {
                row,
                value: value / self.scale,
                variance: noise * noise,
            };
            filter.observe(value.is_finite().then_some(&seen));
        }
        filter
    }

    /// Median of the first readings, in their unit.
    fn first_level(&self) -> f64 {
        const FIRST: usize = 50;
        let known = self.input.reading.iter().copied();
        median(known.filter(|v| v.is_finite()).take(FIRST))
    }

    fn put_forcing(&self, k: usize, transition: &mut Matrix<STATES>) {
        let [cosine_reading, cosine_rate, sine_reading, sine_rate] = self.forcing[k];
        transition[(0, COSINE)] = cosine_reading;
        transition[(1, COSINE)] = cosine_rate;
        transition[(0, SINE)] = sine_reading;
        transition[(1, SINE)] = sine_rate;
    }

    /// What all readings give; the amplitudes of the disturbance are those at each time.
    pub(super) fn smoothed(&self, hyper: &Hyper) -> Pass {
        let filter = self.filtered(hyper, true);
        let scale = self.scale;
        let innovations = filter.innovations().to_vec();
        let nodes = filter.smoother().nodes();
        let states = nodes
            .iter()
            .enumerate()
            .map(|(k, s)| {
                let mut mean = s.mean.map(|m| m * scale);
                let mut variance = s.covariance.diagonal() * (scale * scale);
                let growth = self.growth(k);
                for index in [COSINE, SINE] {
                    mean[index] *= growth;
                    variance[index] *= growth * growth;
                }
                (mean, variance)
            })
            .collect();
        Pass {
            states,
            innovations,
        }
    }
}

/// A pass and others with their weights, as one: means and variances of the mixture.
pub(super) fn mixed(likely: &Pass, others: &[(f64, Pass)]) -> Pass {
    let rest = 1.0 - others.iter().map(|(weight, _)| weight).sum::<f64>();
    let mix = |k: usize, (first, variance): &(Vector<STATES>, Vector<STATES>)| {
        let (mut mean, mut square) = (Vector::zeros(), Vector::zeros());
        for index in 0..STATES {
            // about the first, so that nothing is lost in rounding
            square[index] = rest * variance[index];
            for (weight, other) in others {
                let (state, variance) = &other.states[k];
                let away = state[index] - first[index];
                mean[index] += weight * away;
                square[index] += weight * (variance[index] + away * away);
            }
            square[index] -= mean[index] * mean[index];
            mean[index] += first[index];
        }
        (mean, square)
    };
    Pass {
        states: (likely.states.iter().enumerate())
            .map(|(k, state)| mix(k, state))
            .collect(),
        innovations: likely.innovations.clone(),
    }
}

/// Part of the highest speed below which a shaft comes to rest or leaves it: there the torque changes as it does in a spin-up.
const CREEPING: f64 = 0.02;

/// Time since the torque's last transient, s, at the middle of the steps: the clutch slipped, or the shaft crept.
fn calm(input: &Samples, knots: Knots) -> Vec<f64> {
    let from = (knots.lock.or(knots.engagement)).unwrap_or(f64::NEG_INFINITY);
    let mut crept = f64::NEG_INFINITY;
    (0..input.reading.len())
        .map(|k| {
            let time = input.first + k as f64 * input.interval;
            let speed = input.speed.get(k).map_or(0.0, |speed| speed.abs());
            if speed > 0.0 && speed < CREEPING * input.fastest {
                crept = time;
            }
            (time - from.max(crept) - 0.5 * input.interval).max(0.0)
        })
        .collect()
}

/// Sensor and torque without disturbance: rates of the states.
fn rates(swing: Swing) -> Matrix<STATES> {
    let Swing { omega, zeta } = swing;
    let mut a = Matrix::zeros();
    a[(0, 1)] = omega;
    a[(1, 0)] = -omega;
    a[(1, 1)] = -2.0 * zeta * omega;
    a[(1, TORQUE)] = omega;
    a[(TORQUE, RATE)] = 1.0;
    a
}

/// Transition over a step, and the covariance gathered by unit intensity of the torque's rate.
fn stepped(swing: Swing, step: f64) -> (Matrix<STATES>, Matrix<STATES>) {
    let a = rates(swing);
    let reached = |time: f64| (a * time).exp().column(RATE).into_owned();
    ((a * step).exp(), gathered_noise(reached, step, 2))
}

/// Places in the step, weights, and what a unit torque there does to reading and rate at the step's end.
fn force_response(swing: Swing, step: f64) -> Vec<(f64, f64, [f64; 2])> {
    let a = rates(swing);
    let mut nodes = Vec::new();
    for piece in 0..2 {
        for (node, weight) in GAUSS {
            let place = 0.5 * (f64::from(piece) + node);
            let reach = (a * ((1.0 - place) * step)).exp();
            nodes.push((
                place,
                0.5 * weight * step,
                [reach[(0, 1)] * swing.omega, reach[(1, 1)] * swing.omega],
            ));
        }
    }
    nodes
}

/// Reading of a sensor at rest at the first value that then feels a torque, linear between its values, and a disturbance given
/// over the place in the list; one value each.
pub(super) fn reading_of(
    swing: Swing,
    interval: f64,
    torque: &[f64],
    disturbance: impl Fn(f64) -> f64,
) -> Vec<f64> {
    let (transition, _) = stepped(swing, interval);
    let nodes = force_response(swing, interval);
    let (mut reading, mut rate) = (0.0, 0.0);
    let mut readings = Vec::with_capacity(torque.len());
    for (k, &now) in torque.iter().enumerate() {
        readings.push(reading);
        let next = torque.get(k + 1).copied().unwrap_or(now);
        let mut state = Vector::zeros();
        state[0] = reading;
        state[1] = rate;
        state[TORQUE] = now;
        state[RATE] = (next - now) / interval;
        let moved = transition * state;
        (reading, rate) = (moved[0], moved[1]);
        for &(place, weight, [to_reading, to_rate]) in &nodes {
            let force = weight * disturbance(k as f64 + place);
            reading += force * to_reading;
            rate += force * to_rate;
        }
    }
    readings
}
