//! How far data may lie from a prediction: noise, zero, scale, the band of M, and the models' own error.
//!
//! All that enters linearly is integrated in closed form as covariance of the means y:
//!
//! ```text
//!   C = diag(σ²) + zero² (per test) + scale² y yᵀ + cov M(Ω,Ω') + level² M Mᵀ + inertia² jjᵀ, j = J_O Ω̇
//!     + lag² l lᵀ, l = change of rolling torque over a mean by its width            smoothing by the torque's inversion
//!     + diag(½ M(Ω_1) b)², b = part of a mean's time below the lowest speed Ω_1 of the slow tests, where M is carried on
//!     + a² A Aᵀ ∘ K,   A = M + |j|,  K = ρ exp(-|Δln age|) exp(-|ΔΩ|/½Ω_max)       discrepancy
//!     + scatter² Σ e_t e_tᵀ,  e_t = prediction of test t minus that of rolling balls
//! ```
//! ρ is 1 within a test and ½ between tests. The amplitude a is not known: a few values, equally probable, stand for
//! it. The last term lets the size of an effect differ a little from test to test. Cage speeds have a covariance of
//! their own. At rest no discrepancy is allowed: a shaft that stands transmits no moment that a model could miss.
//! Means between rest and the lowest speed of the slow tests are left out, where M is not known, and those within the settling of the
//! sensor after a stop.

use super::hypothesis::{Bearing, Hypothesis, Prediction};
use super::record::{Bin, Trial};
use crate::algebra::{Factor, dot};
use crate::moment::CARRIED_ON;
use nalgebra::DMatrix;

/// The data with the covariances of their errors.
pub(crate) struct Observed {
    torque: Signal,
    cage: Signal,
    /// Amplitudes a of the discrepancy.
    pub amplitudes: Vec<f64>,
    scatter: f64,
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
    factor: Vec<Factor>,
}

/// Residual of unit covariance but for the scatter of effects.
pub(crate) struct Whitened {
    pub residual: Vec<f64>,
    /// Whitened effect of each test times its scatter.
    pub directions: Vec<Vec<f64>>,
    log_determinant: f64,
}

/// Relative deviation of the geometry 1+s behind a cage speed, from the contact angle: assumed.
const CAGE_SCALE: f64 = 0.003;
/// Relative error of one mean of the cage speed beside its noise: counting of balls over a changing speed, assumed.
const CAGE_NUGGET: f64 = 5e-4;
/// Error of the reduced model of slip over the slip that is seen, assumed: one load and one spin stand for all balls.
const SLIP_ERROR: f64 = 0.1;
/// Discrepancy of the cage speed over that of the torque, assumed.
const CAGE_SHARE: f64 = 0.5;
/// Error of one mean over the discrepancy: 0.3 of its amplitude is not shared with neighbours, assumed.
const NUGGET: f64 = 0.3;
/// Part of the inertia moment that a smoothed torque misplaces in time, assumed.
const SMEAR: f64 = 0.07;

/// Mean speed over the lowest one of the slow tests below which a shaft counts as standing.
const STANDING: f64 = 1e-3;

/// Error of M near the lowest speeds of a coast-down, over M; it fades with 3 % of the highest speed. Assumed.
const NEAR_REST: f64 = 0.3;

impl Observed {
    /// The data of all tests; none where a covariance is not positive definite (a band that is none).
    ///
    /// - `amplitudes`: of the discrepancy
    pub fn new(tests: &[Trial], bearing: &Bearing, amplitudes: &[f64]) -> Option<Self> {
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
            amplitudes,
            |bin| bin.torque,
            |a, i, j| torque_covariance(a, tests, i, j, bearing),
        )?;
        let cage = Signal::new(
            &with_cage,
            amplitudes,
            |bin| bin.cage.map_or(0.0, |mean| mean.speed),
            |a, i, j| cage_covariance(a, i, j, bearing),
        )?;
        Some(Self {
            torque,
            cage,
            amplitudes: amplitudes.to_vec(),
            scatter: settings.effect_scatter,
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

    /// Residual (data minus prediction) and effects at one amplitude.
    pub fn whiten(&self, prediction: &Prediction, amplitude: usize, tests: usize) -> Whitened {
        let signals = [
            (&self.torque, &prediction.torque, &self.rolling.torque),
            (&self.cage, &prediction.cage, &self.rolling.cage),
        ];
        let mut whitened = Whitened {
            residual: Vec::with_capacity(self.count()),
            directions: vec![Vec::with_capacity(self.count()); tests],
            log_determinant: 0.0,
        };
        for (signal, predicted, rolling) in signals {
            let factor = &signal.factor[amplitude];
            whitened.log_determinant += factor.log_determinant;
            let mut residual: Vec<f64> = (signal.value.iter().zip(&signal.place))
                .map(|(value, place)| value - predicted[*place])
                .collect();
            factor.whiten(&mut residual);
            whitened.residual.append(&mut residual);
            for (test, direction) in whitened.directions.iter_mut().enumerate() {
                let mut effect = vec![0.0; signal.place.len()];
                let first = signal.test.partition_point(|owner| *owner < test);
                for (i, place) in signal.place.iter().enumerate().skip(first) {
                    if signal.test[i] != test {
                        break;
                    }
                    effect[i] = self.scatter * (predicted[*place] - rolling[*place]);
                }
                factor.whiten_from(first, &mut effect);
                direction.append(&mut effect);
            }
        }
        whitened
    }

    /// Whitened change of the data per change of the prediction, at one amplitude.
    pub fn whiten_change(&self, from: &Prediction, to: &Prediction, amplitude: usize) -> Vec<f64> {
        let mut all = Vec::with_capacity(self.count());
        for (signal, from, to) in [
            (&self.torque, &from.torque, &to.torque),
            (&self.cage, &from.cage, &to.cage),
        ] {
            let mut change: Vec<f64> = (signal.place.iter())
                .map(|place| to[*place] - from[*place])
                .collect();
            signal.factor[amplitude].whiten(&mut change);
            all.append(&mut change);
        }
        all
    }

    /// ln of the likelihood and χ² at each amplitude.
    pub fn log_likelihood(&self, prediction: &Prediction, tests: usize) -> Vec<(f64, f64)> {
        (0..self.amplitudes.len())
            .map(|amplitude| self.whiten(prediction, amplitude, tests).log_likelihood())
            .collect()
    }
}

impl Whitened {
    /// Factor of I + GᵀG of the directions G; none where an effect is not finite.
    fn inner(&self) -> Option<Factor> {
        let size = self.directions.len();
        Factor::of(DMatrix::from_fn(size, size, |i, j| {
            f64::from(u8::from(i == j)) + dot(&self.directions[i], &self.directions[j])
        }))
    }

    /// (I + GGᵀ)⁻¹ v.
    pub fn metric(&self, vectors: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let Some(inner) = self.inner() else {
            return vectors.to_vec();
        };
        (vectors.iter())
            .map(|vector| {
                let mut shares: Vec<f64> = self.directions.iter().map(|d| dot(d, vector)).collect();
                inner.solve(&mut shares);
                let mut out = vector.clone();
                for (share, direction) in shares.iter().zip(&self.directions) {
                    for (entry, d) in out.iter_mut().zip(direction) {
                        *entry -= share * d;
                    }
                }
                out
            })
            .collect()
    }

    /// ln of the likelihood and χ².
    pub fn log_likelihood(&self) -> (f64, f64) {
        let Some(inner) = self.inner() else {
            return (f64::NEG_INFINITY, f64::INFINITY);
        };
        let mut shares: Vec<f64> = (self.directions.iter())
            .map(|d| dot(d, &self.residual))
            .collect();
        inner.whiten(&mut shares);
        let square = dot(&self.residual, &self.residual) - dot(&shares, &shares);
        let normal = self.residual.len() as f64 * (2.0 * std::f64::consts::PI).ln();
        let log = -0.5 * (square + self.log_determinant + inner.log_determinant + normal);
        (if log.is_nan() { f64::NEG_INFINITY } else { log }, square)
    }
}

impl Signal {
    fn new(
        means: &[(usize, usize, &Bin)],
        amplitudes: &[f64],
        value: impl Fn(&Bin) -> f64,
        covariance: impl Fn(f64, (usize, &Bin), (usize, &Bin)) -> f64,
    ) -> Option<Self> {
        let size = means.len();
        let factor = (amplitudes.iter())
            .map(|amplitude| {
                let mut matrix = DMatrix::zeros(size, size);
                for (i, (place, test, bin)) in means.iter().enumerate() {
                    for (j, (other_place, other_test, other)) in means[..=i].iter().enumerate() {
                        let mut entry = covariance(*amplitude, (*test, bin), (*other_test, other));
                        if place == other_place {
                            entry *= 1.0 + 1e-9;
                        }
                        matrix[(i, j)] = entry;
                    }
                }
                Factor::of(matrix)
            })
            .collect::<Option<Vec<_>>>()?;
        Some(Self {
            place: means.iter().map(|(place, _, _)| *place).collect(),
            test: means.iter().map(|(_, test, _)| *test).collect(),
            value: means.iter().map(|(_, _, bin)| value(bin)).collect(),
            factor,
        })
    }
}

/// Correlation of a model's error in two means.
fn kernel(one: (usize, &Bin), other: (usize, &Bin), top_speed: f64) -> f64 {
    let ((test, a), (other_test, b)) = (one, other);
    let shared = if test == other_test { 1.0 } else { 0.5 };
    let age = ((a.age + 0.02) / (b.age + 0.02)).ln().abs();
    let speed = (a.speed - b.speed).abs() / (0.5 * top_speed);
    shared * (-age - speed).exp()
}

fn torque_covariance(
    amplitude: f64,
    tests: &[Trial],
    one: (usize, &Bin),
    other: (usize, &Bin),
    bearing: &Bearing,
) -> f64 {
    let ((test, a), (other_test, b)) = (one, other);
    let settings = bearing.settings;
    let inertia = bearing.set.outer_inertia();
    let (j, k) = (inertia * a.acceleration, inertia * b.acceleration);
    let (m, n) = (bearing.table.at(a.speed).0, bearing.table.at(b.speed).0);
    let carried_on = CARRIED_ON * bearing.table.at(bearing.table.lowest).0;
    let scale = tests[test].scale_deviation * tests[other_test].scale_deviation;
    let mut sum = scale * a.torque * b.torque
        + bearing.steady.covariance_between(a.speed, b.speed)
        + settings.level_deviation.powi(2) * m * n
        + settings.inertia_deviation.powi(2) * j * k
        + settings.lag_deviation.powi(2) * a.steepness * b.steepness;
    if !a.before && !b.before {
        let size = amplitude * amplitude * (m + j.abs()) * (n + k.abs());
        sum += size * kernel(one, other, bearing.table.top_speed);
    }
    if test == other_test {
        sum += tests[test].zero_deviation.powi(2);
        if std::ptr::eq(a, b) {
            sum += a.variance
                + (carried_on * a.below).powi(2)
                + (SMEAR * j).powi(2)
                + (0.3 * settings.lag_deviation * a.steepness).powi(2)
                + (NUGGET * amplitude * m).powi(2)
                + (NEAR_REST * m * (-a.speed / (0.03 * bearing.table.top_speed)).exp()).powi(2);
        }
    }
    sum
}

fn cage_covariance(
    amplitude: f64,
    one: (usize, &Bin),
    other: (usize, &Bin),
    bearing: &Bearing,
) -> f64 {
    let ((test, a), (other_test, b)) = (one, other);
    let (m, n) = (
        bearing.set.cage_speed(a.speed),
        bearing.set.cage_speed(b.speed),
    );
    let share = CAGE_SHARE * amplitude;
    let slip = |bin: &Bin, rolling: f64| bin.cage.map_or(0.0, |mean| (rolling - mean.speed).abs());
    let slip_error = SLIP_ERROR * SLIP_ERROR * slip(a, m) * slip(b, n);
    let mut sum = CAGE_SCALE * CAGE_SCALE * m * n
        + (share * share * m * n + slip_error) * kernel(one, other, bearing.table.top_speed);
    if test == other_test && std::ptr::eq(a, b) {
        let top = bearing.set.cage_speed(bearing.table.top_speed);
        sum += a.cage.map_or(0.0, |mean| mean.variance) + (CAGE_NUGGET * top).powi(2);
    }
    sum
}
