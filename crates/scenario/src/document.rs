//! The text of a scenario as a list of keys and raw values, each with its place.

use crate::bearing::kind::{FIDELITY, TYPE, is_bushing};
use crate::key::{Key, quoted};
use crate::meant;
use crate::measured::{self, MEASURED};
use crate::not_modelled;
use crate::renamed;
use crate::rotor::keys::{OF_MACHINES, kind_at, kind_within};
use crate::rotor::tables::{self, WrittenPart, is_part};
use crate::several::{self, AUXILIARY_BEARING, LIMIT, PLANES, VARY};
use crate::system::{COASTING_DOWN, SystemName};
use crate::table;
pub use problem::raw::{Input, Raw, as_toml};
use problem::raw::{Written, collect, raw, table_raw, tables};
use problem::{Code, Place, Problem, Result, did_you_mean};
use std::collections::BTreeMap;
use std::ops::Range;
use toml::de::{DeTable, DeValue};

/// All given values by path; every path is a key of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    pub(crate) file: String,
    pub(crate) system: SystemName,
    pub(crate) values: BTreeMap<&'static str, Input>,
    /// Where each section of the text starts.
    pub sections: BTreeMap<String, Place>,
    /// The auxiliary bearing that it is of, where the file tells several apart.
    pub bearing: Option<String>,
    /// Number of rows of all auxiliary bearings.
    pub rows: f64,
    /// What the file gives of each of several auxiliary bearings alone.
    own: Vec<PartValues>,
    /// What repeated runs vary: path, distribution, place.
    pub vary: Vec<Written>,
    /// What results must hold: the keys of each limit.
    pub limits: Vec<Vec<Written>>,
    /// Measured channels beside predicted columns: the keys of each.
    pub measured: Vec<Vec<Written>>,
    /// Parts of a flexible rotor.
    pub parts: Vec<WrittenPart>,
}

/// An auxiliary bearing of several: its name, and the values that it alone has.
#[derive(Clone, Debug, PartialEq)]
struct PartValues {
    name: String,
    values: BTreeMap<&'static str, Input>,
}

/// One key or section of the text, before it is known whether it exists.
struct Entry {
    path: Vec<String>,
    start: usize,
    raw: Option<Raw>,
}

impl Document {
    /// Reads a text and the overrides; refuses what is no TOML and what is no key.
    pub fn read(text: &str, file: &str, sets: &[String]) -> Result<Document> {
        let root = DeTable::parse(text).map_err(|error| Problem::of_toml(&error, text, file))?;
        require_format(text, root.get_ref(), file)?;
        let mut document = Document {
            file: file.to_string(),
            system: find_system(text, root.get_ref(), file, sets)?,
            values: BTreeMap::new(),
            sections: BTreeMap::new(),
            bearing: None,
            rows: 1.0,
            own: Vec::new(),
            vary: Vec::new(),
            limits: Vec::new(),
            measured: Vec::new(),
            parts: Vec::new(),
        };
        let mut entries = Vec::new();
        flatten(document.system, root.get_ref(), &[], &mut entries);
        entries.sort_by_key(|entry| entry.start);
        for entry in entries {
            let place = Place::of_offset(text, entry.start);
            document.add(&entry.path, entry.raw, None, place)?;
        }
        if let Some((key, value)) = root.get_ref().get_key_value(AUXILIARY_BEARING) {
            document.add_bearings(text, key.span().start, value.get_ref())?;
        }
        if let Some((key, value)) = root.get_ref().get_key_value(VARY) {
            document.add_varied(text, key.span().start, value.get_ref())?;
        }
        for (name, list) in [
            (LIMIT, &mut document.limits),
            (MEASURED, &mut document.measured),
        ] {
            if let Some((key, value)) = root.get_ref().get_key_value(name) {
                *list = tables(text, key.span().start, value.get_ref());
            }
        }
        document.parts = tables::read_all(text, root.get_ref(), file, document.system)?;
        for set in sets {
            document.add_override(set)?;
        }
        Ok(document)
    }

    /// One document for each auxiliary bearing, with what the file gives for all and what it gives for that one; the document
    /// itself where the file does not tell several apart.
    pub fn of_each_bearing(&self) -> Result<Vec<Document>> {
        // what is no count is refused where it is read
        let count = |values: &BTreeMap<_, Input>, path| match values.get(path)?.raw.plain()? {
            Raw::Integer(_, Some(count)) => Some((*count).clamp(1, 1000) as f64),
            _ => None,
        };
        let planes = |path| count(&self.values, path).unwrap_or(1.0);
        let rows = |own: &PartValues| count(&own.values, PLANES).unwrap_or(planes(PLANES));
        let whole = planes("rotor.planes");
        let mut document = self.clone();
        document.rows = whole * planes(PLANES);
        if self.own.is_empty() {
            renamed::under_present_keys(&mut document)?;
            return Ok(vec![document]);
        }
        document.rows = whole * self.own.iter().map(rows).sum::<f64>();
        let of = |own: &PartValues| {
            let mut one = Document {
                bearing: Some(own.name.clone()),
                values: own.values.clone(),
                own: Vec::new(),
                ..document.clone()
            };
            renamed::under_present_keys(&mut one)?;
            for (path, given) in &document.values {
                // how the others are modelled says nothing of a ring
                if *path != FIDELITY || !one.values.get(TYPE).is_some_and(is_bushing) {
                    one.values.entry(path).or_insert_with(|| given.clone());
                }
            }
            renamed::under_present_keys(&mut one)?;
            Ok(one)
        };
        self.own.iter().map(of).collect()
    }

    /// The first value of the last row of a table, as it is written.
    pub fn last_of(&self, path: &str) -> Option<String> {
        match self.values.get(path)?.raw.plain()? {
            Raw::List(rows) => match rows.last()? {
                Raw::List(row) => row.first().map(Raw::shown),
                _ => None,
            },
            _ => None,
        }
    }

    /// The analysis of a machine's rotor: the values and parts that both systems have, under the same gravity. `fastest`: the highest
    /// speed of its diagrams where the file gives none, and what says so.
    pub fn rotor_alone(&self, fastest: Option<(String, &str)>) -> Document {
        let system = SystemName::Rotor;
        let mut rotor = self.clone();
        let gravity = [
            ("gravity.acceleration", "analysis.gravity"),
            ("gravity.direction", "analysis.gravity_angle"),
        ];
        for (from, to) in gravity {
            if let Some(given) = rotor.values.remove(from) {
                rotor.values.insert(to, given);
            }
        }
        if let Some((speed, source)) = fastest {
            let text = |text: &str| Raw::Text(text.to_string());
            let keys = [("value", text(&speed)), ("source", text(source))];
            let keys = keys.map(|(key, raw)| (key.to_string(), raw));
            let given = Input {
                raw: Raw::Table(keys.to_vec()),
                typed: None,
                place: Place::Whole,
            };
            rotor.values.entry("analysis.speed_to").or_insert(given);
        }
        (rotor.values).retain(|path, _| table::keys_of(system).any(|key| key.path == *path));
        if let Some(given) = rotor.values.get_mut("system") {
            given.raw = Raw::Text(system.word().to_string());
        }
        rotor.parts.retain(|part| !OF_MACHINES.contains(&part.kind));
        rotor.own.clear();
        rotor.vary.clear();
        rotor.limits.clear();
        rotor.measured.clear();
        Document { system, ..rotor }
    }

    /// Reads the array of tables of several auxiliary bearings.
    fn add_bearings(&mut self, text: &str, start: usize, value: &DeValue<'_>) -> Result<()> {
        let problem = |code, start, found: String, allowed: &str| {
            Problem::new(code, &self.file, found, allowed)
                .at(Place::of_offset(text, start))
                .on_key(AUXILIARY_BEARING)
        };
        if !self.system.has_auxiliary_bearings() {
            let found = "a section that has no effect".to_string();
            let systems = SystemName::list(COASTING_DOWN);
            let allowed = format!("it is used only with system = {systems}");
            return Err(problem(Code::UnusedKey, start, found, &allowed));
        }
        let DeValue::Array(list) = value else {
            let found = raw(value).text();
            return Err(problem(Code::WrongType, start, found, TABLES));
        };
        let mut all = Vec::new();
        for item in list.iter() {
            let start = item.span().start;
            let DeValue::Table(table) = item.get_ref() else {
                let found = raw(item.get_ref()).text();
                return Err(problem(Code::WrongType, start, found, TABLES));
            };
            let Some((key, name)) = table.get_key_value("name") else {
                let found = "an auxiliary bearing without a name".to_string();
                return Err(problem(Code::MissingKey, start, found, NAME));
            };
            let at = key.span().start;
            let name = match name.get_ref() {
                DeValue::String(name) if is_name(name) => name.to_string(),
                DeValue::String(name) => {
                    return Err(problem(Code::UnknownWord, at, quoted(name), NAME));
                }
                other => {
                    return Err(problem(Code::WrongType, at, raw(other).text(), NAME));
                }
            };
            if all.iter().any(|(other, _): &(String, _)| *other == name) {
                let found = format!("the name {} twice", quoted(&name));
                return Err(problem(Code::Conflict, at, found, NAME));
            }
            let mut entries = Vec::new();
            flatten(self.system, table, &[], &mut entries);
            entries.retain(|entry| entry.path != ["name"]);
            entries.sort_by_key(|entry| entry.start);
            all.push((name, entries));
        }
        for (name, entries) in all {
            let mut document = Document {
                bearing: Some(name.clone()),
                values: BTreeMap::new(),
                ..self.clone()
            };
            for entry in entries {
                let place = Place::of_offset(text, entry.start);
                document.add(&entry.path, entry.raw, None, place)?;
            }
            self.sections.append(&mut document.sections);
            self.own.push(PartValues {
                name,
                values: document.values,
            });
        }
        Ok(())
    }

    /// Reads what repeated runs vary; a path may stand in quotes or as nested tables.
    fn add_varied(&mut self, text: &str, start: usize, value: &DeValue<'_>) -> Result<()> {
        let place = Place::of_offset(text, start);
        self.only_drops_vary(place)?;
        let DeValue::Table(table) = value else {
            let found = raw(value).text();
            let allowed = format!("a section [{VARY}] of paths and distributions is needed");
            let problem = Problem::new(Code::WrongType, &self.file, found, allowed);
            return Err(problem.at(place).on_key(VARY));
        };
        collect(text, table, "", &mut self.vary);
        // as they stand in the text: what is drawn first depends on it
        self.vary.sort_by_key(|(_, _, place)| match *place {
            Place::Line { line, column } => (line, column),
            Place::Whole | Place::Set => (0, 0),
        });
        Ok(())
    }

    fn only_drops_vary(&self, place: Place) -> Result<()> {
        if self.system.falls() {
            return Ok(());
        }
        let problem = Problem::new(
            Code::UnusedKey,
            &self.file,
            "a section that has no effect",
            "it is used only with system = \"drop\" or \"machine\", whose runs are repeated",
        );
        Err(problem.at(place).on_key(VARY))
    }

    /// An override of a value that one auxiliary bearing has: its path behind `auxiliary_bearing.NAME`.
    fn add_to_bearing(&mut self, path: &[String], raw: Raw, typed: String) -> Result<()> {
        let named = path.get(1).map_or("", String::as_str);
        let Some(place) = self.own.iter().position(|own| own.name == named) else {
            let names: Vec<String> = self.own.iter().map(|own| quoted(&own.name)).collect();
            let allowed = match names.as_slice() {
                [] => "the file does not name several auxiliary bearings".to_string(),
                names => format!("one of {} is needed", names.join(", ")),
            };
            let problem = Problem::new(Code::UnknownKey, &self.file, quoted(named), allowed);
            return Err(problem.at(Place::Set).on_key(path.join(".")));
        };
        let mut document = Document {
            bearing: Some(named.to_string()),
            values: std::mem::take(&mut self.own[place].values),
            ..self.clone()
        };
        let added = document.add(&path[2..], Some(raw), Some(typed), Place::Set);
        self.own[place].values = document.values;
        added
    }

    pub(crate) fn add_override(&mut self, set: &str) -> Result<()> {
        let unreadable = |found: String| {
            Problem::new(
                Code::UnreadableSet,
                &self.file,
                found,
                "path=value is needed, e.g. --set \"rotor.speed=9000 rpm\"",
            )
            .at(Place::Set)
        };
        let (path, typed) = set
            .split_once('=')
            .ok_or_else(|| unreadable(format!("\"{set}\"")))?;
        let (path, typed) = (path.trim(), typed.trim());
        let path: Vec<String> = path
            .split('.')
            .map(|part| part.trim().to_string())
            .collect();
        if path.iter().any(String::is_empty) || typed.is_empty() {
            return Err(unreadable(format!("\"{set}\"")));
        }
        let raw = as_toml(typed).unwrap_or_else(|| Raw::Text(typed.to_string()));
        if path[0] == VARY {
            let path = path[1..].join(".").replace('"', "");
            self.vary.retain(|(other, ..)| *other != path);
            self.vary.push((path, raw, Place::Set));
            return self.only_drops_vary(Place::Set);
        }
        if let [first, quantity @ .., word] = path.as_slice()
            && first == LIMIT
        {
            let quantity = Raw::Text(quantity.join("."));
            let mut keys = vec![("quantity", quantity), (word.as_str(), raw)];
            // of a warning or a severity
            keys.retain(|(_, raw)| raw != &Raw::Text(String::new()));
            let keys = keys
                .into_iter()
                .map(|(key, raw)| (key.to_string(), raw, Place::Set));
            self.limits.push(keys.collect());
            return Ok(());
        }
        if self.system.has_shaft() && kind_within(&path.join(".")).is_some() {
            return tables::set(&mut self.parts, &self.file, &path, raw);
        }
        if path[0] == MEASURED && path.len() > 1 {
            return measured::set(self, &path, raw);
        }
        if path[0] == AUXILIARY_BEARING {
            return self.add_to_bearing(&path, raw, typed.to_string());
        }
        self.add(&path, Some(raw), Some(typed.to_string()), Place::Set)
    }

    fn add(
        &mut self,
        path: &[String],
        raw: Option<Raw>,
        typed: Option<String>,
        place: Place,
    ) -> Result<()> {
        let dotted = path.join(".");
        let section = table::sections().find(|section| section.path == dotted);
        let bearing = self.bearing.as_deref();
        let shown = match bearing {
            // what no auxiliary bearing has is told under its name all the same
            Some(name) => format!("{AUXILIARY_BEARING}.{name}.{dotted}"),
            None => dotted.clone(),
        };
        let problem = |code, found: String, allowed: String| {
            Problem::new(code, &self.file, found, allowed)
                .at(place)
                .on_key(&shown)
        };
        let below = format!("{dotted}.");
        let of_each =
            |key: &Key| several::of_each_bearing(key.path) && key.path.starts_with(&below);
        let own = match section {
            Some(_) => table::keys_of(self.system).any(of_each),
            None => several::of_each_bearing(&dotted),
        };
        if bearing.is_some() && !own {
            return Err(problem(
                Code::UnknownKey,
                "what no auxiliary bearing has of its own".to_string(),
                "name, planes, contact, mount, bearing and heat are possible".to_string(),
            ));
        }
        let elsewhere = |what: &str, systems: &[SystemName]| {
            problem(
                Code::UnusedKey,
                format!("a {what} that has no effect"),
                format!(
                    "it is used only with system = {}; here it is \"{}\"",
                    SystemName::list(systems),
                    self.system.word()
                ),
            )
        };
        let for_analysis =
            self.system.bends() && path.first().is_some_and(|first| *first == table::ANALYSIS);
        if let Some(section) = section {
            if !section.systems.contains(&self.system) && !for_analysis {
                return Err(elsewhere("section", section.systems));
            }
            return match raw {
                None => {
                    self.sections.insert(shown, place);
                    Ok(())
                }
                Some(raw) => Err(problem(
                    Code::WrongType,
                    raw.text(),
                    format!("a section [{dotted}] with keys is needed"),
                )),
            };
        }
        let key = table::key(&dotted);
        if let Some(key) = key
            && !table::systems(key).contains(&self.system)
            && !for_analysis
        {
            let hint = meant::namesake(path, self.system);
            return Err(elsewhere("key", table::systems(key)).with_hint(hint));
        }
        match (key, raw) {
            (Some(key), Some(raw)) => {
                let given = Input { raw, typed, place };
                self.values.insert(key.path, given);
                Ok(())
            }
            (key, raw) => {
                if key.is_none()
                    && let Some(absent) = not_modelled::of(&dotted, self.system)
                {
                    let found = "a key of what is not modelled yet".to_string();
                    let told = problem(Code::NotModelled, found, absent.allowed());
                    return Err(told.with_hint(absent.hint()));
                }
                let (code, found) = match (key, raw) {
                    (Some(_), _) => (Code::WrongType, "a section".to_string()),
                    (None, None) => (Code::UnknownKey, "an unknown section".to_string()),
                    (None, Some(_)) => (Code::UnknownKey, "an unknown key".to_string()),
                };
                let allowed =
                    key.map_or_else(|| meant::allowed_near(path, self.system), Key::needed);
                let hint = if key.is_none() {
                    meant::meant(path, self.system)
                } else {
                    None
                };
                Err(problem(code, found, allowed).with_hint(hint))
            }
        }
    }
}

const TABLES: &str = "one table [[auxiliary_bearing]] for each is needed";
const NAME: &str = "name = \"drive_end\" is needed: letters, digits, _ and -, each name once";

/// Whether a name can stand before results: no dots, no blanks.
fn is_name(name: &str) -> bool {
    let allowed = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
    !name.is_empty() && name.chars().all(allowed)
}

/// The format comes first: a file of another format would fail on its keys with misleading words.
fn require_format(text: &str, root: &DeTable<'_>, file: &str) -> Result<()> {
    let needed = format!("format = \"{}\" is needed", table::FORMAT);
    let Some((key, value)) = root.get_key_value("format") else {
        return Err(Problem::new(Code::UnknownFormat, file, "nothing", needed).on_key("format"));
    };
    let found = match value.get_ref() {
        DeValue::String(found) if found == table::FORMAT => return Ok(()),
        DeValue::String(found) => format!("\"{found}\""),
        other => raw(other).text(),
    };
    let newer = found
        .starts_with("\"auxbear.scenario/")
        .then(|| "A file of a newer format needs a newer program".to_string());
    Err(Problem::new(Code::UnknownFormat, file, found, needed)
        .at(Place::of_offset(text, key.span().start))
        .on_key("format")
        .with_hint(newer))
}

/// The system comes next: what it does not have is told as such. An override counts, the last of several.
fn find_system(text: &str, root: &DeTable<'_>, file: &str, sets: &[String]) -> Result<SystemName> {
    let needed = format!("one of {} is needed", quoted_words(SystemName::WORDS));
    let problem = |code, found: String, allowed: String| {
        Problem::new(code, file, found, allowed).on_key("system")
    };
    let set = sets.iter().rev().find_map(|set| {
        let (path, typed) = set.split_once('=')?;
        let typed = typed.trim();
        let raw = as_toml(typed).unwrap_or_else(|| Raw::Text(typed.to_string()));
        (path.trim() == "system").then_some((raw, Place::Set))
    });
    let given = || {
        let (key, value) = root.get_key_value("system")?;
        let place = Place::of_offset(text, key.span().start);
        Some((raw(value.get_ref()), place))
    };
    let Some((raw, place)) = set.or_else(given) else {
        return Err(problem(Code::MissingKey, "no value".to_string(), needed));
    };
    let raw = match raw {
        Raw::Table(parts) => match parts.into_iter().find(|(name, _)| name == "value") {
            Some((_, value)) => value,
            None => Raw::Other("a table without value"),
        },
        raw => raw,
    };
    let Raw::Text(word) = raw else {
        return Err(problem(Code::WrongType, raw.text(), needed).at(place));
    };
    if let Some(system) = SystemName::of(&word) {
        return Ok(system);
    }
    Err(if SystemName::PLANNED.contains(&word.as_str()) {
        let found = format!("\"{word}\", which is planned but not built yet");
        problem(Code::NotBuilt, found, needed).at(place)
    } else {
        problem(Code::UnknownWord, quoted(&word), needed)
            .at(place)
            .with_hint(did_you_mean(&word, SystemName::WORDS.iter().copied()))
    })
}

fn quoted_words(words: &[&str]) -> String {
    let words: Vec<String> = words.iter().map(|word| quoted(word)).collect();
    words.join(", ")
}

/// Lists all keys and sections below a table.
fn flatten(system: SystemName, table: &DeTable<'_>, prefix: &[String], entries: &mut Vec<Entry>) {
    for (key, value) in table {
        let mut path = prefix.to_vec();
        path.push(key.get_ref().to_string());
        let dotted = path.join(".");
        let is_list = [AUXILIARY_BEARING, VARY, LIMIT, MEASURED].contains(&dotted.as_str());
        if is_list || (kind_at(&dotted).is_some_and(|kind| is_part(system, kind, value.get_ref())))
        {
            continue;
        }
        let Range { start, .. } = key.span();
        match value.get_ref() {
            DeValue::Table(inner) if table::key(&dotted).is_some() => {
                let raw = table_raw(inner);
                entries.push(Entry {
                    path,
                    start,
                    raw: Some(raw),
                });
            }
            DeValue::Table(inner) => {
                let is_section = table::sections().any(|section| section.path == dotted);
                entries.push(Entry {
                    path: path.clone(),
                    start,
                    raw: None,
                });
                if is_section {
                    flatten(system, inner, &path, entries);
                }
            }
            other => entries.push(Entry {
                path,
                start,
                raw: Some(raw(other)),
            }),
        }
    }
}
