//! The clock of a channel: from its file, or from a column of times.

use crate::analyse::signals::read::{MOST_VALUES, Source, si_factor};
use crate::problem::{Code, Problem};
use measure::recording::{Channel, Content};

/// Usual intervals in a step from which on values are missing.
const LONG_GAP: f64 = 1.8;
/// How far an instant may be from an even clock, in intervals: beyond, values are not at equal times.
const UNEVEN: f64 = 0.1;
/// Values read at a time from a channel that is a clock.
const PIECE: usize = 1 << 16;

impl Source<'_> {
    /// Refuses an interval in the scenario that no channel needs and one contradicts; `other` is a second file that was read.
    pub fn interval_holds(&self, other: Option<&Source>) -> Result<(), Box<Problem>> {
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
    pub(crate) fn seconds(&self, key: &str, channel: &Channel) -> Result<f64, Box<Problem>> {
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

    /// First time and interval of a clock that is a channel, s.
    pub(crate) fn even_clock(
        &mut self,
        key: &'static str,
        name: &str,
        clock: usize,
    ) -> Result<(f64, f64), Box<Problem>> {
        let Some(times) = self.recording.channels().get(clock).cloned() else {
            let found = format!("channel \"{name}\", whose clock the file does not hold");
            return Err(self.problem(Code::ChannelClock, key, found, "a whole file is needed"));
        };
        let seconds = match times.content {
            Content::Time => 1.0,
            _ => self.seconds(key, &times)?,
        };
        let count = times.count.min(MOST_VALUES) as usize;
        if count < 2 {
            let found = format!(
                "channel \"{name}\", whose clock \"{}\" has {count} values",
                times.name
            );
            return Err(self.problem(Code::ChannelClock, key, found, "two at least are needed"));
        }
        let ends = |values: &[f64]| values.first().copied();
        let first = ends(&self.read(key, clock, 0, 1)?).unwrap_or(f64::NAN) * seconds;
        let last = ends(&self.read(key, clock, count as u64 - 1, 1)?).unwrap_or(f64::NAN) * seconds;
        let interval = (last - first) / (count - 1) as f64;
        let mut before = f64::NEG_INFINITY;
        let mut worst: Option<(usize, f64)> = None;
        let (mut gap, mut steps) = ((0.0, 0.0), Vec::new());
        for begin in (0..count).step_by(PIECE) {
            let piece = self.read(key, clock, begin as u64, PIECE.min(count - begin))?;
            for (k, value) in piece.iter().enumerate() {
                let (at, time) = (begin + k, value * seconds);
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
                let away = ((time - first) / interval - at as f64).abs();
                if away > UNEVEN && worst.is_none_or(|(_, most)| away > most) {
                    worst = Some((at, away));
                }
            }
        }
        if let Some((at, away)) = worst {
            steps.sort_by(f64::total_cmp);
            let usual = steps.get(steps.len() / 2).copied().unwrap_or(interval);
            let found = match gap.1 > LONG_GAP * usual {
                true => format!(
                    "a gap of {:.6} s behind {:.6} s in channel \"{name}\", whose values otherwise come every {usual:.6} s",
                    gap.1, gap.0
                ),
                false => format!(
                    "channel \"{name}\", whose values are not at equal times: value {at} is {away:.2} intervals off"
                ),
            };
            let needed = "values at equal times are needed; instants of marks are read with kind = \"edges\"";
            return Err(self.problem(Code::ChannelClock, key, found, needed));
        }
        Ok((first, interval))
    }
}
