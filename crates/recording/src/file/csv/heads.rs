//! Heads that name columns and clock in a form of their own: measurement files of LabVIEW, tables of oscilloscopes.

use super::cell::{self, Between, Cell, cells, row};
use super::layout::{Column, Kind, Layout, properties, property};
use super::lines::text;
use crate::file::clock;
use crate::file::{Property, Value};

/// The line behind a head of LabVIEW.
const END: &[u8] = b"***End_of_Header***";

impl Layout {
    /// Finds the layout from the first lines; none where no line holds values.
    pub fn of(lines: &[Vec<u8>]) -> Option<Layout> {
        if let Some(layout) = labview(lines) {
            return Some(layout);
        }
        let beside = beside(lines);
        let mut layout = match &beside {
            Some(beside) => Layout::plain(&beside.lines)?,
            None => Layout::plain(lines)?,
        };
        if let Some(beside) = beside {
            layout.skip = beside.skip;
            layout.properties.extend(beside.properties);
        }
        take_units(&mut layout);
        Some(layout)
    }
}

fn number(cell: Option<&String>, comma: bool) -> Option<f64> {
    match cell::read(cell?.as_bytes(), comma) {
        Cell::Number(number) => Some(number),
        _ => None,
    }
}

/// Whether a line ends a head of LabVIEW.
pub(super) fn is_end(line: &[u8]) -> bool {
    line.starts_with(END)
}

/// Whether a line of a file of LabVIEW belongs to a head: its first cell is a word.
pub(super) fn is_head(line: &[u8], layout: &Layout) -> bool {
    let mut head = false;
    cells(line, layout.between, |column, cell| {
        head |= column == 0 && cell::read(cell, layout.comma) == Cell::Text;
    });
    head
}

/// The layout of a measurement file of LabVIEW (.lvm).
///
/// Source: National Instruments, Specification for the LabVIEW Measurement File (.lvm), from memory.
pub(super) fn labview(lines: &[Vec<u8>]) -> Option<Layout> {
    lines
        .first()?
        .starts_with(b"LabVIEW Measurement")
        .then_some(())?;
    let stated = |key: &str| {
        let line = lines
            .iter()
            .find_map(|line| line.strip_prefix(key.as_bytes()))?;
        Some(text(line.get(1..)?))
    };
    let between = match stated("Separator") {
        Some(word) if word.starts_with("Comma") => b',',
        _ => b'\t',
    };
    let decimals = stated("Decimal_Separator").unwrap_or_default();
    let (between, comma) = (Between::Byte(between), decimals.starts_with(','));
    let mut ends = (0..lines.len()).filter(|&k| is_end(&lines[k]));
    let (first, second) = (ends.next()?, ends.next());
    let end = second.unwrap_or(first);
    let mut behind = (end + 1..lines.len()).filter(|&k| !lines[k].trim_ascii().is_empty());
    let (named, first) = (behind.next()?, behind.next()?);
    let names = row(&lines[named], between);
    let of = |key: &str| {
        let own = |line: &&Vec<u8>| line.starts_with(key.as_bytes());
        lines[..end]
            .iter()
            .find(own)
            .map(|line| row(line, between))
            .unwrap_or_default()
    };
    let (units, dimensions) = (of("Y_Unit_Label"), of("X_Dimension"));
    let (starts, steps) = (of("X0"), of("Delta_X"));
    let is_time = |k: usize| names[k] == "X_Value";
    let count = names
        .iter()
        .rposition(|name| !name.is_empty() && name != "Comment")?
        + 1;
    // Without a column of times its cell is empty, or is not there.
    let without = stated("X_Columns").is_some_and(|word| word.starts_with("No")) && is_time(0);
    let skip = usize::from(
        without
            && lines[first].starts_with(match between {
                Between::Byte(b',') => b",",
                _ => b"\t",
            }),
    );
    let several = (0..count).filter(|&k| is_time(k)).count() > 1;
    let columns = (usize::from(without)..count).map(|k| {
        let time = is_time(k);
        let steps = number(steps.get(k), comma).filter(|step| !time && *step > 0.0);
        let own = |cells: &[String], k: usize| cells.get(k).cloned().unwrap_or_default();
        let timed = matches!(own(&dimensions, k + 1).as_str(), "Time" | "");
        Column {
            name: match (names[k].as_str(), several) {
                ("", _) => format!("column {}", k + 1),
                ("X_Value", true) => format!("X_Value {}", own(&names, k + 1)),
                (name, _) => name.to_string(),
            },
            unit: match time {
                true if timed => "s".to_string(),
                true => String::new(),
                false => own(&units, k),
            },
            kind: Kind::Number,
            time,
            steps: steps.map(|step| (number(starts.get(k), comma).unwrap_or(0.0), step)),
        }
    });
    Some(Layout {
        between,
        comma,
        columns: columns.collect(),
        first,
        properties: properties(&lines[..end], (between, comma)),
        named: true,
        skip,
        labview: true,
    })
}

/// A table without the head that stood in cells beside it.
pub(super) struct Beside {
    pub lines: Vec<Vec<u8>>,
    pub skip: usize,
    pub properties: Vec<Property>,
}

/// A head in the cells beside a table, as oscilloscopes write it.
pub(super) fn beside(lines: &[Vec<u8>]) -> Option<Beside> {
    tektronix(lines).or_else(|| rigol(lines))
}

/// `Record Length,2500,,time,value,`: names and values before the table, three cells wide.
fn tektronix(lines: &[Vec<u8>]) -> Option<Beside> {
    const WIDE: usize = 3;
    let comma = Between::Byte(b',');
    let first = row(lines.first()?, comma);
    let both = |k: usize| number(first.get(k), false).is_some();
    (first[0] == "Record Length" && both(WIDE) && both(WIDE + 1)).then_some(())?;
    let rows = || lines.iter().map(|line| row(line, comma));
    let head = rows().filter_map(|row| property(row.first()?, row.get(1)?, false));
    Some(Beside {
        lines: rows()
            .map(|row| row.get(WIDE..).unwrap_or(&[]).join(",").into_bytes())
            .collect(),
        skip: WIDE,
        properties: head.collect(),
    })
}

/// `X,CH1,CH2,Start,Increment` with the numbers of the last two in the row of units below.
fn rigol(lines: &[Vec<u8>]) -> Option<Beside> {
    let comma = Between::Byte(b',');
    let (names, mut units) = (row(lines.first()?, comma), row(lines.get(1)?, comma));
    let start = names.iter().position(|name| name == "Start")?;
    (start > 0 && names.get(start + 1).is_some_and(|name| name == "Increment")).then_some(())?;
    number(units.get(start), false).and(number(units.get(start + 1), false))?;
    let head = (start..start + 2).filter_map(|k| property(&names[k], &units[k], false));
    let properties = head.collect();
    if units[0] == "Sequence" {
        units[0].clear();
    }
    let mut lines = lines.to_vec();
    lines[0] = names[..start].join(",").into_bytes();
    lines[1] = units[..start].join(",").into_bytes();
    Some(Beside {
        lines,
        skip: 0,
        properties,
    })
}

/// Takes names and units of columns from what oscilloscopes state above the table.
pub(super) fn take_units(layout: &mut Layout) {
    let stated = |name: &str| {
        let own = |p: &&Property| p.name.eq_ignore_ascii_case(name);
        match &layout.properties.iter().find(own)?.value {
            Value::Text(text) => Some(text.clone()),
            _ => None,
        }
    };
    let (along, across) = (stated("Horizontal Units"), stated("Vertical Units"));
    let source = stated("Source").filter(|_| !layout.named && layout.columns.len() == 2);
    if let Some(source) = source {
        layout.columns[0].name = "time".to_string();
        layout.columns[1].name = source;
        layout.named = true;
    }
    let seconds = along.filter(|unit| clock::seconds_in(unit).is_some());
    let alone = layout.columns.len() == 2;
    for column in layout.columns.iter_mut().filter(|c| c.unit.is_empty()) {
        match (clock::is_time_name(&column.name), &seconds, &across) {
            (true, Some(unit), _) => column.unit.clone_from(unit),
            (false, _, Some(unit)) if alone => column.unit.clone_from(unit),
            _ => {}
        }
    }
}
