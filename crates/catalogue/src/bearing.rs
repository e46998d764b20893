//! A bearing of the catalogue: its values, each with its source.

/// Format of the data file and of a user's file.
pub const FORMAT: &str = "auxbear.bearings/1";

/// How well a number is founded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Read in a maker's table.
    Catalogue,
    /// Computed from values read.
    Derived,
    /// Neither.
    Assumed,
    /// By the user's file, without a word on where it is from.
    Given,
}

impl Mark {
    /// The word of the data file.
    pub fn word(self) -> &'static str {
        match self {
            Mark::Catalogue => "catalogue",
            Mark::Derived => "derived",
            Mark::Assumed => "assumed",
            Mark::Given => "given",
        }
    }
}

/// What a value is.
#[derive(Clone, Debug, PartialEq)]
pub enum Datum {
    /// A number in SI with its unit as written; a count or ratio has the unit "".
    Number {
        /// Value in SI.
        si: f64,
        /// Value as written, for people: "6.55 kN".
        text: String,
    },
    /// A word, as the scenario spells it.
    Word(String),
}

/// One value of a bearing.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// Key, as in the scenario.
    pub key: String,
    /// The value.
    pub datum: Datum,
    /// How well it is founded.
    pub mark: Mark,
    /// Citation of a value read, way of a value derived, reason of a value assumed.
    pub note: String,
}

impl Value {
    /// The value as written.
    pub fn text(&self) -> &str {
        match &self.datum {
            Datum::Number { text, .. } => text,
            Datum::Word(word) => word,
        }
    }
}

/// Where a bearing is from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// It is part of the program.
    BuiltIn,
    /// A user's file.
    File {
        /// The file, as the user named it.
        file: String,
        /// Whether the program has a bearing of this name, which this one replaces.
        replaces_built_in: bool,
    },
}

/// One bearing of the catalogue.
#[derive(Clone, Debug, PartialEq)]
pub struct Bearing {
    /// Name by which a scenario asks for it.
    pub name: String,
    /// One line for people; empty where the file has none.
    pub description: String,
    /// Where it is from.
    pub origin: Origin,
    /// Values, in the order of the keys' names.
    pub values: Vec<Value>,
}

impl Bearing {
    /// The number under a key, SI.
    pub fn number(&self, key: &str) -> Option<f64> {
        match &self.value(key)?.datum {
            Datum::Number { si, .. } => Some(*si),
            Datum::Word(_) => None,
        }
    }

    /// The word under a key.
    pub fn word(&self, key: &str) -> Option<&str> {
        match &self.value(key)?.datum {
            Datum::Word(word) => Some(word),
            Datum::Number { .. } => None,
        }
    }

    /// The value under a key.
    pub fn value(&self, key: &str) -> Option<&Value> {
        self.values.iter().find(|value| value.key == key)
    }

    /// How many of its values are assumed.
    pub fn assumed_count(&self) -> usize {
        let assumed = |value: &&Value| value.mark == Mark::Assumed;
        self.values.iter().filter(assumed).count()
    }
}
