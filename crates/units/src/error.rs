//! What can be wrong with a quantity or a unit.

use std::fmt;

/// Why a text is not a quantity or not a unit. Prints as one clause without a final stop.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ParseError {
    /// Nothing but white space.
    Empty,
    /// No number at the start of this text.
    MissingNumber(String),
    /// A text whose number is written as infinity or not-a-number.
    NotFinite(String),
    /// A text with a comma where a decimal point belongs.
    DecimalComma(String),
    /// Digits in groups.
    GroupedDigits {
        /// The whole text.
        text: String,
        /// The same without marks between digits.
        joined: String,
    },
    /// A number without a unit, as written.
    MissingUnit(String),
    /// A symbol that is no known unit.
    UnknownUnit {
        /// The symbol as written.
        unit: String,
        /// The known unit that is nearest to it.
        nearest: Option<String>,
    },
    /// A unit up to a power that cannot be read.
    BadExponent(String),
    /// A unit with more than one factor after a division sign.
    AmbiguousDivision(String),
    /// A product with an absolute temperature inside.
    TemperatureInProduct(String),
    /// What belongs to neither number nor unit.
    TrailingText(String),
    /// A text whose value in SI is beyond what a 64-bit float can hold.
    OutOfRange(String),
}

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ParseError::Empty => write!(f, "an empty text"),
            ParseError::MissingNumber(text) => write!(f, "no number at the start of \"{text}\""),
            ParseError::NotFinite(text) => {
                write!(f, "\"{text}\", which is not a finite number")
            }
            ParseError::DecimalComma(text) => {
                write!(
                    f,
                    "a comma in \"{text}\"; decimals are written with a point and thousands without a mark"
                )
            }
            ParseError::GroupedDigits { text, .. } => {
                write!(
                    f,
                    "\"{text}\", whose digits stand in groups; they are written without blanks or marks between them"
                )
            }
            ParseError::MissingUnit(number) => write!(f, "the number {number} without a unit"),
            ParseError::UnknownUnit {
                unit,
                nearest: Some(nearest),
            } => {
                write!(
                    f,
                    "the unknown unit \"{unit}\"; did you mean \"{nearest}\"?"
                )
            }
            ParseError::UnknownUnit {
                unit,
                nearest: None,
            } => write!(f, "the unknown unit \"{unit}\""),
            ParseError::BadExponent(text) => {
                write!(
                    f,
                    "a power that cannot be read in \"{text}\"; powers are written m^2, m^1.5 or m^(10/9)"
                )
            }
            ParseError::AmbiguousDivision(unit) => {
                write!(
                    f,
                    "the unit \"{unit}\", which can be read in two ways; put what follows the one \"/\" in brackets, as in W/(m K)"
                )
            }
            ParseError::TemperatureInProduct(unit) => {
                write!(
                    f,
                    "degC inside the unit \"{unit}\"; in a product a temperature is in K"
                )
            }
            ParseError::TrailingText(text) => {
                write!(f, "\"{text}\" after the quantity, which is not understood")
            }
            ParseError::OutOfRange(text) => {
                write!(
                    f,
                    "\"{text}\", which is too large or too small to compute with"
                )
            }
        }
    }
}

impl std::error::Error for ParseError {}
