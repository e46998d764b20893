//! What is kept of the members of a repetition, and where.

use super::table::Table;
use outcome::joined::Joined;
use outcome::{Outcome, Quantity, Value, Work};
use serde::{Deserialize, Deserializer, Serialize};
use simulate::bearing::LIFE_BY_POINT;
use std::collections::BTreeMap;

/// Where members are kept as they end, by parts; what is there is not computed again.
pub trait Store: Sync {
    /// The members of a part that are there.
    fn there(&self, part: usize) -> Members;
    /// Keeps more members of a part, which ended as planned.
    fn keep(&self, part: usize, fresh: &Members);
}

/// Keeps nothing.
pub struct Nowhere;

impl Store for Nowhere {
    fn there(&self, _: usize) -> Members {
        Members::default()
    }
    fn keep(&self, _: usize, _: &Members) {}
}

/// Members with their results, and what of them counts in sums alone: that is what a file has beside the table.
#[derive(Clone, Default, Serialize, Deserialize)]
pub struct Members {
    /// Results of those that ended as planned: another would pull every mean.
    #[serde(skip)]
    pub table: Table,
    /// Lives by point of these, by their names.
    lives: BTreeMap<String, Lives>,
    warnings: Joined,
    work: Work,
}

/// Sums over members, whose rounding does not depend on their order.
#[derive(Clone, Default, Serialize, Deserialize)]
struct Lives {
    #[serde(deserialize_with = "numbers")]
    sums: Vec<f64>,
    /// What the sums have lost by rounding.
    #[serde(deserialize_with = "numbers")]
    lost: Vec<f64>,
    count: f64,
}

/// Numbers of a file, in which one that is none has no value.
fn numbers<'de, D: Deserializer<'de>>(file: D) -> Result<Vec<f64>, D::Error> {
    let values = Vec::<Option<f64>>::deserialize(file)?.into_iter();
    Ok(values.map(|value| value.unwrap_or(f64::NAN)).collect())
}

impl Lives {
    /// Neumaier's sum.
    fn add(&mut self, values: &[f64]) {
        let count = self.sums.len().max(values.len());
        self.sums.resize(count, 0.0);
        self.lost.resize(count, 0.0);
        for ((sum, lost), value) in self.sums.iter_mut().zip(&mut self.lost).zip(values) {
            let next = *sum + value;
            *lost += match sum.abs() >= value.abs() {
                true => (*sum - next) + value,
                false => (value - next) + *sum,
            };
            *sum = next;
        }
    }
}

impl Members {
    /// Adds a member.
    pub(super) fn add(&mut self, k: usize, made: &mut Outcome) {
        self.work.members += 1;
        self.work.steps += made.work.steps;
        self.work.rejected += made.work.rejected;
        self.work.rate_calls += made.work.rate_calls;
        if made.stop.complete() {
            for result in made.quantities.iter().filter(|own| is_life(own)) {
                if let Value::List(values) = &result.value {
                    let lives = self.lives.entry(result.name.clone()).or_default();
                    lives.add(values);
                    lives.count += 1.0;
                }
            }
            self.table.push(k, Vec::new(), made);
        }
        self.warnings.add(k, std::mem::take(&mut made.warnings));
    }

    /// Adds those of another part.
    pub fn append(&mut self, other: Members) {
        self.table.append(other.table);
        for (name, other) in other.lives {
            let lives = self.lives.entry(name).or_default();
            lives.add(&other.sums);
            lives.add(&other.lost);
            lives.count += other.count;
        }
        self.warnings.append(other.warnings);
        self.work.members += other.work.members;
        self.work.steps += other.work.steps;
        self.work.rejected += other.work.rejected;
        self.work.rate_calls += other.work.rate_calls;
    }

    /// The mean of a life by point.
    pub(super) fn mean_life(&self, name: &str) -> Vec<f64> {
        let Some(lives) = self.lives.get(name) else {
            return Vec::new();
        };
        let sums = lives.sums.iter().zip(&lives.lost);
        sums.map(|(sum, lost)| (sum + lost) / lives.count).collect()
    }

    /// Warnings and work.
    pub(super) fn without_table(self) -> (Joined, Work) {
        (self.warnings, self.work)
    }
}

/// Whether a result is a life by point, of which a repetition has the mean.
pub(super) fn is_life(quantity: &Quantity) -> bool {
    quantity.name.ends_with(LIFE_BY_POINT)
}
