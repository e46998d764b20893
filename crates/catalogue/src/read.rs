//! From the text of a file of bearings to bearings.

use super::bearing::{Bearing, FORMAT, Origin};
use super::draft::{Draft, Read, Reader};
use super::key::{self, KEYS, Key};
use super::{check, complete};
use problem::{Code, Place, Problem, did_you_mean};
use std::collections::BTreeMap;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

/// Reads all bearings of a text.
pub(super) fn read(text: &str, file: &str, built_in: bool) -> Read<Vec<Bearing>> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut reader = Reader {
        text,
        file,
        built_in,
        sources: BTreeMap::new(),
    };
    if text.trim().is_empty() {
        return Err(Problem::new(
            Code::FileEmpty,
            file,
            "an empty file",
            format!("bearings are needed, after format = \"{FORMAT}\""),
        ));
    }
    let root = DeTable::parse(text).map_err(|error| Problem::of_toml(&error, text, file))?;
    reader.whole(root.get_ref())
}

impl Reader<'_> {
    pub(super) fn problem(
        &self,
        code: Code,
        start: usize,
        key: &str,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Box<Problem> {
        Problem::new(code, self.file, found, allowed)
            .at(Place::of_offset(self.text, start))
            .on_key(key)
    }

    fn whole(&mut self, root: &DeTable<'_>) -> Read<Vec<Bearing>> {
        self.format(root)?;
        for (key, value) in in_order(root) {
            let start = key.span().start;
            match (key.get_ref().as_ref(), value.get_ref()) {
                ("format" | "bearing" | "family", _) => {}
                ("sources", DeValue::Table(table)) => self.read_sources(table)?,
                ("sources", other) => {
                    let needed = "a section [sources] with lines key = \"citation\" is needed";
                    return Err(self.problem(
                        Code::WrongType,
                        start,
                        "sources",
                        kind(other),
                        needed,
                    ));
                }
                (unknown, _) => {
                    let known = ["format", "sources", "bearing", "family"];
                    let mut problem = self.problem(
                        Code::UnknownKey,
                        start,
                        unknown,
                        "an unknown key",
                        "the top level takes format, [sources], [[bearing]] and [[family]]",
                    );
                    problem.hint = did_you_mean(unknown, known);
                    return Err(problem);
                }
            }
        }
        let mut drafts = Vec::new();
        for table in self.tables(root, "bearing")? {
            drafts.push(self.bearing(table.get_ref(), table.span().start)?);
        }
        for table in self.tables(root, "family")? {
            self.family(table.get_ref(), table.span().start, &mut drafts)?;
        }
        self.distinct(&drafts)?;
        for draft in &mut drafts {
            complete::complete(&mut draft.bearing);
            // A test checks the built-in bearings once and for all.
            if !self.built_in {
                check::check(draft, self)?;
            }
            draft.bearing.values.sort_by(|a, b| a.key.cmp(&b.key));
        }
        Ok(drafts.into_iter().map(|draft| draft.bearing).collect())
    }

    /// The format comes first: a file of another format would fail on its keys with misleading words.
    fn format(&self, root: &DeTable<'_>) -> Read<()> {
        let needed = format!("format = \"{FORMAT}\" is needed");
        let (start, found) = match root.get_key_value("format") {
            None => {
                let problem = Problem::new(Code::UnknownFormat, self.file, "nothing", needed);
                return Err(problem.on_key("format"));
            }
            Some((key, value)) => match value.get_ref() {
                DeValue::String(found) if found == FORMAT => return Ok(()),
                DeValue::String(found) => (key.span().start, format!("\"{found}\"")),
                other => (key.span().start, kind(other)),
            },
        };
        let mut problem = self.problem(Code::UnknownFormat, start, "format", &found, needed);
        if found.starts_with("\"auxbear.bearings/") {
            problem.hint = Some("A file of a newer format needs a newer program".to_string());
        }
        Err(problem)
    }

    fn read_sources(&mut self, table: &DeTable<'_>) -> Read<()> {
        for (key, value) in table {
            let citation = match value.get_ref() {
                DeValue::String(text) if !text.trim().is_empty() => text.to_string(),
                other => {
                    return Err(self.problem(
                        Code::WrongType,
                        key.span().start,
                        &format!("sources.{}", key.get_ref()),
                        kind(other),
                        "a citation in quotes is needed",
                    ));
                }
            };
            self.sources.insert(key.get_ref().to_string(), citation);
        }
        Ok(())
    }

    /// The tables of `[[name]]`.
    fn tables<'t, 'i>(
        &self,
        root: &'t DeTable<'i>,
        name: &str,
    ) -> Read<Vec<Spanned<&'t DeTable<'i>>>> {
        let Some((key, value)) = root.get_key_value(name) else {
            return Ok(Vec::new());
        };
        let wrong = |start, found| {
            let needed = format!("sections [[{name}]] are needed");
            self.problem(Code::WrongType, start, name, found, needed)
        };
        let DeValue::Array(array) = value.get_ref() else {
            return Err(wrong(key.span().start, kind(value.get_ref())));
        };
        let mut tables = Vec::new();
        for item in array.iter() {
            match item.get_ref() {
                DeValue::Table(table) => tables.push(Spanned::new(item.span(), table)),
                other => return Err(wrong(item.span().start, kind(other))),
            }
        }
        Ok(tables)
    }

    fn bearing(&self, table: &DeTable<'_>, start: usize) -> Read<Draft> {
        let mut draft = draft(start);
        let name = self.text_of(table, "bearing", "name", start)?;
        draft.bearing.name = name.unwrap_or_default().to_string();
        if draft.bearing.name.is_empty() {
            return Err(self.no_name("bearing", start));
        }
        if let Some(text) = self.text_of(table, "bearing", "description", start)? {
            draft.bearing.description = text.to_string();
        }
        for (key, value) in in_order(table) {
            let start = key.span().start;
            match key.get_ref().as_ref() {
                "name" | "description" => {}
                name => {
                    let key = self.key(name, "bearing", start)?;
                    let value = self.value(key, value.get_ref(), None, "bearing", start)?;
                    draft.bearing.values.push(value);
                    draft.starts.push((key.path, start));
                }
            }
        }
        Ok(draft)
    }

    pub(super) fn no_name(&self, section: &str, start: usize) -> Box<Problem> {
        self.problem(
            Code::MissingKey,
            start,
            &format!("{section}.name"),
            "no name",
            "name = \"…\" is needed, by which a scenario asks for the bearing",
        )
    }

    /// The text under a key, without spaces around it.
    pub(super) fn text_of<'t>(
        &self,
        table: &'t DeTable<'_>,
        section: &str,
        name: &str,
        start: usize,
    ) -> Read<Option<&'t str>> {
        match table.get(name).map(Spanned::get_ref) {
            None => Ok(None),
            Some(DeValue::String(text)) => Ok(Some(text.trim())),
            Some(other) => Err(self.problem(
                Code::WrongType,
                table.get(name).map_or(start, |value| value.span().start),
                &format!("{section}.{name}"),
                kind(other),
                "a text in quotes is needed",
            )),
        }
    }

    pub(super) fn key(&self, name: &str, section: &str, start: usize) -> Read<&'static Key> {
        key::find(name).ok_or_else(|| {
            let names = || KEYS.iter().map(|key| key.path);
            let listed: Vec<&str> = names().collect();
            let mut problem = self.problem(
                Code::UnknownKey,
                start,
                &format!("{section}.{name}"),
                "an unknown key",
                format!("a bearing takes {}", listed.join(", ")),
            );
            problem.hint = did_you_mean(name, names());
            problem
        })
    }

    fn distinct(&self, drafts: &[Draft]) -> Read<()> {
        let mut starts = BTreeMap::new();
        for draft in drafts {
            let name = draft.bearing.name.trim();
            if let Some(earlier) = starts.insert(name.to_ascii_lowercase(), draft.start) {
                let line = Place::of_offset(self.text, earlier).line();
                return Err(self.problem(
                    Code::DuplicateBearing,
                    draft.start,
                    "name",
                    format!("\"{name}\" once more"),
                    format!(
                        "each bearing of a file needs a name of its own; line {} has this one",
                        line.unwrap_or_default()
                    ),
                ));
            }
        }
        Ok(())
    }
}

/// An empty bearing.
pub(super) fn draft(start: usize) -> Draft {
    Draft {
        bearing: Bearing {
            name: String::new(),
            description: String::new(),
            origin: Origin::BuiltIn,
            values: Vec::new(),
        },
        start,
        starts: Vec::new(),
    }
}

/// Keys and values in the order of the file.
pub(super) fn in_order<'t, 'i>(
    table: &'t DeTable<'i>,
) -> Vec<(&'t Spanned<DeString<'i>>, &'t Spanned<DeValue<'i>>)> {
    let mut entries: Vec<_> = table.iter().collect();
    entries.sort_by_key(|(key, _)| key.span().start);
    entries
}

/// A value in words, for a message.
pub(super) fn kind(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => format!("the text \"{text}\""),
        DeValue::Integer(integer) => format!("the number {integer}"),
        DeValue::Float(float) => format!("the number {float}"),
        DeValue::Boolean(value) => format!("the switch {value}"),
        DeValue::Datetime(_) => "a date".to_string(),
        DeValue::Array(_) => "a list".to_string(),
        DeValue::Table(_) => "a table".to_string(),
    }
}
