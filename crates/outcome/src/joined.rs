//! Warnings of the members of a repetition, joined.

use crate::{Scope, Warning};
use problem::warning::Evaluation;
use serde::{Deserialize, Serialize};

/// Warnings of members, added in any order: each once, as the one has it where it is most severe.
#[derive(Clone, Default, Serialize, Deserialize)]
pub struct Joined {
    members: usize,
    list: Vec<OfMembers>,
}

#[derive(Clone, Serialize, Deserialize)]
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
}

fn in_each(warning: &Warning) -> bool {
    matches!(warning.evaluation, Evaluation::Each | Evaluation::CoastDown)
}

/// What is the same in another member; nothing is of what is said of the first alone.
fn find<'a>(list: &'a mut [OfMembers], new: &OfMembers) -> Option<&'a mut OfMembers> {
    let same = |own: &&mut OfMembers| {
        let (own, new) = (&own.warning, &new.warning);
        in_each(new)
            && own.code == new.code
            && own.part == new.part
            && own.evaluation == new.evaluation
    };
    list.iter_mut().find(same)
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
        let file = serde_json::to_string(&rest).unwrap();
        first.append(serde_json::from_str(&file).unwrap());
        assert_eq!(first.list(true), whole);
    }
}
