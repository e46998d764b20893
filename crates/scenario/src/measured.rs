//! Measured channels that stand beside predicted columns: `[[measured]]`.
//!
//! ```toml
//! [[measured]]
//! column = "rotor.y"            # a column of the history, as auxbear results lists it
//! file = "test_1.csv"           # that of the table before where it is left out, with its clock
//! channel = "probe y"
//! clock_offset = "12 ms"        # instant of the run at which time 0 of the file lies
//! scale = -1                    # the probe counts the other way
//! unit = "um"                   # where the file has none
//! deviation = "1 um"            # standard deviation of the channel
//! drop = 2                      # of several drops of one machine
//! ```
//! Whether a run has such a column, and the file such a channel, is known when the machine is built: `crates/run/src/measured/mod.rs`.

use crate::bearing::from_catalogue::beside;
use crate::document::Document;
use crate::limit::amount;
use crate::rotor::keys::PartKind;
use crate::system::{OVER_TIME, SystemName};
use problem::key::{Key, Kind, Range, quoted};
use problem::raw::{Raw, Written};
use problem::table::Table;
use problem::{Code, Place, Problem, Result, lasting};
use std::path::PathBuf;
use units::Dimension;

/// The array of tables of measured channels.
pub const MEASURED: &str = "measured";
/// Drops that are compared, at most.
const MOST_DROPS: f64 = 1000.0;
const DEVIATION: &str =
    "a quantity with the unit of the column is needed, e.g. deviation = \"1 um\"";

#[rustfmt::skip]
pub(crate) const KEYS: &[Key<SystemName>] = &[
    Key::new("measured.column", Kind::Text, "rotor.y", "Column of the history that the channel measures, as auxbear results lists it."),
    Key::new("measured.file", Kind::Text, "test_1.csv", "File with the channel, relative to this one: CSV, Parquet, TDMS, UFF 58, MAT, HDF5 or WAV, with a clock.").optional("that of the table before"),
    Key::new("measured.channel", Kind::Text, "probe y", "Channel of the file."),
    Key::new("measured.clock_offset", Kind::Quantity("s"), "12 ms", "Instant of the run at which time 0 of the file lies.").optional("that of the table before where the file is, else 0 s"),
    Key::new("measured.scale", Kind::Coefficient, "-1", "Factor on the values of the file: -1 of a sensor that counts the other way.").default("1", "sensor and column have one direction"),
    Key::new("measured.unit", Kind::Text, "um", "Unit of the values times scale.").optional("that of the channel in the file"),
    Key::new("measured.deviation", Kind::Any(DEVIATION), "1 um", "Standard deviation of a value of the channel.").optional("it is estimated from the values before the release, or not known"),
    Key::new("measured.drop", Kind::Count, "2", "Number of the drop, where several of one machine were measured: those above 1 are also compared with the first.").within(Range::FromTo(1.0, MOST_DROPS)).default("1", "the only one"),
];

/// The table for the schema.
pub(crate) const TABLE: PartKind = PartKind {
    word: MEASURED,
    doc: "Measured channels that stand beside predicted columns.",
    alone: false,
    keys: KEYS,
    starting: &[],
};

/// A measured channel of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// The column that it stands beside.
    pub column: String,
    /// The file.
    pub file: PathBuf,
    /// The channel in it.
    pub channel: String,
    /// Instant of the run at which time 0 of the file lies, s.
    pub clock_offset: f64,
    /// Factor on the values of the file.
    pub scale: f64,
    /// Unit of the values, where it is not that of the file.
    pub unit: Option<String>,
    /// Standard deviation, SI, with its dimension and as a file has it.
    pub deviation: Option<(f64, Dimension, String)>,
    /// Number of the drop.
    pub drop: usize,
    places: Vec<(&'static str, Place)>,
}

impl Measured {
    /// What results and columns call it: the column, of drops after the first with their number.
    pub fn name(&self) -> String {
        self.of_drop(&self.column)
    }

    /// A name with the number of the drop behind it; the first has none.
    pub fn of_drop(&self, name: &str) -> String {
        match self.drop {
            1 => name.to_string(),
            drop => format!("{name}.drop_{drop}"),
        }
    }

    /// The table as a file has it.
    pub(crate) fn toml(&self) -> String {
        let mut text = format!(
            "[[{MEASURED}]]\ncolumn = {}\nfile = {}\nchannel = {}\nclock_offset = \"{} s\"\nscale = {}\ndrop = {}\n",
            quoted(&self.column),
            quoted(&self.file.display().to_string()),
            quoted(&self.channel),
            units::number_text(self.clock_offset),
            units::number_text(self.scale),
            self.drop
        );
        let unit = self.unit.as_ref().map(|unit| ("unit", quoted(unit)));
        let deviation = self.deviation.as_ref();
        let deviation = deviation.map(|(.., text)| ("deviation", text.clone()));
        for (key, value) in unit.into_iter().chain(deviation) {
            text.push_str(&format!("{key} = {value}\n"));
        }
        text
    }

    /// A problem with one of its keys, with its line.
    pub fn problem(&self, code: Code, key: &str, found: String, allowed: String) -> Box<Problem> {
        let known = self.places.iter().find(|(name, _)| *name == key);
        let place = known.or(self.places.first()).map(|(_, place)| *place);
        Problem::new(code, crate::UNNAMED, found, allowed)
            .at(place.unwrap_or_default())
            .on_key(format!("{MEASURED}.{key}"))
    }
}

/// An override `measured.COLUMN.KEY` of a table, of another drop behind `COLUMN.drop_2`.
pub(crate) fn set(document: &mut Document, path: &[String], raw: Raw) -> Result<()> {
    let key = path.last().cloned().unwrap_or_default();
    let named = path[1..path.len() - 1].join(".");
    let name = |table: &Vec<Written>| {
        let of =
            |key: &str| (table.iter().find(|(own, ..)| own == key)).map(|(_, raw, _)| raw.shown());
        let drop = of("drop").filter(|drop| drop != "1");
        of("column").unwrap_or_default()
            + &drop.map_or(String::new(), |drop| format!(".drop_{drop}"))
    };
    let names: Vec<String> = document.measured.iter().map(name).collect();
    let Some(place) = names.iter().position(|own| *own == named) else {
        let names = names.join(", ");
        let allowed = format!(
            "measured.COLUMN.KEY is needed, with one of the columns of [[measured]]: {names}"
        );
        let problem = Problem::new(Code::UnknownKey, &document.file, quoted(&named), allowed);
        return Err(problem.at(Place::Set).on_key(path.join(".")));
    };
    let table = &mut document.measured[place];
    table.retain(|(own, ..)| *own != key);
    table.push((key, raw, Place::Set));
    Ok(())
}

/// The measured channels of a file.
pub(crate) fn of(document: &Document) -> Result<Vec<Measured>> {
    let mut all: Vec<Measured> = Vec::new();
    for written in &document.measured {
        let head = (MEASURED.to_string(), "[[measured]]");
        let table = Table::read(&document.file, head, KEYS, written, &[])?;
        if !OVER_TIME.contains(&document.system) {
            let systems = SystemName::list(OVER_TIME);
            let found = "a section that has no effect";
            let allowed = format!(
                "it is used only with system = {systems}: nothing else is computed over time"
            );
            return table.refuse(Code::UnusedKey, "", found, allowed);
        }
        let before = all.last();
        let (file, same_clock) = match (table.text("file"), before) {
            (Some(file), _) => (lasting(beside(&document.file, file)), 0.0),
            (None, Some(before)) => (before.file.clone(), before.clock_offset),
            (None, None) => {
                let allowed = "file = \"…\" is needed of the first [[measured]]";
                return table.refuse(Code::MissingKey, "file", "no value", allowed);
            }
        };
        let deviation = table.raw("deviation").map(|raw| {
            let wrong = |(code, found, hint): (Code, String, Option<String>)| {
                (table.problem(code, "deviation", found, DEVIATION)).with_hint(hint)
            };
            amount(raw).map_err(wrong)
        });
        let deviation = deviation.transpose()?;
        if let Some((value, _, text)) = &deviation
            && *value <= 0.0
        {
            return table.refuse(Code::OutOfRange, "deviation", text, "one above 0 is needed");
        }
        let measured = Measured {
            column: table.text("column").unwrap_or_default().to_string(),
            file,
            channel: table.text("channel").unwrap_or_default().to_string(),
            clock_offset: table.number("clock_offset").unwrap_or(same_clock),
            scale: table.needed("scale"),
            unit: table.text("unit").map(str::to_string),
            deviation,
            drop: table.count("drop").unwrap_or(1),
            places: (KEYS
                .iter()
                .map(Key::name)
                .filter(|key| table.known.contains_key(key)))
            .map(|key| (key, table.place_of(key)))
            .collect(),
        };
        let record = |own: &Measured| {
            (
                own.file.clone(),
                own.channel.clone(),
                own.clock_offset.to_bits(),
            )
        };
        let is_same =
            |own: &&Measured| own.drop != measured.drop && record(own) == record(&measured);
        if let Some(other) = all.iter().find(is_same) {
            let found = format!("the record of drop {} once more", other.drop);
            let allowed =
                "another channel, file or clock_offset is needed: each drop is measured by itself";
            return table.refuse(Code::Conflict, "drop", found, allowed);
        }
        if measured.scale == 0.0 {
            return table.refuse(
                Code::OutOfRange,
                "scale",
                "0",
                "a factor that is not 0 is needed",
            );
        }
        if all.iter().any(|other| other.name() == measured.name()) {
            let found = format!("{} twice", quoted(&measured.name()));
            let allowed = "each column once is needed; that of another drop has drop = 2";
            return table.refuse(Code::Conflict, "column", found, allowed);
        }
        all.push(measured);
    }
    Ok(all)
}
