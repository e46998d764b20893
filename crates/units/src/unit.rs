//! Units: products and powers of known symbols.
//!
//! ```text
//! unit    = product [ "/" factor ]
//! product = factor { ( " " | "·" | "*" ) factor }
//! factor  = ( symbol | "1" | "(" unit ")" ) [ power ]
//! power   = "^" number | "^(" number [ "/" number ] ")" | superscript digits
//! ```

use crate::dimension::Dimension;
use crate::error::ParseError;
use crate::near::nearest_names;
use crate::rational::Rational;
use crate::symbols::{SYMBOLS, Symbol, find};

/// Longest unit text that is read; real ones are far shorter.
const LONGEST: usize = 120;
/// Largest size of a power; real ones are far smaller.
const LARGEST_POWER: f64 = 20.0;

/// A unit: a dimension and how many SI units one of it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    dimension: Dimension,
    /// One unit is `10^ten · numerator / denominator` SI units.
    ten: i64,
    numerator: f64,
    denominator: f64,
    /// SI value at the zero of the scale: not zero for degC alone.
    offset: f64,
}

impl Unit {
    const ONE: Unit = Unit {
        dimension: Dimension::NONE,
        ten: 0,
        numerator: 1.0,
        denominator: 1.0,
        offset: 0.0,
    };

    fn of(symbol: &Symbol) -> Unit {
        Unit {
            dimension: symbol.dimension,
            ten: i64::from(symbol.ten),
            numerator: symbol.numerator,
            denominator: symbol.denominator,
            offset: symbol.offset,
        }
    }

    /// Reads a unit such as `N/m^(10/9)`, `kg m²` or `W/(m K)`.
    pub fn parse(text: &str) -> Result<Unit, ParseError> {
        let text = text.trim();
        if text.is_empty() {
            return Err(ParseError::Empty);
        }
        if text.len() > LONGEST {
            return Err(ParseError::TrailingText(format!(
                "{}…",
                text.chars().take(20).collect::<String>()
            )));
        }
        if let Some(alone) = find(text).filter(|symbol| symbol.text.contains(['/', '-'])) {
            return Ok(Unit::of(alone));
        }
        let mut reader = Reader {
            whole: text,
            rest: text,
        };
        let unit = reader.unit()?;
        if reader.rest.is_empty() {
            Ok(unit)
        } else {
            Err(reader.trailing())
        }
    }

    /// The dimension of the unit.
    pub fn dimension(&self) -> Dimension {
        self.dimension
    }

    /// Power of ten, numerator, denominator and offset of the scale.
    pub(crate) fn scale(&self) -> (i64, f64, f64, f64) {
        (self.ten, self.numerator, self.denominator, self.offset)
    }

    /// The SI value of `value` of this unit.
    pub fn to_si(&self, value: f64) -> f64 {
        self.si_of_scaled(shift(value, self.ten))
    }

    /// The SI value, when the power of ten of the unit is applied already.
    pub(crate) fn si_of_scaled(&self, scaled: f64) -> f64 {
        scaled * self.numerator / self.denominator + self.offset
    }

    /// How many of this unit the SI value is.
    pub fn from_si(&self, value_si: f64) -> f64 {
        shift(
            (value_si - self.offset) * self.denominator / self.numerator,
            -self.ten,
        )
    }

    fn times(self, other: Unit) -> Option<Unit> {
        Some(Unit {
            dimension: self.dimension.times(other.dimension)?,
            ten: self.ten + other.ten,
            numerator: self.numerator * other.numerator,
            denominator: self.denominator * other.denominator,
            offset: 0.0,
        })
    }

    fn power(self, exponent: Rational) -> Option<Unit> {
        let size = exponent.value().abs();
        let whole = self.ten * exponent.numerator();
        let fraction = (whole % exponent.denominator()) as f64 / exponent.denominator() as f64;
        let (above, below) = if exponent.numerator() < 0 {
            (self.denominator, self.numerator)
        } else {
            (self.numerator, self.denominator)
        };
        Some(Unit {
            dimension: self.dimension.power(exponent)?,
            ten: whole / exponent.denominator(),
            numerator: raise(above, size) * raise(10.0, fraction),
            denominator: raise(below, size),
            offset: 0.0,
        })
    }
}

/// `base^exponent`; exact for small whole exponents of whole numbers, and 1 for base 1 or exponent 0.
fn raise(base: f64, exponent: f64) -> f64 {
    if exponent.fract() == 0.0 {
        base.powi(exponent as i32)
    } else {
        base.powf(exponent)
    }
}

/// `value · 10^ten`, rounded once, by way of the decimal digits.
fn shift(value: f64, ten: i64) -> f64 {
    if ten == 0 || !value.is_finite() {
        return value;
    }
    let text = format!("{value:e}");
    text.split_once('e')
        .and_then(|(digits, exponent)| Some((digits, exponent.parse::<i64>().ok()?)))
        .and_then(|(digits, exponent)| format!("{digits}e{}", exponent + ten).parse().ok())
        .unwrap_or(f64::NAN)
}

struct Reader<'a> {
    whole: &'a str,
    rest: &'a str,
}

impl<'a> Reader<'a> {
    fn unit(&mut self) -> Result<Unit, ParseError> {
        let mut unit = self.factor()?;
        loop {
            let separated = self.skip_product_sign();
            match self.peek() {
                None | Some(')') => return Ok(unit),
                Some('/') => break,
                Some(_) if separated => {
                    let factor = self.factor()?;
                    unit = self.product(unit, factor)?;
                }
                Some('(') => {
                    return Err(ParseError::TrailingText(self.rest.to_string()));
                }
                Some(_) => return Err(self.trailing()),
            }
        }
        self.take();
        self.skip_space();
        let divisor = self.factor()?;
        if divisor.offset != 0.0 {
            return Err(self.temperature());
        }
        self.skip_product_sign();
        if !matches!(self.peek(), None | Some(')')) {
            let continues = self
                .peek()
                .is_some_and(|c| c == '/' || c == '(' || is_symbol(c));
            return Err(if continues {
                ParseError::AmbiguousDivision(self.whole.to_string())
            } else {
                self.trailing()
            });
        }
        let inverse = divisor
            .power(Rational::integer(-1))
            .ok_or_else(|| self.bad_exponent())?;
        self.product(unit, inverse)
    }

    fn product(&self, a: Unit, b: Unit) -> Result<Unit, ParseError> {
        if a.offset != 0.0 || b.offset != 0.0 {
            return Err(self.temperature());
        }
        a.times(b).ok_or_else(|| self.bad_exponent())
    }

    fn factor(&mut self) -> Result<Unit, ParseError> {
        let base = match self.peek() {
            Some('(') => {
                self.take();
                self.skip_space();
                let inner = self.unit()?;
                if self.take() != Some(')') {
                    return Err(ParseError::TrailingText(self.whole.to_string()));
                }
                inner
            }
            Some('1') => {
                self.take();
                if self.peek().is_some_and(|c| c.is_ascii_digit() || c == '.') {
                    return Err(ParseError::TrailingText(format!("1{}", self.rest)));
                }
                Unit::ONE
            }
            Some(c) if is_symbol(c) => self.symbol()?,
            _ => return Err(self.trailing()),
        };
        match self.exponent()? {
            None => Ok(base),
            Some(_) if base.offset != 0.0 => Err(self.temperature()),
            Some(exponent) => base.power(exponent).ok_or_else(|| self.bad_exponent()),
        }
    }

    fn symbol(&mut self) -> Result<Unit, ParseError> {
        let end = self
            .rest
            .find(|c: char| !is_symbol(c))
            .unwrap_or(self.rest.len());
        let (text, rest) = self.rest.split_at(end);
        // a pressure of this name would be taken for the megapascal; a viscosity is meant as it stands
        let second = |after: &str| after.starts_with('s') && !after[1..].starts_with(is_symbol);
        let viscosity = second(rest.trim_start_matches([' ', '·', '*']));
        let milli = find("mPa").filter(|_| viscosity);
        let known = if text == "mPa" { milli } else { find(text) };
        let known = known.ok_or_else(|| ParseError::UnknownUnit {
            unit: text.to_string(),
            nearest: nearest_names(text, SYMBOLS.iter().map(|symbol| symbol.text))
                .first()
                .map(|name| name.to_string()),
        })?;
        self.rest = rest;
        Ok(Unit::of(known))
    }

    fn exponent(&mut self) -> Result<Option<Rational>, ParseError> {
        let text = match self.peek() {
            Some('^') => {
                self.take();
                if self.peek() == Some('(') {
                    let end = self.rest.find(')').ok_or_else(|| self.bad_exponent())?;
                    let inner = self.rest[1..end].to_string();
                    self.rest = &self.rest[end + 1..];
                    inner
                } else {
                    let is_part = |(i, c): (usize, char)| {
                        c.is_ascii_digit() || c == '.' || (i == 0 && (c == '-' || c == '+'))
                    };
                    let end = self
                        .rest
                        .char_indices()
                        .find(|&part| !is_part(part))
                        .map_or(self.rest.len(), |(i, _)| i);
                    let (digits, rest) = self.rest.split_at(end);
                    self.rest = rest;
                    digits.to_string()
                }
            }
            Some(c) if superscript(c).is_some() => {
                let mut digits = String::new();
                while let Some(c) = self.peek().and_then(superscript) {
                    digits.push(c);
                    self.take();
                }
                digits
            }
            Some(c) if c.is_ascii_digit() => return Err(self.bad_exponent()),
            _ => return Ok(None),
        };
        let exponent = Rational::parse(&text)
            .filter(|exponent| exponent.value().abs() <= LARGEST_POWER)
            .ok_or_else(|| self.bad_exponent())?;
        Ok(Some(exponent))
    }

    /// Skips spaces and at most one product sign; returns whether there was any.
    fn skip_product_sign(&mut self) -> bool {
        let before = self.rest.len();
        self.skip_space();
        if matches!(self.peek(), Some('·' | '*' | '⋅' | '×')) {
            self.take();
            self.skip_space();
        }
        self.rest.len() < before
    }

    fn skip_space(&mut self) {
        self.rest = self.rest.trim_start();
    }

    fn peek(&self) -> Option<char> {
        self.rest.chars().next()
    }

    fn take(&mut self) -> Option<char> {
        let mut chars = self.rest.chars();
        let taken = chars.next();
        self.rest = chars.as_str();
        taken
    }

    fn trailing(&self) -> ParseError {
        let text = if self.rest.is_empty() {
            self.whole
        } else {
            self.rest
        };
        ParseError::TrailingText(text.to_string())
    }

    fn bad_exponent(&self) -> ParseError {
        ParseError::BadExponent(self.whole.to_string())
    }

    fn temperature(&self) -> ParseError {
        ParseError::TemperatureInProduct(self.whole.to_string())
    }
}

fn is_symbol(c: char) -> bool {
    c.is_alphabetic() || c == '°' || c == '%'
}

fn superscript(c: char) -> Option<char> {
    Some(match c {
        '⁰' => '0',
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        '⁴' => '4',
        '⁵' => '5',
        '⁶' => '6',
        '⁷' => '7',
        '⁸' => '8',
        '⁹' => '9',
        '⁻' => '-',
        '⁺' => '+',
        _ => return None,
    })
}
