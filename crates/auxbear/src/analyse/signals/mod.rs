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
mod history;
mod read;
pub(crate) mod shaft;
mod spectrum;
mod steady;
mod temperature;
pub(crate) mod torque;
mod unit;
mod vibration;

use crate::options::Options;
use crate::problem::Problem;
use crate::result::assumptions::assumptions;
use crate::result::outcome::{Outcome, Picture, Stop, Warning, Work};
use crate::scenario::{CageKind, PickupKind, Scenario, SensorSource, Signals};
use read::{Listed, Series, Source, Stamps};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Channels that were read, and what is asked of them.
pub(crate) struct Asked {
    signals: Signals,
    listed: Vec<Listed>,
    notes: Vec<String>,
    speed: Option<Signal>,
    torque: Option<Series>,
    tap: Option<Series>,
    cage: Option<Signal>,
    temperature: Option<Series>,
    vibration: Option<Series>,
}

/// What a channel holds.
enum Signal {
    Sampled(Series),
    Stamped(Stamps),
}

impl Asked {
    /// Reads what is asked for; refuses what is not there or not what it should be.
    pub fn of(signals: &Signals) -> Result<Asked, Box<Problem>> {
        let mut source = Source::open(&signals.file, "signals.file", signals)?;
        let listed = source.listed();
        let speed = match &signals.speed {
            Some(speed) => {
                let key = "signals.speed.channel";
                Some(match speed.kind {
                    PickupKind::Analog { .. } => {
                        Signal::Sampled(source.passings(key, &speed.channel)?)
                    }
                    PickupKind::Edges { .. } => {
                        Signal::Stamped(source.stamps(key, &speed.channel)?)
                    }
                })
            }
            None => None,
        };
        let mut torque = None;
        let mut tap = None;
        let mut notes = Vec::new();
        let mut tap_source = None;
        if let Some(asked) = &signals.torque {
            let key = "signals.torque.channel";
            let series = in_newton_metres(&mut source, key, &asked.channel, asked.scale, false)?;
            source.reaches(
                "signals.torque.highest_frequency",
                asked.highest_frequency,
                &series,
                spectrum::resolved(series.values.len(), series.interval),
            )?;
            torque = Some(series);
            if let Some(SensorSource::Tap {
                tap_file,
                tap_channel,
                ..
            }) = &asked.sensor
            {
                let mut other = Source::open(tap_file, "signals.torque.tap_file", signals)?;
                let key = other.key();
                let series = other.series(key, tap_channel, true)?;
                notes = other.notes();
                tap_source = Some(other);
                tap = Some(series);
            }
        }
        let cage = match &signals.cage {
            Some(cage) => {
                let key = "signals.cage.channel";
                Some(match cage.kind {
                    CageKind::Edges => Signal::Stamped(source.stamps(key, &cage.channel)?),
                    _ => Signal::Sampled(source.passings(key, &cage.channel)?),
                })
            }
            None => None,
        };
        let temperature = match &signals.temperature {
            Some(name) => {
                let key = "signals.temperature.channel";
                let mut series = source.series(key, name, false)?;
                let unit = source.temperature_unit(key, &series)?;
                for value in &mut series.values {
                    *value = unit.to_si(*value);
                }
                Some(series)
            }
            None => None,
        };
        let vibration = match &signals.vibration {
            Some(asked) => {
                let series = source.series("signals.vibration.channel", &asked.channel, false)?;
                source.reaches(
                    "signals.vibration.highest_frequency",
                    asked.highest_frequency,
                    &series,
                    vibration::resolved(series.values.len(), series.interval),
                )?;
                Some(series)
            }
            None => None,
        };
        if let Some(converter) = &signals.converter {
            source.has("signals.converter.channels", &converter.channels)?;
        }
        source.interval_holds(tap_source.as_ref())?;
        let mut all = source.notes();
        all.append(&mut notes);
        Ok(Asked {
            signals: signals.clone(),
            listed,
            notes: all,
            speed,
            torque,
            tap,
            cage,
            temperature,
            vibration,
        })
    }

    /// Where a part comes from: channel and file, as in "channel \"torque\" of run.tdms".
    fn place(&self, part: &str) -> String {
        let asked = &self.signals;
        let channel = match part {
            "speed" => asked.speed.as_ref().map(|one| &one.channel),
            "torque" => asked.torque.as_ref().map(|one| &one.channel),
            "cage" => asked.cage.as_ref().map(|one| &one.channel),
            "vibration" => asked.vibration.as_ref().map(|one| &one.channel),
            _ => None,
        };
        let file = read::short(&asked.file);
        match channel {
            Some(channel) => format!("channel \"{channel}\" of {file}"),
            None => file,
        }
    }
}

/// The middle of the values that are numbers; not-a-number where there is none.
fn median(values: &[f64]) -> f64 {
    let mut known: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    known.sort_by(f64::total_cmp);
    known.get(known.len() / 2).copied().unwrap_or(f64::NAN)
}

/// A text that begins a sentence.
fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|letter| letter.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}

fn in_newton_metres(
    source: &mut Source,
    key: &'static str,
    name: &str,
    scale: Option<f64>,
    whole: bool,
) -> Result<Series, Box<Problem>> {
    let mut series = source.series(key, name, whole)?;
    let factor = source.torque_factor(key, &series.unit, name, scale)?;
    for value in &mut series.values {
        *value *= factor;
    }
    if let Some(converter) = &mut series.converter {
        converter.lowest *= factor;
        converter.highest *= factor;
    }
    Ok(series)
}

/// What was found, and what to know of it.
#[derive(Default)]
pub(crate) struct Found {
    pub shaft: Option<shaft::Found>,
    pub torque: Option<torque::Found>,
    pub cage: Option<cage::Found>,
    /// Temperature of the outer race, K, about every 50 ms.
    pub temperature: Option<temperature::Found>,
    vibration: Option<vibration::Found>,
    steady: Option<steady::Found>,
    /// Channels held against their converter.
    converted: Vec<converter::Converted>,
    /// What an estimator refused: a name of the channel's part, and why.
    refused: Vec<(&'static str, String)>,
    pub warnings: Vec<Warning>,
}

impl Found {
    fn warn(&mut self, code: &'static str, part: &str, notes: &[String]) {
        for note in notes {
            let text = format!("{part}: {}.", note.trim_end_matches('.'));
            self.warnings.push(Warning { code, text });
        }
    }

    /// Why a part has no numbers.
    pub fn why(&self, part: &'static str, asked: bool) -> String {
        let refused = self.refused.iter().find(|(name, _)| *name == part);
        match refused {
            Some((_, why)) => why.clone(),
            None if asked => "what it needs was not found".to_string(),
            None => format!("signals.{part}.channel is not given"),
        }
    }
}

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

/// The channels that were read as samples.
fn sampled<'a>(asked: &'a Asked) -> impl Iterator<Item = &'a Series> {
    let of = |signal: &'a Option<Signal>| match signal {
        Some(Signal::Sampled(series)) => Some(series),
        _ => None,
    };
    let all = [
        of(&asked.speed),
        asked.torque.as_ref(),
        of(&asked.cage),
        asked.vibration.as_ref(),
    ];
    all.into_iter().flatten()
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
    let steady = match &found.shaft {
        Some(shaft) => going()
            .and_then(|()| steady::Found::of(wish, shaft, reading, asked.signals.torque.as_ref())),
        None => Err("it needs the speed of the shaft".to_string()),
    };
    match steady {
        Ok(steady) => {
            found.warn("AB1043", "Steady curve", &steady.notes);
            found.steady = Some(steady);
        }
        Err(why) => found.refused.push(("steady", why)),
    }
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
        picture: Picture {
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
        },
        files: Vec::new(),
    }
}
