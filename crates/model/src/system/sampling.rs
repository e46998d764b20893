//! What every system's record does alike: rows at equal intervals, largest values, first rises through a level.

use super::energy::Content;
use solve::{Machine, Step};

/// The largest value of something, and when.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Peak {
    /// Value.
    pub value: f64,
    /// Instant, s.
    pub time: f64,
}

impl Peak {
    /// Nothing yet.
    pub const NONE: Peak = Peak {
        value: 0.0,
        time: 0.0,
    };
    /// Takes a larger value.
    pub fn raise(&mut self, value: f64, time: f64) {
        if value > self.value {
            *self = Peak { value, time };
        }
    }
    /// Takes a larger size of a probe at the ends of a step.
    pub fn raise_at_ends<M: Machine>(&mut self, step: &Step<M>, probe: usize) {
        self.raise(step.start_probe(probe).abs(), step.start);
        self.raise(step.end_probe(probe).abs(), step.end);
    }
}

/// When a value last passed by far what it had been before.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Growth {
    level: f64,
    /// When, s; none before the first value above zero.
    pub last: Option<f64>,
}

/// A value grows where it is so many times what it had been when it last grew.
const GROWS: f64 = 1.05;

impl Growth {
    /// Takes a value at an instant, s.
    pub fn watch(&mut self, value: f64, time: f64) {
        if value > GROWS * self.level {
            (self.level, self.last) = (value, Some(time));
        }
    }
}

/// Turns about a centre, counter-clockwise positive.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Turns {
    /// All of them, those in the other sense subtracted.
    pub net: f64,
    lowest: f64,
    highest: f64,
    /// The most in succession counter-clockwise, and clockwise.
    pub most: [f64; 2],
}

impl Turns {
    /// Takes a part of a turn.
    pub fn add(&mut self, turn: f64) {
        self.net += turn;
        self.lowest = self.lowest.min(self.net);
        self.highest = self.highest.max(self.net);
        let now = [self.net - self.lowest, self.highest - self.net];
        self.most = [0, 1].map(|sense| self.most[sense].max(now[sense]));
    }
    /// The most in succession in the sense of a spin, and against it.
    pub fn about(&self, spin: f64) -> [f64; 2] {
        let [left, right] = self.most;
        if spin < 0.0 {
            [right, left]
        } else {
            [left, right]
        }
    }
}

/// Means of some probes over equal periods that end with the run, by trapezoids over the steps; and the range of a channel
/// in each. Room is made before the run.
#[derive(Clone, Debug, PartialEq)]
pub struct Periods<const N: usize> {
    probes: [usize; N],
    channel: usize,
    start: f64,
    length: f64,
    periods: Vec<Period<N>>,
}

/// One period of [`Periods`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Period<const N: usize> {
    /// Means of the probes.
    pub means: [f64; N],
    /// Smallest and largest value of the channel.
    pub range: (f64, f64),
    covered: f64,
}

/// Periods kept at most: the last ones.
const MOST_PERIODS: f64 = 64.0;

impl<const N: usize> Periods<N> {
    /// Periods of a length (s) up to the end of a run (s).
    pub fn until(end: f64, length: f64, probes: [usize; N], channel: usize) -> Self {
        let count = (end / length).floor().clamp(0.0, MOST_PERIODS);
        let none = Period {
            means: [0.0; N],
            range: (f64::INFINITY, f64::NEG_INFINITY),
            covered: 0.0,
        };
        Periods {
            probes,
            channel,
            start: end - count * length,
            length,
            periods: vec![none; count as usize],
        }
    }
    /// Takes a step, each part of it for the period it lies in.
    pub fn watch<M: Machine>(&mut self, step: &Step<M>) {
        let mut from = step.start.max(self.start);
        while from < step.end {
            let index = ((from - self.start) / self.length) as usize;
            let Some(period) = self.periods.get_mut(index) else {
                return;
            };
            let border = self.start + (index + 1) as f64 * self.length;
            // rounding may leave the border where it is
            let to = step.end.min(border).max(from + f64::EPSILON * step.end);
            let weight = 0.5 * (to - from);
            for (mean, probe) in period.means.iter_mut().zip(self.probes) {
                *mean += weight * (step.start_probe(probe) + step.end_probe(probe));
            }
            period.covered += to - from;
            for value in [step.start_state(self.channel), step.end_state(self.channel)] {
                period.range = (period.range.0.min(value), period.range.1.max(value));
            }
            from = to;
        }
    }
    /// The periods that the run came through whole, in order.
    pub fn whole(&self) -> impl DoubleEndedIterator<Item = Period<N>> + '_ {
        let whole = |period: &&Period<N>| period.covered > 0.999 * self.length;
        self.periods.iter().filter(whole).map(|period| Period {
            means: period.means.map(|sum| sum / period.covered),
            ..*period
        })
    }
}

/// A channel that rises through a level for the first time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rise {
    /// The channel.
    channel: usize,
    /// The level, of either sign: the channel rises away from zero.
    level: f64,
    /// When it did, s.
    pub time: Option<f64>,
}

impl Rise {
    /// A rise that has not happened yet.
    pub fn through(channel: usize, level: f64) -> Self {
        Rise {
            channel,
            level,
            time: None,
        }
    }
    /// Looks for the rise in a step, on dense output.
    #[inline]
    pub fn watch<M: Machine>(&mut self, step: &mut Step<M>) {
        if self.time.is_none() && self.above(step.end_state(self.channel)) {
            self.find(step);
        }
    }
    /// True from the level on.
    fn above(&self, value: f64) -> bool {
        self.level != 0.0 && value * self.level.signum() >= self.level.abs()
    }
    /// The instant of the rise in a step that ends above the level.
    #[cold]
    fn find<M: Machine>(&mut self, step: &mut Step<M>) {
        let above = |value: f64| self.above(value);
        if above(step.start_state(self.channel)) {
            self.time = Some(step.start);
            return;
        }
        let (mut low, mut high) = (0.0, 1.0);
        // 40 halvings: 1e-12 of a step
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if above(step.leading_state(middle, self.channel + 1)[self.channel]) {
                high = middle;
            } else {
                low = middle;
            }
        }
        self.time = Some(step.time(high));
    }
}

/// One sampled row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<'a> {
    /// Time, s.
    pub time: f64,
    /// State.
    pub state: &'a [f64],
    /// Probes.
    pub probe: &'a [f64],
    /// Energies and momentum.
    pub content: Content,
}

/// Time and content of a row.
const EXTRA: usize = 5;

/// Rows at equal intervals. Room is made before the run.
#[derive(Clone, Debug)]
pub struct Rows {
    interval: f64,
    next: u64,
    values: Vec<f64>,
    keep: bool,
    dimension: usize,
    probes: usize,
}

impl Rows {
    /// Rows of a run until `end`, one every `interval`, or none.
    pub fn new<M: Machine>(machine: &M, end: f64, interval: f64, keep: bool) -> Self {
        let (dimension, probes) = (machine.dimension(), machine.probes());
        let count = if keep {
            (end / interval) as usize + 3
        } else {
            0
        };
        Rows {
            interval,
            next: 0,
            values: Vec::with_capacity(count * (dimension + probes + EXTRA)),
            keep,
            dimension,
            probes,
        }
    }
    /// Room for one row alone.
    pub(crate) fn of_one(&self) -> Self {
        Rows {
            values: Vec::new(),
            keep: true,
            ..*self
        }
    }
    fn width(&self) -> usize {
        self.dimension + self.probes + EXTRA
    }
    /// Number of rows.
    pub fn count(&self) -> usize {
        self.values.len() / self.width()
    }
    /// The rows.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = Row<'_>> {
        self.values.chunks_exact(self.width()).map(|row| {
            let (state, rest) = row.split_at(self.dimension);
            let (probe, rest) = rest.split_at(self.probes);
            Row {
                time: rest[0],
                state,
                probe,
                content: Content {
                    translation: rest[1],
                    spin: rest[2],
                    potential: rest[3],
                    angular_momentum: rest[4],
                },
            }
        })
    }
    fn push(&mut self, row: &Row) {
        let content = row.content;
        self.values.extend_from_slice(row.state);
        self.values.extend_from_slice(row.probe);
        let extra: [f64; EXTRA] = [
            row.time,
            content.translation,
            content.spin,
            content.potential,
            content.angular_momentum,
        ];
        self.values.extend_from_slice(&extra);
    }
    /// Takes the rows that fall into a step; `content` gives energies and momentum of a state, and puts it as the rows have it.
    pub fn sample<M: Machine>(
        &mut self,
        step: &mut Step<M>,
        content: impl Fn(&M, &mut [f64]) -> Content,
    ) {
        if !self.keep {
            return;
        }
        let length = step.end - step.start;
        loop {
            let time = self.next as f64 * self.interval;
            if time > step.end {
                return;
            }
            // a row on the very end of the step is the end itself
            let theta = ((time - step.start) / length).clamp(0.0, 1.0);
            let (machine, time) = (step.machine, step.time(theta));
            let (state, probe) = step.evaluate(theta);
            let content = content(machine, state);
            self.push(&Row {
                time,
                state,
                probe,
                content,
            });
            self.next += 1;
        }
    }
    /// Adds the last state of a run, where it is not a row already.
    pub fn finish(&mut self, row: &Row) {
        let last = self.iter().next_back().map(|row| row.time);
        if self.keep && last.is_none_or(|last| last < row.time) {
            self.push(row);
        }
    }
}
