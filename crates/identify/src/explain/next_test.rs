//! Which test would decide: candidates ranked by expected information.
//!
//! ```text
//!   I = H(E) - ⟨H(E | y)⟩      H entropy of the probabilities of the explanations that are left, nats
//! ```
//! Each candidate is simulated under draws of the posterior of each explanation that is left; recovery at rest is drawn
//! from its prior. The approximation: means of torque (and cage speed) have the covariance of the comparison at
//! one amplitude of the discrepancy, and the predictions of one explanation are taken as normal with the mean and
//! covariance of its draws. The mean over draws and noise is a sum of few hundred terms: I is known to some hundredths.
//!
//! Does not model: what the new test shares with the old ones (zero, scale and level count as new), the effort of a test.

use super::settings::DISCREPANCY;
use nalgebra::DMatrix;
use physics::rolling::RollingSet;
use statistics::random::Random;

use crate::algebra::{Factor, dot, log_sum_exp};
use crate::{Measurement, SteadyMoment};

use super::hypothesis::{Bearing, Hypothesis, Prediction};
use super::means::CageMean;
use super::noise::Observed;
use super::prior::{RECOVERY_TIME, Range};
use super::record::{LeastWidth, Past, Trial};
use super::steady::Table;
use super::{BAD_CURVE, Settings, Verdict, bearing};

/// A test that could be made next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Proposal {
    /// Let it coast down at once after the spin-up.
    CoastDownAtOnce,
    /// Repeat the test after 5 s at rest.
    RepeatAfterSeconds,
    /// Repeat the test after 24 h at rest.
    RepeatAfterDay,
    /// The same acceleration to half the speed.
    HalfSpeed,
    /// Twice the dead weight.
    TwiceTheLoad,
    /// A ramp of 5 s to the same speed and a hold of 5 s.
    SlowRamp,
    /// The same test with a sensor of the cage speed.
    CageSensor,
    /// The same test with 10 s of reading at rest after it.
    ZeroCheck,
    /// The same test with the temperature of the outer race.
    Temperature,
}

/// A proposal with what it would settle.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// The test.
    pub proposal: Proposal,
    /// Expected reduction of the entropy between the explanations, nats.
    pub information: f64,
    /// The same over the entropy that is left; 1 decides.
    pub share: f64,
}

impl Proposal {
    /// All proposals.
    pub const ALL: [Self; 9] = [
        Self::CoastDownAtOnce,
        Self::RepeatAfterSeconds,
        Self::RepeatAfterDay,
        Self::HalfSpeed,
        Self::TwiceTheLoad,
        Self::SlowRamp,
        Self::CageSensor,
        Self::ZeroCheck,
        Self::Temperature,
    ];

    /// What to do.
    pub fn name(self) -> &'static str {
        match self {
            Self::CoastDownAtOnce => "coast-down at once after the spin-up",
            Self::RepeatAfterSeconds => "the same test again after 5 s at rest",
            Self::RepeatAfterDay => "the same test again after 24 h at rest",
            Self::HalfSpeed => "spin-up to half the speed",
            Self::TwiceTheLoad => "twice the dead weight",
            Self::SlowRamp => "ramp of 5 s to the same speed and 5 s hold",
            Self::CageSensor => "the same test with a sensor of the cage speed",
            Self::ZeroCheck => "the same test with 10 s of reading at rest after it",
            Self::Temperature => "the same test with the temperature of the outer race",
        }
    }

    /// What would differ between the explanations.
    pub fn difference(self) -> &'static str {
        match self {
            Self::CoastDownAtOnce => {
                "Worked grease lowers the viscous part at every speed, a drifted zero all speeds by the same torque, \
                 creep and another steady moment all by the same factor, creep not at first; slip ends where M falls below \
                 the traction limit."
            }
            Self::RepeatAfterSeconds => {
                "Worked grease starts low and shows no build-up; a sensor that has drifted does not drift again; slip and \
                 oil, cold again after seconds, repeat themselves."
            }
            Self::RepeatAfterDay => {
                "Rested grease and a recovered sensor repeat their course; what does not repeat was neither."
            }
            Self::HalfSpeed => {
                "Build-up scales with cage turns and takes twice as long; heating has less power; an artefact keeps its \
                 time; the traction limit may suffice for the lower M."
            }
            Self::TwiceTheLoad => {
                "Nearly twice the traction limit: slip shrinks or ends; grease and sensor keep their effect."
            }
            Self::SlowRamp => {
                "No skid in the run-up and no quick load on the sensor; breakdown and heating begin at low speed; slip \
                 of a limited traction comes back at the speed where M exceeds it."
            }
            Self::CageSensor => {
                "Slip shows as a cage that stays behind rolling speed; with grease or an artefact it does not."
            }
            Self::ZeroCheck => {
                "A drifted zero stays when the shaft stands and a slow sensor lags; torque of the bearing is gone."
            }
            Self::Temperature => {
                "Heating must warm the outer race; within seconds it does so by tenths of a kelvin, whatever the cause."
            }
        }
    }
}

/// Candidates for the next test, the most informative first.
///
/// - `verdict`: of the tests made so far, with the same arguments
/// - `tests`, `steady`, `set`, `settings`: as for [`explain`](super::explain)
///
/// Where one explanation is certain nothing is left to learn: all informations are near 0.
///
/// # Errors
/// Where the arguments cannot be used: why.
pub fn next_test(
    verdict: &Verdict,
    tests: &[Measurement],
    steady: &SteadyMoment,
    set: &RollingSet<f64>,
    settings: &Settings,
) -> Result<Vec<Candidate>, String> {
    let bearing = bearing(tests, steady, set, settings)?;
    let table = &bearing.table;
    let rig = Rig::of(&tests[tests.len() - 1], table, set.outer_inertia());
    let mut candidates = Vec::new();
    for proposal in Proposal::ALL {
        let mut random = Random::new(settings.seed ^ 0xca5e);
        let trial = Planned {
            proposal,
            test: rig.plan(proposal, table),
            bearing: &bearing,
        };
        let (information, entropy) = trial.information(verdict, &mut random).ok_or(BAD_CURVE)?;
        candidates.push(Candidate {
            proposal,
            information,
            share: if entropy > 0.0 {
                information / entropy
            } else {
                0.0
            },
        });
    }
    candidates.sort_by(|a, b| b.information.total_cmp(&a.information));
    Ok(candidates)
}

/// What the last test shows of rig and sensors.
struct Rig {
    /// J_O, kg m².
    inertia: f64,
    ramp: f64,
    /// Least width of a mean, s, over the time since the engagement.
    least_width: LeastWidth,
    /// Variance of a mean times its width, (N m)² s.
    noise: f64,
    zero_deviation: f64,
    scale_deviation: f64,
}

/// Deviation of one value of a cage sensor that is not there yet, over the cage speed: ball pass counted over 10 ms.
const CAGE_NOISE: f64 = 0.005;
/// Deviation of a thermocouple's reading of a rise, K: assumed.
const TEMPERATURE_NOISE: f64 = 0.1;
/// Range of the heat capacity that outer race and housing bring into play within seconds, J/K: 0.1 to 1 kg of steel.
const HEAT_CAPACITY: Range = Range::new(50.0, 500.0);

impl Rig {
    fn of(test: &Measurement, table: &Table, inertia: f64) -> Self {
        let record = Trial::measured(test, table, inertia);
        let ramp = (record.steps.iter())
            .find(|step| step.speed > 0.95 * table.top_speed)
            .map_or(0.1, |step| step.elapsed);
        let mut noise: Vec<f64> = (record.bins.iter())
            .map(|bin| bin.variance * (bin.to - bin.from))
            .filter(|noise| noise.is_finite())
            .collect();
        noise.sort_by(f64::total_cmp);
        Self {
            inertia,
            ramp,
            least_width: LeastWidth::of(test, table.top_speed),
            noise: noise.get(noise.len() / 2).copied().unwrap_or(1e-10),
            zero_deviation: test.zero_deviation,
            scale_deviation: test.scale_deviation,
        }
    }

    fn plan(&self, proposal: Proposal, table: &Table) -> Trial {
        let top = table.top_speed;
        let ramp = |ramp: f64, top: f64| move |t: f64| top * (t / ramp).clamp(0.0, 1.0);
        let usual = ramp(self.ramp, top);
        let hold = self.ramp + 5.0;
        let planned = |speed: &dyn Fn(f64) -> f64, end: f64| {
            Trial::planned(speed, end, &self.least_width, table, self.inertia)
        };
        let mut test = match proposal {
            Proposal::CoastDownAtOnce => {
                // M over a shaft that needs about 20 s
                let begin = self.ramp + 0.3;
                planned(
                    &|t| usual(t) - top * ((t - begin) / 20.0).clamp(0.0, 1.0),
                    begin + 20.0,
                )
            }
            Proposal::HalfSpeed => {
                planned(&ramp(0.5 * self.ramp, 0.5 * top), 0.5 * self.ramp + 5.0)
            }
            Proposal::SlowRamp => planned(&ramp(5.0, top), 10.0),
            Proposal::ZeroCheck => planned(
                &|t| usual(t) - top * ((t - hold) / 0.5).clamp(0.0, 1.0),
                hold + 10.5,
            ),
            _ => planned(&usual, hold),
        };
        if proposal == Proposal::TwiceTheLoad {
            test.past.load_factor = 2.0;
        }
        test.zero_deviation = self.zero_deviation;
        test.scale_deviation = self.scale_deviation;
        for bin in &mut test.bins {
            let width = bin.to - bin.from;
            bin.variance = self.noise / width;
            bin.torque = table.at(bin.speed).0;
            if proposal == Proposal::CageSensor {
                // a value each 10 ms
                let deviation = CAGE_NOISE * 0.4 * top;
                bin.cage = Some(CageMean {
                    from: bin.from,
                    to: bin.to,
                    speed: 0.0,
                    variance: deviation * deviation * 0.01 / width,
                });
            }
        }
        test
    }
}

/// A candidate before it is judged.
struct Planned<'a> {
    proposal: Proposal,
    test: Trial,
    bearing: &'a Bearing<'a>,
}

/// Predictions of one explanation as a normal distribution over whitened data.
struct Class {
    probability: f64,
    points: Vec<Vec<f64>>,
    mean: Vec<f64>,
    factor: Factor,
}

/// Least probability of an explanation that counts as left.
const LEFT: f64 = 0.005;
/// Draws of each explanation and of noise for each.
const NOISE_DRAWS: u32 = 4;
/// Draws of the posterior that are used.
const DRAWS: usize = 24;

impl Planned<'_> {
    /// Expected information and the entropy that is left, nats.
    fn information(&self, verdict: &Verdict, random: &mut Random) -> Option<(f64, f64)> {
        let one = std::slice::from_ref(&self.test);
        let observed = Observed::new(one, self.bearing, &DISCREPANCY, 1.0)?;
        let discrepancy = verdict.best().fit.map_or(0.02, |fit| fit.discrepancy);
        let nearest = |a: &f64| (a.ln() - discrepancy.max(1e-6).ln()).abs();
        let amplitude = (0..observed.amplitudes.len()).min_by(|i, j| {
            nearest(&observed.amplitudes[*i]).total_cmp(&nearest(&observed.amplitudes[*j]))
        })?;
        let mut classes = Vec::new();
        for assessment in &verdict.assessments {
            if assessment.probability < LEFT || assessment.draws.is_empty() {
                continue;
            }
            let every = assessment.draws.len().div_ceil(DRAWS);
            let points: Vec<Vec<f64>> = (assessment.draws.iter().step_by(every))
                .map(|draw| {
                    let prediction = self.predict(draw.form, &draw.coordinates, random);
                    let mut point =
                        observed.whiten_change(&observed.rolling, &prediction, amplitude);
                    if self.proposal == Proposal::Temperature {
                        point.push(self.warming(&prediction, random));
                    }
                    point
                })
                .collect();
            classes.push(Class::of(assessment.probability, points)?);
        }
        let total: f64 = classes.iter().map(|class| class.probability).sum();
        classes
            .iter_mut()
            .for_each(|class| class.probability /= total);
        let entropy = -(classes.iter().map(|c| c.probability * c.probability.ln())).sum::<f64>();
        let mut left = 0.0;
        for class in &classes {
            let share = class.probability / (class.points.len() as f64 * f64::from(NOISE_DRAWS));
            for point in &class.points {
                for _ in 0..NOISE_DRAWS {
                    let data: Vec<f64> = point.iter().map(|x| x + random.normal()).collect();
                    left += share * entropy_after(&classes, &data);
                }
            }
        }
        // + 0 makes 0 of -0, which one certain explanation leaves
        let entropy = entropy.max(0.0) + 0.0;
        Some(((entropy - left).clamp(0.0, entropy) + 0.0, entropy))
    }

    fn predict(&self, form: Hypothesis, coordinates: &[f64], random: &mut Random) -> Prediction {
        let mut test = self.test.clone();
        let values = form.values(coordinates, self.bearing);
        let recovery = match form.recovery(&values, self.bearing) {
            Some(time) => time,
            None => RECOVERY_TIME.positive(random.normal()),
        };
        let rest = match self.proposal {
            Proposal::RepeatAfterSeconds => 5.0,
            _ => 86_400.0,
        };
        let (left, film) = form.left(rest, recovery, &values);
        test.past = Past {
            left,
            film,
            ..test.past
        };
        form.predict(coordinates, std::slice::from_ref(&test), self.bearing)
    }

    /// Rise of the outer race at the end of the test in deviations of its reading.
    fn warming(&self, prediction: &Prediction, random: &mut Random) -> f64 {
        let heat: f64 = (self.test.bins.iter().zip(&prediction.torque))
            .map(|(bin, torque)| torque * bin.speed * (bin.to - bin.from))
            .sum();
        heat / HEAT_CAPACITY.positive(random.normal()) / TEMPERATURE_NOISE
    }
}

impl Class {
    fn of(probability: f64, points: Vec<Vec<f64>>) -> Option<Self> {
        let size = points.first()?.len();
        let count = points.len() as f64;
        let mut mean = vec![0.0; size];
        for point in &points {
            for (mean, x) in mean.iter_mut().zip(point) {
                *mean += x / count;
            }
        }
        let apart = DMatrix::from_fn(points.len(), size, |k, i| points[k][i] - mean[i]);
        let covariance =
            DMatrix::identity(size, size) + apart.tr_mul(&apart) / (count - 1.0).max(1.0);
        Some(Self {
            probability,
            points,
            mean,
            factor: Factor::of(covariance)?,
        })
    }

    fn log_density(&self, data: &[f64]) -> f64 {
        let mut residual: Vec<f64> = data.iter().zip(&self.mean).map(|(y, m)| y - m).collect();
        self.factor.whiten(&mut residual);
        -0.5 * (dot(&residual, &residual) + self.factor.log_determinant)
    }
}

fn entropy_after(classes: &[Class], data: &[f64]) -> f64 {
    let logs: Vec<f64> = (classes.iter())
        .map(|class| class.probability.ln() + class.log_density(data))
        .collect();
    let total = log_sum_exp(&logs);
    -(logs.iter())
        .map(|log| {
            let p = (log - total).exp();
            if p > 0.0 { p * p.ln() } else { 0.0 }
        })
        .sum::<f64>()
}
