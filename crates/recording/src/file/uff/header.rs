//! The header of a set 58: its eleven lines.

use std::collections::HashMap;

use super::set::{Axis, Body, Set};
use super::text::{Numbers, columns, value};
use crate::Instant;
use crate::file::clock;

/// The header of a set 58 as it stands.
pub struct Header {
    /// Type of the values: 2 and 5 of single, 4 and 6 of double precision, 5 and 6 complex.
    pub ordinate: u64,
    /// Number of values that is stated.
    pub count: u64,
    /// What else is stated; the values are still to be found.
    pub set: Set,
}

/// A remark or label: nothing where it says NONE.
pub fn said(text: &str) -> String {
    let text = text.trim();
    if text.eq_ignore_ascii_case("none") {
        String::new()
    } else {
        text.to_owned()
    }
}

/// Reads the header of a set 58.
pub fn header(lines: &[String]) -> Result<Header, String> {
    let text = |number: usize| lines.get(number).map_or("", String::as_str);
    let form = text(6);
    let spelt: Vec<&[u8]> = Numbers::of(form.as_bytes()).collect();
    let whole = |first: usize, number: usize| -> Option<u64> {
        let fixed = columns(form, first, first + 10).parse().ok();
        // Where the columns are shifted the numbers follow each other.
        let shifted = || std::str::from_utf8(spelt.get(number)?).ok()?.parse().ok();
        if form
            .chars()
            .take(30)
            .all(|c| c == ' ' || c.is_ascii_digit())
        {
            fixed
        } else {
            None
        }
        .or_else(shifted)
    };
    let (Some(ordinate), Some(count)) = (whole(0, 0), whole(10, 1)) else {
        return Err(format!("its form '{}' cannot be read", form.trim()));
    };
    let uneven = whole(20, 2) == Some(0);
    let complex = match ordinate {
        2 | 4 => false,
        5 | 6 => true,
        other => return Err(format!("its values are of type {other}, not 2, 4, 5 or 6")),
    };
    let real = |number: usize| {
        spelt
            .get(number)
            .and_then(|spelling| value(spelling))
            .filter(|number| number.is_finite())
    };
    let denominator = axis(text(9));
    let mut ordinate_axis = axis(text(8));
    if !denominator.unit.is_empty() && !ordinate_axis.unit.is_empty() {
        ordinate_axis.unit = format!("({})/({})", ordinate_axis.unit, denominator.unit);
    }
    let set = Set {
        remarks: std::array::from_fn(|number| said(text(number))),
        complex,
        uneven,
        count: 0,
        first: real(3).unwrap_or(0.0),
        interval: real(4).unwrap_or(0.0),
        abscissa: axis(text(7)),
        ordinate: ordinate_axis,
        body: Body::Text { places: Vec::new() },
    };
    Ok(Header {
        ordinate,
        count,
        set,
    })
}

/// An axis: quantity, three exponents, label, unit.
fn axis(text: &str) -> Axis {
    let quantity = columns(text, 0, 10).parse().unwrap_or(0);
    let letter = |column: usize| text.chars().nth(column).unwrap_or(' ');
    if letter(25) == ' ' && letter(46) == ' ' {
        return Axis {
            quantity,
            label: said(columns(text, 26, 46)),
            unit: said(columns(text, 47, 67)),
        };
    }
    // The columns are shifted: what follows the four numbers is parted by two blanks or more.
    let rest = text.trim_start_matches(|c: char| c == ' ' || c == '-' || c.is_ascii_digit());
    let mut parts = rest
        .split("  ")
        .map(str::trim)
        .filter(|part| !part.is_empty());
    let (label, unit) = (parts.next().unwrap_or(""), parts.next().unwrap_or(""));
    Axis {
        quantity,
        label: said(label),
        unit: said(unit),
    }
}

/// The unit of a quantity in SI, by its number in the format's list.
///
/// Source: SDRC, universal file data set 58, "specific data type" (from memory).
pub fn si_unit(quantity: u32) -> Option<&'static str> {
    Some(match quantity {
        2 | 15 | 21 => "Pa",
        3 => "m/m",
        5 => "K",
        8 => "m",
        9 | 13 => "N",
        11 => "m/s",
        12 => "m/s^2",
        16 => "kg",
        17 => "s",
        18 => "Hz",
        19 => "rpm",
        _ => return None,
    })
}

/// The instant of a remark like `18-Apr-16 13:49:58`, as if it were UTC; none where it is no date.
pub fn date(text: &str) -> Option<Instant> {
    let (day, clock) = text.trim().split_once(' ')?;
    let mut day = day.split('-');
    let (d, m, y) = (
        day.next()?.parse::<i64>().ok()?,
        day.next()?.to_ascii_lowercase(),
        day.next()?,
    );
    let months = [
        "jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec",
    ];
    let m = months.iter().position(|month| *month == m)? as i64 + 1;
    let year = y
        .parse::<i64>()
        .ok()
        .filter(|year| (0..10_000).contains(year))?;
    // Two digits: the format is of 1970 at the earliest.
    let year = match (y.len(), year) {
        (2, 70..) => 1900 + year,
        (2, _) => 2000 + year,
        _ => year,
    };
    let clock: Vec<f64> = clock
        .trim()
        .split(':')
        .map(|part| part.trim().parse().unwrap_or(f64::NAN))
        .collect();
    let [h, min, s] = clock[..] else { return None };
    let sound = (1..=31).contains(&d)
        && (0.0..24.0).contains(&h)
        && (0.0..60.0).contains(&min)
        && (0.0..61.0).contains(&s);
    if !sound {
        return None;
    }
    let seconds = h * 3600.0 + min * 60.0 + s.floor();
    Some(Instant {
        seconds: clock::days(year, m, d) * 86_400 + seconds as i64,
        fraction: s.fract(),
    })
}

/// Gives each name once: a name that was there before gets a number.
pub struct Names(HashMap<String, u64>);

impl Names {
    /// None given yet.
    pub fn new() -> Names {
        Names(HashMap::new())
    }

    /// The name, with a number where it was given before.
    pub fn give(&mut self, name: &str) -> String {
        let mut given = name.to_owned();
        loop {
            let Some(count) = self.0.get_mut(&given) else {
                self.0.insert(given.clone(), 1);
                return given;
            };
            *count += 1;
            given = format!("{name} ({count})");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_seconds_since_1970() {
        let at = |text: &str| date(text).map(|instant| instant.seconds);
        assert_eq!(at("01-Jan-70 00:00:00"), Some(0));
        // By `date -u -d '2016-04-18 13:49:58' +%s`, and likewise for the leap day.
        assert_eq!(at("18-Apr-16 13:49:58"), Some(1_460_987_398));
        assert_eq!(at("29-Feb-2000 23:59:59"), Some(951_868_799));
        assert_eq!(at("Record 1 of Dataset"), None);
        assert_eq!(at("18-Apr-16 25:49:58"), None);
        assert_eq!(at("NONE"), None);
    }

    #[test]
    fn a_name_is_given_once() {
        let mut names = Names::new();
        assert_eq!(
            ["a", "a", "a (2)", "a"].map(|name| names.give(name)),
            ["a", "a (2)", "a (2) (2)", "a (3)"]
        );
    }
}
