//! Text in columns: reader and writer.
//!
//! Found from the first lines: what stands between cells (comma, semicolon, tab, stroke, blanks), whether a comma or a
//! point stands before decimals, the lines before the table, the row of names, and units in a row of their own or in
//! the names (`force [N]`, `force (N)`, `force / N`). Letters are UTF-8, UTF-16 with its mark, or Latin-1.
//!
//! A column of times, known by its name (`time`, `t`, `Zeit` …) or by being the first in a unit of time, is the clock;
//! equal spacing within the rounding of its numbers makes the clock uniform. Without one, a line such as
//! `Sample rate: 1000` before the table states it.
//!
//! Opening reads the whole file once and keeps where every some thousand lines start; values are read on demand. An
//! empty cell and one that is no number are not-a-number, and are noted with column and line; so is a last line without a
//! line end, whose last number may be a part of one.

mod cell;
mod clocks;
mod faults;
mod heads;
mod layout;
mod lines;
mod moment;
mod write;

use std::io::{Read, Seek};
use std::path::Path;

use super::clock::{self, Spacing};
use super::source::Source;
use crate::{Channel, Content, FileError, Instant, Note, Recording};
use cell::{Cell, cells};
use faults::{Faults, Lost, Rounding, count};
use layout::{Kind, Layout};
use lines::{Letters, Lines};
use moment::Moment;
pub use write::CsvWriter;

/// Lines and bytes from which the layout is found.
const HEAD_LINES: usize = 2000;
const HEAD_BYTES: usize = 1 << 20;

/// Most values of a block, and most lines of it.
const BLOCK_VALUES: usize = 1 << 18;
const BLOCK_ROWS: usize = 4096;

/// Values that are kept.
const KEPT_VALUES: usize = 1 << 22;

/// Before the first time of a day.
const NO_DAY: (f64, f64) = (f64::NEG_INFINITY, 0.0);
/// A time of the day that is so much earlier than the one before is of the next day, s.
const NEXT_DAY: f64 = 43_200.0;

/// Most columns that are read.
const MOST_COLUMNS: usize = 1 << 16;

/// Whether a file that starts with these bytes may be text in columns: it is text. Whether it holds values shows when
/// it is opened.
pub fn is_csv(head: &[u8]) -> bool {
    let (letters, mark) = Letters::of(head);
    if letters != Letters::Bytes {
        return true;
    }
    super::is_plain_text(&head[(mark as usize).min(head.len())..])
}

/// Lines of the file that were found together.
#[derive(Clone, Copy, Debug)]
struct Block {
    /// Where its first line starts, and which line of the file that is, counted from 1.
    at: u64,
    line: u64,
    /// Index of its first row of values.
    row: u64,
    /// Last time of the day before it, s, and how many midnights came.
    day: (f64, f64),
}

/// A table that is open for reading.
pub struct Csv<S> {
    source: Source<S>,
    letters: Letters,
    layout: Layout,
    channels: Vec<Channel>,
    starts: Vec<Option<Instant>>,
    blocks: Vec<Block>,
    rows: u64,
    rows_of_block: usize,
    /// The column of times, and the last time of a day with the midnights before it.
    time: Option<usize>,
    day: (f64, f64),
    /// Heads that stand between rows of values.
    heads: u64,
    notes: Vec<Note>,
    /// Values of blocks, row by row, the one used last at the end.
    kept: Vec<(usize, Vec<f64>)>,
}

shown_by_contents!(Csv);

impl<S: Read + Seek> Csv<S> {
    /// Reads the table once, without keeping the values of large files; errors name `path`.
    ///
    /// An error where no line of the first megabyte holds values.
    pub fn from_source(source: S, path: &Path) -> Result<Csv<S>, FileError> {
        let mut source = Source::new(source, path)?;
        let mut mark = [0; 3];
        let there = source.read_at(0, &mut mark)?;
        let (letters, mark) = Letters::of(&mark[..there]);
        let mut begin = vec![0; HEAD_BYTES.min(1 << 16)];
        let there = source.read_at(0, &mut begin)?;
        let letters = letters.with_ends(&begin[..there]);
        let mut lines = Lines::new(letters, mark);
        let (mut head, mut places, mut line, mut bytes) = (Vec::new(), Vec::new(), Vec::new(), 0);
        while head.len() < HEAD_LINES && bytes < HEAD_BYTES {
            places.push(lines.at());
            if !lines.next(&mut source, &mut line)? {
                break;
            }
            bytes += line.len() + 1;
            head.push(line.clone());
        }
        let Some(layout) = Layout::of(&head) else {
            let needed = "rows of numbers with comma, semicolon, tab or blanks between them";
            return Err(FileError::new(
                path,
                "",
                "is text, but no table of numbers",
                needed,
            ));
        };
        if layout.columns.len() > MOST_COLUMNS {
            let found = format!("has {} columns", layout.columns.len());
            let needed = format!("at most {MOST_COLUMNS} can be read");
            return Err(FileError::new(path, "", found, needed));
        }
        let channels = layout.columns.iter().map(|column| Channel {
            unit: column.unit.clone(),
            content: match column.kind {
                Kind::Number => Content::Number,
                Kind::Moment => Content::Time,
                Kind::Text => Content::Text,
            },
            ..Channel::new(column.name.clone(), 0)
        });
        let width = layout.columns.len();
        let first = Block {
            at: places[layout.first],
            line: layout.first as u64 + 1,
            row: 0,
            day: NO_DAY,
        };
        let mut file = Csv {
            source,
            letters,
            channels: channels.collect(),
            starts: vec![None; width],
            blocks: Vec::new(),
            rows: 0,
            rows_of_block: (BLOCK_VALUES / width).clamp(1, BLOCK_ROWS),
            time: None,
            day: NO_DAY,
            heads: 0,
            notes: Vec::new(),
            kept: Vec::new(),
            layout,
        };
        file.index(first)?;
        Ok(file)
    }

    /// The column of times, if there is one.
    fn time(&self) -> Option<usize> {
        let columns = &self.layout.columns;
        let named = columns
            .iter()
            .position(|c| c.kind != Kind::Text && clock::is_time_name(&c.name));
        let moment = columns.iter().position(|c| c.kind == Kind::Moment);
        let first = columns.first().filter(|c| c.kind == Kind::Number);
        let first = first.filter(|c| clock::seconds_in(&c.unit).is_some());
        named.or(moment).or(first.map(|_| 0))
    }

    /// Reads the whole table once: where its blocks start, what is wrong with it, and its clock.
    fn index(&mut self, first: Block) -> Result<(), FileError> {
        let time = self.time();
        self.time = time;
        let (mut lines, mut line) = (Lines::new(self.letters, first.at), Vec::new());
        let mut number = first.line;
        let mut cut = None;
        let mut faults = vec![Faults::default(); self.channels.len()];
        let mut lost = Lost::default();
        let mut spacing = Spacing::new();
        let mut rounding = Rounding::default();
        let mut back_line = 0;
        let (mut values, mut row) = (Vec::new(), Vec::new());
        loop {
            let (at, day) = (lines.at(), self.day);
            if !lines.next(&mut self.source, &mut line)? {
                break;
            }
            let there = self.take_row(&line, &mut row, Some((&mut faults, &mut lost, number)));
            if there {
                if self.rows.is_multiple_of(self.rows_of_block as u64) {
                    self.keep(&mut values);
                    self.blocks.push(Block {
                        at,
                        line: number,
                        row: self.rows,
                        day,
                    });
                }
                if let Some(time) = time {
                    let slack = self.slack(&line, time, row[time], &mut rounding);
                    spacing.add(row[time], slack);
                    if spacing.back.is_some() && back_line == 0 {
                        back_line = number;
                    }
                }
                values.extend(&row);
                self.rows += 1;
                cut = (!lines.ended()).then_some(number);
            }
            number += 1;
        }
        self.keep(&mut values);
        for channel in &mut self.channels {
            channel.count = self.rows;
        }
        self.set_notes(&faults, &lost);
        if let Some(line) = cut {
            self.notes.push(Note::of_file(format!(
                    "the last line, {line}, has no line end: if the file was cut off there, its last number is a part of one"
                )));
        }
        self.set_clock(time, &spacing, back_line);
        Ok(())
    }

    /// How many blocks are kept.
    fn most_kept(&self) -> usize {
        (KEPT_VALUES / (self.rows_of_block * self.channels.len())).max(4)
    }

    /// Keeps the values of the block that was read last, while there is room.
    fn keep(&mut self, values: &mut Vec<f64>) {
        if let Some(block) = self.blocks.len().checked_sub(1) {
            if self.kept.len() < self.most_kept() {
                self.kept.push((block, std::mem::take(values)));
            }
            values.clear();
        }
    }

    /// How far a time may be from what it was before it was written.
    fn slack(&self, line: &[u8], time: usize, value: f64, rounding: &mut Rounding) -> f64 {
        if self.layout.columns[time].kind == Kind::Moment {
            // Loggers write at least milliseconds, or whole seconds.
            let mut slack = 1.0;
            cells(line, self.layout.between, |column, cell| {
                if column == time + self.layout.skip {
                    let point = cell.iter().rposition(|&b| b == b'.' || b == b',');
                    let last = cell.iter().rposition(|&b| b == b':').unwrap_or(0);
                    let decimals = point
                        .filter(|&p| p > last)
                        .map_or(0, |p| cell.len() - p - 1);
                    slack = 10f64.powi(-(decimals.min(12) as i32));
                }
            });
            return slack;
        }
        let mut slack = 0.0;
        cells(line, self.layout.between, |column, cell| {
            if column == time + self.layout.skip {
                slack = rounding.of(cell, self.layout.comma, value);
            }
        });
        slack
    }

    /// Reads the cells of a line into a row; returns whether it is one of values.
    fn take_row(
        &mut self,
        line: &[u8],
        row: &mut Vec<f64>,
        mut report: Option<(&mut Vec<Faults>, &mut Lost, u64)>,
    ) -> bool {
        row.clear();
        if line.trim_ascii().is_empty() || layout::is_remark(line) {
            return false;
        }
        if self.layout.labview && heads::is_head(line, &self.layout) {
            self.heads += u64::from(report.is_some() && heads::is_end(line));
            return false;
        }
        let (width, skip) = (self.channels.len(), self.layout.skip);
        row.resize(width, f64::NAN);
        let (mut values, mut texts) = (0, 0);
        // Columns of what is no value are noted only when the line turns out to be one of values.
        let mut wrong: Vec<(usize, Option<&[u8]>)> = Vec::new();
        let (comma, columns, starts) = (self.layout.comma, &self.layout.columns, &mut self.starts);
        let found = cells(line, self.layout.between, |column, cell| {
            let Some(column) = column.checked_sub(skip).filter(|column| *column < width) else {
                return;
            };
            match columns[column].kind {
                Kind::Text => {}
                Kind::Number => match cell::read(cell, comma) {
                    Cell::Number(number) => {
                        row[column] = number;
                        values += 1;
                    }
                    Cell::Missing => wrong.push((column, None)),
                    Cell::Text => {
                        texts += 1;
                        wrong.push((column, Some(cell)));
                    }
                },
                Kind::Moment => match moment::read(cell) {
                    Some(moment) => {
                        if let (Moment::Instant(now), None) = (moment, starts[column]) {
                            starts[column] = Some(now);
                        }
                        row[column] = moment.since(starts[column]);
                        values += 1;
                    }
                    None if cell.is_empty() => wrong.push((column, None)),
                    None => {
                        texts += 1;
                        wrong.push((column, Some(cell)));
                    }
                },
            }
        });
        // A head that stands in the middle, where the logger started again.
        if values == 0 && texts > 1 {
            if let Some((_, lost, number)) = &mut report {
                count(&mut lost.left_out, *number);
            }
            return false;
        }
        if let Some(time) = self.time.filter(|&time| {
            columns[time].kind == Kind::Moment && starts[time].is_none() && row[time].is_finite()
        }) {
            const DAY: f64 = 86_400.0;
            let (last, days) = self.day;
            let days = days + f64::from(u8::from(row[time] + DAY * days < last - NEXT_DAY));
            row[time] += DAY * days;
            self.day = (row[time], days);
        }
        if let Some((faults, lost, number)) = report {
            for (column, text) in wrong {
                faults[column].add(text, number);
            }
            if found < width + skip {
                count(&mut lost.short, number);
            } else if cells_after(line, self.layout.between, width + skip) {
                count(&mut lost.long, number);
            }
        }
        true
    }

    fn set_notes(&mut self, faults: &[Faults], lost: &Lost) {
        for (channel, faults) in self.channels.iter().zip(faults) {
            let mut note = |text: String| {
                self.notes.push(Note::of(&channel.name, text));
            };
            if faults.missing.0 > 0 {
                note(format!(
                    "{} cells are empty, the first in line {}; they are not-a-number",
                    faults.missing.0, faults.missing.1
                ));
            }
            if faults.texts.0 > 0 {
                note(format!(
                    "{} cells are no numbers, the first in line {}: “{}”; they are not-a-number",
                    faults.texts.0, faults.texts.1, faults.example
                ));
            }
        }
        let lines = [
            (lost.short, "are short; what is missing is not-a-number"),
            (
                lost.long,
                "have more cells than columns; the rest is left out",
            ),
            (lost.left_out, "hold no values; they are left out"),
        ];
        for ((count, first), text) in lines {
            if count > 0 {
                self.notes.push(Note::of_file(format!(
                    "{count} lines {text}; the first is line {first}"
                )));
            }
        }
        if !self.layout.named {
            self.notes.push(Note::of_file(
                "the columns have no names; they are numbered",
            ));
        }
    }

    /// The values of a block, row by row.
    fn block(&mut self, block: usize) -> Result<&[f64], FileError> {
        if let Some(known) = self.kept.iter().position(|(known, _)| *known == block) {
            let entry = self.kept.remove(known);
            self.kept.push(entry);
        } else {
            let Block {
                at,
                row: first,
                day,
                ..
            } = self.blocks[block];
            self.day = day;
            let rows = (self.rows - first).min(self.rows_of_block as u64) as usize;
            let (mut lines, mut line, mut row) =
                (Lines::new(self.letters, at), Vec::new(), Vec::new());
            let mut values = Vec::with_capacity(rows * self.channels.len());
            let mut taken = 0;
            while taken < rows && lines.next(&mut self.source, &mut line)? {
                if self.take_row(&line, &mut row, None) {
                    values.extend(&row);
                    taken += 1;
                }
            }
            // A file that was changed while it was open.
            values.resize(rows * self.channels.len(), f64::NAN);
            if self.kept.len() >= self.most_kept() {
                self.kept.remove(0);
            }
            self.kept.push((block, values));
        }
        Ok(self.kept.last().map_or(&[], |(_, values)| values))
    }
}

/// Whether one of the cells past the last column holds anything.
fn cells_after(line: &[u8], between: cell::Between, width: usize) -> bool {
    let mut filled = false;
    cells(line, between, |column, cell| {
        filled |= column >= width && !cell.is_empty();
    });
    filled
}

impl<S: Read + Seek> Recording for Csv<S> {
    contents!(self, self.source.path(), self);

    fn fill(&mut self, channel: usize, first: u64, values: &mut [f64]) -> Result<usize, FileError> {
        let there = values.len();
        let (width, per_block) = (self.channels.len(), self.rows_of_block as u64);
        let mut done = 0;
        while done < there {
            let row = first + done as u64;
            let (block, inside) = ((row / per_block) as usize, (row % per_block) as usize);
            let rows = self.block(block)?;
            let from = rows.iter().skip(inside * width + channel).step_by(width);
            let before = done;
            for (to, &from) in values[done..there].iter_mut().zip(from) {
                *to = from;
                done += 1;
            }
            if done == before {
                break;
            }
        }
        Ok(done)
    }
}
