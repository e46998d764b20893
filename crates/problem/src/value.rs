//! Values of keys, as they were read and as files have them.

use crate::Place;
use crate::key::Key;
use crate::provenance::Provenance;
use crate::raw::Raw;
use units::{Dimension, Quantity};

/// A value that was read.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A quantity in SI or a bare number.
    Number(f64),
    /// A whole number, not negative.
    Count(u64),
    /// One of the words of the key.
    Word(&'static str),
    /// `true` or `false`.
    Switch(bool),
    /// Any text.
    Text(String),
    /// Rows of two quantities in SI.
    Rows(Vec<[f64; 2]>),
    /// Quantities in SI.
    Numbers(Vec<f64>),
    /// Words of the key.
    Words(Vec<&'static str>),
    /// Any texts.
    Texts(Vec<String>),
    /// Rows of a matrix in SI, and the unit of each as its key names it.
    Matrix(Vec<Vec<f64>>, Vec<&'static str>),
    /// Filters: numerator and denominator, the highest power of s first, in SI.
    Filters(Vec<[Vec<f64>; 2]>),
    /// What is not read yet.
    Raw(Raw),
}

impl Value {
    /// A number or count; none of any other kind.
    pub fn number(&self) -> Option<f64> {
        match self {
            Value::Number(value) => Some(*value),
            Value::Count(count) => Some(*count as f64),
            Value::Word(_)
            | Value::Switch(_)
            | Value::Text(_)
            | Value::Rows(_)
            | Value::Numbers(_)
            | Value::Words(_)
            | Value::Texts(_)
            | Value::Matrix(..)
            | Value::Filters(_)
            | Value::Raw(_) => None,
        }
    }
}

/// A value with everything known of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    /// The value.
    pub value: Value,
    /// As a file has it.
    pub text: String,
    /// Where it comes from.
    pub provenance: Provenance,
    /// Where it stands.
    pub place: Place,
    /// Whether the file says that the program filled it in.
    pub filled_in: bool,
}

/// A value in SI as a text that reads back bit for bit: in SI, or in rpm or degrees where that is shorter.
pub fn quantity_text<S>(key: &Key<S>, value_si: f64) -> String {
    let Some(dimension) = key.dimension() else {
        return units::number_text(value_si);
    };
    let si = Quantity {
        value_si,
        dimension,
    }
    .to_string();
    let unit = match dimension {
        Dimension::ANGLE => "deg",
        Dimension::ANGULAR_SPEED => "rpm",
        _ => return si,
    };
    let usual = units::display(value_si, unit).unwrap_or_default();
    let same = units::parse_quantity(&usual)
        .is_ok_and(|back| back.value_si.to_bits() == value_si.to_bits());
    if same && usual.len() < si.len() {
        usual
    } else {
        si
    }
}
