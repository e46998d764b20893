//! Values of a TOML text set and taken away where they stand: everything else keeps its bytes.
//!
//! The text is parsed for its places alone. A change replaces the bytes of a value, or puts in or takes away a line of its own, so that
//! comments, order and spelling around it stay. Setting a key and taking it away again gives the bytes from before.

use auxbear::scenario::template::LEFT;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value as Json, json};
use std::ops::Range;
use toml_edit::{Array, Document, InlineTable, Item, Table, Value};

/// A step of a path: the name of a key, or the place in a list of tables.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
#[serde(untagged)]
pub enum Step {
    /// Place in a list of tables, from 0.
    Place(usize),
    /// Name of a key or table.
    Name(String),
}

/// A header that a change put in, with what stands before it: the same path takes it away with its last key.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub struct AddedHeader {
    /// The header as written, `[mount]`.
    pub header: String,
    /// The line breaks before it that came with it.
    pub before: String,
}

/// A text after a change.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Edited {
    /// The text.
    pub text: String,
    /// The header that the change put in, where it did.
    pub made: Option<AddedHeader>,
}

type Places = Range<usize>;

/// What a path leads to.
enum Target<'a> {
    /// A value; with the places of its key where it stands on a line of its own.
    Value(&'a Value, Option<Places>),
    /// Nothing, in a table that has a header or is the head of the file.
    Free(&'a Table),
    /// Nothing, in a table that dotted keys make.
    Dotted(&'a Table),
    /// Nothing, not even the table: below this one, which has the first so many steps.
    Nowhere(&'a Table, usize),
    /// What cannot be changed here.
    Fixed,
}

/// Sets the value of a path to a literal of TOML.
///
/// # Errors
/// Why the text has no place for it: what to do instead.
pub fn set(text: &str, path: &[Step], literal: &str) -> Result<Edited, String> {
    let document = parsed(text)?;
    let name = name_of(path)?;
    let newline = newline_of(text);
    let mut made = None;
    let changed = match target(document.as_table(), path) {
        Target::Value(value, _) => {
            let place = value.span().ok_or_else(no_place)?;
            spliced(text, place, literal)
        }
        Target::Free(table) => {
            let line = format!("{} = {literal}", key_text(name));
            let of_root = path.len() == 1;
            match last_line(text, table, of_root) {
                Some(end) => with_line(text, end, &line),
                None => format!("{line}{newline}{text}"),
            }
        }
        Target::Dotted(table) => {
            let end = last_line(text, table, false).ok_or_else(no_place)?;
            let line = &text[line_start(text, end)..end];
            let before = line.split('=').next().unwrap_or_default();
            let dotted = before.rsplit_once('.').ok_or_else(no_place)?.0;
            with_line(
                text,
                end,
                &format!("{dotted}.{} = {literal}", key_text(name)),
            )
        }
        Target::Nowhere(above, steps) => {
            let names: Vec<String> = (path[..path.len() - 1].iter())
                .filter_map(|step| match step {
                    Step::Name(name) => Some(key_text(name)),
                    Step::Place(_) => None,
                })
                .collect();
            let header = format!("[{}]", names.join("."));
            // inside a table of a list the header belongs before the next of them
            let within = path[..steps]
                .iter()
                .any(|step| matches!(step, Step::Place(_)));
            let end = match within {
                true => end_of(above).map(|end| line_end(text, end)),
                false => None,
            };
            let end = end.filter(|end| !text[*end..].trim_start_matches(['\r', '\n']).is_empty());
            let end = end.unwrap_or(text.len());
            let before = match text.is_empty() {
                true => String::new(),
                false if end == text.len() && text.ends_with('\n') => newline.to_string(),
                false => newline.repeat(2),
            };
            let line = format!("{} = {literal}", key_text(name));
            let block = match end == text.len() {
                true => format!("{before}{header}{newline}{line}{newline}"),
                false => format!("{before}{header}{newline}{line}"),
            };
            made = Some(AddedHeader { header, before });
            spliced(text, end..end, &block)
        }
        Target::Fixed => return Err(no_place()),
    };
    match parsed(&changed)
        .map(|document| matches!(target(document.as_table(), path), Target::Value(..)))
    {
        Ok(true) => Ok(Edited {
            text: changed,
            made,
        }),
        _ => Err(no_place()),
    }
}

/// Takes the key of a path away, with the header that is then empty where the list says that a change put it in.
///
/// # Errors
/// Where there is no such key on a line of its own.
pub fn unset(text: &str, path: &[Step], made: &[AddedHeader]) -> Result<String, String> {
    let document = parsed(text)?;
    let Target::Value(value, Some(key)) = target(document.as_table(), path) else {
        return Err(no_place());
    };
    let end = value.span().ok_or_else(no_place)?.end;
    let rest = without_lines(text, key.start, end);
    let Ok(after) = parsed(&rest) else {
        return Err(no_place());
    };
    let Target::Free(table) = target(after.as_table(), path) else {
        return Ok(rest);
    };
    let (true, Some(place)) = (has_no_keys(table), table.span()) else {
        return Ok(rest);
    };
    let own = &rest[place.clone()];
    let Some(known) = made.iter().find(|known| known.header == own) else {
        return Ok(rest);
    };
    let before = place.start.saturating_sub(known.before.len());
    if rest[before..place.start] != known.before {
        return Ok(rest);
    }
    let end = line_end(&rest, place.end);
    // at the end of a text the header's own line break goes; within one it separates what follows
    let end = if before == 0 || rest[end..].len() <= 2 {
        rest.len()
    } else {
        end
    };
    Ok(spliced(&rest, before..end, ""))
}

/// Adds a table to a list of tables, after the last of them.
///
/// # Errors
/// Where the list is written in another form.
pub fn add(text: &str, path: &[Step], keys: &[(String, String)]) -> Result<String, String> {
    let document = parsed(text)?;
    let newline = newline_of(text);
    let mut table = document.as_table();
    let mut last = None;
    let names: Vec<&str> = path.iter().filter_map(Step::name).collect();
    for (k, name) in names.iter().enumerate() {
        match table.get(name) {
            None => break,
            Some(Item::Table(inner)) => table = inner,
            Some(Item::ArrayOfTables(list)) if k + 1 == names.len() => {
                last = list.iter().last().and_then(end_of);
            }
            Some(_) => return Err(no_place()),
        }
    }
    let header = names
        .iter()
        .map(|name| key_text(name))
        .collect::<Vec<_>>()
        .join(".");
    let lines = keys
        .iter()
        .map(|(name, literal)| format!("{} = {literal}{newline}", key_text(name)));
    let block = format!("[[{header}]]{newline}{}", lines.collect::<String>());
    let end = last.map_or(text.len(), |end| line_end(text, end));
    let changed = match end == text.len() {
        true if text.is_empty() => block,
        true if text.ends_with('\n') => format!("{text}{newline}{block}"),
        true => format!("{text}{newline}{newline}{block}"),
        false => spliced(
            text,
            end..end,
            &format!("{newline}{newline}{}", block.trim_end()),
        ),
    };
    match parsed(&changed) {
        Ok(_) => Ok(changed),
        Err(_) => Err(no_place()),
    }
}

/// Takes a table of a list of tables away.
///
/// # Errors
/// Where there is no such table with a header of its own.
pub fn remove(text: &str, path: &[Step]) -> Result<String, String> {
    let document = parsed(text)?;
    let mut item = document.as_item();
    for step in path {
        item = match (step, item) {
            (Step::Name(name), Item::Table(table)) => table.get(name).ok_or_else(no_place)?,
            (Step::Place(place), Item::ArrayOfTables(list)) => {
                let table = list.get(*place).ok_or_else(no_place)?;
                let start = table.span().ok_or_else(no_place)?.start;
                let end = end_of(table).ok_or_else(no_place)?;
                let rest = without_lines(text, start, end);
                // the empty line before it goes too
                let cut = line_start(text, start);
                let before = rest[..cut]
                    .strip_suffix('\n')
                    .map(|rest| rest.trim_end_matches('\r'));
                let kept = before.filter(|before| before.ends_with('\n') || before.is_empty());
                let changed = kept.map(|kept| format!("{kept}{}", &rest[cut..]));
                return Ok(changed.unwrap_or(rest));
            }
            _ => return Err(no_place()),
        };
    }
    Err(no_place())
}

/// All values of a text as they are typed, each with its line: tables as objects, lists of tables as lists.
///
/// # Errors
/// What is no TOML: the message and its line, from 1.
pub fn typed(text: &str) -> Result<Json, (String, usize)> {
    let document = Document::parse(text).map_err(|error| {
        let start = error.span().map_or(0, |span| span.start);
        (error.message().to_string(), line_of(text, start))
    })?;
    Ok(of_table(text, document.as_table()))
}

fn of_table(text: &str, table: &Table) -> Json {
    let mut object = Map::new();
    for (name, item) in table {
        let own = match item {
            Item::Table(inner) => of_table(text, inner),
            Item::ArrayOfTables(list) => list.iter().map(|inner| of_table(text, inner)).collect(),
            Item::Value(value) => of_value(text, value),
            Item::None => continue,
        };
        object.insert(name.to_string(), own);
    }
    Json::Object(object)
}

/// A value: what is typed, its line, and the source or reason beside it.
fn of_value(text: &str, value: &Value) -> Json {
    let line = value.span().map_or(0, |span| line_of(text, span.start));
    let plain = |value: &Value| match value {
        Value::String(own) => own.value().clone(),
        other => other
            .span()
            .map_or(String::new(), |span| text[span].to_string()),
    };
    if let Value::InlineTable(inner) = value {
        if let Some(own) = inner.get("value") {
            let word = |key: &str| inner.get(key).and_then(Value::as_str);
            return json!({ "=": plain(own), "line": line, "source": word("source"), "assumed": word("assumed"), "from": word("from") });
        }
        let members = inner
            .iter()
            .map(|(name, value)| (name.to_string(), of_value(text, value)));
        return Json::Object(members.collect());
    }
    if let Value::Array(list) = value
        && !list.is_empty()
        && list.iter().all(Value::is_inline_table)
    {
        return list.iter().map(|value| of_value(text, value)).collect();
    }
    json!({ "=": plain(value), "line": line })
}

impl Step {
    /// The name, where it is one.
    pub fn name(&self) -> Option<&str> {
        match self {
            Step::Name(name) => Some(name),
            Step::Place(_) => None,
        }
    }
}

/// The steps of a dotted path.
pub fn steps(path: &str) -> Vec<Step> {
    path.split('.')
        .map(|name| Step::Name(name.to_string()))
        .collect()
}

fn parsed(text: &str) -> Result<Document<&str>, String> {
    Document::parse(text)
        .map_err(|error| format!("the text is not valid TOML: {}", error.message()))
}

fn no_place() -> String {
    "the text writes this in a form that a field cannot change: change it in the text".to_string()
}

fn name_of(path: &[Step]) -> Result<&str, String> {
    path.last().and_then(Step::name).ok_or_else(no_place)
}

/// A key as TOML has it: quoted where it is not bare.
fn key_text(name: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    match !name.is_empty() && name.chars().all(bare) {
        true => name.to_string(),
        false => auxbear::scenario::quoted(name),
    }
}

/// Where a path leads.
fn target<'a>(root: &'a Table, path: &[Step]) -> Target<'a> {
    let mut table = root;
    let mut k = 0;
    while k < path.len() {
        let Some(name) = path[k].name() else {
            return Target::Fixed;
        };
        let last = k + 1 == path.len();
        let Some((key, item)) = table.get_key_value(name) else {
            return match last {
                true if table.is_dotted() => Target::Dotted(table),
                // a table that only its sub-tables make has no header to stand under
                true if table.is_implicit() && k > 0 => Target::Nowhere(table, k),
                true => Target::Free(table),
                false if table.is_dotted() => Target::Fixed,
                false => Target::Nowhere(table, k),
            };
        };
        match item {
            Item::Table(inner) if !last => table = inner,
            Item::ArrayOfTables(list) => match path.get(k + 1) {
                Some(Step::Place(place)) => match list.get(*place) {
                    Some(inner) if k + 2 < path.len() => {
                        table = inner;
                        k += 1;
                    }
                    _ => return Target::Fixed,
                },
                _ => return Target::Fixed,
            },
            Item::Value(value) => return within(value, &path[k + 1..], key.span()),
            _ => return Target::Fixed,
        }
        k += 1;
    }
    Target::Fixed
}

/// What the rest of a path leads to in a value.
fn within<'a>(value: &'a Value, rest: &[Step], key: Option<Places>) -> Target<'a> {
    let inline: Option<&InlineTable> = value.as_inline_table();
    let list: Option<&Array> = value.as_array();
    match (rest, inline, list) {
        ([], Some(table), _) => match table.get("value") {
            // another value is no example
            Some(_) if table.get("assumed").and_then(Value::as_str) == Some(LEFT) => {
                Target::Value(value, key)
            }
            Some(own) => Target::Value(own, key),
            None => Target::Fixed,
        },
        ([], None, _) => Target::Value(value, key),
        ([Step::Name(name), rest @ ..], Some(table), _) => match table.get(name) {
            Some(own) => within(own, rest, None),
            None => Target::Fixed,
        },
        ([Step::Place(place), rest @ ..], _, Some(list)) => match list.get(*place) {
            Some(own) => within(own, rest, None),
            None => Target::Fixed,
        },
        _ => Target::Fixed,
    }
}

/// Whether a table has only tables with headers of their own.
fn has_no_keys(table: &Table) -> bool {
    table.iter().all(|(_, item)| match item {
        Item::Table(inner) => !inner.is_dotted(),
        Item::ArrayOfTables(_) => true,
        _ => false,
    })
}

/// Where the last line of a table's own keys ends, else that of its header; none in a head of a file without keys.
fn last_line(text: &str, table: &Table, of_root: bool) -> Option<usize> {
    let ends = table.iter().filter_map(|(_, item)| match item {
        Item::Value(value) => value.span().map(|span| span.end),
        Item::Table(inner) if inner.is_dotted() => end_of(inner),
        _ => None,
    });
    let header = if of_root {
        None
    } else {
        table.span().map(|span| span.end)
    };
    let end = ends.max().or(header)?;
    Some(line_end(text, end))
}

/// Where a table ends with all that is in it: the end of its last value, or of its header.
fn end_of(table: &Table) -> Option<usize> {
    let inner = table.iter().filter_map(|(_, item)| match item {
        Item::Value(value) => value.span().map(|span| span.end),
        Item::Table(inner) => end_of(inner),
        Item::ArrayOfTables(list) => list.iter().filter_map(end_of).max(),
        Item::None => None,
    });
    let own = table
        .span()
        .filter(|_| !table.is_dotted())
        .map(|span| span.end);
    inner.chain(own).max()
}

fn newline_of(text: &str) -> &'static str {
    if text.contains("\r\n") { "\r\n" } else { "\n" }
}

fn line_start(text: &str, at: usize) -> usize {
    text[..at].rfind('\n').map_or(0, |newline| newline + 1)
}

/// End of the line, before its line break.
fn line_end(text: &str, at: usize) -> usize {
    let end = text[at..]
        .find('\n')
        .map_or(text.len(), |newline| at + newline);
    if text[..end].ends_with('\r') && end > at {
        end - 1
    } else {
        end
    }
}

fn line_of(text: &str, at: usize) -> usize {
    text[..at.min(text.len())].matches('\n').count() + 1
}

fn spliced(text: &str, place: Places, with: &str) -> String {
    format!("{}{with}{}", &text[..place.start], &text[place.end..])
}

/// A line after the one that ends here, indented as that one.
fn with_line(text: &str, end: usize, line: &str) -> String {
    let above = &text[line_start(text, end)..end];
    let indent = &above[..above.len() - above.trim_start_matches([' ', '\t']).len()];
    spliced(
        text,
        end..end,
        &format!("{}{indent}{}", newline_of(text), line.trim_start()),
    )
}

/// Without the lines from one place to another; of the last line of a text the line break before it goes.
fn without_lines(text: &str, from: usize, to: usize) -> String {
    let start = line_start(text, from);
    let end = line_end(text, to);
    match text[end..].find('\n') {
        Some(newline) => spliced(text, start..end + newline + 1, ""),
        None => {
            let before = text[..start].trim_end_matches('\n').len();
            let before = if start > before { start - 1 } else { start };
            let before = if text[..before].ends_with('\r') {
                before - 1
            } else {
                before
            };
            text[..before].to_string()
        }
    }
}

#[cfg(test)]
mod tests;
