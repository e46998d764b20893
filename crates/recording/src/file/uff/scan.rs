//! The sets of a file: where they are, and what their headers state.

use std::collections::BTreeMap;
use std::io::{Read, Seek};

use super::header::{Header, header};
use super::is_uff_mark;
use super::set::{Body, Set};
use super::text::{Numbers, columns, decoded, is_plain, line, value};
use crate::file::keep_note;
use crate::file::source::{Source, WINDOW};
use crate::{FileError, Note};

/// Lines of a header of set 58, without the one that names the set.
const HEADER: usize = 11;

/// Values from one kept place of a text to the next.
pub const PLACES: u64 = 4096;

/// What a file holds.
#[derive(Debug, Default)]
pub struct Contents {
    /// The sets 58 in their order.
    pub sets: Vec<Set>,
    /// Number of the system of units by the set 164: 1 is SI.
    pub units: Option<u32>,
    /// What was wrong.
    pub notes: Vec<Note>,
}

impl Contents {
    /// Keeps a note unless there are many.
    pub fn note(&mut self, channel: Option<String>, text: impl Into<String>) {
        let text = text.into();
        keep_note(&mut self.notes, Note { channel, text });
    }

    /// Finds the sets of a file.
    pub fn of<S: Read + Seek>(source: &mut Source<S>) -> Result<Contents, FileError> {
        let mut contents = Contents::default();
        let mut skipped: BTreeMap<String, u64> = BTreeMap::new();
        let mut at = 0;
        while let Some((text, next)) = line(source, at)? {
            let (mark, blank) = (is_uff_mark(text), text.trim_ascii().is_empty());
            at = next;
            if !mark {
                if !blank {
                    contents.note(None, "has lines outside of its sets, which are left out");
                }
                continue;
            }
            let Some((text, next)) = line(source, at)? else {
                break;
            };
            if is_uff_mark(text) {
                // The mark that closes the set before is missing, or there are two: this one opens a set.
                continue;
            }
            let kind = decoded(text).0;
            at = next;
            at = match kind.split_whitespace().next().unwrap_or("") {
                "58" => contents.function(source, at, None)?,
                "58b" | "58B" => contents.function(source, at, Some(&kind))?,
                other => {
                    *skipped.entry(other.chars().take(8).collect()).or_default() +=
                        u64::from(other != "151" && other != "164");
                    contents.other(source, at, other)?
                }
            };
        }
        for (kind, count) in skipped.into_iter().filter(|kind| kind.1 > 0).take(20) {
            contents.note(None, format!("sets of type {kind} are left out ({count})"));
        }
        Ok(contents)
    }

    /// Reads what matters of a set of another type; returns the byte behind the mark that closes it.
    fn other<S: Read + Seek>(
        &mut self,
        source: &mut Source<S>,
        mut at: u64,
        kind: &str,
    ) -> Result<u64, FileError> {
        let mut number = 0;
        while let Some((text, next)) = line(source, at)? {
            at = next;
            if is_uff_mark(text) {
                break;
            }
            if number == 0 && kind == "164" {
                self.units = columns(&decoded(text).0, 0, 10).parse().ok();
            }
            number += 1;
        }
        Ok(at)
    }

    /// Reads a set 58, with the line that names it where it is binary; returns the byte behind the mark that closes it.
    fn function<S: Read + Seek>(
        &mut self,
        source: &mut Source<S>,
        start: u64,
        binary: Option<&str>,
    ) -> Result<u64, FileError> {
        let words = binary.unwrap_or_default().split_whitespace().skip(1);
        let words: Vec<u64> = words.filter_map(|word| word.parse().ok()).collect();
        let word = |number: usize| words.get(number).copied();
        // A vendor may add lines to the header; the number of its lines shows it.
        let count = word(2)
            .filter(|&lines| lines > HEADER as u64 && lines <= 100)
            .map_or(HEADER, |lines| lines as usize);
        let mut lines = Vec::with_capacity(count);
        let mut at = start;
        let mut latin = false;
        while lines.len() < count {
            let Some((text, next)) = line(source, at)? else {
                break;
            };
            if is_uff_mark(text) {
                break;
            }
            let (text, foreign) = decoded(text);
            latin |= foreign;
            lines.push(text);
            at = next;
        }
        let read = if lines.len() < HEADER {
            Err("its header is cut off".to_owned())
        } else {
            header(&lines)
        };
        let mut header = match read {
            Ok(header) => header,
            Err(why) => {
                self.note(
                    None,
                    format!("the set 58 at byte {start} is left out: {why}"),
                );
                return self.other(source, at, "58");
            }
        };
        if binary.is_some() && word(1).is_some_and(|format| format != 2) {
            self.note(
                header.set.name(),
                "is left out: its numbers are not of IEEE 754",
            );
            let stated = word(3).unwrap_or(0).min(source.length() - at);
            return self.other(source, at + stated, "58b");
        }
        let after = match binary {
            None => self.text(source, at, &mut header)?,
            Some(_) => self.binary(source, at, word(0) == Some(2), word(3), &mut header)?,
        };
        if latin {
            self.note(
                header.set.name(),
                "its header is not UTF-8: it is read as Latin-1",
            );
        }
        if header.set.count == 0 {
            self.note(header.set.name(), "has no values");
        }
        self.sets.push(header.set);
        Ok(after)
    }

    /// Counts the values of a text and keeps some of their places.
    fn text<S: Read + Seek>(
        &mut self,
        source: &mut Source<S>,
        mut at: u64,
        header: &mut Header,
    ) -> Result<u64, FileError> {
        let mut places = vec![(0, at)];
        let (mut numbers, mut wrong, mut first_wrong, mut closed) = (0u64, 0u64, at, false);
        while let Some((text, next)) = line(source, at)? {
            if is_uff_mark(text) {
                (at, closed) = (next, true);
                break;
            }
            if text.len() == WINDOW {
                let text =
                    format!("a line of more than {WINDOW} bytes: a number may be cut in two");
                self.note(header.set.name(), text);
            }
            let before = numbers;
            let mut bad = 0;
            for spelling in Numbers::of(text) {
                numbers += 1;
                // Most are seen to be sound at a glance; the others have to be looked at.
                bad += u64::from(!is_plain(spelling) && value(spelling).is_none());
            }
            if wrong == 0 && bad > 0 {
                first_wrong = at;
            }
            wrong += bad;
            if places.last().is_some_and(|last| before - last.0 >= PLACES) {
                places.push((before, at));
            }
            at = next;
        }
        let name = header.set.name();
        if wrong > 0 {
            self.note(name.clone(), format!("{wrong} of its values are no numbers, the first after byte {first_wrong}: they are NaN"));
        }
        let there = numbers / header.set.fields();
        header.set.count = self.counted(name.clone(), header.count, there);
        if !closed {
            self.note(name, "its set is not closed: the file was cut off");
        }
        header.set.body = Body::Text { places };
        Ok(at)
    }

    /// Number of values where `stated` are stated and `there` are there.
    fn counted(&mut self, name: Option<String>, stated: u64, there: u64) -> u64 {
        if stated == 0 && there > 0 {
            let text = "its header states no number of values";
            self.note(name, format!("{text}: the {there} that are there are read"));
            return there;
        }
        if stated != there {
            let rest = if stated < there {
                ": the last are left out"
            } else {
                ""
            };
            let text = format!("its header states {stated} values, {there} are there{rest}");
            self.note(name, text);
        }
        stated.min(there)
    }

    /// Finds where the bytes of a set end, and so how wide its numbers are.
    fn binary<S: Read + Seek>(
        &mut self,
        source: &mut Source<S>,
        at: u64,
        big: bool,
        stated: Option<u64>,
        header: &mut Header,
    ) -> Result<u64, FileError> {
        let name = header.set.name();
        let left = source.length().saturating_sub(at);
        let is_double = matches!(header.ordinate, 4 | 6);
        let value: u64 = if is_double { 8 } else { 4 };
        let parts = 1 + u64::from(header.set.complex);
        // The abscissa is of single precision by the description; some write it as wide as the values.
        let widths: &[u64] = match (header.set.uneven, value) {
            (false, _) => &[0],
            (true, 4) => &[4],
            (true, _) => &[4, 8],
        };
        let row = |abscissa: u64| abscissa + parts * value;
        let size = |abscissa: u64| header.count.saturating_mul(row(abscissa));
        let mut abscissa = widths[0];
        let mut bytes = None;
        // Where the mark that closes the set follows, there the values end.
        let mut ends = Vec::new();
        ends.extend(stated.filter(|&bytes| bytes > 0));
        ends.extend(widths.iter().map(|&width| size(width)));
        for end in ends.into_iter().filter(|&end| end <= left) {
            if closes(source, at + end)? {
                bytes = Some(end);
                break;
            }
        }
        let fits = |width: &&u64| Some(size(**width)) == bytes.or(stated);
        if let Some(&wide) = widths.iter().find(fits) {
            abscissa = wide;
        }
        if bytes.is_none() {
            let missing = match size(abscissa) > left {
                true => "the file was cut off",
                false => "its length is not where the next set begins",
            };
            self.note(name.clone(), format!("its set is not closed: {missing}"));
        }
        let stated = stated.filter(|&bytes| bytes > 0);
        let bytes = bytes.unwrap_or_else(|| stated.unwrap_or(size(abscissa)).min(left));
        header.set.count = self.counted(name, header.count, bytes / row(abscissa));
        header.set.body = Body::Binary {
            at,
            big,
            value,
            abscissa,
        };
        self.other(source, at + bytes, "58b")
    }
}

/// Whether the mark that closes a set, or the end of the file, is at a byte; line ends before it do not matter.
fn closes<S: Read + Seek>(source: &mut Source<S>, mut at: u64) -> Result<bool, FileError> {
    for _ in 0..3 {
        match line(source, at)? {
            None => return Ok(false),
            Some((text, next)) if text.trim_ascii().is_empty() => at = next,
            Some((text, _)) => return Ok(is_uff_mark(text)),
        }
    }
    Ok(false)
}
