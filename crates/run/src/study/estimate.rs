//! Inputs whose predicted curves are most like the measured ones, and how well these determine them.
//!
//! ```text
//!   members of the design ──best four──▶ simplex on Σ r²/n, of growing parts of the curves ──▶ û          r = (measured - predicted)/deviation
//!   r(û ± h) ──▶ J ──▶ cov = (Σ JᵀJ/(s² τ) + 12 I)⁻¹                 one term a channel, and the bounds
//! ```
//! s² is the mean of r² at û, 1 at least; τ = 1 + 2 Σ ρ(k) counts how many samples of a channel say the same, ρ the autocorrelation of r.
//! Inputs are counted in shares of their bounds, which alone have the variance of a uniform distribution, 1/12. All is a function of the file alone, whatever the number of threads.
//!
//! Source: weighted least squares with a prior of the bounds' variance; the inverse of the information matrix bounds the covariance (Cramér and Rao).
//! Valid: near û the curves follow the inputs on straight lines; errors of the model that no input can cure are in s² and τ alone.

use super::Study;
use super::kept::Nowhere;
use super::table::Table;
use crate::Options;
use crate::measured::{self, Curve, Fitted, Residuals};
use outcome::{Outcome, host};
use scenario::Vary;
use statistics::design::Coordinate;
use statistics::noise::Noise;
use statistics::{linear, simplex};
use std::array::from_fn;
use std::sync::atomic::AtomicUsize;
use std::sync::atomic::Ordering::Relaxed;

/// The result of a member that is made small.
pub const MISFIT: &str = "measured.misfit";
/// Evaluations of the simplex: so many, and so many an input.
const CALLS: [usize; 2] = [20, 40];
/// The simplex ends where Σ r² differs by less between its corners.
const TOLERANCE: f64 = 0.02;
/// Steps of the first and of the second slope at least and at most, as shares of the bounds.
const STEPS: [f64; 3] = [1e-3, 1e-5, 2e-2];
/// Information of bounds alone, in shares of them: that of a uniform distribution.
const BOUNDS: f64 = 12.0;
/// An input is determined where its deviation is at most this share of the bounds: half of that of the bounds themselves, 1/√12.
const DETERMINED: f64 = 0.144;
/// Two inputs whose coefficient is larger are determined together alone.
const TOGETHER: f64 = 0.95;
/// Standard deviations of the mean square of noise beyond which it does not explain that of the residuals.
const UNEXPLAINED: f64 = 3.0;
/// Neighbouring residuals repeat each other so much more than noise does where the model has something wrong.
const STRUCTURED: f64 = 1.5;
/// Parts of the curves that the search begins with.
const PARTS: [f64; 3] = [0.25, 0.5, 0.75];
/// Members that the search starts from, at most, and rounds of it over the whole curves.
const STARTS: usize = 4;
const ROUNDS: usize = 3;
/// A member as good as the best one, by its misfit, and so many deviations away, is another estimate.
const RIVAL: (f64, f64) = (1.05, 5.0);
/// Blocks of residuals, at most: the autocorrelation of more takes long.
const BLOCKS: usize = 8192;
/// Nearest to a bound, as a share of both.
const EDGE: f64 = 1e-3;
const NO_MISFIT: &str = "no member has measured.misfit: a run of the scenario says why";

/// What measured curves say of inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Each input.
    pub inputs: Vec<Estimated>,
    /// Coefficients between them.
    pub correlation: Vec<Vec<f64>>,
    /// Root mean square of the residuals over their deviations at the estimate.
    pub misfit: f64,
    /// Whether noise explains the residuals.
    pub explained: bool,
    /// Samples that were compared, of all channels, and how many of them are independent.
    pub rows: [f64; 2],
    /// Runs besides the members.
    pub runs: usize,
    /// The first member that fits as well elsewhere.
    pub rival: Option<usize>,
    /// The channels beside the run of the estimate.
    pub curves: Vec<Fitted>,
}

/// An input with its estimate.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimated {
    /// Its path.
    pub path: String,
    /// SI unit.
    pub unit: String,
    /// Best value, SI.
    pub value: f64,
    /// Standard uncertainty, SI; none where the curves do not depend on it.
    pub uncertainty: Option<f64>,
    /// Its bounds, SI.
    pub bounds: [f64; 2],
    /// Paths with the best value, as an override has them.
    pub set: Vec<(String, String)>,
    /// What is wrong with it, in words; empty where it is determined.
    pub why: String,
}

impl Study {
    /// Estimates the inputs from the best member on. None where this was interrupted.
    ///
    /// # Errors
    /// Why nothing can be estimated.
    pub fn estimate(&self, table: &Table, options: &Options) -> Option<Result<Estimate, String>> {
        match self.file.inputs.len() {
            1 => self.estimated::<1>(table, options),
            2 => self.estimated::<2>(table, options),
            3 => self.estimated::<3>(table, options),
            4 => self.estimated::<4>(table, options),
            _ => self.estimated::<5>(table, options),
        }
    }

    fn estimated<const N: usize>(
        &self,
        table: &Table,
        options: &Options,
    ) -> Option<Result<Estimate, String>> {
        let misfits = table.values(MISFIT);
        let known = misfits.iter().zip(&table.members);
        let known = known.filter_map(|(misfit, member)| Some(((*misfit)?, *member)));
        let best = known.clone().min_by(|a, b| a.0.total_cmp(&b.0));
        let machine = crate::build(&self.file.scenario).map_err(|problem| problem.to_string());
        let (best, curves) = match (best, machine) {
            (Some((_, best)), Ok(machine)) => (best, machine.measured),
            (_, Err(why)) => return Some(Err(why)),
            (None, _) => return Some(Err(NO_MISFIT.to_string())),
        };
        let fit = Fit::<N> {
            study: self,
            curves: &curves,
            options,
        };
        let at_best = fit.outcome(&self.shares(best));
        let channels = at_best.map_or(Vec::new(), |own| measured::fitted(&curves, &own));
        let still = |own: &Fitted| own.measured.windows(2).all(|two| two[0] == two[1]);
        let unknown = channels
            .iter()
            .filter(|own| own.deviation.is_none() || still(own));
        let unknown: Vec<&str> = unknown.map(|own| own.name.as_str()).collect();
        if !unknown.is_empty() {
            return Some(Err(format!(
                "the noise of {} is not known (a channel that does not change, or too few values): measured.deviation is needed there, or no such table",
                unknown.join(", ")
            )));
        }
        let step = 0.5 / (table.members.len() as f64).powf(1.0 / N as f64);
        let rows: usize = (fit.at(&self.shares(best)).iter().flatten())
            .map(|own| own.values.len())
            .sum();
        let runs = AtomicUsize::new(2 + 4 * N);
        let tolerance = |part: f64| TOLERANCE / (part * rows as f64);
        let search = |start: [f64; N], step: f64, part: f64| {
            let calls = CALLS[0] + CALLS[1] * N;
            let step = start.map(|u| if u > 0.5 { -step } else { step });
            simplex::lowest(start, step, tolerance(part), calls, |u| {
                runs.fetch_add(1, Relaxed);
                fit.mean_square(u, part)
            })
        };
        // late impacts, which the inputs shift, make many valleys: the first part of the curves has few
        let mut sorted: Vec<_> = known.clone().collect();
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut starts: Vec<[f64; N]> = Vec::new();
        for (_, member) in sorted {
            let own = self.shares(member);
            let near = |other: &[f64; N]| (0..N).all(|k| (own[k] - other[k]).abs() < step);
            if starts.len() < STARTS && !starts.iter().any(near) {
                starts.push(own);
            }
        }
        let valleys = host::in_pool(options.threads, || {
            host::each(&starts, |_, start| search(*start, step, PARTS[0]))
        });
        let lowest = valleys.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
        let mut found = lowest.map_or(self.shares(best), |(place, _)| place);
        let mut value = f64::INFINITY;
        let rounds = PARTS[1..].iter().chain([1.0; ROUNDS].iter());
        for part in rounds {
            let (place, lowest) = search(found.map(|u| u.clamp(0.0, 1.0)), 0.3 * step, *part);
            if *part < 1.0 {
                found = place;
                continue;
            }
            let better = value - lowest;
            if better > 0.0 {
                (found, value) = (place, lowest);
            }
            if better < tolerance(1.0) {
                break;
            }
        }
        let place = found.map(|u| u.clamp(0.0, 1.0));
        let at = fit.at(&place).unwrap_or_default();
        let mut information = fit.information(&place, [STEPS[0]; N], &at);
        let steps = from_fn(|k| information[k][k].powf(-0.5).clamp(STEPS[1], STEPS[2]));
        information = fit.information(&place, steps, &at);
        if fit.interrupted() {
            return None;
        }
        if at.is_empty() || !value.is_finite() {
            return Some(Err("no run of the search ended as planned".to_string()));
        }
        let (deviations, correlation) = uncertainties(&information);
        let misfit = value.sqrt();
        let explained = is_noise(value, &at);
        let far = |shares: [f64; N]| {
            (0..N).any(|k| (shares[k] - place[k]).abs() > RIVAL.1 * deviations[k].unwrap_or(1.0))
        };
        let mut rivals = known.filter(|(own, k)| *own <= RIVAL.0 * misfit && far(self.shares(*k)));
        let inputs = (0..N).map(|k| {
            let mut own = self.input(k, place[k], deviations[k], &correlation[k]);
            if !explained {
                let model = "only if the rest of the model holds and the search has found the lowest misfit: noise does not explain it";
                own.why = [own.why.as_str(), model].map(str::to_string).into_iter().filter(|own| !own.is_empty()).collect::<Vec<_>>().join("; ");
            }
            own
        });
        let independent = (at.iter()).map(|own| own.values.len() as f64 / repetition(&own.values));
        Some(Ok(Estimate {
            rival: rivals.next().map(|(_, member)| member),
            rows: [rows as f64, independent.sum()],
            inputs: inputs.collect(),
            correlation: correlation.map(|row| row.to_vec()).to_vec(),
            misfit,
            explained,
            runs: runs.into_inner(),
            curves: (fit.outcome(&place)).map_or(Vec::new(), |own| measured::fitted(&curves, &own)),
        }))
    }

    /// An input at a share of its bounds, with its deviation as such a share and its coefficients with all.
    fn input(&self, k: usize, at: f64, deviation: Option<f64>, coefficients: &[f64]) -> Estimated {
        let vary = &self.file.inputs[k].vary;
        let number = |u: f64| at_share(vary, u).1;
        let bounds = [number(0.0), number(1.0)];
        let beside = |i: usize| i != k && coefficients[i].abs() > TOGETHER;
        let together = (0..coefficients.len()).find(|i| beside(*i));
        let edge = deviation.unwrap_or(0.0).clamp(EDGE, 0.5);
        let why = match (deviation, together) {
            (None, _) => "not determined: the curves do not depend on it".to_string(),
            (Some(own), _) if own > DETERMINED => {
                "not determined: hardly better than its bounds".to_string()
            }
            (_, Some(i)) => format!(
                "determined only together with {}",
                self.file.inputs[i].vary.path
            ),
            _ if at < edge || at > 1.0 - edge => {
                "at a bound: a wider one may fit better".to_string()
            }
            _ => String::new(),
        };
        Estimated {
            path: vary.path.clone(),
            unit: vary.unit(),
            value: number(at),
            uncertainty: deviation.map(|own| own * (bounds[1] - bounds[0]).abs()),
            bounds,
            set: at_share(vary, at).0,
            why,
        }
    }

    /// Shares of the bounds that a member drew.
    fn shares<const N: usize>(&self, member: usize) -> [f64; N] {
        let drawn = self.file.design.member(self.file.seed, member);
        from_fn(|k| match drawn.get(k) {
            Some(Coordinate::Share(u)) => *u,
            _ => 0.5,
        })
    }
}

/// Value of an input at a share of its bounds: as overrides have it, and as a number.
fn at_share(vary: &Vary, u: f64) -> (Vec<(String, String)>, f64) {
    let (values, number) = vary.at(Coordinate::Share(u));
    (values, number.unwrap_or(f64::NAN))
}

struct Fit<'a, const N: usize> {
    study: &'a Study,
    curves: &'a [Curve],
    options: &'a Options<'a>,
}

impl<const N: usize> Fit<'_, N> {
    fn interrupted(&self) -> bool {
        self.options.interrupt.load(Relaxed)
    }

    /// Residuals of each channel at shares of the bounds; none of a run that does not end as planned.
    fn at(&self, shares: &[f64; N]) -> Option<Vec<Residuals>> {
        let all = measured::residuals(self.curves, &self.outcome(shares)?);
        let any = all.iter().any(|own| !own.values.is_empty());
        any.then_some(all)
    }

    /// The run at shares of the bounds, if it ends as planned.
    fn outcome(&self, shares: &[f64; N]) -> Option<Outcome> {
        if self.interrupted() {
            return None;
        }
        let file = &self.study.file;
        let inputs = file.inputs.iter().zip(shares);
        let values: Vec<_> = inputs
            .flat_map(|(input, u)| at_share(&input.vary, *u).0)
            .collect();
        let quiet = Options {
            threads: Some(1),
            interrupt: self.options.interrupt,
            progress: &|_| {},
            controllers: self.options.controllers,
            rows: None,
        };
        let scenario = file.scenario.with(&values).ok()?;
        let outcome = crate::built(&scenario).ok()?.computed(&quiet, &Nowhere);
        outcome.stop.complete().then_some(outcome)
    }

    /// Mean of the squares of the residuals of the first part of each curve; beyond the bounds it grows.
    fn mean_square(&self, shares: &[f64; N], part: f64) -> f64 {
        let inside = shares.map(|u| u.clamp(0.0, 1.0));
        let both = shares.iter().zip(&inside);
        let beyond: f64 = both.map(|(u, inside)| (u - inside).abs()).sum();
        let square = |all: Vec<Residuals>| {
            let first = |own: &Residuals| (part * own.values.len() as f64).ceil() as usize;
            let all: Vec<f64> = (all.iter())
                .flat_map(|own| own.values[..first(own)].iter().copied())
                .collect();
            (1.0 + beyond) * mean_of_squares(&all) + beyond
        };
        self.at(&inside).map_or(f64::INFINITY, square)
    }

    /// Σ JᵀJ/(s² τ) over the channels.
    fn information(&self, place: &[f64; N], steps: [f64; N], at: &[Residuals]) -> [[f64; N]; N] {
        let point = |k: usize, sense: f64| {
            let mut own = *place;
            own[k] = (own[k] + sense * steps[k]).clamp(0.0, 1.0);
            own
        };
        let points: Vec<[f64; N]> = (0..N)
            .flat_map(|k| [point(k, 1.0), point(k, -1.0)])
            .collect();
        let found = host::in_pool(self.options.threads, || {
            host::each(&points, |_, point| self.at(point).unwrap_or_default())
        });
        let mut information = [[0.0; N]; N];
        for (channel, own) in at.iter().enumerate() {
            let slopes: [Vec<f64>; N] = from_fn(|k| {
                let width = points[2 * k][k] - points[2 * k + 1][k];
                let of =
                    |point: usize| found[point].get(channel).map_or(&[][..], |own| &own.values);
                let both = of(2 * k).iter().zip(of(2 * k + 1));
                both.map(|(above, below)| (above - below) / width).collect()
            });
            let weight = 1.0 / (mean_of_squares(&own.values).max(1.0) * repetition(&own.values));
            for (i, k) in (0..N).flat_map(|i| (0..N).map(move |k| (i, k))) {
                let product = slopes[i].iter().zip(&slopes[k]).map(|(a, b)| a * b);
                information[i][k] += weight * product.sum::<f64>();
            }
        }
        information
    }
}

/// Whether noise explains residuals of this mean square: no larger than its scatter allows, and repeating each other no more than noise does.
fn is_noise(mean_square: f64, all: &[Residuals]) -> bool {
    let rows: f64 = all.iter().map(|own| own.values.len() as f64).sum();
    // of a normal value the variance of the square is 2; the deviation itself is known by some values alone
    let variance = all.iter().map(|own| {
        let count = own.values.len() as f64;
        let of_noise = 2.0 * own.repetition.unwrap_or(1.0) / count.max(1.0) + 2.0 / own.known_by;
        (count / rows).powi(2) * of_noise
    });
    let small = mean_square <= 1.0 + UNEXPLAINED * variance.sum::<f64>().sqrt();
    let structured = |own: &Residuals| {
        let noise = own.repetition.map(|noise| STRUCTURED * noise);
        noise.is_some_and(|noise| repetition(&own.values) > noise)
    };
    small && !all.iter().any(structured)
}

fn mean_of_squares(values: &[f64]) -> f64 {
    values.iter().map(|own| own * own).sum::<f64>() / values.len().max(1) as f64
}

/// How many neighbouring residuals say the same; of many by the means of blocks.
fn repetition(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    let apart: Vec<f64> = values.iter().map(|own| own - mean).collect();
    let size = apart.len().div_ceil(BLOCKS).max(1);
    let blocks: Vec<f64> = apart
        .chunks(size)
        .map(|own| own.iter().sum::<f64>() / own.len() as f64)
        .collect();
    let within = size as f64 * mean_of_squares(&blocks) / mean_of_squares(&apart);
    Noise::of(&blocks, 1).map_or(1.0, |noise| within * noise.repetition())
}

/// Deviations and coefficients by the inverse of the information with that of the bounds; none of an input that nothing depends on.
fn uncertainties<const N: usize>(information: &[[f64; N]; N]) -> ([Option<f64>; N], [[f64; N]; N]) {
    let size: [f64; N] = from_fn(|k| match information[k][k] {
        own if own > 0.0 => (own + BOUNDS).sqrt(),
        _ => 0.0,
    });
    let plain = from_fn(|i| {
        from_fn(|k| match size[i] * size[k] {
            both if both > 0.0 && i != k => information[i][k] / both,
            _ => f64::from(u8::from(i == k)),
        })
    });
    let inverse: [[f64; N]; N] = linear::inverse(plain, 1e-10).unwrap_or([[f64::INFINITY; N]; N]);
    let known = |own: &f64| own.is_finite();
    let deviations = from_fn(|k| Some(inverse[k][k].sqrt() / size[k]).filter(known));
    let of = |i: usize, k: usize| inverse[i][k] / (inverse[i][i] * inverse[k][k]).sqrt();
    (deviations, from_fn(|i| from_fn(|k| of(i, k))))
}

#[cfg(test)]
#[path = "../../tests/unit/estimate.rs"]
mod tests;
