//! Filters: how the bytes of a chunk were changed before they were written.

use std::io::Read;

use super::checksum::fletcher32;
use super::fields::Fields;

/// One filter of a chunked dataset.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Filter {
    /// zlib.
    Deflate,
    /// Bytes of equal rank together.
    Shuffle { size: usize },
    /// Fletcher32: a checksum of four bytes behind.
    Checksum,
    /// LZF of h5py.
    Lzf,
}

/// The filters of a message, in the order in which they were applied; or which of them is not known.
pub(super) fn read(body: &[u8], element: usize) -> Option<Result<Vec<Filter>, String>> {
    let mut fields = Fields::new(body, 8, 8);
    let version = fields.u8()?;
    let count = fields.u8()?;
    if version == 1 {
        fields.skip(6)?;
    }
    let mut filters = Vec::new();
    for _ in 0..count {
        let id = fields.u16()?;
        let named = version == 1 || id >= 256;
        let name_length = if named { usize::from(fields.u16()?) } else { 0 };
        fields.skip(2)?;
        let values = usize::from(fields.u16()?);
        let name_length = match version {
            1 => name_length.next_multiple_of(8),
            _ => name_length,
        };
        let name = fields.take(name_length)?;
        let first = fields.take(4 * values)?.first_chunk::<4>();
        if version == 1 && values % 2 == 1 {
            fields.skip(4)?;
        }
        filters.push(match id {
            1 => Filter::Deflate,
            2 => Filter::Shuffle {
                size: first.map_or(element, |bytes| u32::from_le_bytes(*bytes) as usize),
            },
            3 => Filter::Checksum,
            32000 => Filter::Lzf,
            _ => {
                let known = match id {
                    4 => "szip",
                    5 => "nbit",
                    6 => "scaleoffset",
                    32001 => "blosc",
                    32004 => "lz4",
                    32008 => "bitshuffle",
                    32013 => "zfp",
                    32015 => "zstd",
                    _ => "",
                };
                let name = String::from_utf8_lossy(name);
                let name = if known.is_empty() {
                    name.trim_end_matches('\0')
                } else {
                    known
                };
                return Some(Err(format!("{id} {name}").trim_end().to_string()));
            }
        });
    }
    Some(Ok(filters))
}

/// Undoes the filters of a chunk of `size` bytes; bit k of `left_out`: filter k was not applied.
pub(super) fn undo(
    filters: &[Filter],
    left_out: u32,
    mut bytes: Vec<u8>,
    size: usize,
) -> Option<Vec<u8>> {
    for (place, filter) in filters.iter().enumerate().rev() {
        if left_out >> place.min(31) & 1 == 1 {
            continue;
        }
        bytes = match filter {
            Filter::Deflate => inflate(&bytes, size)?,
            Filter::Shuffle { size } => unshuffle(&bytes, *size)?,
            Filter::Checksum => {
                let kept = bytes.len().checked_sub(4)?;
                let sum = fletcher32(&bytes[..kept]).to_le_bytes();
                // Old writers on machines of the other byte order swapped the bytes in pairs.
                let swapped = [sum[1], sum[0], sum[3], sum[2]];
                (bytes[kept..] == sum || bytes[kept..] == swapped).then_some(())?;
                bytes.truncate(kept);
                bytes
            }
            Filter::Lzf => unpack_lzf(&bytes, size)?,
        };
    }
    (bytes.len() >= size).then_some(bytes)
}

fn inflate(bytes: &[u8], size: usize) -> Option<Vec<u8>> {
    let mut out = Vec::new();
    // A checksum may stand behind the values; a byte more is wanted, so that the end of the stream is read and verified.
    flate2::read::ZlibDecoder::new(bytes)
        .take(size as u64 + 5)
        .read_to_end(&mut out)
        .ok()?;
    Some(out)
}

fn unshuffle(bytes: &[u8], size: usize) -> Option<Vec<u8>> {
    if size <= 1 {
        return Some(bytes.to_vec());
    }
    let count = bytes.len() / size;
    let mut out = bytes.to_vec();
    for (rank, plane) in bytes.chunks_exact(count.max(1)).take(size).enumerate() {
        if count == 0 {
            break;
        }
        for (value, &byte) in plane.iter().enumerate() {
            *out.get_mut(value * size + rank)? = byte;
        }
    }
    Some(out)
}

/// Undoes LZF.
///
/// Source: the format of LibLZF: a byte below 32 announces one more than its value of literal bytes; otherwise its
/// high three bits are a length and the rest with the next byte a distance back (from memory).
fn unpack_lzf(bytes: &[u8], size: usize) -> Option<Vec<u8>> {
    let mut fields = Fields::new(bytes, 8, 8);
    let mut out: Vec<u8> = Vec::new();
    while fields.left() > 0 {
        let control = usize::from(fields.u8()?);
        if control < 32 {
            out.extend(fields.take(control + 1)?);
        } else {
            let mut length = control >> 5;
            if length == 7 {
                length += usize::from(fields.u8()?);
            }
            let back = ((control & 0x1f) << 8) + usize::from(fields.u8()?) + 1;
            let from = out.len().checked_sub(back)?;
            for place in from..from + length + 2 {
                let byte = out[place];
                out.push(byte);
            }
        }
        if out.len() > size + 4 {
            return None;
        }
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_of_equal_rank_go_back_to_their_values() {
        // Three values of two bytes: low bytes first, then high bytes; a rest stays where it is.
        let shuffled = [1, 2, 3, 0x10, 0x20, 0x30, 9];
        let back = unshuffle(&shuffled, 2).unwrap();
        assert_eq!(back, [1, 0x10, 2, 0x20, 3, 0x30, 9]);
        assert_eq!(unshuffle(&[7], 8).unwrap(), [7]);
    }

    #[test]
    fn a_stream_with_a_wrong_checksum_or_end_is_refused() {
        use std::io::Write;
        let mut packer = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::fast());
        packer.write_all(&[7; 100]).unwrap();
        let packed = packer.finish().unwrap();
        let undone = |bytes: &[u8]| undo(&[Filter::Deflate], 0, bytes.to_vec(), 100);
        assert_eq!(undone(&packed).unwrap(), [7; 100]);
        let end = packed.len() - 1;
        assert_eq!(undone(&packed[..end]), None);
        let mut changed = packed;
        changed[end] ^= 1;
        assert_eq!(undone(&changed), None);
    }

    #[test]
    fn lzf_repeats_what_stands_before() {
        // Literals a b c, then five bytes from three back.
        let packed = [2, b'a', b'b', b'c', 3 << 5, 2];
        assert_eq!(unpack_lzf(&packed, 8).unwrap(), b"abcabcab");
        assert_eq!(unpack_lzf(&[3 << 5, 2], 8), None);
    }

    #[test]
    fn a_filter_that_is_not_known_is_named() {
        let mut body = vec![2, 1];
        body.extend(32015u16.to_le_bytes());
        body.extend([4, 0, 0, 0, 0, 0]);
        body.extend(*b"zstd");
        assert_eq!(read(&body, 8), Some(Err("32015 zstd".to_string())));
    }
}
