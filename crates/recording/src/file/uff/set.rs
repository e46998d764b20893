//! A set 58 of a file, and its axes.

/// An axis of a set.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// Number of the quantity in the format's list.
    pub quantity: u32,
    /// What it is called; empty where not stated.
    pub label: String,
    /// Its unit; empty where not stated.
    pub unit: String,
}

/// How the values of a set are written.
#[derive(Debug)]
pub enum Body {
    /// As text: numbers before and byte at the start of some of its lines.
    Text { places: Vec<(u64, u64)> },
    /// As bytes from a place on; `wide` are the bytes of a value and of an abscissa.
    Binary {
        at: u64,
        big: bool,
        value: u64,
        abscissa: u64,
    },
}

/// A function at nodal degrees of freedom: set 58.
#[derive(Debug)]
pub struct Set {
    /// The five lines of remarks; empty where they say nothing.
    pub remarks: [String; 5],
    /// Values have a real and an imaginary part.
    pub complex: bool,
    /// Abscissae are written with the values.
    pub uneven: bool,
    /// Number of values that can be read.
    pub count: u64,
    /// The first abscissa.
    pub first: f64,
    /// The interval of abscissae.
    pub interval: f64,
    /// The abscissa.
    pub abscissa: Axis,
    /// The ordinate; its unit with that of its denominator.
    pub ordinate: Axis,
    /// Where the values are.
    pub body: Body,
}

impl Set {
    /// Numbers of a value: abscissa where it is uneven, real part, imaginary part.
    pub fn fields(&self) -> u64 {
        1 + u64::from(self.uneven) + u64::from(self.complex)
    }

    /// Name for messages.
    pub(super) fn name(&self) -> Option<String> {
        Some(self.remarks[0].clone()).filter(|name| !name.is_empty())
    }
}
