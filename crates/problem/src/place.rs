//! Where in an input something stands.

/// Where in the input the wrong thing stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Place {
    /// Nowhere in particular: the file as a whole, or something that is missing.
    #[default]
    Whole,
    /// A line of the file, counted from 1.
    Line {
        /// Line, from 1.
        line: usize,
        /// Column in characters, from 1.
        column: usize,
    },
    /// An override on the command line.
    Set,
}

impl Place {
    /// The place of a byte offset in a text.
    pub fn of_offset(text: &str, offset: usize) -> Place {
        let mut offset = offset.min(text.len());
        while !text.is_char_boundary(offset) {
            offset -= 1;
        }
        let before = &text[..offset];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        Place::Line {
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
        }
    }

    /// The line, where there is one.
    pub fn line(self) -> Option<usize> {
        match self {
            Place::Line { line, .. } => Some(line),
            Place::Whole | Place::Set => None,
        }
    }
}
