//! What the estimators find in the tests, each with its own reason where it refuses.

use super::measured::measurement;
use super::read::{Asked, Test};
use crate::scenario::RotorFriction;
use crate::simulate::Options;
use crate::simulate::build_bearing::material;
use crate::simulate::outcome::Warning;
use crate::simulate::signals;
use identify::dissipation::{Dissipation, dissipation};
use identify::doubt::{Doubt, DoubtSettings, ViscosityByTemperature, doubts};
use identify::explain::{self, Candidate, Priors, Verdict};
use identify::loss::{Loss, LossMap, LossSettings, Rolling, loss};
use identify::moment::{Moment, MomentSettings, moment};
use identify::rotor_friction::{self, Race, RubbingSpinUp};
use identify::skid::{Skid, SkidSettings, skid};
use identify::slip::{CageSlip, SlipSettings, cage_slip};
use identify::{Measurement, SetDeviation};
use measure::uncertain::Uncertain;
use physics::materials::ball_mass;
use physics::rolling::RollingSet;
use std::sync::atomic::Ordering;

/// Relative standard deviation of how much the moment changes per kelvin: half of it is open.
const PER_KELVIN_DEVIATION: f64 = 0.5;
/// Relative standard deviation of the masses of balls and cage.
const MASS_DEVIATION: f64 = 0.02;
/// Relative standard deviation of the radius of the inner track.
const RADIUS_DEVIATION: f64 = 0.002;
/// Least part of the weight that counts as contact of a dropped rotor.
const CONTACT: f64 = 0.5;
/// Least slip that counts as sliding, m/s.
const SLIDING: f64 = 0.05;
/// Part of the largest speed at which tests are compared where nothing is asked for.
const ANALYSED: f64 = 0.95;
/// Number of times at which the friction of a rotor is looked at.
const ROTOR_TIMES: usize = 2000;

/// Time around the end of a quick change within which a jump of the torque is smeared, s: some times 1/ω_n of a usual arm.
const SMEARED: f64 = 0.01;

/// Time before a stop that a slow test is cut by, s: a usual arm settles within it several times over.
const STOPPING: f64 = 0.5;
/// Relative standard deviation of the cage's rolling speed as it is foretold: of the ratio by contact angle and radii, and of a
/// shaft's speed where its acceleration changes at once. A slip that explains a torque is ten times that.
const ROLLING_RATIO: f64 = 0.002;

/// One test with what its signals hold and what they tell.
pub(super) struct TestFound {
    /// Name for people.
    pub name: String,
    /// The test as the estimators take it.
    pub measurement: Measurement,
    /// Largest acceleration of the shaft, rad/s².
    pub peak_acceleration: Uncertain,
    /// The friction of accelerated balls.
    pub loss: Result<Loss, String>,
    /// Energy of its spin-up.
    pub dissipation: Result<Dissipation, String>,
    /// Slip of the cage.
    pub slip: Result<CageSlip, String>,
    /// Spin of the balls.
    pub skid: Result<Skid, String>,
}

/// Everything that was found.
pub(super) struct Found {
    /// Balls and cage.
    pub set: RollingSet<f64>,
    /// The slow tests.
    pub coast_downs: Vec<Measurement>,
    /// The steady moment.
    pub moment: Result<Moment, String>,
    /// Tests with acceleration.
    pub tests: Vec<TestFound>,
    /// F over speed and acceleration.
    pub map: Result<LossMap, String>,
    /// Which explanation the data support.
    pub verdict: Result<Verdict, String>,
    /// The next test.
    pub next: Result<Vec<Candidate>, String>,
    /// Sliding friction of a dropped rotor.
    pub rotor: Result<rotor_friction::RotorFriction, String>,
    /// What to know before trusting the numbers.
    pub warnings: Vec<Warning>,
    /// Whether it was interrupted.
    pub interrupted: bool,
}

impl Found {
    /// Runs all estimators.
    pub fn of(asked: &Asked, options: &Options) -> Found {
        let wish = asked.identify;
        let set = rolling_set(asked);
        let mut warnings = Vec::new();
        let mut unusable = Vec::new();
        let interrupted = || options.interrupt.load(Ordering::Relaxed);
        let mut read = |tests: &[Test]| -> Vec<(Measurement, Uncertain)> {
            let mut list = Vec::new();
            for test in tests {
                if interrupted() {
                    break;
                }
                match measured(test, &mut warnings) {
                    Ok(measurement) => list.push(measurement),
                    Err(why) => unusable.push((test.name.clone(), why)),
                }
            }
            list
        };
        let coast_downs: Vec<Measurement> = (read(&asked.coast_downs).into_iter())
            .map(|(test, _)| test)
            .collect();
        let tests = read(&asked.tests);
        let steady: Vec<Measurement> = coast_downs.iter().map(before_the_stop).collect();
        let slow: Vec<&Measurement> = steady.iter().collect();
        let moment = match slow.as_slice() {
            [] => Err("none of the slow tests can be used".to_string()),
            slow => moment(
                slow,
                &set,
                &MomentSettings {
                    viscosity: wish.viscosity,
                    ..MomentSettings::default()
                },
            ),
        };
        let deviation = set_deviation(&set);
        let settings = LossSettings {
            rolling: match wish.rolling_stated {
                true => Rolling::Stated,
                false => Rolling::ByCage,
            },
            set_deviation: deviation,
            ..LossSettings::default()
        };
        let curve = moment.as_ref().map(|moment| &moment.curve);
        let no_moment = || "the steady moment is not known".to_string();
        let tests: Vec<TestFound> = (tests.into_iter())
            .map(|(test, peak_acceleration)| TestFound {
                name: test.name.clone(),
                peak_acceleration,
                loss: (curve.as_ref().map_err(|_| no_moment()))
                    .and_then(|curve| loss(&test, curve, &set, &settings)),
                dissipation: dissipation(&test, &set, &deviation, None),
                slip: cage_slip(&test, &set, &SlipSettings::default()),
                skid: (curve.as_ref().map_err(|_| no_moment()))
                    .and_then(|curve| skid(&test, curve, &set, &SkidSettings::default())),
                measurement: test,
            })
            .collect();
        let map = map(&tests, curve.as_ref().ok().copied(), &set, &settings);
        let measurements: Vec<&Measurement> = tests.iter().map(|test| &test.measurement).collect();
        let doubts = doubted(asked, &measurements, curve.as_ref().ok().copied(), &set);
        let doubts = doubts.unwrap_or_else(|why| {
            unusable.push(("tests".to_string(), why));
            Vec::new()
        });
        let (verdict, next) = match (&moment, wish.explanations) {
            (_, None) => {
                let why = || "identify.explanations.compare is false".to_string();
                (Err(why()), Err(why()))
            }
            (_, Some(_)) if interrupted() => {
                let why = || "interrupted".to_string();
                (Err(why()), Err(why()))
            }
            (Err(_), Some(_)) => (Err(no_moment()), Err(no_moment())),
            (Ok(moment), Some(how)) => explained(&tests, moment, &set, how),
        };
        let rotor = match (&wish.rotor_friction, &asked.rotor) {
            (Some(wish), Some(test)) => rubbed(wish, test, &moment, &set, deviation, &mut warnings),
            _ => Err("identify.rotor_friction.file is not given".to_string()),
        };
        let mut told: Vec<Warning> = (unusable.iter())
            .map(|(name, why)| Warning {
                code: "AB1060",
                text: format!("{name} is not used: {}.", why.trim_end_matches('.')),
            })
            .collect();
        told.extend(doubts.iter().map(|doubt| Warning {
            code: "AB1061",
            text: format!("{}.", doubt.to_string().trim_end_matches('.')),
        }));
        let notes = (moment.iter().flat_map(|moment| &moment.notes))
            .chain(map.iter().flat_map(|map| &map.notes))
            .chain(rotor.iter().flat_map(|rotor| &rotor.notes));
        let of_tests = tests.iter().flat_map(|test| {
            let notes = (test.loss.iter().flat_map(|loss| &loss.notes))
                .chain(test.dissipation.iter().flat_map(|found| &found.notes));
            notes.map(|note| match note.contains(&test.name) {
                true => note.clone(),
                false => format!("{}: {note}", test.name),
            })
        });
        told.extend(notes.cloned().chain(of_tests).map(|note| Warning {
            code: "AB1062",
            text: format!("{}.", note.trim_end_matches('.')),
        }));
        told.append(&mut warnings);
        Found {
            set,
            coast_downs,
            moment,
            tests,
            map,
            verdict,
            next,
            rotor,
            warnings: told,
            interrupted: interrupted(),
        }
    }
}

/// A slow test without its end: where the shaft stops the moment falls at once, which no smoothed torque follows.
fn before_the_stop(test: &Measurement) -> Measurement {
    let turning = test.speed.iter().rposition(|speed| *speed != 0.0);
    match (turning, test.time.first()) {
        (Some(last), Some(first)) if last + 1 < test.time.len() => {
            test.between(*first, test.time[last] - STOPPING)
        }
        _ => test.clone(),
    }
}

/// Masses and radii of balls and cage.
fn rolling_set(asked: &Asked) -> RollingSet<f64> {
    let bearing = asked.identify;
    let ball = bearing.ball_mass.unwrap_or_else(|| {
        ball_mass(
            bearing.ball_diameter,
            material(bearing.ball_material).density,
        )
    });
    let track = 0.5 * (bearing.pitch_diameter - bearing.ball_diameter);
    RollingSet {
        inner_track_radius: track,
        ball_ratio: 0.5 * bearing.ball_diameter / track,
        balls_mass: bearing.ball_count as f64 * ball,
        cage_mass: bearing.cage_mass,
    }
}

fn set_deviation(set: &RollingSet<f64>) -> SetDeviation {
    SetDeviation {
        balls_mass: MASS_DEVIATION * set.balls_mass,
        cage_mass: MASS_DEVIATION * set.cage_mass,
        inner_track_radius: RADIUS_DEVIATION * set.inner_track_radius,
    }
}

/// The signals of a test as the estimators of the bearing take them.
fn measured(test: &Test, warnings: &mut Vec<Warning>) -> Result<(Measurement, Uncertain), String> {
    let found = signals::find(&test.asked);
    let scale = (test.signals.torque.as_ref()).map_or(0.0, |torque| torque.scale_deviation);
    let measurement = measurement(&test.name, test.load.unwrap_or(0.0), &found, scale);
    warnings.extend(found.warnings.iter().map(|warning| Warning {
        text: format!("{}: {}", test.name, warning.text),
        ..warning.clone()
    }));
    let peak = (found.shaft.as_ref()).map_or(Uncertain::exact(0.0), |shaft| {
        Uncertain::new(
            shaft.peak.acceleration,
            shaft.peak.acceleration_uncertainty(),
        )
    });
    measurement.map(|measurement| (measurement, peak))
}

fn map(
    tests: &[TestFound],
    curve: Option<&identify::SteadyMoment>,
    set: &RollingSet<f64>,
    settings: &LossSettings,
) -> Result<LossMap, String> {
    let curve = curve.ok_or_else(|| "the steady moment is not known".to_string())?;
    let pairs: Vec<(&Measurement, &Loss)> = (tests.iter())
        .filter_map(|test| Some((&test.measurement, test.loss.as_ref().ok()?)))
        .collect();
    if pairs.is_empty() {
        return Err("no test with acceleration can be used".to_string());
    }
    LossMap::fitted(&pairs, curve, set, settings)
}

fn doubted(
    asked: &Asked,
    tests: &[&Measurement],
    curve: Option<&identify::SteadyMoment>,
    set: &RollingSet<f64>,
) -> Result<Vec<Doubt>, String> {
    let wish = asked.identify;
    let fastest = |test: &&Measurement| test.speed.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let slowest = tests.iter().map(fastest).fold(f64::INFINITY, f64::min);
    let wanted = wish.analysed_speed.unwrap_or(ANALYSED * slowest);
    let per_kelvin = wish.moment_per_kelvin;
    doubts(
        tests,
        curve,
        set,
        &DoubtSettings {
            wanted_speed: wanted.is_finite().then_some(wanted),
            ball_count: Some(wish.ball_count as u32),
            masses_known: true,
            viscosity: Some(ViscosityByTemperature::PerKelvin(
                per_kelvin,
                PER_KELVIN_DEVIATION * per_kelvin.abs(),
            )),
            ..DoubtSettings::default()
        },
    )
}

fn explained(
    tests: &[TestFound],
    moment: &Moment,
    set: &RollingSet<f64>,
    how: crate::scenario::Explanations,
) -> (Result<Verdict, String>, Result<Vec<Candidate>, String>) {
    let settings = explain::Settings {
        seed: how.seed,
        decision: how.decide_at,
        ..explain::Settings::default()
    };
    let priors = Priors::default();
    let measurements: Vec<Measurement> = (tests.iter())
        .map(|test| foretold(&test.measurement, moment, set))
        .collect();
    let curve = &explain::ContinuedMoment::from(&moment.curve);
    let verdict = explain::explain(&measurements, curve, set, &priors, &settings)
        .map_err(|why| why.to_string());
    let next = match &verdict {
        Ok(verdict) if matches!(verdict.conclusion, explain::Conclusion::Supported(_)) => {
            Err("the tests at hand decide".to_string())
        }
        Ok(verdict) => explain::next_test(verdict, &measurements, curve, set, &priors, &settings)
            .map(|mut candidates| {
                let all_see_the_cage = measurements.iter().all(|test| test.cage.is_some());
                candidates.retain(|candidate| {
                    !(all_see_the_cage && candidate.proposal == explain::Proposal::CageSensor)
                });
                candidates
            })
            .map_err(|why| why.to_string()),
        Err(why) => Err(why.clone()),
    };
    (verdict, next)
}

/// A test whose torque is as uncertain as what is foretold of it: an explanation takes speed and acceleration as they are, so what
/// is not known of them counts as an error of the torque.
///
/// Where a clutch locks the inertia's part of the torque jumps, which no smoothed torque follows: there it is not known.
fn foretold(test: &Measurement, moment: &Moment, set: &RollingSet<f64>) -> Measurement {
    let mut test = test.clone();
    let peak = (test.acceleration.iter().enumerate())
        .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
        .map_or((0, 0.0), |(at, acceleration)| (at, acceleration.abs()));
    let locked = test.time.get(peak.0).copied().unwrap_or(f64::NAN);
    let jump = set.outer_inertia() * peak.1;
    // below the slowest speed that was measured the moment falls to nothing
    let slowest = moment.curve.range().0;
    let near_rest = moment.curve.at(slowest).map_or(0.0, |m| m.value / slowest);
    for (k, deviation) in test.torque_deviation.iter_mut().enumerate() {
        let slope = moment.curve.slope(test.speed[k]).unwrap_or(near_rest);
        let by_speed = slope * test.speed_deviation[k];
        let by_inertia = set.outer_inertia() * test.acceleration_deviation[k];
        *deviation = deviation.hypot(by_speed).hypot(by_inertia);
        if (test.time[k] - locked).abs() < SMEARED {
            *deviation = deviation.hypot(jump);
        }
    }
    if let Some(cage) = &mut test.cage {
        for (speed, deviation) in cage.speed.iter().zip(&mut cage.deviation) {
            *deviation = deviation.hypot(ROLLING_RATIO * speed);
        }
    }
    test
}

/// The friction of a rotor that brings a race up.
fn rubbed(
    wish: &RotorFriction,
    test: &Test,
    moment: &Result<Moment, String>,
    set: &RollingSet<f64>,
    set_deviation: SetDeviation,
    warnings: &mut Vec<Warning>,
) -> Result<rotor_friction::RotorFriction, String> {
    let moment = moment
        .as_ref()
        .map_err(|_| "the steady moment is not known".to_string())?;
    let found = signals::find(&test.asked);
    let why = found.why("speed", true);
    warnings.extend(found.warnings.iter().map(|warning| Warning {
        text: format!("{}: {}", test.name, warning.text),
        ..warning.clone()
    }));
    let shaft = found.shaft.as_ref().ok_or(why)?;
    let (from, to) = shaft.speed.range();
    let motions: Vec<_> = (0..ROTOR_TIMES)
        .map(|k| from + (to - from) * k as f64 / (ROTOR_TIMES - 1) as f64)
        .map(|time| shaft.speed.at(time))
        .collect();
    let held = |value: f64, deviation: f64| vec![Uncertain::new(value, deviation); motions.len()];
    let run = RubbingSpinUp {
        name: test.name.clone(),
        time: motions.iter().map(|m| m.time).collect(),
        race_speed: (motions.iter())
            .map(|m| Uncertain::new(m.speed, m.speed_uncertainty()))
            .collect(),
        race_acceleration: (motions.iter())
            .map(|m| Uncertain::new(m.acceleration, m.acceleration_uncertainty()))
            .collect(),
        rotor_speed: held(wish.rotor_speed, 0.0),
        load: held(wish.radial_load, wish.load_deviation * wish.radial_load),
        correlation_time: to - from,
    };
    rotor_friction::rotor_friction(
        &run,
        &Race {
            inertia: Uncertain::new(wish.inertia, MASS_DEVIATION * wish.inertia),
            bore_radius: Uncertain::exact(0.5 * wish.bore_diameter),
            set: *set,
            set_deviation,
            steady_moment: &|speed, _| moment.curve.at(speed),
            friction: &|_, _| Some(Uncertain::exact(0.0)),
            least_load: CONTACT * wish.radial_load,
            least_slip: SLIDING,
        },
    )
}
