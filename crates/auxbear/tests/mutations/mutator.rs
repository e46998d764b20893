//! Mutations of files, seeded: the same number gives the same file.

/// Random numbers. Source: Steele, Lea, Flood, "Fast splittable pseudorandom number generators" (2014): SplitMix64.
pub struct Dice(u64);

impl Dice {
    pub fn new(seed: u64) -> Dice {
        Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d)
    }

    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below another one; 0 where that is 0.
    pub fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }

    pub fn of<'a, T>(&mut self, list: &'a [T]) -> &'a T {
        &list[self.below(list.len())]
    }

    /// Mostly one, now and then several.
    fn several(&mut self) -> usize {
        1 + self.next().trailing_zeros().min(7) as usize
    }

    /// A stretch of something that long; short ones are as likely as long ones.
    fn stretch(&mut self, length: usize) -> std::ops::Range<usize> {
        let from = self.below(length);
        let longest = (length - from) >> self.below(16);
        from..from + self.below(longest + 1).max(usize::from(length > from))
    }
}

/// A file with some bytes changed, cut, repeated or exchanged; `other` lends stretches.
pub fn bytes(dice: &mut Dice, seed: &[u8], other: &[u8]) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..dice.several() {
        if bytes.is_empty() {
            bytes.extend(other);
        }
        change_bytes(dice, &mut bytes, other);
    }
    bytes
}

fn change_bytes(dice: &mut Dice, bytes: &mut Vec<u8>, other: &[u8]) {
    let at = dice.below(bytes.len());
    match dice.below(12) {
        0..=2 => {
            if let Some(byte) = bytes.get_mut(at) {
                *byte ^= 1 << dice.below(8);
            }
        }
        3 => {
            if let Some(byte) = bytes.get_mut(at) {
                *byte = *dice.of(&[0, 1, 0x7f, 0x80, 0xff, b'\n', b'"', b'9']);
            }
        }
        // a number of some width, in either byte order: sizes, counts and offsets are such
        4..=6 => {
            let length = bytes.len() as u64;
            let extremes = [
                0,
                1,
                2,
                u64::MAX,
                u64::MAX / 2,
                1 << 31,
                u64::from(u32::MAX),
                length,
                length + 1,
                length / 2,
            ];
            let value = match dice.below(3) {
                0 => dice.next() >> dice.below(64),
                _ => *dice.of(&extremes),
            };
            let width = *dice.of(&[1, 2, 4, 8]);
            let mut raw = value.to_le_bytes();
            if dice.below(4) == 0 {
                raw[..width].reverse();
            }
            let at = if dice.below(2) == 0 {
                at & !(width - 1)
            } else {
                at
            };
            for (byte, raw) in bytes.iter_mut().skip(at).zip(&raw[..width]) {
                *byte = *raw;
            }
        }
        7 => bytes.truncate(at),
        8 => {
            let stretch = dice.stretch(bytes.len());
            bytes.drain(stretch);
        }
        9 => {
            let stretch = dice.stretch(bytes.len());
            let copy = bytes[stretch].to_vec();
            bytes.splice(at..at, copy);
        }
        10 => {
            let stretch = dice.stretch(bytes.len());
            let value = dice.next() as u8;
            let wild = dice.below(2) == 0;
            for byte in &mut bytes[stretch] {
                *byte = if wild { dice.next() as u8 } else { value };
            }
        }
        _ => {
            let stretch = dice.stretch(other.len());
            let end = (at + stretch.len()).min(bytes.len());
            let insert = dice.below(2) == 0;
            bytes.splice(
                at..if insert { at } else { end },
                other[stretch].iter().copied(),
            );
        }
    }
}

const NUMBERS: &[&str] = &[
    "0",
    "-0.0",
    "1",
    "-1",
    "2",
    "3",
    "7",
    "0.5",
    "1e-3",
    "1e-9",
    "1e-30",
    "1e-308",
    "1e308",
    "1e400",
    "-1e9",
    "1e9",
    "1e5",
    "100",
    "1000",
    "4294967296",
    "9223372036854775807",
    "nan",
    "inf",
    "-inf",
    "0x7f",
    "1_000",
    "",
];
const WORDS: &[&str] = &[
    "\"\"",
    "\"1 mm\"",
    "\"5 rpm\"",
    "\"-3 K\"",
    "\"0 s\"",
    "\"1 h\"",
    "\"7 N\"",
    "\"µ\"",
    "\"a\\u0000b\"",
    "true",
    "[]",
    "{}",
    "[1, 2, 3]",
    "{ value = 1 }",
    "{ value = \"1 N\", assumed = \"\" }",
    "1979-05-27T07:32:00Z",
    "'''",
    "\"6205\"",
];
const SIGNS: &[char] = &[
    '"', '\'', '[', ']', '{', '}', '=', '.', ',', '#', '\n', '\t', '\\', '\u{0}', 'µ', '\u{feff}',
    '9', 'e', '-',
];

/// A text with some numbers, words, lines or letters changed; `other` lends lines.
pub fn text(dice: &mut Dice, seed: &str, other: &str) -> String {
    let mut text = seed.to_string();
    for _ in 0..dice.several() {
        text = change_text(dice, &text, other);
    }
    text
}

/// A text with one number changed, or a few: most of these still mean something.
pub fn numbers(dice: &mut Dice, seed: &str) -> String {
    let mut text = seed.to_string();
    for _ in 0..dice.several() {
        text = change_number(dice, &text);
    }
    text
}

fn change_text(dice: &mut Dice, text: &str, other: &str) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    let line = dice.below(lines.len());
    match dice.below(14) {
        0..=4 => change_number(dice, text),
        5 | 6 => {
            let words = tokens(text, |c| c.is_alphanumeric() || "_./".contains(c));
            let others = tokens(other, |c| c.is_alphanumeric() || "_./".contains(c));
            match (words.is_empty(), others.is_empty()) {
                (false, false) => {
                    let (word, new) = (dice.of(&words).clone(), dice.of(&others).clone());
                    replaced(text, word, &other[new])
                }
                _ => text.to_string(),
            }
        }
        // the value behind a key
        7 => {
            let Some((key, _)) = lines.get(line).and_then(|line| line.split_once('=')) else {
                return text.to_string();
            };
            let new = format!("{key}= {}", dice.of(WORDS));
            lines[line] = &new;
            joined(&lines)
        }
        8 if !lines.is_empty() => {
            lines.remove(line);
            joined(&lines)
        }
        9 if !lines.is_empty() => {
            let to = dice.below(lines.len());
            lines.insert(to, lines[line]);
            joined(&lines)
        }
        10 if !lines.is_empty() => {
            let to = dice.below(lines.len());
            lines.swap(line, to);
            joined(&lines)
        }
        11 => {
            let others: Vec<&str> = other.lines().collect();
            if !others.is_empty() {
                lines.insert(line, others[dice.below(others.len())]);
            }
            joined(&lines)
        }
        12 => {
            let at = boundary(text, dice.below(text.len() + 1));
            let insert = match dice.below(8) {
                0 => "[".repeat(1 + dice.below(3000)),
                1 => "a = {".repeat(1 + dice.below(300)),
                2 => "x".repeat(dice.below(100_000)),
                _ => dice.of(SIGNS).to_string(),
            };
            format!("{}{insert}{}", &text[..at], &text[at..])
        }
        _ => {
            let from = boundary(text, dice.below(text.len() + 1));
            let to = match dice.below(3) {
                0 => text.len(),
                _ => boundary(text, (from + dice.below(8)).min(text.len())),
            };
            replaced(text, from..to, "")
        }
    }
}

fn change_number(dice: &mut Dice, text: &str) -> String {
    let found = tokens(text, |c| c.is_ascii_digit() || ".e-+".contains(c));
    let found: Vec<_> = found
        .into_iter()
        .filter(|token| text[token.clone()].parse::<f64>().is_ok())
        .collect();
    if found.is_empty() {
        return text.to_string();
    }
    let token = dice.of(&found).clone();
    let value: f64 = text[token.clone()].parse().unwrap_or(1.0);
    let new = match dice.below(4) {
        0 => dice.of(NUMBERS).to_string(),
        1 => format!("{}", -value),
        2 => format!("{}", value * 10f64.powi(dice.below(13) as i32 - 6)),
        _ => format!("{}", value * (0.5 + dice.below(1000) as f64 / 500.0)),
    };
    replaced(text, token, &new)
}

/// Places of the longest stretches of such letters.
fn tokens(text: &str, belongs: impl Fn(char) -> bool) -> Vec<std::ops::Range<usize>> {
    let mut found = Vec::new();
    let mut from = None;
    for (at, letter) in text.char_indices().chain([(text.len(), '\u{0}')]) {
        match (belongs(letter) && at < text.len(), from) {
            (true, None) => from = Some(at),
            (false, Some(begin)) => {
                found.push(begin..at);
                from = None;
            }
            _ => {}
        }
    }
    found
}

fn replaced(text: &str, at: std::ops::Range<usize>, new: &str) -> String {
    format!(
        "{}{new}{}",
        &text[..at.start],
        &text[at.end.max(at.start)..]
    )
}

fn joined(lines: &[&str]) -> String {
    lines.join("\n") + "\n"
}

fn boundary(text: &str, at: usize) -> usize {
    (0..=at)
        .rev()
        .find(|&at| text.is_char_boundary(at))
        .unwrap_or(0)
}

#[test]
fn the_same_seed_gives_the_same_mutation_and_others_give_others() {
    let seed = "a = \"3 mm\"\nb = [1, 2.5]\n";
    let all: Vec<String> = (0..200)
        .map(|k| text(&mut Dice::new(k), seed, "c = 1\n"))
        .collect();
    let again: Vec<String> = (0..200)
        .map(|k| text(&mut Dice::new(k), seed, "c = 1\n"))
        .collect();
    assert_eq!(all, again);
    let different: std::collections::BTreeSet<&String> = all.iter().collect();
    assert!(different.len() > 100, "{}", different.len());
    let raw = [7; 64];
    let changed = (0..200).filter(|&k| bytes(&mut Dice::new(k), &raw, &[1, 2, 3]) != raw);
    assert!(changed.count() > 180);
}
