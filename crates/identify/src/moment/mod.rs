//! The steady moment M(Ω) from slow tests.
//!
//! ```text
//!   y = (t_O + J_O Ω̇) sgn Ω  =  M(|Ω|) + zero of the test + noise          means over equal times, |Ω̇| small, balls roll
//!
//!   Palmgren   M = f0·1e-7 d_m³ max(160, (ν n)^(2/3)) + M1      two coefficients; without ν twelve viscosities for its floor
//!   SKF        M = a φ_ish φ_rs (ν n)^0.6 + b μ_sl(Ω) + c n²    factors on the law's parts; without a law φ = 1, μ_sl constant
//!   spline     sixteen cubic B-splines, second differences drawn to 0 as strongly as the data ask
//! ```
//! Every coefficient has a normal prior about 0, its shape scaled to the root mean square 1 over the data and its deviation the
//! root mean square of the torque; zeros have the deviation that the measurement states. Noise is a first-order autoregression
//! of unknown size and correlation, so that correlated residuals do not count as so many data. The forms' probabilities follow
//! from their marginal likelihoods, equal odds before. The curve is the mean over the forms by probability, its band holds their
//! disagreement. Coefficients of these forms correlate by 0.98 and more with each other and with the zero: the curve is the result,
//! not they.
//!
//! **Does not model**: a moment that changes with time, temperature or direction inside one call (up against down is compared,
//! not averaged away); noise slower than the test, other than its zero; F in slow tests (taken as 0).
//!
//! Measured (`tests/moment.rs`, 400 made-up coast-downs with another law, another noise and a nonlinear sensor): the band of two
//! deviations holds the true moment at 95.5 % of all speeds after one coast-down of 20 s, at 94.8 % after three of 3 s.
//! Noise alike over 0.6 s, a smoothed one and no autoregression, makes the band wider than it need be: 98.7 %.

mod blocks;
mod curve;
mod forms;
mod unequal;

pub use curve::SteadyMoment;
pub use unequal::Unequal;

use crate::algebra::log_sum_exp;
use crate::measurement::Measurement;
use crate::regression::{Posterior, weighed};
use crate::steady_curve::{Difference, SteadyCurve, compare};
use blocks::Blocks;
use forms::Member;
use measure::uncertain::Uncertain;
use nalgebra::DMatrix;
use physics::rolling::RollingSet;
use physics::skf::SkfMoment;

/// A form of the steady moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Form {
    /// A power 2/3 of speed with a floor, and a constant.
    Palmgren,
    /// A power 0.6 of speed with its two factors, sliding, drag.
    Skf,
    /// Any smooth curve.
    Spline,
}

/// What is known beside the tests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentSettings {
    /// Kinematic viscosity ν, m²/s: sets Palmgren's floor; none where it is not known.
    pub viscosity: Option<f64>,
    /// The SKF law of this bearing with its lubricant; none where it is not known.
    pub skf: Option<SkfMoment<f64>>,
    /// Largest |Ω̇| of slow running, rad/s².
    pub slow_acceleration: f64,
    /// Least |Ω| that counts as turning, rad/s.
    pub least_speed: f64,
}

impl Default for MomentSettings {
    /// Slow is below 300 rad/s²: the part of inertia, which is taken out, is then 1 % of the moment of a greased 6005.
    /// Turning is above 1 rad/s: all laws fade below.
    fn default() -> Self {
        Self {
            viscosity: None,
            skf: None,
            slow_acceleration: 300.0,
            least_speed: 1.0,
        }
    }
}

/// A number of a form.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Name: of the law's quantity, or "zero of" a test.
    pub name: String,
    /// Its unit.
    pub unit: &'static str,
    /// Value and deviation.
    pub value: Uncertain,
}

/// What the data say of one form.
#[derive(Clone, Debug, PartialEq)]
pub struct FormFit {
    /// The form.
    pub form: Form,
    /// Its probability among the forms.
    pub probability: f64,
    /// Logarithm of the marginal likelihood of the data, (N m)^-n.
    pub log_evidence: f64,
    /// Its parameters, those of a law first, then the zeros; a spline has only zeros.
    pub parameters: Vec<Parameter>,
    /// Their correlations, by rows.
    pub correlation: Vec<Vec<f64>>,
    /// Viscosity of the floor that fits best, m²/s; given or chosen; of Palmgren's form alone.
    pub viscosity: Option<f64>,
    /// The curve of this form.
    pub curve: SteadyMoment,
    /// Deviation of one mean, N m.
    pub noise: f64,
    /// Correlation of the errors of neighbouring means.
    pub noise_correlation: f64,
}

/// The steady moment of slow tests.
#[derive(Clone, Debug)]
pub struct Moment {
    /// The forms, the most probable first.
    pub forms: Vec<FormFit>,
    /// Mean over the forms, its band with their disagreement.
    pub curve: SteadyMoment,
    /// Number of means that were fitted.
    pub data: usize,
    /// How many independent data they are worth.
    pub effective_data: f64,
    /// Moment speeding up minus moment slowing down, where the tests have both.
    pub up_against_down: Option<Difference>,
    /// The two slow tests of one direction that differ most, where they differ by more than their bands.
    pub unequal: Option<Unequal>,
    /// What is not trustworthy.
    pub notes: Vec<String>,
}

impl Moment {
    /// The most probable form.
    pub fn best(&self) -> &FormFit {
        &self.forms[0]
    }
}

/// Deviation of M outside the speeds at which it was measured, over M at the nearest of them, where it has to be carried on: it may
/// be anything from none to twice that; assumed.
pub(crate) const CARRIED_ON: f64 = 0.5;

/// Loads that differ by less count as one, relative: dead weights are known better.
pub(crate) const SAME_LOAD: f64 = 0.02;

/// Number of speeds of a curve.
const SPEEDS: usize = 81;

/// The steady moment from slow tests at one load.
///
/// - `tests`: slow tests, or tests with slow parts; quick parts and rest are left out
/// - `set`: balls and cage, for the small part of their inertia
/// - `settings`: what is known beside
///
/// Refused: tests at different loads, too little slow running, a single speed.
pub fn moment(
    tests: &[&Measurement],
    set: &RollingSet<f64>,
    settings: &MomentSettings,
) -> Result<Moment, String> {
    refuse(tests, set, settings)?;
    let mut notes = Vec::new();
    let mut whole = fitted(tests, set, settings)?;
    let (up, down): (Vec<_>, Vec<_>) = tests.iter().partition(|test| speeds_up(test));
    let mut up_against_down = None;
    if !up.is_empty() && !down.is_empty() {
        match (fitted(&up, set, settings), fitted(&down, set, settings)) {
            (Ok(up), Ok(down)) => match difference(&up.curve, &down.curve) {
                Ok(found) => {
                    if found.chance < 0.01 {
                        notes.push(format!(
                            "speeding up and slowing down differ by {} N m: their mean is no steady moment",
                            found.mean
                        ));
                    }
                    up_against_down = Some(found);
                }
                Err(why) => notes.push(format!("up and down are not compared: {why}")),
            },
            _ => notes.push("up and down are not compared: one of them alone is too short".into()),
        }
    }
    if let Some(best) = whole.forms.first() {
        for parameter in &best.parameters {
            let found = parameter.value;
            if !parameter.name.starts_with("zero") && found.value < -2.0 * found.deviation {
                notes.push(format!(
                    "{} of the most probable form is negative ({found} {}): no such law",
                    parameter.name, parameter.unit
                ));
            }
        }
        if best.noise_correlation > 0.9 {
            notes.push(format!(
                "errors of neighbouring means correlate by {:.2}: slow noise and the shape of the curve are hard to separate",
                best.noise_correlation
            ));
        }
    }
    if settings.viscosity.is_none() {
        notes.push("the viscosity is not known: Palmgren's floor is averaged over viscosities from 5 to 450 mm²/s".into());
    }
    if settings.skf.is_none() {
        notes.push("no SKF law is given: its form stands without shear heating, starvation and change of sliding friction".into());
    }
    whole.notes = notes;
    whole.up_against_down = up_against_down;
    whole.unequal = unequal::unequal(tests, set, settings);
    Ok(whole)
}

fn refuse(
    tests: &[&Measurement],
    set: &RollingSet<f64>,
    settings: &MomentSettings,
) -> Result<(), String> {
    if tests.is_empty() {
        return Err("a steady moment needs a slow test".into());
    }
    for test in tests {
        test.sound()?;
    }
    let inertia = set.outer_inertia();
    if !(inertia.is_finite()
        && inertia >= 0.0
        && set.ball_ratio > 0.0
        && set.inner_track_radius > 0.0)
    {
        return Err("masses and radii of balls and cage must be positive and finite".into());
    }
    for (what, value) in [
        ("viscosity", settings.viscosity.unwrap_or(1.0)),
        ("largest slow acceleration", settings.slow_acceleration),
        ("least speed", settings.least_speed),
    ] {
        if !(value > 0.0 && value.is_finite()) {
            return Err(format!(
                "the {what} is {value}; it must be positive and finite"
            ));
        }
    }
    if let Some(other) = tests
        .iter()
        .find(|test| !same_load(test.load, tests[0].load))
    {
        return Err(format!(
            "{} was at {} N and {} at {} N: M depends on the load, give tests at one load",
            tests[0].name, tests[0].load, other.name, other.load
        ));
    }
    Ok(())
}

/// Whether two loads count as one: they differ by less than 2 %.
///
/// - `a`, `b`: loads, N
pub fn same_load(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME_LOAD * a.max(b)
}

/// Whether the speed of a test grows more than it falls.
fn speeds_up(test: &Measurement) -> bool {
    test.speed[test.speed.len() - 1].abs() > test.speed[0].abs()
}

/// Curves on common speeds, one against the other.
fn difference(up: &SteadyMoment, down: &SteadyMoment) -> Result<Difference, String> {
    let low = up.range().0.max(down.range().0);
    let high = up.range().1.min(down.range().1);
    if low >= high {
        return Err("they have no speed in common".into());
    }
    let speed: Vec<f64> = (0..=20)
        .map(|k| low + (high - low) * f64::from(k) / 20.0)
        .map(|speed| speed.clamp(low, high))
        .collect();
    let drawn = |curve: &SteadyMoment| {
        let own: Vec<Uncertain> = speed
            .iter()
            .filter_map(|&s| curve.without_scale(s))
            .collect();
        SteadyCurve {
            speed: speed.clone(),
            torque: own.iter().map(|u| u.value).collect(),
            covariance: speed
                .iter()
                .map(|&a| {
                    speed
                        .iter()
                        .map(|&b| curve.covariance_between(a, b).unwrap_or(0.0))
                        .collect()
                })
                .collect(),
            // one sensor: the scale is the same in both and cancels but for its part of the difference
            ..SteadyCurve::default()
        }
    };
    compare(&drawn(up), &drawn(down))
}

/// One member, weighed.
struct Weighed {
    member: Member,
    posterior: Posterior,
}

fn fitted(
    tests: &[&Measurement],
    set: &RollingSet<f64>,
    settings: &MomentSettings,
) -> Result<Moment, String> {
    let blocks = Blocks::new(tests, set, settings)?;
    let level = blocks.data.level();
    let load = tests[0].load;
    let members = Member::all(settings, set, load, blocks.range, &blocks.data.x);
    let weighed: Vec<Weighed> = members
        .into_iter()
        .filter_map(|member| {
            let columns = with_zeros(&member, &blocks, tests.len());
            let precisions: Vec<DMatrix<f64>> = (member.precisions(level).into_iter())
                .map(|precision| beside_zeros(precision, tests, level))
                .collect();
            let posterior = weighed(&blocks.data, &columns, &precisions)?;
            Some(Weighed { member, posterior })
        })
        .collect();
    let scale = tests
        .iter()
        .map(|test| test.scale_deviation)
        .fold(0.0, f64::max);
    // dense where laws bend, at low speed
    let (low, high) = blocks.range;
    let speed: Vec<f64> = (0..SPEEDS)
        .map(|k| low + (high - low) * (k as f64 / (SPEEDS - 1) as f64).powf(1.5))
        .collect();
    let mut forms: Vec<FormFit> = [Form::Palmgren, Form::Skf, Form::Spline]
        .into_iter()
        .filter_map(|form| {
            let own: Vec<&Weighed> = weighed.iter().filter(|w| w.member.form == form).collect();
            form_fit(form, &own, tests, &speed, (load, scale))
        })
        .collect();
    if forms.is_empty() {
        return Err("no form of the steady moment can be fitted to these tests".into());
    }
    let odds = shares(&forms.iter().map(|f| f.log_evidence).collect::<Vec<_>>());
    for (form, probability) in forms.iter_mut().zip(odds) {
        form.probability = probability;
    }
    forms.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    let curves: Vec<(f64, &SteadyMoment)> =
        forms.iter().map(|f| (f.probability, &f.curve)).collect();
    let curve = mixed(&curves);
    let rho = forms[0].noise_correlation;
    Ok(Moment {
        curve,
        data: blocks.data.x.len(),
        effective_data: blocks.data.x.len() as f64 * (1.0 - rho) / (1.0 + rho),
        unequal: None,
        up_against_down: None,
        notes: Vec::new(),
        forms,
    })
}

/// Shapes and, behind them, one column a test for its zero.
fn with_zeros(member: &Member, blocks: &Blocks, tests: usize) -> DMatrix<f64> {
    let shapes = member.rows(&blocks.data.x);
    let size = shapes.ncols();
    let mut columns = shapes.resize_horizontally(size + tests, 0.0);
    for (k, test) in blocks.test.iter().enumerate() {
        columns[(k, size + test)] = 1.0;
    }
    columns
}

/// The prior of the coefficients with that of the zeros.
fn beside_zeros(shapes: DMatrix<f64>, tests: &[&Measurement], level: f64) -> DMatrix<f64> {
    let size = shapes.ncols();
    let mut precision = shapes.resize(size + tests.len(), size + tests.len(), 0.0);
    for (k, test) in tests.iter().enumerate() {
        // a zero that is known exactly is known to a millionth of the level
        precision[(size + k, size + k)] = test.zero_deviation.max(1e-6 * level).powi(-2);
    }
    precision
}

/// Probabilities of logarithms of evidence.
fn shares(logs: &[f64]) -> Vec<f64> {
    let total = log_sum_exp(logs);
    logs.iter().map(|log| (log - total).exp()).collect()
}

fn form_fit(
    form: Form,
    own: &[&Weighed],
    tests: &[&Measurement],
    speed: &[f64],
    (load, scale_deviation): (f64, f64),
) -> Option<FormFit> {
    let logs: Vec<f64> = own.iter().map(|w| w.posterior.log_evidence).collect();
    let odds = shares(&logs);
    let best = *own.iter().max_by(|a, b| {
        a.posterior
            .log_evidence
            .total_cmp(&b.posterior.log_evidence)
    })?;
    let curves: Vec<(f64, SteadyMoment)> = own
        .iter()
        .zip(&odds)
        .filter(|(_, odds)| **odds > 1e-4)
        .map(|(weighed, &odds)| {
            let rows = weighed.member.rows(speed);
            let posterior = &weighed.posterior;
            let (moment, covariance) =
                posterior.drawn(&rows.resize_horizontally(posterior.mean.len(), 0.0));
            let curve = SteadyMoment {
                load,
                speed: speed.to_vec(),
                moment: moment.as_slice().to_vec(),
                covariance: listed(&covariance),
                scale_deviation,
            };
            (odds, curve)
        })
        .collect();
    let curves: Vec<(f64, &SteadyMoment)> =
        curves.iter().map(|(odds, curve)| (*odds, curve)).collect();
    let (parameters, correlation) = parameters(best, tests);
    Some(FormFit {
        form,
        probability: 0.0,
        log_evidence: log_sum_exp(&logs) - (logs.len() as f64).ln(),
        parameters,
        correlation,
        viscosity: best.member.viscosity(),
        curve: mixed(&curves),
        noise: best.posterior.noise,
        noise_correlation: best.posterior.correlation,
    })
}

/// Parameters of a member and the zeros, with their correlations.
fn parameters(weighed: &Weighed, tests: &[&Measurement]) -> (Vec<Parameter>, Vec<Vec<f64>>) {
    let posterior = &weighed.posterior;
    let first_zero = posterior.mean.len() - tests.len();
    let mut list: Vec<(usize, String, &'static str, f64)> = weighed
        .member
        .meanings
        .iter()
        .enumerate()
        .map(|(k, m)| (k, m.name.to_string(), m.unit, m.factor))
        .collect();
    for (k, test) in tests.iter().enumerate() {
        list.push((first_zero + k, format!("zero of {}", test.name), "N m", 1.0));
    }
    let deviation = |k: usize| posterior.covariance[(k, k)].max(0.0).sqrt();
    let parameters = list
        .iter()
        .map(|(k, name, unit, factor)| Parameter {
            name: name.clone(),
            unit,
            value: Uncertain::new(factor * posterior.mean[*k], factor * deviation(*k)),
        })
        .collect();
    let correlation = list
        .iter()
        .map(|(i, ..)| {
            list.iter()
                .map(|(j, ..)| {
                    let size = deviation(*i) * deviation(*j);
                    if size > 0.0 {
                        posterior.covariance[(*i, *j)] / size
                    } else {
                        0.0
                    }
                })
                .collect()
        })
        .collect();
    (parameters, correlation)
}

/// A matrix by rows.
fn listed(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
    (matrix.row_iter())
        .map(|row| row.iter().copied().collect())
        .collect()
}

/// Mean of curves by weight, their disagreement in the covariance.
fn mixed(curves: &[(f64, &SteadyMoment)]) -> SteadyMoment {
    let total: f64 = curves.iter().map(|(weight, _)| weight).sum();
    let first = curves[0].1;
    let count = first.speed.len();
    let mut moment = vec![0.0; count];
    for (weight, curve) in curves {
        for (sum, value) in moment.iter_mut().zip(&curve.moment) {
            *sum += weight / total * value;
        }
    }
    let mut covariance = vec![vec![0.0; count]; count];
    for (weight, curve) in curves {
        let apart: Vec<f64> = curve
            .moment
            .iter()
            .zip(&moment)
            .map(|(m, mean)| m - mean)
            .collect();
        for i in 0..count {
            for j in 0..count {
                covariance[i][j] += weight / total * (curve.covariance[i][j] + apart[i] * apart[j]);
            }
        }
    }
    SteadyMoment {
        load: first.load,
        speed: first.speed.clone(),
        moment,
        covariance,
        scale_deviation: first.scale_deviation,
    }
}
