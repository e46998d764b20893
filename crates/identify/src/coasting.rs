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
use measure::interpolation::place;
use measure::uncertain::Uncertain;
use physics::rolling::RollingSet;

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
mod tests {
    use super::*;

    const LAW: Windage = Windage::Law {
        coefficients: [1e-3, 2e-5, 1e-7],
        deviation: 0.1,
    };

    #[test]
    fn a_windage_is_taken_out_with_its_error_and_that_of_the_inertia() {
        // by hand at 100 rad/s: 1 + 2 + 1 N mm
        assert!((LAW.at(100.0).unwrap() - 4e-3).abs() < 1e-15);
        let mut curve = SteadyCurve {
            speed: vec![100.0],
            torque: vec![10e-3],
            covariance: vec![vec![0.0]],
            scale_deviation: 0.02,
            ..SteadyCurve::default()
        };
        LAW.taken_out(&mut curve);
        assert!((curve.torque[0] - 6e-3).abs() < 1e-15);
        // the inertia's 2 % of the whole 10 N mm, the windage's 10 % of 4
        let wanted = (0.02_f64 * 10e-3).hypot(0.1 * 4e-3);
        assert!((curve.whole_deviation()[0] / wanted - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_curve_reaches_a_little_beyond_its_ends() {
        let curve = Windage::Curve(SteadyCurve {
            speed: vec![0.0, 20.0, 60.0, 120.0],
            torque: vec![f64::NAN, 1e-3, 3e-3, 5e-3],
            covariance: vec![vec![1e-8; 4]; 4],
            ..SteadyCurve::default()
        });
        assert!((curve.at(40.0).unwrap() - 2e-3).abs() < 1e-15);
        assert!((curve.at(124.0).unwrap() - 5e-3).abs() < 1e-15);
        assert!(curve.at(130.0).is_none() && curve.at(10.0).is_none());
        assert!((curve.covariance(40.0, 90.0).unwrap() - 1e-8).abs() < 1e-20);
    }

    #[test]
    fn the_torque_of_a_coast_down_is_the_inertia_times_its_slope() {
        let set = RollingSet {
            inner_track_radius: 15e-3,
            ball_ratio: 0.2,
            balls_mass: 0.01,
            cage_mass: 5e-3,
        };
        // M = 8 N mm + the windage, I = 4e-4: Euler's steps of 10 ms
        let inertia = 4e-4;
        let mut speed = vec![150.0];
        while speed.len() < 400 {
            let last: f64 = speed[speed.len() - 1];
            speed.push(last - 0.01 * (8e-3 + LAW.at(last).unwrap()) / inertia);
        }
        let run = Coasting {
            name: "coast",
            load: 60.0,
            clock: (0.0, 0.01),
            speed: &speed,
            inertia: Uncertain::new(inertia, 0.01 * inertia),
            windage: Some(&LAW),
            set: &set,
        };
        let found = coasting(&run).unwrap();
        assert_eq!(found.time.len(), 399);
        assert!(found.sound().is_ok());
        for k in [0, 200, 398] {
            let moment = found.torque[k] + set.outer_inertia() * found.acceleration[k];
            // the windage at the middle of a step beside that at its begin: 0.005 of it
            assert!((moment / 8e-3 - 1.0).abs() < 5e-3, "{moment}");
        }
        let short = Coasting {
            speed: &speed[..10],
            ..run
        };
        assert!(coasting(&short).unwrap_err().contains("24 are needed"));
    }
}
