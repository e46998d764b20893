//! F as a map over speed and acceleration, from many tests.
//!
//! ```text
//!   F(Ω, Ω̇) = F0(Ω) + F1(Ω) |Ω̇|          F0, F1 smooth in Ω: normal processes, correlation ½ + ½ exp(-(ΔΩ)²/2ℓ²)
//!   data     means of F over the correlation time of the torque, where the balls are known to roll
//!   errors   noise of the means with its correlation in time; zero of each test; M's band, by its covariance; masses, common to all
//! ```
//! Sizes of F0 and F1 and the length ℓ are those of the highest marginal likelihood on a grid, neither smaller than what the data
//! leave of F0 or F1 at their best speed under the wide prior below: data cannot show that F is smaller than they resolve. Where no
//! data are the band returns to that size.
//!
//! Whether F is *known* at a place is asked of the data, not of F: what the same data, with the same errors, leave of a prior that
//! is wide and always the same.
//!
//! ```text
//!   known    V = k - kᵀ (K + E)⁻¹ k < (S/4)²     and a datum within a quarter of the range of speeds and accelerations
//!   S        mean of M over the arm of F: an F that is as large as all of M
//!   K, k     F0 and F1·(largest |Ω̇|) of deviation S each, ℓ a quarter of the largest speed;   E: the errors above
//! ```
//! So a bearing without F has the same known places as one with much of it.
//!
//! **Does not model**: dependence on load or temperature; unequal directions of rotation (Ω and F count along the rotation).

use super::{Loss, LossSettings, State, scale_part};
use crate::algebra::{Factor, dot};
use crate::measurement::Measurement;
use crate::moment::SteadyMoment;
use crate::series::{alike, trapezoid};
use nalgebra::{DMatrix, DVector};
use physics::rolling::RollingSet;
use problem::{note, note::Note};
use statistics::uncertain::Uncertain;

/// Most means that are used: their matrix is dense.
const MOST: usize = 240;
/// Distance to the nearest datum, in parts of the ranges of the data, up to which a place is known.
const NEAR: f64 = 0.25;
/// What the data may leave of the wide prior, over its size.
const LEFT: f64 = 0.25;
/// Lengths that are tried, and the first of them for the wide prior: over the largest speed.
const LENGTHS: [f64; 3] = [0.25, 0.75, 2.0];

/// One mean.
#[derive(Clone, Copy, Debug)]
struct Datum {
    test: usize,
    /// Age of the torque's noise, correlation times.
    age: f64,
    speed: f64,
    /// |Ω̇|.
    rate: f64,
    /// Ω̇ along the rotation.
    signed_rate: f64,
    friction: f64,
    /// Deviation by the noise of the torque, N.
    noise: f64,
    /// Deviation by the acceleration, N.
    by_rate: f64,
}

/// Sizes of the prior.
#[derive(Clone, Copy, Debug)]
struct Sizes {
    constant: f64,
    proportional: f64,
    length: f64,
}

impl Sizes {
    fn alike(&self, a: f64, b: f64) -> f64 {
        let apart = (a - b) / self.length;
        0.5 + 0.5 * (-0.5 * apart * apart).exp()
    }

    fn covariance(&self, a: (f64, f64), b: (f64, f64)) -> f64 {
        let amount = self.constant.powi(2) + self.proportional.powi(2) * a.1 * b.1;
        amount * self.alike(a.0, b.0)
    }
}

/// F over speed and acceleration.
#[derive(Clone, Debug)]
pub struct LossMap {
    data: Vec<Datum>,
    factor: Factor,
    weights: DVector<f64>,
    sizes: Sizes,
    /// The wide prior, and the factor of the data under it.
    wide: Sizes,
    wide_factor: Factor,
    range: (f64, f64, f64, f64),
    /// What is not trustworthy.
    pub notes: Vec<Note>,
}

/// F at a place of the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapPlace {
    /// F, N, along the rotation.
    pub friction: Uncertain,
    /// Whether data are near: the nearest below 0.25 of the range of speeds and of accelerations of the data, and what these data leave of a prior as wide as M is less than a quarter of it,
    /// whatever F is.
    pub known: bool,
}

impl LossMap {
    /// Fits the map to tests with their losses, in pairs, all against one steady moment.
    ///
    /// Refused: fewer than 8 means at which the balls are known to roll.
    pub fn fitted(
        tests: &[(&Measurement, &Loss)],
        steady: &SteadyMoment,
        set: &RollingSet<f64>,
        settings: &LossSettings,
    ) -> Result<Self, String> {
        steady.sound()?;
        settings.set_deviation.sound()?;
        let mut data = Vec::new();
        for (number, (test, loss)) in tests.iter().enumerate() {
            test.sound()?;
            if loss.points.len() != test.time.len() {
                return Err(format!("{}: loss and test have different times", test.name));
            }
            means(number, test, loss, set, &mut data);
        }
        if data.len() < 8 {
            return Err(format!(
                "{} means of F at which the balls are known to roll; at least 8 are needed for a map",
                data.len()
            ));
        }
        let mut notes = Vec::new();
        if data.len() > MOST {
            let step = data.len().div_ceil(MOST);
            notes.push(note!("every {}th of {} means is used", step, data.len()));
            data = data.into_iter().step_by(step).collect();
        }
        let errors = errors(&data, tests, steady, set, settings);
        let level =
            (data.iter().map(|d| d.friction.powi(2)).sum::<f64>() / data.len() as f64).sqrt();
        let span = |f: fn(&Datum) -> f64| {
            data.iter()
                .map(f)
                .fold((f64::INFINITY, 0.0), |(a, b): (f64, f64), x| {
                    (a.min(x), b.max(x))
                })
        };
        let (low, high) = span(|d| d.speed);
        let (least, most) = span(|d| d.rate);
        let floor = errors.diagonal().min().sqrt();
        let level = level.max(floor);
        let undetermined = "the means of F do not determine a map";
        let wide = wide(&data, steady, set.pocket_friction_arm(), high, most);
        let wide_factor = covered(&data, &errors, &wide).ok_or(undetermined)?;
        let tried = |least: f64, level: f64| {
            [0.03, 0.1, 0.3, 1.0, 3.0].map(|part| (part * level).max(least))
        };
        let constants = tried(
            least_left(&data, &wide_factor, &wide, wide.constant, |_| 1.0),
            level,
        );
        let proportionals = tried(
            least_left(&data, &wide_factor, &wide, wide.proportional, |d| d.rate),
            per(level, most),
        );
        let best =
            Self::sizes(&data, &errors, constants, proportionals, high).ok_or(undetermined)?;
        let factor = covered(&data, &errors, &best).ok_or(undetermined)?;
        let friction = DVector::from_iterator(data.len(), data.iter().map(|d| d.friction));
        if most - least < 0.2 * most {
            notes.push(note!(
                "all accelerations are from {:.0} to {:.0} rad/s²: F0 and F1 are hardly distinguished",
                least, most
            ));
        }
        Ok(Self {
            weights: factor.solved(&friction),
            factor,
            sizes: best,
            wide,
            wide_factor,
            range: (low, high, least, most),
            data,
            notes,
        })
    }

    /// The sizes of highest marginal likelihood among those that are tried, in rising order.
    ///
    /// - `high`: largest speed
    fn sizes(
        data: &[Datum],
        errors: &DMatrix<f64>,
        constants: [f64; 5],
        proportionals: [f64; 5],
        high: f64,
    ) -> Option<Sizes> {
        let friction: Vec<f64> = data.iter().map(|d| d.friction).collect();
        let distinct = |list: [f64; 5]| {
            let mut list = list.to_vec();
            list.dedup();
            list
        };
        let (constants, proportionals) = (distinct(constants), distinct(proportionals));
        let mut best: Option<(f64, Sizes)> = None;
        for length in LENGTHS {
            for &constant in &constants {
                for &proportional in &proportionals {
                    let sizes = Sizes {
                        constant,
                        proportional,
                        length: length * high,
                    };
                    let Some(factor) = covered(data, errors, &sizes) else {
                        continue;
                    };
                    let square = whitened_square(&factor, friction.clone());
                    let log = -0.5 * (square + factor.log_determinant);
                    if best.is_none_or(|(top, _)| log > top) {
                        best = Some((log, sizes));
                    }
                }
            }
        }
        best.map(|(_, sizes)| sizes)
    }

    /// F at a speed and an acceleration, either sign.
    ///
    /// - `speed`: Ω, rad/s
    /// - `acceleration`: Ω̇, rad/s²
    pub fn at(&self, speed: f64, acceleration: f64) -> MapPlace {
        let place = (speed.abs(), acceleration.abs());
        let with = |d: &Datum| self.sizes.covariance(place, (d.speed, d.rate));
        let row: Vec<f64> = self.data.iter().map(with).collect();
        let value = dot(&row, self.weights.as_slice());
        let variance = self.sizes.covariance(place, place) - whitened_square(&self.factor, row);
        let (low, high, least, most) = self.range;
        let wide = |x: f64, scale: f64| x / scale.max(1e-300);
        let nearest = self
            .data
            .iter()
            .map(|d| {
                wide(place.0 - d.speed, high - low).hypot(wide(place.1 - d.rate, most - least))
            })
            .fold(f64::INFINITY, f64::min);
        MapPlace {
            friction: Uncertain::new(value, variance.max(0.0).sqrt()),
            known: nearest < NEAR && self.left(place) < LEFT * self.wide.constant,
        }
    }

    /// What the data leave of the wide prior at a place, N.
    fn left(&self, place: (f64, f64)) -> f64 {
        let with = |d: &Datum| self.wide.covariance(place, (d.speed, d.rate));
        let row: Vec<f64> = self.data.iter().map(with).collect();
        let variance = self.wide.covariance(place, place) - whitened_square(&self.wide_factor, row);
        variance.max(0.0).sqrt()
    }
}

/// A size over the largest rate; 0 where nothing accelerates.
fn per(size: f64, most: f64) -> f64 {
    if most > 0.0 { size / most } else { 0.0 }
}

/// The prior against which data are weighed: F as large as all of M.
fn wide(data: &[Datum], steady: &SteadyMoment, arm: f64, high: f64, most: f64) -> Sizes {
    let moment = |d: &Datum| steady.without_scale(d.speed).map_or(0.0, |m| m.value.abs());
    let size = data.iter().map(moment).sum::<f64>() / (arm * data.len() as f64);
    Sizes {
        constant: size,
        proportional: per(size, most),
        length: LENGTHS[0] * high,
    }
}

/// The least that the data leave, under the wide prior, of F0 or F1 at any of their speeds.
///
/// - `size`: deviation of that part under the prior
/// - `share`: what a datum holds of it
fn least_left(
    data: &[Datum],
    factor: &Factor,
    wide: &Sizes,
    size: f64,
    share: impl Fn(&Datum) -> f64,
) -> f64 {
    let left = data.iter().map(|at| {
        let row: Vec<f64> = (data.iter())
            .map(|d| size * size * share(d) * wide.alike(at.speed, d.speed))
            .collect();
        (size * size - whitened_square(factor, row)).max(0.0).sqrt()
    });
    left.fold(f64::INFINITY, f64::min)
}

/// vᵀ C⁻¹ v of a covariance C.
fn whitened_square(factor: &Factor, mut vector: Vec<f64>) -> f64 {
    factor.whiten(&mut vector);
    dot(&vector, &vector)
}

/// Factor of the covariance of the data.
fn covered(data: &[Datum], errors: &DMatrix<f64>, sizes: &Sizes) -> Option<Factor> {
    let place = |i: usize| (data[i].speed, data[i].rate);
    Factor::of(DMatrix::from_fn(data.len(), data.len(), |i, j| {
        errors[(i, j)] + sizes.covariance(place(i), place(j))
    }))
}

/// Means of F over the correlation time, where the balls roll and the speed does not change by more than a tenth of its range.
fn means(
    number: usize,
    test: &Measurement,
    loss: &Loss,
    set: &RollingSet<f64>,
    data: &mut Vec<Datum>,
) {
    let arm = set.pocket_friction_arm();
    let inertia = set.outer_inertia() / arm;
    let age = test.noise_age();
    // by time: rows lie closer where the speed bends
    let weights = trapezoid(&test.time);
    let top = test.speed.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
    let fastest = test
        .acceleration
        .iter()
        .fold(0.0, |a: f64, x| a.max(x.abs()));
    let mut start = 0;
    while start < loss.points.len() {
        if loss.points[start].state != State::Rolling {
            start += 1;
            continue;
        }
        let first = loss.points[start];
        let mut end = start;
        while end < loss.points.len() {
            let point = loss.points[end];
            let ends = point.state != State::Rolling
                || (point.speed - first.speed).abs() > 0.1 * top
                || (point.acceleration - first.acceleration).abs() > 0.1 * fastest
                || point.time - first.time
                    > test.correlation_time[start]
                        .max(0.02 * (test.time[test.time.len() - 1] - test.time[0]));
            if ends && end > start {
                break;
            }
            end += 1;
        }
        let whole: f64 = weights[start..end].iter().sum();
        let sign = first.speed.signum();
        let mean =
            |f: &dyn Fn(usize) -> f64| (start..end).map(|k| weights[k] * f(k)).sum::<f64>() / whole;
        let friction = mean(&|k| loss.points[k].friction.map_or(0.0, |f| sign * f.value));
        // errors within a mean are taken as one: at most too wide
        let noise = mean(&|k| test.torque_noise(k)) / arm;
        let rate = mean(&|k| test.acceleration_deviation[k]) * inertia;
        let signed_rate = sign * mean(&|k| test.acceleration[k]);
        data.push(Datum {
            test: number,
            age: mean(&|k| age[k]),
            speed: mean(&|k| test.speed[k].abs()),
            rate: signed_rate.abs(),
            signed_rate,
            friction,
            noise,
            by_rate: rate,
        });
        start = end;
    }
}

/// Covariance of the errors of the means.
fn errors(
    data: &[Datum],
    tests: &[(&Measurement, &Loss)],
    steady: &SteadyMoment,
    set: &RollingSet<f64>,
    settings: &LossSettings,
) -> DMatrix<f64> {
    let arm = set.pocket_friction_arm();
    let inertia = set.outer_inertia();
    let own = &settings.set_deviation;
    let mass = own.outer_inertia(set) / arm;
    let scale: Vec<f64> = data
        .iter()
        .map(|d| {
            let moment = steady.without_scale(d.speed).map_or(0.0, |m| m.value);
            let torque = moment + arm * d.friction - inertia * d.signed_rate;
            scale_part(tests[d.test].0, torque, moment) / arm
        })
        .collect();
    let mut sum = DMatrix::zeros(data.len(), data.len());
    for (i, a) in data.iter().enumerate() {
        for (j, b) in data.iter().enumerate().take(i + 1) {
            let mut value = steady.covariance_between(a.speed, b.speed).unwrap_or(0.0)
                / (arm * arm)
                + mass * mass * a.signed_rate * b.signed_rate
                + own.inner_track_radius.powi(2) * a.friction * b.friction
                + scale[i] * scale[j];
            if a.test == b.test {
                let test = tests[a.test].0;
                value +=
                    (test.zero_deviation / arm).powi(2) + a.noise * b.noise * alike(a.age - b.age);
            }
            if i == j {
                // a thousandth of the rest keeps exact data solvable
                value += a.by_rate.powi(2);
                value += 1e-6 * value + 1e-300;
            }
            sum[(i, j)] = value;
            sum[(j, i)] = value;
        }
    }
    sum
}
