//! Instants in a channel: as they stand there, or those at which a line of 0 and 1 has a flank.

use crate::signals::read::{MOST_VALUES, Source};
use problem::{Code, Result};
use recording::Content;
use scenario::PickupFlank;

/// Instants in a channel, s, in order.
#[derive(Clone, Debug, PartialEq)]
pub struct Stamps {
    /// The instants.
    pub times: Vec<f64>,
    /// Values of the channel that were none.
    pub missing: usize,
}

impl Source<'_> {
    /// The instants in a channel, or those at which a line of 0 and 1 has a flank, within the part that is looked at.
    pub fn stamps(&mut self, key: &'static str, name: &str, flank: PickupFlank) -> Result<Stamps> {
        let (index, channel) = self.channel(key, name)?;
        if channel.count > MOST_VALUES {
            let found = format!("channel \"{name}\" with {} values", channel.count);
            let needed = format!("at most {MOST_VALUES} instants are taken");
            return Err(self.problem(Code::TooManyRows, key, found, needed));
        }
        // A counter takes its stamps when they come.
        let offset = self.start(&channel);
        let read = self.read(key, index, 0, channel.count as usize)?;
        let line = channel.content == Content::Number && is_line(&read);
        let (known, missing) = match self.times_of(key, &channel, read.len())? {
            Some(times) if line => (flanks(&times, &read, flank), 0),
            _ => {
                let seconds = match channel.content {
                    Content::Time => 1.0,
                    _ => self.seconds(key, &channel)?,
                };
                let known: Vec<f64> = (read.iter().filter(|v| v.is_finite()))
                    .map(|v| v * seconds)
                    .collect();
                let missing = read.len() - known.len();
                (known, missing)
            }
        };
        let known: Vec<f64> = known.iter().map(|time| time + offset).collect();
        if let Some(at) = known.windows(2).position(|pair| pair[1] <= pair[0]) {
            return Err(self.backwards(key, name, at + 1, known[at], known[at + 1]));
        }
        let inside = |t: &f64| {
            self.signals.from.is_none_or(|from| *t >= from)
                && self.signals.to.is_none_or(|to| *t <= to)
        };
        Ok(Stamps {
            missing,
            times: known.iter().copied().filter(inside).collect(),
        })
    }
}

/// Whether values are those of a logic line: 0 and 1, and both.
fn is_line(values: &[f64]) -> bool {
    let all = values.iter().all(|value| *value == 0.0 || *value == 1.0);
    all && values.contains(&0.0) && values.contains(&1.0)
}

/// Instants at which a logic line has a flank: its time is that of the first value behind it.
fn flanks(times: &[f64], line: &[f64], flank: PickupFlank) -> Vec<f64> {
    let changes = (1..line.len().min(times.len())).filter(|&k| line[k] != line[k - 1]);
    let rises = |k: &usize| line[*k] > 0.5;
    match flank {
        PickupFlank::Both => changes.map(|k| times[k]).collect(),
        PickupFlank::Rising => changes.filter(rises).map(|k| times[k]).collect(),
        PickupFlank::Falling => changes.filter(|k| !rises(k)).map(|k| times[k]).collect(),
        PickupFlank::Centre => {
            let changes: Vec<usize> = changes.collect();
            let pulses = changes.windows(2).filter(|pair| rises(&pair[0]));
            pulses
                .map(|pair| 0.5 * (times[pair[0]] + times[pair[1]]))
                .collect()
        }
    }
}
