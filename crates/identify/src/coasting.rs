//! A coast-down of which no torque was measured: what brakes the shaft is its inertia times its deceleration.
//!
//! ```text
//! M(Ω) = -I Ω̇ - w(Ω)      Ω̇ = (Ω_k+1 - Ω_k)/Δt from speeds at equal times,  w: what brakes the shaft without the bearing
//! ```
//! The differences are not smoothed: their noise is left to the fit of M, which would take what a smoother makes of it for shape.
//! The inertia's error is that of a scale; with a windage also of what the windage hides of it, see [`Windage::covariance`].
//!
//! **Does not model**: a torque of other bearings on the shaft that the windage does not hold.

use crate::measurement::Measurement;
use crate::moment::Moment;
use crate::steady_curve::SteadyCurve;
use physics::rolling::RollingSet;
use statistics::interpolation::place;
use statistics::uncertain::Uncertain;

/// What brakes a shaft without the bearing.
#[derive(Clone, Debug)]
pub enum Windage {
    /// A law a + b Ω + c Ω² with the relative standard deviation of all of it.
    Law {
        /// a, N m; b, N m s; c, N m s².
        coefficients: [f64; 3],
        /// Its relative standard deviation, 1.
        deviation: f64,
    },
    /// A curve from a run without the bearing.
    Curve(SteadyCurve),
}

/// Part of the range of a curve by which a speed may lie outside and still count as its end: ends of records differ.
const BEYOND: f64 = 0.05;

impl Windage {
    /// Its torque at a speed, N m; none where a curve does not reach.
    pub fn at(&self, speed: f64) -> Option<f64> {
        match self {
            Windage::Law {
                coefficients: [a, b, c],
                ..
            } => Some(a + (b + c * speed.abs()) * speed.abs()),
            Windage::Curve(curve) => {
                let (low, high, part) = around(curve, speed)?;
                Some((1.0 - part) * curve.torque[low] + part * curve.torque[high])
            }
        }
    }

    /// Covariance of its torques at two speeds, (N m)², its scale and zero included; none where a curve does not reach.
    pub fn covariance(&self, first: f64, second: f64) -> Option<f64> {
        let both = self.at(first)? * self.at(second)?;
        match self {
            Windage::Law { deviation, .. } => Some(deviation * deviation * both),
            Windage::Curve(curve) => {
                let ((a, b, u), (c, d, v)) = (around(curve, first)?, around(curve, second)?);
                let of = &curve.covariance;
                let noise = (1.0 - u) * ((1.0 - v) * of[a][c] + v * of[a][d])
                    + u * ((1.0 - v) * of[b][c] + v * of[b][d]);
                Some(noise + curve.scale_deviation.powi(2) * both + curve.zero_deviation.powi(2))
            }
        }
    }

    /// Takes it out of a torque by the slope of the speed, where that has one; its error, and the inertia's of what was taken out,
    /// are added.
    pub fn taken_out(&self, of: &mut SteadyCurve) {
        let whole = of.torque.clone();
        let count = of.speed.len();
        let own: Vec<Option<f64>> = of.speed.iter().map(|speed| self.at(*speed)).collect();
        for (torque, own) in of.torque.iter_mut().zip(&own) {
            *torque -= own.unwrap_or(f64::NAN);
        }
        let scale = of.scale_deviation.powi(2);
        for i in 0..count {
            for j in 0..count {
                let Some(windage) = self.covariance(of.speed[i], of.speed[j]) else {
                    continue;
                };
                let inertia = scale * (whole[i] * whole[j] - of.torque[i] * of.torque[j]);
                if inertia.is_finite() {
                    of.covariance[i][j] += windage + inertia;
                }
            }
        }
    }

    /// Adds its error to a moment that was fitted behind it: `scale_deviation` is that of the inertia, 1.
    pub fn left_open(&self, moment: &mut Moment, scale_deviation: f64) {
        let curves = moment.forms.iter_mut().map(|form| &mut form.curve);
        for curve in curves.chain([&mut moment.curve]) {
            let (speed, own) = (curve.speed.clone(), curve.moment.clone());
            let windage: Vec<f64> = (speed.iter()).map(|s| self.at(*s).unwrap_or(0.0)).collect();
            for i in 0..speed.len() {
                for j in 0..speed.len() {
                    // (M + w)(M + w)' - M M'
                    let hidden =
                        own[i] * windage[j] + windage[i] * own[j] + windage[i] * windage[j];
                    curve.covariance[i][j] += self.covariance(speed[i], speed[j]).unwrap_or(0.0)
                        + scale_deviation.powi(2) * hidden;
                }
            }
        }
    }
}

/// Indices and part between two speeds of a curve that have a torque; beyond its ends, a little, its end.
fn around(curve: &SteadyCurve, speed: f64) -> Option<(usize, usize, f64)> {
    let known: Vec<usize> = (0..curve.speed.len())
        .filter(|&k| curve.torque[k].is_finite())
        .collect();
    let speeds: Vec<f64> = known.iter().map(|&k| curve.speed[k]).collect();
    let (low, high) = (*speeds.first()?, *speeds.last()?);
    let margin = BEYOND * (high - low);
    if speed.abs() < low - margin || speed.abs() > high + margin {
        return None;
    }
    let (next, part) = place(&speeds, speed.abs().clamp(low, high))?;
    Some((known[next - 1], known[next], part))
}

/// A coast-down without a torque.
#[derive(Clone, Copy)]
pub struct Coasting<'a> {
    /// Name for messages.
    pub name: &'a str,
    /// Radial load on the bearing, N.
    pub load: f64,
    /// Time of the first speed and interval, s.
    pub clock: (f64, f64),
    /// Speeds at equal times, rad/s; not-a-number where there is none.
    pub speed: &'a [f64],
    /// Inertia of all that coasts, kg m².
    pub inertia: Uncertain,
    /// What brakes the shaft without the bearing, where it is known.
    pub windage: Option<&'a Windage>,
    /// Balls and cage.
    pub set: &'a RollingSet<f64>,
}

/// Fewest speeds of a coast-down: sixteen means of M need as many differences.
const FEWEST: usize = 24;

/// The measurement that a coast-down without a torque is: its torque is that at the outer race which the deceleration shows.
///
/// Formula: t_O = -I Ω̇ - w(Ω) - J_O Ω̇, so that t_O + J_O Ω̇ is M
///
/// Source: definition of inertia.
pub fn coasting(run: &Coasting) -> Result<Measurement, String> {
    let (first, interval) = run.clock;
    let outer = run.set.outer_inertia();
    let known = run.speed.iter().filter(|speed| speed.is_finite()).count();
    if known < FEWEST {
        return Err(format!(
            "the coast-down gives {known} speeds, and {FEWEST} are needed: a longer part (signals.steady.from, to), or more values a second"
        ));
    }
    // Third differences let pass what is smooth; white noise has √20 of its deviation in them.
    let square: Vec<f64> = (run.speed.windows(4))
        .map(|w| (w[3] - 3.0 * w[2] + 3.0 * w[1] - w[0]).powi(2) / 20.0)
        .filter(|square| square.is_finite())
        .collect();
    let noise = (square.iter().sum::<f64>() / square.len().max(1) as f64).sqrt();
    let deviation = 2.0_f64.sqrt() * noise / interval;
    let mut measurement = Measurement {
        name: run.name.to_string(),
        load: run.load,
        time: Vec::new(),
        speed: Vec::new(),
        speed_deviation: Vec::new(),
        acceleration: Vec::new(),
        acceleration_deviation: Vec::new(),
        torque: Vec::new(),
        torque_deviation: Vec::new(),
        zero_deviation: 0.0,
        scale_deviation: run.inertia.deviation / run.inertia.value,
        correlation_time: Vec::new(),
        engagement: None,
        engagement_deviation: 0.0,
        rest_before: None,
        cage: None,
        temperature: None,
    };
    for (k, pair) in run.speed.windows(2).enumerate() {
        let (speed, acceleration) = (0.5 * (pair[0] + pair[1]), (pair[1] - pair[0]) / interval);
        let windage = run.windage.map_or(Some(0.0), |windage| windage.at(speed));
        let Some(windage) = windage.filter(|_| speed.is_finite()) else {
            continue;
        };
        measurement.time.push(first + (k as f64 + 0.5) * interval);
        measurement.speed.push(speed);
        measurement.speed_deviation.push(noise);
        measurement.acceleration.push(acceleration);
        measurement.acceleration_deviation.push(deviation);
        let moment = -run.inertia.value * acceleration - windage * speed.signum();
        measurement.torque.push(moment - outer * acceleration);
        measurement
            .torque_deviation
            .push(run.inertia.value * deviation);
        measurement.correlation_time.push(interval);
    }
    if measurement.time.len() < FEWEST {
        return Err("the run without bearing shows no windage at the speeds of this coast-down: both need the same range of speeds".into());
    }
    Ok(measurement)
}

#[cfg(test)]
#[path = "../tests/unit/coasting.rs"]
mod tests;
