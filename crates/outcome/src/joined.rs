//! Warnings of the members of a repetition, joined.

use crate::{Amount, Scope, Severity, Warning};
use problem::warning::{Declared, Evaluation};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

/// Warnings of members, added in any order: each once, as the one has it where it is most severe.
#[derive(Clone, Default)]
pub struct Joined {
    members: usize,
    list: Vec<OfMembers>,
}

#[derive(Clone)]
struct OfMembers {
    warning: Warning,
    /// Whose it is, and in how many members it was found.
    member: usize,
    count: usize,
    /// Where it stands: the first member that has one, and its place among the warnings of that.
    place: (usize, usize),
    /// Whether all of them say the same.
    alike: bool,
}

impl OfMembers {
    /// Takes the same of other members; of those of one member the first counts.
    fn join(&mut self, other: OfMembers) {
        self.count += other.count;
        self.alike &= other.alike && self.warning.text == other.warning.text;
        self.place = self.place.min(other.place);
        // of equal ones that of the first member, so that no order of adding matters
        let (own, new) = (self.warning.grade, other.warning.grade);
        if new > own || new == own && other.member < self.member {
            (self.warning, self.member) = (other.warning, other.member);
        }
    }
}

/// A warning of members in words that a file keeps.
#[derive(Serialize, Deserialize)]
pub struct Told {
    code: String,
    severity: String,
    /// Place in [`EVALUATIONS`].
    evaluation: usize,
    part: String,
    names_part: bool,
    time: Option<f64>,
    values: Vec<(String, Said, String)>,
    grade: f64,
    text: String,
    member: usize,
    count: usize,
    place: (usize, usize),
    alike: bool,
}

const EVALUATIONS: [Evaluation; 4] = [
    Evaluation::File,
    Evaluation::Each,
    Evaluation::Unperturbed,
    Evaluation::CoastDown,
];

/// An [`Amount`] in a file.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Said {
    Number(f64),
    Text(String),
}

impl Joined {
    /// Adds those of a member, by its index, in their order; of another than the first only those judged in each.
    pub fn add(&mut self, member: usize, warnings: Vec<Warning>) {
        self.members += 1;
        let mut fresh: Vec<OfMembers> = Vec::new();
        for (at, warning) in warnings.into_iter().enumerate() {
            if member > 0 && !in_each(&warning) {
                continue;
            }
            let new = OfMembers {
                warning,
                member,
                count: 1,
                place: (member, at),
                alike: true,
            };
            // several of one kind in a member are one of it
            match find(&mut fresh, &new) {
                Some(known) => {
                    known.join(new);
                    known.count = 1;
                }
                None => fresh.push(new),
            }
        }
        self.take(fresh);
    }

    /// Adds those of other members.
    pub fn append(&mut self, other: Joined) {
        self.members += other.members;
        self.take(other.list);
    }

    fn take(&mut self, others: Vec<OfMembers>) {
        for new in others {
            match find(&mut self.list, &new) {
                Some(known) => known.join(new),
                None => self.list.push(new),
            }
        }
    }

    /// All of them, with the members that have them; `alike` where all have one machine.
    pub fn list(mut self, alike: bool) -> Vec<Warning> {
        let all = self.members;
        self.list.sort_by_key(|own| own.place);
        let scope = |own: &OfMembers| match own.warning.evaluation {
            Evaluation::File => Scope::Alike,
            Evaluation::Unperturbed => Scope::Unperturbed,
            // what follows from the machine alone
            _ if alike && own.alike && own.count == all => Scope::Alike,
            _ => Scope::Each {
                count: own.count,
                all,
                member: own.member,
            },
        };
        let told = |mut own: OfMembers| {
            own.warning.scope = scope(&own);
            own.warning
        };
        self.list.into_iter().map(told).collect()
    }

    /// All of them in words that a file keeps.
    pub fn told(&self) -> Vec<Told> {
        let tell = |own: &OfMembers| Told {
            code: own.warning.code.to_string(),
            severity: own.warning.severity.word().to_string(),
            evaluation: (EVALUATIONS.iter())
                .position(|known| *known == own.warning.evaluation)
                .unwrap_or_default(),
            part: own.warning.part.clone(),
            names_part: own.warning.names_part(),
            time: own.warning.time,
            values: (own.warning.values.iter())
                .map(|(name, amount, unit)| {
                    let said = match amount {
                        Amount::Number(value) => Said::Number(*value),
                        Amount::Text(text) => Said::Text(text.clone()),
                    };
                    (name.to_string(), said, unit.to_string())
                })
                .collect(),
            grade: own.warning.grade,
            text: own.warning.text.clone(),
            member: own.member,
            count: own.count,
            place: own.place,
            alike: own.alike,
        };
        self.list.iter().map(tell).collect()
    }

    /// Those of so many members as a file kept them; none where a word is none that was kept.
    pub fn of_told(members: usize, list: Vec<Told>) -> Option<Joined> {
        let read = |told: Told| {
            let kind = Declared {
                name: "",
                code: lasting(told.code),
                severity: Severity::of_word(&told.severity)?,
                evaluation: *EVALUATIONS.get(told.evaluation)?,
                by: "",
            };
            let value = |(name, said, unit)| {
                let amount = match said {
                    Said::Number(value) => Amount::Number(value),
                    Said::Text(text) => Amount::Text(text),
                };
                (lasting(name), amount, lasting(unit))
            };
            let time = told.time.map(|time| ("time", Amount::Number(time), "s"));
            let part = (told.names_part).then(|| ("part", Amount::Text(told.part.clone()), ""));
            let values = told.values.into_iter().map(value).chain(time).chain(part);
            let mut warning = Warning::new(&kind, told.text, values.collect());
            if !told.names_part {
                warning = warning.of_part(&told.part);
            }
            warning.grade = told.grade;
            Some(OfMembers {
                warning,
                member: told.member,
                count: told.count,
                place: told.place,
                alike: told.alike,
            })
        };
        let list = list.into_iter().map(read).collect::<Option<_>>()?;
        Some(Joined { members, list })
    }
}

fn in_each(warning: &Warning) -> bool {
    matches!(warning.evaluation, Evaluation::Each | Evaluation::CoastDown)
}

/// What is the same in another member; nothing is of what is said of the first alone.
fn find<'a>(list: &'a mut [OfMembers], new: &OfMembers) -> Option<&'a mut OfMembers> {
    let same = |own: &&mut OfMembers| {
        let (own, new) = (&own.warning, &new.warning);
        in_each(new)
            && [own.code, &own.part] == [new.code, &new.part]
            && own.evaluation == new.evaluation
    };
    list.iter_mut().find(same)
}

/// The same text for as long as the process lives: names of values and their units, of which there are few.
fn lasting(text: String) -> &'static str {
    static KNOWN: Mutex<BTreeSet<&str>> = Mutex::new(BTreeSet::new());
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(own) = known.get(text.as_str()) {
        return own;
    }
    let own = &*text.leak();
    known.insert(own);
    own
}

#[cfg(test)]
mod tests {
    use super::*;

    problem::warnings! {
        enum Own {
            Load { part: text, force: "N" } "AB1001" Destroys, each ("{part}: {force} N.");
            Long { time: "s" } "AB1002" Uncertain, each ("From {time} s on.");
            Given {} "AB1003" Note ("As given.");
        }
    }

    /// Warnings of a member: a load that grows with its number in two bearings, an instant in every other, what is given in all.
    fn of(member: usize) -> Vec<Warning> {
        let load = |part: &str, force: f64| {
            let part = part.to_string();
            let mut warning = Warning::from(Own::Load { part, force });
            warning.grade = force;
            warning
        };
        let force = ((7 * member) % 11) as f64;
        let mut list = vec![load("a", force), load("b", 3.0), Own::Given {}.into()];
        if member % 2 == 1 {
            list.push(Warning::from(Own::Long { time: 0.5 }).of_part("a"));
        }
        list
    }

    fn joined(members: impl Iterator<Item = usize>) -> Joined {
        let mut all = Joined::default();
        members.for_each(|k| all.add(k, of(k)));
        all
    }

    #[test]
    fn neither_order_nor_parts_nor_a_file_change_what_members_say() {
        let whole = joined(0..9).list(true);
        let texts: Vec<String> = whole.iter().map(ToString::to_string).collect();
        assert_eq!(
            texts,
            [
                "a: 10 N. In 9 of 9 members; the numbers are those of member 3.",
                "b: 3 N.",
                "As given.",
                "a: From 0.5 s on. In 4 of 9 members; the numbers are those of member 1.",
            ]
        );
        assert_eq!(joined((0..9).rev()).list(true), whole);
        let (mut first, rest) = (joined(5..9), joined(0..5));
        let told = serde_json::to_string(&rest.told()).unwrap();
        let read = Joined::of_told(5, serde_json::from_str(&told).unwrap()).unwrap();
        first.append(read);
        assert_eq!(first.list(true), whole);
        let odd = told.replace("destroys", "destructive");
        assert!(Joined::of_told(5, serde_json::from_str(&odd).unwrap()).is_none());
    }
}
