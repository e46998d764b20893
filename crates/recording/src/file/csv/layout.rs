//! How a table is laid out, found from its first lines.

use super::cell::{self, Between, Cell, cells};
use super::lines::text;
use super::moment;
use crate::file::clock;
use crate::file::{Property, Value};

/// What the cells of a column hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Number,
    Moment,
    Text,
}

/// A column.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Column {
    pub name: String,
    pub unit: String,
    pub kind: Kind,
    /// Whether a head says that it holds times.
    pub time: bool,
    /// First time and interval, s, that a head states of the column by itself.
    pub steps: Option<(f64, f64)>,
}

/// How a table is laid out.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    pub between: Between,
    /// Whether a comma stands before the decimals.
    pub comma: bool,
    pub columns: Vec<Column>,
    /// Which of the first lines, counted from 0, is the first of values.
    pub first: usize,
    /// What stands before the table.
    pub properties: Vec<Property>,
    /// Whether the columns have names of the file.
    pub named: bool,
    /// Cells before the first column that belong to a head beside the table.
    pub skip: usize,
    /// Whether the file is one of LabVIEW, which may have heads between rows of values.
    pub labview: bool,
}

/// What may stand between cells, and whether a comma stands before decimals, the most usual first.
const FORMS: [(Between, bool); 9] = [
    (Between::Byte(b'\t'), false),
    (Between::Byte(b'\t'), true),
    (Between::Byte(b';'), false),
    (Between::Byte(b';'), true),
    (Between::Byte(b','), false),
    (Between::Byte(b'|'), false),
    (Between::Byte(b'|'), true),
    (Between::Blanks, false),
    (Between::Blanks, true),
];

/// Units of the laboratory that are not quantities of mechanics.
const OTHER_UNITS: &[&str] = &[
    "-", "V", "mV", "µV", "uV", "kV", "A", "mA", "dB", "Ohm", "Ω", "C", "F", "µm/m", "um/m", "g",
    "counts", "LSB", "EU", "U/min", "1/min", "min-1", "min^-1", "m/s2", "mV/V", "lx", "digit",
    "µε", "Volt", "Volts", "Ampere", "Amp",
];

/// Whether a line is a remark.
pub(super) fn is_remark(line: &[u8]) -> bool {
    let line = line.trim_ascii_start();
    line.starts_with(b"#") || line.starts_with(b"%") || line.starts_with(b"//")
}

fn without_remark(line: &[u8]) -> &[u8] {
    let marks = |byte: &&u8| matches!(**byte, b'#' | b'%' | b'/' | b' ');
    if is_remark(line) {
        &line[line.iter().take_while(marks).count()..]
    } else {
        line
    }
}

/// What the cells of a line hold.
fn kinds(line: &[u8], between: Between, comma: bool) -> Vec<Option<Kind>> {
    let mut found = Vec::new();
    cells(line, between, |_, cell| {
        found.push(match cell::read(cell, comma) {
            Cell::Number(_) => Some(Kind::Number),
            Cell::Missing => None,
            Cell::Text if moment::read(cell).is_some() => Some(Kind::Moment),
            Cell::Text => Some(Kind::Text),
        });
    });
    found
}

/// How well a form fits: how many cells are values, in how many columns.
struct Fit {
    form: (Between, bool),
    /// Sum over the lines of the part of their cells that are values.
    values: f64,
    columns: usize,
    /// What each column mostly holds.
    kinds: Vec<Kind>,
    /// The first line of values.
    first: usize,
    /// Whether the last cell of all lines of values is empty.
    open_end: bool,
}

impl Layout {
    /// The layout of a table whose head has no form of its own.
    pub fn plain(lines: &[Vec<u8>]) -> Option<Layout> {
        let mut best: Option<(Fit, (u64, bool, usize))> = None;
        for form in FORMS {
            let Some(fit) = fit(lines, form) else {
                continue;
            };
            let headed = head_of(lines, &fit).is_some();
            // Millionths, so that rounding of the sum decides nothing.
            let rank = ((fit.values * 1e6).round() as u64, headed, fit.columns);
            if best.as_ref().is_none_or(|(_, known)| rank > *known) {
                best = Some((fit, rank));
            }
        }
        let (fit, _) = best?;
        let head = head_of(lines, &fit);
        let (names, units, from) = match head {
            Some((names, units, from)) => (names, units, from),
            None => (Vec::new(), Vec::new(), fit.first),
        };
        let unnamed_end = names.get(fit.columns - 1).is_none_or(String::is_empty);
        let count = match fit.columns {
            columns @ 2.. if fit.open_end && unnamed_end => columns - 1,
            columns => columns,
        };
        let columns = (0..count).map(|k| {
            let head = names.get(k).map_or("", String::as_str);
            let (mut name, mut unit) = name_and_unit(head);
            if let Some(own) = units.get(k).filter(|own| !own.is_empty()) {
                unit = own.clone();
            }
            if name.is_empty() {
                name = format!("column {}", k + 1);
            }
            Column {
                name,
                unit,
                kind: fit.kinds[k],
                time: false,
                steps: None,
            }
        });
        Some(Layout {
            between: fit.form.0,
            comma: fit.form.1,
            columns: columns.collect(),
            first: fit.first,
            properties: properties(&lines[..from], fit.form),
            named: !names.is_empty(),
            skip: 0,
            labview: false,
        })
    }
}

fn fit(lines: &[Vec<u8>], form: (Between, bool)) -> Option<Fit> {
    let is_value = |kind: &Option<Kind>| matches!(kind, Some(Kind::Number | Kind::Moment));
    let mut counts: Vec<(usize, usize)> = Vec::new();
    let mut all: Vec<Vec<Option<Kind>>> = Vec::with_capacity(lines.len());
    for line in lines {
        let kinds = match line.is_empty() || is_remark(line) {
            true => Vec::new(),
            false => kinds(line, form.0, form.1),
        };
        let values = kinds.iter().filter(|kind| is_value(kind)).count();
        let texts = kinds
            .iter()
            .filter(|kind| **kind == Some(Kind::Text))
            .count();
        if values > 0 && values >= texts {
            match counts
                .iter_mut()
                .find(|(columns, _)| *columns == kinds.len())
            {
                Some((_, count)) => *count += 1,
                None => counts.push((kinds.len(), 1)),
            }
        }
        all.push(kinds);
    }
    let (columns, _) = counts
        .into_iter()
        .max_by_key(|&(columns, count)| (count, columns))?;
    let whole = || {
        all.iter().filter(|kinds| {
            let values = kinds.iter().filter(|kind| is_value(kind)).count();
            kinds.len() == columns && values > 0
        })
    };
    let kinds: Vec<Kind> = (0..columns)
        .map(|k| {
            let count = |kind| whole().filter(|line| line[k] == Some(kind)).count();
            let (numbers, moments) = (count(Kind::Number), count(Kind::Moment));
            let texts = count(Kind::Text);
            if texts > numbers + moments {
                Kind::Text
            } else if moments > numbers {
                Kind::Moment
            } else {
                Kind::Number
            }
        })
        .collect();
    let is_first = |line: &Vec<Option<Kind>>| {
        let fits = line
            .iter()
            .zip(&kinds)
            .all(|(cell, kind)| *kind == Kind::Text || cell.is_none_or(|cell| cell == *kind));
        line.len() == columns && line.iter().any(is_value) && fits
    };
    let first = all.iter().position(is_first)?;
    let values = whole().map(|line| {
        let values = line.iter().filter(|kind| is_value(kind)).count() as f64;
        let missing = line.iter().filter(|kind| kind.is_none()).count() as f64;
        // An empty cell speaks for what stands around it, a little less than a number.
        (values + 0.9 * missing) / columns as f64
    });
    Some(Fit {
        form,
        values: values.sum(),
        columns,
        first,
        open_end: whole().all(|line| line.last() == Some(&None)),
        kinds,
    })
}

/// Names and units above a table, and the line where they start.
fn head_of(lines: &[Vec<u8>], fit: &Fit) -> Option<(Vec<String>, Vec<String>, usize)> {
    let mut above = (0..fit.first)
        .rev()
        .filter(|&at| !lines[at].trim_ascii().is_empty());
    let row = |at: usize| {
        let line = without_remark(&lines[at]);
        let found = cell::row(line, fit.form.0);
        let spare = found.len() == fit.columns + 1 && found.last().is_some_and(String::is_empty);
        let short = found.len() + 1 == fit.columns && fit.open_end;
        (found.len() == fit.columns || spare || short).then_some(found)
    };
    let last = above.next()?;
    let lower = row(last)?;
    if is_units(&lower)
        && let Some(before) = above.next()
        && let Some(upper) = row(before).filter(|upper| !is_units(upper))
    {
        let units = lower.iter().map(|unit| bare(unit).to_string()).collect();
        return Some((upper, units, before));
    }
    Some((lower, Vec::new(), last))
}

/// Whether the cells of a row are units.
fn is_units(row: &[String]) -> bool {
    let mut filled = row.iter().filter(|cell| !cell.is_empty()).peekable();
    filled.peek().is_some() && filled.all(|cell| bare(cell) != cell.as_str() || is_unit(cell))
}

/// A unit without brackets around it.
fn bare(unit: &str) -> &str {
    let unit = unit.trim();
    let inner = |open, close| {
        unit.strip_prefix(open)
            .and_then(|u: &str| u.strip_suffix(close))
    };
    inner('[', ']')
        .or_else(|| inner('(', ')'))
        .unwrap_or(unit)
        .trim()
}

fn is_unit(text: &str) -> bool {
    let text = text.trim();
    clock::seconds_in(text).is_some()
        || OTHER_UNITS.contains(&text)
        || units::Unit::parse(text).is_ok()
}

/// Name and unit of `name [unit]`, `name (unit)`, `name / unit`, or `time_s`.
fn name_and_unit(head: &str) -> (String, String) {
    let head = head.trim();
    let of = |name: &str, unit: &str| (name.trim().to_string(), unit.trim().to_string());
    if let Some((name, unit)) = head.strip_suffix(']').and_then(|h| h.rsplit_once('[')) {
        return of(name, unit);
    }
    if let Some((name, unit)) = head.strip_suffix(')').and_then(|h| h.rsplit_once('('))
        && is_unit(unit)
    {
        return of(name, unit);
    }
    if let Some((name, unit)) = head.rsplit_once(" / ").filter(|(_, unit)| is_unit(unit)) {
        return of(name, unit);
    }
    if let Some((name, unit)) = head.rsplit_once('_')
        && clock::is_time_name(name)
        && clock::seconds_in(unit).is_some()
    {
        return of(name, unit);
    }
    of(head, "")
}

/// What the lines above a table state: `name: value`, `name = value`, or two cells.
pub(super) fn properties(lines: &[Vec<u8>], form: (Between, bool)) -> Vec<Property> {
    let mut found = Vec::new();
    for line in lines {
        let line = without_remark(line);
        let mut row = cell::row(line, form.0);
        while row.len() > 1 && row.last().is_some_and(String::is_empty) {
            row.pop();
        }
        let whole = text(line);
        let pair = match &row[..] {
            [name, value] => Some((name.as_str(), value.as_str())),
            _ => whole.split_once([':', '=']),
        };
        let Some((name, value)) = pair else {
            continue;
        };
        found.extend(property(name, value, form.1));
    }
    found
}

/// What a name and a value above a table state; `comma`: whether it stands before decimals.
pub(super) fn property(name: &str, value: &str, comma: bool) -> Option<Property> {
    let (name, unit) = name_and_unit(name.trim().trim_end_matches([':', '=']));
    let value = value.trim().trim_matches('"');
    if name.is_empty() || value.is_empty() {
        return None;
    }
    let value = match cell::read(value.as_bytes(), comma) {
        Cell::Number(number) if unit.is_empty() => Value::Number(number),
        Cell::Number(number) => match known_scale(&unit) {
            Some(scale) => Value::Number(number * scale),
            None => Value::Text(format!("{value} {unit}")),
        },
        _ => Value::Text(value.to_string()),
    };
    Some(Property { name, value })
}

/// What a number of a rate or an interval is to be multiplied by for 1/s or s.
fn known_scale(unit: &str) -> Option<f64> {
    match unit {
        "Hz" | "S/s" | "1/s" => Some(1.0),
        "kHz" | "kS/s" => Some(1e3),
        "MHz" | "MS/s" => Some(1e6),
        unit => clock::seconds_in(unit),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layout(text: &str) -> Layout {
        let lines: Vec<Vec<u8>> = text.lines().map(|line| line.as_bytes().to_vec()).collect();
        Layout::of(&lines).unwrap()
    }

    fn heads(layout: &Layout) -> Vec<(&str, &str)> {
        let heads = layout.columns.iter();
        heads.map(|c| (c.name.as_str(), c.unit.as_str())).collect()
    }

    #[test]
    fn separators_and_decimals_are_distinguished() {
        let cases = [
            ("a,b\n1.5,2\n3,4\n", Between::Byte(b','), false, 2),
            ("a;b\n1,5;2,5\n3,0;4\n", Between::Byte(b';'), true, 2),
            ("a\tb\n1,5\t2,5\n", Between::Byte(b'\t'), true, 2),
            ("a b c\n1 2 3\n  4  5 6\n", Between::Blanks, false, 3),
            ("speed\n1,5\n2,5\n", Between::Byte(b'\t'), true, 1),
            ("x,y\n1,5\n2,5\n", Between::Byte(b','), false, 2),
            ("a;b;c\n1;;3\n4;5;\n", Between::Byte(b';'), false, 3),
        ];
        for (text, between, comma, columns) in cases {
            let found = layout(text);
            let form = (found.between, found.comma, found.columns.len());
            assert_eq!(form, (between, comma, columns), "{text:?}");
        }
    }

    #[test]
    fn units_stand_in_a_row_or_in_the_heads() {
        let row = layout("Zeit;Kraft\n[s];[N]\n0;1,5\n1;2,5\n");
        assert_eq!(heads(&row), [("Zeit", "s"), ("Kraft", "N")]);
        let row = layout("time,speed\ns,rpm\n0,1\n");
        assert_eq!(heads(&row), [("time", "s"), ("speed", "rpm")]);
        let inside = layout("Time (ms),Torque (filtered),Arm / mV,t_s\n0,1,2,3\n");
        let expected = [
            ("Time", "ms"),
            ("Torque (filtered)", ""),
            ("Arm", "mV"),
            ("t", "s"),
        ];
        assert_eq!(heads(&inside), expected);
        let letters = layout("t,s\n0,1\n");
        assert_eq!(heads(&letters), [("t", ""), ("s", "")]);
        assert_eq!(
            heads(&layout("1,2\n3,4\n")),
            [("column 1", ""), ("column 2", "")]
        );
    }

    #[test]
    fn what_stands_before_the_table_is_kept() {
        let found = layout("Logger 7\nSample rate,1000\nOperator: nobody\n\n# t,F\n0,1\n1,2\n");
        assert_eq!(heads(&found), [("t", ""), ("F", "")]);
        assert_eq!(found.first, 5);
        let names: Vec<&str> = found.properties.iter().map(|p| p.name.as_str()).collect();
        assert_eq!(names, ["Sample rate", "Operator"]);
        assert_eq!(found.properties[0].value, Value::Number(1000.0));
    }

    #[test]
    fn a_separator_at_the_end_of_lines_makes_no_column() {
        assert_eq!(layout("a;b;\n1;2;\n3;4;\n").columns.len(), 2);
        assert_eq!(layout("a;b\n1;2;\n3;4;\n").columns.len(), 2);
    }
}
