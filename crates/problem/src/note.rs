//! Sentences with their values: what is said of several tests or channels is recognised by its pattern, and never by its words.

use crate::warning::Word;
use serde::{Deserialize, Serialize};
use std::{fmt, slice::Iter};

/// A value in a sentence.
#[derive(Clone, Debug, PartialEq)]
pub enum Shown {
    /// A number; several as the smallest and the largest.
    Numbers(f64, f64),
    /// A name or word.
    Text(String),
    /// A sentence within the sentence.
    Note(Note),
}

/// A sentence: its pattern, and the values in it. Made by [`note!`](crate::note!).
///
/// ```
/// use problem::note;
///
/// let swing = |frequency: f64| note!("{}: it swings at {:.1} Hz", "Torque", frequency);
/// let both = swing(27.04).joined(&swing(144.62)).unwrap();
/// assert_eq!(both.to_string(), "Torque: it swings at 27.0 to 144.6 Hz");
/// ```
///
/// A value stands behind the pattern; one within it would be no value of the sentence:
///
/// ```compile_fail,E0308
/// let frequency = 27.0;
/// problem::note!("it swings at {frequency:.1} Hz");
/// ```
///
/// A file has its words alone.
#[derive(Clone, Serialize, Deserialize)]
#[serde(from = "String", into = "String")]
pub struct Note {
    pattern: Word,
    values: Vec<Shown>,
    render: Render,
}

/// Writes a pattern with its values one after another.
type Render = fn(&mut Iter<'_, Shown>, &mut fmt::Formatter<'_>) -> fmt::Result;

impl Note {
    /// A sentence that `render` writes from a pattern and its values.
    pub fn new(pattern: Word, values: Vec<Shown>, render: Render) -> Note {
        Note {
            pattern,
            values,
            render,
        }
    }

    /// Both as one, each number from the smallest to the largest; none where they differ in more than their numbers.
    pub fn joined(&self, other: &Note) -> Option<Note> {
        let values = self.values.iter().zip(&other.values);
        let values: Option<_> = values.map(|(own, other)| own.joined(other)).collect();
        (self.pattern == other.pattern).then_some(Note::new(self.pattern, values?, self.render))
    }
}

impl Shown {
    fn joined(&self, other: &Shown) -> Option<Shown> {
        match (self, other) {
            (Shown::Numbers(least, most), Shown::Numbers(low, high)) => {
                Some(Shown::Numbers(least.min(*low), most.max(*high)))
            }
            (Shown::Note(own), Shown::Note(other)) => own.joined(other).map(Shown::Note),
            _ => (self == other).then(|| self.clone()),
        }
    }
}

impl fmt::Display for Shown {
    /// Where least and largest number look the same with their digits, it is written once.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = |value: &f64| match f.precision() {
            Some(digits) => format!("{value:.digits$}"),
            None => value.to_string(),
        };
        match self {
            Shown::Numbers(least, most) => match (number(least), number(most)) {
                (least, most) if least == most => f.write_str(&least),
                (least, most) => write!(f, "{least} to {most}"),
            },
            Shown::Text(text) => f.write_str(text),
            Shown::Note(note) => write!(f, "{note}"),
        }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        (self.render)(&mut self.values.iter(), f)
    }
}

impl fmt::Debug for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.to_string())
    }
}

impl PartialEq for Note {
    fn eq(&self, other: &Note) -> bool {
        self.pattern == other.pattern && self.values == other.values
    }
}

impl From<String> for Note {
    fn from(text: String) -> Note {
        crate::note!("{}", text)
    }
}

impl From<Note> for String {
    fn from(note: Note) -> String {
        note.to_string()
    }
}

impl From<Note> for Shown {
    fn from(note: Note) -> Shown {
        Shown::Note(note)
    }
}

macro_rules! shown {
    ($($number:ty)* ; $($text:ty)*) => {
        $(impl From<$number> for Shown {
            fn from(value: $number) -> Shown {
                Shown::Numbers(value as f64, value as f64)
            }
        }
        impl From<&$number> for Shown {
            fn from(value: &$number) -> Shown {
                Shown::from(*value)
            }
        })*
        $(impl From<$text> for Shown {
            fn from(text: $text) -> Shown {
                Shown::Text(text.into())
            }
        })*
    };
}
shown!(f64 usize u32 i32 i64 ; String &String &str);

/// The next value of a pattern.
#[doc(hidden)]
pub fn next<'a>(values: &mut Iter<'a, Shown>) -> &'a Shown {
    static NOTHING: Shown = Shown::Text(String::new());
    values.next().unwrap_or(&NOTHING)
}

/// A [`Note`](crate::note::Note) of a pattern, as `format!` takes it, and the values that stand behind it.
#[macro_export]
macro_rules! note {
    (@next $values:ident $value:expr) => { $crate::note::next($values) };
    ($pattern:literal $(, $value:expr)* $(,)?) => {
        $crate::note::Note::new($pattern, vec![$($crate::note::Shown::from($value)),*], |_values, f| {
            write!(f, $pattern $(, $crate::note!(@next _values $value))*)
        })
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settled(ratio: f64, at: &str) -> Note {
        note!("it settles at {:.3} of {}", ratio, at)
    }

    #[test]
    fn the_same_of_two_is_one_sentence_with_ranges() {
        let (one, other) = (settled(0.714, "M"), settled(0.952, "M"));
        let both = one.joined(&other).unwrap();
        assert_eq!(both.to_string(), "it settles at 0.714 to 0.952 of M");
        assert_eq!(other.joined(&one).unwrap().joined(&one), Some(both));
        // what differs only beyond the digits that are shown is one number
        let near = one.joined(&settled(0.714_2, "M")).unwrap();
        assert!(near != one && near.to_string() == one.to_string());
        let count = |count: usize| note!("{} of {} marks", count, 60_u32);
        let counts = count(1446).joined(&count(27)).unwrap();
        assert_eq!(counts.to_string(), "27 to 1446 of 60 marks");
    }

    #[test]
    fn another_text_or_pattern_is_another_sentence() {
        assert_eq!(settled(0.7, "M").joined(&settled(0.7, "F")), None);
        let text = |text: &str| Note::from(text.to_string());
        assert_eq!(text("3 gaps").joined(&text("3 gaps")), Some(text("3 gaps")));
        assert_eq!(text("3 gaps").joined(&text("4 gaps")), None);
        let one = note!("{} gaps", 3.0);
        // another pattern, the same words, a text in place of a number
        for other in [
            note!("{} holes", 3.0),
            text("3 gaps"),
            note!("{} gaps", "3"),
        ] {
            assert!(one.joined(&other).is_none() && one != other, "{other}");
        }
    }

    #[test]
    fn a_sentence_within_a_sentence_keeps_its_values() {
        let tap = |ratio: f64, at: &str| note!("tap: {}", settled(ratio, at));
        let both = tap(0.7, "M").joined(&tap(0.5, "M")).unwrap();
        assert_eq!(both.to_string(), "tap: it settles at 0.500 to 0.700 of M");
        assert_eq!(tap(0.5, "M").joined(&tap(0.5, "F")), None);
    }
}
