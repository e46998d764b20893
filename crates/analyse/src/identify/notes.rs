//! What to know of the tests before trusting the numbers: what says the same of several tests is one line that names them, its
//! numbers from the smallest to the largest.

use crate::identify::read::Test;
use crate::signals;
use outcome::Warning;

problem::warnings! {
    /// Of the tests of an identification.
    pub enum IdentifyWarning {
        Unused { why: note } "AB1060" Invalid (note "it is not used: {}.", why);
        Doubt { finding: note } "AB1061" Uncertain (note "{}.", finding);
        Remark { note: note } "AB1062" Note (note "{}.", note);
        Reading { finding: note } "AB1063" Invalid (note "{}.", finding);
    }
}

/// The lines, in the order in which each is said first.
pub(crate) fn grouped(warnings: &[Warning]) -> Vec<Warning> {
    let mut groups: Vec<(Vec<&Warning>, Warning)> = Vec::new();
    for one in warnings {
        if groups.iter().any(|(members, _)| members.contains(&one)) {
            continue;
        }
        // twice of one test is two things
        let apart = |other: &&Warning| other.part != one.part && !other.part.is_empty();
        let mut of_tests = (groups.iter_mut())
            .filter(|(members, _)| members.iter().all(apart) && !one.part.is_empty());
        let joined = of_tests.find_map(|(members, line)| Some((line.joined(one)?, members, line)));
        match joined {
            Some((both, members, line)) => {
                members.push(one);
                *line = both;
            }
            None => groups.push((vec![one], one.clone())),
        }
    }
    let named = |(members, line): (Vec<&Warning>, Warning)| {
        let names: Vec<&str> = members.iter().map(|own| own.part.as_str()).collect();
        line.of_part(&names.join(", "))
    };
    groups.into_iter().map(named).collect()
}

/// What the estimators of the signals say.
pub(super) fn noted(test: &Test, found: &signals::estimate::Estimate) -> Vec<Warning> {
    let own = found.warnings.iter();
    own.map(|warning| warning.clone().of_part(&test.name))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signals::warning_table::SignalsWarning;
    use problem::{note, note::Note};

    fn remark(test: &str, note: Note) -> Warning {
        Warning::from(IdentifyWarning::Remark { note }).of_part(test)
    }

    fn estimate(test: &str, about: &str, note: Note) -> Warning {
        let about = about.to_string();
        Warning::from(SignalsWarning::Estimate { about, note }).of_part(test)
    }

    fn texts(lines: &[Warning]) -> Vec<String> {
        grouped(lines).iter().map(Warning::to_string).collect()
    }

    #[test]
    fn the_same_of_several_tests_is_one_line_with_ranges() {
        let outside = |count: u32| note!("{} of {} times lie outside", count, 8029_u32);
        let doubt = |test: &str, apart: f64| {
            let finding = note!("it settles {:.1} ± {:.2} N mm (2σ) apart", apart, 0.13);
            Warning::from(IdentifyWarning::Doubt { finding }).of_part(test)
        };
        let lines = [
            remark("fast", outside(1446)),
            doubt("slow", -7.4),
            remark("slow", outside(27)),
            doubt("fast", -12.4),
            remark("", note!("no SKF law is given")),
        ];
        assert_eq!(
            texts(&lines),
            [
                "fast, slow: 27 to 1446 of 8029 times lie outside.",
                "slow, fast: it settles -12.4 to -7.4 ± 0.13 N mm (2σ) apart.",
                "no SKF law is given.",
            ]
        );
    }
    #[test]
    fn the_name_of_a_test_is_said_once_though_it_be_a_number() {
        let unused = IdentifyWarning::Unused {
            why: "no mark".to_string().into(),
        };
        let lines: Vec<Warning> = (["1300", "7200", "11500"].iter())
            .map(|name| remark(name, note!("no cage signal")))
            .chain([Warning::from(unused).of_part("r1")])
            .collect();
        assert_eq!(
            texts(&lines),
            [
                "1300, 7200, 11500: no cage signal.",
                "r1: it is not used: no mark.",
            ]
        );
    }
    #[test]
    fn what_differs_in_words_code_or_by_one_test_stays_apart() {
        let left = |count: u32| note!("{} values are left out", count);
        let channel = SignalsWarning::Channel {
            about: "Torque".to_string(),
            note: left(1),
        };
        let lines = [
            estimate("a", "Torque", left(1)),
            estimate("b", "Cage", left(1)),
            Warning::from(channel).of_part("c"),
            estimate("a", "Torque", left(2)),
            estimate(
                "d",
                "Torque",
                note!("{} values are left out, and more", 1_u32),
            ),
            // the very same of the same test is said once
            estimate("b", "Cage", left(1)),
            remark("", note!("Torque: {} values are left out", 1_u32)),
            // a word with a number in it is a name
            remark("a", note!("{}: {} gaps", "channel 1", 3_u32)),
            remark("b", note!("{}: {} gaps", "channel 2", 3_u32)),
        ];
        let said = texts(&lines);
        assert_eq!(said.len(), 8, "{said:?}");
    }
}
