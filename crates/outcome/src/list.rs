//! Named results, declared once in a table of the part or system that has them, and the list of them that a run fills.
//!
//! ```text
//!   results! {
//!       /// Contacts of a bearing.
//!       pub fn contacts(setup: &Bearing, run: &BearingRun) {
//!           "time_to_first_contact": instant "s", FIRST_CONTACT, "first touch after the release" => run.first_contact();
//!           "peak_contact_force": number "N" headline, CONTACT_FORCE, "largest normal force" when setup.rolling() => run.peak_force();
//!       }
//!   }
//! ```
//! A block may hold several tables. Each becomes a function `contacts(list, setup, run)`. With a run it lists the values; without one it lists the same
//! names, units and meanings, which is how results are known before a run. Whether a row is there follows from the setup alone
//! (`when`), and so does the reason of a result that no such run has (`unless`, an `Option<String>`).
//!
//! A row that is `headline` is among the results that a run prints. `in figure "words"`, once or more, places a result in a figure
//! or table of the fronts, where these words stand for it: fronts ask for figures, not for names.
//!
//! Kinds of rows: `number`, `instant` (a number that the run waits for), `list`, `text`. Each `*` of a name stands for what
//! `List::named` puts there: the number of a critical speed, the name of a node.

use crate::{Quantity, Value};

/// Law, source and valid range of a kind of result.
#[derive(Debug)]
pub struct Origin {
    /// The law.
    pub law: &'static str,
    /// Where it stands.
    pub source: &'static str,
    /// The range in which it holds.
    pub valid: &'static str,
}
/// A result as it is declared.
#[derive(Debug)]
pub struct Declared {
    /// Its name; each `*` stands for a number or name.
    pub name: &'static str,
    /// What kind of value it has.
    pub kind: Kind,
    /// SI unit; empty for texts and counts.
    pub unit: &'static str,
    /// Law, source and valid range.
    pub origin: &'static Origin,
    /// What it is, in a few words.
    pub meaning: &'static str,
    /// Whether it is among those that are looked at first.
    pub headline: bool,
    /// Figures and tables that show it, each with its words there.
    pub shown: &'static [(&'static str, &'static str)],
}

/// Kinds of values.
#[allow(non_camel_case_types)] // they are the words of the tables
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A number.
    number,
    /// An instant that the run waits for: without a value it is later than the end of the run.
    instant,
    /// A number of contacts: zero in a run that ends as planned without one, where it has no value.
    contact,
    /// A list of numbers.
    list,
    /// A word.
    text,
}

/// Origins by their names, each with its law, source and valid range.
#[macro_export]
macro_rules! origins {
    ($($(#[$doc:meta])* $vis:vis $name:ident: law $law:expr, source $source:expr, valid $valid:expr;)*) => {
        $($(#[$doc])*
        $vis const $name: $crate::list::Origin = $crate::list::Origin {
            law: $law,
            source: $source,
            valid: $valid,
        };)*
    };
}
pub use crate::origins;

/// Tables of results as functions; see the head of this file.
#[macro_export]
macro_rules! results {
    ($($(#[$doc:meta])* $vis:vis fn $table:ident($setup:ident: &$of:ty, $run:ident: &$after:ty) {
        $($name:literal : $kind:ident $unit:literal $($headline:ident)?, $origin:expr, $meaning:literal $(in $figure:ident $words:literal)* $(when $there:expr)? $(, unless $why:expr)? => $value:expr;)*
    })*) => {
        $($(#[$doc])*
        $vis fn $table(list: &mut $crate::list::List, $setup: &$of, after: Option<&$after>) {
            let _ = $setup;
            $({
                static DECLARED: $crate::list::Declared = $crate::list::Declared {
                    name: $name,
                    kind: $crate::list::Kind::$kind,
                    unit: $unit,
                    origin: &$origin,
                    meaning: $meaning,
                    headline: {
                        const WORDS: &[&str] = &[$(stringify!($headline))?];
                        !WORDS.is_empty()
                    },
                    shown: &[$((stringify!($figure), $words)),*],
                };
                if true $(&& $there)? {
                    let absent: Option<String> = None$(.or($why))?;
                    let absent = absent.map(|why| $crate::Value::None { why });
                    let value = || after.map(|$run| {
                        let _ = $run;
                        $value.into()
                    });
                    list.add(&DECLARED, absent.or_else(value));
                }
            })*
        })*
    };
}
pub use crate::results;

/// How the reason ends of a result that cannot be had because its key was left out: known before the run.
pub const NOT_GIVEN: &str = " is not given";
/// Why a result has no value before a run.
const BEFORE_THE_RUN: &str = "not known before the run";

impl Quantity {
    /// Why a run cannot have it whatever happens, as far as that is known before.
    pub fn why_never(&self) -> Option<&str> {
        self.value.why_absent().filter(|why| *why != BEFORE_THE_RUN)
    }
}

/// Why a result cannot be had whose key is left out; none where it is given.
pub fn not_given<T>(key: &str, value: Option<T>) -> Option<String> {
    value.is_none().then(|| format!("{key}{NOT_GIVEN}"))
}

/// Named results in their order.
#[derive(Default)]
pub struct List {
    /// What was added.
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
        let filled = |pattern: &str, stars: &[String]| {
            let text = pattern.to_string();
            (stars.iter()).fold(text, |text, star| text.replacen('*', star, 1))
        };
        let name = filled(declared.name, &self.stars);
        let value = value.unwrap_or_else(|| match declared.kind {
            Kind::number | Kind::instant | Kind::contact => Value::None {
                why: BEFORE_THE_RUN.to_string(),
            },
            Kind::list => Value::List(Vec::new()),
            Kind::text => Value::Text(BEFORE_THE_RUN.to_string()),
        });
        // one of many that is not there is no news
        let is_missed = !declared.name.contains('*') || value.why_absent().is_none();
        self.push(
            &name,
            declared.unit,
            declared.meaning,
            value,
            declared.origin,
        );
        if let Some(last) = self.quantities.last_mut() {
            last.awaited = declared.kind == Kind::instant;
            last.of_contacts = declared.kind == Kind::contact;
            last.headline = declared.headline && is_missed;
            let plain: Vec<String> = (self.stars.iter())
                .map(|star| star.replace('_', " "))
                .collect();
            let shown = declared.shown.iter();
            last.shown = shown
                .map(|(figure, words)| (*figure, filled(words, &plain)))
                .collect();
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
    /// Adds a list for each of what a run has found, by its name; before the run the pattern of their names.
    pub fn each_found(
        &mut self,
        found: Option<Vec<(&str, Vec<f64>)>>,
        table: fn(&mut List, &(), Option<&Vec<f64>>),
    ) {
        let Some(found) = found else {
            return self.named(&["*"], |list| table(list, &(), None));
        };
        for (name, values) in &found {
            self.named(&[name], |list| table(list, &(), Some(values)));
        }
    }
    /// Adds results of a part, whose names follow its own and a point; a part without a name adds nothing to them.
    pub fn of_part(&mut self, part: &str, add: impl FnOnce(&mut List)) {
        let first = self.quantities.len();
        add(self);
        for quantity in &mut self.quantities[first..] {
            quantity.name = model::system::layout::of_part(part, &quantity.name);
        }
    }
    /// Adds a result whose name and unit a column has.
    pub fn push(
        &mut self,
        name: &str,
        unit: &'static str,
        meaning: &'static str,
        value: Value,
        origin: &Origin,
    ) {
        self.quantities.push(Quantity {
            name: name.to_string(),
            value,
            unit,
            meaning,
            headline: false,
            law: origin.law,
            source: origin.source,
            valid: origin.valid,
            chaotic: false,
            spread: None,
            awaited: false,
            of_contacts: false,
            shown: Vec::new(),
        });
    }
    /// The results of a run that ended at an instant, s, or of none: no number has a value where it ended before its first step.
    pub fn ended_at(mut self, time: Option<f64>) -> Vec<Quantity> {
        if time == Some(0.0) {
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
}

/// A residual over what it is compared with.
pub fn relative(residual: f64, scale: f64) -> Result<f64, String> {
    if scale > 0.0 {
        Ok(residual / scale)
    } else {
        Err("nothing turned, moved or was dissipated that it could be compared with".to_string())
    }
}
