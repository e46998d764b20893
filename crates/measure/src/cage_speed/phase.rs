//! Deviation of the cage angle from that of a rolling cage, smoothed.

use super::CageSpeed;
use crate::quantile::noise;
use crate::shaft::Shaft;
use crate::state_space::{Belief, Filter, Matrix, Observation, Vector, colour};
use problem::{note, note::Note};
use statistics::simplex;
use std::f64::consts::PI;

/// Observed deviations of the cage angle.
pub(super) struct Deviations<'a> {
    /// Times in order, s.
    pub(super) time: &'a [f64],
    /// Deviation, rad of cage angle; NaN where nothing was seen.
    pub(super) deviation: &'a [f64],
    /// Relative variance of each, 1 on the average.
    pub(super) weight: &'a [f64],
    /// Rate of the deviation that was already taken out, rad/s, at the times; empty where none.
    pub(super) removed: &'a [f64],
    /// Time of an engagement after which slip may change fast, s.
    pub(super) engagement: Option<f64>,
    /// Time at which the shaft's acceleration ends at once, s: the deviation's rate changes by as much where the cage slips.
    pub(super) lock: Option<f64>,
    /// Whether shaft and cage rest at the first time.
    pub(super) from_rest: bool,
}

/// Times and deviations of an angle with instants between them at which nothing was seen.
#[derive(Default)]
struct Filled {
    time: Vec<f64>,
    deviation: Vec<f64>,
    weight: Vec<f64>,
    from_rest: bool,
}

/// Time before a lock over which the acceleration that ends there is taken, s.
const BEFORE_LOCK: f64 = 4e-3;

/// Correlation time of what is not seen before the first ball, over the time until it passes: one error, not several.
const ONE_ERROR: f64 = 10.0;

/// Correlation of a smooth random curve is gone after so many times the ratio of its deviation to that of its rate.
const INDEPENDENT: f64 = 2.0;

/// After an engagement the cage's speed is given at such intervals, s, for such a time, s: few balls pass while it rises.
const CLOSE: f64 = 2e-3;
const CLOSE_FOR: f64 = 0.5;

/// Speeds below which the shaft rests, and above which it surely turns, over its highest.
const REST: f64 = 0.01;
const TURNS: f64 = 1e-4;

/// Change of slip that is usual within [`USUAL_TIME`], 1: the centre of a prior that is wide (a factor of 12 either way in the
/// intensity) and counts only where noise hides the wander of the slip. Assumed.
const USUAL_CHANGE: f64 = 0.003;

/// Time of that change, s. Assumed.
const USUAL_TIME: f64 = 0.5;

/// Logarithms of noise variance, intensity of the speed's wander, of its rate's wander, of the latter after an engagement, and of
/// the time in which it calms down.
type Hyper = [f64; 5];

impl Deviations<'_> {
    /// Speed and slip of the cage.
    pub(super) fn smoothed(
        &self,
        shaft: &Shaft,
        ratio: f64,
        mut notes: Vec<Note>,
    ) -> Result<CageSpeed, String> {
        let seen = self.deviation.iter().filter(|v| v.is_finite()).count();
        if seen < 8 {
            return Err(format!(
                "{seen} passings of balls are usable; at least 8 are needed"
            ));
        }
        let rolling = ratio
            * self
                .time
                .iter()
                .map(|&t| shaft.speed_at(t).abs())
                .sum::<f64>()
            / self.time.len() as f64;
        let guess = self.guess(rolling);
        let kink = self.kink(shaft, ratio);
        let cost = |hyper: &Hyper| {
            let widths = [3.0, 2.0, 2.5, 5.0, 0.7];
            let prior: f64 = (0..5)
                .map(|i| 0.5 * ((hyper[i] - guess[i]) / widths[i]).powi(2))
                .sum();
            prior - self.filtered(hyper, kink, false).log_likelihood()
        };
        let (hyper, lowest) = simplex::lowest(guess, [1.0, 1.0, 1.5, 1.5, 0.4], 0.02, 240, cost);
        let filter = self.filtered(&hyper, kink, true);
        let wide = colour(filter.innovations());
        let filled = self.filled(shaft);
        let dense = Deviations {
            time: &filled.time,
            deviation: &filled.deviation,
            weight: &filled.weight,
            from_rest: filled.from_rest,
            ..*self
        };
        let states = dense.filtered(&hyper, kink, true).smoother().nodes();
        let mut variance: Vec<f64> = states.iter().map(|s| s.covariance[(1, 1)] * wide).collect();
        for axis in 0..if self.engagement.is_some() { 5 } else { 3 } {
            let moved = |by: f64| {
                let mut other = hyper;
                other[axis] += by;
                other
            };
            let curvature = (cost(&moved(0.5)) + cost(&moved(-0.5)) - 2.0 * lowest) / 0.25;
            let deviation = (1.0 / curvature.max(0.25)).sqrt();
            for by in [deviation, -deviation] {
                let other = dense.filtered(&moved(by), kink, true).smoother().nodes();
                for ((v, a), b) in variance.iter_mut().zip(&states).zip(&other) {
                    *v += 0.5
                        * ((b.mean[1] - a.mean[1]).powi(2) + b.covariance[(1, 1)]
                            - a.covariance[(1, 1)]);
                }
            }
        }
        if wide > 1.5 {
            notes.push(note!(
                "the noise of the cage angle is correlated; bands are wider by {:.2}",
                wide.sqrt()
            ));
        }
        let outliers = filter
            .innovations()
            .iter()
            .filter(|e| e.abs() > 5.0)
            .count();
        if outliers > 0 {
            notes.push(note!(
                "{} passings lie more than 5 deviations from where they are expected",
                outliers
            ));
        }
        let mut result = CageSpeed {
            noise: (0.5 * hyper[0]).exp(),
            ..CageSpeed::default()
        };
        for (k, ((&time, state), variance)) in
            dense.time.iter().zip(&states).zip(&variance).enumerate()
        {
            let rolling = ratio * shaft.speed_at(time);
            let shaft_part = ratio * shaft.speed_deviation_at(time);
            let excess = state.mean[1] + self.removed.get(k).copied().unwrap_or(0.0);
            let own = variance.max(state.covariance[(1, 1)]).max(0.0).sqrt();
            // Before the first ball has passed the cage may be anywhere between rest and rolling.
            let unseen = self.time.first().is_some_and(|first| time < *first);
            let own = own.hypot(if unseen { rolling / 12f64.sqrt() } else { 0.0 });
            let rate = (state.covariance[(2, 2)] * wide).max(0.0).sqrt();
            result.correlation_time.push(match self.time.first() {
                Some(first) if unseen => ONE_ERROR * (first - dense.time[0]),
                _ => INDEPENDENT * own / rate.max(f64::MIN_POSITIVE),
            });
            // The deviation is relative to the shaft's angle, which is known better than its speed: what the shaft's speed has
            // wrong for longer than a passing is not in the deviation's rate.
            let deviation = own.hypot(shaft_part);
            result.time.push(time);
            result.speed.push(rolling + excess);
            result.deviation.push(deviation);
            result.slip.push(if rolling == 0.0 {
                f64::NAN
            } else {
                -excess / rolling
            });
            result.slip_deviation.push(if rolling == 0.0 {
                f64::NAN
            } else {
                own / rolling.abs()
            });
        }
        if result.slip.iter().any(|s| s.is_nan()) {
            notes.push(note!("slip has no value where the shaft rests"));
        }
        result.notes = notes;
        Ok(result)
    }

    /// The same with instants between the passings after an engagement, and from it on where the shaft rested.
    fn filled(&self, shaft: &Shaft) -> Filled {
        let mut filled = Filled::default();
        let unseen = |filled: &mut Filled, from: f64, to: f64| {
            let parts = ((to - from) / CLOSE).ceil().max(1.0);
            for k in 1..parts as usize {
                let time = from + (to - from) * k as f64 / parts;
                // A slip has no value where the shaft rests.
                if shaft.speed_at(time).abs() > TURNS * shaft.fastest() {
                    filled.time.push(time);
                    filled.deviation.push(f64::NAN);
                    filled.weight.push(1.0);
                }
            }
        };
        // A signal whose trend was taken out is seen at equal times already.
        let engagement = self.engagement.filter(|_| self.removed.is_empty());
        let until = engagement.map_or(f64::NEG_INFINITY, |time| time + CLOSE_FOR);
        if let (Some(engagement), Some(first)) = (engagement, self.time.first())
            && engagement < *first
            && *first < until
            && shaft.covers(engagement)
            && shaft.speed_at(engagement).abs() < REST * shaft.fastest()
        {
            unseen(&mut filled, engagement, *first);
            filled.from_rest = !filled.time.is_empty();
        }
        for (k, (&time, &deviation)) in self.time.iter().zip(self.deviation).enumerate() {
            filled.time.push(time);
            filled.deviation.push(deviation);
            filled
                .weight
                .push(self.weight.get(k).copied().unwrap_or(1.0));
            if let Some(&next) = self.time.get(k + 1)
                && engagement.is_some_and(|engagement| time > engagement)
                && time < until
            {
                unseen(&mut filled, time, next);
            }
        }
        filled
    }

    /// Noise as second differences show it, and the usual changes of slip.
    fn guess(&self, rolling: f64) -> Hyper {
        let noise = noise(self.deviation, [1.0, -2.0, 1.0]).powi(2);
        let usual = USUAL_CHANGE * rolling.max(1e-9);
        // Integrated random walk: ω = √(q t³/3).
        let slow = 3.0 * usual * usual / USUAL_TIME.powi(3);
        let fast = 300.0 * usual * usual / 0.05_f64.powi(3);
        let wander = 0.3 * usual * usual / USUAL_TIME;
        [
            noise.max(1e-18).ln(),
            wander.ln(),
            slow.ln(),
            fast.ln(),
            0.05_f64.ln(),
        ]
    }

    /// The instant of the lock and the variance of the change of the deviation's rate there.
    ///
    /// Formula: δ̈ = ω̇_c - ratio·Ω̇ is 0 where the cage rolls; where it slips ω̇_c does not follow, and δ̈ jumps by ratio·Ω̇
    fn kink(&self, shaft: &Shaft, ratio: f64) -> Option<(f64, f64)> {
        let lock = self.lock.filter(|lock| shaft.covers(*lock))?;
        let before = lock - BEFORE_LOCK;
        let acceleration = (shaft.speed_at(lock) - shaft.speed_at(before)) / BEFORE_LOCK;
        shaft
            .covers(before)
            .then_some((lock, (ratio * acceleration).powi(2)))
    }

    fn filtered(&self, hyper: &Hyper, kink: Option<(f64, f64)>, keep: bool) -> Filter<3> {
        let [noise, wander, slow, fast, calming] = hyper.map(|v| v.clamp(-80.0, 60.0).exp());
        let first = self
            .deviation
            .iter()
            .copied()
            .find(|v| v.is_finite())
            .unwrap_or(0.0);
        let length = (self.time[self.time.len() - 1] - self.time[0]).max(1e-6);
        let spread = PI;
        let step = length / self.time.len() as f64;
        // Wide: any phase, any speed that moves the phase by a tenth of a turn in a step, any rate that does so in ten.
        let speed = (0.2 * spread / step).powi(2);
        let rate = (0.02 * spread / (step * step)).powi(2).min(1e12 * speed);
        let speed = if self.from_rest { 0.0 } else { speed };
        let prior = Belief {
            mean: Vector::from([first, 0.0, 0.0]),
            covariance: Matrix::from_diagonal(&Vector::from([spread * spread, speed, rate])),
        };
        let mut filter = Filter::new(prior, keep);
        for (k, (&time, &deviation)) in self.time.iter().zip(self.deviation).enumerate() {
            if k > 0 {
                let dt = (time - self.time[k - 1]).max(0.0);
                let since = self.engagement.map_or(f64::INFINITY, |e| {
                    (0.5 * (time + self.time[k - 1]) - e).abs()
                });
                let q = slow
                    + if since.is_finite() {
                        fast * (-since / calming).exp()
                    } else {
                        0.0
                    };
                match kink.filter(|(lock, _)| *lock > self.time[k - 1] && *lock <= time) {
                    Some((lock, variance)) => {
                        let before = lock - self.time[k - 1];
                        advance(&mut filter, before, q, wander, variance);
                        advance(&mut filter, dt - before, q, wander, 0.0);
                    }
                    None => advance(&mut filter, dt, q, wander, 0.0),
                }
            }
            let seen = Observation {
                row: Vector::from([1.0, 0.0, 0.0]),
                value: deviation,
                variance: noise * self.weight.get(k).copied().unwrap_or(1.0),
            };
            filter.observe(deviation.is_finite().then_some(&seen));
        }
        filter
    }
}

/// Angle, speed and rate after a time.
///
/// - `dt`: the time, s
/// - `q`, `wander`: intensities of the wander of the rate and of the speed
/// - `jump`: variance of a change of the rate at the end
fn advance(filter: &mut Filter<3>, dt: f64, q: f64, wander: f64, jump: f64) {
    let powers = [
        q * dt,
        q * dt * dt / 2.0,
        q * dt.powi(3) / 3.0,
        q * dt.powi(4) / 8.0,
        q * dt.powi(5) / 20.0,
    ];
    let angle = powers[4] + wander * dt.powi(3) / 3.0;
    let both = powers[3] + wander * dt * dt / 2.0;
    let speed = powers[2] + wander * dt;
    let (far, rate) = (0.5 * powers[2], powers[0] + jump);
    filter.predict(
        &Matrix::<3>::new(1.0, dt, 0.5 * dt * dt, 0.0, 1.0, dt, 0.0, 0.0, 1.0),
        &Matrix::<3>::new(
            angle, both, far, both, speed, powers[1], far, powers[1], rate,
        ),
    );
}
