//! Drawn inputs beside results: a row a member, a column with unit an input or result.

use crate::warnings::rank;
use outcome::{Quantity, Severity, Value, Warning};
use problem::explain;
use scenario::Forbidden;
use std::collections::BTreeMap;

/// Members with what they drew and gave; what a member does not have is not a number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Members in their order.
    pub members: Vec<usize>,
    /// Inputs first, then results.
    pub columns: Vec<Column>,
    /// How many of the columns are inputs.
    pub inputs: usize,
    /// Members that did not end as planned, with the reason.
    pub failed: BTreeMap<usize, String>,
}

/// An input or a result of all members.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Column {
    /// Its name; inputs begin with `input.`.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// What it is.
    pub meaning: String,
    /// A value a member.
    pub values: Vec<f64>,
}

/// One member.
pub(super) struct Row {
    pub member: usize,
    pub inputs: Vec<f64>,
    pub whole: bool,
    /// How long it lasted, s.
    pub time: f64,
    pub why: Option<String>,
    pub results: Vec<Quantity>,
    pub warnings: Vec<Warning>,
}

/// What a column begins with that has the time until which an instant did not come in a run that ended as planned, s.
pub const LATE: &str = "late.";
/// What a column begins with that has a result as it was when a run stopped that did not end as planned.
pub const STOPPED: &str = "stopped.";
/// What a column begins with that is 1 for members with a warning of that code.
const WARNING: &str = "warning.";

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

impl Table {
    pub(super) fn of(inputs: Vec<Column>, rows: Vec<Row>) -> Table {
        let mut table = Table {
            inputs: inputs.len(),
            columns: inputs,
            ..Table::default()
        };
        for row in rows {
            table.members.push(row.member);
            for (column, value) in table.columns.iter_mut().zip(row.inputs) {
                column.values.push(value);
            }
            if let Some(why) = row.why {
                table.failed.insert(row.member, why);
            }
            let mut last = 0;
            let from = outcome::counted_from(&row.results);
            for result in &row.results {
                let value = match result.value {
                    Value::Number(value) => value,
                    Value::None { .. } => f64::NAN,
                    Value::List(_) | Value::Text(_) => continue,
                };
                // results of a run that ended early are those of another question, but what is broken by then stays so
                let kept = if row.whole { value } else { f64::NAN };
                last = table.set(last + 1, &result.name, result.unit, || result.law, kept);
                if !row.whole && value.is_finite() {
                    let name = format!("{STOPPED}{}", result.name);
                    let meaning = || "when a run stopped that did not end as planned";
                    last = table.set(last + 1, &name, result.unit, meaning, value);
                }
                if let (true, Some(from)) = (result.awaited && value.is_nan() && row.whole, from) {
                    let name = format!("{LATE}{}", result.name);
                    let meaning = || "the run ended before it came";
                    last = table.set(last + 1, &name, "s", meaning, row.time - from);
                }
            }
            for warning in &row.warnings {
                let name = format!("{WARNING}{}", warning.code);
                last = table.set(last + 1, &name, "", || explain::title(warning.code), 1.0);
            }
            let count = table.members.len();
            for column in &mut table.columns {
                column.values.resize(count, f64::NAN);
            }
        }
        table
    }

    /// The last member has a value in a column, which begins with it where there is none yet; returns the place of the column, which
    /// in most rows is the one expected.
    fn set(
        &mut self,
        expected: usize,
        name: &str,
        unit: &str,
        meaning: impl FnOnce() -> &'static str,
        value: f64,
    ) -> usize {
        let has = |column: &Column| column.name == name;
        let known = match self.columns.get(expected) {
            Some(column) if has(column) => Some(expected),
            _ => self.columns.iter().position(has),
        };
        let at = known.unwrap_or_else(|| {
            self.columns.push(Column {
                name: name.to_string(),
                unit: unit.to_string(),
                meaning: meaning().to_string(),
                values: Vec::new(),
            });
            self.columns.len() - 1
        });
        let values = &mut self.columns[at].values;
        values.resize(self.members.len() - 1, f64::NAN);
        values.push(value);
        at
    }

    /// Whether each member has a warning of these, 1 or 0; not known of those that failed without one.
    pub(super) fn warned_of(&self, forbids: &Forbidden) -> Vec<Option<f64>> {
        let meets = |column: &&Column| {
            let code = column.name.strip_prefix(WARNING);
            code.is_some_and(|code| forbids.meets(code, rank(code).0))
        };
        let columns: Vec<&Column> = self.columns.iter().filter(meets).collect();
        let of = |(row, member): (usize, &usize)| {
            let has = columns.iter().any(|column| !column.values[row].is_nan());
            match has {
                true => Some(1.0),
                false => (!self.failed.contains_key(member)).then_some(0.0),
            }
        };
        self.members.iter().enumerate().map(of).collect()
    }

    /// A result of each member, of one that stopped as it was then.
    pub fn reached(&self, name: &str) -> Vec<Option<f64>> {
        let stopped = self.values(&format!("{STOPPED}{name}")).into_iter();
        let values = self.values(name).into_iter().zip(stopped);
        values.map(|(value, stopped)| value.or(stopped)).collect()
    }

    /// Whether some member has a warning.
    pub fn warns(&self, code: &str) -> bool {
        self.column(&format!("{WARNING}{code}")).is_some()
    }

    /// The same with the members in their order.
    pub fn sorted(mut self) -> Table {
        let mut order: Vec<usize> = (0..self.members.len()).collect();
        order.sort_by_key(|row| self.members[*row]);
        self.members = order.iter().map(|row| self.members[*row]).collect();
        for column in &mut self.columns {
            column.values = order.iter().map(|row| column.values[*row]).collect();
        }
        self
    }

    /// What members warn of, the most severe first.
    pub fn warned(&self) -> Vec<Warned> {
        let of = |column: &Column| {
            let code = column.name.strip_prefix(WARNING)?;
            let mut members = (self.members.iter().zip(&column.values))
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
        let mut list: Vec<Warned> = self.columns.iter().filter_map(of).collect();
        list.sort_by_cached_key(|own| (rank(&own.code), own.code.clone()));
        list
    }

    /// The same with results in the order of these names, others behind them by their names: however parts were computed
    /// together, the table is the same.
    pub fn ordered(mut self, names: &[&str]) -> Table {
        let place = |column: &Column| {
            let known = names.iter().position(|name| *name == column.name);
            (known.unwrap_or(names.len()), column.name.clone())
        };
        self.columns[self.inputs..].sort_by_cached_key(place);
        self
    }

    /// Adds the members of another table behind these.
    pub fn append(&mut self, other: Table) {
        if self.columns.is_empty() {
            *self = other;
            return;
        }
        let before = self.members.len();
        self.members.extend(other.members);
        self.failed.extend(other.failed);
        for column in other.columns {
            let known = self.columns.iter().position(|own| own.name == column.name);
            let at = known.unwrap_or_else(|| {
                let fresh = Column {
                    values: vec![f64::NAN; before],
                    ..column.clone()
                };
                self.columns.push(fresh);
                self.columns.len() - 1
            });
            self.columns[at].values.extend(column.values);
        }
        for column in &mut self.columns {
            column.values.resize(self.members.len(), f64::NAN);
        }
    }

    /// Some of the rows; results that none of these members has are left out, as if they were computed alone.
    pub fn part(&self, rows: std::ops::Range<usize>) -> Table {
        let members = self.members[rows.clone()].to_vec();
        let failed = self
            .failed
            .iter()
            .filter(|(member, _)| members.contains(member));
        let columns = self.columns.iter().enumerate().map(|(at, column)| {
            let values = column.values[rows.clone()].to_vec();
            (
                at,
                Column {
                    values,
                    ..column.clone()
                },
            )
        });
        let has = |column: &Column| column.values.iter().any(|value| !value.is_nan());
        Table {
            failed: failed.map(|(member, why)| (*member, why.clone())).collect(),
            columns: columns
                .filter(|(at, column)| *at < self.inputs || has(column))
                .map(|(_, column)| column)
                .collect(),
            inputs: self.inputs,
            members,
        }
    }

    /// A column by its name.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|column| column.name == name)
    }

    /// A result of each member; none of those that lack it.
    pub fn values(&self, name: &str) -> Vec<Option<f64>> {
        let finite = |value: &f64| value.is_finite().then_some(*value);
        match self.column(name) {
            Some(column) => column.values.iter().map(finite).collect(),
            None => vec![None; self.members.len()],
        }
    }
}
