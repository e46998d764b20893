//! What a key takes, as its kind and range say.

use crate::key::{Key, Kind, Range};
use crate::system::SystemName;
use serde_json::{Value, json};

/// A number and a unit. Which unit is for the program to judge.
pub(super) const QUANTITY: &str =
    r"^\s*[+\-−]?(\d+\.?\d*|\.\d+)([eE][+\-]?\d+)?\s*(1/.+|1\s*|[^\s\d.,+\-/^)]([^\d+\-].*)?)$";

/// A number or a fraction of whole numbers.
const FRACTION: &str = r"^\s*[+\-]?\d*\.?\d*\s*(/\s*[+\-]?\d+\s*)?$";

/// What a file has of a key, without where it comes from.
pub(super) fn plain(key: &Key, system: SystemName) -> Value {
    let quantity = json!({ "type": "string", "pattern": QUANTITY });
    let quantity_or = |other: Value| json!({ "anyOf": [quantity, other] });
    match key.kind {
        Kind::Quantity(_) if key.prefix.is_some() => json!({ "type": "string" }),
        Kind::Quantity(_) | Kind::ContactStiffness { .. } => quantity,
        Kind::Coefficient => number("number", key.range),
        Kind::Count => number("integer", key.range),
        Kind::Exponent => json!({ "anyOf": [
            number("number", key.range),
            { "type": "string", "pattern": FRACTION },
        ] }),
        Kind::Word(_) if key.path == "system" => json!({ "enum": [system.word()] }),
        Kind::Word(words) => json!({ "enum": words }),
        Kind::Switch => json!({ "type": "boolean" }),
        Kind::Any(_) => json!({}),
        Kind::Text => json!({ "type": "string" }),
        Kind::Quantities(_) | Kind::Series(_) => one_or_several(&quantity),
        Kind::Words(words) => one_or_several(&json!({ "enum": words })),
        Kind::Texts => one_or_several(&json!({ "type": "string" })),
        Kind::Matrix(_) => list_of(&list_of(&quantity_or(json!({ "const": 0 })))),
        Kind::Filters => {
            let row = list_of(&quantity_or(json!({ "type": "number" })));
            list_of(&json!({
                "type": "object",
                "properties": { "numerator": row, "denominator": row },
                "required": ["numerator", "denominator"],
                "additionalProperties": false,
            }))
        }
        Kind::Table(_, "1") => json!({
            "type": "array",
            "minItems": 2,
            "items": { "type": "array", "prefixItems": [quantity, { "type": "number" }], "minItems": 2, "maxItems": 2 },
        }),
        Kind::Table(..) => json!({
            "type": "array",
            "minItems": 2,
            "items": { "type": "array", "minItems": 2, "maxItems": 2, "items": quantity },
        }),
    }
}

/// One value, or a list of them.
fn one_or_several(entry: &Value) -> Value {
    json!({ "anyOf": [entry, list_of(entry)] })
}

fn list_of(entry: &Value) -> Value {
    json!({ "type": "array", "minItems": 1, "items": entry })
}

/// A bare number in its range; whole numbers are never negative.
fn number(kind: &str, range: Range) -> Value {
    let mut schema = json!({ "type": kind });
    match range {
        Range::Any if kind == "integer" => schema["minimum"] = json!(0),
        Range::Any => {}
        Range::Positive => schema["exclusiveMinimum"] = json!(0),
        Range::NotNegative => schema["minimum"] = json!(0),
        Range::Above(low) => schema["exclusiveMinimum"] = json!(low),
        Range::AboveTo(low, high) => {
            schema["exclusiveMinimum"] = json!(low);
            schema["maximum"] = json!(high);
        }
        Range::FromTo(low, high) => {
            schema["minimum"] = json!(low);
            schema["maximum"] = json!(high);
        }
    }
    schema
}
