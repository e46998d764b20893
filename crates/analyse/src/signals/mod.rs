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
pub(crate) mod cage;
mod converter;
mod design;
pub(crate) mod estimate;
mod history;
mod mains;
mod read;
pub(crate) mod request;
pub(crate) mod shaft;
mod spectrum;
pub(crate) mod steady;
mod temperature;
pub(crate) mod torque;
mod vibration;
pub mod warning_table;

use crate::interruptible::{INTERRUPTED, interruptible};
use crate::signals::estimate::Estimate;
pub use crate::signals::request::Request;
use crate::signals::request::{capital, sampled};
use crate::signals::warning_table::SignalsWarning;
use identify::coasting::Windage;
use outcome::options::Options;
use outcome::{Column, Outcome, Picture, Quantity, Stop, Warning};
use scenario::{Scenario, SensorSource, SteadySignal};
use simulate::assumptions::assumptions;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Keys that say something of a sensor only where it is given, not where a tap tells it.
const OF_GIVEN_SENSOR: &[&str] = &[
    "signals.torque.frequency_deviation",
    "signals.torque.damping_deviation",
];

/// What is assumed of the sensor, where it counts.
fn assumed(scenario: &Scenario, asked: &Request, found: &Estimate) -> Option<Warning> {
    found.torque.as_ref()?;
    let sensor = asked.signals.torque.as_ref()?.sensor.as_ref()?;
    let given = matches!(sensor, SensorSource::Given { .. });
    let values = scenario.resolved.values.iter();
    let values = values.filter(|value| value.provenance.mark() == "assumed");
    let paths: Vec<&str> = values.map(|value| value.path).collect();
    let counts = |path: &&str| given || !OF_GIVEN_SENSOR.contains(path);
    assumptions(&paths.into_iter().filter(counts).collect::<Vec<_>>())
}

/// Why a part has no numbers where the shaft has none.
fn no_shaft<T>() -> Result<T, String> {
    Err("it needs the speed of the shaft".to_string())
}

/// Why a part has no numbers that was not asked for.
fn not_asked<T>() -> Result<T, String> {
    Err("it is not asked for".to_string())
}

/// A vibration and slow runs, which need the shaft.
fn more(asked: &Arc<Request>, interrupt: &AtomicBool, found: &mut Estimate) {
    if asked.vibration.is_some() && asked.signals.vibration.is_some() {
        let (own, shaft) = (Arc::clone(asked), found.shaft.clone());
        let vibration = move || match (&own.vibration, &own.signals.vibration, &shaft) {
            (Some(series), Some(wish), Some(shaft)) => vibration::Estimate::of(series, wish, shaft),
            _ => no_shaft(),
        };
        if let Some(vibration) = found.answer("vibration", interruptible(interrupt, vibration)) {
            found.note("Vibration", &vibration.notes);
            found.vibration = Some(vibration);
        }
    }
    if asked.signals.steady.is_none() {
        return;
    }
    let (own, shaft, torque) = (Arc::clone(asked), found.shaft.clone(), found.torque.clone());
    let steady = move || {
        let faulty = own.torque.as_ref().map(torque::faulty);
        let reading = own.torque.as_ref().zip(faulty.as_ref());
        let reading = reading.map(|(series, faulty)| (series, faulty, torque.as_deref()));
        match (&own.signals.steady, &shaft) {
            (Some(wish), Some(shaft)) => {
                let windage = windage(wish, &own, &AtomicBool::new(false));
                steady::Estimate::of(wish, shaft, reading, own.signals.torque.as_ref(), windage)
            }
            _ => no_shaft(),
        }
    };
    if let Some(steady) = found.answer("steady", interruptible(interrupt, steady)) {
        found.warn("Steady curve", &steady.doubt, |about, note| {
            SignalsWarning::SteadyCurve { about, note }
        });
        found.note("Steady curve", &steady.notes);
        found.steady = Some(steady);
    }
}

/// What brakes the shaft without the bearing, by its law or by the run without it.
pub(crate) fn windage(
    wish: &SteadySignal,
    asked: &Request,
    interrupt: &AtomicBool,
) -> Result<Windage, String> {
    steady::windage(wish, || {
        let run = (asked.windage.as_ref())
            .ok_or_else(|| "there is no run without bearing".to_string())?;
        let found = find(run, interrupt);
        let of = |part| found.why(part);
        let steady = found.steady.as_ref();
        match (steady, &found.shaft) {
            (Some(steady), _) => steady.inertial.clone(),
            (None, Some(_)) => Err(of("steady")),
            (None, None) => Err(of("speed")),
        }
        .map_err(|why| format!("in the run without bearing: {why}"))
    })
}

/// Computes what is asked for, part by part until an interrupt.
pub(crate) fn find(asked: &Arc<Request>, interrupt: &AtomicBool) -> Estimate {
    let mut found = Estimate::default();
    found.warn("The file", &asked.notes, |about, note| {
        SignalsWarning::File { about, note }
    });
    for series in sampled(asked) {
        let Some(converted) = converter::Converted::of(series) else {
            continue;
        };
        // What is clipped of the torque is told with what is done about it.
        let own = asked.torque.as_ref().is_some_and(|t| t.name == series.name);
        let told = converted.at_limit.iter().filter(|_| !own);
        found.warn(
            &format!("Channel {}", converted.name),
            told.chain(&converted.coarse),
            |about, note| SignalsWarning::Channel { about, note },
        );
        found.converted.push(converted);
    }
    let watched = asked
        .torque
        .as_ref()
        .map(|series| (series.first, series.last()));
    if asked.speed.is_some() && asked.signals.speed.is_some() {
        let own = Arc::clone(asked);
        let shaft = move || match (&own.speed, &own.signals.speed) {
            (Some(signal), Some(wish)) => shaft::Estimate::of(signal, wish, watched),
            _ => not_asked(),
        };
        if let Some(shaft) = found.answer("speed", interruptible(interrupt, shaft)) {
            let marks = "Marks per revolution";
            found.warn(marks, &shaft.doubt, |about, note| {
                SignalsWarning::MarksPerRevolution { about, note }
            });
            let wish = asked.signals.speed.as_ref();
            let odd = wish.and_then(|wish| shaft.beside_set(wish));
            found.warn("Largest speed", &odd, |about, note| {
                SignalsWarning::LargestSpeed { about, note }
            });
            if let shaft::MotionSource::Channel(channel) = &shaft.seen {
                found.warn("Speed", &channel.doubt, |about, note| {
                    SignalsWarning::SpeedChannel { about, note }
                });
            }
            found.note("Speed", &shaft.notes);
            found.shaft = Some(Arc::new(shaft));
        }
    }
    if let (Some(series), Some(_)) = (&asked.torque, &asked.signals.torque) {
        let faults = torque::faulty(series);
        found.warn(
            &format!("Channel {}", series.name),
            &faults.told,
            |about, note| SignalsWarning::Channel { about, note },
        );
        let (own, shaft) = (Arc::clone(asked), found.shaft.clone());
        let torque = move || match (&own.torque, &own.signals.torque) {
            (Some(series), Some(wish)) => {
                torque::Estimate::of(series, &faults, wish, own.tap.as_ref(), shaft.as_deref())
            }
            _ => not_asked(),
        };
        if let Some(torque) = found.answer("torque", interruptible(interrupt, torque)) {
            found.warnings.extend(torque.doubts.iter().cloned());
            found.note(torque::TORQUE, &torque.notes);
            found.torque = Some(Arc::new(torque));
        }
    }
    if let (Some(_), Some(wish)) = (&asked.cage, &asked.signals.cage) {
        let (own, shaft) = (Arc::clone(asked), found.shaft.clone());
        let cage = move || match (&own.cage, &own.signals.cage, &shaft) {
            (Some(signal), Some(wish), Some(shaft)) => cage::Estimate::of(signal, wish, shaft),
            _ => no_shaft(),
        };
        if let Some(cage) = found.answer("cage", interruptible(interrupt, cage)) {
            found.note("Cage", &cage.notes);
            let marks = asked.signals.speed.as_ref();
            let marks = marks.map_or(0, |speed| speed.marks_per_revolution);
            let shaft = found.shaft.as_deref();
            let doubt = shaft.and_then(|shaft| cage.doubt(wish, marks, shaft));
            let place = capital(&asked.place("cage"));
            found.warn(&place, &doubt, |about, note| SignalsWarning::Cage {
                about,
                note,
            });
            found.cage = Some(cage);
        }
    }
    found.temperature = asked.temperature.as_ref().map(temperature::Estimate::of);
    more(asked, interrupt, &mut found);
    let refused: Vec<Warning> = found
        .refused
        .iter()
        .map(|(part, why)| {
            let what = match *part {
                "steady" => "steady curve",
                other => other,
            };
            let (what, place) = (what.to_string(), asked.place(part));
            let why = why.clone().into();
            SignalsWarning::Refused { what, place, why }.into()
        })
        .collect();
    found.warnings.splice(0..0, refused);
    found
}

/// The columns of its history, without values.
pub fn columns(asked: &Request) -> Vec<Column> {
    history::columns(asked, None)
}

/// The results of such a measurement, without values.
pub fn results(asked: &Request) -> Vec<Quantity> {
    answer::name(asked, None)
}

/// Computes what is asked for and names it.
pub fn run(scenario: &Scenario, asked: &Arc<Request>, options: &Options) -> Outcome {
    let mut found = find(asked, options.interrupt);
    found.warnings.extend(assumed(scenario, asked, &found));
    let history = history::columns(asked, Some(&found));
    let end = history.first().and_then(|time| time.values.last().copied());
    let end = end.unwrap_or(0.0);
    let cage = asked.signals.cage.as_ref();
    let (ratio, balls) = cage.map_or((f64::NAN, 0), |cage| (cage.rolling_ratio, cage.ball_count));
    Outcome {
        system: "signals",
        title: scenario
            .title
            .clone()
            .unwrap_or_else(|| "Measured signals".to_string()),
        quantities: answer::name(asked, Some(&found)),
        history,
        stop: match found.refused.as_slice() {
            refused if refused.iter().any(|(_, why)| why == INTERRUPTED) => Stop::new(
                "interrupted",
                end,
                "Interrupted; what was found until then is kept.",
            ),
            [] => Stop::new("finished", end, "Everything asked for was computed."),
            [(part, why), ..] => Stop::new(
                "not answered",
                end,
                format!("the record does not carry the {part} asked for: {why}"),
            ),
        },
        warnings: found.warnings,
        pictures: vec![Picture::without_rotor(ratio, balls)],
        ..Outcome::default()
    }
}
