//! How a column of times, or a number beside the values, becomes a clock.
//!
//! Formats without a clock of their own (text, MAT, HDF5, Parquet) have the times as a channel of values, or as a rate
//! or an interval by a name that is usual in the field.

use super::{Property, Value};
use crate::{Channel, Clock, Content, Note, Recording};

/// Names of a channel of times, in lower case and without its unit.
const TIME_NAMES: &str = "t, time, times, zeit, temps, tiempo, tempo, x_value, timestamp, timestamps, time stamp, elapsed, elapsed time, relative time, tijd";

/// Names of a sampling rate in 1/s.
const RATE_NAMES: &str = "fs, sr, f_s, f_sample, sampling rate, sample rate, samplingrate, samplerate, sampling frequency, sample frequency, samplingfrequency, samplefrequency, abtastrate, abtastfrequenz";

/// Names of a sampling interval in s.
const INTERVAL_NAMES: &str = "dt, delta t, delta_x, ts, interval, sampling interval, sample interval, sampling period, sample period, sample time, wf_increment, increment";

/// Names of the time of the first value, s, beside a sampling interval.
const FIRST_NAMES: &[&str] = &["start", "x0", "t0", "wf_start_offset"];

/// The last part of a name, in lower case.
fn plain(name: &str) -> String {
    let name = name.trim().to_lowercase();
    let last = name.rsplit('/').next().unwrap_or("");
    last.trim().to_string()
}

/// Whether a name is one of these, as it is or with blanks for its `_`.
fn is_among(names: &str, name: &str) -> bool {
    let spaced = name.replace('_', " ");
    names
        .split(", ")
        .any(|known| known == name || known == spaced)
}

/// Whether a channel of this name holds times.
pub(crate) fn is_time_name(name: &str) -> bool {
    is_among(TIME_NAMES, &plain(name))
}

/// The interval, s, that a number of this name states: a rate in 1/s or an interval in s; none for other names, and
/// for numbers that are no interval.
pub(crate) fn interval_of(name: &str, value: f64) -> Option<f64> {
    let name = plain(name);
    let interval = if is_among(RATE_NAMES, &name) {
        1.0 / value
    } else if is_among(INTERVAL_NAMES, &name) {
        value
    } else {
        return None;
    };
    (interval.is_finite() && interval > 0.0).then_some(interval)
}

/// Seconds in one unit of time; none where the unit is not one of time.
pub(crate) fn seconds_in(unit: &str) -> Option<f64> {
    match unit.trim() {
        "sec" | "secs" | "second" | "seconds" | "Second" | "Seconds" | "Sekunden" => {
            return Some(1.0);
        }
        "msec" | "millisecond" | "milliseconds" => return Some(1e-3),
        "usec" | "microsecond" | "microseconds" => return Some(1e-6),
        "nsec" | "nanosecond" | "nanoseconds" => return Some(1e-9),
        "minute" | "minutes" => return Some(60.0),
        "hour" | "hours" => return Some(3600.0),
        _ => {}
    }
    let unit = units::Unit::parse(unit.trim()).ok()?;
    let second = units::Unit::parse("s").ok()?;
    (unit.dimension() == second.dimension()).then(|| unit.to_si(1.0))
}

/// Days from 1970-01-01 to a day of the Gregorian calendar.
pub(crate) fn days(year: i64, month: i64, day: i64) -> i64 {
    // The year starts with March, so that the day that is added in leap years is its last.
    let (year, month) = match month {
        3.. => (year, month - 3),
        _ => (year - 1, month + 9),
    };
    let leaps = year.div_euclid(4) - year.div_euclid(100) + year.div_euclid(400);
    365 * year + leaps + (153 * month + 2) / 5 + day - 1 - 719_468
}

/// Part of an interval by which equally spaced times may be off: below every use of them, above what is lost when ten
/// million intervals are added up in double precision.
const NEGLIGIBLE: f64 = 1e-4;

/// Share of steps over two intervals below which they are rows that were lost, not the rounding of an interval that is a little longer.
const FEW: f64 = 0.01;

/// Whether times are equally spaced, found in one pass.
///
/// Every time, known to its rounding, leaves a range for the interval; the times are equally spaced as long as the
/// ranges of all have an interval in common. Where times are written no finer than the interval, a few steps of two intervals among
/// single ones would fit an interval that is a little longer: those are lost rows, and the times stay as written.
#[derive(Clone, Debug)]
pub(crate) struct Spacing {
    first: f64,
    last: f64,
    count: u64,
    least: f64,
    most: f64,
    equal: bool,
    /// Steps of more than an interval and a half, by the first step.
    wide: u64,
    step: f64,
    /// Index of the first time that is not after the one before, and how many there are.
    pub back: Option<(u64, u64)>,
    /// How many times are not numbers.
    pub missing: u64,
}

impl Spacing {
    /// Before the first time.
    pub fn new() -> Spacing {
        Spacing {
            first: 0.0,
            last: 0.0,
            count: 0,
            least: 0.0,
            most: f64::INFINITY,
            equal: true,
            wide: 0,
            step: 0.0,
            back: None,
            missing: 0,
        }
    }

    /// Takes the next time; `rounding` is the spacing of the numbers in which it was written.
    pub fn add(&mut self, time: f64, rounding: f64) {
        let k = self.count;
        self.count += 1;
        if !time.is_finite() {
            self.missing += 1;
            self.equal = false;
            return;
        }
        if k == 0 || self.missing == k {
            (self.first, self.last) = (time, time);
            return;
        }
        if time < self.last || (time == self.last && !self.equal) {
            let (first, count) = self.back.unwrap_or((k, 0));
            self.back = Some((first, count + 1));
        }
        if time < self.last {
            self.equal = false;
        }
        let step = time - self.last;
        self.last = time;
        if k == 1 {
            self.step = step;
        }
        self.wide += u64::from(step > 1.5 * self.step);
        if self.equal {
            // Both ends are rounded, each by half of the spacing; a few units in the last place for the subtraction; and
            // what a writer loses who adds the interval from time to time.
            let passed = time - self.first;
            let last_place = f64::EPSILON * time.abs().max(self.first.abs());
            let slack = rounding + 4.0 * last_place + NEGLIGIBLE * passed / k as f64;
            self.least = self.least.max((passed - slack) / k as f64);
            self.most = self.most.min((passed + slack) / k as f64);
            self.equal = self.least <= self.most;
        }
    }

    /// First time and interval, in the unit of the times; none where they are not equally spaced.
    pub fn uniform(&self) -> Option<(f64, f64)> {
        let lost = self.wide > 0 && (self.wide as f64) < FEW * self.count as f64;
        if !self.equal || lost || self.count < 2 || self.last <= self.first {
            return None;
        }
        let mean = (self.last - self.first) / (self.count - 1) as f64;
        let interval = round_number(mean.clamp(self.least, self.most), self.least, self.most);
        (interval > 0.0).then_some((self.first, interval))
    }

    /// What is wrong with the times of a channel of this name.
    pub fn notes(&self, name: &str) -> Vec<Note> {
        let note = |text: String| Note::of(name, text);
        let mut notes = Vec::new();
        if let Some((first, count)) = self.back {
            notes.push(note(format!(
                "{count} times are not after the one before, the first at index {first}"
            )));
        }
        if self.missing > 0 {
            notes.push(note(format!("{} times are not numbers", self.missing)));
        }
        notes
    }

    /// The clock of the channels beside a channel of times, which has the given index and unit.
    pub fn clock(&self, channel: usize, unit: &str) -> Clock {
        match (self.uniform(), seconds_in(unit)) {
            (Some((first, interval)), Some(seconds)) => Clock::Uniform {
                first: first * seconds,
                interval: interval * seconds,
            },
            _ => Clock::Channel(channel),
        }
    }
}

/// The part of a name up to its last stroke: the group in which a channel stands.
fn group_of(name: &str) -> &str {
    name.rfind('/').map_or("", |end| &name[..=end])
}

/// The clock that a property in the group of a channel, or in a group around it, states, and the property's name.
fn stated_by<'a>(properties: &'a [Property], channel: &Channel) -> Option<(f64, &'a str)> {
    let around =
        |property: &&Property| group_of(&channel.name).starts_with(group_of(&property.name));
    let stated = properties.iter().filter(around).filter_map(|property| {
        let Value::Number(value) = property.value else {
            return None;
        };
        let interval = interval_of(&property.name, value)?;
        Some((interval, &*property.name))
    });
    stated.max_by_key(|(_, name)| group_of(name).len())
}

/// Clocks for the channels of a file that have none: from a channel of times in the same group or one around it, or
/// else from one of the properties of the file such as `fs`; with what is to be noted.
///
/// `rounding`: for each channel how its values are rounded, as a part of them, of instants in s; none for a channel whose values
/// are not to be looked at.
pub(crate) fn clocks(
    file: &mut dyn Recording,
    properties: &[Property],
    rounding: &[Option<f64>],
) -> (Vec<(usize, Clock)>, Vec<Note>) {
    let (mut clocks, mut notes) = (Vec::new(), Vec::new());
    let channels = file.channels().to_vec();
    let is_open = |channel: &Channel| channel.clock == Clock::Unknown;
    let mut open: Vec<bool> = channels.iter().map(is_open).collect();
    // Times by their name, then the index of a table of pandas, then other instants.
    let rank = |channel: &Channel| match channel.content {
        Content::Text => None,
        _ if is_time_name(&channel.name) => Some(0),
        Content::Time if channel.name.starts_with("__index_level_") => Some(1),
        Content::Time => Some(2),
        Content::Number => None,
    };
    let mut times: Vec<usize> = (0..channels.len())
        .filter(|&k| rank(&channels[k]).is_some())
        .collect();
    times.sort_by_key(|&k| rank(&channels[k]));
    for (time, channel) in times.into_iter().map(|k| (k, &channels[k])) {
        if !open[time] || channel.count == 0 {
            continue;
        }
        let mut clock = Clock::Channel(time);
        if let Some(&Some(rounding)) = rounding.get(time) {
            let absolute = channel.content == Content::Time;
            let spacing = spacing(file, time, channel.count, (rounding, absolute));
            notes.extend(spacing.notes(&channel.name));
            clock = spacing.clock(time, &channel.unit);
        }
        if seconds_in(&channel.unit).is_none() {
            let text = "is a time by its name, but its unit is not stated";
            notes.push(Note::of(&channel.name, text));
        }
        for (index, beside) in channels.iter().enumerate() {
            let near = group_of(&beside.name).starts_with(group_of(&channel.name));
            if open[index] && near && beside.count == channel.count {
                open[index] = false;
                clocks.push((index, clock.clone()));
            }
        }
    }
    let mut origins: Vec<(&str, usize)> = Vec::new();
    let left = channels.iter().enumerate();
    for (index, channel) in left.filter(|(index, _)| open[*index]) {
        if let Some((interval, origin)) = stated_by(properties, channel) {
            let first = properties.iter().find_map(|property| match property.value {
                Value::Number(first) if FIRST_NAMES.contains(&plain(&property.name).as_str()) => {
                    Some(first).filter(|_| group_of(&property.name) == group_of(origin))
                }
                _ => None,
            });
            let first = first.filter(|first| first.is_finite()).unwrap_or(0.0);
            clocks.push((index, Clock::Uniform { first, interval }));
            match origins.iter_mut().find(|(known, _)| *known == origin) {
                Some((_, count)) => *count += 1,
                None => origins.push((origin, 1)),
            }
        }
    }
    notes.extend(origins.iter().map(|(origin, count)| {
        Note::of_file(format!(
            "{count} channels have the clock that {origin} states, taken in s or 1/s"
        ))
    }));
    (clocks, notes)
}

/// The spacing of the times of a channel; their rounding is absolute, or a part of them.
fn spacing(
    file: &mut dyn Recording,
    time: usize,
    count: u64,
    (rounding, absolute): (f64, bool),
) -> Spacing {
    let mut spacing = Spacing::new();
    let mut values = vec![0.0; 1 << 14];
    let mut at = 0;
    while at < count {
        let Ok(read @ 1..) = file.read(time, at, &mut values) else {
            break;
        };
        for &value in &values[..read] {
            let scale = if absolute { 1.0 } else { value.abs() };
            spacing.add(value, rounding * scale);
        }
        at += read as u64;
    }
    spacing
}

/// The interval in a range that has fewest decimal digits, or whose rate has; that is how loggers are set.
fn round_number(value: f64, least: f64, most: f64) -> f64 {
    let short = |value: f64, digits: usize| format!("{value:.digits$e}").parse::<f64>().ok();
    let fits = |value: &f64| *value >= least && *value <= most;
    (0..15)
        .find_map(|digits| {
            let interval = short(value, digits).filter(fits);
            let rate = short(1.0 / value, digits);
            interval.or(rate.map(|rate| 1.0 / rate).filter(fits))
        })
        .unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spacing(times: &[f64], rounding: f64) -> Spacing {
        let mut spacing = Spacing::new();
        for &time in times {
            spacing.add(time, rounding);
        }
        spacing
    }

    #[test]
    fn rounded_times_give_the_interval_that_made_them() {
        // 1/42000 s written with six decimals, as a logger does.
        let times: Vec<f64> = (0..5000)
            .map(|k| (f64::from(k) / 42000.0 * 1e6).round() / 1e6)
            .collect();
        let (first, interval) = spacing(&times, 1e-6).uniform().unwrap();
        assert_eq!((first, interval), (0.0, 1.0 / 42000.0));
    }

    #[test]
    fn an_interval_of_few_digits_is_found_exactly() {
        let times: Vec<f64> = (0..1000).map(|k| 3.0 + f64::from(k) * 0.001).collect();
        assert_eq!(spacing(&times, 0.0).uniform(), Some((3.0, 0.001)));
    }

    #[test]
    fn intervals_that_were_added_up_are_still_equal() {
        let mut time = 0.0;
        let times = (0..1_000_000).map(|_| {
            time += 1.0 / 42000.0;
            time
        });
        let times: Vec<f64> = times.collect();
        assert_eq!(
            spacing(&times, 0.0).uniform(),
            Some((times[0], 1.0 / 42000.0))
        );
    }

    #[test]
    fn one_late_time_is_no_equal_spacing() {
        let mut times: Vec<f64> = (0..100).map(f64::from).collect();
        times[50] += 0.01;
        assert_eq!(spacing(&times, 1e-3).uniform(), None);
        assert_eq!(spacing(&times, 1e-3).clock(4, "s"), Clock::Channel(4));
    }

    /// Times in steps of their last digit: one step of two is a row less, many are a longer interval.
    #[test]
    fn a_lost_row_among_coarse_times_is_no_longer_interval() {
        let mut times: Vec<f64> = (0..500).map(|k| f64::from(k) * 1e-4).collect();
        assert_eq!(spacing(&times, 1e-4).uniform(), Some((0.0, 1e-4)));
        times.remove(99);
        assert_eq!(spacing(&times, 1e-4).uniform(), None);
        let longer = (0..500).map(|k| (f64::from(k) * 1.05).floor() * 1e-4);
        let longer: Vec<f64> = longer.collect();
        assert!(spacing(&longer, 1e-4).uniform().is_some());
    }

    #[test]
    fn a_time_that_goes_back_is_reported_with_its_index() {
        let found = spacing(&[0.0, 1.0, 2.0, 1.5, 2.5, 2.4], 0.0);
        assert_eq!(found.back, Some((3, 2)));
        assert_eq!(found.uniform(), None);
    }

    #[test]
    fn the_clock_is_in_seconds_and_needs_the_unit() {
        let times: Vec<f64> = (0..10).map(|k| f64::from(k) * 0.5).collect();
        let found = spacing(&times, 0.0);
        let expected = Clock::Uniform {
            first: 0.0,
            interval: 0.5e-3,
        };
        assert_eq!(found.clock(0, "ms"), expected);
        assert_eq!(found.clock(0, ""), Clock::Channel(0));
        assert_eq!(found.clock(0, "mm"), Clock::Channel(0));
    }

    #[test]
    fn usual_names_tell_rate_and_interval() {
        assert_eq!(interval_of("Sampling_Rate", 4.0), Some(0.25));
        assert_eq!(interval_of("run1/dt", 0.25), Some(0.25));
        assert_eq!(interval_of("fs", 0.0), None);
        assert_eq!(interval_of("mass", 2.0), None);
        assert!(is_time_name("Group/Time") && !is_time_name("timer"));
    }
}
