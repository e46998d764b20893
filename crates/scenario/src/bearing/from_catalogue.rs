//! Values that a bearing catalogue knows.

use crate::bearing::source::{ARRANGEMENT, BearingRecord, BearingSource};
use crate::document::Document;
use crate::key::{Key, Kind, quoted};
use crate::table;
use crate::values::{Known, Value, Values};
use catalogue::Catalogue;
use catalogue::designation::{self, Designation};
use problem::provenance::Provenance;
use problem::raw::{Input, Raw};
use problem::value::quantity_text;
use problem::{Code, Place, Result, did_you_mean};
use std::path::{Path, PathBuf};

/// Keys outside `[bearing]` that take a value of the rings.
const OF_RINGS: [&str; 10] = [
    "heat.bore_diameter",
    "heat.outer_diameter",
    "heat.width",
    "contact.bore_diameter",
    "drive.bore_diameter",
    "bearing.fits.bore_diameter",
    "bearing.fits.outer_diameter",
    "bearing.moment.bore_diameter",
    "bearing.moment.outer_diameter",
    "bearing.moment.contact_angle",
];

/// Key of the user's own catalogue.
const CATALOGUE: &str = "catalogue";

impl Values {
    /// The catalogue with the user's own bearings, where the file names one.
    pub fn own_catalogue(&self, document: &Document) -> Result<Option<Catalogue>> {
        let key = table::key(CATALOGUE);
        let (Some(key), Some(given)) = (key, document.values.get(CATALOGUE)) else {
            return Ok(None);
        };
        let path = beside(&document.file, &self.reader(key).read(key, given)?.text);
        let catalogue = Catalogue::with_file(&path).map_err(|mut problem| {
            if problem.hint.is_none() {
                problem.hint = Some(format!("It is named by catalogue in {}", document.file));
            }
            problem
        })?;
        Ok(Some(catalogue))
    }

    /// The path of the user's own catalogue or measurement as it is found from any folder: the resolved file stands in another one.
    pub fn lasting_path(&self, key: &Key, known: Known) -> Known {
        if key.path != CATALOGUE && !table::names_files(key) {
            return known;
        }
        let lasting = |text: &String| {
            problem::lasting(beside(self.file(), text))
                .display()
                .to_string()
        };
        match &known.value {
            Value::Texts(texts) => {
                let texts: Vec<String> = texts.iter().map(lasting).collect();
                let quoted: Vec<String> = texts.iter().map(|text| quoted(text)).collect();
                Known {
                    text: format!("[{}]", quoted.join(", ")),
                    value: Value::Texts(texts),
                    ..known
                }
            }
            _ => {
                let text = lasting(&known.text);
                Known {
                    value: Value::Text(text.clone()),
                    text,
                    ..known
                }
            }
        }
    }

    /// The catalogue's knowledge of the bearing named. It comes first, because other sections take values from it.
    pub fn find_bearing(
        &self,
        document: &Document,
        bearings: &dyn BearingSource,
    ) -> Result<Option<BearingRecord>> {
        let given = document.values.get("bearing.name");
        let key = table::key("bearing.name");
        let (Some(key), Some(given)) = (key, given) else {
            return Ok(None);
        };
        let known = self.reader(key).read(key, given)?;
        let name = known.text.as_str();
        if let Some(record) = bearings.find(name) {
            return Ok(Some(record));
        }
        let meant = designation::read(name, &|name| bearings.find(name).is_some());
        if let Some(Designation::Known {
            name, arrangement, ..
        }) = &meant
        {
            let words = arrangement.map(|own| {
                let origin = format!("the {own} in bearing.name");
                let (key, word) = (ARRANGEMENT.to_string(), own.to_string());
                (key, word, Provenance::Derived(origin))
            });
            let record = bearings.find(name);
            return Ok(record.map(|mut record| {
                record.words.extend(words);
                record
            }));
        }
        let names = bearings.names();
        let mut listed: Vec<&str> = names.iter().map(String::as_str).collect();
        let mut near = did_you_mean(name, listed.iter().copied());
        listed.truncate(12);
        let allowed = if let Some(Designation::Missing(why)) = meant {
            near = None;
            why
        } else if listed.is_empty() {
            "the catalogue is empty; give the dimensions of the bearing instead of its name"
                .to_string()
        } else {
            format!(
                "a bearing of the catalogue is needed ({}{}), or its dimensions instead of its name",
                listed.join(", "),
                if names.len() > listed.len() {
                    ", …"
                } else {
                    ""
                }
            )
        };
        Err(self
            .problem(
                Code::UnknownBearing,
                "bearing.name",
                known.place,
                format!("\"{name}\", which is not in the catalogue"),
                allowed,
            )
            .with_hint(near))
    }

    pub(crate) fn catalogued(
        &self,
        key: &Key,
        record: Option<&BearingRecord>,
    ) -> Result<Option<Known>> {
        let Some(record) = record else {
            return Ok(None);
        };
        let name = match key.section() {
            "bearing" => key.name(),
            _ if OF_RINGS.contains(&key.path) => key.name(),
            _ => return Ok(None),
        };
        if let Kind::Word(_) = key.kind {
            return self.catalogued_word(key, name, record);
        }
        let Some((_, si, provenance)) = record.values.iter().find(|(known, ..)| known == name)
        else {
            return Ok(None);
        };
        let (value, text) = match key.kind {
            Kind::Quantity(_) => (Value::Number(*si), quantity_text(key, *si)),
            Kind::Count => (Value::Count(*si as u64), format!("{}", *si as u64)),
            Kind::Coefficient => (Value::Number(*si), format!("{si:?}")),
            _ => return Ok(None),
        };
        if !key.range.holds(*si) {
            return Err(self.problem(
                Code::OutOfRange,
                key.path,
                Place::Whole,
                format!("{text} in the catalogue for \"{}\"", record.name),
                key.needed(),
            ));
        }
        Ok(Some(Known {
            value,
            text,
            provenance: provenance.clone(),
            place: Place::Whole,
            filled_in: false,
        }))
    }

    fn catalogued_word(
        &self,
        key: &Key,
        name: &str,
        record: &BearingRecord,
    ) -> Result<Option<Known>> {
        let Some((_, word, provenance)) = record.words.iter().find(|(known, ..)| known == name)
        else {
            return Ok(None);
        };
        let given = Input {
            raw: Raw::Text(word.clone()),
            typed: None,
            place: Place::Whole,
        };
        let mut known = self.reader(key).read(key, &given)?;
        known.provenance = provenance.clone();
        Ok(Some(known))
    }
}

/// A path relative to the file that names it.
pub(crate) fn beside(file: &str, path: &str) -> PathBuf {
    Path::new(file).parent().unwrap_or(Path::new("")).join(path)
}
