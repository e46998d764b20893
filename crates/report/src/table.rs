//! Tables as other programs take them: a head and rows of numbers, texts and empty cells.

use serde_json::Value;
use std::borrow::Cow;

/// One cell.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Cell<'a> {
    Empty,
    Number(f64),
    Text(Cow<'a, str>),
}

impl<'a> Cell<'a> {
    pub fn number(value: f64) -> Self {
        match value.is_finite() {
            true => Cell::Number(value),
            false => Cell::Empty,
        }
    }
    pub fn text(text: &'a str) -> Self {
        match text {
            "" => Cell::Empty,
            text => Cell::Text(text.into()),
        }
    }
    /// A value of the summary; what is no number and no text is empty.
    pub fn of(value: Option<&'a Value>) -> Self {
        match value {
            Some(Value::Number(number)) => number.as_f64().map_or(Cell::Empty, Cell::number),
            Some(Value::String(text)) => Cell::text(text),
            Some(Value::Bool(switch)) => Cell::Text(switch.to_string().into()),
            _ => Cell::Empty,
        }
    }
}

/// A table with a head.
pub(super) struct Table<'a> {
    pub name: &'static str,
    pub heads: Vec<String>,
    pub rows: usize,
    pub cell: Box<dyn Fn(usize, usize) -> Cell<'a> + 'a>,
}

impl<'a> Table<'a> {
    pub fn of_rows(name: &'static str, heads: Vec<String>, rows: Vec<Vec<Cell<'a>>>) -> Self {
        Table {
            name,
            heads,
            rows: rows.len(),
            cell: Box::new(move |row, column| {
                rows[row].get(column).cloned().unwrap_or(Cell::Empty)
            }),
        }
    }

    /// Columns of numbers, with empty cells below the shorter ones.
    pub fn of_columns(
        name: &'static str,
        heads: Vec<String>,
        columns: Vec<Cow<'a, [f64]>>,
    ) -> Self {
        let rows = columns.iter().map(|column| column.len()).max();
        Table {
            name,
            heads,
            rows: rows.unwrap_or(0),
            cell: Box::new(move |row, column| {
                let value = columns[column].get(row);
                value.map_or(Cell::Empty, |value| Cell::number(*value))
            }),
        }
    }

    /// Members of objects of the summary: (name there, head).
    pub fn of_objects(name: &'static str, keys: &[(&str, &str)], objects: &'a [Value]) -> Self {
        let row = |object: &'a Value| keys.iter().map(|(key, _)| Cell::of(object.get(key)));
        let heads = keys.iter().map(|(_, head)| (*head).to_string());
        let rows = objects.iter().map(|object| row(object).collect());
        Table::of_rows(name, heads.collect(), rows.collect())
    }
}
