//! How far data may lie from a prediction: noise, zero, scale, the band of M, and the models' own error.
//!
//! What is known to be shared enters linearly and is integrated in closed form; what is not is independent, and its likelihood counts to
//! the power w of the [evidence](crate::evidence):
//!
//! ```text
//!   L^w = ∫ N(y; f + U u, D)^w N(u; 0, I) du        ln L^w = -½ [rᵀC⁻¹r + ln|C| - ln|D/w| + w ln|D| + w n ln 2π],  C = D/w + U Uᵀ
//!
//!   U Uᵀ = zero² (per test) + scale² y yᵀ + cov M(Ω,Ω') + level² M Mᵀ + inertia² jjᵀ, j = J_O Ω̇
//!        + lag² l lᵀ, l = change of rolling torque over a mean by its width            smoothing by the torque's inversion
//!   D    = σ² + (½ M(Ω_1) b)², b = part of a mean's time below the lowest speed Ω_1 of the slow tests, where M is carried on
//!        + a² (M + |j|)²                                                                the models' own error
//! ```
//! The amplitude a is not known: a few values, equally probable, stand for it. Cage speeds have a covariance of
//! their own. At rest no error of a model is allowed: a shaft that stands transmits no moment that a model could miss.
//! Means between rest and the lowest speed of the slow tests are left out, where M is not known, and those within the settling of the
//! sensor after a stop.

use super::hypothesis::{Bearing, Hypothesis, Prediction};
use super::record::{Bin, Trial};
use super::settings::{INERTIA_DEVIATION, LAG_DEVIATION, LEVEL_DEVIATION};
use crate::algebra::{Factor, dot};
use crate::evidence::effective_number;
use crate::moment::CARRIED_ON;
use nalgebra::DMatrix;
use std::f64::consts::TAU;

/// The data with the covariances of their errors.
pub(crate) struct Observed {
    torque: Signal,
    cage: Signal,
    /// Amplitudes a of the models' own error.
    pub amplitudes: Vec<f64>,
    /// What rolling balls would give: effects are counted from there.
    pub rolling: Prediction,
}

/// Means of one kind.
struct Signal {
    /// Their places in a prediction.
    place: Vec<usize>,
    /// The test each belongs to.
    test: Vec<usize>,
    value: Vec<f64>,
    /// For each amplitude.
    errors: Vec<Errors>,
}

/// Errors at one amplitude.
struct Errors {
    /// Of the covariance C.
    factor: Factor,
    /// Variances D of what is not shared, over the power w.
    own: Vec<f64>,
    /// ln L^w at no residual.
    normal: f64,
}

/// Relative deviation of the geometry 1+s behind a cage speed, from the contact angle: assumed.
const CAGE_SCALE: f64 = 0.003;
/// Relative error of one mean of the cage speed beside its noise: counting of balls over a changing speed, assumed.
const CAGE_NUGGET: f64 = 5e-4;
/// Error of the reduced model of slip over the slip that is seen, assumed: one load and one spin stand for all balls.
const SLIP_ERROR: f64 = 0.1;
/// The models' own error of the cage speed over that of the torque, assumed.
const CAGE_SHARE: f64 = 0.5;
/// Part of the inertia moment that a smoothed torque misplaces in time, assumed.
const SMEAR: f64 = 0.07;
/// Mean speed over the lowest one of the slow tests below which a shaft counts as standing.
const STANDING: f64 = 1e-3;
/// Error of M near the lowest speeds of a coast-down, over M; it fades with 3 % of the highest speed. Assumed.
const NEAR_REST: f64 = 0.3;

impl Observed {
    /// The data of all tests; none where a covariance is not positive definite (a band that is none).
    ///
    /// - `amplitudes`: of the models' own error
    /// - `power`: w
    pub fn new(tests: &[Trial], bearing: &Bearing, amplitudes: &[f64], power: f64) -> Option<Self> {
        let settings = bearing.settings;
        let all: Vec<(usize, usize, &Bin)> = (tests.iter().enumerate())
            .flat_map(|(t, test)| test.bins.iter().map(move |bin| (t, bin)))
            .enumerate()
            .map(|(place, (t, bin))| (place, t, bin))
            .collect();
        // between rest and the lowest speed of the slow tests nothing is known of M, and where the shaft stops the torque falls at
        // once, which no sensor and no smoothed torque follows
        let lowest = bearing.table.lowest;
        let stands = |bin: &Bin| bin.speed < STANDING * lowest;
        let stopped: Vec<f64> = (tests.iter())
            .map(|test| {
                let moving = test.bins.iter().filter(|bin| !bin.before && !stands(bin));
                moving.map(|bin| bin.to).fold(0.0, f64::max) + settings.settling_time
            })
            .collect();
        let known = |test: usize, bin: &Bin| match stands(bin) {
            true => bin.before || bin.from >= stopped[test],
            false => bin.speed >= lowest,
        };
        let with_torque: Vec<_> = (all.iter().copied())
            .filter(|(_, test, bin)| bin.variance.is_finite() && known(*test, bin))
            .collect();
        let with_cage: Vec<_> = (all.iter().copied())
            .filter(|(_, _, bin)| bin.cage.is_some() && bin.speed > 0.1 * bearing.table.top_speed)
            .collect();
        let torque = Signal::new(
            &with_torque,
            |bin| bin.torque,
            |i, j| shared_torque(tests, i, j, bearing),
            amplitudes.iter().map(|a| own_torque(*a, bearing)),
            power,
        )?;
        let cage = Signal::new(
            &with_cage,
            |bin| bin.cage.map_or(0.0, |mean| mean.speed),
            |(_, a), (_, b)| shared_cage(a, b, bearing),
            amplitudes.iter().map(|a| own_cage(*a, bearing)),
            power,
        )?;
        Some(Self {
            torque,
            cage,
            amplitudes: amplitudes.to_vec(),
            rolling: Hypothesis::Rolling.predict(&[], tests, bearing),
        })
    }

    /// Numbers of means of torque and of cage speed.
    pub fn counts(&self) -> (usize, usize) {
        (self.torque.value.len(), self.cage.value.len())
    }

    /// Places of the means of torque in a prediction.
    pub fn torque_places(&self) -> &[usize] {
        &self.torque.place
    }

    /// Number of means.
    pub fn count(&self) -> usize {
        self.torque.value.len() + self.cage.value.len()
    }

    /// Both kinds of means with what is predicted of them.
    fn signals<'a>(&'a self, prediction: &'a Prediction) -> [(&'a Signal, &'a [f64]); 2] {
        [
            (&self.torque, &prediction.torque),
            (&self.cage, &prediction.cage),
        ]
    }

    /// Data minus prediction, of unit covariance, at one amplitude.
    pub fn residual(&self, prediction: &Prediction, amplitude: usize) -> Vec<f64> {
        let mut all = Vec::with_capacity(self.count());
        for (signal, predicted) in self.signals(prediction) {
            let mut residual = signal.residual(predicted);
            signal.errors[amplitude].factor.whiten(&mut residual);
            all.append(&mut residual);
        }
        all
    }

    /// Whitened change of the data per change of the prediction, at one amplitude.
    pub fn whiten_change(&self, from: &Prediction, to: &Prediction, amplitude: usize) -> Vec<f64> {
        let (from, to) = (self.residual(from, amplitude), self.residual(to, amplitude));
        from.iter().zip(to).map(|(from, to)| from - to).collect()
    }

    /// ln of the likelihood to the power w, and χ², at each amplitude.
    pub fn log_likelihood(&self, prediction: &Prediction) -> Vec<(f64, f64)> {
        let at = |amplitude: usize| {
            let residual = self.residual(prediction, amplitude);
            let normal = self.torque.errors[amplitude].normal + self.cage.errors[amplitude].normal;
            let square = dot(&residual, &residual);
            let log = normal - 0.5 * square;
            (if log.is_nan() { f64::NEG_INFINITY } else { log }, square)
        };
        (0..self.amplitudes.len()).map(at).collect()
    }

    /// Effective number of data by what a prediction leaves beside the shared errors.
    pub fn effective_number(&self, prediction: &Prediction, amplitude: usize) -> f64 {
        let mut left: Vec<Vec<f64>> = Vec::new();
        for (signal, predicted) in self.signals(prediction) {
            let errors = &signal.errors[amplitude];
            let mut residual = signal.residual(predicted);
            errors.factor.solve(&mut residual);
            for (residual, own) in residual.iter_mut().zip(&errors.own) {
                *residual *= own.sqrt();
            }
            let mut from = 0;
            for test in signal.test.chunk_by(|a, b| a == b) {
                left.push(residual[from..from + test.len()].to_vec());
                from += test.len();
            }
        }
        effective_number(left.iter().map(Vec::as_slice))
    }
}

impl Signal {
    fn new<Own: Fn(&Bin) -> f64>(
        means: &[(usize, usize, &Bin)],
        value: impl Fn(&Bin) -> f64,
        shared: impl Fn((usize, &Bin), (usize, &Bin)) -> f64,
        own: impl Iterator<Item = Own>,
        power: f64,
    ) -> Option<Self> {
        let size = means.len();
        let mut common = DMatrix::zeros(size, size);
        for (i, (_, test, bin)) in means.iter().enumerate() {
            for (j, (_, other_test, other)) in means[..=i].iter().enumerate() {
                common[(i, j)] = shared((*test, bin), (*other_test, other));
            }
        }
        let errors = own.map(|own| {
            let own: Vec<f64> = means.iter().map(|(_, _, bin)| own(bin) / power).collect();
            let mut matrix = common.clone();
            for (i, own) in own.iter().enumerate() {
                matrix[(i, i)] += own;
            }
            let factor = Factor::of(matrix)?;
            let logs: f64 = own
                .iter()
                .map(|own| (power * (TAU * power * own).ln()) - own.ln())
                .sum();
            Some(Errors {
                normal: -0.5 * (factor.log_determinant + logs),
                factor,
                own,
            })
        });
        Some(Self {
            place: means.iter().map(|(place, _, _)| *place).collect(),
            test: means.iter().map(|(_, test, _)| *test).collect(),
            value: means.iter().map(|(_, _, bin)| value(bin)).collect(),
            errors: errors.collect::<Option<Vec<_>>>()?,
        })
    }

    fn residual(&self, predicted: &[f64]) -> Vec<f64> {
        let pairs = self.value.iter().zip(&self.place);
        pairs
            .map(|(value, place)| value - predicted[*place])
            .collect()
    }
}

fn shared_torque(
    tests: &[Trial],
    one: (usize, &Bin),
    other: (usize, &Bin),
    bearing: &Bearing,
) -> f64 {
    let ((test, a), (other_test, b)) = (one, other);
    let inertia = bearing.set.outer_inertia();
    let (j, k) = (inertia * a.acceleration, inertia * b.acceleration);
    let (m, n) = (bearing.table.at(a.speed).0, bearing.table.at(b.speed).0);
    let scale = tests[test].scale_deviation * tests[other_test].scale_deviation;
    let zero = match test == other_test {
        true => tests[test].zero_deviation.powi(2),
        false => 0.0,
    };
    zero + scale * a.torque * b.torque
        + bearing.steady.covariance_between(a.speed, b.speed)
        + LEVEL_DEVIATION.powi(2) * m * n
        + INERTIA_DEVIATION.powi(2) * j * k
        + LAG_DEVIATION.powi(2) * a.steepness * b.steepness
}

fn own_torque(amplitude: f64, bearing: &Bearing) -> impl Fn(&Bin) -> f64 {
    let carried_on = CARRIED_ON * bearing.table.at(bearing.table.lowest).0;
    move |bin| {
        let j = bearing.set.outer_inertia() * bin.acceleration;
        let m = bearing.table.at(bin.speed).0;
        let model = if bin.before {
            0.0
        } else {
            amplitude * (m + j.abs())
        };
        bin.variance
            + model.powi(2)
            + (carried_on * bin.below).powi(2)
            + (SMEAR * j).powi(2)
            + (0.3 * LAG_DEVIATION * bin.steepness).powi(2)
            + (NEAR_REST * m * (-bin.speed / (0.03 * bearing.table.top_speed)).exp()).powi(2)
    }
}

fn shared_cage(one: &Bin, other: &Bin, bearing: &Bearing) -> f64 {
    let rolling = |bin: &Bin| CAGE_SCALE * bearing.set.cage_speed(bin.speed);
    rolling(one) * rolling(other)
}

fn own_cage(amplitude: f64, bearing: &Bearing) -> impl Fn(&Bin) -> f64 {
    let nugget = CAGE_NUGGET * bearing.set.cage_speed(bearing.table.top_speed);
    move |bin| {
        let rolling = bearing.set.cage_speed(bin.speed);
        let model = CAGE_SHARE * amplitude * rolling;
        bin.cage.map_or(0.0, |mean| {
            let slip = SLIP_ERROR * (rolling - mean.speed);
            mean.variance + slip.powi(2)
        }) + model.powi(2)
            + nugget.powi(2)
    }
}
