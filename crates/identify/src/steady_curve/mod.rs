//! Torque over speed from slow runs of which no bearing is known, by two methods.
//!
//! ```text
//! direct:    reading of a torque sensor against speed            M(Ω)
//! inertial:  slope of the speed of a coasting rotor              M(Ω) = −I dΩ/dt
//! ```
//!
//! Both are smooth curves with a band, fitted as the spline of [`moment`](mod@crate::moment) is: sixteen cubic B-splines, residuals a
//! first-order autoregression, smoothness, noise and correlation summed over. The deviation of the inertia shifts a whole curve,
//! so it is kept apart. [`compare`] sets one curve against another: up against down, direct against inertial.
//!
//! Not modelled: hysteresis inside one record, torque that changes with time at constant speed.

mod compare;

pub use compare::{Difference, compare};

use crate::regression::{Data, Posterior, spline, weighed};
use nalgebra::DMatrix;
use problem::{note, note::Note};
use statistics::uncertain::Uncertain;

/// About as many means as are fitted. Few, so that noise faster than a mean averages out and what is left is near a first-order
/// autoregression.
const MEANS: usize = 80;

/// Smoothness that is tried, parts of the level: of second differences in a torque over speed; of third ones in a speed over time,
/// which falls nearly evenly.
const OF_TORQUE: [f64; 6] = [0.001, 0.003, 0.01, 0.03, 0.1, 0.3];
const OF_SPEED: [f64; 8] = [3e-5, 1e-4, 3e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1];

/// Correlation of the residuals above which slow noise may be taken for the shape of a curve.
const INSEPARABLE: f64 = 0.95;

/// A torque over speed with its band. All lists have the same length.
#[derive(Clone, Debug, Default)]
pub struct SteadyCurve {
    /// Speeds, rad/s, as given.
    pub speed: Vec<f64>,
    /// Torque at these speeds; NaN where the record does not reach.
    pub torque: Vec<f64>,
    /// Relative standard deviation that all torques share: of the inertia or of the sensor's calibration, or 0.
    pub scale_deviation: f64,
    /// Standard deviation of an error that all torques share: of the sensor's zero, or 0.
    pub zero_deviation: f64,
    /// Covariance of the torques by noise, by rows; 0 where the torque is NaN.
    pub covariance: Vec<Vec<f64>>,
    /// The part of it that is not the record's: how far the curve may leave what its smoothness makes of the record. Of two records
    /// of one curve it is the same in both. Empty where it is not known.
    pub smoothing: Vec<Vec<f64>>,
    /// What is not trustworthy.
    pub notes: Vec<Note>,
}

impl SteadyCurve {
    /// Standard deviation of the torque by noise and correlated residuals; NaN where the record does not reach.
    pub fn deviation(&self) -> Vec<f64> {
        let variance = (0..self.speed.len()).map(|k| self.covariance[k][k].max(0.0));
        (variance.zip(&self.torque))
            .map(|(v, m)| if m.is_nan() { f64::NAN } else { v.sqrt() })
            .collect()
    }

    /// Standard deviation of the torque with that of the scale and of the zero.
    pub fn whole_deviation(&self) -> Vec<f64> {
        let own = self.deviation().into_iter().zip(&self.torque);
        own.map(|(s, m)| s.hypot(self.scale_deviation * m).hypot(self.zero_deviation))
            .collect()
    }
}

/// Torque over speed from a torque that was measured beside the speed in a slow run.
///
/// `speed` in rad/s and `torque` in any unit at the same times, at equal intervals; NaN where there is none. `at` are the speeds of
/// the curve. The error says what is missing.
pub fn direct(speed: &[f64], torque: &[f64], at: &[f64]) -> Result<SteadyCurve, String> {
    if speed.len() != torque.len() {
        return Err(format!(
            "{} speeds and {} torques: they must be at the same times",
            speed.len(),
            torque.len()
        ));
    }
    let smooth = Smooth::fitted(speed, torque, 2, &OF_TORQUE)?;
    let rows: Vec<_> = at.iter().map(|&speed| smooth.row(speed, 0)).collect();
    Ok(smooth.drawn(at, &rows, 1.0))
}

/// Torque over speed from the coasting of a rotor, `M = −I dΩ/dt`: all the torque that brakes it, friction of other bearings and
/// windage included.
///
/// `first` and `interval` of time in s, `speed` in rad/s, NaN where there is none; `inertia` in kg m²; torque in N m. A run up
/// under a known drive is the same with the drive's torque added by the caller. `at` are the speeds of the curve.
///
/// Source: definition of inertia.
pub fn inertial(
    first: f64,
    interval: f64,
    speed: &[f64],
    inertia: Uncertain,
    at: &[f64],
) -> Result<SteadyCurve, String> {
    if !(interval > 0.0 && interval.is_finite() && first.is_finite()) {
        return Err("the interval of the speed must be positive and finite".into());
    }
    if !(inertia.is_sound() && inertia.value > 0.0) {
        return Err("the inertia must be positive and finite".into());
    }
    let time: Vec<f64> = (0..speed.len())
        .map(|k| first + k as f64 * interval)
        .collect();
    let smooth = Smooth::fitted(&time, speed, 3, &OF_SPEED)?;
    let (start, end) = smooth.range;
    let steps = 400;
    let path: Vec<(f64, f64)> = (0..=steps)
        .map(|k| start + (end - start) * f64::from(k) / f64::from(steps))
        .filter_map(|t| Some((t, smooth.value(&smooth.row(t, 0)?))))
        .collect();
    let falls = path.windows(2).filter(|w| w[1].1 < w[0].1).count();
    let down = 2 * falls > path.len();
    let turned = if down { path.len() - 1 - falls } else { falls };
    let rows: Vec<_> = at
        .iter()
        .map(|&wanted| {
            let pair = path
                .windows(2)
                .find(|w| (w[0].1 - wanted) * (w[1].1 - wanted) <= 0.0 && w[0].1 != w[1].1)?;
            let part = (wanted - pair[0].1) / (pair[1].1 - pair[0].1);
            smooth.row(pair[0].0 + part * (pair[1].0 - pair[0].0), 1)
        })
        .collect();
    let mut curve = smooth.drawn(at, &rows, -inertia.value);
    curve.scale_deviation = inertia.deviation / inertia.value;
    if turned > 0 {
        curve.notes.push(note!(
            "the speed turns back during {} of {} parts of the record: the first pass counts",
            turned,
            steps
        ));
    }
    Ok(curve)
}

/// A smooth curve through noisy values whose residuals are correlated.
struct Smooth {
    range: (f64, f64),
    posterior: Posterior,
    notes: Vec<Note>,
}

impl Smooth {
    /// Fits a curve whose coefficients' differences of an order are small. Values are in the order in which they were taken.
    fn fitted(x: &[f64], y: &[f64], order: usize, smoothness: &[f64]) -> Result<Self, String> {
        let mut notes = Vec::new();
        let known: Vec<usize> = (0..x.len())
            .filter(|&k| x[k].is_finite() && y[k].is_finite())
            .collect();
        if known.len() < x.len() {
            notes.push(note!(
                "{} of {} values are missing",
                x.len() - known.len(),
                x.len()
            ));
        }
        let size = ((known.len() as f64 / MEANS as f64).round() as usize).max(1);
        let mut data = Data::default();
        for run in known.chunk_by(|a, b| b - a == 1) {
            let part = run[0]..run[0] + run.len();
            data.add(&x[part.clone()], &y[part], &vec![1.0; run.len()], size);
        }
        let least = 2 * spline::SPLINES;
        if data.x.len() < least {
            return Err(format!(
                "the part gives {} values (whole turns of the shaft, or values of a channel), in {} means without a gap, and {least} are needed: a longer part, or more values a second",
                known.len(),
                data.x.len(),
            ));
        }
        let span = |list: &[f64]| {
            list.iter()
                .fold((f64::MAX, f64::MIN), |(a, b), &v| (a.min(v), b.max(v)))
        };
        let range = span(&data.x);
        if range.1 <= range.0 || !(range.1 - range.0).is_finite() {
            return Err("the values all lie at one place".into());
        }
        let (low, high) = span(&data.y);
        if high <= low || !(high - low).is_finite() {
            return Err("the values do not change".into());
        }
        let rows = data.x.iter().flat_map(|&x| spline::row(x, range, 0));
        let columns = DMatrix::from_row_iterator(data.x.len(), spline::SPLINES, rows);
        let precisions = spline::precisions(data.level(), order, smoothness);
        let posterior =
            weighed(&data, &columns, &precisions).ok_or("the values do not determine a curve")?;
        if posterior.correlation > INSEPARABLE {
            notes.push(note!(
                "residuals of neighbouring values correlate by {:.3}: slow noise and the shape of the curve are hard to separate",
                posterior.correlation
            ));
        }
        Ok(Self {
            range,
            posterior,
            notes,
        })
    }

    /// Weights of the coefficients in the curve (`derivative` 0) or its slope (1); none outside the range.
    fn row(&self, x: f64, derivative: usize) -> Option<Vec<f64>> {
        (x >= self.range.0 && x <= self.range.1).then(|| spline::row(x, self.range, derivative))
    }

    fn value(&self, row: &[f64]) -> f64 {
        crate::algebra::dot(row, self.posterior.mean.as_slice())
    }

    /// The curve whose torques are a factor times weighted sums of the coefficients.
    fn drawn(self, at: &[f64], rows: &[Option<Vec<f64>>], factor: f64) -> SteadyCurve {
        let inside: Vec<usize> = (0..at.len()).filter(|&k| rows[k].is_some()).collect();
        let weights = DMatrix::from_row_iterator(
            inside.len(),
            spline::SPLINES,
            rows.iter().flatten().flatten().copied(),
        );
        let (values, own) = self.posterior.drawn(&weights);
        let smoothing = self.posterior.drawn_prior(&weights);
        let mut curve = SteadyCurve {
            speed: at.to_vec(),
            torque: vec![f64::NAN; at.len()],
            covariance: vec![vec![0.0; at.len()]; at.len()],
            smoothing: vec![vec![0.0; at.len()]; at.len()],
            notes: self.notes,
            ..SteadyCurve::default()
        };
        for (i, &to) in inside.iter().enumerate() {
            curve.torque[to] = factor * values[i];
            for (j, &with) in inside.iter().enumerate() {
                curve.covariance[to][with] = factor * factor * own[(i, j)];
                curve.smoothing[to][with] = factor * factor * smoothing[(i, j)];
            }
        }
        if inside.len() < at.len() {
            curve.notes.push(note!(
                "{} of {} speeds lie outside the record and have no torque",
                at.len() - inside.len(),
                at.len()
            ));
        }
        curve
    }
}
