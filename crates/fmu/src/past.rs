//! A state as bytes: what an instance did since its start, from which any instance of the same unit comes to the same bits again.
//!
//! It is short, does not depend on the layout of the library's memory, and costs its reader the computing time of the run until then.

use crate::instance::{Entry, Past, Phase, Settings};
use std::collections::BTreeMap;

/// What such bytes begin with.
const HEAD: &[u8] = b"auxbear unit state 1\n";

/// Bytes of a state of the unit with that guid.
pub(crate) fn written(guid: &str, past: &Past) -> Vec<u8> {
    let mut out = Writer(HEAD.to_vec());
    out.text(guid);
    out.numbers(past.settings.parameters.iter());
    out.count(usize::from(past.settings.stops_at_contacts));
    out.text(&past.settings.run_directory);
    out.numbers(past.inputs.iter());
    out.count(
        PHASES
            .iter()
            .position(|own| *own == past.phase)
            .unwrap_or(0),
    );
    out.number(past.start);
    out.count(past.done.len());
    for entry in &past.done {
        out.numbers(
            entry
                .inputs
                .iter()
                .map(|(reference, value)| (reference, value)),
        );
        out.number(entry.until);
    }
    out.numbers(
        past.pending
            .iter()
            .map(|(reference, value)| (reference, value)),
    );
    out.0
}

/// The state in bytes; none where they are not of this unit.
pub(crate) fn read(guid: &str, bytes: &[u8]) -> Option<Past> {
    let mut from = Reader(bytes.strip_prefix(HEAD)?);
    if from.text()? != guid {
        return None;
    }
    let parameters: BTreeMap<u32, f64> = from.numbers()?.into_iter().collect();
    let stops_at_contacts = from.count()? != 0;
    let run_directory = from.text()?;
    let inputs = from.numbers()?.into_iter().collect();
    let phase = *PHASES.get(from.count()?)?;
    let start = from.number()?;
    let entry = |from: &mut Reader| {
        Some(Entry {
            inputs: from.numbers()?,
            until: from.number()?,
        })
    };
    let done = (0..from.count()?)
        .map(|_| entry(&mut from))
        .collect::<Option<_>>()?;
    let pending = from.numbers()?;
    from.0.is_empty().then_some(Past {
        settings: Settings {
            parameters,
            stops_at_contacts,
            run_directory,
        },
        inputs,
        phase,
        start,
        done,
        pending,
    })
}

const PHASES: [Phase; 4] = [
    Phase::Instantiated,
    Phase::Initializing,
    Phase::Stepping,
    Phase::Terminated,
];

struct Writer(Vec<u8>);

impl Writer {
    fn count(&mut self, value: usize) {
        self.0.extend_from_slice(&(value as u64).to_le_bytes());
    }
    fn number(&mut self, value: f64) {
        self.0.extend_from_slice(&value.to_bits().to_le_bytes());
    }
    fn text(&mut self, value: &str) {
        self.count(value.len());
        self.0.extend_from_slice(value.as_bytes());
    }
    fn numbers<'a>(&mut self, list: impl ExactSizeIterator<Item = (&'a u32, &'a f64)>) {
        self.count(list.len());
        for (reference, value) in list {
            self.count(*reference as usize);
            self.number(*value);
        }
    }
}

struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn word(&mut self) -> Option<u64> {
        let (word, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(u64::from_le_bytes(*word))
    }
    fn count(&mut self) -> Option<usize> {
        usize::try_from(self.word()?).ok()
    }
    fn number(&mut self) -> Option<f64> {
        Some(f64::from_bits(self.word()?))
    }
    fn text(&mut self) -> Option<String> {
        let length = self.count()?;
        let (text, rest) = self.0.split_at_checked(length)?;
        self.0 = rest;
        String::from_utf8(text.to_vec()).ok()
    }
    fn numbers(&mut self) -> Option<Vec<(u32, f64)>> {
        let count = self.count()?;
        (0..count)
            .map(|_| Some((u32::try_from(self.word()?).ok()?, self.number()?)))
            .collect()
    }
}
