//! Columns of a history, declared once by the code that fills them.
//!
//! ```text
//!   columns! { table, |row|
//!       "rotor.speed": "rad/s", "spin of the rotor" when turns => row.state[spin];
//!       "load_{number}.friction.moment": "N m", "steady moment M under {load} N" => friction(*row, load);
//!   }
//! ```
//! Over the rows of a run each has its values. Over no rows the same code declares names, units and meanings, which is how columns are
//! known before a run. Whether a column is there follows from the setup alone (`when`), but for [`Columns::optional`] ones.

use crate::Column;
use std::fmt::Arguments;

/// Columns over rows.
pub struct Columns<'a, R> {
    /// What was added.
    pub list: Vec<Column>,
    rows: &'a [R],
    optional: bool,
}

/// Columns with names and meanings as formats; see the head of this file.
#[macro_export]
macro_rules! columns {
    ($columns:expr, |$row:ident| $($name:literal : $unit:expr, $meaning:literal $(when $there:expr)? => $value:expr;)*) => {
        $(if true $(&& $there)? {
            $columns.add(format_args!($name), $unit, format_args!($meaning), |$row| $value);
        })*
    };
}
pub use crate::columns;

impl<'a, R> Columns<'a, R> {
    /// None yet.
    pub fn over(rows: &'a [R]) -> Self {
        Columns {
            list: Vec::new(),
            rows,
            optional: false,
        }
    }
    /// Adds one with its value in each row.
    pub fn add(
        &mut self,
        name: Arguments,
        unit: &'static str,
        meaning: Arguments,
        value: impl Fn(&R) -> f64,
    ) {
        self.list.push(Column {
            name: name.to_string(),
            unit,
            meaning: meaning.to_string(),
            optional: self.optional,
            values: self.rows.iter().map(value).collect(),
        });
    }
    /// Adds columns that a run may lack: before it all, after it where it has them.
    pub fn optional(&mut self, there: Option<bool>, add: impl FnOnce(&mut Self)) {
        if there != Some(false) {
            let before = std::mem::replace(&mut self.optional, true);
            add(self);
            self.optional = before;
        }
    }
}
