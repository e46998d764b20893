//! Results as they are declared: once, in a table of the part or system that has them.
//!
//! ```text
//!   results! {
//!       /// Contacts of a bearing.
//!       pub(crate) fn contacts(setup: &Bearing, run: &BearingRun) {
//!           "time_to_first_contact": instant "s", FIRST_CONTACT, "first touch after the release" => run.first_contact();
//!           "peak_contact_force": number "N", CONTACT_FORCE, "largest normal force" when setup.rolling() => run.peak_force();
//!       }
//!   }
//! ```
//! The table becomes a function `contacts(list, setup, run)`. With a run it lists the values; without one it lists the same
//! names, units and meanings, which is how results are known before a run. Whether a row is there follows from the setup alone
//! (`when`), and so does the reason of a result that no such run has (`unless`, an `Option<String>`).
//!
//! Kinds of rows: `number`, `instant` (a number that the run waits for), `list`, `text`. Each `*` of a name stands for what
//! [`List::named`] puts there: the number of a critical speed, the name of a node.

use crate::result::list::Origin;

/// A result as it is declared.
#[derive(Debug)]
pub(crate) struct Declared {
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
}

/// Kinds of values.
#[allow(non_camel_case_types)] // they are the words of the tables
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A number.
    number,
    /// An instant that the run waits for: without a value it is later than the end of the run.
    instant,
    /// A list of numbers.
    list,
    /// A word.
    text,
}

/// Tables of results as functions; see [`crate::result::declared`].
macro_rules! results {
    ($($(#[$doc:meta])* $vis:vis fn $table:ident($setup:ident: &$of:ty, $run:ident: &$after:ty) {
        $($name:literal : $kind:ident $unit:literal, $origin:expr, $meaning:literal $(when $there:expr)? $(, unless $why:expr)? => $value:expr;)*
    })*) => {
        $($(#[$doc])*
        $vis fn $table(list: &mut $crate::result::list::List, $setup: &$of, after: Option<&$after>) {
            let _ = $setup;
            $({
                static DECLARED: $crate::result::declared::Declared = $crate::result::declared::Declared {
                    name: $name,
                    kind: $crate::result::declared::Kind::$kind,
                    unit: $unit,
                    origin: &$origin,
                    meaning: $meaning,
                };
                if true $(&& $there)? {
                    let absent: Option<String> = None$(.or($why))?;
                    let absent = absent.map(|why| $crate::result::outcome::Value::None { why });
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
pub(crate) use results;
