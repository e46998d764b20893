//! Which explanation of a torque transient the data support, and which test would decide.
//!
//! After a quick spin-up t_O is low, reaches the steady curve M(Ω) after some tenths of a second and then falls below
//! it within seconds. Seven explanations are compared, over all tests of a bearing jointly:
//!
//! | explanation | what it predicts |
//! |---|---|
//! | rolling | t_O = M(Ω) - J_O Ω̇ |
//! | grease | the same with M0 times D = \[g0+(1-g0)b\]\[1-(1-g_w)w\], ḃ = \|ω_c\|(1-b)/φ_b, ẇ = (1-w)/τ_w while turning |
//! | isothermal slip | balls and cage follow a limited traction; the cage stays behind, the missing inertia shows |
//! | slip with heating | the same, traction and drag falling with the film's temperature |
//! | sensor artefact | rolling, read with a drifting zero (it stays at rest), with creep, or too slowly |
//! | rolling in oil that warms | rolling with M0 e^(-λθ), θ̇ = (M Ω/(M_0 Ω_0) - θ)/τ: the viscosity at the oil's temperature |
//! | another steady moment | rolling, with k M(Ω) and another part without speed dependence: the slow tests had another bearing, load, temperature or scale |
//!
//! ```text
//!   Z(E) = ∫ p(y | z)^w p(z | E) dz      p(E | y) ∝ odds(E) Z(E)
//! ```
//! y are means of torque (and cage speed). What enters linearly and is shared — zero, scale, level
//! and band of M, inertia — is integrated in closed form; the models' own error has an amplitude of a short list. The parameters z are
//! those of the largest posterior, their integral is that of Laplace, and the power w is the effective number of data over their
//! number: see `evidence`, `noise` and `mode`. An explanation wins with a probability of
//! [`Settings::decision`] and an acceptable fit; otherwise the verdict is "undecided" or "none of these".
//!
//! An explanation is a claim: what it says must show on the torque by `LEAST_EFFECT`. Grease claims that both
//! its states show, slip a cage that stays behind, heating a traction that still falls 0.3 s after the run-up, a slow
//! sensor more than what any inversion smooths.
//!
//! Assumed: all tests at one load, with the bearing rested before each but where [`Measurement::rest_before`] says otherwise: such a
//! test begins with what is left of a whole test like it. Ranges of parameters before the data stand in `parameter`: an explanation
//! that needs a coincidence (traction and drag that agree to 0.4 % for seconds) is as improbable as the coincidence is.
//!
//! # How often it is right
//! Of 8 campaigns per truth (three tests of the paper each, bearing and sensor finer than the models, effects of 15 to
//! 40 % of M) none names a wrong explanation: see `tests/explain/mod.rs`.
//!
//! What stays open is creep against grease (they differ by the load part of M) and, without a signal of the cage, rolling or
//! oil that warms against a slip that a traction limit just below M leaves small.
//!
//! One verdict on three tests of 8 s takes about 1 s of CPU.
//!
//! Does not model: several explanations at once (skid in the run-up and a grease state), a grease that had not rested,
//! a moment at rest, faults of the speed signal. A breakdown of grease without a build-up is no explanation of its own:
//! it differs from creep by the load part of M alone, and creep is what it would be called.

mod explanation;
mod hypothesis;
mod means;
mod mode;
mod next_test;
mod noise;
mod parameter;
mod prediction_errors;
mod prior;
mod record;
mod settings;
mod slip;
mod steady;
mod verdict;

use physics::rolling::RollingSet;
use settings::DISCREPANCY;

use crate::algebra::{dot, log_sum_exp};
use crate::{Measurement, SteadyMoment};

use crate::evidence::{limited, shares};
use hypothesis::{Bearing, Hypothesis, Prediction};
use mode::{Mode, Search};
use noise::Observed;
use record::{Trial, engagement};
use statistics::normal::squares_above;
use statistics::random::Random;
use verdict::FormDraw;

pub use explanation::Explanation;
pub use next_test::{Candidate, Proposal, next_test};
pub use prediction_errors::{PredictionErrors, with_prediction_errors};
pub use settings::{LEAST_FIT, LEAST_SLIP, Settings};
pub use verdict::{Assessment, Conclusion, Estimate, Fit, TorqueMean, Verdict};

/// Which explanation the tests of one bearing support.
///
/// - `tests`: all at one load; the record may include rest before, run-down and rest after; speed and acceleration are taken as
///   they are, [`with_prediction_errors`] makes what is not known of them an error of the torque
/// - `steady`: M(Ω) at this load; between its speeds as it is, held above them, fading to 0 at rest below
/// - `set`: masses and radii of balls and cage
///
/// # Errors
/// Where tests, curve or settings cannot be used: why.
pub fn explain(
    tests: &[Measurement],
    steady: &SteadyMoment,
    set: &RollingSet<f64>,
    settings: &Settings,
) -> Result<Verdict, String> {
    let bearing = bearing(tests, steady, set, settings)?;
    let records: Vec<Trial> = (tests.iter())
        .map(|test| Trial::measured(test, &bearing.table, set.outer_inertia()))
        .collect();
    // what is left by the most probable explanation says how many data the means are worth; which one it is depends on that little
    let (mut power, mut effective) = (1.0, 0.0);
    let mut pass = || -> Option<(Observed, Vec<Assessment>)> {
        let observed = Observed::new(&records, &bearing, &DISCREPANCY, power)?;
        let assess = |explanation| assess(explanation, &records, &bearing, &observed);
        let assessments: Vec<_> = Explanation::ALL.into_iter().map(assess).collect();
        let best = (assessments.iter().flat_map(|(_, best)| best))
            .max_by(|a, b| a.1.log_evidence.total_cmp(&b.1.log_evidence));
        if let Some((form, mode)) = best {
            let search = Search::new(*form, &records, &bearing, &observed);
            let amplitude = search.best_amplitude(&mode.at);
            effective = observed.effective_number(&search.predict(&mode.at), amplitude);
            power = effective / observed.count() as f64;
        }
        let assessments = assessments.into_iter().map(|(assessment, _)| assessment);
        Some((observed, assessments.collect()))
    };
    pass().ok_or(BAD_CURVE)?;
    let (observed, mut assessments) = pass().ok_or(BAD_CURVE)?;
    let logs: Vec<f64> = assessments.iter().map(|a| a.log_evidence).collect();
    let weights: Vec<f64> = (assessments.iter().zip(limited(&logs, effective)))
        .map(|(a, log)| a.prior_probability.ln() + log)
        .collect();
    // nothing fits at all: the odds stay as they were
    if weights.iter().any(|weight| weight.is_finite()) {
        for (assessment, share) in assessments.iter_mut().zip(shares(&weights)) {
            assessment.probability = share;
        }
    }
    let mut verdict = Verdict {
        conclusion: Conclusion::NoneOfThese,
        assessments,
        means: observed.counts(),
        effective_means: effective,
        torque_means: torque_means(tests, &records, &observed, &bearing),
    };
    verdict.conclusion = conclude(&verdict, settings);
    Ok(verdict)
}

/// The means of torque that are compared, on the clocks of their tests.
fn torque_means(
    tests: &[Measurement],
    records: &[Trial],
    observed: &Observed,
    bearing: &Bearing,
) -> Vec<TorqueMean> {
    let all: Vec<TorqueMean> = (tests.iter().zip(records).enumerate())
        .flat_map(|(test, (measurement, record))| {
            let begin = engagement(measurement, bearing.table.top_speed);
            record.bins.iter().map(move |bin| TorqueMean {
                test,
                from: begin + bin.from,
                to: begin + bin.to,
                torque: bin.torque,
            })
        })
        .collect();
    let places = observed.torque_places();
    places.iter().map(|place| all[*place]).collect()
}

fn conclude(verdict: &Verdict, settings: &Settings) -> Conclusion {
    let fits = |a: &Assessment| a.fit.is_some_and(|fit| fit.probability >= LEAST_FIT);
    let best = verdict.best();
    if best.probability >= settings.decision {
        return if fits(best) {
            Conclusion::Supported(best.explanation)
        } else {
            Conclusion::NoneOfThese
        };
    }
    let mut left: Vec<&Assessment> = (verdict.assessments.iter())
        .filter(|a| a.probability > 0.4 * (1.0 - settings.decision))
        .collect();
    if !left.iter().any(|a| fits(a)) {
        return Conclusion::NoneOfThese;
    }
    left.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    Conclusion::Undecided(left.iter().map(|a| a.explanation).collect())
}

/// The bearing as the comparison and the ranking of tests see it, where tests, curve and settings can be used.
fn bearing<'a>(
    tests: &[Measurement],
    steady: &'a SteadyMoment,
    set: &'a RollingSet<f64>,
    settings: &'a Settings,
) -> Result<Bearing<'a>, String> {
    refuse(tests, steady, settings)?;
    let top_speed = (tests.iter().flat_map(|test| &test.speed)).fold(0.0_f64, |a, b| a.max(*b));
    if top_speed <= 0.0 {
        return Err(bad_test(&tests[0]));
    }
    let repeated = tests.iter().any(|test| test.rest_before.is_some());
    Ok(Bearing::new(steady, top_speed, set, settings, repeated))
}

/// Why a curve of the steady moment cannot be used.
const BAD_CURVE: &str = "the steady moment needs rising positive speeds, positive moments and a covariance of as many rows";

fn refuse(tests: &[Measurement], steady: &SteadyMoment, settings: &Settings) -> Result<(), String> {
    let first = tests.first().ok_or("no test was given")?;
    for test in tests {
        if !usable(test) {
            return Err(bad_test(test));
        }
        if (test.load - first.load).abs() > 0.02 * first.load.abs() {
            return Err(format!(
                "test \"{}\" ran at another load than the first: tests of one load are compared with one M(Ω)",
                test.name
            ));
        }
    }
    let size = steady.speed.len();
    let rising = |values: &[f64]| values.windows(2).all(|pair| pair[1] > pair[0]);
    let curve = size > 0
        && steady.moment.len() == size
        && steady.covariance.len() == size
        && rising(&steady.speed)
        && steady.speed[0] > 0.0
        && steady.moment.iter().all(|m| m.is_finite() && *m > 0.0)
        && (steady.covariance.iter())
            .all(|row| row.len() == size && row.iter().all(|c| c.is_finite()));
    if !curve {
        return Err(BAD_CURVE.to_string());
    }
    match settings.fault() {
        Some(name) => Err(format!("setting \"{name}\" is out of its range")),
        None => Ok(()),
    }
}

fn bad_test(test: &Measurement) -> String {
    format!(
        "test \"{}\": at least ten values, rising times, equal lengths, numbers and positive deviations are needed",
        test.name
    )
}

fn usable(test: &Measurement) -> bool {
    let count = test.time.len();
    let numbers = |values: &[f64]| values.len() == count && values.iter().all(|v| v.is_finite());
    let rising = |values: &[f64]| values.windows(2).all(|pair| pair[1] > pair[0]);
    count >= 10
        && numbers(&test.time)
        && rising(&test.time)
        && numbers(&test.speed)
        && numbers(&test.torque)
        && numbers(&test.torque_deviation)
        && test.torque_deviation.iter().all(|d| *d > 0.0)
        && numbers(&test.correlation_time)
        && test.correlation_time.iter().all(|t| *t >= 0.0)
        && [test.zero_deviation, test.scale_deviation]
            .iter()
            .all(|v| v.is_finite() && *v >= 0.0)
        && test.load.is_finite()
        && test.cage.as_ref().is_none_or(|cage| {
            cage.speed.len() == cage.time.len()
                && cage.deviation.len() == cage.time.len()
                && rising(&cage.time)
                && (cage.time.iter().chain(&cage.speed)).all(|v| v.is_finite())
                && cage.deviation.iter().all(|d| d.is_finite() && *d > 0.0)
        })
}

/// Amplitudes of the models' own error that the fit allows beside those of the odds: what is caution in the odds, that no model is
/// better than half a per cent, would make any fit look good.
const FINE: f64 = 0.003;
/// Largest amplitude that it allows: a model that leaves more does not fit, however even its errors.
const COARSE: f64 = 0.02;

/// Draws of the posterior by which parameters and the ranking of tests go.
const DRAWS: usize = 200;

/// One explanation, and the most probable of its forms.
fn assess(
    explanation: Explanation,
    tests: &[Trial],
    bearing: &Bearing,
    observed: &Observed,
) -> (Assessment, Option<(Hypothesis, Mode)>) {
    let prior_probability = bearing.settings.probability(explanation);
    let mut assessment = Assessment {
        explanation,
        prior_probability,
        probability: prior_probability,
        log_evidence: f64::NEG_INFINITY,
        fit: None,
        form: explanation.name(),
        parameters: Vec::new(),
        predicted_torque: Vec::new(),
        draws: Vec::new(),
    };
    let forms = Hypothesis::of(explanation).iter();
    let modes: Vec<(Hypothesis, Mode)> = forms
        .filter(|_| prior_probability > 0.0)
        .filter_map(|form| {
            let mut mode = Search::new(*form, tests, bearing, observed).mode()?;
            mode.log_evidence += form.weight().ln();
            Some((*form, mode))
        })
        .collect();
    let logs: Vec<f64> = modes.iter().map(|(_, mode)| mode.log_evidence).collect();
    assessment.log_evidence = log_sum_exp(&logs);
    let mut random = Random::new(bearing.settings.seed);
    for ((form, mode), share) in modes.iter().zip(shares(&logs)) {
        let count = (share * DRAWS as f64).round() as usize;
        assessment.draws.extend((0..count).map(|_| FormDraw {
            form: *form,
            coordinates: mode.draw(&mut random),
        }));
    }
    let best = (modes.into_iter()).max_by(|a, b| a.1.log_evidence.total_cmp(&b.1.log_evidence));
    if let Some((form, mode)) = &best {
        assessment.form = form.name();
        assessment.parameters = estimates(*form, mode, bearing);
        let prediction = form.predict(&mode.at, tests, bearing);
        assessment.fit = fit(&prediction, &mode.at, tests, bearing);
        let places = observed.torque_places().iter();
        assessment.predicted_torque = places.map(|place| prediction.torque[*place]).collect();
    }
    (assessment, best)
}

fn estimates(form: Hypothesis, mode: &Mode, bearing: &Bearing) -> Vec<Estimate> {
    let mut random = Random::new(bearing.settings.seed);
    let draws: Vec<Vec<f64>> = (0..DRAWS).map(|_| mode.draw(&mut random)).collect();
    (form.parameters(bearing).iter().enumerate())
        .map(|(axis, parameter)| {
            let values = || draws.iter().map(|draw| parameter.value(draw[axis]));
            let mean = values().sum::<f64>() / DRAWS as f64;
            let variance = values().map(|value| (value - mean).powi(2)).sum::<f64>() / DRAWS as f64;
            Estimate {
                name: parameter.name,
                unit: parameter.unit,
                mean: if axis == 0 { form.sign() * mean } else { mean },
                deviation: variance.sqrt(),
            }
        })
        .collect()
}

/// How far the data lie from a mode.
///
/// Formula: χ² = (y - f(z))ᵀ C⁻¹ (y - f(z)) + zᵀz; of all data that the explanation predicts with its priors it has as many degrees of
/// freedom as there are means, where f is straight over the width of the posterior; mean over the amplitudes of the models' own
/// error
fn fit(prediction: &Prediction, at: &[f64], tests: &[Trial], bearing: &Bearing) -> Option<Fit> {
    let allowed = (DISCREPANCY.iter()).filter(|amplitude| **amplitude <= COARSE);
    let amplitudes: Vec<f64> = std::iter::once(&FINE).chain(allowed).copied().collect();
    let observed = Observed::new(tests, bearing, &amplitudes, 1.0)?;
    let mut fit = Fit {
        chi_squared: 0.0,
        count: observed.count(),
        probability: 0.0,
        discrepancy: 0.0,
    };
    let levels = observed.log_likelihood(prediction);
    let logs: Vec<f64> = levels.iter().map(|(log, _)| *log).collect();
    for ((share, (_, residual)), amplitude) in shares(&logs).iter().zip(levels).zip(amplitudes) {
        let all = residual + dot(at, at);
        fit.chi_squared += share * all;
        fit.probability += share * squares_above(all, fit.count as f64);
        fit.discrepancy += share * amplitude;
    }
    // shares sum to 1 but for rounding
    fit.probability = fit.probability.min(1.0);
    Some(fit)
}
