//! Bearings known by name, with the origin of every number.
//!
//! The data stand in `bearings.toml`, which is part of the program; a user's file adds bearings or replaces built-in
//! ones. Both have the format `auxbear.bearings/1`:
//!
//! ```toml
//! format = "auxbear.bearings/1"
//!
//! [sources]                      # short keys for citations
//! maker = "Maker's catalogue 2024, p. 12"
//!
//! [[bearing]]                    # one bearing; the keys are those of the scenario's [bearing] and a few more
//! name = "my 6205"
//! type = "deep groove"
//! bore_diameter = { value = "25 mm", catalogue = "maker" }
//! ball_diameter = { value = "7.938 mm", assumed = "as other makers" }
//! ball_count = 9                 # without a mark: given by the user
//!
//! [[family]]                     # many bearings: common values, columns, one row each
//! name = "mine {size}"
//! type = "deep groove"
//! columns = [
//!   { note = "size" },           # text for {size} in name, description and notes
//!   { key = "bore_diameter", unit = "mm", catalogue = "maker" },
//!   { key = "ball_count", derived = "from C0 of {size}" },
//! ]
//! rows = [["A", 25, 9], ["B", 30, { value = 9, assumed = "as A" }]]
//! ```
//!
//! A value carries one mark: `catalogue` (a key of `[sources]`), `derived` (how), `assumed` (why); a user's value may go
//! without, then it is `given`. A quantity is a text with unit; a count or ratio is a bare number. What a bearing lacks
//! follows by the rules of `complete.rs`, marked; what contradicts itself is refused.
//!
//! Masses and inertias are those of the bare ring: a sleeve on it belongs to the inner race and is the user's to add.

#![forbid(unsafe_code)]
#![deny(clippy::disallowed_methods, clippy::disallowed_types)]

mod bearing;
mod check;
mod complete;
pub mod designation;
mod draft;
mod family;
mod filter;
pub mod geometry;
mod json;
mod key;
mod meant;
mod read;
mod ring;
mod value;

pub use bearing::{Bearing, Datum, FORMAT, Mark, Origin, Value};
pub use filter::{Filter, FilterTexts};
pub use json::to_json;
pub use meant::Meant;
pub use ring::Ring;

use problem::Result;
use std::path::Path;
use std::sync::OnceLock;

const TEXT: &str = include_str!("bearings.toml");

/// The built-in bearings, in the order of their names.
pub fn bearings() -> &'static [Bearing] {
    static BEARINGS: OnceLock<Vec<Bearing>> = OnceLock::new();
    BEARINGS.get_or_init(|| {
        let mut bearings = built_in(TEXT);
        bearings.sort_by_cached_key(|bearing| natural_pieces(&bearing.name));
        bearings
    })
}

/// The built-in bearing of this name; spaces around it and the case of letters do not matter.
///
/// It reads only those sections of the data in which the first word of the name occurs: a run does not pay for bearings
/// that it does not use.
pub fn find(name: &str) -> Option<&'static Bearing> {
    type Section = (&'static str, OnceLock<Vec<Bearing>>);
    static SECTIONS: OnceLock<Vec<Section>> = OnceLock::new();
    let mut parts = TEXT.split("\n[[");
    let head = parts.next().unwrap_or_default();
    let sections = SECTIONS.get_or_init(|| parts.map(|part| (part, OnceLock::new())).collect());
    let first_word = name.split_whitespace().next()?.to_ascii_lowercase();
    sections.iter().find_map(|(part, read)| {
        if !part.to_ascii_lowercase().contains(&first_word) {
            return None;
        }
        let bearings = read.get_or_init(|| built_in(&format!("{head}\n[[{part}")));
        bearings.iter().find(|bearing| same(&bearing.name, name))
    })
}

fn built_in(text: &str) -> Vec<Bearing> {
    // The text is compiled in and read by a test, so a user never meets this panic.
    read::read(text, "bearings.toml", true).expect("the built-in catalogue is valid")
}

/// Names of all built-in bearings.
pub fn names() -> Vec<String> {
    let name = |bearing: &Bearing| bearing.name.clone();
    bearings().iter().map(name).collect()
}

/// The built-in bearings and those of a user's file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Catalogue {
    added: Vec<Bearing>,
}

impl Catalogue {
    /// The built-in bearings alone.
    pub fn built_in() -> Catalogue {
        Catalogue::default()
    }

    /// The built-in bearings with those of a file, which replace built-in ones of the same name.
    pub fn with_file(path: &Path) -> Result<Catalogue> {
        Catalogue::with_text(
            &problem::read_text(path, "a file of bearings")?,
            &path.display().to_string(),
        )
    }

    /// The same from a text; the name stands for the file in messages.
    pub fn with_text(text: &str, file: &str) -> Result<Catalogue> {
        let mut added = read::read(text, file, false)?;
        for bearing in &mut added {
            bearing.origin = Origin::File {
                file: file.to_string(),
                replaces_built_in: find(&bearing.name).is_some(),
            };
        }
        Ok(Catalogue { added })
    }

    /// The bearing of this name; spaces around it and the case of letters do not matter.
    pub fn find(&self, name: &str) -> Option<&Bearing> {
        let added = self.added.iter().find(|bearing| same(&bearing.name, name));
        added.or_else(|| find(name))
    }

    /// All bearings: those of the user's file in its order, then the built-in ones that they do not replace.
    pub fn iter(&self) -> impl Iterator<Item = &Bearing> {
        let replaced = |name: &str| self.added.iter().any(|added| same(&added.name, name));
        let built_in = bearings().iter();
        self.added
            .iter()
            .chain(built_in.filter(move |bearing| !replaced(&bearing.name)))
    }

    /// Names of all bearings.
    pub fn names(&self) -> Vec<String> {
        self.iter().map(|bearing| bearing.name.clone()).collect()
    }
}

/// Whether two names mean the same bearing.
fn same(a: &str, b: &str) -> bool {
    a.trim().eq_ignore_ascii_case(b.trim())
}

/// What sorts names as people expect: numbers in a name count as numbers.
fn natural_pieces(name: &str) -> Vec<(u64, String)> {
    let mut pieces = Vec::new();
    let mut rest = name;
    while let Some(first) = rest.chars().next() {
        let is_digit = first.is_ascii_digit();
        let end = rest.find(|letter: char| letter.is_ascii_digit() != is_digit);
        let (piece, after) = rest.split_at(end.unwrap_or(rest.len()));
        pieces.push((piece.parse().unwrap_or(u64::MAX), piece.to_string()));
        rest = after;
    }
    pieces
}
