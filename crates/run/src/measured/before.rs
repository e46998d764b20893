//! What a channel shows before the release: its mean, the synchronous orbit, and its noise, which is what is left.
//!
//! ```text
//!   v = mean + c cos φ + s sin φ + noise        φ angle that the rotor turns from the release on: at the release the orbit is c
//! ```
//! The speed is that of the run, corrected by what the orbit itself shows.
//!
//! Source: least squares; uncertainties by the autocorrelation of the residuals.
//! Of a channel that stands still before the release, as the speed of a race, the noise is that of its motion: the median second difference.
//! Valid: a speed that differs from that of the run by a constant; other motions of the rotor before the release count as noise.

use super::Curve;
use super::samples::alone;
use outcome::Outcome;
use statistics::interpolation::{between, held};
use statistics::least_squares::LeastSquares;
use statistics::noise::Noise;
use statistics::quantile;
use statistics::uncertain::Uncertain;
use std::f64::consts::TAU;

/// Values before the release that a deviation is estimated from, at least.
const FEWEST: usize = 16;
/// Samples before the release that stand alone and are left out, at most.
const MOST_ALONE: usize = 8;
/// Turns before the release that are used, at most.
const TURNS: f64 = 64.0;
/// An orbit corrects the speed from so many standard uncertainties on.
const SHOWN: f64 = 6.0;
/// Rounds of that correction.
const ROUNDS: usize = 4;
/// A channel that stands still before the release moves with noise of its own where that is so many times what rounding alone makes.
const MOVING: f64 = 2.0;
/// Rounding averages out where noise spreads values over several steps: where their deviation is this share of a step at least; rounding alone
/// has 1/√12 of it.
const SPREAD: f64 = 0.42;

/// Instants, s, and angles of the rotor from the release on, rad, of a run whose rotor turns; before the run it has the first speed.
pub(super) type Turning = [Vec<f64>; 2];

pub(super) fn turning(outcome: &Outcome, release: f64) -> Option<Turning> {
    let [times, speeds] = ["time", "rotor.speed"].map(|name| outcome.column(name));
    let (mut times, mut speeds) = (times?.values.clone(), speeds?.values.clone());
    let speed = *speeds.first().filter(|speed| **speed != 0.0)?;
    times.insert(0, times[0] - (TURNS + 1.0) * TAU / speed.abs());
    speeds.insert(0, speed);
    let mut angle = 0.0;
    let turned = |row: usize| {
        let before = row.saturating_sub(1);
        angle += 0.5 * (speeds[row] + speeds[before]) * (times[row] - times[before]);
        angle
    };
    let angles: Vec<f64> = (0..times.len()).map(turned).collect();
    let start = between(&times, &angles, release)?;
    Some([times, angles.iter().map(|angle| angle - start).collect()])
}

/// A channel before the release.
#[derive(Debug, Default)]
pub(super) struct Before {
    /// Mean, where there are values.
    pub mean: Option<Uncertain>,
    /// Displacement by the synchronous orbit at the release and a quarter of a turn later, where the rotor turns once at least.
    pub orbit: Option<[Uncertain; 2]>,
    /// Noise of the channel, where it is known.
    pub noise: Option<Noise>,
    /// Deviation of the values before the release, whatever the file says.
    pub scatter: Option<f64>,
    /// Independent values that the deviation is known by; infinite where the file gives it.
    pub known_by: f64,
}

impl Curve {
    /// Before a release, from which instants count.
    pub(super) fn before(&self, release: f64, turning: Option<&Turning>) -> Before {
        let last = self.times.partition_point(|time| *time < release);
        let angle = |time: &f64| turning.map_or(0.0, |[times, angles]| held(times, angles, *time));
        let far = |time: &f64| angle(time).abs() > TURNS * TAU;
        let first = self.times[..last].partition_point(far);
        let (times, values) = (&self.times[first..last], &self.values[first..last]);
        // few samples that stand alone are faults of the record, no noise
        let lone = alone(values, white(values).deviation);
        let lone: Vec<usize> = lone.into_iter().map(|own| own.0).collect();
        let kept = |rows: &[f64]| -> Vec<f64> {
            let own = rows.iter().enumerate();
            let own = own.filter(|(row, _)| lone.len() > MOST_ALONE || !lone.contains(row));
            own.map(|(_, own)| *own).collect()
        };
        let (times, values) = (&kept(times)[..], &kept(values)[..]);
        let since: Vec<f64> = times.iter().map(|time| time - release).collect();
        let angles: Vec<f64> = times.iter().map(angle).collect();
        let turns = angles.first().is_some_and(|angle| angle.abs() >= TAU);
        let enough = values.len() >= FEWEST;
        let orbit = (enough && turns).then(|| synchronous(&since, angles, values));
        let alone = || {
            let ([mean], noise) = solved(vec![[1.0]; values.len()], values).filter(|_| enough)?;
            Some((mean, None, noise))
        };
        let found = orbit
            .flatten()
            .map(|(mean, orbit, noise)| (mean, Some(orbit), noise));
        let (mean, orbit, noise) = match found.or_else(alone) {
            Some((mean, orbit, noise)) => (Some(mean), orbit, noise),
            // of the whole, by differences that impacts do not raise
            None if self.values.len() >= FEWEST => (None, None, Some(white(&self.values))),
            None => (None, None, None),
        };
        let scatter = noise.as_ref().map(|own| own.deviation);
        let known_by = match (&self.given.deviation, &noise) {
            (None, Some(own)) => values.len().max(FEWEST) as f64 / own.repetition(),
            _ => f64::INFINITY,
        };
        let noise = self.noise(noise, last);
        let rounding = noise
            .as_ref()
            .map_or(0.0, |noise| noise.rounding / 12_f64.sqrt());
        let rounded = |own: Uncertain| Uncertain::new(own.value, own.deviation.hypot(rounding));
        Before {
            mean: mean.map(rounded),
            orbit,
            noise,
            scatter: scatter.filter(|_| enough),
            known_by,
        }
    }

    /// Noise with the deviation that the file gives, or with that of rounding at least, and of a channel that stands still before a row with
    /// that of its motion after it.
    fn noise(&self, found: Option<Noise>, release: usize) -> Option<Noise> {
        let mut noise = found.unwrap_or_default();
        let step = quantile::step(&self.values);
        let least = step / 12_f64.sqrt();
        if noise.deviation < SPREAD * step {
            noise.rounding = step;
        }
        if noise.deviation < least {
            // rounding alone: of a channel that stands still it repeats itself, of one that moves it does not
            (noise.deviation, noise.correlation) = (least, Vec::new());
            let (before, after) = self.values.split_at(release);
            let still = before.windows(2).all(|two| (two[1] - two[0]).abs() <= step);
            let moving = Some(after).filter(|_| still);
            let moving = moving.filter(|own| own.len() >= FEWEST).map(white);
            if let Some(moving) = moving.filter(|own| own.deviation > MOVING * least) {
                noise = moving;
            }
        }
        let given = self.given.deviation.as_ref().map(|(value, ..)| *value);
        noise.deviation = given.unwrap_or(noise.deviation);
        let largest = (self.values.iter()).fold(0.0, |most: f64, own| most.max(own.abs()));
        // less is rounding of numbers
        (noise.deviation > 1e-9 * largest).then_some(noise)
    }
}

/// Coefficients of values with their uncertainty, and the noise that is left.
pub(super) fn solved<const N: usize>(
    rows: Vec<[f64; N]>,
    values: &[f64],
) -> Option<([Uncertain; N], Option<Noise>)> {
    let fit = LeastSquares::new(rows)?;
    let weights = fit.weights();
    let coefficients = |noise: &Noise| weights.each_ref().map(|own| noise.weighted(own, values));
    let exact = coefficients(&Noise::default()).map(|own| own.value);
    let noise = Noise::of(&fit.residuals(&exact, values), N);
    Some((
        coefficients(noise.as_ref().unwrap_or(&Noise::default())),
        noise,
    ))
}

/// Mean and synchronous orbit at the release and a quarter of a turn later, by times from it and angles of the rotor.
fn synchronous(
    times: &[f64],
    mut angles: Vec<f64>,
    values: &[f64],
) -> Option<(Uncertain, [Uncertain; 2], Option<Noise>)> {
    let rows = angles.iter().map(|angle| [1.0, angle.cos(), angle.sin()]);
    let ([mut mean, mut cosine, mut sine], mut noise) = solved(rows.collect(), values)?;
    let size = cosine.value.hypot(sine.value);
    let shown = size > SHOWN * cosine.deviation.max(sine.deviation);
    for _ in 0..if shown { ROUNDS } else { 0 } {
        // what a speed that differs adds, in time over the length of the stretch
        let rows = times.iter().zip(&angles).map(|(time, angle)| {
            let slope = (sine.value * angle.cos() - cosine.value * angle.sin()) / size;
            [1.0, angle.cos(), angle.sin(), slope * time / -times[0]]
        });
        let rate;
        ([mean, cosine, sine, rate], noise) = solved(rows.collect(), values)?;
        let turned = (rate.value / size).clamp(-1.0, 1.0);
        let both = angles.iter_mut().zip(times);
        both.for_each(|(angle, time)| *angle += turned * time / -times[0]);
    }
    Some((mean, [cosine, sine], noise))
}

/// White noise of values that are smooth but for it.
pub(super) fn white(values: &[f64]) -> Noise {
    Noise {
        deviation: quantile::noise(values, [1.0, -2.0, 1.0]),
        ..Noise::default()
    }
}
