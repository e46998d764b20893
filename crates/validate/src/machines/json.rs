//! Numbers, lists and vectors in the files.

use number::Vec2;
use serde_json::Value;

pub(crate) fn list<'a>(value: &'a Value, key: &str) -> Result<&'a [Value], String> {
    let list = value[key].as_array().map(Vec::as_slice);
    list.ok_or_else(|| format!("{key} is no list"))
}
pub(crate) fn number(value: &Value, key: &str) -> Result<f64, String> {
    let number = value[key].as_f64().filter(|number| number.is_finite());
    number.ok_or_else(|| format!("{key} is no number"))
}
/// So many numbers.
pub(crate) fn numbers<const N: usize>(value: &Value, key: &str) -> Result<[f64; N], String> {
    let found = value[key].as_array().map(Vec::as_slice).unwrap_or_default();
    let found: Option<Vec<f64>> = found.iter().map(Value::as_f64).collect();
    let found = found.and_then(|list| <[f64; N]>::try_from(list).ok());
    found.ok_or_else(|| format!("{key} is no list of {N} numbers"))
}
pub(super) fn pair(value: &Value) -> Result<Vec2<f64>, String> {
    match (value[0].as_f64(), value[1].as_f64()) {
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
