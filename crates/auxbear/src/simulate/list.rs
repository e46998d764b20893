//! Named results: how they are collected, and what each tells of its origin.

use super::outcome::{Quantity, Value};

/// Law, source and valid range of a kind of result.
pub(super) struct Origin {
    pub law: &'static str,
    pub source: &'static str,
    pub valid: &'static str,
}

/// Named results in their order.
pub(super) struct List(pub Vec<Quantity>);

impl List {
    pub fn push(&mut self, name: &str, unit: &'static str, value: Value, origin: &Origin) {
        self.0.push(Quantity {
            name: name.to_string(),
            value,
            unit,
            law: origin.law,
            source: origin.source,
            valid: origin.valid,
            spread: None,
        });
    }
    /// Takes all values back: nothing was computed.
    pub fn clear(&mut self, why: &str) {
        for quantity in &mut self.0 {
            quantity.value = Value::None {
                why: why.to_string(),
            };
        }
    }
    pub fn number(
        &mut self,
        name: &str,
        unit: &'static str,
        value: Result<f64, String>,
        origin: &Origin,
    ) {
        let value = match value {
            Ok(value) if value.is_finite() => Value::Number(value),
            Ok(value) => Value::None {
                why: format!("the run ended with {value} here"),
            },
            Err(why) => Value::None { why },
        };
        self.push(name, unit, value, origin);
    }
}

/// A residual over what it is compared with.
pub(super) fn relative(residual: f64, scale: f64) -> Result<f64, String> {
    if scale > 0.0 {
        Ok(residual / scale)
    } else {
        Err("nothing turned, moved or was dissipated that it could be compared with".to_string())
    }
}

/// A Hertz pressure over its limit.
pub(super) fn share_of_limit(pressure: f64, limit: Option<f64>) -> Result<f64, String> {
    limit.map(|limit| pressure / limit).ok_or_else(|| {
        "no limit is given: for hybrid bearings bearing.hertz_pressure_limit is yours to set"
            .to_string()
    })
}
