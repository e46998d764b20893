//! What to know of the tests before trusting the numbers: what says the same of several tests is one line that names them, its
//! numbers from the smallest to the largest.

use crate::identify::read::Test;
use crate::signals;
use outcome::Warning;

problem::warnings! {
    /// Of the tests of an identification.
    pub enum IdentifyWarning {
        Unused { why: words } "AB1060" Invalid ("it is not used: {}.", why.trim_end_matches('.'));
        Doubt { finding: words } "AB1061" Uncertain ("{}.", finding.trim_end_matches('.'));
        Remark { note: words } "AB1062" Note ("{}.", note.trim_end_matches('.'));
        Reading { finding: words } "AB1063" Invalid ("{}.", finding.trim_end_matches('.'));
    }
}

/// A warning of one test; of all where it has no name.
///
/// Where the text begins with the name, or says it again on the way, it is left out: the line names the test already, and a name
/// that is a number is none to be merged.
pub(crate) fn of_test(warning: impl Into<Warning>, test: &str) -> Warning {
    let mut warning = warning.into();
    if test.is_empty() {
        return warning;
    }
    let named = format!("{test}: ");
    let text = warning.text.replace(&format!(" {named}"), " ");
    warning.text = text.trim_start_matches(named.as_str()).to_string();
    warning.of_part(test)
}

/// A word with the number in it, where it is one: what stands before it, the number as written, what stands behind it.
fn number(word: &str) -> Option<(&str, &str, &str)> {
    let core = word.trim_start_matches('(');
    let before = &word[..word.len() - core.len()];
    let core = core.trim_end_matches([')', ',', ';', ':', '%']);
    let behind = &word[before.len() + core.len()..];
    let begins = core
        .trim_start_matches('-')
        .starts_with(|c: char| c.is_ascii_digit());
    (begins && core.parse::<f64>().is_ok()).then_some((before, core, behind))
}

/// Whether two texts are the same but for their numbers.
fn alike(one: &str, other: &str) -> bool {
    let (mut left, mut right) = (one.split(' '), other.split(' '));
    loop {
        match (left.next(), right.next()) {
            (None, None) => return true,
            (Some(a), Some(b)) => match (number(a), number(b)) {
                (Some((before, _, behind)), Some(same)) if (before, behind) == (same.0, same.2) => {
                }
                _ if a == b => {}
                _ => return false,
            },
            _ => return false,
        }
    }
}

/// Texts that are alike as one, each number from its smallest to its largest.
fn merged(texts: &[&str]) -> String {
    let rows: Vec<Vec<&str>> = texts.iter().map(|text| text.split(' ').collect()).collect();
    let word = |column: usize| {
        let numbers: Vec<_> = rows.iter().filter_map(|row| number(row[column])).collect();
        let size = |core: &str| core.parse::<f64>().unwrap_or(0.0);
        let least = numbers
            .iter()
            .min_by(|a, b| size(a.1).total_cmp(&size(b.1)));
        let most = numbers
            .iter()
            .max_by(|a, b| size(a.1).total_cmp(&size(b.1)));
        match (least, most) {
            (Some((before, least, behind)), Some((_, most, _))) if size(least) != size(most) => {
                format!("{before}{least} to {most}{behind}")
            }
            _ => rows[0][column].to_string(),
        }
    };
    let words: Vec<String> = (0..rows[0].len()).map(word).collect();
    words.join(" ")
}

/// The lines: in the order in which each is said first.
pub(crate) fn grouped(warnings: &[Warning]) -> Vec<Warning> {
    let mut groups: Vec<Vec<&Warning>> = Vec::new();
    for one in warnings {
        if groups.iter().any(|group| group.contains(&one)) {
            continue;
        }
        // twice of one test is two things
        let group = groups.iter_mut().find(|group| {
            let first = group[0];
            first.code == one.code
                && !first.part.is_empty()
                && group.iter().all(|member| member.part != one.part)
                && !one.part.is_empty()
                && alike(without_stop(first), without_stop(one))
        });
        match group {
            Some(group) => group.push(one),
            None => groups.push(vec![one]),
        }
    }
    (groups.iter())
        .map(|group| {
            let names: Vec<&str> = group.iter().map(|own| own.part.as_str()).collect();
            let texts: Vec<&str> = group.iter().map(|own| without_stop(own)).collect();
            let mut warning = group[0].clone().of_part(&names.join(", "));
            warning.text = merged(&texts) + ".";
            warning
        })
        .collect()
}

fn without_stop(warning: &Warning) -> &str {
    warning.text.trim_end_matches('.')
}

/// What the estimators of the signals say.
pub(super) fn noted(test: &Test, found: &signals::estimate::Estimate) -> Vec<Warning> {
    (found.warnings.iter())
        .map(|warning| of_test(warning.clone(), &test.name))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signals::warning_table::SignalsWarning;

    fn of(code: &str, test: &str, text: &str) -> Warning {
        let note = text.to_string();
        let (about, rest) = text.split_once(": ").unwrap_or_default();
        let (about, rest) = (about.to_string(), rest.to_string());
        let warning: Warning = match code {
            "AB1060" => IdentifyWarning::Unused { why: note }.into(),
            "AB1061" => IdentifyWarning::Doubt { finding: note }.into(),
            "AB1062" => IdentifyWarning::Remark { note }.into(),
            "AB1041" => SignalsWarning::Channel { about, note: rest }.into(),
            _ => SignalsWarning::Estimate { about, note: rest }.into(),
        };
        of_test(warning, test)
    }

    fn texts(notes: &[Warning]) -> Vec<String> {
        grouped(notes)
            .into_iter()
            .map(|warning| warning.to_string())
            .collect()
    }

    #[test]
    fn the_same_of_several_tests_is_one_line_with_ranges() {
        let outside = |count: u32| {
            format!("{count} of 8029 times lie outside 3.7 to 150 rad/s: nothing is reported there")
        };
        let notes = [
            of("AB1062", "fast", &outside(1446)),
            of(
                "AB1061",
                "slow",
                "it settles at 0.714 of M, -7.4 ± 0.13 N mm (2σ) apart.",
            ),
            of("AB1062", "slow", &outside(27)),
            of(
                "AB1061",
                "fast",
                "it settles at 0.714 of M, -12.4 ± 0.13 N mm (2σ) apart",
            ),
            of("AB1062", "", "no SKF law is given."),
        ];
        assert_eq!(
            texts(&notes),
            [
                "fast, slow: 27 to 1446 of 8029 times lie outside 3.7 to 150 rad/s: nothing is reported there.",
                "slow, fast: it settles at 0.714 of M, -12.4 to -7.4 ± 0.13 N mm (2σ) apart.",
                "no SKF law is given.",
            ]
        );
    }
    #[test]
    fn the_name_of_a_test_is_said_once_though_it_be_a_number() {
        let notes: Vec<Warning> = ["1300", "7200", "11500"]
            .iter()
            .map(|name| of("AB1062", name, &format!("{name}: no cage signal")))
            .chain([of("AB1060", "r1", "r1: no mark")])
            .collect();
        assert_eq!(
            texts(&notes),
            [
                "1300, 7200, 11500: no cage signal.",
                "r1: it is not used: no mark.",
            ]
        );
    }
    #[test]
    fn what_differs_in_words_code_or_by_one_test_stays_apart() {
        let notes = [
            of("AB1043", "a", "Torque: 1 values are left out"),
            of("AB1043", "b", "Cage: 1 values are left out"),
            of("AB1041", "c", "Torque: 1 values are left out"),
            of("AB1043", "a", "Torque: 2 values are left out"),
            of("AB1043", "d", "Torque: 1 values are left out, and more"),
            // the very same of the same test is said once
            of("AB1043", "b", "Cage: 1 values are left out"),
            of("AB1062", "", "Torque: 1 values are left out"),
        ];
        let said = texts(&notes);
        assert_eq!(said.len(), 6, "{said:?}");
        // a word with a number in it is a name
        assert!(!alike("channel ch1: 3 gaps", "channel ch2: 3 gaps"));
        assert!(number("±").is_none() && number("inf").is_none() && number("-").is_none());
        assert_eq!(number("(5%),"), Some(("(", "5", "%),")));
    }
}
