//! Quantities: a number with a unit, read and printed.

use crate::dimension::Dimension;
use crate::error::ParseError;
use crate::unit::Unit;
use std::fmt;

/// A value in SI with its dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// The value in the SI unit of the dimension.
    pub value_si: f64,
    /// The dimension.
    pub dimension: Dimension,
}

impl fmt::Display for Quantity {
    /// The shortest digits that read back bit for bit, and the SI unit.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} {}",
            number_text(self.value_si),
            self.dimension.si_unit()
        )
    }
}

/// Reads a number with a unit, such as `"25 mm"`, `"-90 deg"` or `"5e8 N/m^(10/9)"`.
pub fn parse_quantity(text: &str) -> Result<Quantity, ParseError> {
    let whole = text.trim();
    if whole.is_empty() {
        return Err(ParseError::Empty);
    }
    if let Some(joined) = without_groups(whole) {
        return Err(ParseError::GroupedDigits {
            text: whole.to_string(),
            joined,
        });
    }
    let number = split_number(whole)?;
    let rest = number.rest.trim_start();
    if rest.is_empty() {
        return Err(ParseError::MissingUnit(number.written.to_string()));
    }
    let is_number = rest.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '.' | '+' | '-'));
    if is_number && rest != "1" && !rest.starts_with("1/") {
        return Err(ParseError::TrailingText(rest.to_string()));
    }
    let unit = Unit::parse(rest)?;
    let out_of_range = || ParseError::OutOfRange(whole.to_string());
    let scaled: f64 = format!("{}e{}", number.digits, number.exponent + unit.scale().0)
        .parse()
        .map_err(|_| out_of_range())?;
    let value_si = unit.si_of_scaled(scaled);
    let is_zero = !number
        .digits
        .bytes()
        .any(|byte| byte.is_ascii_digit() && byte != b'0');
    if !value_si.is_finite()
        || (scaled == 0.0 && !is_zero)
        || (value_si == 0.0 && scaled != 0.0 && unit.scale().3 == 0.0)
    {
        return Err(out_of_range());
    }
    Ok(Quantity {
        value_si,
        dimension: unit.dimension(),
    })
}

/// The text with the thousands of its number joined, where they stand in groups of three digits.
fn without_groups(whole: &str) -> Option<String> {
    let is_mark = |c: char| {
        matches!(
            c,
            ' ' | '\u{a0}' | '\u{2009}' | '\u{202f}' | '\'' | '’' | '_'
        )
    };
    let start = whole.find(|c: char| c.is_ascii_digit())?;
    if start > 0 && !matches!(&whole[..start], "-" | "+" | "−") {
        return None;
    }
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let mut joined = whole[..start + digits(&whole[start..])].to_string();
    let mut rest = &whole[joined.len()..];
    while let Some(group) = rest.strip_prefix(is_mark)
        && digits(group) == 3
    {
        joined.push_str(&group[..3]);
        rest = &group[3..];
    }
    let grouped = rest.len() + joined.len() < whole.len();
    grouped.then(|| joined + rest)
}

/// The number at the start of a text, in decimal pieces.
pub(crate) struct Number<'a> {
    written: &'a str,
    /// Sign, digits and point, without exponent.
    digits: String,
    exponent: i64,
    pub(crate) rest: &'a str,
}

/// Larger exponents give infinity or zero anyway; the limit keeps sums of exponents small.
const LARGEST_EXPONENT: i64 = 100_000;

pub(crate) fn split_number(whole: &str) -> Result<Number<'_>, ParseError> {
    let sign_length = whole
        .chars()
        .next()
        .filter(|c| matches!(c, '+' | '-' | '−'))
        .map_or(0, char::len_utf8);
    let negative = matches!(whole.chars().next(), Some('-' | '−'));
    let body = &whole[sign_length..];
    let lower = body.to_ascii_lowercase();
    if lower.starts_with("inf") || lower.starts_with("nan") {
        return Err(ParseError::NotFinite(whole.to_string()));
    }
    let bytes = body.as_bytes();
    let digits_from = |start: usize| {
        bytes[start..]
            .iter()
            .take_while(|byte| byte.is_ascii_digit())
            .count()
    };
    let before_point = digits_from(0);
    let mut end = before_point;
    if bytes.get(end) == Some(&b'.') {
        end += 1 + digits_from(end + 1);
    }
    let has_digit = body[..end].bytes().any(|byte| byte.is_ascii_digit());
    if !has_digit {
        return Err(ParseError::MissingNumber(whole.to_string()));
    }
    if bytes.get(end) == Some(&b',') {
        return Err(ParseError::DecimalComma(whole.to_string()));
    }
    let digits = format!("{}{}", if negative { "-" } else { "" }, &body[..end]);
    let mut exponent = 0;
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let start = end + 1 + sign;
        let length = if start < bytes.len() {
            digits_from(start)
        } else {
            0
        };
        if length > 0 {
            let size = body[start..start + length]
                .parse::<i64>()
                .map_or(LARGEST_EXPONENT, |size| size.min(LARGEST_EXPONENT));
            exponent = if bytes[end + 1] == b'-' { -size } else { size };
            end = start + length;
        }
    }
    Ok(Number {
        written: &whole[..sign_length + end],
        digits,
        exponent,
        rest: &body[end..],
    })
}

/// The SI value in the wanted unit, for example `display(0.00025, "mm")` gives `0.25 mm`.
///
/// The digits are the fewest that read back to the same bits. Some values have no such decimal in a unit like `rpm`; then
/// 17 digits are printed, which read back within one unit in the last place.
pub fn display(value_si: f64, unit_text: &str) -> Result<String, ParseError> {
    let unit = Unit::parse(unit_text)?;
    let unit_text = unit_text.trim();
    if !value_si.is_finite() {
        return Ok(format!("{value_si} {unit_text}"));
    }
    let (ten, numerator, denominator, offset) = unit.scale();
    if numerator == 1.0 && denominator == 1.0 && offset == 0.0 {
        let (negative, digits, exponent) = decimal_digits(&format!("{value_si:e}"));
        return Ok(format!(
            "{} {unit_text}",
            layout(negative, &digits, exponent - ten)
        ));
    }
    let value = unit.from_si(value_si);
    let mut text = String::new();
    for decimals in 0..17 {
        let (negative, digits, exponent) = decimal_digits(&format!("{value:.decimals$e}"));
        text = format!("{} {unit_text}", layout(negative, &digits, exponent));
        let back = parse_quantity(&text).map(|quantity| quantity.value_si.to_bits());
        if back == Ok(value_si.to_bits()) {
            break;
        }
    }
    Ok(text)
}

/// The fewest digits that read back bit for bit: `0.25`, `12000`, `1e-9`, `2.5e10`.
pub fn number_text(value: f64) -> String {
    if !value.is_finite() {
        return value.to_string();
    }
    let (negative, digits, exponent) = decimal_digits(&format!("{value:e}"));
    layout(negative, &digits, exponent)
}

/// Sign, digits without point and power of ten of the first digit, from scientific notation.
fn decimal_digits(scientific: &str) -> (bool, String, i64) {
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((scientific, "0"));
    let negative = mantissa.starts_with('-');
    let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
    let trimmed = digits.trim_end_matches('0');
    if trimmed.is_empty() {
        return (negative, "0".to_string(), 0);
    }
    (negative, trimmed.to_string(), exponent.parse().unwrap_or(0))
}

/// Writes digits whose first has the value 10^exponent: plain between 1e-5 and 1e7, else scientific.
fn layout(negative: bool, digits: &str, exponent: i64) -> String {
    let sign = if negative { "-" } else { "" };
    if digits == "0" {
        return format!("{sign}0");
    }
    let count = digits.len() as i64;
    if (-5..0).contains(&exponent) {
        let zeros = "0".repeat((-exponent - 1) as usize);
        return format!("{sign}0.{zeros}{digits}");
    }
    if (0..8).contains(&exponent) {
        if count <= exponent + 1 {
            let zeros = "0".repeat((exponent + 1 - count) as usize);
            return format!("{sign}{digits}{zeros}");
        }
        let (whole, part) = digits.split_at((exponent + 1) as usize);
        return format!("{sign}{whole}.{part}");
    }
    let (first, more) = digits.split_at(1);
    let point = if more.is_empty() { "" } else { "." };
    format!("{sign}{first}{point}{more}e{exponent}")
}
