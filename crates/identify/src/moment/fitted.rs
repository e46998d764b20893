//! The forms of the steady moment fitted to slow tests, and two of their curves compared.

use super::blocks::Blocks;
use super::curve::SteadyMoment;
use super::forms::Member;
use super::found::{FormFit, Moment, Parameter};
use super::settings::Form;
use crate::algebra::log_sum_exp;
use crate::evidence::{effective_number, limited, linear, shares};
use crate::measurement::Measurement;
use crate::regression::{Data, Posterior, weighed};
use crate::steady_curve::{Difference, SteadyCurve, compare};
use nalgebra::DMatrix;
use physics::rolling::RollingSet;
use statistics::uncertain::Uncertain;

/// Number of speeds of a curve.
const SPEEDS: usize = 81;

/// Whether the speed of a test grows more than it falls.
pub(super) fn speeds_up(test: &Measurement) -> bool {
    test.speed[test.speed.len() - 1].abs() > test.speed[0].abs()
}

/// Curves on common speeds, one against the other.
pub(super) fn difference(up: &SteadyMoment, down: &SteadyMoment) -> Result<Difference, String> {
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
    columns: DMatrix<f64>,
    precisions: Vec<DMatrix<f64>>,
    posterior: Posterior,
    /// ln of its evidence.
    log_evidence: f64,
}

impl Weighed {
    fn residual(&self, y: &[f64]) -> Vec<f64> {
        let fitted = &self.columns * &self.posterior.mean;
        y.iter().zip(&fitted).map(|(y, m)| y - m).collect()
    }
}

/// The evidence of all members by the effective number of data, which is that of the most probable one: in two passes from the one
/// that leaves least.
fn weigh(weighed: &mut [Weighed], data: &Data) -> f64 {
    let noises = data.noises();
    let number = |weighed: &Weighed| {
        let residual = weighed.residual(&data.y);
        effective_number(data.stretches.iter().map(|range| &residual[range.clone()]))
    };
    let left = |weighed: &Weighed| -weighed.residual(&data.y).iter().map(|r| r * r).sum::<f64>();
    let largest = |weighed: &[Weighed], of: &dyn Fn(&Weighed) -> f64| {
        let best = weighed.iter().max_by(|a, b| of(a).total_cmp(&of(b)));
        best.map_or(1.0, number)
    };
    let mut effective = largest(weighed, &left);
    for _ in 0..2 {
        let weight = effective / data.y.len() as f64;
        for one in weighed.iter_mut() {
            one.log_evidence = linear(&data.y, &one.columns, &one.precisions, &noises, weight);
        }
        effective = largest(weighed, &|one| one.log_evidence);
    }
    effective
}

/// The steady moment of these tests, without notes and comparisons.
pub(super) fn fitted(
    tests: &[&Measurement],
    set: &RollingSet<f64>,
    viscosity: Option<f64>,
) -> Result<Moment, String> {
    let blocks = Blocks::new(tests, set)?;
    let level = blocks.data.level();
    let load = tests[0].load;
    let members = Member::all(viscosity, set, blocks.range, &blocks.data.x);
    let mut weighed: Vec<Weighed> = members
        .into_iter()
        .filter_map(|member| {
            let columns = with_zeros(&member, &blocks, tests.len());
            let precisions: Vec<DMatrix<f64>> = (member.precisions(level).into_iter())
                .map(|precision| beside_zeros(precision, tests, level))
                .collect();
            let posterior = weighed(&blocks.data, &columns, &precisions)?;
            Some(Weighed {
                member,
                columns,
                precisions,
                posterior,
                log_evidence: f64::NEG_INFINITY,
            })
        })
        .collect();
    let effective = weigh(&mut weighed, &blocks.data);
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
    let logs: Vec<f64> = forms.iter().map(|form| form.log_evidence).collect();
    let odds = shares(&limited(&logs, effective));
    for (form, probability) in forms.iter_mut().zip(odds) {
        form.probability = probability;
    }
    forms.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    let curves: Vec<(f64, &SteadyMoment)> =
        forms.iter().map(|f| (f.probability, &f.curve)).collect();
    let curve = mixed(&curves);
    Ok(Moment {
        curve,
        data: blocks.data.x.len(),
        effective_data: effective,
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

fn form_fit(
    form: Form,
    own: &[&Weighed],
    tests: &[&Measurement],
    speed: &[f64],
    (load, scale_deviation): (f64, f64),
) -> Option<FormFit> {
    let logs: Vec<f64> = own.iter().map(|w| w.log_evidence).collect();
    let odds = shares(&logs);
    let best = *(own.iter()).max_by(|a, b| a.log_evidence.total_cmp(&b.log_evidence))?;
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
        curve: mixed(&curves),
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
