//! Instants of the calendar and times of the day, as loggers write them.

use crate::Instant;
use crate::file::clock;

/// What a text of a time states.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Moment {
    /// An instant of the calendar, without regard to a time zone.
    Instant(Instant),
    /// Seconds since midnight.
    OfDay(f64),
}

impl Moment {
    /// Seconds from an instant, or since midnight, to this.
    pub fn since(&self, start: Option<Instant>) -> f64 {
        match (self, start) {
            (Moment::Instant(now), Some(start)) => {
                let whole = now.seconds.saturating_sub(start.seconds) as f64;
                whole + (now.fraction - start.fraction)
            }
            (Moment::Instant(_), None) => f64::NAN,
            (Moment::OfDay(seconds), _) => *seconds,
        }
    }
}

/// Reads `2024-02-29 12:34:56.789` (with `T`, with `Z`, with a comma), `29.02.2024 12:34:56` or `12:34:56.789`.
pub(super) fn read(cell: &[u8]) -> Option<Moment> {
    let text = std::str::from_utf8(cell).ok()?.trim().trim_end_matches('Z');
    if text.len() > 40 || text.len() < 5 {
        return None;
    }
    let (date, time) = match text.split_once([' ', 'T']) {
        Some((date, time)) => (Some(date), time.trim()),
        None => (None, text),
    };
    let seconds = of_day(time)?;
    let Some(date) = date else {
        return Some(Moment::OfDay(seconds));
    };
    let days = days(date)?;
    let whole = seconds.floor();
    Some(Moment::Instant(Instant {
        seconds: days * 86_400 + whole as i64,
        fraction: seconds - whole,
    }))
}

/// Seconds since midnight of `h:m` or `h:m:s`.
fn of_day(text: &str) -> Option<f64> {
    let mut parts = text.split(':');
    let whole = |part: &str| {
        let plain = (1..=2).contains(&part.len()) && part.bytes().all(|b| b.is_ascii_digit());
        plain.then(|| part.parse::<u32>().ok()).flatten()
    };
    let hour = whole(parts.next()?).filter(|&hour| hour < 24)?;
    let minute = whole(parts.next()?).filter(|&minute| minute < 60)?;
    let second = match parts.next() {
        Some(text) => {
            let text = text.replace(',', ".");
            let plain = text.bytes().all(|b| b.is_ascii_digit() || b == b'.');
            text.parse::<f64>().ok().filter(|&s| plain && s < 61.0)?
        }
        None => 0.0,
    };
    parts.next().is_none().then_some(())?;
    Some(f64::from(hour * 3600 + minute * 60) + second)
}

/// Days from 1970-01-01 to `year-month-day` or `day.month.year`.
fn days(text: &str) -> Option<i64> {
    let number = |text: &str| text.parse::<i64>().ok();
    let mut parts = text.split(['-', '.']);
    let (a, b, c) = (parts.next()?, parts.next()?, parts.next()?);
    parts.next().is_none().then_some(())?;
    let (year, month, day) = match text.contains('.') {
        true => (number(c)?, number(b)?, number(a)?),
        false => (number(a)?, number(b)?, number(c)?),
    };
    let fits = (1..=9999).contains(&year) && (1..=12).contains(&month) && (1..=31).contains(&day);
    fits.then_some(())?;
    Some(clock::days(year, month, day))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_counted_by_the_calendar() {
        // Known days: the epoch, a leap day, and the day 10^9 seconds after the epoch.
        assert_eq!(days("1970-01-01"), Some(0));
        assert_eq!(days("2000-02-29"), Some(11_016));
        assert_eq!(days("09.09.2001"), Some(1_000_000_000 / 86_400));
        assert_eq!(days("2001-13-01"), None);
    }

    #[test]
    fn the_forms_of_loggers_are_read() {
        let expected = Moment::Instant(Instant {
            seconds: 1_000_000_000,
            fraction: 0.5,
        });
        assert_eq!(read(b"2001-09-09 01:46:40.5"), Some(expected));
        assert_eq!(read(b"2001-09-09T01:46:40,5Z"), Some(expected));
        assert_eq!(read(b"09.09.2001 01:46:40.5"), Some(expected));
        assert_eq!(read(b"01:46:40"), Some(Moment::OfDay(6400.0)));
        for other in ["12.5", "1:2", "a:b:c", "2001-09-09", "25:00:00", ""] {
            assert_eq!(read(other.as_bytes()), None, "{other}");
        }
    }
}
