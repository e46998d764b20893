//! Named results: how they are collected, and what each states of its origin.

use crate::result::outcome::{Quantity, Value};

/// Law, source and valid range of a kind of result.
pub(crate) struct Origin {
    pub law: &'static str,
    pub source: &'static str,
    pub valid: &'static str,
}

/// How the reason ends of a result that cannot be had because its key was left out: known before the run.
pub(crate) const NOT_GIVEN: &str = " is not given";

/// Named results in their order.
pub(crate) struct List(pub Vec<Quantity>);

impl List {
    pub fn push(&mut self, name: &str, unit: &'static str, value: Value, origin: &Origin) {
        self.0.push(Quantity {
            name: name.to_string(),
            value,
            unit,
            law: origin.law,
            source: origin.source,
            valid: origin.valid,
            chaotic: false,
            spread: None,
            awaited: false,
        });
    }
    /// An instant that the run waits for, s; or why it did not come.
    pub fn awaited(&mut self, name: &str, time: Result<f64, String>, origin: &Origin) {
        self.number(name, "s", time, origin);
        if let Some(last) = self.0.last_mut() {
            last.awaited = true;
        }
    }
    /// The results of a run that ended at an instant, s: no number has a value where it ended before its first step.
    pub fn ended_at(mut self, time: f64) -> Vec<Quantity> {
        if time == 0.0 {
            for quantity in &mut self.0 {
                if matches!(&quantity.value, Value::None { why } if why.ends_with(NOT_GIVEN)) {
                    continue;
                }
                let why = "the run ended before its first step".to_string();
                // what kind of result it is stays known
                quantity.value = match quantity.value {
                    Value::List(_) => Value::List(Vec::new()),
                    Value::Text(_) => Value::Text(format!("not known: {why}")),
                    Value::Number(_) | Value::None { .. } => Value::None { why },
                };
            }
        }
        self.0
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
pub(crate) fn relative(residual: f64, scale: f64) -> Result<f64, String> {
    if scale > 0.0 {
        Ok(residual / scale)
    } else {
        Err("nothing turned, moved or was dissipated that it could be compared with".to_string())
    }
}
