//! Matrices of quantities, and filters: quotients of polynomials.

use crate::key::{Key, quoted};
use crate::raw::Raw;
use crate::read::Reader;
use crate::read_rows::{BARE, cell};
use crate::value::Value;
use crate::{Code, Place, Result};

/// Names of the polynomials of a filter.
pub const POLYNOMIALS: [&str; 2] = ["numerator", "denominator"];

/// What is wrong: code, what was found and a hint.
type Wrong = (Code, String, Option<String>);

/// Entries in SI, as a file has them.
type Row = (Vec<f64>, String);

impl Reader<'_> {
    /// Reads rows of equally many entries, each row in one of these units.
    pub(crate) fn read_matrix<S>(
        &self,
        key: &Key<S>,
        units: &[&'static str],
        raw: &Raw,
        place: Place,
    ) -> Result<(Value, String)> {
        let wrong = |(code, found, hint): Wrong| {
            self.problem(code, place, found, key.needed())
                .with_hint(hint)
        };
        let (mut rows, mut texts, mut of_rows) = (Vec::<Vec<f64>>::new(), Vec::new(), Vec::new());
        for (number, list) in (1..).zip(entries(raw).map_err(wrong)?) {
            let read = |unit: &&'static str| {
                let (row, text) = row(list, |_| (*unit).to_string())?;
                Ok((row, text, *unit))
            };
            let (row, text, unit) = first_right(units, read).map_err(|(code, found, hint)| {
                wrong((code, format!("{found} of row {number}"), hint))
            })?;
            if let Some(first) = rows.first().filter(|first| first.len() != row.len()) {
                let found = format!(
                    "{} values in row {number}, {} in row 1",
                    row.len(),
                    first.len()
                );
                return Err(wrong((Code::WrongType, found, None)));
            }
            rows.push(row);
            texts.push(text);
            of_rows.push(unit);
        }
        let text = format!("[{}]", texts.join(", "));
        Ok((Value::Matrix(rows, of_rows), text))
    }

    /// Reads a list of filters, or one, each a numerator over a denominator: coefficients of s, the highest power first.
    pub(crate) fn read_filters<S>(
        &self,
        key: &Key<S>,
        raw: &Raw,
        place: Place,
    ) -> Result<(Value, String)> {
        let wrong = |(code, found, hint): Wrong| {
            self.problem(code, place, found, key.needed())
                .with_hint(hint)
        };
        let all = match raw {
            Raw::Table(_) => std::slice::from_ref(raw),
            list => entries(list).map_err(wrong)?,
        };
        let (mut filters, mut texts) = (Vec::new(), Vec::new());
        for (number, raw) in (1..).zip(all) {
            let (filter, text) = filter(raw).map_err(|(code, found, hint)| {
                wrong((code, format!("{found} of filter {number}"), hint))
            })?;
            filters.push(filter);
            texts.push(text);
        }
        Ok((Value::Filters(filters), format!("[{}]", texts.join(", "))))
    }
}

/// The entries of a list that is not empty.
fn entries(raw: &Raw) -> Result<&[Raw], Wrong> {
    match raw {
        Raw::List(list) if !list.is_empty() => Ok(list),
        Raw::List(_) => Err((Code::WrongType, "an empty list".to_string(), None)),
        other => Err((Code::WrongType, other.text(), None)),
    }
}

/// What reads without a problem with one of these, else the problem with the first of them.
fn first_right<U, T>(all: &[U], read: impl Fn(&U) -> Result<T, Wrong>) -> Result<T, Wrong> {
    let first = read(&all[0]);
    match first {
        Ok(right) => Ok(right),
        Err(wrong) => all[1..]
            .iter()
            .find_map(|other| read(other).ok())
            .ok_or(wrong),
    }
}

/// Reads a row whose entries have these units; zero needs none.
fn row(raw: &Raw, unit: impl Fn(usize) -> String) -> Result<Row, Wrong> {
    let (mut values, mut texts) = (Vec::new(), Vec::new());
    for (at, raw) in entries(raw)?.iter().enumerate() {
        let unit = match raw {
            Raw::Integer(_, Some(0)) => BARE.to_string(),
            Raw::Float(value) if *value == 0.0 => BARE.to_string(),
            _ => unit(at),
        };
        let (value, text) = cell(raw, &unit).map_err(|(code, found, hint)| {
            let unit = if unit == BARE { "a bare number" } else { &unit };
            (
                code,
                format!("{found} in place of {unit} as value {}", at + 1),
                hint,
            )
        })?;
        values.push(value);
        texts.push(match raw {
            Raw::Text(_) => quoted(&text),
            _ => text,
        });
    }
    Ok((values, format!("[{}]", texts.join(", "))))
}

/// Reads a filter. One coefficient of its denominator has no unit, the first or another; those of lower powers of s have one
/// more 1/s each.
fn filter(raw: &Raw) -> Result<([Vec<f64>; 2], String), Wrong> {
    let wrong = |found: String| (Code::WrongType, found, None);
    let Raw::Table(parts) = raw else {
        return Err(wrong(format!("{} in place", raw.text())));
    };
    if let Some((other, _)) = parts.iter().find(|part| !POLYNOMIALS.contains(&&*part.0)) {
        return Err((Code::UnknownKey, format!("the unknown key {other}"), None));
    }
    let part = |name: &str| {
        let part = parts.iter().find(|part| part.0 == name);
        part.map(|part| &part.1)
            .ok_or_else(|| wrong(format!("no {name}")))
    };
    let [above, below] = [part(POLYNOMIALS[0])?, part(POLYNOMIALS[1])?];
    let length = |raw: &Raw| entries(raw).map(|list| list.len() as i64);
    let (over, order) = (length(above)?, length(below)?);
    let read = |without: &i64| {
        let coefficients = |name: &str, raw: &Raw, from: i64| {
            row(raw, |at| power_of_seconds(from - at as i64))
                .map_err(|(code, found, hint)| (code, format!("{found} of the {name}"), hint))
        };
        let [numerator, denominator] = POLYNOMIALS;
        let (den, den_text) = coefficients(denominator, below, *without)?;
        let (num, num_text) = coefficients(numerator, above, without + over - order)?;
        let text = format!("{{ numerator = {num_text}, denominator = {den_text} }}");
        Ok(([num, den], text))
    };
    first_right(&(0..order).collect::<Vec<_>>(), read)
}

/// A power of the second as a unit.
pub fn power_of_seconds(power: i64) -> String {
    match power {
        0 => BARE.to_string(),
        1 => "s".to_string(),
        -1 => "1/s".to_string(),
        2.. => format!("s^{power}"),
        _ => format!("1/s^{}", -power),
    }
}
