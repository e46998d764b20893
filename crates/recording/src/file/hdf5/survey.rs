//! The walk through a file that finds its channels and properties.

use std::collections::HashSet;
use std::io::{Read, Seek};

use super::dataset::{self, Dataset, Line, Place, Unreadable};
use super::datatype::{Datatype, Kind};
use super::group::Target;
use super::header::{Message, kind};
use super::storage::Storage;
use crate::file::{Property, Value, clock};
use crate::{Channel, Clock, FileError, Note};

/// Deepest group that is looked into.
const DEEPEST: usize = 64;
/// Most objects that are looked at.
const MOST_OBJECTS: usize = 1 << 16;
/// Most channels of one dataset.
const MOST_COLUMNS: u64 = 4096;
/// Longest unit that is kept, in letters.
const LONGEST_UNIT: usize = 64;
/// Longest description that is kept, in letters.
const LONGEST_DESCRIPTION: usize = 1024;

/// What a file holds.
#[derive(Default)]
pub(super) struct Contents {
    pub channels: Vec<Channel>,
    pub lines: Vec<Line>,
    pub datasets: Vec<Dataset>,
    pub properties: Vec<Property>,
    pub notes: Vec<Note>,
    /// Other names of what is read, and single values: neither are channels.
    aliases: Vec<String>,
    singles: Vec<String>,
}

/// Walks through a file.
pub(super) fn survey<S: Read + Seek>(
    storage: &mut Storage<S>,
    matlab: bool,
) -> Result<Contents, FileError> {
    let mut found = Contents::default();
    let length = storage.source.length();
    if let Some(end) = storage.end.filter(|&end| end > length) {
        let text = format!("the file was cut off: it states {end} bytes, {length} are there");
        found.note("", text);
    }
    let mut seen = HashSet::new();
    // The root must be readable: without it nothing of the file is.
    storage.messages(storage.root)?;
    let mut groups = vec![(String::new(), storage.root, 0)];
    let (mut paths, mut links) = (HashSet::new(), Vec::new());
    let mut objects = 0;
    while let Some((prefix, address, depth)) = groups.pop() {
        if !seen.insert(address) {
            found.aliases.push(prefix.trim_end_matches('/').to_string());
            continue;
        }
        let messages = match storage.messages(address) {
            Ok(messages) => messages,
            Err(error) => {
                found.note(&prefix, left_out(&error));
                continue;
            }
        };
        let is = |kinds: &[u16]| messages.iter().any(|message| kinds.contains(&message.kind));
        if !is(&kind::OF_GROUPS) && !is(&[kind::DATATYPE]) {
            let text = "its header names neither members nor values: it is damaged, and what it holds is left out";
            found.note(&prefix, text);
        }
        let attributes = found.attributes(storage, &prefix, &messages);
        found.take_properties(&prefix, attributes);
        let (members, error) = storage.members(&messages);
        if let Some(error) = error {
            found.note(&prefix, left_out(&error));
        }
        let mut below = Vec::new();
        for (name, target) in members {
            objects += 1;
            if objects > MOST_OBJECTS {
                found.note("", format!("only {MOST_OBJECTS} objects were looked at"));
                break;
            }
            if matlab && (name == "#refs#" || name == "#subsystem#") {
                continue;
            }
            let name = format!("{prefix}{name}");
            let address = match target {
                Target::Object(address) => address,
                Target::Path(path) => {
                    links.push((name, prefix.clone(), path));
                    continue;
                }
                Target::Outside(place) => {
                    found.note(&name, format!("leads to {place}; it is left out"));
                    continue;
                }
            };
            paths.insert(name.clone());
            let messages = match storage.messages(address) {
                Ok(messages) => messages,
                Err(error) => {
                    found.note(&name, left_out(&error));
                    continue;
                }
            };
            if messages.iter().any(|message| message.kind == kind::LAYOUT) {
                if seen.insert(address) {
                    found.take_dataset(storage, name, &messages, matlab);
                } else {
                    found.aliases.push(name);
                }
            } else if depth < DEEPEST {
                below.push((format!("{name}/"), address, depth + 1));
            } else {
                let text = format!("stands below {DEEPEST} groups; it is left out");
                found.note(&name, text);
            }
        }
        groups.extend(below.into_iter().rev());
    }
    // What a soft link leads to is read under its own name.
    for (name, prefix, path) in links {
        let whole = match path.strip_prefix('/') {
            Some(path) => path.to_string(),
            None => format!("{prefix}{path}"),
        };
        let whole = whole.trim_end_matches('/');
        match paths.contains(whole) {
            true => found.aliases.push(format!("{name} (read as {whole})")),
            false => found.note(&name, format!("leads to {path}, which is not there")),
        }
    }
    found.tell_what_is_no_channel();
    Ok(found)
}

/// The interval that one of these properties states.
fn stated_interval(properties: &[Property]) -> Option<f64> {
    properties.iter().find_map(|property| match property.value {
        Value::Number(value) => clock::interval_of(&property.name, value),
        _ => None,
    })
}

/// What an error says, without the name of the file, for a note of that file.
fn left_out(error: &FileError) -> String {
    format!("{}: {}; it is left out", error.place, error.found)
}

impl Contents {
    fn note(&mut self, name: &str, text: impl Into<String>) {
        self.notes.push(Note::of(name.trim_end_matches('/'), text));
    }

    /// One note each of what somebody may look for among the channels.
    fn tell_what_is_no_channel(&mut self) {
        const NAMED: usize = 8;
        let aliases =
            "links or other names lead to what is read under its first name, and are no channels";
        let singles = "single values are properties of the file, and no channels";
        for (names, what) in [
            (std::mem::take(&mut self.aliases), aliases),
            (std::mem::take(&mut self.singles), singles),
        ] {
            let rest = match names.len().saturating_sub(NAMED) {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            if !names.is_empty() {
                let first = names[..NAMED.min(names.len())].join(", ");
                self.note("", format!("{} {what}: {first}{rest}", names.len()));
            }
        }
    }

    /// The attributes of an object that can be read.
    fn attributes<S: Read + Seek>(
        &mut self,
        storage: &mut Storage<S>,
        name: &str,
        messages: &[Message],
    ) -> Vec<Property> {
        let (attributes, whole) = storage.attributes(messages);
        if !whole {
            let text = "attributes of it are damaged or cut off; they are left out";
            self.note(name, text);
        }
        attributes
    }

    fn take_properties(&mut self, prefix: &str, properties: Vec<Property>) {
        let named = properties.into_iter().map(|property| Property {
            name: format!("{prefix}{}", property.name),
            value: property.value,
        });
        self.properties.extend(named);
    }

    fn take_dataset<S: Read + Seek>(
        &mut self,
        storage: &mut Storage<S>,
        name: String,
        messages: &[Message],
        matlab: bool,
    ) {
        let attributes = self.attributes(storage, &name, messages);
        let text = |key: &str| {
            let named = |property: &&Property| property.name.eq_ignore_ascii_case(key);
            let found = attributes
                .iter()
                .filter(named)
                .map(|property| &property.value);
            let mut texts = found.filter_map(|value| match value {
                Value::Text(text) => Some(text.clone()),
                _ => None,
            });
            texts.next()
        };
        let class = text("MATLAB_class").filter(|_| matlab);
        let is_empty = attributes
            .iter()
            .any(|a| a.name == "MATLAB_empty" && a.value != Value::Number(0.0));
        if matlab && is_empty {
            return self.note(&name, "is empty");
        }
        if matlab && attributes.iter().any(|a| a.name == "MATLAB_object_decode") {
            let class = class.unwrap_or_default();
            let text = format!(
                "is an object of the class {class}, of which no format is published; it is left out: save its numbers as a matrix, its text as char"
            );
            return self.note(&name, text);
        }
        let dataset = match storage.dataset(messages) {
            Ok(dataset) => dataset,
            Err(Unreadable::Form(why)) => {
                return self.note(&name, format!("{why}; it is left out"));
            }
            Err(Unreadable::Damaged(error)) => {
                return self.note(&name, left_out(&error));
            }
        };
        let numbers = numbers(&dataset.datatype);
        if numbers.is_empty() {
            let count: u64 = dataset.sizes.iter().product();
            if count == 1 && single(storage, &dataset).is_some() {
                return;
            }
            let what = match &dataset.datatype.kind {
                Kind::Other(what) => what,
                Kind::Text | Kind::LongText => "texts",
                _ => "compounds without numbers",
            };
            let way_out = match matlab && *what == *"references" {
                true => {
                    ": an array of structures is read from a file saved with -v7, or as variables of its own, as x = S(1).speed"
                }
                false => "",
            };
            return self.note(&name, format!("holds {what}; it is left out{way_out}"));
        }
        let wide: Vec<usize> = (0..dataset.sizes.len())
            .filter(|&direction| dataset.sizes[direction] != 1)
            .collect();
        if class.as_deref() == Some("char") && wide.len() <= 1 {
            return;
        }
        let (along, across) = match wide[..] {
            [] if !dataset.sizes.is_empty() && !matlab => (0, None),
            [] => {
                let values = numbers.iter().filter_map(|(member, offset, datatype)| {
                    let line = line(&dataset, self.datasets.len(), 0, *offset, datatype);
                    let value = first_value(storage, &dataset, &line)?;
                    Some(Property {
                        name: format!("{name}{member}"),
                        value: Value::Number(value),
                    })
                });
                let values: Vec<Property> = values.collect();
                if !matlab {
                    self.singles.push(name.clone());
                }
                return self.properties.extend(values);
            }
            [along] => (along, None),
            // MATLAB stores columns as rows, and its columns are the channels unless they are the shorter direction.
            [a, b] => match (dataset.sizes[a], dataset.sizes[b]) {
                (rows, columns) if rows > columns || (rows == columns && !matlab) => (a, Some(b)),
                _ => (b, Some(a)),
            },
            _ => {
                return self.note(&name, "has more than two directions; it is left out");
            }
        };
        let columns = across.map_or(1, |across| dataset.sizes[across]);
        if columns.saturating_mul(numbers.len() as u64) > MOST_COLUMNS {
            return self.note(&name, format!("has {columns} columns; it is left out"));
        }
        let size = dataset.sizes.get(along).copied().unwrap_or(1);
        let length = storage.source.length();
        let count = dataset.readable(along, storage.base, length);
        if count < size {
            let text = format!("{size} values are stated, {count} are there");
            self.note(&name, text);
        }
        let first = |keys: &str| keys.split(' ').find_map(text).unwrap_or_default();
        let unit = first("unit units unit_string physical_unit einheit");
        let unit: String = unit.trim().chars().take(LONGEST_UNIT).collect();
        let description = first("description long_name meaning comment label title");
        let clock = stated_interval(&attributes).map(|interval| {
            let first = attributes.iter().find_map(|property| {
                let names = ["t0", "x0", "start_offset", "wf_start_offset"];
                match property.value {
                    Value::Number(first) if names.contains(&property.name.as_str()) => Some(first),
                    _ => None,
                }
            });
            Clock::Uniform {
                first: first.filter(|first| first.is_finite()).unwrap_or(0.0),
                interval,
            }
        });
        let description: String = description.chars().take(LONGEST_DESCRIPTION).collect();
        for column in 0..columns {
            for (member, offset, datatype) in &numbers {
                let mut line = line(&dataset, self.datasets.len(), along, *offset, datatype);
                let mut full = format!("{name}{member}");
                if let Some(across) = across {
                    line.from[across] = column;
                    full = format!("{full}[{}]", column + 1);
                }
                self.lines.push(line);
                self.channels.push(Channel {
                    unit: unit.clone(),
                    description: description.clone(),
                    clock: clock.clone().unwrap_or(Clock::Unknown),
                    ..Channel::new(full, count)
                });
            }
        }
        self.datasets.push(dataset);
    }
}

/// Names, places and types of the numbers of a value.
fn numbers(datatype: &Datatype) -> Vec<(String, usize, Datatype)> {
    if datatype.is_number() {
        return vec![(String::new(), 0, datatype.clone())];
    }
    let mut found = Vec::new();
    if let Kind::Compound(members) = &datatype.kind {
        for member in members {
            for (name, offset, inner) in numbers(&member.datatype) {
                let offset = member.offset.saturating_add(offset);
                found.push((format!("/{}{name}", member.name), offset, inner));
            }
        }
    }
    found
}

fn line(dataset: &Dataset, index: usize, along: usize, offset: usize, inner: &Datatype) -> Line {
    Line {
        dataset: index,
        along,
        from: vec![0; dataset.sizes.len()],
        offset,
        datatype: inner.clone(),
    }
}

fn first_value<S: Read + Seek>(
    storage: &mut Storage<S>,
    dataset: &Dataset,
    line: &Line,
) -> Option<f64> {
    let mut value = [0.0];
    let line = &Line {
        along: 0,
        ..line.clone()
    };
    let mut cache = dataset::Cache::default();
    dataset::read_line(storage, &mut cache, dataset, line, 0, &mut value).then_some(value[0])
}

/// The single text of a dataset.
fn single<S: Read + Seek>(storage: &mut Storage<S>, dataset: &Dataset) -> Option<Value> {
    let bytes = match &dataset.place {
        Place::Compact(bytes) => bytes.clone(),
        Place::Contiguous(Some(at)) => storage
            .piece(*at, dataset.datatype.size as u64, "a text")
            .ok()?,
        _ => return None,
    };
    storage.value(&dataset.datatype, &bytes)
}
