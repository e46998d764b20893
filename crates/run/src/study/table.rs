//! What the members of a table warn of.

use crate::warnings::rank;
use outcome::Severity;
pub use outcome::table::{CONFIRMED, Column, LATE, STOPPED, Table, WARNING};
use scenario::Forbidden;

/// What some members warn of.
#[derive(Clone, Debug, PartialEq)]
pub struct Warned {
    /// Its code.
    pub code: String,
    /// What the book calls it.
    pub title: String,
    /// Members that have it.
    pub members: usize,
    /// The first of them.
    pub first: usize,
}

impl Warned {
    /// How severe it is.
    pub fn severity(&self) -> Severity {
        rank(&self.code).0
    }

    /// Which of so many members have it, in words.
    pub fn share(&self, all: usize) -> String {
        match self.members == all {
            true => "all members".to_string(),
            false => format!(
                "{} of {all} members, the first is {}",
                self.members, self.first
            ),
        }
    }
}

/// Whether each member has a warning of these, 1 or 0; not known of those that failed without one, nor, of warnings that may come
/// later, of those that end too soon, which these warnings say.
pub(super) fn warned_of(table: &Table, forbids: &Forbidden, too_soon: &[&str]) -> Vec<Option<f64>> {
    let unfinished = too_soon
        .iter()
        .map(|code| table.values(&format!("{WARNING}{code}")));
    let unfinished: Vec<_> = unfinished.collect();
    let meets = |column: &&Column| {
        let code = column.name.strip_prefix(WARNING);
        code.is_some_and(|code| forbids.meets(code, rank(code).0))
    };
    let columns: Vec<&Column> = table.columns.iter().filter(meets).collect();
    let of = |(row, member): (usize, &usize)| {
        let has = columns.iter().any(|column| !column.values[row].is_nan());
        match has {
            true => Some(1.0),
            false if unfinished.iter().any(|own| own[row].is_some()) => None,
            false => (!table.failed.contains_key(member)).then_some(0.0),
        }
    };
    table.members.iter().enumerate().map(of).collect()
}

/// What members warn of, the most severe first.
pub fn warned(table: &Table) -> Vec<Warned> {
    let of = |column: &Column| {
        let code = column.name.strip_prefix(WARNING)?;
        let mut members = (table.members.iter().zip(&column.values))
            .filter(|(_, value)| !value.is_nan())
            .map(|(member, _)| *member);
        let first = members.next()?;
        Some(Warned {
            code: code.to_string(),
            title: column.meaning.clone(),
            members: 1 + members.count(),
            first,
        })
    };
    let mut list: Vec<Warned> = table.columns.iter().filter_map(of).collect();
    list.sort_by_cached_key(|own| (rank(&own.code), own.code.clone()));
    list
}
