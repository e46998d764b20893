//! The index of a file: its objects, and where the values of each stand.
//!
//! What is kept per segment is its place, its length and the number of its layout; layouts that are alike are kept once,
//! and the number of values before a segment only at milestones. So a file of many segments needs little memory.

use std::collections::HashMap;
use std::io::{Read, Seek};
use std::sync::Arc;

use super::layout::{Layout, Piece};
use super::meta::{Cursor, Placement, RawIndex, names};
use crate::file::keep_note;
use crate::file::source::Source;
use crate::file::{Property, Value};
use crate::{Content, FileError, Note};

/// Bytes of the head of a segment.
pub const LEAD_IN: u64 = 28;

/// Length of a segment that was never completed.
const UNFINISHED: u64 = u64::MAX;

/// What a segment has, by the bits of its head.
const META_DATA: u32 = 1 << 1;
const NEW_LIST: u32 = 1 << 2;
const RAW_DATA: u32 = 1 << 3;
const INTERLEAVED: u32 = 1 << 5;
const BIG_ENDIAN: u32 = 1 << 6;

/// Fewest segments from one milestone to the next.
const MILESTONE: usize = 64;

/// An object of the file: the file itself, a group or a channel.
#[derive(Debug, Default)]
pub struct Object {
    /// The names in its path.
    pub names: Vec<String>,
    /// Its properties, the last value of each.
    pub properties: Vec<Property>,
    /// What its values are, as first stated; none where it has none.
    pub content: Option<Content>,
    /// Its values are complex.
    pub complex: bool,
    /// Number of its values.
    pub count: u64,
}

impl Object {
    /// The value of a property.
    pub fn property(&self, name: &str) -> Option<&Value> {
        let found = self.properties.iter().find(|own| own.name == name);
        found.map(|property| &property.value)
    }
}

/// Raw data of a segment.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    /// Byte of the file where they begin.
    pub at: u64,
    /// Their bytes, as far as they are there.
    pub bytes: u64,
    /// Number of their layout.
    pub layout: u32,
}

/// Number of values before a block.
#[derive(Debug)]
struct Milestone {
    block: usize,
    counts: Vec<u64>,
}

/// The index of a file.
#[derive(Debug, Default)]
pub struct Index {
    /// Objects in the order in which the file names them.
    pub objects: Vec<Object>,
    /// Raw data in the order of the file.
    pub blocks: Vec<Block>,
    /// What was wrong.
    pub notes: Vec<Note>,
    layouts: Vec<Arc<Layout>>,
    milestones: Vec<Milestone>,
}

impl Index {
    /// The layout of a block.
    pub fn layout(&self, block: &Block) -> Option<&Arc<Layout>> {
        self.layouts.get(block.layout as usize)
    }

    /// What chunks of all layouts hold of an object.
    pub fn pieces(&self, object: u32) -> impl Iterator<Item = &Piece> {
        let layouts = self.layouts.iter();
        layouts.filter_map(move |layout| layout.piece(object))
    }

    /// Values of an object in a block.
    pub fn count_in(&self, block: &Block, object: u32) -> u64 {
        let of = |layout: &Arc<Layout>| Some(count_of(layout, layout.piece(object)?, block));
        self.layout(block).and_then(of).unwrap_or(0)
    }

    /// The last milestone before or at the value `first` of an object: a block, and the index of its first value.
    pub fn milestone(&self, object: u32, first: u64) -> (usize, u64) {
        let before =
            |milestone: &Milestone| milestone.counts.get(object as usize).copied().unwrap_or(0);
        let is_before = |milestone: &Milestone| before(milestone) <= first;
        let behind = self.milestones.partition_point(is_before);
        match behind.checked_sub(1).and_then(|at| self.milestones.get(at)) {
            Some(milestone) => (milestone.block, before(milestone)),
            None => (0, 0),
        }
    }

    /// Keeps a note unless there are many.
    pub fn note(&mut self, channel: Option<String>, text: impl Into<String>) {
        let text = text.into();
        keep_note(&mut self.notes, Note { channel, text });
    }

    /// Reads the index of a file; an error where its first bytes are no TDMS.
    pub fn of<S: Read + Seek>(source: &mut Source<S>) -> Result<Index, FileError> {
        let mut scan = Scan::default();
        let mut at = 0;
        while at < source.length() {
            match scan.segment(source, at)? {
                Some(next) => at = next,
                None => break,
            }
        }
        Ok(scan.index)
    }
}

/// Values of a piece in a block.
fn count_of(layout: &Layout, piece: &Piece, block: &Block) -> u64 {
    let whole = block.bytes / layout.bytes.max(1);
    whole
        .saturating_mul(piece.count)
        .saturating_add(piece.count_in(block.bytes % layout.bytes.max(1)))
}

/// What is known of an object while the index is read.
#[derive(Default)]
struct State {
    /// Where its raw data stood in the last segment that stated it.
    raw: Option<RawIndex>,
    /// It is in the list of the present segment.
    active: bool,
    /// The places of its properties by their names.
    properties: HashMap<String, usize>,
}

/// The index while it is read.
#[derive(Default)]
struct Scan {
    index: Index,
    numbers: HashMap<String, u32>,
    states: Vec<State>,
    /// Objects with raw data in the present segment, in order.
    list: Vec<u32>,
    layouts: HashMap<Arc<Layout>, u32>,
    /// Layout of the present list, and the head's bits it was made for; none where it has to be made.
    present: Option<(u32, Option<u32>)>,
    since_milestone: usize,
}

impl Scan {
    /// Reads the segment at a byte; returns where the next is, none where what follows cannot be read.
    fn segment<S: Read + Seek>(
        &mut self,
        source: &mut Source<S>,
        at: u64,
    ) -> Result<Option<u64>, FileError> {
        let length = source.length();
        let mut head = [0; LEAD_IN as usize];
        let there = source.read_at(at, &mut head)?;
        if !head.starts_with(b"TDSm") {
            if at == 0 {
                let found = "is no TDMS: the first letters are not TDSm";
                return Err(source.error(0, found, "a TDMS file"));
            }
            self.index.note(None, format!("at byte {at} a segment should begin but does not: what follows ({} bytes) is not read", length - at));
            return Ok(None);
        }
        if there < head.len() {
            let text = format!("the file ends in the head of a segment (byte {at})");
            self.index.note(None, text);
            return Ok(None);
        }
        let flags = u32::from_le_bytes([head[4], head[5], head[6], head[7]]);
        let big = flags & BIG_ENDIAN != 0;
        let mut cursor = Cursor::new(&head[12..], big);
        let (size, raw_size) = match (cursor.u64(), cursor.u64()) {
            (Ok(size), Ok(raw)) => (size, raw),
            _ => return Ok(None),
        };
        let body = at + LEAD_IN;
        let stated = Some(size).filter(|&size| size != UNFINISHED);
        let stated = stated.and_then(|size| body.checked_add(size));
        let end = match stated {
            Some(end) if end <= length => end,
            Some(end) => {
                let missing = end - length;
                self.index.note(None, format!("the last segment (byte {at}) claims {missing} bytes more than the file has: what is there is read"));
                length
            }
            None => {
                let text = "was never completed: what is there is read";
                self.index
                    .note(None, format!("the last segment (byte {at}) {text}"));
                length
            }
        };
        let raw_at = body.checked_add(raw_size).filter(|&raw_at| raw_at <= end);
        let Some(raw_at) = raw_at else {
            let text = "are cut off: it is not read";
            let text = format!("the meta data of the last segment (byte {at}) {text}");
            self.index.note(None, text);
            return Ok(None);
        };
        if flags & META_DATA != 0 {
            let meta = source.bytes(body, raw_at - body)?;
            if let Err(wrong) = self.meta_data(&meta, flags) {
                let text =
                    format!("segment at byte {at}: {wrong}; it and what follows is not read");
                self.index.note(None, text);
                return Ok(None);
            }
        }
        if flags & RAW_DATA != 0 && end > raw_at {
            self.raw_data(flags, raw_at, end - raw_at, stated == Some(end));
        }
        Ok(Some(end))
    }

    /// Reads meta data into the objects and the list of the present segment.
    fn meta_data(&mut self, bytes: &[u8], flags: u32) -> Result<(), String> {
        let mut cursor = Cursor::new(bytes, flags & BIG_ENDIAN != 0);
        if flags & NEW_LIST != 0 {
            for &object in &self.list {
                self.states[object as usize].active = false;
            }
            self.list.clear();
            self.present = None;
        }
        for _ in 0..cursor.u32()? {
            let path = cursor.text()?;
            let number = self.number_of(&path)?;
            let stated = cursor.raw_index()?;
            self.place(number, stated)?;
            for _ in 0..cursor.u32()? {
                let (name, value) = cursor.property()?;
                self.set(number, name, value);
            }
        }
        Ok(())
    }

    /// The number of the object of a path, which is a new one where it was not named before.
    fn number_of(&mut self, path: &str) -> Result<u32, String> {
        if let Some(&number) = self.numbers.get(path) {
            return Ok(number);
        }
        let number = u32::try_from(self.states.len()).map_err(|_| "too many objects".to_owned())?;
        self.numbers.insert(path.to_owned(), number);
        self.states.push(State::default());
        self.index.objects.push(Object {
            names: names(path),
            ..Object::default()
        });
        Ok(number)
    }

    /// Puts an object into the list of the present segment, or takes it out.
    fn place(&mut self, number: u32, stated: Placement) -> Result<(), String> {
        let state = &mut self.states[number as usize];
        match stated {
            Placement::None => {
                if state.active {
                    state.active = false;
                    self.list.retain(|&other| other != number);
                    self.present = None;
                }
                return Ok(());
            }
            Placement::Same if state.raw.is_none() => {
                let name = self.index.objects[number as usize].names.join("/");
                return Err(format!(
                    "'{name}' repeats a raw data index that it never had"
                ));
            }
            Placement::Same => {}
            Placement::New(raw) => {
                if state.raw.as_ref() != Some(&raw) {
                    state.raw = Some(raw);
                    self.present = None;
                }
            }
        }
        if !state.active {
            state.active = true;
            self.list.push(number);
            self.present = None;
        }
        Ok(())
    }

    /// Sets a property of an object.
    fn set(&mut self, number: u32, name: String, value: Value) {
        let properties = &mut self.index.objects[number as usize].properties;
        match self.states[number as usize].properties.get(&name) {
            Some(&at) => properties[at].value = value,
            None => {
                self.states[number as usize]
                    .properties
                    .insert(name.clone(), properties.len());
                properties.push(Property { name, value });
            }
        }
    }

    /// Enters the raw data of the present segment.
    fn raw_data(&mut self, flags: u32, at: u64, bytes: u64, complete: bool) {
        let kept = flags & (INTERLEAVED | BIG_ENDIAN);
        let number = match self.present {
            Some((made_for, number)) if made_for == kept => number,
            _ => {
                let number = self.lay_out(flags);
                self.present = Some((kept, number));
                number
            }
        };
        let Some(number) = number else { return };
        let Some(layout) = self.index.layouts.get(number as usize).cloned() else {
            return;
        };
        let block = Block {
            at,
            bytes,
            layout: number,
        };
        if complete && !bytes.is_multiple_of(layout.bytes) {
            let text = "end in the middle of a chunk: what is there is read";
            let text = format!("the raw data at byte {at} {text}");
            self.index.note(None, text);
        }
        let spacing = MILESTONE.max(self.index.objects.len());
        if self.since_milestone >= spacing {
            let counts = self.index.objects.iter().map(|object| object.count);
            self.index.milestones.push(Milestone {
                block: self.index.blocks.len(),
                counts: counts.collect(),
            });
            self.since_milestone = 0;
        }
        self.since_milestone += 1;
        for piece in &layout.pieces {
            if let Some(object) = self.index.objects.get_mut(piece.object as usize) {
                let here = count_of(&layout, piece, &block);
                object.count = object.count.saturating_add(here);
            }
        }
        self.index.blocks.push(block);
    }

    /// The number of the layout of the present list; none where its values cannot be placed.
    fn lay_out(&mut self, flags: u32) -> Option<u32> {
        let states = &self.states;
        let raw = |object: u32| Some((object, states.get(object as usize)?.raw.as_ref()?));
        let objects = self.list.iter().filter_map(|&object| raw(object));
        let objects: Vec<(u32, &RawIndex)> = objects.collect();
        let mut complaints = Vec::new();
        let mut complain = |object, text| complaints.push((object, text));
        let [interleaved, big] = [INTERLEAVED, BIG_ENDIAN].map(|bit| flags & bit != 0);
        let layout = Layout::of(&objects, interleaved, big, &mut complain);
        let layout = layout.map(|mut layout| {
            let keeps = |piece: &Piece| self.keeps_content(piece, &mut complaints);
            layout.pieces.retain(keeps);
            layout
        });
        for (object, text) in complaints {
            let object = self.index.objects.get(object as usize);
            let name = object.map(|object| object.names.join("/"));
            self.index.note(name, text);
        }
        let layout = Arc::new(layout.filter(|layout| !layout.pieces.is_empty())?);
        if let Some(&number) = self.layouts.get(&layout) {
            return Some(number);
        }
        let number = u32::try_from(self.index.layouts.len()).ok()?;
        self.index.layouts.push(Arc::clone(&layout));
        self.layouts.insert(layout, number);
        Some(number)
    }

    /// Whether a piece holds what its object held before; the first piece decides.
    fn keeps_content(&mut self, piece: &Piece, complaints: &mut Vec<(u32, String)>) -> bool {
        let Some(object) = self.index.objects.get_mut(piece.object as usize) else {
            return false;
        };
        let Some(kind) = piece.parts.first().map(|part| part.kind) else {
            return false;
        };
        let content = *object.content.get_or_insert_with(|| {
            object.complex = kind.is_complex();
            kind.content()
        });
        let keeps = content == kind.content() && object.complex == kind.is_complex();
        if !keeps {
            let text = "changes what its values are: those of the new kind are left out";
            complaints.push((piece.object, text.to_owned()));
        }
        keeps
    }
}
