//! Numbers, vectors, lists and words in the files.

use number::Vec2;
use serde_json::Value;

/// The largest size a number of these files may have: products of a few stay finite.
const LARGEST: f64 = 1e30;

pub(super) fn list<'a>(value: &'a Value, key: &str) -> Result<&'a [Value], String> {
    let list = value[key].as_array().map(Vec::as_slice);
    list.ok_or_else(|| format!("{key} is no list"))
}

fn finite(value: &Value) -> Option<f64> {
    value.as_f64().filter(|number| number.abs() <= LARGEST)
}

pub(super) fn number(value: &Value, key: &str) -> Result<f64, String> {
    finite(&value[key]).ok_or_else(|| format!("{key} is no number"))
}

pub(super) fn positive(value: &Value, key: &str) -> Result<f64, String> {
    within(value, key, 1.0 / LARGEST, LARGEST).map_err(|_| format!("{key} is no number above 0"))
}

/// A number between two others, these included.
pub(super) fn within(value: &Value, key: &str, least: f64, most: f64) -> Result<f64, String> {
    let number = number(value, key)?;
    if (least..=most).contains(&number) {
        Ok(number)
    } else {
        Err(format!("{key} is {number}, not {least} to {most}"))
    }
}

pub(super) fn count(value: &Value, key: &str, most: usize) -> Result<usize, String> {
    let number = within(value, key, 1.0, most as f64)?;
    if number.fract() == 0.0 {
        Ok(number as usize)
    } else {
        Err(format!("{key} is no count"))
    }
}

pub(super) fn text<'a>(value: &'a Value, key: &str) -> Result<&'a str, String> {
    let text = value[key].as_str();
    text.ok_or_else(|| format!("{key} is no text"))
}

/// A list of numbers of any length.
pub(super) fn numbers(value: &Value, key: &str) -> Result<Vec<f64>, String> {
    let found: Option<Vec<f64>> = list(value, key)?.iter().map(finite).collect();
    found.ok_or_else(|| format!("{key} is no list of numbers"))
}

/// A list of so many numbers.
pub(super) fn exactly(value: &Value, key: &str, count: usize) -> Result<Vec<f64>, String> {
    let found = numbers(value, key)?;
    if found.len() == count {
        Ok(found)
    } else {
        let has = found.len();
        Err(format!("{key} has {has} numbers, not {count}"))
    }
}

/// So many numbers.
pub(super) fn array<const N: usize>(value: &Value, key: &str) -> Result<[f64; N], String> {
    let found = numbers(value, key).ok();
    let found = found.and_then(|list| <[f64; N]>::try_from(list).ok());
    found.ok_or_else(|| format!("{key} is no list of {N} numbers"))
}

/// So many positive numbers.
pub(super) fn positives<const N: usize>(value: &Value, key: &str) -> Result<[f64; N], String> {
    let found = array(value, key)?;
    match found.iter().all(|number| *number >= 1.0 / LARGEST) {
        true => Ok(found),
        false => Err(format!("{key} has a number that is not above 0")),
    }
}

pub(super) fn pair(value: &Value) -> Result<Vec2<f64>, String> {
    match (finite(&value[0]), finite(&value[1])) {
        (Some(x), Some(y)) => Ok(Vec2::new(x, y)),
        _ => Err("an entry is no pair of numbers".to_string()),
    }
}

pub(super) fn pairs(value: &Value, key: &str, count: usize) -> Result<Vec<Vec2<f64>>, String> {
    let found = list(value, key)?;
    if found.len() != count {
        return Err(format!("{key} has {} entries, not {count}", found.len()));
    }
    found.iter().map(pair).collect()
}
