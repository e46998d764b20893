//! Cells of a line: where they begin and end, and which number one holds.

use super::lines::text;

/// What stands between the cells of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Between {
    /// One such byte.
    Byte(u8),
    /// Any number of blanks and tabs.
    Blanks,
}

/// Calls `each` with the number and the bytes of every cell of a line, without blanks and quotes around them; returns
/// how many cells there are.
pub(super) fn cells<'a>(
    line: &'a [u8],
    between: Between,
    mut each: impl FnMut(usize, &'a [u8]),
) -> usize {
    let mut count = 0;
    match between {
        Between::Blanks => {
            let blank = |byte: &u8| matches!(byte, b' ' | b'\t');
            for cell in line.split(blank).filter(|cell| !cell.is_empty()) {
                each(count, unquoted(cell));
                count += 1;
            }
        }
        Between::Byte(between) => {
            let mut rest = line;
            loop {
                let lead = rest.iter().take_while(|&&b| b == b' ').count();
                // A quoted cell may hold what stands between cells.
                let quoted = match rest[lead..].first() {
                    Some(b'"') => rest[lead + 1..]
                        .iter()
                        .position(|&b| b == b'"')
                        .map_or(0, |end| lead + end + 2),
                    _ => 0,
                };
                let end = rest[quoted..].iter().position(|&b| b == between);
                let end = end.map(|end| quoted + end);
                each(count, unquoted(&rest[..end.unwrap_or(rest.len())]));
                count += 1;
                match end {
                    Some(end) => rest = &rest[end + 1..],
                    None => break,
                }
            }
        }
    }
    count
}

/// The cells of a line as texts.
pub(super) fn row(line: &[u8], between: Between) -> Vec<String> {
    let mut row = Vec::new();
    cells(line, between, |_, cell| row.push(text(cell)));
    row
}

fn unquoted(cell: &[u8]) -> &[u8] {
    let cell = cell.trim_ascii();
    match cell {
        [b'"', inner @ .., b'"'] => inner.trim_ascii(),
        _ => cell,
    }
}

/// What a cell holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Cell {
    /// A number.
    Number(f64),
    /// Nothing, or a sign for a missing value.
    Missing,
    /// Something else.
    Text,
}

/// Reads a cell; `comma`: whether it stands before the decimals.
pub(super) fn read(cell: &[u8], comma: bool) -> Cell {
    if let Some(number) = plain_number(cell, comma) {
        return Cell::Number(number);
    }
    // What starts and ends like a number and has no comma is most often one of many digits.
    let ends = matches!(
        (cell.first(), cell.last()),
        (Some(b'0'..=b'9' | b'-' | b'+' | b'.'), Some(b'0'..=b'9'))
    );
    if ends
        && !comma
        && let Ok(text) = std::str::from_utf8(cell)
        && let Ok(number) = text.parse::<f64>()
    {
        return Cell::Number(number);
    }
    if cell.len() > 64 {
        return Cell::Text;
    }
    let mut buffer = [0; 64];
    let buffer = &mut buffer[..cell.len()];
    buffer.copy_from_slice(cell);
    buffer.make_ascii_lowercase();
    match &*buffer {
        b"" | b"nan" | b"na" | b"n/a" | b"#n/a" | b"-" | b"--" | b"---" | b"null" | b"none"
        | b"-nan" | b"+nan" | b"-1.#ind" | b"1.#qnan" | b"-1.#qnan" | b"nan(ind)"
        | b"-nan(ind)" => return Cell::Missing,
        _ => {}
    }
    for byte in buffer.iter_mut() {
        *byte = match *byte {
            b',' if comma => b'.',
            b'.' if comma => return Cell::Text,
            // FORTRAN's sign before the exponent of a double.
            b'd' => b'e',
            other => other,
        };
    }
    let text = std::str::from_utf8(buffer).ok();
    match text.and_then(|text| text.parse::<f64>().ok()) {
        Some(number) if number.is_nan() => Cell::Missing,
        Some(number) => Cell::Number(number),
        None => Cell::Text,
    }
}

/// A number of up to fifteen digits with up to twenty-two decimals, which one division gives exactly rounded.
fn plain_number(cell: &[u8], comma: bool) -> Option<f64> {
    const POWERS: [f64; 23] = [
        1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
        1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
    ];
    let point = if comma { b',' } else { b'.' };
    let (negative, digits) = match cell {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, cell),
    };
    let (mut value, mut count, mut decimals, mut past) = (0u64, 0, 0, false);
    for &byte in digits {
        match byte {
            b'0'..=b'9' => {
                value = value * 10 + u64::from(byte - b'0');
                count += usize::from(value > 0);
                decimals += usize::from(past);
                if count > 15 || decimals > 22 {
                    return None;
                }
            }
            _ if byte == point && !past => past = true,
            _ => return None,
        }
    }
    if digits.len() == usize::from(past) {
        return None;
    }
    let number = value as f64 / POWERS[decimals];
    Some(if negative { -number } else { number })
}

/// How a number is rounded: decimals and significant digits of its text.
pub(super) fn digits(cell: &[u8], comma: bool) -> (i32, i32) {
    let point = if comma { b',' } else { b'.' };
    let (mut decimals, mut significant, mut past, mut exponent) = (0, 0, false, 0);
    for (place, &byte) in cell.iter().enumerate().take(64) {
        match byte {
            b'0'..=b'9' => {
                decimals += i32::from(past);
                significant += i32::from(significant > 0 || byte != b'0');
            }
            b'e' | b'E' | b'd' | b'D' => {
                let text = std::str::from_utf8(&cell[place + 1..]).unwrap_or("");
                exponent = text.parse::<i32>().unwrap_or(0).clamp(-400, 400);
                break;
            }
            _ if byte == point => past = true,
            _ => {}
        }
    }
    (decimals - exponent, significant)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(line: &str, between: Between) -> Vec<String> {
        let mut found = Vec::new();
        cells(line.as_bytes(), between, |_, cell| {
            found.push(String::from_utf8_lossy(cell).into_owned());
        });
        found
    }

    #[test]
    fn quotes_hold_what_stands_between_cells() {
        let comma = Between::Byte(b',');
        assert_eq!(split("\"1,5\", \"a b\",c,", comma), ["1,5", "a b", "c", ""]);
        assert_eq!(split("  1\t 2  3 ", Between::Blanks), ["1", "2", "3"]);
        assert_eq!(split("\"open,2", comma), ["\"open", "2"]);
    }

    #[test]
    fn numbers_are_read_as_rust_reads_them() {
        for text in [
            "0",
            "-0.0",
            "1.5",
            "+2",
            "123456789012345",
            "0.1",
            "1e-3",
            "-1.25E+10",
            "5e-324",
            "0.0000001234",
            "1234567890123456789",
            "9007199254740993",
            ".5",
            "5.",
            "inf",
        ] {
            let Cell::Number(number) = read(text.as_bytes(), false) else {
                panic!("{text}");
            };
            assert_eq!(
                number.to_bits(),
                text.parse::<f64>().unwrap().to_bits(),
                "{text}"
            );
        }
        assert_eq!(read(b"1,5", true), Cell::Number(1.5));
        assert_eq!(read(b"-1,5E3", true), Cell::Number(-1500.0));
        assert_eq!(read(b"1.5D2", false), Cell::Number(150.0));
    }

    #[test]
    fn what_is_no_number_is_missing_or_text() {
        for missing in ["", "NaN", "-nan", "n/a", "-1.#IND", "--"] {
            assert_eq!(read(missing.as_bytes(), false), Cell::Missing, "{missing}");
        }
        for text in ["1,5", "OVER", "1.2.3", ".", "1;2", "1 2", "0x10"] {
            assert_eq!(read(text.as_bytes(), false), Cell::Text, "{text}");
        }
        assert_eq!(read(b"1.5", true), Cell::Text);
    }

    #[test]
    fn digits_tell_the_rounding() {
        assert_eq!(digits(b"0.0012", false), (4, 2));
        assert_eq!(digits(b"1,5e-3", true), (4, 2));
        assert_eq!(digits(b"120", false), (0, 3));
    }
}
