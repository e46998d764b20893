//! Members that lie nearest to a limit, run again at design accuracy: both values are kept, and design decides.

use super::Study;
use super::table::{CONFIRMED, Column, LATE, STOPPED, Table, warned_of};
use crate::Options;
use outcome::forbidden::{may_come_later, not_evaluated, unjudged};
use outcome::list::NOT_GIVEN;
use outcome::{Value, limits};
use scenario::Limit;

impl Study {
    /// The members nearest to each limit, as many as are to be confirmed, in their order.
    pub fn nearest(&self, table: &Table) -> Vec<usize> {
        let mut near: Vec<usize> = Vec::new();
        for limit in &self.file.limits {
            let values = match limit.forbids {
                Some(_) => continue,
                None => table.values(&limit.quantity),
            };
            let members = table.members.iter().zip(values);
            let apart = members.filter_map(|(k, value)| Some((*k, (value? - limit.bound).abs())));
            let mut apart: Vec<(usize, f64)> = apart.collect();
            apart.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
            near.extend(apart.into_iter().take(self.file.confirm).map(|(k, _)| k));
        }
        near.sort_unstable();
        near.dedup();
        near
    }

    /// Runs members at design accuracy. None where this was interrupted.
    pub fn confirmed(&self, members: &[usize], options: &Options) -> Option<Table> {
        let accuracy = ("run.accuracy".to_string(), "design".to_string());
        let table = self.run_with(members, &[accuracy], options);
        (table.members.len() == members.len()).then_some(table)
    }

    /// Adds the results at design accuracy that limits and ranking ask for, beside those of screening.
    pub fn with_confirmed(&self, table: &mut Table, confirmed: &Table) {
        let limits = self.file.limits.iter().map(|limit| limit.quantity.clone());
        let ranked = self.file.rank.iter().map(|(name, ..)| name.clone());
        let mut names: Vec<String> = limits.chain(ranked).collect();
        names.sort_unstable();
        names.dedup();
        for name in names {
            for late in ["", LATE] {
                let Some(column) = confirmed.column(&format!("{late}{name}")) else {
                    continue;
                };
                let mut values = vec![f64::NAN; table.members.len()];
                for (member, value) in confirmed.members.iter().zip(&column.values) {
                    if let Ok(row) = table.members.binary_search(member) {
                        values[row] = *value;
                    }
                }
                table.columns.push(Column {
                    name: format!("{CONFIRMED}{late}{name}"),
                    unit: column.unit.clone(),
                    meaning: format!("{} at design accuracy", column.meaning),
                    values,
                });
            }
        }
    }

    /// What a limit holds, of each member: a result, or whether a warning came.
    pub fn limited(&self, table: &Table, limit: &Limit) -> Vec<Option<f64>> {
        match &limit.forbids {
            Some(forbids) => {
                let declared = crate::warnings::of(&self.file.scenario);
                // before the runs nothing has a value but what its keys leave out
                let mut known = self.known.clone();
                for own in &mut known {
                    if !(own.value.why_absent()).is_some_and(|why| why.ends_with(NOT_GIVEN)) {
                        own.value = Value::Number(0.0);
                    }
                }
                let unjudged = || unjudged(forbids, &declared, |code| table.warns(code));
                match not_evaluated(forbids, &declared, &known).or_else(unjudged) {
                    Some(_) => vec![None; table.members.len()],
                    None => {
                        let later = may_come_later(forbids, &declared);
                        let too_soon: Vec<_> = later.map(|(code, _)| *code).collect();
                        warned_of(table, forbids, &too_soon)
                    }
                }
            }
            None => {
                let mut known = self.known.iter();
                let known = known.find(|known| known.name == limit.quantity);
                let values = table.limited(limit, known);
                let sized = |value: f64| limits::sized(limit, value);
                // what was broken when a run stopped stays so
                let stopped = table.values(&format!("{STOPPED}{}", limit.quantity));
                let both = values.into_iter().zip(stopped).map(|(value, stopped)| {
                    let breaks = |value: &f64| !limit.side.holds(*value, limit.bound);
                    let stopped = stopped.map(sized).filter(breaks);
                    value.map(sized).or(stopped)
                });
                both.collect()
            }
        }
    }
}
