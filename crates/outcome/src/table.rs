//! Drawn inputs beside results: a row a member, a column with unit an input or result.

use crate::limits::{CUT_BEFORE_COASTING, contacts_of, left_open, sized, stays_broken};
use crate::{Outcome, Quantity, Value};
use problem::explain;
use scenario::Limit;
use serde::Serialize;
use std::collections::BTreeMap;

/// Members with what they drew and gave; what a member does not have is not a number.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
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
#[derive(Clone, Debug, Default, Serialize)]
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

impl PartialEq for Column {
    /// What a member does not have is alike.
    fn eq(&self, other: &Self) -> bool {
        let alike = |(own, other): (&f64, &f64)| own == other || own.is_nan() && other.is_nan();
        [&self.name, &self.unit, &self.meaning] == [&other.name, &other.unit, &other.meaning]
            && self.values.len() == other.values.len()
            && self.values.iter().zip(&other.values).all(alike)
    }
}

/// What a column begins with that has the time until which an instant did not come in a run that ended as planned, s.
pub const LATE: &str = "late.";
/// What a column begins with that has a result as it was when a run stopped that did not end as planned.
pub const STOPPED: &str = "stopped.";
/// What a column begins with that is 1 for members with a warning of that code.
pub const WARNING: &str = "warning.";
/// What columns of results at design accuracy begin with.
pub const CONFIRMED: &str = "confirmed.";

impl Table {
    /// A table of these inputs without members.
    pub fn of(inputs: Vec<Column>) -> Table {
        Table {
            inputs: inputs.len(),
            columns: inputs,
            ..Table::default()
        }
    }

    /// Adds a member with its inputs and what came out of it; words and lists are left out.
    pub fn push(&mut self, member: usize, inputs: Vec<f64>, outcome: &Outcome) {
        self.members.push(member);
        for (column, value) in self.columns.iter_mut().zip(inputs) {
            column.values.push(value);
        }
        let whole = outcome.stop.complete();
        if !whole {
            self.failed.insert(member, outcome.stop.text.clone());
        }
        let mut last = 0;
        let from = crate::counted_from(&outcome.quantities);
        for result in &outcome.quantities {
            let value = match result.value {
                Value::Number(value) => value,
                Value::None { .. } => f64::NAN,
                Value::List(_) | Value::Text(_) => continue,
            };
            // results of a run that ended early are those of another question, but what is broken by then stays so
            let kept = if whole { value } else { f64::NAN };
            last = self.set(last + 1, &result.name, result.unit, || result.law, kept);
            if !whole && value.is_finite() {
                let name = format!("{STOPPED}{}", result.name);
                let meaning = || "when a run stopped that did not end as planned";
                last = self.set(last + 1, &name, result.unit, meaning, value);
            }
            // nobody watches for it during a coast-down
            let cut = || {
                outcome
                    .warnings
                    .iter()
                    .any(|own| own.code == CUT_BEFORE_COASTING)
            };
            if let (true, Some(from)) = (result.awaited && value.is_nan() && whole && !cut(), from)
            {
                let name = format!("{LATE}{}", result.name);
                let meaning = || "the run ended before it came";
                last = self.set(last + 1, &name, "s", meaning, outcome.stop.time - from);
            }
        }
        for warning in &outcome.warnings {
            let name = format!("{WARNING}{}", warning.code);
            last = self.set(last + 1, &name, "", || explain::title(warning.code), 1.0);
        }
        let count = self.members.len();
        for column in &mut self.columns {
            column.values.resize(count, f64::NAN);
        }
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

    /// Whether some member has a warning.
    pub fn warns(&self, code: &str) -> bool {
        self.column(&format!("{WARNING}{code}")).is_some()
    }

    /// The same with the members in their order.
    pub fn sorted(mut self) -> Table {
        if self.members.is_sorted() {
            return self;
        }
        let mut order: Vec<usize> = (0..self.members.len()).collect();
        order.sort_by_key(|row| self.members[*row]);
        self.members = order.iter().map(|row| self.members[*row]).collect();
        for column in &mut self.columns {
            column.values = order.iter().map(|row| column.values[*row]).collect();
        }
        self
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

    /// A result of each member, of one that stopped as it was then.
    pub fn reached(&self, name: &str) -> Vec<Option<f64>> {
        let stopped = self.values(&format!("{STOPPED}{name}")).into_iter();
        let values = self.values(name).into_iter().zip(stopped);
        values.map(|(value, stopped)| value.or(stopped)).collect()
    }

    /// A result of each member: at design accuracy where that was confirmed. An instant that did not come while a run lasted is infinite
    /// where that is past a bound: whenever it comes, it is beyond it.
    pub fn decisive(&self, name: &str, bound: f64) -> Vec<Option<f64>> {
        let of = |begin: &str| -> Vec<Option<f64>> {
            let late = self.values(&format!("{begin}{LATE}{name}")).into_iter();
            let late = late.map(|lasted| (lasted? > bound).then_some(f64::INFINITY));
            let values = self.values(&format!("{begin}{name}")).into_iter();
            values
                .zip(late)
                .map(|(value, late)| value.or(late))
                .collect()
        };
        let both = of(CONFIRMED).into_iter().zip(of(""));
        both.map(|(design, screening)| design.or(screening))
            .collect()
    }

    /// What a limit holds of a result in each member; none where a warning leaves open what holds it.
    pub fn limited(&self, limit: &Limit, known: Option<&Quantity>) -> Vec<Option<f64>> {
        let name = limit.quantity.as_str();
        let [of_contacts, is_instant] =
            known.map_or([false; 2], |known| [known.of_contacts, known.awaited]);
        let mut values = self.decisive(name, limit.bound);
        let warned = |code: &str| self.values(&format!("{WARNING}{code}"));
        let early: Vec<_> = left_open(name, false)
            .map(|(code, _)| warned(code))
            .collect();
        let touches = contacts_of(name).map(|names| names.map(|name| self.values(&name)));
        for (k, value) in values.iter_mut().enumerate() {
            let whole = early.iter().all(|own| own[k].is_none())
                && !self.failed.contains_key(&self.members[k]);
            // a race that the rotor does not touch comes to no speed, and need not
            let idle = (touches.as_ref())
                .is_some_and(|[bore, face]| bore[k] == Some(0.0) && face[k].is_none());
            if whole && idle {
                *value = Some(0.0);
            } else if whole && of_contacts {
                *value = value.or(Some(0.0));
            }
        }
        let holds = |value: f64| limit.side.holds(sized(limit, value), limit.bound);
        for (code, _) in left_open(name, is_instant) {
            for (value, warned) in values.iter_mut().zip(warned(code)) {
                let open = |value: &f64| holds(*value) || !stays_broken(limit);
                *value = value.filter(|value| warned.is_none() || !open(value));
            }
        }
        values
    }

    /// Number of members.
    pub fn len(&self) -> usize {
        self.members.len()
    }

    /// True where there are no members.
    pub fn is_empty(&self) -> bool {
        self.members.is_empty()
    }

    /// The results of a member by its row.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (&str, Option<f64>)> {
        let results = self.columns[self.inputs..].iter();
        let results = results.filter(|column| {
            let besides = [LATE, STOPPED, WARNING];
            !besides.iter().any(|own| column.name.starts_with(own))
        });
        results.map(move |column| {
            let value = Some(column.values[row]).filter(|value| value.is_finite());
            (column.name.as_str(), value)
        })
    }
}
