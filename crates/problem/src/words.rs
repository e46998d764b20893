//! Enums that are the words of a key.

/// An enum each value of which is a word in a file.
pub trait Words: Copy + PartialEq + 'static {
    /// All values.
    const ALL: &'static [Self];
    /// Their words, in the same order.
    const WORDS: &'static [&'static str];

    /// The value of a word.
    fn of_word(word: &str) -> Option<Self> {
        let place = Self::WORDS.iter().position(|known| *known == word)?;
        Some(Self::ALL[place])
    }

    /// The word of a value.
    fn as_word(self) -> &'static str {
        let place = Self::ALL.iter().position(|known| *known == self);
        Self::WORDS[place.unwrap_or(0)]
    }
}

/// An enum with the word of each value, which its documentation names.
#[macro_export]
macro_rules! words {
    ($(#[$of_enum:meta])* $vis:vis enum $Name:ident { $($(#[$of_value:meta])* $Value:ident = $word:literal,)+ }) => {
        $(#[$of_enum])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        $vis enum $Name {
            $($(#[$of_value])* #[doc = concat!("\n\nIn a file: `", $word, "`.")] $Value,)+
        }

        impl $crate::words::Words for $Name {
            const ALL: &'static [Self] = &[$($Name::$Value,)+];
            const WORDS: &'static [&'static str] = &[$($word,)+];
        }
    };
}
