//! Datasets: which values there are, where they stand, and how a line of them is read.

use std::collections::BTreeSet;
use std::io::{Read, Seek};
use std::sync::Arc;

use super::attribute::Dataspace;
use super::chunks::{Chunks, Grid, Index};
use super::datatype::Datatype;
use super::filter::{self, Filter};
use super::header::{Message, kind};
use super::storage::Storage;
use crate::FileError;

/// Largest value that is read, in bytes; a compound of a thousand channels is smaller.
const LARGEST_VALUE: usize = 1 << 16;

/// Largest chunk that is unpacked, in bytes.
const LARGEST_CHUNK: u64 = 256 << 20;

/// Bytes of unpacked chunks that are kept.
const KEPT: usize = 64 << 20;

/// Bytes that are read at once from values that are not in chunks.
const PIECE: usize = 1 << 18;

/// Where the values of a dataset stand.
#[derive(Clone, Debug)]
pub(super) enum Place {
    /// In the header.
    Compact(Vec<u8>),
    /// One behind the other from an address on; none where they were never written.
    Contiguous(Option<u64>),
    /// In chunks.
    Chunked {
        grid: Grid,
        filters: Vec<Filter>,
        chunks: Chunks,
    },
}

/// A dataset of numbers, or of compound values with numbers.
#[derive(Clone, Debug)]
pub(super) struct Dataset {
    pub sizes: Vec<u64>,
    pub datatype: Datatype,
    pub place: Place,
    /// Bytes of a value that was never written.
    pub fill: Vec<u8>,
}

/// A line of numbers through a dataset.
#[derive(Clone, Debug)]
pub(super) struct Line {
    /// Which dataset, by its index.
    pub dataset: usize,
    /// The direction that it follows.
    pub along: usize,
    /// Where it starts.
    pub from: Vec<u64>,
    /// Bytes of a value before the number.
    pub offset: usize,
    /// The type of the number.
    pub datatype: Datatype,
}

/// Why a dataset cannot be read.
pub(super) enum Unreadable {
    /// It is of a form that is not read; which one.
    Form(String),
    /// It is damaged.
    Damaged(FileError),
}

impl From<FileError> for Unreadable {
    fn from(error: FileError) -> Unreadable {
        Unreadable::Damaged(error)
    }
}

impl<S: Read + Seek> Storage<S> {
    /// The dataset with these messages.
    pub fn dataset(&mut self, messages: &[Message]) -> Result<Dataset, Unreadable> {
        let form = |text: &str| Unreadable::Form(text.to_string());
        let space = self
            .part(messages, kind::DATASPACE)?
            .and_then(|body| Dataspace::read(self.fields(&body)))
            .ok_or_else(|| form("its dataspace cannot be read"))?;
        let datatype = self
            .part(messages, kind::DATATYPE)?
            .and_then(|body| Datatype::read(&body))
            .filter(|datatype| datatype.size > 0)
            .ok_or_else(|| form("its datatype cannot be read"))?;
        let count = space.count();
        let bytes = count.and_then(|count| count.checked_mul(datatype.size as u64));
        if bytes.is_none() {
            return Err(form("it claims more values than can be counted"));
        }
        if datatype.size > LARGEST_VALUE {
            return Err(form("its values are too large"));
        }
        let sizes = match count {
            Some(0) => vec![0],
            _ => space.sizes.clone(),
        };
        let filters = match self.part(messages, kind::FILTERS)? {
            Some(body) => match filter::read(&body, datatype.size) {
                Some(Ok(filters)) => filters,
                Some(Err(unknown)) => {
                    return Err(Unreadable::Form(format!(
                        "it is packed by the filter {unknown}, which is not read"
                    )));
                }
                None => return Err(form("its filters cannot be read")),
            },
            None => Vec::new(),
        };
        let fill = self
            .part(messages, kind::FILL_VALUE)?
            .and_then(|body| fill_value(self.fields(&body)))
            .filter(|fill| fill.len() == datatype.size)
            .unwrap_or_else(|| vec![0; datatype.size]);
        let body = self
            .part(messages, kind::LAYOUT)?
            .ok_or_else(|| form("it states no layout"))?;
        let layout = self.layout(&body, &space, datatype.size, !filters.is_empty());
        let place = match layout.ok_or_else(|| form("its layout cannot be read"))? {
            Layout::Compact(bytes) => Place::Compact(bytes),
            Layout::Contiguous(address) => Place::Contiguous(address),
            Layout::Virtual => return Err(form("it only refers to other files")),
            Layout::Chunked(index, at, grid) => {
                if grid.bytes > LARGEST_CHUNK {
                    return Err(form("its chunks are too large"));
                }
                let chunks = match at {
                    Some(at) => self.chunks(&index, at, &grid)?,
                    None => Chunks::new(),
                };
                Place::Chunked {
                    grid,
                    filters,
                    chunks,
                }
            }
        };
        Ok(Dataset {
            sizes,
            datatype,
            place,
            fill,
        })
    }

    /// The body of the message of a kind, where the object has one.
    fn part(&mut self, messages: &[Message], kind: u16) -> Result<Option<Vec<u8>>, FileError> {
        let message = messages.iter().find(|message| message.kind == kind);
        message.map(|message| self.body(message)).transpose()
    }

    fn layout(
        &self,
        body: &[u8],
        space: &Dataspace,
        element: usize,
        filtered: bool,
    ) -> Option<Layout> {
        let mut fields = self.fields(body);
        let version = fields.u8()?;
        if version < 3 {
            let rank = usize::from(fields.u8()?);
            let class = fields.u8()?;
            fields.skip(5)?;
            if class == 0 {
                for _ in 0..rank {
                    fields.u32()?;
                }
                let size = fields.u32()? as usize;
                return Some(Layout::Compact(fields.take(size)?.to_vec()));
            }
            let at = fields.address()?;
            if class == 1 {
                return Some(Layout::Contiguous(at));
            }
            let rank = rank.checked_sub(1)?;
            let chunk = (0..rank).map(|_| fields.u32().map(u64::from));
            let grid = grid(chunk.collect::<Option<_>>()?, space, element, filtered)?;
            return Some(Layout::Chunked(Index::OldTree, at, grid));
        }
        match (version, fields.u8()?) {
            (3..=5, 0) => {
                let size = usize::from(fields.u16()?);
                Some(Layout::Compact(fields.take(size)?.to_vec()))
            }
            (3..=5, 1) => Some(Layout::Contiguous(fields.address()?)),
            (3, 2) => {
                let rank = usize::from(fields.u8()?).checked_sub(1)?;
                let at = fields.address()?;
                let chunk = (0..rank).map(|_| fields.u32().map(u64::from));
                let grid = grid(chunk.collect::<Option<_>>()?, space, element, filtered)?;
                Some(Layout::Chunked(Index::OldTree, at, grid))
            }
            (4 | 5, 2) => {
                let flags = fields.u8()?;
                let rank = usize::from(fields.u8()?).checked_sub(1)?;
                let size = usize::from(fields.u8()?);
                let chunk = (0..rank).map(|_| fields.whole(size));
                let grid = grid(chunk.collect::<Option<_>>()?, space, element, filtered)?;
                fields.skip(size)?;
                let index = match fields.u8()? {
                    1 if flags & 2 != 0 => Index::Single(Some((fields.length()?, fields.u32()?))),
                    1 => Index::Single(None),
                    2 => Index::Implicit,
                    3 => {
                        fields.skip(1)?;
                        Index::Fixed
                    }
                    4 => {
                        fields.skip(5)?;
                        Index::Extensible
                    }
                    5 => {
                        fields.skip(6)?;
                        Index::NewTree
                    }
                    _ => return None,
                };
                Some(Layout::Chunked(index, fields.address()?, grid))
            }
            (4 | 5, 3) => Some(Layout::Virtual),
            _ => None,
        }
    }
}

enum Layout {
    Compact(Vec<u8>),
    Contiguous(Option<u64>),
    Chunked(Index, Option<u64>, Grid),
    Virtual,
}

fn grid(chunk: Vec<u64>, space: &Dataspace, element: usize, filtered: bool) -> Option<Grid> {
    let fits = chunk.len() == space.sizes.len() && !chunk.is_empty() && !chunk.contains(&0);
    fits.then_some(())?;
    let bytes = chunk
        .iter()
        .try_fold(element as u64, |bytes, &size| bytes.checked_mul(size))?;
    Some(Grid {
        sizes: space.sizes.clone(),
        largest: space.largest.clone(),
        chunk,
        bytes,
        filtered,
    })
}

/// The bytes of a value that was never written, where the message defines them.
fn fill_value(mut fields: super::fields::Fields) -> Option<Vec<u8>> {
    let version = fields.u8()?;
    let defined = match version {
        1 | 2 => {
            fields.skip(2)?;
            fields.u8()? != 0 || version == 1
        }
        3 => fields.u8()? & 0x20 != 0,
        _ => false,
    };
    defined.then_some(())?;
    let size = fields.u32()? as usize;
    fields.take(size).map(<[u8]>::to_vec)
}

impl Dataset {
    /// How many values of lines in one direction the file can hold: up to the last that was written.
    pub fn readable(&self, along: usize, base: u64, length: u64) -> u64 {
        let size = self.sizes.get(along).copied().unwrap_or(1);
        let stride = self.stride(along).max(1) * self.datatype.size as u64;
        match &self.place {
            Place::Compact(bytes) => size.min((bytes.len() as u64).div_ceil(stride)),
            Place::Contiguous(None) => 0,
            Place::Contiguous(Some(address)) => {
                let there = length.saturating_sub(base.saturating_add(*address));
                let before: u64 = self.sizes.iter().take(along).product();
                // Lines that do not follow the slowest direction stand one after the other.
                if before > 1 {
                    size
                } else {
                    size.min(there / stride)
                }
            }
            Place::Chunked { grid, chunks, .. } => {
                let last = chunks.keys().filter_map(|place| place.get(along)).max();
                let chunk = grid.chunk.get(along).copied().unwrap_or(1);
                let end = last.map_or(0, |last| last.saturating_add(1).saturating_mul(chunk));
                size.min(end)
            }
        }
    }

    /// Whether the values, as many as a line has, are all in the file.
    pub fn is_dense(&self, along: usize, count: u64) -> bool {
        match &self.place {
            Place::Chunked { grid, chunks, .. } => {
                let chunk = grid.chunk.get(along).copied().unwrap_or(1);
                count.div_ceil(chunk) <= chunks.len() as u64
            }
            _ => true,
        }
    }

    /// Values from one to the next of a line in a direction.
    fn stride(&self, along: usize) -> u64 {
        self.sizes.iter().skip(along + 1).product()
    }
}

/// Unpacked chunks, the one used last at the end.
#[derive(Debug, Default)]
pub(super) struct Cache {
    #[allow(clippy::type_complexity)]
    chunks: Vec<((usize, Vec<u64>), Option<Arc<Vec<u8>>>)>,
    /// Datasets of which a chunk is there, but does not match its checksums.
    pub contradicted: BTreeSet<usize>,
}

impl Cache {
    /// The bytes of a chunk; none where it is damaged or cut off.
    fn get<S: Read + Seek>(
        &mut self,
        storage: &mut Storage<S>,
        dataset: &Dataset,
        key: &(usize, Vec<u64>),
    ) -> Option<Arc<Vec<u8>>> {
        if let Some(at) = self.chunks.iter().position(|(known, _)| known == key) {
            let entry = self.chunks.remove(at);
            self.chunks.push(entry);
        } else {
            let packed = packed(storage, dataset, &key.1);
            let is_there = packed.is_some();
            let bytes = packed.and_then(|packed| packed.undone());
            if is_there && bytes.is_none() {
                self.contradicted.insert(key.0);
            }
            self.chunks.push((key.clone(), bytes.map(Arc::new)));
            let held = |cache: &Cache| -> usize {
                let sizes = cache.chunks.iter().flat_map(|(_, bytes)| bytes.as_ref());
                sizes.map(|bytes| bytes.len()).sum()
            };
            while self.chunks.len() > 1 && (self.chunks.len() > 256 || held(self) > KEPT) {
                self.chunks.remove(0);
            }
        }
        self.chunks.last().and_then(|(_, bytes)| bytes.clone())
    }
}

/// A chunk as it stands in the file.
struct Packed<'a> {
    bytes: Vec<u8>,
    filters: &'a [Filter],
    left_out: u32,
    size: usize,
}

impl Packed<'_> {
    /// Its values; none where they do not unpack, or do not match their checksums.
    fn undone(self) -> Option<Vec<u8>> {
        filter::undo(self.filters, self.left_out, self.bytes, self.size)
    }
}

/// A chunk; none where it is cut off.
fn packed<'a, S: Read + Seek>(
    storage: &mut Storage<S>,
    dataset: &'a Dataset,
    place: &[u64],
) -> Option<Packed<'a>> {
    let Place::Chunked {
        grid,
        filters,
        chunks,
    } = &dataset.place
    else {
        return None;
    };
    let chunk = chunks.get(place)?;
    let at = storage.base.checked_add(chunk.address)?;
    let size = if filters.is_empty() {
        grid.bytes
    } else {
        chunk.size
    };
    Some(Packed {
        bytes: storage.source.bytes(at, size).ok()?,
        filters,
        left_out: chunk.left_out,
        size: grid.bytes as usize,
    })
}

/// Fills `values` along a line from the index `first` on; what cannot be read is NaN. Returns whether all could be.
pub(super) fn read_line<S: Read + Seek>(
    storage: &mut Storage<S>,
    cache: &mut Cache,
    dataset: &Dataset,
    line: &Line,
    first: u64,
    values: &mut [f64],
) -> bool {
    values.fill(f64::NAN);
    let size = dataset.datatype.size;
    let stride = dataset.stride(line.along) as usize;
    let start = line.from.iter().enumerate().map(|(direction, &from)| {
        let index = if direction == line.along { first } else { from };
        index.saturating_mul(dataset.stride(direction))
    });
    let start: u64 = start.sum();
    match &dataset.place {
        Place::Compact(bytes) => {
            for (k, value) in values.iter_mut().enumerate() {
                let at = (start as usize + k * stride) * size + line.offset;
                *value = line.datatype.number(bytes.get(at..).unwrap_or(&[]));
            }
            true
        }
        Place::Contiguous(None) => false,
        Place::Contiguous(Some(address)) => {
            let step = stride.saturating_mul(size).max(1);
            // Rows that are long are not worth reading as a whole for one value of each.
            let (at_once, taken) = if step <= 4096 {
                ((PIECE / step).max(1), step)
            } else {
                (1, size)
            };
            let mut whole = true;
            let mut buffer = vec![0; at_once * taken];
            for (piece, values) in values.chunks_mut(at_once).enumerate() {
                let from = start
                    .saturating_add((piece * at_once * stride) as u64)
                    .saturating_mul(size as u64);
                let from = storage.base.saturating_add(*address).saturating_add(from);
                // The last value of a piece may be followed by nothing.
                let wanted = (values.len() - 1) * step + size;
                let wanted = wanted.min(buffer.len());
                let there = storage.source.read_at(from, &mut buffer[..wanted]);
                let there = &buffer[..there.unwrap_or(0)];
                whole &= there.len() == wanted;
                for (k, value) in values.iter_mut().enumerate() {
                    let bytes = there.get(k * step + line.offset..).unwrap_or(&[]);
                    *value = line.datatype.number(bytes);
                }
            }
            whole
        }
        Place::Chunked { grid, chunks, .. } => {
            let strides: Vec<u64> = (0..grid.chunk.len())
                .map(|direction| grid.chunk[direction + 1..].iter().product())
                .collect();
            let along = line.along;
            let mut place: Vec<u64> = line.from.clone();
            let mut inside = 0;
            for direction in 0..place.len() {
                inside += place[direction] % grid.chunk[direction] * strides[direction];
                place[direction] /= grid.chunk[direction];
            }
            inside -= line.from[along] % grid.chunk[along] * strides[along];
            let (mut done, mut whole) = (0, true);
            while done < values.len() {
                let index = first + done as u64;
                place[along] = index / grid.chunk[along];
                let within = index % grid.chunk[along];
                let left = (grid.chunk[along] - within).min((values.len() - done) as u64) as usize;
                let here = &mut values[done..done + left];
                done += left;
                if !chunks.contains_key(&place) {
                    let fill = dataset.fill.get(line.offset..).unwrap_or(&[]);
                    here.fill(line.datatype.number(fill));
                    continue;
                }
                let key = (line.dataset, place.clone());
                let Some(bytes) = cache.get(storage, dataset, &key) else {
                    whole = false;
                    continue;
                };
                for (k, value) in here.iter_mut().enumerate() {
                    let element = inside + (within + k as u64) * strides[along];
                    let at = element as usize * size + line.offset;
                    *value = line.datatype.number(bytes.get(at..).unwrap_or(&[]));
                }
            }
            whole
        }
    }
}
