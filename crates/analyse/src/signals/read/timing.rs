//! When the values of a channel come.

/// When the values of a channel come.
pub(super) struct Timing {
    /// Index of the first value that is looked at, and of the one behind the last.
    pub begin: u64,
    pub end: u64,
    /// Time of the first one, and the interval, s.
    pub first: f64,
    pub interval: f64,
    /// First and last time of the channel, s.
    pub range: (f64, f64),
    /// What is uneven of them, where something is.
    pub uneven: Option<String>,
    /// The channel of the times, the seconds of its unit, and what is added.
    pub clock: usize,
    pub seconds: f64,
    pub offset: f64,
}

impl Timing {
    /// Equal times, within a part.
    pub fn even(
        first: f64,
        interval: f64,
        count: u64,
        (from, to): (Option<f64>, Option<f64>),
    ) -> Timing {
        // a cast of a float is cut at the ends of the integer
        let place = |time: f64| ((time - first) / interval).ceil().max(0.0) as u64;
        let begin = from.map_or(0, place).min(count);
        let end = to
            .map_or(count, |to| place(to).saturating_add(1))
            .min(count);
        Timing {
            begin,
            end,
            first: first + begin as f64 * interval,
            interval,
            range: (first, first + count.saturating_sub(1) as f64 * interval),
            uneven: None,
            clock: 0,
            seconds: 1.0,
            offset: 0.0,
        }
    }
}
