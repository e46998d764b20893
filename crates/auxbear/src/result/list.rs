//! Named results: how they are collected, and what each states of its origin.

use crate::result::declared::{Declared, Kind};
use crate::result::outcome::{Quantity, Value};

/// Law, source and valid range of a kind of result.
#[derive(Debug)]
pub(crate) struct Origin {
    pub law: &'static str,
    pub source: &'static str,
    pub valid: &'static str,
}

/// How the reason ends of a result that cannot be had because its key was left out: known before the run.
pub(crate) const NOT_GIVEN: &str = " is not given";
/// Why a result has no value before a run.
const BEFORE_THE_RUN: &str = "not known before the run";

/// Named results in their order.
#[derive(Default)]
pub(crate) struct List {
    pub quantities: Vec<Quantity>,
    /// What stands for each `*` of a declared name.
    stars: Vec<String>,
}

impl From<f64> for Value {
    fn from(value: f64) -> Value {
        match value.is_finite() {
            true => Value::Number(value),
            false => Value::None {
                why: format!("the run ended with {value} here"),
            },
        }
    }
}

impl<T: Into<Value>> From<Result<T, String>> for Value {
    fn from(value: Result<T, String>) -> Value {
        value.map_or_else(|why| Value::None { why }, Into::into)
    }
}

impl From<Vec<f64>> for Value {
    fn from(values: Vec<f64>) -> Value {
        Value::List(values)
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Value {
        Value::Text(text.to_string())
    }
}

impl From<String> for Value {
    fn from(text: String) -> Value {
        Value::Text(text)
    }
}

impl List {
    /// Adds a declared result: its value, or before a run none.
    pub fn add(&mut self, declared: &'static Declared, value: Option<Value>) {
        let mut name = declared.name.to_string();
        for star in &self.stars {
            name = name.replacen('*', star, 1);
        }
        let value = value.unwrap_or_else(|| match declared.kind {
            Kind::number | Kind::instant => Value::None {
                why: BEFORE_THE_RUN.to_string(),
            },
            Kind::list => Value::List(Vec::new()),
            Kind::text => Value::Text(BEFORE_THE_RUN.to_string()),
        });
        self.push(&name, declared.unit, value, declared.origin);
        if let Some(last) = self.quantities.last_mut() {
            last.meaning = declared.meaning;
            last.awaited = declared.kind == Kind::instant;
        }
    }
    /// Adds results whose names have something in the place of each `*`.
    pub fn named(&mut self, stars: &[&str], add: impl FnOnce(&mut List)) {
        let stars = stars.iter().map(ToString::to_string).collect();
        let before = std::mem::replace(&mut self.stars, stars);
        add(self);
        self.stars = before;
    }
    /// Adds results of each of what a run finds, numbered from 1 in the place of `*`; before the run once, with the `*` itself.
    pub fn numbered<T>(&mut self, found: Option<&[T]>, add: impl Fn(&mut List, Option<&T>)) {
        let Some(found) = found else {
            return self.named(&["*"], |list| add(list, None));
        };
        for (number, one) in (1..).zip(found) {
            self.named(&[&format!("{number}")], |list| add(list, Some(one)));
        }
    }
    /// Adds results of a part, whose names follow its own and a point; a part without a name adds nothing to them.
    #[allow(dead_code)]
    pub fn of_part(&mut self, part: &str, add: impl FnOnce(&mut List)) {
        let first = self.quantities.len();
        add(self);
        for quantity in &mut self.quantities[first..] {
            quantity.name = model::system::layout::of_part(part, &quantity.name);
        }
    }
    pub fn push(&mut self, name: &str, unit: &'static str, value: Value, origin: &Origin) {
        self.quantities.push(Quantity {
            name: name.to_string(),
            value,
            unit,
            meaning: "",
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
        if let Some(last) = self.quantities.last_mut() {
            last.awaited = true;
        }
    }
    /// The results of a run that ended at an instant, s: no number has a value where it ended before its first step.
    pub fn ended_at(mut self, time: f64) -> Vec<Quantity> {
        if time == 0.0 {
            for quantity in &mut self.quantities {
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
        self.quantities
    }
    pub fn number(
        &mut self,
        name: &str,
        unit: &'static str,
        value: Result<f64, String>,
        origin: &Origin,
    ) {
        self.push(name, unit, value.into(), origin);
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
