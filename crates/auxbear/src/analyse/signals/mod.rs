//! A measurement: from the channels of a file to speed, torque and cage speed with their bands.
//!
//! ```text
//! file ─read─▶ channels ─shaft─▶ speed, acceleration ─torque─▶ torque without the sensor's swing
//!                                                    ├─cage──▶ cage speed, slip
//!                                                    ├─vibration─▶ orders, spectrograms
//!                                                    └─steady─▶ torque over speed
//! ```
//! The estimators are those of the crate `measure`; here they are fed, and what they find is named. An estimator that refuses
//! leaves its quantities empty with the reason, and the run says that it is not complete.

mod answer;
mod answer_analysis;
pub(crate) mod asked;
pub(crate) mod cage;
mod converter;
mod design;
pub(crate) mod found;
mod history;
mod read;
pub(crate) mod shaft;
mod spectrum;
pub(crate) mod steady;
mod temperature;
pub(crate) mod torque;
mod unit;
mod vibration;

pub(crate) use crate::analyse::signals::asked::Asked;
use crate::analyse::signals::asked::{capital, sampled};
use crate::analyse::signals::found::Found;
use crate::options::Options;
use crate::result::assumptions::assumptions;
use crate::result::outcome::{Outcome, Picture, Stop, Warning, Work};
use crate::scenario::{Scenario, SensorSource, SteadySignal};
use identify::coasting::Windage;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Keys that say something of a sensor only where it is given, not where a tap tells it.
const OF_GIVEN_SENSOR: &[&str] = &[
    "signals.torque.frequency_deviation",
    "signals.torque.damping_deviation",
];

/// What is assumed of the sensor, where it counts.
fn assumed(scenario: &Scenario, asked: &Asked) -> Option<Warning> {
    let sensor = asked.signals.torque.as_ref()?.sensor.as_ref()?;
    let given = matches!(sensor, SensorSource::Given { .. });
    let values = scenario.resolved.values.iter();
    let values = values.filter(|value| value.provenance.mark() == "assumed");
    let paths: Vec<&str> = values.map(|value| value.path).collect();
    let counts = |path: &&str| given || !OF_GIVEN_SENSOR.contains(path);
    assumptions(&paths.into_iter().filter(counts).collect::<Vec<_>>())
}

/// A vibration and slow runs, which need the shaft.
fn more(asked: &Asked, going: &dyn Fn() -> Result<(), String>, found: &mut Found) {
    let no_shaft = || Err("it needs the speed of the shaft".to_string());
    if let (Some(series), Some(wish)) = (&asked.vibration, &asked.signals.vibration) {
        let vibration = match &found.shaft {
            Some(shaft) => going().and_then(|()| vibration::Found::of(series, wish, shaft)),
            None => no_shaft(),
        };
        match vibration {
            Ok(vibration) => {
                found.warn("AB1043", "Vibration", &vibration.notes);
                found.vibration = Some(vibration);
            }
            Err(why) => found.refused.push(("vibration", why)),
        }
    }
    let Some(wish) = &asked.signals.steady else {
        return;
    };
    let faulty = asked.torque.as_ref().map(torque::faulty);
    let reading = asked.torque.as_ref().zip(faulty.as_ref());
    let reading = reading.map(|(series, faulty)| (series, faulty, found.torque.as_ref()));
    let windage = windage(wish, asked);
    let steady = match &found.shaft {
        Some(shaft) => going().and_then(|()| {
            let sensor = asked.signals.torque.as_ref();
            steady::Found::of(wish, shaft, reading, sensor, windage)
        }),
        None => Err("it needs the speed of the shaft".to_string()),
    };
    match steady {
        Ok(steady) => {
            if let Some(doubt) = &steady.doubt {
                found.warn("AB1122", "Steady curve", std::slice::from_ref(doubt));
            }
            found.warn("AB1043", "Steady curve", &steady.notes);
            found.steady = Some(steady);
        }
        Err(why) => found.refused.push(("steady", why)),
    }
}

/// What brakes the shaft without the bearing, by its law or by the run without it.
pub(crate) fn windage(wish: &SteadySignal, asked: &Asked) -> Result<Windage, String> {
    steady::windage(wish, || {
        let run = (asked.windage.as_ref())
            .ok_or_else(|| "there is no run without bearing".to_string())?;
        let found = find(run);
        let of = |part| found.why(part, true);
        let steady = found.steady.as_ref();
        match (steady, &found.shaft) {
            (Some(steady), _) => steady.inertial.clone(),
            (None, Some(_)) => Err(of("steady")),
            (None, None) => Err(of("speed")),
        }
        .map_err(|why| format!("in the run without bearing: {why}"))
    })
}

/// Why a part has no numbers where an interrupt came before it.
const INTERRUPTED: &str = "interrupted";

/// Computes what is asked for.
pub(crate) fn find(asked: &Asked) -> Found {
    find_until(asked, &AtomicBool::new(false))
}

/// Computes what is asked for, part by part until an interrupt.
fn find_until(asked: &Asked, interrupt: &AtomicBool) -> Found {
    let going = || match interrupt.load(Ordering::Relaxed) {
        true => Err(INTERRUPTED.to_string()),
        false => Ok(()),
    };
    let mut found = Found::default();
    found.warn("AB1040", "The file", &asked.notes);
    for series in sampled(asked) {
        let Some(converted) = converter::Converted::of(series) else {
            continue;
        };
        // What is clipped of the torque is told with what is done about it.
        let own = asked.torque.as_ref().is_some_and(|t| t.name == series.name);
        let told = converted
            .told
            .iter()
            .filter(|text| !(own && text.contains("clipped")));
        let told: Vec<String> = told.cloned().collect();
        found.warn("AB1041", &format!("Channel {}", converted.name), &told);
        found.converted.push(converted);
    }
    let watched = asked
        .torque
        .as_ref()
        .map(|series| (series.first, series.last()));
    if let (Some(signal), Some(wish)) = (&asked.speed, &asked.signals.speed) {
        match going().and_then(|()| shaft::Found::of(signal, wish, watched)) {
            Ok(shaft) => {
                if let Some(doubt) = &shaft.doubt {
                    found.warn(
                        "AB1044",
                        "Marks per revolution",
                        std::slice::from_ref(doubt),
                    );
                }
                if let Some(odd) = shaft.beside_set(wish) {
                    found.warn("AB1121", "Largest speed", &[odd]);
                }
                if let shaft::Seen::Channel(channel) = &shaft.seen
                    && let Some(doubt) = &channel.doubt
                {
                    found.warn("AB1120", "Speed", std::slice::from_ref(doubt));
                }
                found.warn("AB1043", "Speed", &shaft.notes);
                found.shaft = Some(shaft);
            }
            Err(why) => found.refused.push(("speed", why)),
        }
    }
    if let (Some(series), Some(wish)) = (&asked.torque, &asked.signals.torque) {
        let faults = torque::faulty(series);
        found.warn("AB1041", &format!("Channel {}", series.name), &faults.told);
        let (tap, shaft) = (asked.tap.as_ref(), found.shaft.as_ref());
        match going().and_then(|()| torque::Found::of(series, &faults, wish, tap, shaft)) {
            Ok(torque) => {
                found.warn("AB1043", "Torque", &torque.notes);
                found.torque = Some(torque);
            }
            Err(why) => found.refused.push(("torque", why)),
        }
    }
    if let (Some(signal), Some(wish)) = (&asked.cage, &asked.signals.cage) {
        let cage = match &found.shaft {
            Some(shaft) => going().and_then(|()| cage::Found::of(signal, wish, shaft)),
            None => Err("it needs the speed of the shaft".to_string()),
        };
        match cage {
            Ok(cage) => {
                found.warn("AB1043", "Cage", &cage.notes);
                let marks = asked.signals.speed.as_ref();
                let marks = marks.map_or(0, |speed| speed.marks_per_revolution);
                let shaft = found.shaft.as_ref();
                if let Some(doubt) = shaft.and_then(|shaft| cage.doubt(wish, marks, shaft)) {
                    found.warn("AB1045", &capital(&asked.place("cage")), &[doubt]);
                }
                found.cage = Some(cage);
            }
            Err(why) => found.refused.push(("cage", why)),
        }
    }
    found.temperature = asked.temperature.as_ref().map(temperature::Found::of);
    more(asked, &going, &mut found);
    let refused: Vec<Warning> = found
        .refused
        .iter()
        .map(|(part, why)| Warning {
            code: "AB1042",
            text: format!(
                "No {} from {}: {}.",
                match *part {
                    "steady" => "steady curve",
                    other => other,
                },
                asked.place(part),
                why.trim_end_matches('.')
            ),
        })
        .collect();
    found.warnings.splice(0..0, refused);
    found
}

/// Computes what is asked for and names it.
pub(crate) fn run(scenario: &Scenario, asked: &Asked, options: &Options) -> Outcome {
    let clock = Instant::now();
    let mut found = find_until(asked, options.interrupt);
    found.warnings.extend(assumed(scenario, asked));
    let history = history::columns(asked, &found);
    let end = history.first().and_then(|time| time.values.last().copied());
    Outcome {
        system: "signals",
        title: scenario
            .title
            .clone()
            .unwrap_or_else(|| "Measured signals".to_string()),
        quantities: answer::quantities(asked, &found),
        history,
        contacts: Vec::new(),
        stop: match found.refused.as_slice() {
            refused if refused.iter().any(|(_, why)| why == INTERRUPTED) => Stop {
                reason: "interrupted",
                time: end.unwrap_or(0.0),
                text: "Interrupted; what was found until then is kept.".to_string(),
            },
            [] => Stop {
                reason: "finished",
                time: end.unwrap_or(0.0),
                text: "Everything asked for was computed.".to_string(),
            },
            [(part, why), ..] => Stop {
                reason: "not answered",
                time: end.unwrap_or(0.0),
                text: format!("the record does not carry the {part} asked for: {why}"),
            },
        },
        warnings: found.warnings,
        work: Work {
            members: 1,
            seconds: clock.elapsed().as_secs_f64(),
            ..Work::default()
        },
        members: Vec::new(),
        drawn: Vec::new(),
        pictures: vec![Picture {
            bearing: String::new(),
            clearance: None,
            pressure_limit: None,
            rolling_cage_ratio: asked
                .signals
                .cage
                .as_ref()
                .map_or(f64::NAN, |cage| cage.rolling_ratio),
            balls: asked
                .signals
                .cage
                .as_ref()
                .map_or(0, |cage| cage.ball_count),
        }],
        files: Vec::new(),
    }
}
