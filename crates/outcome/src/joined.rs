//! Warnings of the members of a repetition, joined.

use crate::{Scope, Warning};
use problem::warning::Evaluation;

/// Warnings of members that come one after the other: each once, as the one has it where it is most severe.
#[derive(Default)]
pub struct Joined {
    members: usize,
    list: Vec<OfMembers>,
}

struct OfMembers {
    warning: Warning,
    /// Whose it is, the last that has one, and how many have.
    member: usize,
    last: usize,
    count: usize,
    /// Whether all of them say the same.
    alike: bool,
}

impl Joined {
    /// Adds those of the next member, by its index, in their order; of another than the first only those judged in each.
    pub fn add(&mut self, member: usize, warnings: Vec<Warning>) {
        self.members += 1;
        let mut place = 0;
        for warning in warnings {
            let in_each = matches!(warning.evaluation, Evaluation::Each | Evaluation::CoastDown);
            if member > 0 && !in_each {
                continue;
            }
            let same = |own: &OfMembers| {
                let (own, new) = (&own.warning, &warning);
                in_each
                    && [own.code, &own.part] == [new.code, &new.part]
                    && own.evaluation == new.evaluation
            };
            let Some(at) = self.list.iter().position(same) else {
                let new = OfMembers {
                    warning,
                    member,
                    last: member,
                    count: 1,
                    alike: true,
                };
                self.list.insert(place, new);
                place += 1;
                continue;
            };
            let known = &mut self.list[at];
            place = at + 1;
            known.count += usize::from(known.last != member);
            known.last = member;
            known.alike &= known.warning.text == warning.text;
            if warning.grade > known.warning.grade {
                (known.warning, known.member) = (warning, member);
            }
        }
    }

    /// All of them, with the members that have them; `alike` where all have one machine.
    pub fn list(self, alike: bool) -> Vec<Warning> {
        let all = self.members;
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
