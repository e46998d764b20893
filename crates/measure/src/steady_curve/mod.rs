//! Torque over speed from slow runs, by two ways, and the inertia that one of them needs.
//!
//! ```text
//! direct:    reading of a torque sensor against speed            M(Ω)
//! inertial:  slope of the speed of a coasting rotor              M(Ω) = −I dΩ/dt
//! ```
//!
//! Both are smooth curves with a band. Residuals of such records are correlated; the band allows for it. The deviation of the
//! inertia shifts a whole curve, so it is kept apart. [`compare`] sets one curve against another: up against down, direct against
//! inertial.
//!
//! Not modelled: hysteresis inside one record, torque that changes with time at constant speed.

mod compare;
mod inertia;
mod spline;

pub use compare::{Difference, compare};
pub use inertia::{inertia_from_bifilar, inertia_from_known_torque, inertia_from_pendulum};

use crate::uncertain::Uncertain;
use spline::Spline;

/// A torque over speed with its band. All lists have the same length.
#[derive(Clone, Debug)]
pub struct SteadyCurve {
    /// Speeds, rad/s, as asked for.
    pub speed: Vec<f64>,
    /// Torque at these speeds; NaN where the record does not reach.
    pub torque: Vec<f64>,
    /// Standard deviation of the torque by noise and correlated residuals.
    pub deviation: Vec<f64>,
    /// Relative standard deviation that all torques share: of the inertia or of the sensor's calibration, or 0.
    pub scale_deviation: f64,
    /// Standard deviation of an error that all torques share: of the sensor's zero, or 0.
    pub zero_deviation: f64,
    /// Covariance of the torques by noise, by rows; 0 where the torque is NaN.
    pub covariance: Vec<Vec<f64>>,
    /// Residual of the fit, rms, in the unit of what was fitted.
    pub residual: f64,
    /// Correlation of residuals of neighbouring blocks.
    pub correlation: f64,
    /// What is not trustworthy.
    pub notes: Vec<String>,
}

impl SteadyCurve {
    /// Standard deviation of the torque with that of the scale and of the zero.
    pub fn whole_deviation(&self) -> Vec<f64> {
        let scale = self.scale_deviation;
        self.torque
            .iter()
            .zip(&self.deviation)
            .map(|(m, s)| s.hypot(scale * m).hypot(self.zero_deviation))
            .collect()
    }
}

/// Torque over speed from a torque that was measured beside the speed in a slow run.
///
/// `speed` in rad/s and `torque` in any unit at the same times, in the order of time; NaN where there is none. `at` are the
/// speeds that are asked for. The error says what is missing.
pub fn direct(speed: &[f64], torque: &[f64], at: &[f64]) -> Result<SteadyCurve, String> {
    if speed.len() != torque.len() {
        return Err(format!(
            "{} speeds and {} torques: they must be at the same times",
            speed.len(),
            torque.len()
        ));
    }
    let spline = Spline::fitted(speed, torque, 2)?;
    let rows: Vec<Option<Vec<f64>>> = at.iter().map(|&s| spline.row(s, 0)).collect();
    let mut curve = drawn(&spline, at, &rows, 1.0);
    told(&mut curve);
    Ok(curve)
}

/// Torque over speed from the coasting of a rotor, `M = −I dΩ/dt`: all the torque that brakes it, friction of other bearings and
/// windage included.
///
/// `first` and `interval` of time in s, `speed` in rad/s, NaN where there is none; `inertia` in kg m²; torque in N m. A run up
/// under a known drive is the same with the drive's torque added by the caller. `at` are the speeds that are asked for.
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
    let spline = Spline::fitted(&time, speed, 3)?;
    let (start, end) = spline.range();
    let steps = 400;
    let path: Vec<(f64, f64)> = (0..=steps)
        .filter_map(|k| {
            let t = start + (end - start) * k as f64 / steps as f64;
            spline.row(t, 0).map(|row| (t, spline.value(&row)))
        })
        .collect();
    let falls = path.windows(2).filter(|w| w[1].1 < w[0].1).count();
    let down = 2 * falls > path.len();
    let turned = if down { path.len() - 1 - falls } else { falls };
    let rows: Vec<Option<Vec<f64>>> = at
        .iter()
        .map(|&wanted| {
            let pair = path
                .windows(2)
                .find(|w| (w[0].1 - wanted) * (w[1].1 - wanted) <= 0.0 && w[0].1 != w[1].1)?;
            let part = (wanted - pair[0].1) / (pair[1].1 - pair[0].1);
            spline.row(pair[0].0 + part * (pair[1].0 - pair[0].0), 1)
        })
        .collect();
    let mut curve = drawn(&spline, at, &rows, -inertia.value);
    curve.scale_deviation = inertia.deviation / inertia.value;
    if turned > 0 {
        curve.notes.push(format!("the speed turns back during {turned} of {steps} parts of the record: the first pass counts"));
    }
    told(&mut curve);
    Ok(curve)
}

fn drawn(spline: &Spline, at: &[f64], rows: &[Option<Vec<f64>>], factor: f64) -> SteadyCurve {
    let torque = rows
        .iter()
        .map(|row| {
            row.as_ref()
                .map_or(f64::NAN, |row| factor * spline.value(row))
        })
        .collect();
    let covariance: Vec<Vec<f64>> = rows
        .iter()
        .map(|a| {
            rows.iter()
                .map(|b| match (a, b) {
                    (Some(a), Some(b)) => factor * factor * spline.covariance(a, b),
                    _ => 0.0,
                })
                .collect()
        })
        .collect();
    let deviation = (0..at.len())
        .map(|k| {
            if rows[k].is_some() {
                covariance[k][k].max(0.0).sqrt()
            } else {
                f64::NAN
            }
        })
        .collect();
    SteadyCurve {
        speed: at.to_vec(),
        torque,
        deviation,
        scale_deviation: 0.0,
        zero_deviation: 0.0,
        covariance,
        residual: spline.residual,
        correlation: spline.correlation,
        notes: spline.notes.clone(),
    }
}

fn told(curve: &mut SteadyCurve) {
    let outside = curve.torque.iter().filter(|t| t.is_nan()).count();
    if outside > 0 {
        curve.notes.push(format!(
            "{outside} of {} speeds lie outside the record and have no torque",
            curve.speed.len()
        ));
    }
}
