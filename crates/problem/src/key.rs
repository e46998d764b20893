//! What a key of a file is: its name, kind, range, default and words.
//!
//! Tables of keys are made of these: reading, messages, resolved files and starting files all come from one table.

use units::{Dimension, Unit};

/// What kind of value a key takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A text of number and unit, of the dimension of this SI unit.
    Quantity(&'static str),
    /// A quantity in N/mⁿ, where n is the value of the key named.
    ContactStiffness {
        /// Path of the key that holds n.
        exponent: &'static str,
    },
    /// A bare number.
    Coefficient,
    /// A bare number or a fraction in quotes, `"10/9"`.
    Exponent,
    /// A whole number.
    Count,
    /// One of these words.
    Word(&'static [&'static str]),
    /// `true` or `false`.
    Switch,
    /// Any text.
    Text,
    /// A list of rows of two quantities, of the dimensions of these SI units; the first rises from row to row.
    Table(&'static str, &'static str),
    /// A list of quantities of the dimension of this SI unit; a single one needs no brackets.
    Quantities(&'static str),
    /// The same where values may be equal: what goes over the entries of another list.
    Series(&'static str),
    /// A list of these words; likewise.
    Words(&'static [&'static str]),
    /// A list of any texts; likewise.
    Texts,
    /// A matrix: rows of equally many quantities, each row of the dimension of one of these SI units.
    Matrix(&'static [&'static str]),
    /// Filters: polynomials of s over polynomials of s.
    Filters,
    /// Anything: whoever takes it reads it, and says what is needed.
    Any(&'static str),
}

/// Which values of the right kind are allowed, in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Every finite value.
    Any,
    /// Above zero.
    Positive,
    /// Zero or above.
    NotNegative,
    /// Above this number.
    Above(f64),
    /// From the first number to the second, both included.
    FromTo(f64, f64),
    /// Above the first number, to the second included.
    AboveTo(f64, f64),
}

/// What happens when a key is not given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Presence {
    /// It must be given.
    Required,
    /// It must be given unless the bearing catalogue knows it.
    FromBearing,
    /// It stays away; the text says what that means.
    Optional(&'static str),
    /// It is computed from other values; the text says how.
    Derived(&'static str),
    /// This value is used.
    Default(Fallback),
    /// This value is used when another key has the value it belongs to; else the second presence counts.
    DefaultWhen(Condition, Fallback, Otherwise),
}

/// What holds when a conditional default does not apply.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Otherwise {
    /// The key must be given.
    Required,
    /// Another default.
    Fallback(Fallback),
}

/// A default value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fallback {
    /// The value, as it is written in a file (without quotes).
    pub text: &'static str,
    /// Source or reason.
    pub reason: &'static str,
    /// Whether it is an assumption, which reports mark, or a plain convention.
    pub assumed: bool,
}

impl Presence {
    /// A default that is a plain convention.
    pub const fn convention(text: &'static str, reason: &'static str) -> Presence {
        Presence::Default(Fallback::convention(text, reason))
    }

    /// A default that is an assumption.
    pub const fn assumption(text: &'static str, reason: &'static str) -> Presence {
        Presence::Default(Fallback::assumption(text, reason))
    }
}

impl Fallback {
    /// A default that is a plain convention.
    pub const fn convention(text: &'static str, reason: &'static str) -> Fallback {
        let assumed = false;
        Fallback {
            text,
            reason,
            assumed,
        }
    }

    /// A default that is an assumption.
    pub const fn assumption(text: &'static str, reason: &'static str) -> Fallback {
        let assumed = true;
        Fallback {
            text,
            reason,
            assumed,
        }
    }
}

/// That another key has one of these values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condition {
    /// Path of the other key.
    pub path: &'static str,
    /// Its values, as written in a file (without quotes).
    pub values: &'static [&'static str],
    /// Why the key has no meaning otherwise; empty where the condition says it all.
    pub reason: &'static str,
}

/// One key of a file; `S` names the kinds of files that have it, where a table serves several.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key<S: 'static = ()> {
    /// Dotted path, such as `bearing.cage.pocket_gap`.
    pub path: &'static str,
    /// Kind of value.
    pub kind: Kind,
    /// Allowed values.
    pub range: Range,
    /// What happens without it.
    pub presence: Presence,
    /// The right form, as it is written in a file (without quotes).
    pub example: &'static str,
    /// What it is, in one or two sentences.
    pub doc: &'static str,
    /// The key has a meaning only under all of these conditions.
    pub when: &'static [Condition],
    /// The other key that gives the same thing.
    pub excludes: Option<&'static str>,
    /// Of a part: names of keys beside all of which alone it has an effect.
    pub beside: &'static [&'static str],
    /// Of a part: names of keys beside any of which it has no effect.
    pub unless: &'static [&'static str],
    /// The systems that have the key, where they are fewer than those of its section.
    pub systems: Option<&'static [S]>,
    /// Of a quantity: a letter that may stand before a bare number, and the unit that it means, as in a balance grade "G2.5".
    pub prefix: Option<(&'static str, &'static str)>,
}

impl<S: 'static> Key<S> {
    /// A key that must be given.
    pub const fn new(
        path: &'static str,
        kind: Kind,
        example: &'static str,
        doc: &'static str,
    ) -> Key<S> {
        Key {
            path,
            kind,
            range: Range::Any,
            presence: Presence::Required,
            example,
            doc,
            when: &[],
            excludes: None,
            beside: &[],
            unless: &[],
            systems: None,
            prefix: None,
        }
    }

    /// The same in fewer systems than its section.
    pub const fn only(mut self, systems: &'static [S]) -> Key<S> {
        self.systems = Some(systems);
        self
    }

    /// The same above 0.
    pub const fn positive(self) -> Key<S> {
        self.within(Range::Positive)
    }

    /// The same from 0 on.
    pub const fn not_negative(self) -> Key<S> {
        self.within(Range::NotNegative)
    }

    /// The same within a range.
    pub const fn within(mut self, range: Range) -> Key<S> {
        self.range = range;
        self
    }

    const fn present(mut self, presence: Presence) -> Key<S> {
        self.presence = presence;
        self
    }

    /// The same, which the catalogue may know.
    pub const fn catalogued(self) -> Key<S> {
        self.present(Presence::FromBearing)
    }

    /// The same, which may stay away; the text says what that means.
    pub const fn optional(self, meaning: &'static str) -> Key<S> {
        self.present(Presence::Optional(meaning))
    }

    /// The same, computed where it is not given; the text says how.
    pub const fn derived(self, how: &'static str) -> Key<S> {
        self.present(Presence::Derived(how))
    }

    /// The same with a default that is a convention, and its reason.
    pub const fn default(self, text: &'static str, reason: &'static str) -> Key<S> {
        self.present(Presence::convention(text, reason))
    }

    /// The same with a default that is an assumption, and its reason.
    pub const fn assumed(self, text: &'static str, reason: &'static str) -> Key<S> {
        self.present(Presence::assumption(text, reason))
    }

    /// The same with a default under a condition.
    pub const fn default_when(
        self,
        condition: Condition,
        fallback: Fallback,
        otherwise: Otherwise,
    ) -> Key<S> {
        self.present(Presence::DefaultWhen(condition, fallback, otherwise))
    }

    /// The same under conditions.
    pub const fn when(mut self, conditions: &'static [Condition]) -> Key<S> {
        self.when = conditions;
        self
    }

    /// The same in place of another key.
    pub const fn excludes(mut self, other: &'static str) -> Key<S> {
        self.excludes = Some(other);
        self
    }

    /// The same, with an effect only beside these keys.
    pub const fn beside(mut self, others: &'static [&'static str]) -> Key<S> {
        self.beside = others;
        self
    }

    /// The same, without effect beside any of these keys.
    pub const fn unless(mut self, others: &'static [&'static str]) -> Key<S> {
        self.unless = others;
        self
    }

    /// Path of the section: `bearing.cage` for `bearing.cage.pocket_gap`, empty for `format`.
    pub fn section(&self) -> &'static str {
        self.path
            .rsplit_once('.')
            .map_or("", |(section, _)| section)
    }

    /// Name inside the section: `pocket_gap`.
    pub fn name(&self) -> &'static str {
        self.path
            .rsplit_once('.')
            .map_or(self.path, |(_, name)| name)
    }

    /// SI unit of the value; empty for what has none.
    pub fn unit(&self) -> &'static str {
        match self.kind {
            Kind::Quantity(unit) => unit,
            Kind::ContactStiffness { .. } => "N/m^n",
            _ => "",
        }
    }

    /// Dimension of a quantity whose dimension is fixed.
    pub fn dimension(&self) -> Option<Dimension> {
        match self.kind {
            Kind::Quantity(unit) => Unit::parse(unit).ok().map(|unit| unit.dimension()),
            _ => None,
        }
    }

    /// Whether it is the frequency of a mode, which people also give in Hz.
    pub fn is_frequency(&self) -> bool {
        let name = self.path.rsplit('.').next().unwrap_or(self.path);
        name.contains("frequency") || name == "cutoff"
    }

    /// Writes a value as TOML: in quotes where the kind is a text.
    pub fn literal(&self, text: &str) -> String {
        match self.kind {
            Kind::Quantity(_) | Kind::ContactStiffness { .. } | Kind::Word(_) | Kind::Text => {
                quoted(text)
            }
            Kind::Exponent if text.contains('/') => quoted(text),
            // a single value needs no brackets
            Kind::Series(_) if !text.starts_with('[') => quoted(text),
            Kind::Exponent
            | Kind::Coefficient
            | Kind::Count
            | Kind::Switch
            | Kind::Table(..)
            | Kind::Quantities(_)
            | Kind::Series(_)
            | Kind::Words(_)
            | Kind::Texts
            | Kind::Matrix(_)
            | Kind::Filters
            | Kind::Any(_) => text.to_string(),
        }
    }

    /// What a right value looks like: `a mass above 0 is needed, e.g. "8 kg"`.
    pub fn needed(&self) -> String {
        let example = self.literal(self.example);
        let range = self.range.text();
        match self.kind {
            Kind::Quantity(unit) => {
                let noun = noun(unit);
                format!("{} {noun}{range} is needed, e.g. {example}", article(&noun))
            }
            Kind::Table(first, "1") => format!(
                "rows of {} {}, rising from row to row, and a bare number{range} are needed, e.g. {example}",
                article(&noun(first)),
                noun(first)
            ),
            Kind::Table(first, second) => {
                let (first, second) = (noun(first), noun(second));
                format!(
                    "rows of {} {first}, rising from row to row, and {} {second}{range} are needed, e.g. {example}",
                    article(&first),
                    article(&second)
                )
            }
            Kind::ContactStiffness { exponent } => format!(
                "a contact stiffness{range} in N/m^n with n = {exponent} is needed, e.g. {example}"
            ),
            Kind::Coefficient => format!("a bare number{range} is needed, e.g. {example}"),
            Kind::Exponent => {
                format!("a bare number or fraction in quotes{range} is needed, e.g. {example}")
            }
            Kind::Count => format!("a whole number{range} is needed, e.g. {example}"),
            Kind::Word(words) => {
                let words: Vec<String> = words.iter().map(|word| quoted(word)).collect();
                match words.as_slice() {
                    [only] => format!("{only} is needed"),
                    _ => format!("one of {} is needed", words.join(", ")),
                }
            }
            Kind::Quantities(unit) => {
                let noun = noun(unit);
                format!("a list is needed, each entry another {noun}{range}, e.g. {example}")
            }
            Kind::Series(unit) => {
                let noun = noun(unit);
                format!(
                    "{} {noun}{range}, or a list of them, is needed, e.g. {example}",
                    article(&noun)
                )
            }
            Kind::Words(words) => {
                let words: Vec<String> = words.iter().map(|word| quoted(word)).collect();
                format!(
                    "a list is needed, each entry another one of {}",
                    words.join(", ")
                )
            }
            Kind::Texts => {
                format!("a list of texts in quotes, all different, is needed, e.g. {example}")
            }
            Kind::Matrix(units) => format!(
                "rows of equally many quantities in {} are needed, e.g. {example}; 0 needs no unit",
                units.join(" or ")
            ),
            Kind::Filters => format!(
                "filters are needed, each coefficients of s, the highest power first, whose quotient has no unit, e.g. {example}; 0 needs no unit"
            ),
            Kind::Any(needed) => needed.to_string(),
            Kind::Switch => "true or false is needed".to_string(),
            Kind::Text => format!("a text in quotes is needed, e.g. {example}"),
        }
    }
}

/// The dimension of an SI unit in words.
fn noun(unit: &str) -> String {
    let dimension = Unit::parse(unit).ok().map(|unit| unit.dimension());
    match dimension.and_then(Dimension::name) {
        // Torque and energy are one dimension; a key takes the first.
        Some(name) => name.trim_end_matches(" or energy").to_string(),
        None => format!("quantity in {unit}"),
    }
}

impl Range {
    /// The range as the end of a phrase: ` above 0`; empty for every value.
    pub fn text(self) -> String {
        match self {
            Range::Any => String::new(),
            Range::Positive => " above 0".to_string(),
            Range::NotNegative => " not below 0".to_string(),
            Range::Above(low) => format!(" above {}", units::number_text(low)),
            Range::AboveTo(low, high) => format!(
                " above {} and not above {}",
                units::number_text(low),
                units::number_text(high)
            ),
            Range::FromTo(low, high) => format!(
                " from {} to {}",
                units::number_text(low),
                units::number_text(high)
            ),
        }
    }

    /// Whether the value is allowed; not-a-number never is.
    pub fn holds(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Range::Any => true,
                Range::Positive => value > 0.0,
                Range::NotNegative => value >= 0.0,
                Range::Above(low) => value > low,
                Range::FromTo(low, high) => (low..=high).contains(&value),
                Range::AboveTo(low, high) => value > low && value <= high,
            }
    }
}

impl Condition {
    /// That the key of a path has one of these values.
    pub const fn new(path: &'static str, values: &'static [&'static str]) -> Condition {
        let reason = "";
        Condition {
            path,
            values,
            reason,
        }
    }

    /// The same with the reason why a key has no meaning otherwise.
    pub const fn because(mut self, reason: &'static str) -> Condition {
        self.reason = reason;
        self
    }

    /// The condition in words: `bearing.traction.law = "tanh" or "dry"`.
    pub fn text(&self) -> String {
        let values: Vec<String> = self.values.iter().map(|value| quoted(value)).collect();
        format!("{} = {}", self.path, values.join(" or "))
    }
}

/// `a` or `an`.
pub fn article(noun: &str) -> &'static str {
    if noun.starts_with(['a', 'e', 'i', 'o']) || noun == "unbalance" {
        "an"
    } else {
        "a"
    }
}

/// A TOML basic string.
pub fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            '\r' => out.push_str("\\r"),
            c if c.is_control() => out.push_str(&format!("\\u{:04X}", u32::from(c))),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_says_what_it_needs() {
        let mass = Key::<()>::new("rotor.mass", Kind::Quantity("kg"), "8 kg", "Mass.").positive();
        assert_eq!(mass.needed(), "a mass above 0 is needed, e.g. \"8 kg\"");
        let count =
            Key::<()>::new("a.n", Kind::Count, "10", "Count.").within(Range::FromTo(1.0, 60.0));
        assert_eq!(
            count.needed(),
            "a whole number from 1 to 60 is needed, e.g. 10"
        );
        let word = Key::<()>::new("a.w", Kind::Word(&["on", "off"]), "on", "Word.");
        assert_eq!(word.needed(), "one of \"on\", \"off\" is needed");
    }

    #[test]
    fn quoting_survives_quotes_and_line_breaks() {
        assert_eq!(quoted("a\"b\\c\nd\u{1}"), "\"a\\\"b\\\\c\\nd\\u0001\"");
    }

    #[test]
    fn no_range_holds_for_not_a_number() {
        for range in [
            Range::Any,
            Range::Positive,
            Range::NotNegative,
            Range::Above(0.5),
            Range::FromTo(0.0, 1.0),
        ] {
            assert!(!range.holds(f64::NAN) && !range.holds(f64::INFINITY));
        }
        assert!(!Range::Positive.holds(0.0) && Range::NotNegative.holds(0.0));
        assert!(!Range::Above(0.5).holds(0.5) && Range::FromTo(0.0, 1.0).holds(1.0));
    }
}
