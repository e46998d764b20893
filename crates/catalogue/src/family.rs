//! Families: common values, columns, and one row for each bearing.

use super::bearing::{Mark, Value};
use super::draft::{Draft, Read, Reader};
use super::key::Key;
use super::read::{draft, in_order, kind};
use problem::{Code, did_you_mean};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// What a column holds.
enum Column<'t> {
    /// Texts for `{name}` in names, descriptions and notes.
    Note(&'t str),
    /// Values of a key.
    Values {
        key: &'static Key,
        unit: Option<&'t str>,
        mark: Option<(Mark, String)>,
    },
}

impl Column<'_> {
    fn name(&self) -> &str {
        match self {
            Column::Note(name) => name,
            Column::Values { key, .. } => key.path,
        }
    }
}

impl Reader<'_> {
    /// Reads one `[[family]]` into its bearings.
    pub(super) fn family(
        &self,
        table: &DeTable<'_>,
        start: usize,
        drafts: &mut Vec<Draft>,
    ) -> Read<()> {
        let name = self.text_of(table, "family", "name", start)?;
        let name = name.ok_or_else(|| self.no_name("family", start))?;
        let description = self.text_of(table, "family", "description", start)?;
        let mut common = Vec::new();
        for (key, value) in in_order(table) {
            let start = key.span().start;
            let key = key.get_ref().as_ref();
            if ["name", "description", "columns", "rows"].contains(&key) {
                continue;
            }
            let key = self.key(key, "family", start)?;
            let value = self.value(key, value.get_ref(), None, "family", start)?;
            common.push((key, start, value));
        }
        let columns = self.columns(table, start)?;
        for row in self.list(table.get("rows"), "family.rows", start, "a list of rows")? {
            let start = row.span().start;
            let needed = format!("a list of {} values", columns.len());
            let cells = self.list(Some(row), "family.rows", start, &needed)?;
            if cells.len() != columns.len() {
                return Err(self.problem(
                    Code::WrongType,
                    start,
                    "family.rows",
                    format!("a row of {} values", cells.len()),
                    format!(
                        "one value for each of the {} columns is needed",
                        columns.len()
                    ),
                ));
            }
            drafts.push(self.row(name, description, &common, &columns, cells, start)?);
        }
        Ok(())
    }

    fn columns<'t>(&self, table: &'t DeTable<'_>, start: usize) -> Read<Vec<Column<'t>>> {
        const PATH: &str = "family.columns";
        let mut columns: Vec<Column<'t>> = Vec::new();
        for column in self.list(table.get("columns"), PATH, start, "a list of columns")? {
            let start = column.span().start;
            let wrong = |code, found: String| {
                let needed = "{ note = \"…\" } or { key = \"…\", unit = \"…\", catalogue = \"…\" } is needed";
                self.problem(code, start, PATH, found, needed)
            };
            let DeValue::Table(column) = column.get_ref() else {
                return Err(wrong(Code::WrongType, kind(column.get_ref())));
            };
            let note = self.text_of(column, PATH, "note", start)?;
            let key = self.text_of(column, PATH, "key", start)?;
            let column = match (note, key) {
                (Some(note), None) if column.len() == 1 => Column::Note(note),
                (None, Some(key)) => Column::Values {
                    key: self.key(key, PATH, start)?,
                    unit: self.text_of(column, PATH, "unit", start)?,
                    mark: self.mark(column, &["key", "unit"], PATH, start)?,
                },
                _ => {
                    return Err(wrong(
                        Code::MissingKey,
                        "a column of another form".to_string(),
                    ));
                }
            };
            if columns
                .iter()
                .any(|earlier| earlier.name() == column.name())
            {
                let found = format!("a second column \"{}\"", column.name());
                return Err(wrong(Code::Conflict, found));
            }
            columns.push(column);
        }
        Ok(columns)
    }

    fn list<'t, 'i>(
        &self,
        value: Option<&'t Spanned<DeValue<'i>>>,
        path: &str,
        start: usize,
        needed: &str,
    ) -> Read<&'t [Spanned<DeValue<'i>>]> {
        match value.map(Spanned::get_ref) {
            Some(DeValue::Array(list)) => Ok(list),
            other => {
                let found = other.map_or("nothing".to_string(), kind);
                let needed = format!("{needed} is needed");
                Err(self.problem(Code::WrongType, start, path, found, needed))
            }
        }
    }

    fn row(
        &self,
        name: &str,
        description: Option<&str>,
        common: &[(&'static Key, usize, Value)],
        columns: &[Column<'_>],
        cells: &[Spanned<DeValue<'_>>],
        start: usize,
    ) -> Read<Draft> {
        let mut draft = draft(start);
        let mut texts: Vec<(&str, String)> = Vec::new();
        for (key, start, value) in common {
            texts.push((key.path, value.text().to_string()));
            draft.bearing.values.push(value.clone());
            draft.starts.push((key.path, *start));
        }
        for (column, cell) in columns.iter().zip(cells) {
            let start = cell.span().start;
            match column {
                Column::Note(name) => texts.push((name, note_text(cell.get_ref()))),
                Column::Values { key, unit, mark } => {
                    let value = self.cell(key, *unit, mark, cell.get_ref(), start)?;
                    texts.push((key.path, value.text().to_string()));
                    // A row may differ from its family.
                    draft.bearing.values.retain(|common| common.key != key.path);
                    draft.starts.retain(|common| common.0 != key.path);
                    draft.bearing.values.push(value);
                    draft.starts.push((key.path, start));
                }
            }
        }
        let fill = |template: &str| self.fill(template, &texts, start);
        draft.bearing.name = fill(name)?;
        draft.bearing.description = description.map_or(Ok(String::new()), fill)?;
        for value in &mut draft.bearing.values {
            if value.mark != Mark::Catalogue && value.note.contains('{') {
                value.note = fill(&value.note)?;
            }
        }
        if draft.bearing.name.is_empty() {
            return Err(self.no_name("family", start));
        }
        Ok(draft)
    }

    /// A cell has the mark of its column unless it brings its own.
    fn cell(
        &self,
        key: &'static Key,
        unit: Option<&str>,
        mark: &Option<(Mark, String)>,
        cell: &DeValue<'_>,
        start: usize,
    ) -> Read<Value> {
        if let DeValue::Table(_) = cell {
            return self.value(key, cell, unit, "family", start);
        }
        let path = format!("family.{}", key.path);
        let (mark, note) = self.founded(mark.clone(), &path, start)?;
        Ok(Value {
            key: key.path.to_string(),
            datum: self.datum(key, cell, unit, &path, start)?,
            mark,
            note,
        })
    }

    /// The text with each `{name}` replaced by what the row has under it.
    fn fill(&self, template: &str, texts: &[(&str, String)], start: usize) -> Read<String> {
        let mut filled = String::with_capacity(template.len() + 16);
        let mut rest = template;
        while let Some((before, after)) = rest.split_once('{') {
            filled.push_str(before);
            let Some((name, after)) = after.split_once('}') else {
                rest = after;
                break;
            };
            let known = || texts.iter().map(|(known, _)| *known);
            let Some((_, text)) = texts.iter().find(|(known, _)| *known == name) else {
                let listed: Vec<&str> = known().collect();
                let mut problem = self.problem(
                    Code::UnknownWord,
                    start,
                    "family",
                    format!("{{{name}}} in \"{template}\""),
                    format!("a column is needed there ({})", listed.join(", ")),
                );
                problem.hint = did_you_mean(name, known());
                return Err(problem);
            };
            filled.push_str(text);
            rest = after;
        }
        filled.push_str(rest);
        Ok(filled)
    }
}

fn note_text(cell: &DeValue<'_>) -> String {
    match cell {
        DeValue::String(text) => text.to_string(),
        DeValue::Integer(integer) => integer.to_string(),
        DeValue::Float(float) => float.as_str().to_string(),
        other => kind(other),
    }
}
