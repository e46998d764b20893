//! What the estimators find in the tests, each with its own reason where it refuses.

use crate::identify::coast_down::{coasted, largest};
use crate::identify::consequence::{false_reading, other_cause, rolls, slip_is_open, slips};
use crate::identify::notes::{IdentifyWarning, grouped, noted};
use crate::identify::read::{Request, Test};
use crate::interruptible::{INTERRUPTED, interruptible};
use crate::signals;
use identify::coasting::Windage;
use identify::data_checks::{CheckSettings, Doubt, doubts, reading};
use identify::dissipation::{Dissipation, dissipation};
use identify::explain::{
    self, Candidate, Conclusion, PredictionErrors, Verdict, with_prediction_errors,
};
use identify::loss::{Loss, LossMap, LossSettings, Rolling, loss};
use identify::moment::{Moment, moment, same_load};
use identify::rotor_friction::{self, Race, RubbingSpinUp};
use identify::signals::{Signals, before_the_stop, measurement};
use identify::skid::{Skid, skid};
use identify::slip::{CageSlip, cage_slip};
use identify::{Measurement, SetDeviation};
use outcome::Warning;
use outcome::options::Options;
use physics::rolling::RollingSet;
use problem::{note, note::Note};
use scenario::RotorFriction;
use statistics::uncertain::Uncertain;
use std::sync::atomic::{AtomicBool, Ordering};

/// Part of the largest speed at which tests are compared where nothing is asked for.
const ANALYSED: f64 = 0.95;

/// One test with what its signals hold and what they tell.
pub(crate) struct TestEstimate {
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
    /// Whether the balls roll throughout, as the user states or the verdict says.
    pub rolls: bool,
    /// What the verdict names as the cause of t_O - M, where that is not the balls.
    pub other_cause: Option<String>,
    /// Why the reading is not the torque, where the verdict says so: no energy is read from it then.
    pub false_reading: Option<String>,
}

impl TestEstimate {
    /// What shows that the torque does not come to the steady moment: the lubricant or the sensor was in another state than in the
    /// slow tests, and what is left of t_O - M is not F alone. None where it comes there, or where that is not known.
    pub fn off_the_moment(&self) -> Option<String> {
        let loss = self.loss.as_ref().ok()?;
        loss.off_the_moment(&self.measurement).map(|excess| {
            format!(
                "at the end of the hold of {} t_O - M is {:.2} ± {:.2} N mm: M of the slow tests does not hold there",
                self.name,
                1e3 * excess.value,
                1e3 * excess.deviation
            )
        })
    }

    /// Why neither F nor the spin of the balls is read from t_O - M; none where nothing speaks against it.
    pub fn withheld(&self) -> Option<String> {
        (self.off_the_moment()).or_else(|| self.other_cause.clone())
    }

    /// The energies of its spin-up; where the reading is not the torque, why there are none.
    pub fn energy(&self) -> Result<&Dissipation, String> {
        match &self.false_reading {
            Some(why) => Err(why.clone()),
            None => self.dissipation.as_ref().map_err(Clone::clone),
        }
    }

    /// The best that is known of the energy of its spin-up, J: by the cage signal; else of balls that roll, where that is stated or the
    /// verdict; else with the path term as an uncertainty.
    pub fn best_energy(&self) -> Result<Uncertain, String> {
        let found = self.energy()?;
        Ok(match (found.exact, self.rolls) {
            (None, true) => found.corrected,
            _ => found.best(),
        })
    }
}

/// Everything that was found.
pub(crate) struct Estimate {
    /// Balls and cage.
    pub set: RollingSet<f64>,
    /// The slow tests.
    pub coast_downs: Vec<Measurement>,
    /// The steady moment.
    pub moment: Result<Moment, String>,
    /// What was taken out of slow tests without torque beside the bearing, where that is known.
    pub windage: Option<Windage>,
    /// Tests with acceleration.
    pub tests: Vec<TestEstimate>,
    /// F over speed and acceleration.
    pub map: Result<LossMap, String>,
    /// Which explanation the data support.
    pub verdict: Result<Verdict, String>,
    /// The next test.
    pub next: Result<Vec<Candidate>, String>,
    /// Sliding friction of a dropped rotor.
    pub rotor: Result<rotor_friction::RotorFriction, String>,
    /// Why none of the tests with acceleration that were given can be used; none where one can, or none was given.
    pub unused: Option<String>,
    /// What to know before trusting the numbers.
    pub warnings: Vec<Warning>,
    /// Whether it was interrupted.
    pub interrupted: bool,
}

impl Estimate {
    /// Runs all estimators.
    pub fn of(asked: &Request, options: &Options) -> Estimate {
        let wish = asked.identify;
        let set = rolling_set(asked);
        let mut of_signals = Vec::new();
        let mut unusable = Vec::new();
        let interrupt = options.interrupt;
        let interrupted = || interrupt.load(Ordering::Relaxed);
        let mut read = |tests: &[&Test]| -> Vec<(Measurement, Uncertain)> {
            let mut list = Vec::new();
            for test in tests {
                if interrupted() {
                    break;
                }
                match measured(test, wish.settling_time, interrupt, &mut of_signals) {
                    Ok(measurement) => list.push(measurement),
                    Err(why) => unusable.push((test.name.clone(), why)),
                }
            }
            list
        };
        let (with_torque, without): (Vec<&Test>, Vec<&Test>) =
            (asked.coast_downs.iter()).partition(|test| test.signals.torque.is_some());
        let mut coast_downs: Vec<Measurement> = (read(&with_torque).into_iter())
            .map(|(test, _)| test)
            .collect();
        let tests = read(&asked.tests.iter().collect::<Vec<_>>());
        let mut windages = Vec::new();
        for test in without {
            if interrupted() {
                break;
            }
            match coasted(test, &set, interrupt, &mut of_signals) {
                Ok((measurement, windage)) => {
                    windages.extend(windage.map(|windage| (windage, measurement.scale_deviation)));
                    coast_downs.push(measurement);
                }
                Err(why) => unusable.push((test.name.clone(), why)),
            }
        }
        let unused = all_unused(&tests, &asked.tests, &unusable);
        let steady: Vec<Measurement> = (coast_downs.iter())
            .map(|test| before_the_stop(test, wish.settling_time))
            .collect();
        let viscosity = wish.viscosity;
        let mut moment = match steady.is_empty() {
            true => Err("none of the slow tests can be used".to_string()),
            false => interruptible(interrupt, move || {
                moment(&steady.iter().collect::<Vec<_>>(), &set, viscosity)
            }),
        };
        // a reading that is not the torque says nothing of the bearing, whatever else follows from it
        let readings: Vec<Doubt> = (coast_downs.iter())
            .chain(tests.iter().map(|(test, _)| test))
            .filter_map(|test| reading(test, &set, wish.viscosity))
            .collect();
        let against = |test: &str| {
            let of = readings
                .iter()
                .find(|doubt| doubt.test.as_deref() == Some(test));
            of.map(|doubt| doubt.finding.note().to_string())
        };
        if let Some(why) = coast_downs.iter().find_map(|test| against(&test.name)) {
            moment = Err(why);
        }
        // Of several windages each is part of the mean: the largest that any leaves open counts, once.
        let windage = largest(windages);
        if let (Ok(moment), Some((windage, scale))) = (&mut moment, &windage) {
            windage.left_open(moment, *scale);
        }
        let deviation = SetDeviation {
            balls_mass: wish.ball_mass_deviation,
            cage_mass: wish.cage_mass_deviation,
            inner_track_radius: wish.track_radius_deviation,
        };
        let settings = LossSettings {
            rolling: match wish.rolling_stated {
                true => Rolling::Stated,
                false => Rolling::ByCage,
            },
            set_deviation: deviation,
        };
        let curve = moment.as_ref().map(|moment| &moment.curve);
        let no_moment = || "the steady moment is not known".to_string();
        let mut tests: Vec<TestEstimate> = (tests.into_iter())
            .map(|(test, peak_acceleration)| {
                let (own, moment) = (test.clone(), curve.ok().cloned());
                let parts = interruptible(interrupt, move || {
                    let curve = || moment.as_ref().ok_or_else(no_moment);
                    Ok((
                        curve().and_then(|curve| loss(&own, curve, &set, &settings)),
                        dissipation(&own, &set, &deviation, None),
                        cage_slip(&own, &set),
                        curve().and_then(|curve| skid(&own, curve, &set, None)),
                    ))
                });
                let (loss, dissipation, slip, skid) = parts.unwrap_or_else(|why| {
                    (
                        Err(why.clone()),
                        Err(why.clone()),
                        Err(why.clone()),
                        Err(why),
                    )
                });
                TestEstimate {
                    name: test.name.clone(),
                    peak_acceleration,
                    loss,
                    dissipation,
                    slip,
                    skid,
                    rolls: wish.rolling_stated,
                    other_cause: None,
                    false_reading: against(&test.name),
                    measurement: test,
                }
            })
            .collect();
        let measurements: Vec<&Measurement> = tests.iter().map(|test| &test.measurement).collect();
        let doubts = doubted(asked, &measurements, curve.as_ref().ok().copied(), &set);
        let mut doubts = doubts.unwrap_or_else(|why| {
            unusable.push(("tests".to_string(), why));
            Vec::new()
        });
        doubts = readings.iter().cloned().chain(doubts).collect();
        let (verdict, next) = match (&moment, wish.explanations) {
            (_, None) => {
                let why = || "identify.explanations.compare is false".to_string();
                (Err(why()), Err(why()))
            }
            (_, Some(_)) if interrupted() => {
                let why = || INTERRUPTED.to_string();
                (Err(why()), Err(why()))
            }
            (Err(_), Some(_)) => (Err(no_moment()), Err(no_moment())),
            (Ok(_), Some(_)) if unused.is_some() => {
                let why = || unused.clone().unwrap_or_default();
                (Err(why()), Err(why()))
            }
            (Ok(moment), Some(how)) => match no_comparison(moment, &doubts) {
                Some(finding) => {
                    let why = || format!("M does not hold for these tests: {finding}");
                    (Err(why()), Err(why()))
                }
                None => {
                    let tests: Vec<Measurement> = measurements.iter().copied().cloned().collect();
                    let (moment, settling_time) = (moment.clone(), wish.settling_time);
                    let found = interruptible(interrupt, move || {
                        Ok(explained(&tests, &moment, &set, how, settling_time))
                    });
                    found.unwrap_or_else(|why| (Err(why.clone()), Err(why)))
                }
            },
        };
        let cause = (verdict.as_ref().ok()).and_then(|verdict| other_cause(&verdict.conclusion));
        let conclusion = verdict.as_ref().ok().map(|verdict| &verdict.conclusion);
        let false_reading = conclusion.and_then(false_reading);
        // without a verdict nothing excludes slip, but a statement that they roll
        let slip_is_open = !wish.rolling_stated && conclusion.is_none_or(slip_is_open);
        for test in &mut tests {
            test.other_cause.clone_from(&cause);
            test.rolls |= conclusion.is_some_and(rolls);
            if test.false_reading.is_none() {
                test.false_reading.clone_from(&false_reading);
            }
            if slip_is_open && let Ok(found) = &mut test.dissipation {
                *found = found.clone().with_any_slip(&set);
            }
        }
        if matches!(conclusion, Some(Conclusion::Supported(explanation)) if slips(*explanation)) {
            doubts = doubts.into_iter().map(Doubt::beside_a_slip).collect();
        }
        let map = match &unused {
            Some(why) => Err(why.clone()),
            None => map(&tests, curve.ok(), &set, &settings, interrupt),
        };
        let rotor = match (&wish.rotor_friction, &asked.rotor) {
            (Some(wish), Some(test)) => {
                let bearing = Known {
                    moment: &moment,
                    map: &map,
                    set,
                    deviation,
                };
                rubbed(wish, test, &bearing, interrupt, &mut of_signals)
            }
            _ => Err("identify.rotor_friction.file is not given".to_string()),
        };
        let mut lines: Vec<Warning> = Vec::new();
        for (name, why) in &unusable {
            let why = why.clone().into();
            lines.push(Warning::from(IdentifyWarning::Unused { why }).of_part(name));
        }
        lines.extend(doubts.iter().map(|doubt| {
            let (finding, test) = (doubt.finding.note(), doubt.test.as_deref());
            let warning = match test.is_some() && readings.contains(doubt) {
                true => IdentifyWarning::Reading { finding },
                false => IdentifyWarning::Doubt { finding },
            };
            Warning::from(warning).of_part(test.unwrap_or_default())
        }));
        let unequal = moment.iter().filter_map(|moment| moment.unequal.as_ref());
        let unequal = unequal.map(|unequal| unequal.finding());
        lines.extend(unequal.map(|finding| Warning::from(IdentifyWarning::Doubt { finding })));
        let remark = |note: &Note| Warning::from(IdentifyWarning::Remark { note: note.clone() });
        let notes = (moment.iter().flat_map(|moment| &moment.notes))
            .chain(map.iter().flat_map(|map| &map.notes))
            .chain(rotor.iter().flat_map(|rotor| &rotor.notes));
        lines.extend(notes.map(remark));
        lines.extend(tests.iter().flat_map(|test| {
            let notes = (test.loss.iter().flat_map(|loss| &loss.notes))
                .chain(test.dissipation.iter().flat_map(|found| &found.notes));
            notes.map(|note| remark(note).of_part(&test.name))
        }));
        lines.append(&mut of_signals);
        Estimate {
            set,
            coast_downs,
            moment,
            windage: windage.map(|(windage, _)| windage),
            tests,
            map,
            verdict,
            next,
            rotor,
            unused,
            warnings: grouped(&lines),
            interrupted: interrupted(),
        }
    }
}

/// Why no explanation may be sought with this M.
fn no_comparison(moment: &Moment, doubts: &[Doubt]) -> Option<Note> {
    let unequal = (moment.unequal.iter())
        .filter(|unequal| unequal.forbids_comparison())
        .map(|unequal| unequal.finding());
    let doubted = (doubts.iter())
        .filter(|doubt| doubt.finding.forbids_comparison())
        .map(|doubt| doubt.finding.note());
    unequal.chain(doubted).next()
}

/// Why none of the tests that were asked for is there.
fn all_unused<T>(found: &[T], asked: &[Test], unusable: &[(String, String)]) -> Option<String> {
    let of = |test: &Test| unusable.iter().find(|(name, _)| *name == test.name);
    let why: Vec<String> = (asked.iter().filter_map(of))
        .map(|(name, why)| format!("{name}: {why}"))
        .collect();
    (found.is_empty() && !why.is_empty()).then(|| {
        format!(
            "none of the tests with acceleration can be used: {}",
            why.join("; ")
        )
    })
}

/// Masses and radii of balls and cage.
pub(super) fn rolling_set(asked: &Request) -> RollingSet<f64> {
    let bearing = asked.identify;
    let ball = (bearing.ball_mass)
        .unwrap_or_else(|| bearing.ball_material.ball_mass(bearing.ball_diameter));
    let track = 0.5 * (bearing.pitch_diameter - bearing.ball_diameter);
    RollingSet {
        inner_track_radius: track,
        ball_ratio: 0.5 * bearing.ball_diameter / track,
        balls_mass: bearing.ball_count as f64 * ball,
        cage_mass: bearing.cage_mass,
    }
}

/// The signals of a test as the estimators of the bearing take them, and the largest acceleration of its shaft.
fn measured(
    test: &Test,
    settling_time: f64,
    interrupt: &AtomicBool,
    lines: &mut Vec<Warning>,
) -> Result<(Measurement, Uncertain), String> {
    let found = signals::find(&test.asked, interrupt);
    lines.extend(noted(test, &found));
    let lacks = |part: &'static str| format!("no {part}: {}", found.why(part));
    let shaft = found.shaft.as_ref().ok_or_else(|| lacks("speed"))?;
    let torque = found.torque.as_ref().ok_or_else(|| lacks("torque"))?;
    if let Some(why) = &torque.hidden {
        return Err(format!(
            "{why}; a wider range, or signals.from and signals.to without that part, is needed"
        ));
    }
    let torque = torque.torque.as_ref().ok_or(
        "the sensor's frequency and damping are needed to take its swing out of the reading",
    )?;
    let mut measurement = measurement(&Signals {
        name: &test.name,
        load: test.load.unwrap_or(0.0),
        speed: &shaft.speed,
        fastest: shaft.fastest.speed.abs(),
        silence: shaft.silence(),
        torque,
        scale_deviation: (test.signals.torque.as_ref()).map_or(0.0, |asked| asked.scale_deviation),
        cage: found.cage.as_ref().map(|found| &found.cage),
        settling_time,
        rest_before: test.signals.rest_before,
    });
    measurement.temperature =
        (found.temperature.as_ref()).map(|found| found.rise(&measurement.time));
    let peak = &shaft.peak;
    Ok((
        measurement,
        Uncertain::new(peak.acceleration, peak.acceleration_uncertainty()),
    ))
}

fn map(
    tests: &[TestEstimate],
    curve: Option<&identify::SteadyMoment>,
    set: &RollingSet<f64>,
    settings: &LossSettings,
    interrupt: &AtomicBool,
) -> Result<LossMap, String> {
    let curve = curve.ok_or_else(|| "the steady moment is not known".to_string())?;
    // one map of speed and acceleration cannot hold what changes with time besides
    if let Some(why) = tests.iter().find_map(TestEstimate::withheld) {
        return Err(format!("{why}, so that what is left is not F alone"));
    }
    let pairs: Vec<(Measurement, Loss)> = (tests.iter())
        .filter_map(|test| Some((test.measurement.clone(), test.loss.clone().ok()?)))
        .collect();
    if pairs.is_empty() {
        return Err("no test with acceleration can be used".to_string());
    }
    let (curve, set, settings) = (curve.clone(), *set, *settings);
    interruptible(interrupt, move || {
        let pairs: Vec<(&Measurement, &Loss)> =
            pairs.iter().map(|(test, loss)| (test, loss)).collect();
        LossMap::fitted(&pairs, &curve, &set, &settings)
    })
}

fn doubted(
    asked: &Request,
    tests: &[&Measurement],
    curve: Option<&identify::SteadyMoment>,
    set: &RollingSet<f64>,
) -> Result<Vec<Doubt>, String> {
    let wish = asked.identify;
    let slowest = (tests.iter().map(|test| test.fastest())).fold(f64::INFINITY, f64::min);
    let wanted = wish.analysed_speed.unwrap_or(ANALYSED * slowest);
    let change = wish.moment_per_kelvin;
    let open = wish.moment_per_kelvin_deviation * change.abs();
    doubts(
        tests,
        curve,
        set,
        &CheckSettings {
            wanted_speed: wanted.is_finite().then_some(wanted),
            ball_count: Some(wish.ball_count as u32),
            moment_per_kelvin: Some(Uncertain::new(change, open)),
        },
    )
}

fn explained(
    tests: &[Measurement],
    moment: &Moment,
    set: &RollingSet<f64>,
    how: scenario::Explanations,
    settling_time: f64,
) -> (Result<Verdict, String>, Result<Vec<Candidate>, String>) {
    let settings = explain::Settings {
        seed: how.seed,
        decision: how.decide_at,
        settling_time,
        ..explain::Settings::default()
    };
    let errors = PredictionErrors {
        locking_window: how.locking_window,
        rolling_ratio_deviation: how.rolling_ratio_deviation,
    };
    let curve = &moment.curve;
    let measurements: Vec<Measurement> = (tests.iter())
        .map(|test| with_prediction_errors(test, curve, set, &errors))
        .collect();
    let verdict =
        explain::explain(&measurements, curve, set, &settings).map_err(|why| why.to_string());
    let next = match &verdict {
        Ok(verdict) if matches!(verdict.conclusion, explain::Conclusion::Supported(_)) => {
            Err("the tests at hand decide".to_string())
        }
        Ok(verdict) if verdict.conclusion == explain::Conclusion::NoneOfThese => Err(
            "none of the explanations fits: what would decide between them is not what is asked"
                .to_string(),
        ),
        Ok(verdict) => explain::next_test(verdict, &measurements, curve, set, &settings)
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

/// What the other tests tell of the bearing in which a rotor rubs.
struct Known<'a> {
    moment: &'a Result<Moment, String>,
    map: &'a Result<LossMap, String>,
    set: RollingSet<f64>,
    deviation: SetDeviation,
}

/// The friction of a rotor that brings a race up.
fn rubbed(
    wish: &RotorFriction,
    test: &Test,
    bearing: &Known,
    interrupt: &AtomicBool,
    lines: &mut Vec<Warning>,
) -> Result<rotor_friction::RotorFriction, String> {
    let moment = (bearing.moment.as_ref()).map_err(|_| "the steady moment is not known")?;
    let found = signals::find(&test.asked, interrupt);
    lines.extend(noted(test, &found));
    let shaft = (found.shaft.as_ref()).ok_or_else(|| found.why("speed"))?;
    let run = RubbingSpinUp::measured(
        &test.name,
        &shaft.speed,
        (
            wish.from.unwrap_or(f64::NEG_INFINITY),
            wish.to.unwrap_or(f64::INFINITY),
        ),
        Uncertain::exact(wish.rotor_speed),
        Uncertain::new(wish.radial_load, wish.load_deviation * wish.radial_load),
    )?;
    let friction = |speed: f64, rate: f64| {
        let place = bearing.map.as_ref().ok()?.at(speed, rate);
        place.known.then_some(place.friction)
    };
    let mut found = rotor_friction::rotor_friction(
        &run,
        &Race {
            inertia: Uncertain::new(wish.inertia, wish.inertia_deviation * wish.inertia),
            bore_radius: Uncertain::exact(0.5 * wish.bore_diameter),
            air_clearance: Uncertain::exact(wish.radial_air_clearance.unwrap_or(0.0)),
            set: bearing.set,
            set_deviation: bearing.deviation,
            steady_moment: &|speed, _| moment.curve.at(speed),
            friction: &friction,
            // the force is constant: all of it is contact
            least_load: 0.5 * wish.radial_load,
            least_slip: wish.least_slip,
        },
    )?;
    if wish.radial_air_clearance.is_none() {
        found.notes.push(note!(
            "the air clearance of the rotor is not given (identify.rotor_friction.radial_air_clearance): it counts as wide as the bore, and every slip is too large by {:.3} m/s a tenth of a millimetre of clearance",
            1e-4 * wish.rotor_speed
        ));
    }
    if !same_load(wish.radial_load, moment.curve.load) {
        found.notes.push(note!(
            "the rotor presses with {:.0} N, the steady moment was measured under {:.0} N: the part of it that depends on the load is that of the slow tests",
            wish.radial_load, moment.curve.load
        ));
    }
    Ok(found)
}
