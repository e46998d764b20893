//! What a scenario asks of a bearing catalogue.

use catalogue::{self, Bearing, Catalogue, Datum};
use problem::provenance::Provenance;

/// Name of the key of how rows stand, which a designation may say.
pub(super) const ARRANGEMENT: &str = "arrangement";

/// A catalogue of bearings, asked by name.
pub trait BearingSource {
    /// The bearing of this name; `None` when it is not known.
    fn find(&self, name: &str) -> Option<BearingRecord>;
    /// All names, for messages.
    fn names(&self) -> Vec<String>;
}

/// What a catalogue knows of one bearing.
#[derive(Clone, Debug, PartialEq)]
pub struct BearingRecord {
    /// Name of the bearing.
    pub name: String,
    /// Key of the `[bearing]` section (and `bore_diameter`), value in SI, and where the value comes from.
    pub values: Vec<(String, f64, Provenance)>,
    /// The same for keys that take a word, such as `ball_material`.
    pub words: Vec<(String, String, Provenance)>,
}

impl BearingRecord {
    /// How its rows stand, where its designation says it.
    pub fn arrangement(&self) -> Option<&str> {
        let mut words = self.words.iter();
        words
            .find(|own| own.0 == ARRANGEMENT)
            .map(|own| own.1.as_str())
    }
}

/// A catalogue without bearings: every dimension stands in the file.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoBearings;

impl BearingSource for NoBearings {
    fn find(&self, _name: &str) -> Option<BearingRecord> {
        None
    }

    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}

/// The built-in catalogue.
#[derive(Clone, Copy, Debug, Default)]
pub struct BuiltIn;

impl BearingSource for BuiltIn {
    fn find(&self, name: &str) -> Option<BearingRecord> {
        catalogue::find(name).map(record)
    }

    fn names(&self) -> Vec<String> {
        catalogue::names()
    }
}

impl BearingSource for Catalogue {
    fn find(&self, name: &str) -> Option<BearingRecord> {
        Catalogue::find(self, name).map(record)
    }

    fn names(&self) -> Vec<String> {
        Catalogue::names(self)
    }
}

fn record(bearing: &Bearing) -> BearingRecord {
    let mut record = BearingRecord {
        name: bearing.name.clone(),
        values: Vec::new(),
        words: Vec::new(),
    };
    for value in &bearing.values {
        let provenance = Provenance::Catalogue {
            bearing: bearing.name.clone(),
            mark: value.mark.word().to_string(),
            source: value.note.clone(),
        };
        let key = value.key.clone();
        match &value.datum {
            Datum::Number { si, .. } => record.values.push((key, *si, provenance)),
            Datum::Word(word) => record.words.push((key, word.clone(), provenance)),
        }
    }
    record
}
