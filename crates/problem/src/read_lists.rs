//! Lists: several values of one kind; a single one needs no brackets.

use crate::key::{Key, Kind, quoted};
use crate::raw::Raw;
use crate::read::Reader;
use crate::read_rows::cell;
use crate::value::Value;
use crate::{Code, Place, Result, did_you_mean};

impl Reader<'_> {
    /// Reads a list; a problem names the entry, counted from 1.
    pub(crate) fn read_list<S>(
        &self,
        key: &Key<S>,
        raw: &Raw,
        place: Place,
    ) -> Result<(Value, String)> {
        let wrong = |code, found: String, hint| {
            self.problem(code, place, found, key.needed())
                .with_hint(hint)
        };
        let single = std::slice::from_ref(raw);
        let (entries, alone): (&[Raw], bool) = match raw {
            Raw::List(entries) => (entries, false),
            _ => (single, true),
        };
        if entries.is_empty() {
            return Err(wrong(Code::WrongType, "an empty list".to_string(), None));
        }
        let where_in = |number: usize| match alone {
            true => String::new(),
            false => format!(" as entry {number}"),
        };
        let mut numbers = Vec::new();
        let mut words = Vec::new();
        let mut texts: Vec<String> = Vec::new();
        for (number, entry) in entries.iter().enumerate().map(|(i, entry)| (i + 1, entry)) {
            let text = match (key.kind, entry) {
                (Kind::Quantities(unit) | Kind::Series(unit), entry) => {
                    let (si, text) = cell(entry, unit).map_err(|(code, found, hint)| {
                        let found = found.trim_end_matches(',');
                        wrong(code, format!("{found}{}", where_in(number)), hint)
                    })?;
                    if !key.range.holds(si) {
                        let found = format!("{}{}", quoted(&text), where_in(number));
                        return Err(wrong(Code::OutOfRange, found, None));
                    }
                    numbers.push(si);
                    text
                }
                (Kind::Words(known), Raw::Text(text)) => {
                    let Some(word) = known.iter().find(|word| *word == text) else {
                        let found = format!("{}{}", quoted(text), where_in(number));
                        let hint = did_you_mean(text, known.iter().copied());
                        return Err(wrong(Code::UnknownWord, found, hint));
                    };
                    words.push(*word);
                    text.clone()
                }
                (Kind::Texts, Raw::Text(text)) => text.clone(),
                (_, other) => {
                    let found = format!("{}{}", other.text(), where_in(number));
                    return Err(wrong(Code::WrongType, found, None));
                }
            };
            let alike = texts.iter().position(|known| *known == text);
            if let Some(first) = alike.filter(|_| !matches!(key.kind, Kind::Series(_))) {
                let found = format!("{} as entries {} and {number}", quoted(&text), first + 1);
                return Err(wrong(Code::Conflict, found, None));
            }
            texts.push(text);
        }
        let listed: Vec<String> = texts.iter().map(|text| quoted(text)).collect();
        let value = match key.kind {
            Kind::Quantities(_) | Kind::Series(_) => Value::Numbers(numbers),
            Kind::Words(_) => Value::Words(words),
            _ => Value::Texts(texts),
        };
        Ok((value, format!("[{}]", listed.join(", "))))
    }
}
