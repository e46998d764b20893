//! Where values stand in a chunk of raw data.

use super::kind::Kind;
use super::meta::RawIndex;

/// The scale number of values that no DAQmx scaler brings.
pub const PLAIN: u32 = u32::MAX;

/// Values of one object that stand at equal distances in a chunk.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Part {
    /// The scale that takes them; [`PLAIN`] where there is none.
    pub scale: u32,
    /// Their type.
    pub kind: Kind,
    /// Byte of the first in the chunk.
    pub offset: u64,
    /// Bytes from one to the next.
    pub stride: u64,
}

/// What a chunk holds of one object.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Piece {
    /// The object's number.
    pub object: u32,
    /// Values in a whole chunk.
    pub count: u64,
    /// Bytes of a text's piece; nothing for other types.
    pub bytes: u64,
    /// Where they stand: more than one part with several DAQmx scalers only, all of `count` values.
    pub parts: Vec<Part>,
}

impl Piece {
    /// Values that a chunk cut off after `bytes` still holds.
    pub fn count_in(&self, bytes: u64) -> u64 {
        let there = |part: &Part| {
            let size = part.kind.size();
            if part.kind == Kind::Text {
                return if bytes >= part.offset.saturating_add(self.bytes) {
                    self.count
                } else {
                    0
                };
            }
            let behind = bytes.saturating_sub(part.offset);
            if behind < size {
                0
            } else {
                self.count.min((behind - size) / part.stride.max(1) + 1)
            }
        };
        self.parts.iter().map(there).min().unwrap_or(0)
    }
}

/// How the chunks of a segment are laid out.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Layout {
    /// The highest byte of a number comes first.
    pub big: bool,
    /// Bytes of a chunk.
    pub bytes: u64,
    /// Its pieces by the number of the object.
    pub pieces: Vec<Piece>,
}

impl Layout {
    /// The piece of an object.
    pub fn piece(&self, object: u32) -> Option<&Piece> {
        let at = self
            .pieces
            .binary_search_by_key(&object, |piece| piece.object)
            .ok()?;
        self.pieces.get(at)
    }

    /// Lays out the objects of a segment, given in the order of its object list.
    ///
    /// What cannot be laid out is reported by `complain`, with the number of the object; none where no value of the segment can
    /// be placed.
    pub fn of(
        objects: &[(u32, &RawIndex)],
        interleaved: bool,
        big: bool,
        complain: &mut impl FnMut(u32, String),
    ) -> Option<Layout> {
        let mut layout = Layout {
            big,
            bytes: 0,
            pieces: Vec::new(),
        };
        let is_daqmx = |raw: &RawIndex| matches!(raw, RawIndex::Daqmx { .. });
        for &(object, raw) in objects {
            if let RawIndex::Unknown { code } = raw {
                complain(
                    object,
                    format!(
                        "is of a type ({code:#x}) whose size is not known: data written together with it are left out"
                    ),
                );
                return None;
            }
            if is_daqmx(raw) != objects.first().is_some_and(|first| is_daqmx(first.1)) {
                complain(
                    object,
                    "has raw data of DAQmx beside others: data written together are left out"
                        .to_owned(),
                );
                return None;
            }
        }
        match objects.first() {
            None => return None,
            Some((_, RawIndex::Daqmx { widths, .. })) => {
                layout.lay_buffers(objects, widths, complain)
            }
            Some(_) if interleaved => layout.lay_rows(objects, complain)?,
            Some(_) => layout.lay_pieces(objects, complain)?,
        }
        layout
            .pieces
            .retain(|piece| piece.count > 0 && !piece.parts.is_empty());
        layout.pieces.sort_by_key(|piece| piece.object);
        (layout.bytes > 0 && !layout.pieces.is_empty()).then_some(layout)
    }

    /// One object after the other.
    fn lay_pieces(
        &mut self,
        objects: &[(u32, &RawIndex)],
        complain: &mut impl FnMut(u32, String),
    ) -> Option<()> {
        for &(object, raw) in objects {
            let RawIndex::Plain { kind, count, bytes } = *raw else {
                continue;
            };
            if kind == Kind::Text && bytes / 4 < count {
                complain(
                    object,
                    format!(
                        "has {count} texts in {bytes} bytes: data written together with it are left out"
                    ),
                );
                return None;
            }
            let part = Part {
                scale: PLAIN,
                kind,
                offset: self.bytes,
                stride: kind.size(),
            };
            self.pieces.push(Piece {
                object,
                count,
                bytes,
                parts: vec![part],
            });
            self.bytes = self.bytes.saturating_add(bytes);
        }
        Some(())
    }

    /// A value of each object, then the next of each.
    fn lay_rows(
        &mut self,
        objects: &[(u32, &RawIndex)],
        complain: &mut impl FnMut(u32, String),
    ) -> Option<()> {
        let mut rows = 0;
        let mut stride = 0u64;
        for &(object, raw) in objects {
            let RawIndex::Plain { kind, count, .. } = *raw else {
                continue;
            };
            if kind == Kind::Text {
                complain(object, "has texts among interleaved values: data written together with it are left out".to_owned());
                return None;
            }
            let part = Part {
                scale: PLAIN,
                kind,
                offset: stride,
                stride: 0,
            };
            self.pieces.push(Piece {
                object,
                count,
                bytes: 0,
                parts: vec![part],
            });
            stride = stride.saturating_add(kind.size());
            rows = count.max(rows);
        }
        for part in self.pieces.iter_mut().flat_map(|piece| &mut piece.parts) {
            part.stride = stride;
        }
        self.bytes = stride.saturating_mul(rows);
        Some(())
    }

    /// The raw buffers of a DAQmx task one after the other, each in rows of its width.
    fn lay_buffers(
        &mut self,
        objects: &[(u32, &RawIndex)],
        widths: &[u32],
        complain: &mut impl FnMut(u32, String),
    ) {
        let mut rows = vec![0u64; widths.len()];
        for (_, raw) in objects {
            let RawIndex::Daqmx { count, scalers, .. } = raw else {
                continue;
            };
            for row in scalers
                .iter()
                .filter_map(|s| usize::try_from(s.buffer).ok())
            {
                if let Some(row) = rows.get_mut(row) {
                    *row = (*row).max(*count);
                }
            }
        }
        let mut starts = Vec::with_capacity(widths.len());
        for (&width, &rows) in widths.iter().zip(&rows) {
            starts.push(self.bytes);
            self.bytes = self
                .bytes
                .saturating_add(rows.saturating_mul(u64::from(width)));
        }
        for &(object, raw) in objects {
            let RawIndex::Daqmx { count, scalers, .. } = raw else {
                continue;
            };
            let mut parts = Vec::with_capacity(scalers.len());
            for scaler in scalers {
                let buffer = scaler.buffer as usize;
                let placed = starts.get(buffer).zip(widths.get(buffer)).zip(scaler.kind);
                let inside = placed.filter(|((_, width), kind)| {
                    u64::from(scaler.offset) + kind.size() <= u64::from(**width)
                });
                let Some(((&start, &width), kind)) = inside else {
                    complain(object, "has raw data of DAQmx of a type or at a place that is not known: they are left out".to_owned());
                    parts.clear();
                    break;
                };
                let offset = start.saturating_add(u64::from(scaler.offset));
                parts.push(Part {
                    scale: scaler.scale,
                    kind,
                    offset,
                    stride: u64::from(width),
                });
            }
            self.pieces.push(Piece {
                object,
                count: *count,
                bytes: 0,
                parts,
            });
        }
    }
}
