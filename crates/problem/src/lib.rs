//! The one message for wrong input: file, line, key, what was found, what is needed, what was meant.

#![forbid(unsafe_code)]

mod code;
pub mod explain;
mod file;
pub mod key;
pub mod note;
mod place;
pub mod provenance;
pub mod raw;
pub mod read;
mod read_lists;
pub mod read_matrix;
mod read_rows;
pub mod table;
pub mod value;
pub mod warning;
pub mod words;

pub use code::Code;
pub use file::{lasting, open_file, read_text};
pub use place::Place;
use std::fmt;
use std::path::Path;

/// One thing that is wrong with the input, worded so that it can be corrected. Prints as one paragraph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Stable code.
    pub code: Code,
    /// The file, as the user named it.
    pub file: String,
    /// Where in the file.
    pub place: Place,
    /// Dotted path of the key, where one is concerned.
    pub key: Option<String>,
    /// What was found.
    pub found: String,
    /// What is needed or allowed.
    pub allowed: String,
    /// What was probably meant.
    pub hint: Option<String>,
}

/// What is read or made, or what is wrong with it.
pub type Result<T, E = Box<Problem>> = std::result::Result<T, E>;

impl Problem {
    /// A problem of a file as a whole; the other methods add what else is known.
    pub fn new(
        code: Code,
        file: impl Into<String>,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Box<Problem> {
        Box::new(Problem {
            code,
            file: file.into(),
            place: Place::Whole,
            key: None,
            found: found.into(),
            allowed: allowed.into(),
            hint: None,
        })
    }

    /// A problem at a path of the file system.
    pub fn at_path(
        code: Code,
        path: &Path,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Box<Problem> {
        Problem::new(code, path.display().to_string(), found, allowed)
    }

    /// What the TOML reader refuses, as one clause at its place.
    pub fn of_toml(error: &toml::de::Error, text: &str, file: &str) -> Box<Problem> {
        let clauses: Vec<&str> = error.message().lines().map(str::trim).collect();
        let found = format!("what is not valid TOML ({})", clauses.join("; "));
        let needed = "lines of the form key = \"value\" are needed";
        let place = (error.span()).map_or(Place::Whole, |span| Place::of_offset(text, span.start));
        Problem::new(Code::Syntax, file, found, needed).at(place)
    }

    /// Adds the place.
    pub fn at(mut self: Box<Self>, place: Place) -> Box<Problem> {
        self.place = place;
        self
    }

    /// Adds the dotted path of the key.
    pub fn on_key(mut self: Box<Self>, key: impl Into<String>) -> Box<Problem> {
        self.key = Some(key.into());
        self
    }

    /// Adds a hint; `None` adds nothing.
    pub fn with_hint(mut self: Box<Self>, hint: impl Into<Option<String>>) -> Box<Problem> {
        self.hint = hint.into();
        self
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "error[{}]: {}", self.code, self.file)?;
        match self.place {
            Place::Whole => {}
            Place::Line { line, .. } => write!(f, ":{line}")?,
            Place::Set => write!(f, ", --set")?,
        }
        if let Some(key) = &self.key {
            write!(f, ": {}", one_line(key))?;
        }
        write!(f, ": found {}; {}", one_line(&self.found), self.allowed)?;
        if let Some(hint) = &self.hint {
            write!(f, ". {hint}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Problem {}

/// What a user typed, without line breaks and control characters and not longer than a line; a sentence of our own belongs to
/// what is allowed, which is never cut.
fn one_line(text: &str) -> String {
    const LONGEST: usize = 160;
    let clean = text.chars().map(|c| if c.is_control() { ' ' } else { c });
    let mut short: String = clean.clone().take(LONGEST).collect();
    if clean.count() > LONGEST {
        short.push('…');
    }
    short
}

/// The names near a misspelt one, as a question: `did you mean "mass"?`; `None` when none is near.
pub fn did_you_mean<'a>(found: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    question(&units::nearest_names(found, known))
}

/// The names as a question: `did you mean "mass" or "planes"?`; `None` for no names.
pub fn question(names: &[&str]) -> Option<String> {
    let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    (!quoted.is_empty()).then(|| format!("Did you mean {}?", quoted.join(" or ")))
}

#[cfg(test)]
mod tests;
