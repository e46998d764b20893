//! Units whose factors are written as one word.

use crate::dimension::Dimension;
use crate::quantity::split_number;
use crate::symbols::SYMBOLS;
use crate::unit::Unit;

/// The unit of a quantity such as `5000 Ns/m` or `0.09 kgm2` with blanks between its factors and marks before its powers,
/// `N s/m` or `kg m^2`, where that is of the dimension wanted.
pub fn as_product(text: &str, wanted: Dimension) -> Option<String> {
    let unit = split_number(text.trim()).ok()?.rest.trim_start();
    let mut spaced = String::new();
    let mut rest = unit;
    while let Some(first) = rest.chars().next() {
        let is_letter = |c: char| c.is_alphabetic();
        let end = match is_letter(first) {
            true => rest.find(|c| !is_letter(c)),
            false => rest.find(is_letter),
        };
        let (piece, behind) = rest.split_at(end.unwrap_or(rest.len()));
        let is_power = first.is_ascii_digit() && !spaced.is_empty();
        match is_letter(first) {
            true => spaced.push_str(&factors(piece)?.join(" ")),
            false if is_power => spaced.push_str(&format!("^{piece}")),
            false => spaced.push_str(piece),
        }
        rest = behind;
    }
    let fits = Unit::parse(&spaced).is_ok_and(|unit| unit.dimension() == wanted);
    (fits && spaced != unit).then_some(spaced)
}

/// A word as known symbols, the longest first.
fn factors(word: &str) -> Option<Vec<&str>> {
    if word.is_empty() {
        return Some(Vec::new());
    }
    let mut known: Vec<usize> = (SYMBOLS.iter())
        .filter(|symbol| word.starts_with(symbol.text))
        .map(|symbol| symbol.text.len())
        .collect();
    known.sort_unstable_by(|a, b| b.cmp(a));
    known.into_iter().find_map(|length| {
        let mut list = vec![&word[..length]];
        list.extend(factors(&word[length..])?);
        Some(list)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_written_as_one_word_are_told_apart() {
        for (text, unit, meant) in [
            ("5000 Ns/m", "N s/m", "N s/m"),
            ("0.09 kgm2", "kg m^2", "kg m^2"),
            ("0.09 kgm^2", "kg m^2", "kg m^2"),
            ("40 gmm", "kg m", "g mm"),
            ("1e5 kNs/m", "N s/m", "kN s/m"),
        ] {
            let wanted = Unit::parse(unit).unwrap().dimension();
            assert_eq!(as_product(text, wanted).as_deref(), Some(meant), "{text}");
        }
        assert_eq!(as_product("8 kgs", Dimension::MASS), None);
        assert_eq!(as_product("8 furlong", Dimension::LENGTH), None);
        assert_eq!(as_product("8", Dimension::LENGTH), None);
    }
}
