//! The universal file format: set 58, functions at nodal degrees of freedom, as text and as bytes (58b); reader.
//!
//! ```text
//! file = set, set, …        set = "    -1", number of its type, header, values, "    -1"
//! ```
//! Only sets 58 hold values of measurements; 164 (units) is read beside, others but 151 (the file) are left out with a note.
//!
//! Source: Structural Dynamics Research Corporation, universal file data set 58 (revision 3, from memory); University of
//! Cincinnati, "The Binary 58 Universal File Format".
//!
//! Abscissae of time at equal intervals are the channel's clock. Others, and uneven ones, are a channel of their own that
//! the clock points to. Complex values are two channels.

mod header;
mod scan;
mod set;
mod text;

use std::io::{Read, Seek};
use std::path::Path;

use super::source::{Source, WINDOW};
use super::{is_uff, is_uff_mark, number};
use crate::{Channel, Clock, FileError, Recording};
use header::{Names, date, si_unit};
use scan::Contents;
use set::{Axis, Body, Set};
use text::{Numbers, line, value};

/// Which numbers of a set a channel is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Field {
    /// Abscissae that are written.
    Abscissa,
    /// Abscissae that follow from the first and the interval.
    Even,
    /// Values, or their real parts.
    Real,
    /// Imaginary parts.
    Imaginary,
}

/// Where the values of a channel come from.
#[derive(Debug)]
struct Origin {
    set: usize,
    field: Field,
    /// A place in a text where the last piece ended: numbers before it, and the byte of its line.
    last: (u64, u64),
}

/// A universal file that is open for reading.
#[derive(Debug)]
pub struct Uff<S> {
    source: Source<S>,
    contents: Contents,
    channels: Vec<Channel>,
    origins: Vec<Origin>,
}

impl<S: Read + Seek> Uff<S> {
    /// Finds the sets of a file, which `path` names in messages.
    ///
    /// An error where the file is no universal file; whatever else is wrong is a note.
    pub fn from_source(source: S, path: &Path) -> Result<Uff<S>, FileError> {
        let mut source = Source::new(source, path)?;
        let head = source.bytes(0, source.length().min(super::source::HEAD as u64))?;
        if !is_uff(&head) {
            let found = "is no universal file: the first line is not -1";
            return Err(source.error(0, found, "a file of universal sets"));
        }
        let contents = Contents::of(&mut source)?;
        let mut file = Uff {
            source,
            contents,
            channels: Vec::new(),
            origins: Vec::new(),
        };
        if file.contents.sets.is_empty() {
            let text = "has no set 58: there are no values";
            file.contents.note(None, text);
        }
        let mut names = Names::new();
        for set in 0..file.contents.sets.len() {
            file.list(set, &mut names);
        }
        Ok(file)
    }

    /// Lists the channels of a set.
    fn list(&mut self, number: usize, names: &mut Names) {
        let set = &self.contents.sets[number];
        let own = [&set.remarks[0], &set.ordinate.label]
            .into_iter()
            .find(|name| !name.is_empty());
        let name = names.give(own.map_or("set 58", String::as_str));
        let mut channel = Channel::new(name.clone(), set.count);
        let (unit, lost) = unit(&set.ordinate, self.contents.units);
        channel.unit = unit;
        let remarks = || set.remarks[1..].iter().map(String::as_str);
        let words = remarks().filter(|r| !r.is_empty() && date(r).is_none());
        channel.description = words.collect::<Vec<_>>().join("; ");
        channel.start = remarks().find_map(date);
        let (complex, uneven, axis) = (set.complex, set.uneven, set.abscissa.clone());
        let even = seconds(&axis)
            .filter(|_| !uneven)
            .map(|factor| (set.first * factor, set.interval * factor));
        let has_start = channel.start.is_some();
        let mut wrong = Vec::from_iter(lost);
        let place = self.channels.len() + 1 + usize::from(complex);
        let mut abscissa = None;
        match even {
            Some((first, interval)) if interval > 0.0 => {
                channel.clock = Clock::Uniform { first, interval }
            }
            Some((_, interval)) => {
                wrong.push(format!(
                    "its interval is {interval} s: its clock is unknown"
                ));
            }
            None => {
                channel.clock = Clock::Channel(place);
                let (unit, lost) = self::unit(&axis, self.contents.units);
                wrong.extend(lost.map(|text| format!("abscissa: {text}")));
                let field = if uneven { Field::Abscissa } else { Field::Even };
                let name = names.give(&format!("{name} (abscissa)"));
                let mut own = Channel::new(name, channel.count);
                (own.unit, own.description) = (unit, axis.label.clone());
                abscissa = Some((own, field));
            }
        }
        if complex {
            let mut imaginary = channel.clone();
            imaginary.name = format!("{name} (imaginary)");
            channel.name = format!("{name} (real)");
            self.push(channel, number, Field::Real);
            self.push(imaginary, number, Field::Imaginary);
        } else {
            self.push(channel, number, Field::Real);
        }
        if let Some((channel, field)) = abscissa {
            self.push(channel, number, field);
        }
        for text in wrong {
            self.contents.note(Some(name.clone()), text);
        }
        if has_start {
            let text = "its dates have no time zone: they are taken as UTC";
            self.contents.note(None, text);
        }
    }

    fn push(&mut self, channel: Channel, set: usize, field: Field) {
        self.channels.push(channel);
        self.origins.push(Origin {
            set,
            field,
            last: (0, 0),
        });
    }
}

/// The unit of an axis, and what is to be reported where the file lost it.
fn unit(axis: &Axis, system: Option<u32>) -> (String, Option<String>) {
    let known = si_unit(axis.quantity);
    match (axis.unit.is_empty(), known, system) {
        (false, _, _) => (axis.unit.clone(), None),
        (true, Some(unit), Some(1)) => {
            let why = "by its quantity, as the file is in SI";
            let text = format!("its unit is not stated: {unit} {why}");
            (unit.to_owned(), Some(text))
        }
        (true, Some(unit), _) => {
            let why = "the file states its quantity only, whose unit in SI is";
            let text = format!("its unit is lost: {why} {unit}");
            (String::new(), Some(text))
        }
        (true, None, _) => (String::new(), None),
    }
}

/// The seconds of a unit of an abscissa of time; none where it is of another quantity or unit.
fn seconds(axis: &Axis) -> Option<f64> {
    match (axis.unit.as_str(), axis.quantity) {
        ("s" | "sec" | "Sec" | "S" | "seconds" | "Seconds", _) | ("", 17) => Some(1.0),
        ("ms" | "msec", _) => Some(1e-3),
        ("us" | "µs", _) => Some(1e-6),
        _ => None,
    }
}

/// Brings numbers of a text, every `step`-th from the number `first` on.
fn numbers<S: Read + Seek>(
    source: &mut Source<S>,
    start: (u64, u64),
    first: u64,
    step: u64,
    values: &mut [f64],
) -> Result<(u64, u64), FileError> {
    let (mut number, mut at) = start;
    let mut wanted = first;
    let mut values = values.iter_mut();
    let mut slot = values.next();
    while let Some((text, next)) = line(source, at)? {
        if slot.is_none() || is_uff_mark(text) {
            break;
        }
        let mut here = number;
        for spelling in Numbers::of(text) {
            if here == wanted
                && let Some(value_of) = slot
            {
                *value_of = value(spelling).unwrap_or(f64::NAN);
                slot = values.next();
                wanted += step;
            }
            here += 1;
        }
        if slot.is_none() {
            break;
        }
        (number, at) = (here, next);
    }
    Ok((number, at))
}

/// Brings numbers of `size` bytes, one every `row` bytes from a byte on.
fn bytes<S: Read + Seek>(
    source: &mut Source<S>,
    at: u64,
    row: u64,
    size: u64,
    big: bool,
    values: &mut [f64],
) -> Result<(), FileError> {
    let most = (WINDOW as u64 / row.max(1)).max(1) as usize;
    let mut at = at;
    for some in values.chunks_mut(most) {
        let needed = (some.len() as u64 - 1) * row + size;
        let raw = source.window(at, needed as usize)?;
        for (value, here) in some.iter_mut().zip(raw.chunks(row as usize)) {
            let raw = here.get(..size as usize);
            *value = raw.map_or(f64::NAN, |raw| {
                number::float(number::bits(raw, big), size as usize)
            });
        }
        at += some.len() as u64 * row;
    }
    Ok(())
}

impl Set {
    /// The place of a field among the numbers of a value.
    fn place(&self, field: Field) -> u64 {
        match field {
            Field::Abscissa | Field::Even => 0,
            Field::Real => u64::from(self.uneven),
            Field::Imaginary => u64::from(self.uneven) + 1,
        }
    }
}

impl<S: Read + Seek> Recording for Uff<S> {
    contents!(self, self.source.path(), self.contents);

    fn fill(&mut self, channel: usize, first: u64, values: &mut [f64]) -> Result<usize, FileError> {
        let origin = &mut self.origins[channel];
        let set = &self.contents.sets[origin.set];
        match &set.body {
            _ if origin.field == Field::Even => {
                for (i, value) in values.iter_mut().enumerate() {
                    *value = set.first + set.interval * (first + i as u64) as f64;
                }
            }
            Body::Text { places } => {
                let wanted = first * set.fields() + set.place(origin.field);
                let behind = places.partition_point(|place| place.0 <= wanted);
                let place = behind.checked_sub(1).and_then(|at| places.get(at));
                let place = place.copied().unwrap_or((0, 0));
                let start = match origin.last.0 <= wanted {
                    true => place.max(origin.last),
                    false => place,
                };
                origin.last = numbers(&mut self.source, start, wanted, set.fields(), values)?;
            }
            Body::Binary {
                at,
                big,
                value,
                abscissa,
            } => {
                let parts = 1 + u64::from(set.complex);
                let row = abscissa + parts * value;
                let (offset, size) = match origin.field {
                    Field::Abscissa | Field::Even => (0, *abscissa),
                    Field::Real => (*abscissa, *value),
                    Field::Imaginary => (abscissa + value, *value),
                };
                let from = at + first * row + offset;
                bytes(&mut self.source, from, row, size, *big, values)?;
            }
        }
        Ok(values.len())
    }
}
