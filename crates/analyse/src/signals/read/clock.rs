//! The clock of a channel: from its file, or from a column of times.

use crate::signals::read::timing::Timing;
use crate::signals::read::{MOST_VALUES, Series, Source, si_factor};
use problem::note;
use problem::{Code, Problem, Result};
use recording::{Channel, Clock, Content};

/// Usual intervals in a step from which on values are missing.
const LONG_GAP: f64 = 1.8;
/// How far an instant may be from an even clock, in intervals: beyond, values are not at equal times.
const UNEVEN: f64 = 0.1;
/// Values read at a time from a channel that is a clock.
const PIECE: usize = 1 << 16;

impl Source<'_> {
    /// Refuses an interval in the scenario that no channel needs and one contradicts; `other` is a second file that was read.
    pub fn interval_holds(&self, other: Option<&Source>) -> Result<()> {
        let both = || [Some(self), other].into_iter().flatten();
        let Some(told) = self.signals.sample_interval else {
            return Ok(());
        };
        if both().any(|source| source.interval_taken) {
            return Ok(());
        }
        let contradicted = both().find_map(|source| Some((source, source.contradicted.as_ref()?)));
        let Some((source, (name, own))) = contradicted else {
            return Ok(());
        };
        let text = |value: f64| units::number_text((value * 1e12).round() / 1e6);
        Err(source.problem(
            Code::ChannelClock,
            "signals.sample_interval",
            format!(
                "channel \"{name}\", whose clock has an interval of {} us, beside {} us here",
                text(*own),
                text(told)
            ),
            "leave signals.sample_interval away: the file states the clock of its channels",
        ))
    }

    pub(crate) fn backwards(
        &self,
        key: &str,
        name: &str,
        value: usize,
        from: f64,
        to: f64,
    ) -> Box<Problem> {
        self.problem(
            Code::ChannelClock,
            key,
            format!("channel \"{name}\", whose time goes from {from} s to {to} s at value {value}"),
            "times that rise from value to value are needed",
        )
    }

    /// Seconds of one unit of a channel of times.
    pub(crate) fn seconds(&self, key: &str, channel: &Channel) -> Result<f64> {
        if channel.unit.trim().is_empty() {
            let told = self.signals.time_unit.as_deref();
            return told.and_then(|unit| si_factor(unit, "s")).ok_or_else(|| {
                self.problem(
                    Code::ChannelUnit,
                    key,
                    format!("times in channel \"{}\" without a unit", channel.name),
                    format!(
                        "their unit is needed: signals.time_unit = \"s\", or in the file, as in \"{} [s]\"",
                        channel.name
                    ),
                )
            });
        }
        si_factor(&channel.unit, "s").ok_or_else(|| {
            self.problem(
                Code::ChannelUnit,
                key,
                format!("channel \"{}\" in \"{}\"", channel.name, channel.unit),
                "instants in a unit of time are needed, e.g. s",
            )
        })
    }

    /// Times of the values of a channel as its clock gives them, s; none where it has none.
    pub(super) fn times_of(
        &mut self,
        key: &'static str,
        channel: &Channel,
        count: usize,
    ) -> Result<Option<Vec<f64>>> {
        Ok(match channel.clock {
            Clock::Uniform { first, interval } => {
                Some((0..count).map(|k| first + k as f64 * interval).collect())
            }
            Clock::Channel(clock) => {
                let seconds = self.clock(key, channel, clock)?.1;
                let times = self.read(key, clock, 0, count)?;
                Some(times.iter().map(|time| time * seconds).collect())
            }
            Clock::Unknown => None,
        })
    }

    /// The channel that is the clock of another one, and the seconds of its unit.
    fn clock(&self, key: &str, channel: &Channel, clock: usize) -> Result<(Channel, f64)> {
        let Some(times) = self.recording.channels().get(clock).cloned() else {
            let name = &channel.name;
            let found = format!("channel \"{name}\", whose clock the file does not hold");
            return Err(self.problem(Code::ChannelClock, key, found, "a whole file is needed"));
        };
        let seconds = match times.content {
            Content::Time => 1.0,
            _ => self.seconds(key, &times)?,
        };
        Ok((times, seconds))
    }

    /// When the values of a channel come whose clock is another channel, in the part that is looked at.
    pub(super) fn timing(
        &mut self,
        key: &'static str,
        channel: &Channel,
        clock: usize,
        offset: f64,
        (from, to): (Option<f64>, Option<f64>),
    ) -> Result<Timing> {
        let name = &channel.name;
        let (times, seconds) = self.clock(key, channel, clock)?;
        let count = times.count.min(MOST_VALUES);
        if count < 2 {
            let found = format!(
                "channel \"{name}\", whose clock \"{}\" has {count} values",
                times.name
            );
            return Err(self.problem(Code::ChannelClock, key, found, "two at least are needed"));
        }
        let at = |own: &mut Self, index: u64| -> Result<f64> {
            let value = own.read(key, clock, index, 1)?;
            Ok(value.first().copied().unwrap_or(f64::NAN) * seconds + offset)
        };
        // The times rise, or what is found here is refused below.
        let place = |own: &mut Self, until: &dyn Fn(f64) -> bool| {
            let (mut low, mut high) = (0, count);
            while low < high {
                let middle = low + (high - low) / 2;
                match until(at(own, middle)?) {
                    true => high = middle,
                    false => low = middle + 1,
                }
            }
            Ok::<u64, Box<Problem>>(low)
        };
        let slack = |time: f64| 1e-12 * time.abs();
        let begin = match from {
            Some(from) => place(self, &|time| time >= from - slack(from))?,
            None => 0,
        };
        let end = match to {
            Some(to) => place(self, &|time| time > to + slack(to))?,
            None => count,
        };
        let range = (at(self, 0)?, at(self, count - 1)?);
        let mut timing = Timing {
            begin,
            end,
            first: range.0,
            interval: (range.1 - range.0) / (count - 1) as f64,
            range,
            uneven: None,
            clock,
            seconds,
            offset,
        };
        if end < begin + 2 {
            return Ok(timing);
        }
        let (first, last) = (at(self, begin)?, at(self, end - 1)?);
        let interval = (last - first) / (end - begin - 1) as f64;
        let mut before = f64::NEG_INFINITY;
        let mut worst: Option<(usize, f64)> = None;
        let (mut gap, mut steps) = ((0.0, 0.0), Vec::new());
        for start in (begin..end).step_by(PIECE) {
            let piece = self.read(key, clock, start, PIECE.min((end - start) as usize))?;
            for (k, value) in piece.iter().enumerate() {
                let (at, time) = (start as usize + k, value * seconds + offset);
                if !time.is_finite() {
                    let found = format!(
                        "channel \"{}\", the clock of \"{name}\": value {at} is no number",
                        times.name
                    );
                    return Err(self.problem(
                        Code::ChannelClock,
                        key,
                        found,
                        "a time for each value is needed",
                    ));
                }
                if time <= before {
                    return Err(self.backwards(key, &times.name, at, before, time));
                }
                if before.is_finite() {
                    if time - before > gap.1 {
                        gap = (before, time - before);
                    }
                    if steps.len() < PIECE {
                        steps.push(time - before);
                    }
                }
                before = time;
                let away = ((time - first) / interval - (at as f64 - begin as f64)).abs();
                if away > UNEVEN && worst.is_none_or(|(_, most)| away > most) {
                    worst = Some((at, away));
                }
            }
        }
        (timing.first, timing.interval) = (first, interval);
        steps.sort_by(f64::total_cmp);
        let usual = steps.get(steps.len() / 2).copied().unwrap_or(interval);
        if worst.is_some() {
            timing.interval = usual;
        }
        timing.uneven = worst.map(|(at, away)| {
            match gap.1 > LONG_GAP * usual {
                true => format!(
                    "a gap of {:.6} s behind {:.6} s in channel \"{name}\", whose values otherwise come every {usual:.6} s",
                    gap.1, gap.0
                ),
                false => format!(
                    "channel \"{name}\", whose values are not at equal times: value {at} is {away:.2} intervals off"
                ),
            }
        });
        Ok(timing)
    }

    /// The values of a channel of rising times at equal ones, on straight lines between neighbours; none in a gap.
    pub(super) fn evened(
        &mut self,
        key: &'static str,
        mut series: Series,
        timing: Timing,
    ) -> Result<Series> {
        let read = self.read(key, timing.clock, timing.begin, series.values.len())?;
        let times: Vec<f64> = read
            .iter()
            .map(|t| t * timing.seconds + timing.offset)
            .collect();
        let steps = || times.windows(2).map(|pair| pair[1] - pair[0]);
        let mut sorted: Vec<f64> = steps().collect();
        sorted.sort_by(f64::total_cmp);
        let longest = LONG_GAP * sorted.get(sorted.len() * 9 / 10).copied().unwrap_or(0.0);
        let usual: Vec<f64> = steps().filter(|step| *step <= longest).collect();
        let interval = usual.iter().sum::<f64>() / usual.len().max(1) as f64;
        let (first, last) = (times[0], times[times.len() - 1]);
        let count = ((last - first) / interval * (1.0 + f64::EPSILON)).floor() + 1.0;
        if !(1.0..=MOST_VALUES as f64).contains(&count) {
            let found = format!(
                "channel \"{}\" over {} s with a value every {interval:.3e} s",
                series.name,
                last - first
            );
            let needed = "signals.from and signals.to must leave a part of it without long gaps";
            return Err(self.problem(Code::TooManyRows, key, found, needed));
        }
        let mut before = 0;
        let values = (0..count as usize).map(|k| {
            let time = first + k as f64 * interval;
            while before + 2 < times.len() && times[before + 1] <= time {
                before += 1;
            }
            let step = times[before + 1] - times[before];
            let part = ((time - times[before]) / step).clamp(0.0, 1.0);
            let (a, b) = (series.values[before], series.values[before + 1]);
            match step <= longest || part * step < 1e-6 * interval {
                true => a + part * (b - a),
                false => f64::NAN,
            }
        });
        series.values = values.collect();
        (series.first, series.interval) = (first, interval);
        let gaps = (times.windows(2)).filter(|pair| pair[1] - pair[0] > longest);
        let told: Vec<String> = gaps
            .map(|pair| format!("{:.6} to {:.6} s", pair[0], pair[1]))
            .collect();
        let left = match told.len() {
            0 => String::new(),
            1..=3 => format!("; nothing is known in the gaps {}", told.join(", ")),
            more => format!("; nothing is known in {more} gaps, the first {}", told[0]),
        };
        self.evened.push(note!(
            "{}, channel {}: its values come at uneven times, every {:.6} s on average; they are brought to equal times on straight lines between neighbours{}",
            &self.name, &series.name, interval, left
        ));
        Ok(series)
    }
}
