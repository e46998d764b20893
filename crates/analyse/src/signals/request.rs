//! What is asked of a measurement: its channels, read.

use crate::signals::read::{self, Listed, Series, Source, Stamps};
use crate::signals::spectrum;
use problem::note::Note;
use problem::{Code, Result};
use scenario::{
    BuiltIn, CageKind, PickupFlank, PickupKind, Scenario, SensorSource, Signals, System, Windage,
    problem_at,
};
use std::path::Path;
use std::sync::Arc;

/// Channels that were read, and what is asked of them.
pub struct Request {
    pub(crate) signals: Signals,
    pub(crate) listed: Vec<Listed>,
    pub(crate) notes: Vec<Note>,
    pub(crate) speed: Option<Signal>,
    pub(crate) torque: Option<Series>,
    pub(crate) tap: Option<Series>,
    pub(crate) cage: Option<Signal>,
    pub(crate) temperature: Option<Series>,
    pub(crate) vibration: Option<Series>,
    /// A coast-down without the bearing.
    pub windage: Option<Arc<Request>>,
}

/// What a channel holds.
pub(crate) enum Signal {
    Sampled(Series),
    Stamped(Stamps),
}

impl Request {
    /// Reads what is asked for; refuses what is not there or not what it should be.
    pub fn of(signals: &Signals) -> Result<Request> {
        let mut source = Source::open(&signals.file, "signals.file", signals)?;
        let listed = source.listed();
        let speed = match &signals.speed {
            Some(speed) => {
                let key = "signals.speed.channel";
                Some(match speed.kind {
                    PickupKind::Analog { .. } => {
                        Signal::Sampled(source.passings(key, &speed.channel)?)
                    }
                    PickupKind::Edges { flank, .. } => {
                        Signal::Stamped(source.stamps(key, &speed.channel, flank)?)
                    }
                    PickupKind::Speed { scale, .. } => {
                        Signal::Sampled(source.speeds(key, &speed.channel, scale)?)
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
                    CageKind::Edges => {
                        Signal::Stamped(source.stamps(key, &cage.channel, PickupFlank::Rising)?)
                    }
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
                    spectrum::resolved_over_time(series.values.len(), series.interval),
                )?;
                Some(series)
            }
            None => None,
        };
        if let Some(converter) = &signals.converter {
            source.has("signals.converter.channels", &converter.channels)?;
        }
        let windage = match signals
            .steady
            .as_ref()
            .and_then(|steady| steady.windage.as_ref())
        {
            Some(Windage::Run(path)) => Some(Arc::new(without_bearing(path)?)),
            _ => None,
        };
        source.interval_holds(tap_source.as_ref())?;
        let mut all = source.notes();
        all.append(&mut notes);
        all.extend(windage.iter().flat_map(|run| run.notes.iter().cloned()));
        Ok(Request {
            signals: signals.clone(),
            listed,
            notes: all,
            speed,
            torque,
            tap,
            cage,
            temperature,
            vibration,
            windage,
        })
    }

    /// Where a part comes from: channel and file, as in "channel \"torque\" of run.tdms".
    pub(crate) fn place(&self, part: &str) -> String {
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

/// Reads a signals file that another file names under a key.
pub(crate) fn signals_file(key: &'static str, path: &Path) -> Result<(Scenario, Signals)> {
    let refuse = |code, found: String, needed: String| {
        let found = format!("{}, {found}", path.display());
        problem_at(code, key, found, needed)
    };
    let scenario = Scenario::read(path, &[], &BuiltIn).map_err(|problem| match problem.code {
        // a file that is not there is wrong where it is named
        Code::FileMissing | Code::FileIsFolder | Code::FileUnreadable => {
            let needed = "the path of a signals file is needed, relative to this one";
            let found = problem.found.clone();
            refuse(problem.code, found, format!("{needed}{}", made_by(path)))
        }
        _ => problem,
    })?;
    match &scenario.system {
        System::Signals(signals) => {
            let signals = signals.clone();
            Ok((scenario, signals))
        }
        other => Err(refuse(
            Code::UnknownWord,
            format!("which describes system = \"{}\"", other.name().word()),
            "a file of system = \"signals\" is needed, which says what the channels of a measurement are".to_string(),
        )),
    }
}

/// Which command makes a signals file that is not there: a rig's run writes one called signals.toml into its directory.
fn made_by(path: &Path) -> String {
    let folder = path.parent().filter(|_| path.ends_with("signals.toml"));
    match folder.and_then(|folder| Some((folder, folder.file_name()?.to_string_lossy()))) {
        Some((folder, name)) => format!(
            "; where it is of a simulated rig, its run writes it: auxbear run {name}.toml --out {}",
            folder.display()
        ),
        None => String::new(),
    }
}

/// A coast-down of the shaft without the bearing, its channels read.
fn without_bearing(path: &Path) -> Result<Request> {
    let key = "signals.steady.windage_file";
    let (scenario, signals) = signals_file(key, path)?;
    let refuse = |code, found: &str, needed: &str| {
        let found = format!("{}, {found}", path.display());
        problem_at(code, key, found, needed)
    };
    match &signals.steady {
        Some(steady) if steady.windage.is_some() => {
            return Err(refuse(
                Code::Conflict,
                "which takes a windage out itself",
                "the run without bearing shows the windage: leave signals.steady.windage_* out of its file",
            ));
        }
        Some(steady) if steady.inertia.is_some() && signals.speed.is_some() => (),
        _ => {
            return Err(refuse(
                Code::MissingKey,
                "which draws no torque from the slope of the speed",
                "a coast-down with [signals.speed], signals.steady.from, to and inertia is needed",
            ));
        }
    }
    Request::of(&signals).map_err(|problem| scenario.locate(problem))
}

/// The middle of the values that are numbers; not-a-number where there is none.
pub(crate) fn median(values: &[f64]) -> f64 {
    let mut known: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    known.sort_by(f64::total_cmp);
    known.get(known.len() / 2).copied().unwrap_or(f64::NAN)
}

pub(crate) fn in_newton_metres(
    source: &mut Source,
    key: &'static str,
    name: &str,
    scale: Option<f64>,
    whole: bool,
) -> Result<Series> {
    let mut series = source.series(key, name, whole)?;
    let factor = source.torque_factor(key, &series.unit, name, scale)?;
    series.scale(factor);
    Ok(series)
}

/// The channels that were read as samples.
pub(crate) fn sampled<'a>(asked: &'a Request) -> impl Iterator<Item = &'a Series> {
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

/// A text that begins a sentence.
pub(crate) fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|letter| letter.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}
