//! Tables: rows of two quantities, of which the first rises.

use crate::key::{Key, quoted};
use crate::raw::Raw;
use crate::read::{Reader, described, unreadable};
use crate::value::Value;
use crate::{Code, Place, Result};
use units::{Unit, parse_quantity};

impl Reader<'_> {
    /// Reads the rows of a table; a problem names the row, counted from 1.
    pub(crate) fn read_rows<S>(
        &self,
        key: &Key<S>,
        units: [&str; 2],
        rows: &[Raw],
        place: Place,
    ) -> Result<(Value, String)> {
        let wrong = |code, found: String| self.problem(code, place, found, key.needed());
        if rows.len() < 2 {
            let found = if rows.is_empty() {
                "an empty list"
            } else {
                "a single row"
            };
            let mut problem = wrong(Code::WrongType, found.to_string());
            problem.hint = Some("At least two rows make a table".to_string());
            return Err(problem);
        }
        let mut values: Vec<[f64; 2]> = Vec::new();
        let mut texts: Vec<[String; 2]> = Vec::new();
        for (number, row) in rows.iter().enumerate().map(|(i, row)| (i + 1, row)) {
            let Raw::List(cells) = row else {
                return Err(wrong(
                    Code::WrongType,
                    format!("{} as row {number}", row.text()),
                ));
            };
            let [first, second] = cells.as_slice() else {
                return Err(wrong(
                    Code::WrongType,
                    format!("{} values in row {number}", cells.len()),
                ));
            };
            let read = |raw, unit, which| {
                cell(raw, unit).map_err(|(code, found, hint)| {
                    let mut problem =
                        wrong(code, format!("{found} as {which} value of row {number}"));
                    problem.hint = hint;
                    problem
                })
            };
            let (x, x_text) = read(first, units[0], "first")?;
            let (y, y_text) = read(second, units[1], "second")?;
            if !key.range.holds(y) {
                return Err(wrong(
                    Code::OutOfRange,
                    format!("{} in row {number}", quoted(&y_text)),
                ));
            }
            if x < 0.0 {
                return Err(wrong(
                    Code::OutOfRange,
                    format!("{}, below 0, in row {number}", quoted(&x_text)),
                ));
            }
            if let (Some(last), Some([last_text, _])) = (values.last(), texts.last())
                && x <= last[0]
            {
                return Err(wrong(
                    Code::TableOrder,
                    format!(
                        "{} in row {number}, which is not above {} in row {}",
                        quoted(&x_text),
                        quoted(last_text),
                        number - 1
                    ),
                ));
            }
            values.push([x, y]);
            texts.push([x_text, y_text]);
        }
        let rows: Vec<String> = texts
            .iter()
            .map(|row| {
                let written = |k: usize| match units[k] {
                    BARE => row[k].clone(),
                    _ => quoted(&row[k]),
                };
                format!("[{}, {}]", written(0), written(1))
            })
            .collect();
        Ok((Value::Rows(values), format!("[{}]", rows.join(", "))))
    }
}

/// The unit of what has none: a bare number.
pub(crate) const BARE: &str = "1";

/// One quantity of a row, in SI and as written; else code, what was found and a hint.
pub(crate) fn cell(raw: &Raw, unit: &str) -> Result<(f64, String), (Code, String, Option<String>)> {
    if unit == BARE {
        return match raw {
            Raw::Float(value) if value.is_finite() => Ok((*value, format!("{value:?}"))),
            Raw::Integer(_, Some(value)) => Ok((*value as f64, format!("{:?}", *value as f64))),
            _ => Err((Code::WrongType, raw.text(), None)),
        };
    }
    let Raw::Text(text) = raw else {
        let code = match raw {
            Raw::Integer(..) | Raw::Float(_) => Code::BareNumber,
            _ => Code::WrongType,
        };
        return Err((code, raw.text(), None));
    };
    let text = text.trim();
    let wanted = Unit::parse(unit).ok().map(|unit| unit.dimension());
    let quantity = parse_quantity(text).map_err(|error| unreadable(&error, text, wanted))?;
    if wanted != Some(quantity.dimension) {
        let found = format!("{}, {},", quoted(text), described(quantity.dimension));
        return Err((Code::WrongDimension, found, None));
    }
    Ok((quantity.value_si, text.to_string()))
}
