//! Bearings as JSON.

use super::bearing::{Bearing, Datum, Origin};
use super::key;
use serde_json::{Map, Value as Json, json};

/// The bearings as one JSON text:
/// `{"bearings": [{"name": …, "description": …, "origin": …, "assumed": 3, "values": {"width": {"value": 0.012, "unit": "m",
/// "text": "12 mm", "mark": "catalogue", "note": …}, …}}, …]}`. Numbers are in SI; a word has no unit.
pub fn to_json<'a>(bearings: impl IntoIterator<Item = &'a Bearing>) -> String {
    let list: Vec<Json> = bearings.into_iter().map(bearing).collect();
    let whole = json!({ "bearings": list });
    format!("{whole:#}\n")
}

fn bearing(bearing: &Bearing) -> Json {
    let values: Map<String, Json> = bearing
        .values
        .iter()
        .map(|value| {
            let datum = match &value.datum {
                Datum::Number { si, .. } => json!(si),
                Datum::Word(word) => json!(word),
            };
            let entry = json!({
                "value": datum,
                "unit": unit(&value.key),
                "text": value.text(),
                "mark": value.mark.word(),
                "note": value.note,
            });
            (value.key.clone(), entry)
        })
        .collect();
    let origin = match &bearing.origin {
        Origin::BuiltIn => json!("built-in"),
        Origin::File { file, .. } => json!(file),
    };
    let replaces = matches!(
        bearing.origin,
        Origin::File {
            replaces_built_in: true,
            ..
        }
    );
    json!({
        "name": bearing.name,
        "description": bearing.description,
        "origin": origin,
        "replaces_built_in": replaces,
        "assumed": bearing.assumed_count(),
        "values": values,
    })
}

/// SI unit of a key; "" for counts, ratios and words.
fn unit(name: &str) -> &'static str {
    key::find(name).map_or("", |key| key.unit())
}
