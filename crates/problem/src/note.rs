//! Sentences with their values: what is said of several tests or channels is recognised by its pattern, and never by its words.

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
/// let swing = |frequency: f64| note!("{}: the reading swings at {:.1} Hz", "Torque", frequency);
/// let (slow, quick) = (swing(27.04), swing(144.62));
/// assert!(slow.is_like(&quick) && slow != quick);
/// assert_eq!(slow.to_string(), "Torque: the reading swings at 27.0 Hz");
/// assert_eq!(slow.widened(&quick).to_string(), "Torque: the reading swings at 27.0 to 144.6 Hz");
/// ```
///
/// A value stands behind the pattern; one within it would be no value of the sentence:
///
/// ```compile_fail,E0308
/// let frequency = 27.0;
/// problem::note!("the reading swings at {frequency:.1} Hz");
/// ```
#[derive(Clone)]
pub struct Note {
    pattern: &'static str,
    values: Vec<Shown>,
    render: Render,
}

/// Writes a pattern with its values one after another.
type Render = fn(&mut Iter<'_, Shown>) -> String;

impl Note {
    /// A sentence that `render` writes from a pattern and its values.
    pub fn new(pattern: &'static str, values: Vec<Shown>, render: Render) -> Note {
        Note {
            pattern,
            values,
            render,
        }
    }

    /// Whether both say the same but for their numbers.
    pub fn is_like(&self, other: &Note) -> bool {
        let values = || self.values.iter().zip(&other.values);
        self.pattern == other.pattern && values().all(|(own, other)| own.is_like(other))
    }

    /// The same with each number from the smallest to the largest of both.
    pub fn widened(&self, other: &Note) -> Note {
        let values = self.values.iter().zip(&other.values);
        let values = values.map(|(own, other)| own.widened(other)).collect();
        Note::new(self.pattern, values, self.render)
    }
}

impl Shown {
    fn is_like(&self, other: &Shown) -> bool {
        match (self, other) {
            (Shown::Numbers(..), Shown::Numbers(..)) => true,
            (Shown::Note(own), Shown::Note(other)) => own.is_like(other),
            _ => self == other,
        }
    }

    fn widened(&self, other: &Shown) -> Shown {
        match (self, other) {
            (Shown::Numbers(least, most), Shown::Numbers(low, high)) => {
                Shown::Numbers(least.min(*low), most.max(*high))
            }
            (Shown::Note(own), Shown::Note(other)) => Shown::Note(own.widened(other)),
            _ => self.clone(),
        }
    }

    /// Writes it, its numbers in words of `number`.
    fn write(&self, f: &mut fmt::Formatter<'_>, number: impl Fn(f64) -> String) -> fmt::Result {
        match self {
            Shown::Numbers(least, most) => match (number(*least), number(*most)) {
                (least, most) if least == most => f.write_str(&least),
                (least, most) => write!(f, "{least} to {most}"),
            },
            Shown::Text(text) => f.write_str(text),
            Shown::Note(note) => write!(f, "{note}"),
        }
    }
}

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match f.precision() {
            Some(digits) => self.write(f, |value| format!("{value:.digits$}")),
            None => self.write(f, |value| value.to_string()),
        }
    }
}

impl fmt::LowerExp for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match f.precision() {
            Some(digits) => self.write(f, |value| format!("{value:.digits$e}")),
            None => self.write(f, |value| format!("{value:e}")),
        }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&(self.render)(&mut self.values.iter()))
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
        $crate::note::Note::new($pattern, vec![$($crate::note::Shown::from($value)),*], |_values| {
            format!($pattern $(, $crate::note!(@next _values $value))*)
        })
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settled(ratio: f64, at: &str) -> Note {
        crate::note!(
            "it settles at {:.3} of {}, a factor of {:.0e}",
            ratio,
            at,
            1e3 * ratio
        )
    }

    #[test]
    fn the_same_of_two_is_one_sentence_with_ranges() {
        let (one, other) = (settled(0.714, "M"), settled(0.952, "M"));
        assert!(one.is_like(&other) && one != other && one == settled(0.714, "M"));
        let both = "it settles at 0.714 to 0.952 of M, a factor of 7e2 to 1e3";
        assert_eq!(one.widened(&other).to_string(), both);
        assert_eq!(other.widened(&one).widened(&one), one.widened(&other));
        // what differs only beyond the digits that are shown is one number
        let near = one.widened(&settled(0.714_2, "M"));
        assert_eq!(near.to_string(), one.to_string());
        let count = |count: usize| crate::note!("{} of {} marks", count, 60_u32);
        let counts = count(1446).widened(&count(27));
        assert_eq!(counts.to_string(), "27 to 1446 of 60 marks");
    }

    #[test]
    fn another_text_or_pattern_is_another_sentence() {
        assert!(!settled(0.7, "M").is_like(&settled(0.7, "F")));
        let text = |text: &str| Note::from(text.to_string());
        assert!(
            text("3 gaps").is_like(&text("3 gaps")) && !text("3 gaps").is_like(&text("4 gaps"))
        );
        let (one, other) = (crate::note!("{} gaps", 3.0), crate::note!("{} holes", 3.0));
        assert!(!one.is_like(&other) && one != other && one != text("3 gaps"));
        // a number where the other has a text
        assert!(!crate::note!("{} gaps", "3").is_like(&one));
    }

    #[test]
    fn a_sentence_within_a_sentence_keeps_its_values() {
        let within = |ratio: f64| crate::note!("tap: {}", settled(ratio, "M"));
        assert!(within(0.5).is_like(&within(0.7)));
        assert!(!within(0.5).is_like(&crate::note!("tap: {}", settled(0.5, "F"))));
        let both = within(0.7).widened(&within(0.5)).to_string();
        assert!(
            both.starts_with("tap: it settles at 0.500 to 0.700 of M"),
            "{both}"
        );
        assert_eq!(
            format!("{:?}", within(0.5)),
            format!("{:?}", within(0.5).to_string())
        );
    }
}
