//! Warnings: what a user should know before trusting the numbers. Each home declares its own in one table:
//!
//! ```
//! use problem::{warning::Warning, warnings};
//!
//! warnings! {
//!     /// Of a drop.
//!     enum DropWarning {
//!         BackwardWhirl { turns: "1" } "AB1014" Destroys ("Backward whirl: {turns:.0} turns round the bore against the spin.");
//!     }
//! }
//! let warning = Warning::from(DropWarning::BackwardWhirl { turns: 3.0 });
//! assert_eq!(warning.of_part("drive_end").to_string(), "drive_end: Backward whirl: 3 turns round the bore against the spin.");
//! ```
//!
//! A row has the fields of its variant with their kinds, a code, a severity and the sentence with its arguments, as `format!` takes
//! them; behind the word `note`, as [`note!`](crate::note!) does, which keeps its values apart. Kinds of fields: an SI unit (a number),
//! `text` (a name or word that is a value), `words` or `note` (a piece of the sentence alone, which a [`Note`] is). A number `time` in
//! s is the instant of the warning; a text `part` is the part that the sentence names. `[NAME]` behind the code names the kind, for
//! code that joins or leaves out warnings of it. A word behind the severity says in which members of a repeated run it is evaluated:
//! `each`, `unperturbed` or `coast_down`. `by "RESULT"` behind that names the result that it comes from.

use crate::note::Note;
use serde::{Deserialize, Deserializer, Serialize};
use std::collections::BTreeSet;
use std::fmt;
use std::sync::{Mutex, PoisonError};

/// How severe a warning is, the most severe first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Severity {
    /// What the results show destroys bearing, shaft or what stands around it.
    Destroys,
    /// The results are those of another machine, or of laws outside their range.
    Invalid,
    /// Results are less certain than they look.
    Uncertain,
    /// What is left out or assumed.
    Note,
}

impl Severity {
    /// All of them, the most severe first.
    pub const ALL: [Severity; 4] = [
        Severity::Destroys,
        Severity::Invalid,
        Severity::Uncertain,
        Severity::Note,
    ];

    /// The word in files.
    pub fn word(self) -> &'static str {
        match self {
            Severity::Destroys => "destroys",
            Severity::Invalid => "invalid",
            Severity::Uncertain => "uncertain",
            Severity::Note => "note",
        }
    }

    /// The severity of a word.
    pub fn of_word(word: &str) -> Option<Severity> {
        Severity::ALL.into_iter().find(|own| own.word() == word)
    }
}

/// A kind of warning as its table declares it.
#[derive(Debug, PartialEq, Eq)]
pub struct Declared {
    /// Name of the variant.
    pub name: &'static str,
    /// Stable code, e.g. `AB1001`.
    pub code: &'static str,
    /// How severe it is.
    pub severity: Severity,
    /// In which members of a repeated run it is evaluated.
    pub evaluation: Evaluation,
    /// Last part of the name of the result that it comes from: where a run has no value of it, it cannot come; empty where it always can.
    pub by: &'static str,
}

/// In which members of a repeated run a kind of warning is evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Evaluation {
    /// It follows from the file: in the unperturbed one for all.
    File,
    /// In each.
    Each,
    /// In the unperturbed one alone.
    Unperturbed,
    /// In each, but in the coast-down of the unperturbed one alone.
    CoastDown,
}

/// A value of a warning.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Amount {
    /// A number, SI.
    Number(f64),
    /// A name or word.
    Text(String),
}

/// In which members of a repeated run a warning was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Scope {
    /// The run was not repeated, or it concerns all members.
    Alike,
    /// In the unperturbed member alone.
    Unperturbed,
    /// In each: `count` of `all` have it, and the numbers are those of `member`, where it is most severe.
    Each {
        /// Members that have it.
        count: usize,
        /// Members in all.
        all: usize,
        /// Index of the most severe one.
        member: usize,
    },
}

/// A code, a name or unit of a value, or a pattern.
pub type Word = &'static str;
/// A value of a warning: its name, itself, its unit.
pub type Named = (Word, Amount, Word);

/// Something the user should know. Prints as text with part and members.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Warning {
    /// Stable code, e.g. `AB1001`.
    #[serde(deserialize_with = "read_word")]
    pub code: Word,
    /// How severe it is.
    pub severity: Severity,
    /// Name of the bearing, node or test concerned; empty where there is none.
    pub part: String,
    /// Instant, s, where it has one.
    pub time: Option<f64>,
    /// Values with names and units.
    #[serde(deserialize_with = "read_values")]
    pub values: Vec<Named>,
    /// In which members of a repeated run it is evaluated.
    pub evaluation: Evaluation,
    /// How grave it is beside the same of another member.
    pub grade: f64,
    /// In which members it was found.
    pub scope: Scope,
    /// One or two sentences.
    pub text: String,
    /// The same with its values.
    sentence: Note,
    /// Whether the sentences name the part.
    names_part: bool,
}

impl Warning {
    /// A warning of a declared kind; what stands in `time` and `part` of its values becomes its own.
    pub fn new(kind: &Declared, sentence: Note, mut values: Vec<Named>) -> Warning {
        let (mut part, mut time) = (String::new(), None);
        values.retain(|(name, amount, unit)| match (*name, amount, *unit) {
            (_, Amount::Number(value), _) if !value.is_finite() => false,
            ("time", Amount::Number(value), "s") => {
                time = Some(*value);
                false
            }
            ("part", Amount::Text(name), _) => {
                part.clone_from(name);
                false
            }
            _ => true,
        });
        Warning {
            code: kind.code,
            severity: kind.severity,
            names_part: !part.is_empty(),
            part,
            time,
            values,
            evaluation: kind.evaluation,
            grade: 0.0,
            scope: Scope::Alike,
            text: sentence.to_string(),
            sentence,
        }
    }

    /// Whether it is of a kind.
    pub fn is(&self, kind: &Declared) -> bool {
        self.code == kind.code
    }

    /// Both as one, as [`Note::joined`] does; none where they are of two kinds or differ in more than part and numbers.
    pub fn joined(&self, other: &Warning) -> Option<Warning> {
        let sentence = self.sentence.joined(&other.sentence)?;
        let text = sentence.to_string();
        (self.code == other.code).then(|| Warning {
            sentence,
            text,
            ..self.clone()
        })
    }

    /// The same of a part; one without a name adds nothing.
    pub fn of_part(mut self, name: &str) -> Warning {
        if !name.is_empty() {
            self.part = name.to_string();
            self.names_part = false;
        }
        self
    }
}

/// The same text for as long as the process lives: codes, and names and units of values, of which there are few.
fn lasting(text: String) -> Word {
    static KNOWN: Mutex<BTreeSet<&str>> = Mutex::new(BTreeSet::new());
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(own) = known.get(text.as_str()) {
        return own;
    }
    let own = &*text.leak();
    known.insert(own);
    own
}

fn read_word<'de, D: Deserializer<'de>>(file: D) -> Result<Word, D::Error> {
    String::deserialize(file).map(lasting)
}

fn read_values<'de, D: Deserializer<'de>>(file: D) -> Result<Vec<Named>, D::Error> {
    let values = Vec::<(String, Amount, String)>::deserialize(file)?.into_iter();
    let named = values.map(|(name, amount, unit)| (lasting(name), amount, lasting(unit)));
    Ok(named.collect())
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.names_part && !self.part.is_empty() {
            write!(f, "{}: ", self.part)?;
        }
        f.write_str(&self.text)?;
        match self.scope {
            Scope::Alike => Ok(()),
            Scope::Unperturbed => f.write_str(
                " Judged in the unperturbed run alone: the other members keep no histories.",
            ),
            Scope::Each { count, all, member } => write!(
                f,
                " In {count} of {all} members; the numbers are those of member {member}."
            ),
        }
    }
}

/// A table of warnings as an enum; see [`mod@crate::warning`].
#[macro_export]
macro_rules! warnings {
    (@type text) => { String };
    (@type words) => { String };
    (@type note) => { $crate::note::Note };
    (@type $unit:literal) => { f64 };
    (@evaluation) => { $crate::warning::Evaluation::File };
    (@evaluation each) => { $crate::warning::Evaluation::Each };
    (@evaluation unperturbed) => { $crate::warning::Evaluation::Unperturbed };
    (@evaluation coast_down) => { $crate::warning::Evaluation::CoastDown };
    (@declared $variant:ident $code:literal $severity:ident [$($evaluation:ident)?] [$($by:literal)?]) => {
        $crate::warning::Declared {
            name: stringify!($variant),
            code: $code,
            severity: $crate::warning::Severity::$severity,
            evaluation: $crate::warnings!(@evaluation $($evaluation)?),
            by: concat!($($by)?),
        }
    };
    (@constant $vis:vis [] $($kind:tt)*) => {};
    (@constant $vis:vis [$name:ident] $($kind:tt)*) => {
        #[doc = concat!("The kind ", stringify!($($kind)*), ".")]
        $vis const $name: &$crate::warning::Declared = &$crate::warnings!(@declared $($kind)*);
    };
    (@sentence note $($sentence:tt)*) => { $crate::note!($($sentence)*) };
    (@sentence $($sentence:tt)*) => { $crate::note::Note::from(format!($($sentence)*)) };
    (@value $list:ident $field:ident words) => {};
    (@value $list:ident $field:ident note) => {};
    (@value $list:ident $field:ident text) => {
        $list.push((stringify!($field), $crate::warning::Amount::Text($field), ""))
    };
    (@value $list:ident $field:ident $unit:literal) => {
        $list.push((stringify!($field), $crate::warning::Amount::Number($field), $unit))
    };
    ($(#[$doc:meta])* $vis:vis enum $table:ident {
        $($variant:ident $({ $($field:ident: $kind:tt),* $(,)? })? $code:literal $([$name:ident])? $severity:ident $(, $evaluation:ident)? $(by $by:literal)? ($($sentence:tt)*);)*
    }) => {
        $(#[$doc])*
        $vis enum $table {
            $(#[doc = $code] $variant $({ $(#[doc = stringify!($kind)] $field: $crate::warnings!(@type $kind)),* })?,)*
        }

        $($crate::warnings!(@constant $vis [$($name)?] $variant $code $severity [$($evaluation)?] [$($by)?]);)*

        impl $table {
            /// Every kind, in the order of the table.
            pub const DECLARED: &[$crate::warning::Declared] = &[$($crate::warnings!(@declared $variant $code $severity [$($evaluation)?] [$($by)?])),*];
        }

        impl From<$table> for $crate::warning::Warning {
            #[allow(unused_mut)]
            fn from(warning: $table) -> Self {
                match warning {
                    $($table::$variant $({ $($field),* })? => {
                        let kind = $crate::warnings!(@declared $variant $code $severity [$($evaluation)?] [$($by)?]);
                        let sentence = $crate::warnings!(@sentence $($sentence)*);
                        let mut values = Vec::new();
                        $($($crate::warnings!(@value values $field $kind);)*)?
                        $crate::warning::Warning::new(&kind, sentence, values)
                    })*
                }
            }
        }
    };
}
