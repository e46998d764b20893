//! The channels that are asked for, read from a measurement file and brought to one clock in s.

mod clock;
mod stamps;
mod timing;

pub use stamps::Stamps;
use timing::Timing;

use measure::converter::Converter;
use problem::{Code, Problem, Result};
use problem::{note, note::Note};
use recording::unit::{no_signal, si_factor, speed_factor, unit_of};
use recording::{Channel, Clock, Content, FileError, Instant, Recording};
use scenario::{Signals, problem_at};
use std::path::Path;
use units::Unit;

/// Most values that are taken from a channel: 400 MB.
const MOST_VALUES: u64 = 50_000_000;
/// Lines that a spectrum needs to show anything.
const FEWEST_LINES: f64 = 4.0;
/// Part by which an interval in the scenario may differ from that of the file, as where a rate is written down with three digits.
const ROUNDED: f64 = 1e-3;

/// Values of a channel at equal intervals.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name as in the file.
    pub name: String,
    /// Unit as in the file; may be empty.
    pub unit: String,
    /// Time of the first value, s.
    pub first: f64,
    /// Interval, s.
    pub interval: f64,
    /// Values in the unit of the file; not-a-number where there is none.
    pub values: Vec<f64>,
    /// The converter that took them, in the same unit, where it is known.
    pub converter: Option<Converter>,
}

impl Series {
    /// Time of the last value, s.
    pub fn last(&self) -> f64 {
        self.first + self.values.len().saturating_sub(1) as f64 * self.interval
    }

    /// Turns values and converter into another unit, of which one of the file's has `factor`.
    pub fn scale(&mut self, factor: f64) {
        for value in &mut self.values {
            *value *= factor;
        }
        if let Some(converter) = &mut self.converter {
            let ends = [factor * converter.lowest, factor * converter.highest];
            converter.lowest = ends[0].min(ends[1]);
            converter.highest = ends[0].max(ends[1]);
        }
    }

    /// Time of a value, s.
    pub fn time(&self, index: usize) -> f64 {
        self.first + index as f64 * self.interval
    }
}

/// What the file says of one of its channels.
#[derive(Clone, Debug, PartialEq)]
pub struct Listed {
    /// Name.
    pub name: String,
    /// Unit.
    pub unit: String,
    /// Number of values.
    pub count: u64,
    /// Values a second, where the clock is even.
    pub rate: Option<f64>,
}

/// A measurement file that is open.
pub struct Source<'a> {
    recording: Box<dyn Recording>,
    signals: &'a Signals,
    /// The key that names the file.
    key: &'static str,
    name: String,
    /// Whether the interval of the scenario was taken for a channel.
    interval_taken: bool,
    /// A channel whose own clock has another interval than the scenario, and that, s.
    contradicted: Option<(String, f64)>,
    /// What was done with channels of uneven times.
    evened: Vec<Note>,
}

impl<'a> Source<'a> {
    /// Opens a file; `key` names it in the scenario.
    pub fn open(path: &Path, key: &'static str, signals: &'a Signals) -> Result<Source<'a>> {
        let recording = recording::open(path).map_err(|error| of_file(&error, key))?;
        let name = short(path);
        Ok(Source {
            recording,
            signals,
            key,
            name,
            interval_taken: false,
            contradicted: None,
            evened: Vec::new(),
        })
    }

    /// The channels as the file lists them.
    pub fn listed(&self) -> Vec<Listed> {
        let channels = self.recording.channels().iter();
        channels
            .map(|channel| Listed {
                name: channel.name.clone(),
                unit: channel.unit.clone(),
                count: channel.count,
                rate: match channel.clock {
                    Clock::Uniform { interval, .. } => Some(1.0 / interval),
                    _ => None,
                },
            })
            .collect()
    }

    /// What was wrong with the file as far as it was read.
    pub fn notes(&self) -> Vec<Note> {
        let notes = self.recording.notes().iter();
        let notes = notes.map(|note| match &note.channel {
            Some(channel) => note!("{}, channel {}: {}", &self.name, channel, &note.text),
            None => note!("{}: {}", &self.name, &note.text),
        });
        notes.chain(self.evened.iter().cloned()).collect()
    }

    fn problem(
        &self,
        code: Code,
        key: &str,
        found: String,
        needed: impl Into<String>,
    ) -> Box<Problem> {
        let found = format!("{}, {found}", self.name);
        problem_at(code, key, found, needed)
    }

    fn channel(&self, key: &str, name: &str) -> Result<(usize, Channel)> {
        recording::find(&*self.recording, name).map_err(|why| {
            let problem = self.problem(Code::UnknownChannel, key, why.found, why.needed);
            problem.with_hint(why.hint)
        })
    }

    /// Seconds from the earliest start of the file to that of a channel, and its delay by the converter: columns of times are
    /// no turn of it.
    fn offset(&self, index: usize, channel: &Channel) -> f64 {
        let all = self.recording.channels();
        let is_clock = |k: usize| all.iter().any(|c| c.clock == Clock::Channel(k));
        let times = |k: usize, c: &Channel| {
            c.content == Content::Time || si_factor(&c.unit, "s").is_some() || is_clock(k)
        };
        let before = all.iter().enumerate().take(index);
        let turn = before.filter(|(k, c)| !times(*k, c)).count();
        self.start(channel) + turn as f64 * self.signals.channel_delay
    }

    /// Seconds from the earliest start of the file to that of a channel.
    fn start(&self, channel: &Channel) -> f64 {
        let starts = self.recording.channels().iter().filter_map(|c| c.start);
        let earlier = |a: Instant, b: Instant| {
            if (a.seconds, a.fraction) <= (b.seconds, b.fraction) {
                a
            } else {
                b
            }
        };
        match (channel.start, starts.reduce(earlier)) {
            (Some(own), Some(first)) => {
                own.seconds.saturating_sub(first.seconds) as f64 + own.fraction - first.fraction
            }
            _ => 0.0,
        }
    }

    /// The values of a channel at equal times, within the part that is looked at; all of it where `whole`.
    pub fn series(&mut self, key: &'static str, name: &str, whole: bool) -> Result<Series> {
        self.sampled(key, name, whole, false)
    }

    /// The same; where `rising`, of a channel whose times only rise, brought to equal times.
    fn sampled(
        &mut self,
        key: &'static str,
        name: &str,
        whole: bool,
        rising: bool,
    ) -> Result<Series> {
        let (index, channel) = self.channel(key, name)?;
        let offset = self.offset(index, &channel);
        let part = match whole {
            true => (None, None),
            false => (self.signals.from, self.signals.to),
        };
        let timing = match (&channel.clock, self.signals.sample_interval) {
            (Clock::Uniform { first, interval }, _) => {
                Timing::even(first + offset, *interval, channel.count, part)
            }
            (Clock::Channel(clock), _) => self.timing(key, &channel, *clock, offset, part)?,
            (Clock::Unknown, Some(interval)) => {
                self.interval_taken = true;
                Timing::even(offset, interval, channel.count, part)
            }
            (Clock::Unknown, None) => {
                return Err(self.problem(
                    Code::ChannelClock,
                    key,
                    format!("channel \"{name}\", of which the file states no clock"),
                    "signals.sample_interval is needed with it, e.g. \"0.1 ms\"",
                ));
            }
        };
        let interval = timing.interval;
        if let Some(told) = self.signals.sample_interval
            && (interval / told - 1.0).abs() > ROUNDED
        {
            self.contradicted
                .get_or_insert((channel.name.clone(), interval));
        }
        let count = timing.end.saturating_sub(timing.begin);
        if count == 0 {
            let (first, last) = timing.range;
            let found = format!(
                "channel \"{name}\", which has no value there: it runs from {first:.6} s to {last:.6} s"
            );
            return Err(self.problem(
                Code::ChannelClock,
                key,
                found,
                "signals.from and signals.to must leave some of it",
            ));
        }
        if count > MOST_VALUES {
            let found = format!("channel \"{name}\" with {count} values");
            let needed = format!(
                "at most {MOST_VALUES} are taken at once: give signals.from and signals.to"
            );
            return Err(self.problem(Code::TooManyRows, key, found, needed));
        }
        let values = self.read(key, index, timing.begin, count as usize)?;
        let converter = self.converter(&channel.name);
        let series = Series {
            converter,
            name: channel.name,
            unit: channel.unit,
            first: timing.first,
            interval,
            values,
        };
        match timing.uneven {
            None => Ok(series),
            Some(_) if rising => self.evened(key, series, timing),
            Some(found) => Err(self.problem(
                Code::ChannelClock,
                key,
                found,
                "values at equal times are needed; signals.from and signals.to leave out a gap; instants of marks are read with kind = \"edges\"",
            )),
        }
    }

    /// The converter of a channel, where one is told.
    fn converter(&self, name: &str) -> Option<Converter> {
        let told = self.signals.converter.as_ref()?;
        let meant = |known: &String| {
            let end = name.strip_suffix(known.as_str());
            end.is_some_and(|start| start.is_empty() || start.ends_with('/'))
        };
        told.channels.iter().any(meant).then_some(Converter {
            lowest: told.lowest,
            highest: told.highest,
            bits: told.bits,
        })
    }

    /// Refuses names of channels that the file does not have.
    pub fn has(&self, key: &str, names: &[String]) -> Result<()> {
        names
            .iter()
            .try_for_each(|name| self.channel(key, name).map(|_| ()))
    }

    /// Refuses a highest frequency of a spectrum that the samples do not reach, or below which they have no lines.
    ///
    /// - `resolved`: distance of two lines at best, Hz
    pub fn reaches(
        &self,
        key: &'static str,
        highest: Option<f64>,
        series: &Series,
        resolved: f64,
    ) -> Result<()> {
        let half = 0.5 / series.interval;
        let least = FEWEST_LINES * resolved;
        match highest {
            // Clocks are read with their rounding.
            Some(highest) if highest > half * (1.0 + 1e-6) || highest < least.min(half) => {
                let text = |value: f64| units::number_text(value);
                Err(self.problem(
                    Code::OutOfRange,
                    key,
                    format!("{} Hz", text(highest)),
                    format!(
                        "from {} to {} Hz is needed: {FEWEST_LINES} lines as fine as the record has them, and half of the sampling rate of channel \"{}\"",
                        text((least * 1e3).ceil() / 1e3),
                        text((half * 1e6).round() / 1e6),
                        series.name
                    ),
                ))
            }
            _ => Ok(()),
        }
    }

    /// The values of a channel in which passing marks or balls are looked for; refuses what is another quantity by its unit.
    pub fn passings(&mut self, key: &'static str, name: &str) -> Result<Series> {
        let series = self.series(key, name, false)?;
        match no_signal(&series.unit) {
            Some(quantity) => Err(self.problem(
                Code::ChannelUnit,
                key,
                format!(
                    "channel \"{}\" in \"{}\", a {quantity}",
                    series.name,
                    series.unit.trim()
                ),
                match speed_factor(&series.unit) {
                    Some(_) if key == "signals.speed.channel" => {
                        "a speed is read with signals.speed.kind = \"speed\"; else the signal of a sensor that sees each mark pass is needed, e.g. in V"
                    }
                    _ => "the signal of a sensor that sees each of them pass is needed, e.g. in V",
                },
            )),
            None => Ok(series),
        }
    }

    /// The values of a channel that shows a speed, in rad/s, within the part that is looked at.
    pub fn speeds(&mut self, key: &'static str, name: &str, scale: Option<f64>) -> Result<Series> {
        let mut series = self.sampled(key, name, false, true)?;
        let named = || format!("channel \"{}\" in \"{}\"", series.name, series.unit.trim());
        let factor = match (speed_factor(&series.unit), scale) {
            (Some(own), Some(scale)) if (own / scale - 1.0).abs() > 1e-9 => {
                return Err(self.problem(
                    Code::ChannelUnit,
                    "signals.speed.scale",
                    named(),
                    "the unit of the file and this scale contradict each other: leave the scale away, or correct it",
                ));
            }
            (_, Some(scale)) => scale,
            (Some(own), None) => own,
            (None, None) => {
                let found = match series.unit.trim() {
                    "" => format!("channel \"{}\" without a unit", series.name),
                    _ => named(),
                };
                return Err(self.problem(
                    Code::ChannelUnit,
                    key,
                    found,
                    "a unit of turning is needed (rpm, rad/s, Hz): tell what one unit of the channel is, e.g. signals.speed.scale = \"1 rpm\"",
                ));
            }
        };
        series.scale(factor);
        Ok(series)
    }

    fn read(
        &mut self,
        key: &'static str,
        channel: usize,
        first: u64,
        count: usize,
    ) -> Result<Vec<f64>> {
        let mut values = vec![f64::NAN; count];
        let got = self
            .recording
            .read(channel, first, &mut values)
            .map_err(|error| of_file(&error, key))?;
        values.truncate(got);
        if self.recording.contradicts_checksum(channel) {
            let name = &self.recording.channels()[channel].name;
            return Err(self.problem(
                Code::MeasurementUnreadable,
                key,
                format!("channel \"{name}\", whose values do not match the checksum in the file"),
                "the file was damaged after it was written: a whole copy of it is needed",
            ));
        }
        Ok(values)
    }

    /// The factor from the unit of a torque channel to N m.
    pub fn torque_factor(
        &self,
        key: &'static str,
        unit: &str,
        name: &str,
        scale: Option<f64>,
    ) -> Result<f64> {
        let own = si_factor(unit, "N m");
        match (own, scale) {
            // a sensor may be mounted the other way round
            (Some(own), Some(scale)) if ((own / scale).abs() - 1.0).abs() > 1e-9 => Err(self.problem(
                Code::ChannelUnit,
                "signals.torque.scale",
                format!("channel \"{name}\" in \"{unit}\""),
                "the unit of the file and this scale contradict each other: leave the scale away, or correct it",
            )),
            (None, Some(0.0)) => Err(self.problem(
                Code::OutOfRange,
                "signals.torque.scale",
                format!("channel \"{name}\" times 0"),
                "a torque of one unit other than 0 is needed; below 0 for a sensor mounted the other way round",
            )),
            (_, Some(scale)) => Ok(scale),
            (Some(own), None) => Ok(own),
            (None, None) => Err(self.problem(
                Code::ChannelUnit,
                key,
                match unit.trim() {
                    "" => format!("channel \"{name}\" without a unit"),
                    unit => format!("channel \"{name}\" in \"{unit}\""),
                },
                "a unit of torque is needed: state what one unit of the channel is, e.g. signals.torque.scale = \"1 N mm\"",
            )),
        }
    }

    /// The unit of a channel that must be a temperature.
    pub fn temperature_unit(&self, key: &'static str, series: &Series) -> Result<Unit> {
        unit_of(&series.unit, "K").ok_or_else(|| {
            self.problem(
                Code::ChannelUnit,
                key,
                format!("channel \"{}\" in \"{}\"", series.name, series.unit.trim()),
                "a unit of temperature is needed, K or degC",
            )
        })
    }

    /// The key that names the file.
    pub fn key(&self) -> &'static str {
        self.key
    }
}

/// What a reader refuses, as a problem of the scenario.
fn of_file(error: &FileError, key: &str) -> Box<Problem> {
    let place = match error.place.as_str() {
        "" => String::new(),
        place => format!(", {place}"),
    };
    let found = format!("{}{place}, which {}", short(&error.path), error.found);
    let needed = match error.needed.as_str() {
        "" => "a measurement file that can be read is needed",
        needed => needed,
    };
    problem_at(Code::MeasurementUnreadable, key, found, needed)
}

/// The name of a file without its folders, for messages.
pub fn short(path: &Path) -> String {
    let name = path.file_name().unwrap_or(path.as_os_str());
    name.to_string_lossy().into_owned()
}
